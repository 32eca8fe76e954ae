//! How sure it is where the robot stands: what was told with a pose, carried on over what was driven since.
//!
//! Compounded after R. Smith, P. Cheeseman, "On the representation and estimation of spatial uncertainty" (1986): who is not
//! sure of a heading is the less sure of the place, the farther it went from there.
//!
//! **Invariant**: nothing is made up. What nobody told is said to be unknown.

use crate::frames::Place;
use crate::messages::Covariance;

/// A variance that tells of nothing, m²: the robot may be anywhere within a kilometre.
const ANYWHERE: f64 = 1e6;
/// Of a heading that may be any: (2π)² / 12, rad².
const ANY_WAY: f64 = std::f64::consts::PI * std::f64::consts::PI / 3.0;
/// x, y and the turn about z among the rows of ROS.
const ROWS: [usize; 3] = [0, 1, 5];

/// The covariance of a place: x, y in m and the heading in rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spread([[f64; 3]; 3]);

impl Spread {
    /// What a message tells. None where it tells nothing: nobody is sure without end, so all zeros say that it is unknown, as
    /// a negative variance does.
    pub(crate) fn of(told: &Covariance) -> Option<Self> {
        let cells = ROWS.map(|row| ROWS.map(|column| told.rows[row][column]));
        let are_numbers = cells.iter().flatten().all(|cell| cell.is_finite());
        let variances = [cells[0][0], cells[1][1], cells[2][2]];
        let are_told = variances.iter().all(|variance| *variance >= 0.0)
            && variances.iter().any(|variance| *variance > 0.0);
        (are_numbers && are_told).then_some(Self(cells))
    }

    /// As a message tells it. The height and the tilts of a robot on a floor are certain: 0, as AMCL has them.
    pub(crate) fn told(spread: Option<Self>) -> Covariance {
        let unknown = [[ANYWHERE, 0.0, 0.0], [0.0, ANYWHERE, 0.0], [0.0, 0.0, ANY_WAY]];
        let cells = spread.map_or(unknown, |spread| spread.0);
        let mut rows = [[0.0; 6]; 6];
        for (row, cells) in ROWS.into_iter().zip(cells) {
            for (column, cell) in ROWS.into_iter().zip(cells) {
                rows[row][column] = cell;
            }
        }
        Covariance { rows }
    }

    /// Of a place to which the robot came from one of which this was known.
    fn carried(self, from: Place, to: Place) -> Self {
        // x' = x + dx, y' = y + dy, where (dx, dy) turns with the heading that it set out with.
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let jacobian = [[1.0, 0.0, -dy], [0.0, 1.0, dx], [0.0, 0.0, 1.0]];
        let mut cells = [[0.0; 3]; 3];
        for (i, row) in cells.iter_mut().enumerate() {
            for (j, cell) in row.iter_mut().enumerate() {
                *cell = (0..3)
                    .flat_map(|k| (0..3).map(move |l| (k, l)))
                    .map(|(k, l)| jacobian[i][k] * self.0[k][l] * jacobian[j][l])
                    .sum();
            }
        }
        Self(cells)
    }

    /// The same, less sure by what another grew meanwhile: in every direction as in its worst, since that is of another frame.
    fn grown(mut self, before: Self, after: Self) -> Self {
        let by = |cell: usize| (after.0[cell][cell] - before.0[cell][cell]).max(0.0);
        let place = by(0).max(by(1));
        self.0[0][0] += place;
        self.0[1][1] += place;
        self.0[2][2] += by(2);
        self
    }
}

/// A place that a localisation found, and how sure the wheels were then.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Found {
    place: Place,
    spread: Spread,
    wheels: Option<Spread>,
}

impl Found {
    pub(crate) fn new(place: Place, spread: Spread, wheels: Option<Spread>) -> Self {
        Self { place, spread, wheels }
    }

    /// How sure it is now, here, by what the wheels tell now.
    pub(crate) fn now(&self, here: Place, wheels: Option<Spread>) -> Spread {
        let carried = self.spread.carried(self.place, here);
        match (self.wheels, wheels) {
            (Some(before), Some(after)) => carried.grown(before, after),
            _ => carried,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagonal(x: f64, y: f64, yaw: f64) -> Spread {
        Spread([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, yaw]])
    }

    #[test]
    fn what_is_told_is_told_again_and_what_is_not_is_unknown() {
        let spread = Spread([[0.04, 0.01, 0.002], [0.01, 0.09, 0.003], [0.002, 0.003, 0.01]]);
        assert_eq!(Spread::of(&Spread::told(Some(spread))), Some(spread));
        let unknown = Spread::told(None);
        assert!(unknown.rows[0][0] >= 1e6 && unknown.rows[1][1] >= 1e6 && unknown.rows[5][5] > 3.0);
        for cell in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut rows = [[0.0; 6]; 6];
            rows[0][0] = cell;
            assert_eq!(Spread::of(&Covariance { rows }), None, "{cell}");
        }
    }

    #[test]
    fn an_unsure_heading_makes_the_place_unsure_across_the_way() {
        let at = |x: f64, y: f64| Place { x, y, yaw: 0.3 };
        let found = Found::new(at(1.0, 1.0), diagonal(0.01, 0.01, 0.0025), None);
        assert_eq!(found.now(at(1.0, 1.0), None), diagonal(0.01, 0.01, 0.0025));
        let Spread(after) = found.now(at(5.0, 1.0), None);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(near(after[0][0], 0.01) && near(after[1][1], 0.05) && near(after[1][2], 0.01));
        assert!(near(after[2][1], after[1][2]) && near(after[2][2], 0.0025));
    }

    #[test]
    fn what_the_wheels_lost_is_added_and_nothing_is_won() {
        let at = Place { x: 0.0, y: 0.0, yaw: 0.0 };
        let found = Found::new(at, diagonal(0.1, 0.1, 0.1), Some(diagonal(1.0, 1.0, 1.0)));
        assert_eq!(found.now(at, Some(diagonal(3.0, 2.0, 1.5))), diagonal(2.1, 2.1, 0.6));
        assert_eq!(found.now(at, Some(diagonal(0.0, 0.0, 0.0))), diagonal(0.1, 0.1, 0.1));
        assert_eq!(found.now(at, None), diagonal(0.1, 0.1, 0.1));
    }
}

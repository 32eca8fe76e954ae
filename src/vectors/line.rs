//! Lines through runs of points, in constant time each, with their uncertainty.
//!
//! Sums over the points before each point are kept, so that the moments of a run are differences of two of them.
//! The line minimises the squared distances across it (total least squares): its direction t is the greater axis of
//! the scatter S, tan 2θ = 2 S_xy / (S_xx − S_yy), and what remains is the smaller eigenvalue,
//! SSE = ½ (S_xx + S_yy − √((S_xx − S_yy)² + 4 S_xy²)). Products are not fused: without an instruction for it `mul_add` is a
//! call, and slower than all the rest.

use nalgebra::Vector2;

use crate::scan::Noise;

/// Deviation of a wall from its plane, in cm: what no sensor is to blame for.
pub(crate) const ROUGHNESS: f64 = 0.5;

/// Sums over a run of points: number, x, y, x², xy, y², 1/r².
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sums {
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
    yy: f64,
    inverse: f64,
}

impl Sums {
    /// With one more point, `square` cm² from the origin.
    pub(crate) fn and(&self, p: Vector2<f64>, square: f64) -> Self {
        Self {
            x: self.x + p.x,
            y: self.y + p.y,
            xx: p.x * p.x + self.xx,
            xy: p.x * p.y + self.xy,
            yy: p.y * p.y + self.yy,
            inverse: self.inverse + 1.0 / square,
        }
    }
}

/// How points lie about their centre.
struct Scatter {
    count: f64,
    centre: Vector2<f64>,
    /// S_xx + S_yy.
    sum: f64,
    /// S_xx − S_yy.
    difference: f64,
    /// 2 S_xy.
    twice: f64,
}

impl Scatter {
    fn of(sums: &[Sums], from: usize, to: usize) -> Self {
        let (a, b) = (&sums[from], &sums[to]);
        let count = (to - from) as f64;
        let share = 1.0 / count;
        let centre = Vector2::new((b.x - a.x) * share, (b.y - a.y) * share);
        let xx = (b.xx - a.xx) - centre.x * centre.x * count;
        let xy = (b.xy - a.xy) - centre.x * centre.y * count;
        let yy = (b.yy - a.yy) - centre.y * centre.y * count;
        Self { count, centre, sum: xx + yy, difference: xx - yy, twice: 2.0 * xy }
    }
}

/// A line by total least squares.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Line {
    pub(crate) count: f64,
    pub(crate) centre: Vector2<f64>,
    pub(crate) direction: Vector2<f64>,
    /// Squared distances along the line from the centre, summed, in cm².
    pub(crate) spread: f64,
    /// Squared distances across the line, summed, in cm².
    pub(crate) sse: f64,
    /// Mean variance of one point across the line, as the sensor's noise has it, in cm².
    pub(crate) expected: f64,
    /// What the two halves of the points disagree by, as a variance of one point, in cm²: of a line that is none, as two walls
    /// that hardly turn, it grows with the points, where the deviation of a single one hides it. Zero until asked for.
    pub(crate) bend: f64,
}

impl Line {
    /// Through the points `from..to`, at least one, each with variance `expected` across the line.
    pub(crate) fn through(sums: &[Sums], from: usize, to: usize, expected: f64) -> Self {
        let Scatter { count, centre, sum, difference, twice } = Scatter::of(sums, from, to);
        let root = length(difference, twice);
        let direction = half_turn(difference, twice, root);
        let sse = (0.5 * (sum - root)).max(0.0);
        let spread = (0.5 * (sum + root)).max(1e-12);
        Self { count, centre, direction, spread, sse, expected, bend: 0.0 }
    }

    /// Holds the two halves of the points `from..to`, through which this is the line, against one another.
    pub(crate) fn halve(&mut self, sums: &[Sums], from: usize, to: usize) {
        let middle = usize::midpoint(from, to);
        let sse = |from, to| {
            let half = Scatter::of(sums, from, to);
            (0.5 * (half.sum - length(half.difference, half.twice))).max(0.0)
        };
        // Two lines have two parameters more than one.
        self.bend = 0.5 * (self.sse - sse(from, middle) - sse(middle, to)).max(0.0);
    }

    /// The same for points that a range sensor measured from the origin.
    pub(crate) fn seen(sums: &[Sums], from: usize, to: usize, noise: &Noise) -> Self {
        let mut line = Self::through(sums, from, to, 0.0);
        let (a, b) = (&sums[from], &sums[to]);
        // n·u of a point at distance r is d / r, with d the distance of the line: no sum over angles is needed.
        let d = line.direction.perp(&line.centre);
        let share = 1.0 / line.count;
        let squares = ((b.xx - a.xx) + (b.yy - a.yy)) * share;
        let facing = (d * d * (b.inverse - a.inverse) * share).min(1.0);
        let bearing = noise.bearing * noise.bearing;
        let across = bearing * (squares - d * d).max(0.0) + ROUGHNESS * ROUGHNESS;
        line.expected = noise.along(squares.sqrt()) * facing + across;
        line
    }

    /// To the left of the direction.
    pub(crate) fn normal(&self) -> Vector2<f64> {
        Vector2::new(-self.direction.y, self.direction.x)
    }

    /// Place along the line, from the centre.
    pub(crate) fn place(&self, p: Vector2<f64>) -> f64 {
        (p - self.centre).dot(&self.direction)
    }

    pub(crate) fn at(&self, place: f64) -> Vector2<f64> {
        self.centre + self.direction * place
    }

    /// Where the beam along `u` meets the line: its range; infinite or negative where it does not.
    pub(crate) fn range(&self, u: Vector2<f64>) -> f64 {
        let n = self.normal();
        n.dot(&self.centre) / n.dot(&u)
    }

    /// Whether a point lies on the line, within so many deviations of a point and of the line where it was fitted.
    pub(crate) fn admits(&self, p: Vector2<f64>, deviations: f64) -> bool {
        let across = self.direction.perp(&(p - self.centre));
        across * across <= deviations * deviations * 2.0 * self.expected
    }

    /// Variance of one point across the line, in cm²: what the noise expects, or what is found where that is more.
    pub(crate) fn variance(&self) -> f64 {
        let found = if self.count > 2.0 { self.sse / (self.count - 2.0) } else { 0.0 };
        self.expected.max(found)
    }

    /// Variance of the line's direction, in rad².
    pub(crate) fn turning(&self) -> f64 {
        self.variance().max(self.bend) / self.spread
    }

    /// Covariance of the line's errors across itself at the places `a` and `b`.
    pub(crate) fn across(&self, a: f64, b: f64) -> f64 {
        self.variance().max(self.bend) * (1.0 / self.count + a * b / self.spread)
    }
}

/// √(x² + y²) of what is neither as great nor as small as the exponents reach.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// The unit vector at half the angle of (cos2·root, sin2·root), the greater axis.
fn half_turn(difference: f64, twice: f64, root: f64) -> Vector2<f64> {
    // Of squares that vanish nothing follows.
    if root < 1e-100 {
        return Vector2::new(1.0, 0.0);
    }
    // Of the two forms the one without cancellation.
    let (x, y) = if difference >= 0.0 {
        (root + difference, twice)
    } else {
        (twice.abs(), (root - difference).copysign(twice))
    };
    let length = length(x, y);
    Vector2::new(x / length, y / length)
}

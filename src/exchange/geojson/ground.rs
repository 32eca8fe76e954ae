//! Which unit the coordinates of a file count in, and the way from them to centimetres on a plan.
//!
//! The standard says degrees; files of drawing programs say metres, centimetres or millimetres and tell it in no
//! member that all agree on. So: what the file says outright, else degrees when the whole lies within their range
//! and is no larger than a town, else by the size of a room.

use crate::outline;
use crate::units::{Bilingual, Piece, Point, said, word};

use super::feature::{Position, Surroundings};

/// Degrees that a building or campus may span: eleven kilometres.
const LARGEST_SPAN: f64 = 0.1;
/// Plans whose corners lie farther out than this, in cm, are brought to the origin.
const FAR: f64 = 1e6;
/// WGS 84: equatorial radius in cm, and the square of the eccentricity.
const RADIUS: f64 = 637_813_700.0;
const ECCENTRICITY2: f64 = 0.006_694_379_990_14;

/// The way from a file's coordinates to cm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Ground {
    /// Tangent plane at a longitude and latitude.
    Degrees { lon: f64, lat: f64 },
    /// `(p - origin) * scale`
    Plane { scale: f64, origin: Position },
}

impl Ground {
    /// Judges by what the file says and by its polygons. The second value tells the person what was assumed.
    pub(super) fn of(
        around: &Surroundings,
        is_imdf: bool,
        all: impl Iterator<Item = Position>,
        mut sizes: Vec<f64>,
    ) -> (Self, Bilingual) {
        let usable = all.filter(|[x, y]| x.abs() < 1e12 && y.abs() < 1e12);
        let mut points: Vec<Point> = usable.map(|[x, y]| Point::new(x, y)).collect();
        let in_range = points.iter().all(|p| p.x.abs() <= 180.0 && p.y.abs() <= 90.0);
        let on_date_line = |p: &Point| p.x.abs() > 179.0;
        if in_range && points.iter().all(on_date_line) {
            points.iter_mut().filter(|p| p.x < 0.0).for_each(|p| p.x += 360.0);
        }
        if points.is_empty() {
            return (
                Self::Plane { scale: 100.0, origin: [0.0, 0.0] },
                said!("there-are-no-coordinates"),
            );
        }
        let (low, high) = outline::bounds(&points);
        let span = (high - low).amax();
        let crs = around.crs.to_uppercase();
        let is_mercator = crs.contains("3857") || crs.contains("900913");
        let says_degrees = crs.contains("CRS84") || crs.contains("4326");
        let plane = |scale: f64, unit: Piece| {
            let far = low.coords.amax().max(high.coords.amax()) * scale > FAR;
            let origin = if far { [low.x.floor(), low.y.floor()] } else { [0.0, 0.0] };
            let [x, y] = origin;
            let told = match far {
                true => said!("coordinates-moved", unit, x, y),
                false => said!("coordinates", unit),
            };
            (Self::Plane { scale, origin }, told)
        };
        if let Some((scale, says)) = unit(&around.units) {
            return plane(scale, says);
        }
        if is_imdf || says_degrees || (crs.is_empty() && in_range && span <= LARGEST_SPAN) {
            let middle = low + (high - low) / 2.0;
            let (lon, lat) = (middle.x, middle.y.clamp(-89.0, 89.0));
            let says = said!(
                "the-coordinates-are-degrees-the",
                lon = format!("{lon:.7}"),
                lat = format!("{lat:.7}")
            );
            return (Self::Degrees { lon, lat }, says);
        }
        if is_mercator && low.coords.amax().max(high.coords.amax()) > 1e5 {
            // Mercator stretches by 1/cos of the latitude.
            let lat = 2.0 * ((low.y + high.y) / 2.0 / 6_378_137.0).exp().atan()
                - std::f64::consts::FRAC_PI_2;
            return plane(100.0 * lat.cos(), word!("metres-of-mercator-s-projection"));
        }
        sizes.sort_by(f64::total_cmp);
        let room = sizes.get(sizes.len() / 2).copied().unwrap_or(5.0);
        if is_mercator || room < 100.0 {
            plane(100.0, word!("metres"))
        } else if room < 2000.0 {
            plane(1.0, word!("centimetres-by-the-size-of"))
        } else {
            plane(0.1, word!("millimetres-by-the-size-of"))
        }
    }

    /// A position of the file on the plan, in cm.
    pub(super) fn place(&self, [x, y]: Position) -> Point {
        match *self {
            Self::Plane { scale, origin } => {
                Point::new((x - origin[0]) * scale, (y - origin[1]) * scale)
            }
            Self::Degrees { lon, lat } => {
                let sin2 = lat.to_radians().sin().powi(2);
                let w = (1.0 - ECCENTRICITY2 * sin2).sqrt();
                let across = RADIUS / w * lat.to_radians().cos();
                let along = RADIUS * (1.0 - ECCENTRICITY2) / w.powi(3);
                // A building on the date line has longitudes on both ends of the scale.
                let mut turn = (x - lon) % 360.0;
                if turn.abs() > 180.0 {
                    turn -= 360.0 * turn.signum();
                }
                Point::new(turn.to_radians() * across, (y - lat).to_radians() * along)
            }
        }
    }
}

fn unit(word: &str) -> Option<(f64, Piece)> {
    match word.trim().to_lowercase().as_str() {
        "m" | "metre" | "metres" | "meter" | "meters" => Some((100.0, word!("metres"))),
        "cm" => Some((1.0, word!("centimetres"))),
        "mm" => Some((0.1, word!("millimetres"))),
        "ft" | "feet" => Some((30.48, word!("feet"))),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(points: &[Position], sizes: &[f64]) -> Ground {
        Ground::of(&Surroundings::default(), false, points.iter().copied(), sizes.to_vec()).0
    }

    #[test]
    fn a_degree_is_as_long_as_the_ellipsoid_says() {
        // One thousandth of a degree at 60° north: 55.80 m to the east, 111.41 m to the north.
        let ground = of(&[[30.0, 60.0], [30.002, 60.002]], &[0.0001]);
        let (a, b) = (ground.place([30.0, 60.0]), ground.place([30.001, 60.001]));
        assert!(((b - a).x - 5580.1).abs() < 1.0, "{}", (b - a).x);
        assert!(((b - a).y - 11141.5).abs() < 1.0, "{}", (b - a).y);
    }

    #[test]
    fn the_size_of_a_room_tells_metres_from_millimetres() {
        let far = [[0.0, 0.0], [40_000.0, 30_000.0]];
        assert_eq!(of(&far, &[5000.0]), Ground::Plane { scale: 0.1, origin: [0.0, 0.0] });
        assert_eq!(of(&far, &[500.0]), Ground::Plane { scale: 1.0, origin: [0.0, 0.0] });
        assert_eq!(
            of(&[[0.0, 0.0], [40.0, 30.0]], &[5.0]),
            Ground::Plane { scale: 100.0, origin: [0.0, 0.0] }
        );
    }

    #[test]
    fn a_building_on_the_date_line_stays_whole() {
        let ground = Ground::Degrees { lon: 180.0, lat: 0.0 };
        let width = ground.place([-179.9999, 0.0]) - ground.place([179.9999, 0.0]);
        assert!((width.x - 2226.4).abs() < 1.0, "{}", width.x);
    }
}

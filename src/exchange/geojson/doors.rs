//! Doors and windows: a line from jamb to jamb, a leaf as a thin polygon, or a point to be set into the nearest wall.

use crate::geometry::nearest_on_segment;
use crate::map::{DoorKind, DoorStatus};
use crate::units::{Bilingual, Cm, Point, said};
use crate::{Opening, OpeningKind, ReadError, outline};

use super::classify::Class;
use super::feature::{FORMAT, Feature, Shape};
use super::{Reader, properties};

/// Of a door that is a point without a width.
const USUAL_WIDTH: f64 = 90.0;
/// A door farther from every wall than this stands in none.
const FARTHEST: f64 = 100.0;
const NARROWEST: f64 = 20.0;
/// Doors given as points, times rooms: what is looked through to find their walls.
const MOST_PAIRS: usize = 2_000_000_000;

impl Reader {
    pub(super) fn doors(
        &mut self,
        features: &[Feature],
        classes: &[Class],
    ) -> Result<(), ReadError> {
        let is_opening = |c: &Class| matches!(c, Class::Door | Class::Passage | Class::Window);
        let doors = || features.iter().zip(classes).filter(|(_, c)| is_opening(c));
        let points = doors().filter(|(f, _)| matches!(f.shape, Some(Shape::Points(_)))).count();
        let rooms = self.survey.levels.iter().map(|l| l.rooms.len()).max().unwrap_or(0);
        if points.saturating_mul(rooms) > MOST_PAIRS {
            let limit = MOST_PAIRS;
            return Err(ReadError::TooMany {
                format: FORMAT,
                what: said!("pairs-of-door-and-room"),
                limit,
            });
        }
        let bounds: Vec<Vec<(Point, Point)>> = self
            .survey
            .levels
            .iter()
            .map(|level| level.rooms.iter().map(|room| outline::bounds(&room.outline)).collect())
            .collect();
        for (feature, class) in doors() {
            for level in self.levels.of_feature(feature) {
                match self.jambs(feature, level, &bounds[level]) {
                    Ok(jambs) => {
                        let opening = opening(feature, class, jambs, self.tongue.name(feature));
                        self.survey.levels[level].openings.push(opening);
                    }
                    Err(why) => self.remark(&feature.id, said!("door-left-out", why)),
                }
            }
        }
        Ok(())
    }

    fn jambs(
        &self,
        feature: &Feature,
        level: usize,
        bounds: &[(Point, Point)],
    ) -> Result<[Point; 2], Bilingual> {
        let sound = |jambs: [Point; 2]| {
            let fit = jambs.iter().all(|p| Cm::new(p.x).is_ok() && Cm::new(p.y).is_ok());
            if !fit {
                Err(said!("its-coordinates-are-no-numbers"))
            } else if (jambs[1] - jambs[0]).norm() < NARROWEST {
                Err(said!("door-too-narrow", least = NARROWEST))
            } else {
                Ok(jambs)
            }
        };
        match &feature.shape {
            Some(Shape::Lines(lines)) => {
                let ends = lines.first().and_then(|l| l.first().copied().zip(l.last().copied()));
                let (a, b) = ends.ok_or_else(|| said!("the-line-has-no-points"))?;
                sound([self.ground.place(a), self.ground.place(b)])
            }
            Some(Shape::Polygons(polygons)) => {
                let ring = polygons
                    .first()
                    .and_then(|p| p.first())
                    .ok_or_else(|| said!("the-outline-has-no-points"))?;
                let ring = outline::ring(self.points(ring))
                    .ok_or_else(|| said!("the-outline-has-no-area"))?;
                sound(outline::long_axis(&ring).ok_or_else(|| said!("the-outline-has-no-area"))?)
            }
            Some(Shape::Points(points)) => {
                let at =
                    self.ground.place(*points.first().ok_or_else(|| said!("it-has-no-place"))?);
                sound(
                    self.in_wall(feature, at, level, bounds)
                        .ok_or_else(|| said!("no-wall-of-a-room"))?,
                )
            }
            None => Err(said!("it-has-no-place")),
        }
    }

    /// Jambs in the nearest wall of the storey's rooms, around the wall's point nearest to `at`.
    fn in_wall(
        &self,
        feature: &Feature,
        at: Point,
        level: usize,
        bounds: &[(Point, Point)],
    ) -> Option<[Point; 2]> {
        let near = |(low, high): &(Point, Point)| {
            let within = |x: f64, l: f64, h: f64| (l - FARTHEST..=h + FARTHEST).contains(&x);
            within(at.x, low.x, high.x) && within(at.y, low.y, high.y)
        };
        let rooms = self.survey.levels[level].rooms.iter().zip(bounds);
        let walls = rooms.filter(|(_, b)| near(b)).flat_map(|(r, _)| outline::edges(&r.outline));
        let distance = |(a, b): &(Point, Point)| (nearest_on_segment(at, *a, *b) - at).norm();
        let (a, b) = walls.min_by(|x, y| distance(x).total_cmp(&distance(y)))?;
        if distance(&(a, b)) > FARTHEST {
            return None;
        }
        let wall = (b - a).norm();
        let width = width(feature).unwrap_or(USUAL_WIDTH).min(wall);
        let along = (b - a) / wall;
        let middle =
            (nearest_on_segment(at, a, b) - a).norm().clamp(width / 2.0, wall - width / 2.0);
        Some([a + along * (middle - width / 2.0), a + along * (middle + width / 2.0)])
    }
}

/// In cm; the file's metres, or what looks like centimetres or millimetres.
fn width(feature: &Feature) -> Option<f64> {
    let width = feature.number(&["width", "door:width", "door_width", "ширина"])?;
    match width {
        w if w < 0.2 => None,
        w if w < 12.0 => Some(w * 100.0),
        w if w < 500.0 => Some(w),
        w if w < 5000.0 => Some(w / 10.0),
        _ => None,
    }
}

fn opening(feature: &Feature, class: &Class, jambs: [Point; 2], name: Option<String>) -> Opening {
    let metres = |keys: &[&str]| {
        let m = feature.number(keys).filter(|h| (0.0..=20.0).contains(h));
        m.map(|m| Cm::of(m * 100.0))
    };
    let is_window = *class == Class::Window;
    Opening {
        source: feature.id.clone(),
        name: name.unwrap_or_default(),
        what: if is_window { OpeningKind::Window } else { kind(feature, class) },
        jambs,
        rooms: None,
        height: metres(&["height", "door:height"]),
        sill: metres(&["sill", "sill_height", "window:sill"]).unwrap_or(Cm::ZERO),
        properties: properties(feature),
    }
}

/// How a door moves: IMDF's `door.type`, OpenStreetMap's `door=sliding`, a plain field.
fn kind(feature: &Feature, class: &Class) -> OpeningKind {
    let imdf = feature.properties.get("door");
    let imdf_type = imdf.and_then(|d| d.get("type")?.as_str());
    let is_imdf = !feature.feature_type.is_empty();
    // An IMDF opening without a door is a hole in a wall.
    if *class == Class::Passage || (is_imdf && imdf.is_none_or(serde_json::Value::is_null)) {
        return OpeningKind::Passage;
    }
    let word = imdf_type.map(str::to_owned).or_else(|| {
        let word = feature.first(&["door", "door_type", "operation", "тип_двери"]);
        word.map(|w| w.to_lowercase())
    });
    let kind = match word.as_deref() {
        Some("open" | "no" | "turnstile" | "turnstile.fullheight" | "turnstile.waistheight") => {
            return OpeningKind::Passage;
        }
        Some("sliding" | "movablepartition" | "folding" | "раздвижная" | "сдвижная") => {
            DoorKind::Sliding
        }
        _ => DoorKind::Hinged,
    };
    let state = feature.first(&["status", "state", "состояние"]).map(|s| s.to_lowercase());
    let (status, opening) = match state.as_deref() {
        Some("open" | "opened" | "открыта") => (DoorStatus::Open, 100.0),
        Some("locked" | "заперта") => (DoorStatus::Locked, 0.0),
        _ if feature.text("locked").is_some_and(|l| l == "yes") => (DoorStatus::Locked, 0.0),
        _ => (DoorStatus::Closed, 0.0),
    };
    OpeningKind::Door { kind, leaves: Vec::new(), opens: None, status, opening }
}

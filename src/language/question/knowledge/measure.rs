//! Places, distances and sizes. Lengths in cm, in the frame of the Map.
//!
//! Invariant: things on different Maps have no distance.

use super::Knowledge;
use crate::map::{Entity, Extent};
use crate::question::query::{Extreme, Thing};
use crate::question::values::Property;
use crate::report::Detail;
use crate::units::{AreaId, MapId, Point, Vector};

/// Distances of several things, all measured in one manner, in cm.
pub(in crate::question) struct HowFar {
    /// Along the ways that the robot drives; else straight.
    pub(in crate::question) by_way: bool,
    pub(in crate::question) each: Vec<f64>,
}

impl Knowledge<'_> {
    /// The room in which a thing is.
    pub(in crate::question) fn area_of(&self, thing: Thing) -> Option<AreaId> {
        match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.area_of(id),
            Thing::Entity(Entity::Area(id)) => Some(id),
            Thing::Entity(Entity::Place(id)) => self.world.places.get(&id).map(|p| p.area),
            Thing::Entity(Entity::Door(_)) | Thing::Opening(_) => {
                self.opening(thing).and_then(|g| g.areas.first().copied())
            }
            Thing::Window(n) => Some(self.lexicon().windows[n as usize].area),
            Thing::Robot => {
                let (map, pose) = self.senses.robot()?;
                self.relations.measurements().area_at(map, pose.at)
            }
            Thing::Entity(Entity::Zone(id)) => match &self.world.zones.get(&id)?.extent {
                Extent::Areas(areas) => areas.first().copied(),
                Extent::Polygon { .. } => {
                    let (map, at) = self.point(thing)?;
                    self.relations.measurements().area_at(map, at)
                }
            },
            Thing::Entity(Entity::Map(_)) => None,
        }
    }

    /// Where a thing is on its Map.
    pub(in crate::question) fn point(&self, thing: Thing) -> Option<(MapId, Point)> {
        match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.centre(id),
            Thing::Entity(Entity::Area(id)) => self.relations.area_centre(id),
            Thing::Entity(Entity::Place(id)) => {
                let place = self.world.places.get(&id)?;
                let (map, frame) = self.world.placement(place.area)?;
                Some((map, frame.apply(place.at)))
            }
            Thing::Entity(Entity::Door(_)) | Thing::Opening(_) => {
                let gate = self.opening(thing)?;
                let (map, _) = self.world.placement(*gate.areas.first()?)?;
                let ends = self.ends_of(gate)?;
                Some((map, nalgebra::center(&ends.0, &ends.1)))
            }
            Thing::Window(n) => {
                let window = &self.lexicon().windows[n as usize];
                let (map, _) = self.world.placement(window.area)?;
                Some((map, nalgebra::center(&window.ends.0, &window.ends.1)))
            }
            Thing::Robot => self.senses.robot().map(|(map, pose)| (map, pose.at)),
            Thing::Entity(Entity::Zone(id)) => match &self.world.zones.get(&id)?.extent {
                Extent::Areas(areas) => self.relations.area_centre(*areas.first()?),
                Extent::Polygon { map, corners } => {
                    let sum = corners.iter().fold(Vector::zeros(), |sum, p| sum + p.coords);
                    Some((*map, Point::from(sum / corners.len() as f64)))
                }
            },
            Thing::Entity(Entity::Map(_)) => None,
        }
    }

    /// Straight distance between two things of one Map, cm: between surfaces, where both have any.
    pub(in crate::question) fn distance(&self, a: Thing, b: Thing) -> Option<f64> {
        let segment = |t: Thing| match t {
            Thing::Window(n) => Some(self.lexicon().windows[n as usize].ends),
            _ => self.ends_of(self.opening(t)?),
        };
        match (a, b) {
            (Thing::Entity(Entity::Replica(x)), Thing::Entity(Entity::Replica(y))) => {
                self.relations.distance(x, y)
            }
            (Thing::Entity(Entity::Replica(x)), Thing::Entity(Entity::Area(y)))
            | (Thing::Entity(Entity::Area(y)), Thing::Entity(Entity::Replica(x))) => {
                self.relations.distance_to_area(x, y)
            }
            (Thing::Entity(Entity::Replica(x)), other)
            | (other, Thing::Entity(Entity::Replica(x))) => match segment(other) {
                Some(ends) => {
                    let (map, _) = self.point(other)?;
                    let own = self.relations.centre(x).map(|(m, _)| m);
                    (own == Some(map))
                        .then(|| self.relations.distance_to_segment(x, ends))
                        .flatten()
                }
                None => {
                    let (map, at) = self.point(other)?;
                    self.relations.distance_to_point(x, map, at)
                }
            },
            _ => {
                let ((m, p), (n, q)) = (self.point(a)?, self.point(b)?);
                (m == n).then(|| (p - q).norm())
            }
        }
    }

    /// Between what of two things [`Self::distance`] is measured.
    pub(in crate::question) fn between_what(&self, a: Thing, b: Thing) -> &'static str {
        let has_edge = |t: Thing| t.replica().is_some();
        let is_opening = |t: Thing| matches!(t, Thing::Window(_)) || self.opening(t).is_some();
        let of_middle = |t: Thing| t.area().is_some() || is_opening(t);
        match (has_edge(a), has_edge(b)) {
            (true, true) => self.pick(" между ближайшими краями", " between the nearest edges"),
            (true, false) | (false, true) if is_opening(a) || is_opening(b) => {
                self.pick(" между ближайшими краями", " between the nearest edges")
            }
            (true, false) | (false, true) => {
                self.pick(" до ближайшего края", " to the nearest edge")
            }
            (false, false) if of_middle(a) || of_middle(b) => {
                self.pick(" между серединами", " between the middles")
            }
            (false, false) => "",
        }
    }

    /// How far it is from one thing to each of several: by the ways that are driven, where all of them are rooms and places
    /// to go to and there is a way to each; else straight. None where one has no distance.
    pub(in crate::question) fn how_far(&self, from: Thing, to: &[Thing]) -> Option<HowFar> {
        let driven = || to.iter().map(|t| self.driven(from, *t)).collect::<Option<Vec<f64>>>();
        let by_way = to.iter().all(|t| t.is_gone_to()).then(driven).flatten();
        if let Some(each) = by_way {
            return Some(HowFar { by_way: true, each });
        }
        let straight = to.iter().map(|t| self.distance(*t, from)).collect::<Option<Vec<f64>>>();
        straight.map(|each| HowFar { by_way: false, each })
    }

    /// How far the robot drives from one thing to another, cm; none where there is no way.
    pub(in crate::question) fn driven(&self, from: Thing, to: Thing) -> Option<f64> {
        let start = Some(from).filter(|start| *start != Thing::Robot);
        self.senses.way(start, to, self.language, Detail::Region).ok().map(|way| way.length)
    }

    /// «Выше всех» by their place; by their size, where all begin equally high or have no such measure.
    pub(in crate::question) fn by_place_or_size(
        &self,
        extreme: Extreme,
        things: &[Thing],
    ) -> Extreme {
        let equal = self.relations.thresholds().level_equal;
        if extreme == extreme.of_size() {
            return extreme;
        }
        let feet: Option<Vec<f64>> = things.iter().map(|t| self.measure(extreme, *t)).collect();
        let feet = feet.unwrap_or_default();
        let apart = feet.iter().any(|foot| (foot - feet[0]).abs() > equal);
        if apart { extreme } else { extreme.of_size() }
    }

    /// What a superlative compares of a thing; more is more of it.
    pub(in crate::question) fn measure(&self, extreme: Extreme, thing: Thing) -> Option<f64> {
        if matches!(extreme, Extreme::Heaviest | Extreme::Lightest) {
            let told = self.values(thing).into_iter().find(|(p, _, _)| *p == Property::Weight)?;
            return kilograms(&told.2);
        }
        if let Thing::Entity(Entity::Map(map)) = thing {
            let placed = self.world.domain.maps.iter().find(|m| m.map == map)?;
            return extreme.is_level().then_some(placed.frame.z.get());
        }
        let extent = match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.extent(id)?,
            Thing::Entity(Entity::Area(id)) => self.relations.area_extent(id)?,
            _ => {
                let ends = match thing {
                    Thing::Window(n) => self.lexicon().windows[n as usize].ends,
                    _ => self.ends_of(self.opening(thing)?)?,
                };
                let width = (ends.1 - ends.0).norm();
                return matches!(
                    extreme,
                    Extreme::Widest | Extreme::Narrowest | Extreme::Biggest | Extreme::Smallest
                )
                .then_some(width);
            }
        };
        let is_area = thing.area().is_some();
        Some(match extreme {
            Extreme::Biggest | Extreme::Smallest if is_area => extent.base,
            Extreme::Biggest | Extreme::Smallest => extent.base * extent.height,
            Extreme::Tallest | Extreme::Lowest => extent.height,
            // The width that "how wide" is answered with, which need not be the longer side.
            Extreme::Widest | Extreme::Narrowest => extent.width,
            Extreme::Longest | Extreme::Shortest => extent.width.max(extent.depth),
            Extreme::Topmost | Extreme::Bottommost | Extreme::Midmost if !is_area => extent.bottom,
            Extreme::Thickest | Extreme::Thinnest if !is_area => {
                extent.width.min(extent.depth).min(extent.height)
            }
            _ => return None,
        })
    }
}

/// A weight as maps write it: «12 кг», "800 g"; a bare number is of kilograms.
fn kilograms(text: &str) -> Option<f64> {
    let text = text.trim().replace(',', ".");
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let number: f64 = text[..end].parse().ok()?;
    Some(match text[end..].trim().to_lowercase().as_str() {
        "г" | "гр" | "g" => number / 1000.0,
        "т" | "t" => number * 1000.0,
        "" | "кг" | "kg" => number,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_read_with_their_units() {
        assert_eq!(kilograms("12 кг"), Some(12.0));
        assert_eq!(kilograms("0,5"), Some(0.5));
        assert_eq!(kilograms("800 g"), Some(0.8));
        assert_eq!(kilograms("a lot"), None);
        assert_eq!(kilograms("3 мешка"), None);
    }
}

//! Doors, windows and openings without either.
//!
//! A door's placement has X along the wall and Y the way its leaves swing (IfcDoor, IfcDoorTypeOperationEnum):
//!
//! ```text
//!        ↑ y, the leaves swing this way
//!   -----|========|-----→ x     hinges of SINGLE_SWING_LEFT at the left end of `=`
//!        the first room, from which left and right are told
//! ```

use std::collections::{HashMap, HashSet};

use nalgebra::{Point3, Vector3};

use crate::map::{DoorKind, DoorLeaf, DoorStatus, HingeSide, OpensTo, Properties};
use crate::units::{Cm, Point, Vector, said, word};
use crate::{Opening, OpeningKind, Treatment, What};

use super::body::Body;
use super::building::{Reader, source};
use super::classes::Becomes;
use super::place::Place;
use super::shape::Else;
use super::step::Instance;

/// Widths that a door or window may have, in cm.
const WIDTHS: std::ops::RangeInclusive<f64> = 20.0..=2000.0;
/// How far from a door's middle, in cm, the rooms are looked for: past thick walls.
const STEPS: [f64; 6] = [5.0, 15.0, 30.0, 45.0, 60.0, 90.0];
/// An opening without a door lets people through when it is as high, as wide and as low as this, in cm.
pub(super) const PASSAGE: (f64, f64, f64) = (180.0, 55.0, 10.0);
const LEAF_THICKNESS: f64 = 4.0;
/// Openings of one file.
const MOST_OPENINGS: usize = 200_000;

/// Where an opening is in its wall.
struct Hole {
    /// Ends along the wall, at the local X from low to high, in cm.
    ends: [Point; 2],
    /// Across the wall, the local Y.
    across: Vector,
    /// In cm above the building's zero.
    bottom: f64,
    height: Option<f64>,
}

impl Reader<'_> {
    pub(super) fn doors(&mut self) {
        let boundaries = self.boundaries();
        let all = self.all;
        let fillings = || all.all("IFCRELFILLSELEMENT").map(|(_, r)| (r.at(4), r.at(5)));
        let filled: HashSet<u32> = fillings().filter_map(|(hole, _)| hole.reference()).collect();
        let holes: HashMap<u32, u32> = fillings()
            .filter_map(|(hole, by)| Some((by.reference()?, hole.reference()?)))
            .collect();
        let mut every: Vec<(u32, &Instance, What)> = Vec::new();
        for (becomes, what) in [(Becomes::Door, What::Door), (Becomes::Window, What::Window)] {
            every.extend(self.elements(becomes).into_iter().map(|(id, r)| (id, r, what)));
        }
        let empty = self.elements(Becomes::Opening).into_iter();
        let empty = empty.filter(|(id, _)| !filled.contains(id));
        every.extend(empty.map(|(id, r)| (id, r, What::Passage)));
        let none = HashSet::new();
        let (mut others, mut passed) = (0_usize, 0_usize);
        for (no, (id, record, what)) in every.into_iter().enumerate() {
            let is_hole = what == What::Passage;
            if no >= MOST_OPENINGS {
                passed += 1;
                continue;
            }
            // A door that tells neither body nor width is as large as the hole that it fills.
            let filled = holes.get(&id).and_then(|hole| all.get(*hole));
            let found = self.hole(record, is_hole).or_else(|| self.hole(filled?, true));
            let Some(hole) = found else {
                if is_hole {
                    others += 1;
                } else {
                    let text = word!("place-or-width-is-not");
                    self.lose(what, &source(record, id), text);
                }
                continue;
            };
            let level = self.level_of(id, hole.bottom);
            let floor = self.survey.levels[level].elevation.get();
            if is_hole && !is_passage(&hole, floor) {
                others += 1;
                continue;
            }
            let near = boundaries.get(&id).unwrap_or(&none);
            let sides = self.sides(&hole, level, near);
            let opening = self.opening(id, record, what, &hole, floor, sides);
            // A hole in a wall that joins nothing is for pipes.
            let joins = sides.iter().all(Option::is_some) && sides[0] != sides[1];
            if is_hole && !joins {
                others += 1;
            } else {
                self.survey.levels[level].openings.push(opening);
            }
        }
        if others > 0 {
            let text = said!("empty-openings-that-cannot-be", others);
            self.tell((Treatment::Noted, What::Record), (others, 0), "IFCOPENINGELEMENT", text);
        }
        if passed > 0 {
            let text = said!("beyond-are-left-out", passed, limit = MOST_OPENINGS);
            self.tell((Treatment::Skipped, What::Record), (passed, 0), "IFCDOOR", text);
        }
    }

    /// Element → the spaces whose boundary it is.
    fn boundaries(&self) -> HashMap<u32, HashSet<u32>> {
        let mut found = HashMap::<u32, HashSet<u32>>::new();
        for (space, element, _) in self.space_boundaries() {
            if let Some(element) = element {
                found.entry(element).or_default().insert(space);
            }
        }
        found
    }

    /// The hole that a door, window or opening makes: its overall width at the middle of its body, else the body's,
    /// else from its placement's origin along X.
    fn hole(&mut self, record: &Instance, is_opening: bool) -> Option<Hole> {
        let mut place = self.place_of(record);
        let (bodies, _) = self.shapes.of_product(record.at(6), &place, Else::Box);
        let mut body = Extent::of(&bodies, &place);
        // An opening's placement may have either axis along the wall; it is cut where it is wider.
        if is_opening && body.as_ref().is_some_and(|b| b.y.1 - b.y.0 > b.x.1 - b.x.0) {
            place = Place { x: place.y, y: -place.x, ..place };
            body = Extent::of(&bodies, &place);
        }
        let unit = place.z.norm();
        let measure = |index: usize| {
            let told = record.at(index).number().filter(|_| !is_opening)? * unit;
            Some(told).filter(|w| WIDTHS.contains(w))
        };
        let (told_height, told_width) = (measure(8), measure(9));
        let (low, high) = match (&body, told_width) {
            (Some(b), None) => (b.x.0, b.x.1),
            (Some(b), Some(w)) => {
                let middle = b.x.0.midpoint(b.x.1);
                (middle - w / 2.0, middle + w / 2.0)
            }
            (None, Some(w)) => (0.0, w),
            (None, None) => return None,
        };
        let y = body.as_ref().map_or(0.0, |b| b.y.0.midpoint(b.y.1));
        let (along, across) = (flat(place.x)?, flat(place.y)?);
        let origin = Point::new(place.origin.x, place.origin.y);
        let ends = [low, high].map(|x| origin + along * x + across * y);
        let sound = ends.iter().all(|p| Cm::new(p.x).is_ok() && Cm::new(p.y).is_ok());
        let bottom = body.as_ref().map_or(place.origin.z, |b| b.z.0);
        let height = told_height.or(body.as_ref().map(|b| b.z.1 - b.z.0));
        (sound && WIDTHS.contains(&(ends[1] - ends[0]).norm())).then_some(Hole {
            ends,
            across,
            bottom,
            height,
        })
    }

    /// The rooms on the near side (against Y) and on the far side.
    fn sides(&mut self, hole: &Hole, level: usize, near: &HashSet<u32>) -> [Option<usize>; 2] {
        let known: HashSet<usize> = near
            .iter()
            .filter_map(|space| self.rooms.get(space))
            .filter(|(l, _)| *l == level)
            .map(|(_, room)| *room)
            .collect();
        let middle = hole.ends[0] + (hole.ends[1] - hole.ends[0]) / 2.0;
        [-1.0, 1.0].map(|way| {
            STEPS.iter().find_map(|step| {
                let rooms = self.rooms_at(level, middle + hole.across * (way * step));
                let bounded = rooms.iter().find(|r| known.contains(r));
                bounded.or(rooms.first()).copied()
            })
        })
    }

    fn opening(
        &self,
        id: u32,
        record: &Instance,
        what: What,
        hole: &Hole,
        floor: f64,
        [near, far]: [Option<usize>; 2],
    ) -> Opening {
        let operation = (what == What::Door).then(|| self.operation(id, record)).flatten();
        let mut properties = Properties::new();
        properties.extend(operation.clone().map(|o| ("ifc:OperationType".to_owned(), o)));
        // Seen from the near side, looking along Y, the end with the larger X is on the right.
        let (mut jambs, mut rooms) = ([hole.ends[1], hole.ends[0]], [near, far]);
        let is_window = what == What::Window;
        let mut what = match what {
            What::Door => door(operation.as_deref()),
            What::Window => OpeningKind::Window,
            _ => OpeningKind::Passage,
        };
        if near.is_none() && far.is_some() {
            // The first room is one that there is: the same door, told from its other side.
            (jambs, rooms) = ([hole.ends[0], hole.ends[1]], [far, near]);
            if let OpeningKind::Door { leaves, opens, .. } = &mut what {
                leaves.reverse();
                for leaf in leaves {
                    leaf.hinge = other_side(leaf.hinge);
                }
                *opens = opens.map(|_| OpensTo::Inside);
            }
        }
        Opening {
            source: source(record, id),
            name: record.at(2).text().unwrap_or_default().chars().take(200).collect(),
            what,
            jambs,
            rooms: rooms[0].map(|_| rooms).filter(|[a, b]| a != b),
            height: hole.height.and_then(|h| Cm::new(h).ok()),
            sill: Cm::new(hole.bottom - floor)
                .ok()
                .filter(|s| is_window && s.get() > 0.0)
                .unwrap_or(Cm::ZERO),
            properties,
        }
    }

    /// IFC4 tells it of the door or of its type, IFC2x3 of its style.
    fn operation(&self, id: u32, door: &Instance) -> Option<String> {
        let own = door.at(11).word();
        let of_type = self.type_of(id).and_then(|t| match t.kind {
            "IFCDOORSTYLE" => t.at(8).word(),
            "IFCDOORTYPE" => t.at(10).word(),
            _ => None,
        });
        let said = |w: &&str| *w != "NOTDEFINED";
        own.filter(said).or(of_type.filter(said)).map(str::to_owned)
    }
}

fn is_passage(hole: &Hole, floor: f64) -> bool {
    let (height, width, above) = PASSAGE;
    hole.height.is_some_and(|h| h >= height)
        && (hole.ends[1] - hole.ends[0]).norm() >= width
        && (hole.bottom - floor).abs() <= above
}

fn other_side(side: HingeSide) -> HingeSide {
    match side {
        HingeSide::Right => HingeSide::Left,
        HingeSide::Left => HingeSide::Right,
    }
}

/// How the leaves of an operation type move, seen from the near side.
fn door(operation: Option<&str>) -> OpeningKind {
    use HingeSide::{Left, Right};
    let operation = operation.unwrap_or_default();
    let leaf = |hinge, share, max_open| DoorLeaf {
        hinge,
        share,
        thickness: Cm::of(LEAF_THICKNESS),
        max_open,
    };
    let is_sliding =
        ["SLIDING", "FOLDING", "ROLLINGUP", "LIFTING"].iter().any(|w| operation.contains(w));
    let (kind, most) =
        if is_sliding { (DoorKind::Sliding, 100.0) } else { (DoorKind::Hinged, 90.0) };
    let leaves = match operation {
        o if o.starts_with("DOUBLE_DOOR") => vec![leaf(Right, 0.5, most), leaf(Left, 0.5, most)],
        o if o.ends_with("LEFT") => vec![leaf(Left, 1.0, most)],
        o if o.ends_with("RIGHT") => vec![leaf(Right, 1.0, most)],
        // Revolving doors, shutters and what a user defined: how is not told.
        _ if is_sliding => vec![leaf(Right, 1.0, most)],
        _ => Vec::new(),
    };
    let opens = (!leaves.is_empty()).then_some(OpensTo::Outside);
    // A model of a building tells how a door is hung, never how it stands.
    OpeningKind::Door { kind, leaves, opens, status: DoorStatus::Open, opening: 100.0 }
}

/// A direction on the plan.
fn flat(axis: Vector3<f64>) -> Option<Vector> {
    Vector::new(axis.x, axis.y).try_normalize(1e-9)
}

/// What some bodies take up along the axes of a frame, in cm.
struct Extent {
    x: (f64, f64),
    y: (f64, f64),
    z: (f64, f64),
}

impl Extent {
    fn of(bodies: &[Body], place: &Place) -> Option<Self> {
        let wide = |axis: Vector3<f64>| {
            let axis = axis.try_normalize(1e-12).unwrap_or_else(Vector3::x);
            let along = |p: &Point3<f64>| (p - place.origin).dot(&axis);
            let corners = bodies.iter().flat_map(Body::corners).map(along);
            corners.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let z = bodies.iter().filter_map(Body::heights);
        let z = z.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
        Some(Self { x: wide(place.x), y: wide(place.y), z })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operation_types_become_leaves_from_right_to_left() {
        let said = |operation: Option<&str>| match door(operation) {
            OpeningKind::Door { kind, leaves, opens, .. } => {
                let hinges: Vec<_> = leaves.iter().map(|l| (l.hinge, l.share)).collect();
                (kind, hinges, opens)
            }
            other => panic!("{other:?}"),
        };
        use HingeSide::{Left, Right};
        let out = Some(OpensTo::Outside);
        assert_eq!(said(Some("SINGLE_SWING_LEFT")), (DoorKind::Hinged, vec![(Left, 1.0)], out));
        assert_eq!(said(Some("SLIDING_TO_RIGHT")), (DoorKind::Sliding, vec![(Right, 1.0)], out));
        let both = vec![(Right, 0.5), (Left, 0.5)];
        assert_eq!(said(Some("DOUBLE_DOOR_SINGLE_SWING")), (DoorKind::Hinged, both, out));
        assert_eq!(said(None), (DoorKind::Hinged, Vec::new(), None));
    }
}

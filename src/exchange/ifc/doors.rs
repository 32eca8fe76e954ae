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

use nalgebra::Point3;

use crate::exchange::{Opening, OpeningKind, Remark, outline};
use crate::map::{DoorKind, DoorLeaf, DoorStatus, HingeSide, OpensTo, Properties};
use crate::units::{Cm, Point, Vector};

use super::building::{Reader, source};
use super::place::Place;
use super::shape::Prism;
use super::step::Instance;

/// Widths that a door or window may have, in cm.
const WIDTHS: std::ops::RangeInclusive<f64> = 20.0..=2000.0;
/// How far from a door's middle, in cm, the rooms are looked for: past thick walls.
const STEPS: [f64; 5] = [15.0, 30.0, 45.0, 60.0, 90.0];
/// An opening without a door lets people through when it is as high, as wide and as low as this, in cm.
const PASSAGE: (f64, f64, f64) = (180.0, 55.0, 10.0);
const LEAF_THICKNESS: f64 = 4.0;
/// Openings of one file, and openings times rooms looked through for their sides.
const MOST_OPENINGS: usize = 200_000;
const MOST_PAIRS: usize = 2_000_000_000;

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
        let filled: HashSet<u32> =
            self.all.all("IFCRELFILLSELEMENT").filter_map(|(_, r)| r.at(4).reference()).collect();
        let doors = ["IFCDOOR", "IFCDOORSTANDARDCASE"].iter().flat_map(|k| self.all.all(k));
        let windows = ["IFCWINDOW", "IFCWINDOWSTANDARDCASE"].iter().flat_map(|k| self.all.all(k));
        let holes = self.all.all("IFCOPENINGELEMENT").filter(|(id, _)| !filled.contains(id));
        let every: Vec<(u32, &Instance)> =
            doors.chain(windows).chain(holes).take(MOST_OPENINGS).collect();
        let rooms = self.survey.levels.iter().map(|l| l.rooms.len()).max().unwrap_or(0);
        let look = every.len().saturating_mul(rooms) <= MOST_PAIRS;
        let none = HashSet::new();
        for (id, record) in every {
            let kind = record.kind.trim_start_matches("IFC").trim_end_matches("STANDARDCASE");
            let Some(hole) = self.hole(record, kind) else {
                if kind != "OPENINGELEMENT" {
                    let text = "место или ширина не указаны, пропущено".to_owned();
                    self.survey.remarks.push(Remark { source: source(record, id), text });
                }
                continue;
            };
            let level = self.level_of(id, hole.bottom);
            let floor = self.survey.levels[level].elevation.get();
            if kind == "OPENINGELEMENT" && !is_passage(&hole, floor) {
                continue;
            }
            let near = boundaries.get(&id).unwrap_or(&none);
            let sides = if look { self.sides(&hole, level, near) } else { [None, None] };
            let opening = self.opening(id, record, kind, &hole, floor, sides);
            // A hole in a wall that joins nothing is for pipes.
            let joins = sides.iter().all(Option::is_some) && sides[0] != sides[1];
            if kind != "OPENINGELEMENT" || joins {
                self.survey.levels[level].openings.push(opening);
            }
        }
    }

    /// Element → the spaces whose boundary it is.
    fn boundaries(&self) -> HashMap<u32, HashSet<u32>> {
        let mut found = HashMap::<u32, HashSet<u32>>::new();
        for kind in
            ["IFCRELSPACEBOUNDARY", "IFCRELSPACEBOUNDARY1STLEVEL", "IFCRELSPACEBOUNDARY2NDLEVEL"]
        {
            for (_, relation) in self.all.all(kind) {
                if let (Some(space), Some(element)) =
                    (relation.at(4).reference(), relation.at(5).reference())
                {
                    found.entry(element).or_default().insert(space);
                }
            }
        }
        found
    }

    /// The hole that a door, window or opening makes: its overall width at the middle of its body, else the body's,
    /// else from its placement's origin along X.
    fn hole(&mut self, record: &Instance, kind: &str) -> Option<Hole> {
        let mut place = self.place_of(record);
        let prisms = self.shapes.of_product(record.at(6), &place);
        let mut body = Extent::of(&prisms, &place);
        let is_opening = kind == "OPENINGELEMENT";
        // An opening's placement may have either axis along the wall; it is cut where it is wider.
        if is_opening && body.as_ref().is_some_and(|b| b.y.1 - b.y.0 > b.x.1 - b.x.0) {
            place = Place { x: place.y, y: -place.x, ..place };
            body = Extent::of(&prisms, &place);
        }
        let measure = |index: usize| {
            let told = record.at(index).number().filter(|_| !is_opening)?;
            Some(told).filter(|w| WIDTHS.contains(&(w * self.scale)))
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
        let end = |x: f64| {
            let p = place.apply(Point3::new(x, y, 0.0));
            self.plan(Point::new(p.x, p.y))
        };
        let ends = [end(low), end(high)];
        let across = Vector::new(place.y.x, place.y.y).try_normalize(1e-9)?;
        let sound = ends.iter().all(|p| Cm::new(p.x).is_ok() && Cm::new(p.y).is_ok());
        let bottom = body.as_ref().map_or(place.origin.z, |b| b.z.0);
        let height = told_height.or(body.as_ref().map(|b| b.z.1 - b.z.0));
        (sound && WIDTHS.contains(&(ends[1] - ends[0]).norm())).then(|| Hole {
            ends,
            across,
            bottom: self.height(bottom),
            height: height.map(|h| h * self.scale),
        })
    }

    /// The rooms on the near side (against Y) and on the far side.
    fn sides(&self, hole: &Hole, level: usize, near: &HashSet<u32>) -> [Option<usize>; 2] {
        let known: Vec<usize> = near
            .iter()
            .filter_map(|space| self.rooms.get(space))
            .filter(|(l, _)| *l == level)
            .map(|(_, room)| *room)
            .collect();
        let rooms = &self.survey.levels[level].rooms;
        let middle = hole.ends[0] + (hole.ends[1] - hole.ends[0]) / 2.0;
        let holds = |room: usize, p: Point| {
            let room = &rooms[room];
            outline::contains(&room.outline, p)
                && !room.holes.iter().any(|h| outline::contains(h, p))
        };
        [-1.0, 1.0].map(|way| {
            STEPS.iter().find_map(|step| {
                let p = middle + hole.across * (way * step);
                let bounded = known.iter().copied().find(|r| holds(*r, p));
                bounded.or_else(|| (0..rooms.len()).find(|r| holds(*r, p)))
            })
        })
    }

    fn opening(
        &self,
        id: u32,
        record: &Instance,
        kind: &str,
        hole: &Hole,
        floor: f64,
        [near, far]: [Option<usize>; 2],
    ) -> Opening {
        let operation = (kind == "DOOR").then(|| self.operation(id, record)).flatten();
        let mut properties = Properties::new();
        properties.extend(operation.clone().map(|o| ("ifc:OperationType".to_owned(), o)));
        // Seen from the near side, looking along Y, the end with the larger X is on the right.
        let (mut jambs, mut rooms) = ([hole.ends[1], hole.ends[0]], [near, far]);
        let mut what = match kind {
            "DOOR" => door(operation.as_deref()),
            "WINDOW" => OpeningKind::Window,
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
                .filter(|s| kind == "WINDOW" && s.get() > 0.0)
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
    OpeningKind::Door { kind, leaves, opens, status: DoorStatus::Closed, opening: 0.0 }
}

/// What some prisms take up along the axes of a frame, in the file's unit.
struct Extent {
    x: (f64, f64),
    y: (f64, f64),
    z: (f64, f64),
}

impl Extent {
    fn of(prisms: &[Prism], place: &Place) -> Option<Self> {
        let wide = |axis: nalgebra::Vector3<f64>| {
            let axis = Vector::new(axis.x, axis.y);
            let origin = Point::new(place.origin.x, place.origin.y);
            let along = prisms.iter().flat_map(|p| &p.outline).map(|p| (p - origin).dot(&axis));
            along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let low = prisms.iter().map(|p| p.bottom).fold(f64::INFINITY, f64::min);
        let high = prisms.iter().map(|p| p.top).fold(f64::NEG_INFINITY, f64::max);
        prisms.first()?;
        Some(Self { x: wide(place.x), y: wide(place.y), z: (low, high) })
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

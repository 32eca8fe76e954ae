//! Passframes (W2; paper 1, section 7): the convex cells of a Fragment's free floor, and what borders them.
//!
//! **Invariant**: the Passframes of a Fragment are convex, do not overlap and together are exactly its free
//! floor. An id follows from the Passframe's place, so that it lasts while the Passframe does.
//!
//! The cells and their ids are made with the floor; what borders them is found when it is first asked for, from
//! what the floor keeps ([`super::edging`]): no way is looked for along it.

use std::collections::HashSet;
use std::fmt;

use crate::map::Permeability;
use crate::units::{AreaId, DoorId, InOrder as _, Language, Point};

use super::blocker::Blocker;
use super::buckets::Buckets;
use super::edging::Face;
use super::floor::FragmentFloor;
use super::mesh::{Mesh, NONE};
use super::{Bounds, Polygon, nearest_on_segment};

/// Unique in its Fragment; said in digits and letters of which none is taken for another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PassframeId(pub u32);

impl fmt::Display for PassframeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SIGNS: [char; 32] = [
            '0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'A', 'B', 'C', 'D', 'E', 'F', 'G',
            'H', 'J', 'K', 'M', 'N', 'P', 'Q', 'R', 'S', 'T', 'V', 'W', 'X', 'Y', 'Z',
        ];
        let signs = (0..7).rev().map(|k| SIGNS[(self.0 >> (5 * k)) as usize % SIGNS.len()]);
        write!(f, "П-{}", signs.collect::<String>())
    }
}

/// The paper's marker-types. Where several would fit, the one named first holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PassframeKind {
    /// «Закрытая зона»: no chain of Passframes that the robot can cross leads from it to a door or passage.
    Closed,
    /// «Граница видимости»: it borders a door or passage, where the Fragment ends and the neighbour begins.
    Boundary,
    /// «Тупик»: the robot can leave it over one border at most.
    DeadEnd,
    /// «Проход»: all others.
    Passage,
}

impl PassframeKind {
    /// The paper's word.
    #[must_use]
    pub fn name(self, language: Language) -> &'static str {
        match self {
            Self::Closed => language.pick("Закрытая зона", "Closed zone"),
            Self::Boundary => language.pick("Граница видимости", "Boundary"),
            Self::DeadEnd => language.pick("Тупик", "Dead end"),
            Self::Passage => language.pick("Проход", "Passage"),
        }
    }
}

/// What lies on the other side of a border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Beyond {
    Passframe(PassframeId),
    /// A door (none for an open passage) into an Area; `doorway` is its number, see [`super::FloorPlan::doorway_at`].
    Doorway {
        doorway: usize,
        door: Option<DoorId>,
        area: AreaId,
    },
    /// A face of something solid; `side` counts the faces of the Orthoframe.
    Face {
        blocker: Blocker,
        side: Option<usize>,
    },
    /// Floor that the robot cannot cover, by its index in [`FragmentFloor::dead_zones`].
    DeadZone(usize),
}

/// One vector of a Passframe.
#[derive(Debug, Clone, PartialEq)]
pub struct Border {
    pub start: Point,
    pub end: Point,
    /// Inherited from the face beyond; what is floor on both sides is permeable.
    pub permeability: Permeability,
    pub beyond: Beyond,
    /// What people call the face: «Парадный вход».
    pub names: Vec<String>,
    /// Where the robot's centre can cross.
    pub crossing: Option<(Point, Point)>,
    /// The cell beyond.
    pub(super) across: u32,
}

/// A convex cell of free floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Passframe {
    pub id: PassframeId,
    pub polygon: Polygon,
    pub kind: PassframeKind,
    /// Border `i` starts at corner `i`.
    pub borders: Vec<Border>,
}

impl Passframe {
    /// The Passframes that the robot can reach from here over one border.
    pub fn neighbours(&self) -> impl Iterator<Item = (PassframeId, (Point, Point))> + '_ {
        self.borders.iter().filter_map(|b| match b.beyond {
            Beyond::Passframe(id) => Some((id, b.crossing?)),
            _ => None,
        })
    }
}

/// Everything that can stand along a border, by place.
struct Faces {
    all: Vec<Face>,
    boxes: Vec<Bounds>,
    buckets: Buckets,
    zones: Buckets,
}

impl Faces {
    fn of(floor: &FragmentFloor) -> Self {
        let all = floor.edging.faces(floor);
        let boxes: Vec<Bounds> =
            all.iter().map(|f| Bounds::of([f.start, f.end]).grown(TOUCH)).collect();
        let zones: Vec<Bounds> =
            floor.dead_zones().iter().map(|z| z.outer.bounds().grown(TOUCH)).collect();
        Self { all, buckets: Buckets::of(&boxes), zones: Buckets::of(&zones), boxes }
    }

    /// The numbers of those whose boxes meet that of an edge, in their order, written into `found`.
    fn near(&self, start: Point, end: Point, found: &mut Vec<u32>) {
        let reach = Bounds::of([start, end]);
        self.buckets.meeting(&reach, found);
        found.retain(|&i| self.boxes[i as usize].meets(&reach));
    }
}

/// Lists that serve one edge after another.
#[derive(Default)]
struct Scratch {
    near: Vec<u32>,
    cuts: Vec<(f64, Point)>,
    cells: Vec<u32>,
    stretches: Vec<(f64, f64)>,
}

/// The Passframes of a floor, in the order of its cells.
pub(super) fn passframes(floor: &FragmentFloor) -> Vec<Passframe> {
    let faces = Faces::of(floor);
    let mut scratch = Scratch::default();
    let mut frames: Vec<Passframe> = floor
        .frames
        .cells()
        .map(|cell| {
            let edges = floor.frames.ring(cell).len();
            let mut own = Vec::with_capacity(edges);
            for edge in 0..edges {
                borders(floor, &faces, (cell, edge), &mut scratch, &mut own);
            }
            own.shrink_to_fit();
            Passframe {
                id: floor.ids[cell as usize],
                polygon: Polygon::new(own.iter().map(|b| b.start).collect()),
                kind: PassframeKind::Passage,
                borders: own,
            }
        })
        .collect();
    share_crossings(&mut frames);
    let kinds: Vec<_> = kinds(&frames);
    for (frame, kind) in frames.iter_mut().zip(kinds) {
        frame.kind = kind;
    }
    frames
}

/// Gives each Passframe the crossings that were found from its neighbours of lower number.
fn share_crossings(frames: &mut [Passframe]) {
    for cell in 0..frames.len() {
        let (lower, own) = frames.split_at_mut(cell);
        for border in &mut own[0].borders {
            let Some(other) = lower.get(border.across as usize) else { continue };
            let twin = other.borders.iter().find(|b| {
                b.across as usize == cell && b.start == border.end && b.end == border.start
            });
            border.crossing = twin.and_then(|t| t.crossing).map(|(from, to)| (to, from));
        }
    }
}

/// Adds the borders along one edge of a cell: one to another Passframe, or one for each face that stands there.
fn borders(
    floor: &FragmentFloor,
    faces: &Faces,
    (cell, edge): (u32, usize),
    scratch: &mut Scratch,
    borders: &mut Vec<Border>,
) {
    let (start, end) = floor.frames.edge(cell, edge);
    let across = floor.frames.across(cell).get(edge);
    if across != NONE {
        borders.push(Border {
            start,
            end,
            permeability: Permeability::Permeable,
            beyond: Beyond::Passframe(floor.ids[across as usize]),
            names: Vec::new(),
            // Found once for both Passframes, see below.
            crossing: if cell < across { crossing(floor, scratch, start, end) } else { None },
            across,
        });
        return;
    }
    let first = borders.len();
    faces.near(start, end, &mut scratch.near);
    cut(faces, scratch, start, end);
    let mut from = start;
    for to in scratch.cuts.iter().map(|c| c.1).chain([end]) {
        let (beyond, face) = what_stands_along(floor, faces, &scratch.near, from, to);
        match borders[first..].last_mut() {
            Some(last) if last.beyond == beyond => last.end = to,
            _ => borders.push(Border {
                start: from,
                end: to,
                permeability: face.map_or(Permeability::Impermeable, |f| f.permeability),
                beyond,
                names: face.map_or_else(Vec::new, |f| f.names.clone()),
                crossing: None,
                across,
            }),
        }
        from = to;
    }
    for border in &mut borders[first..] {
        if matches!(border.beyond, Beyond::Doorway { .. }) {
            border.crossing = crossing(floor, scratch, border.start, border.end);
        }
    }
}

/// The places on an edge where faces along it end, into the scratch lists.
fn cut(faces: &Faces, scratch: &mut Scratch, start: Point, end: Point) {
    let cuts = &mut scratch.cuts;
    cuts.clear();
    let length = (end - start).norm();
    let Some(along) = (end - start).try_normalize(0.0) else { return };
    let ends = scratch.near.iter().map(|&i| &faces.all[i as usize]).flat_map(|f| [f.start, f.end]);
    for p in ends {
        let t = (p - start).dot(&along);
        if t > TOUCH && t < length - TOUCH && along.perp(&(p - start)).abs() < TOUCH {
            cuts.push((t, start + along * t));
        }
    }
    cuts.order_by(|a, b| a.0.total_cmp(&b.0));
    cuts.dedup_by(|a, b| a.0 - b.0 < TOUCH);
}

/// Faces within this distance of a border stand along it, in cm.
const TOUCH: f64 = 0.05;

/// The widest stretch of a border on which the robot's centre may be as it turns, or else a place where a lane of a
/// strait crosses it.
fn crossing(
    floor: &FragmentFloor,
    scratch: &mut Scratch,
    a: Point,
    b: Point,
) -> Option<(Point, Point)> {
    let Scratch { cells, stretches, .. } = scratch;
    floor.cells.stretches_into(a, b, cells, stretches);
    let widest = stretches.iter().max_by(|x, y| (x.1 - x.0).total_cmp(&(y.1 - y.0)));
    match widest {
        Some(&(from, to)) => Some((a + (b - a) * from, a + (b - a) * to)),
        None => {
            let mut lanes = floor.lanes.iter();
            lanes.find_map(|&lane| meeting(lane, (a, b))).map(|p| (p, p))
        }
    }
}

/// Where two lines cross each other.
fn meeting((from, to): (Point, Point), (a, b): (Point, Point)) -> Option<Point> {
    let (along, border) = (to - from, b - a);
    let sine = along.perp(&border);
    let (t, u) = ((a - from).perp(&border) / sine, (a - from).perp(&along) / sine);
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)).then(|| a + border * u)
}

/// What is beyond a piece of border, and the face that it is, if it is one.
fn what_stands_along<'a>(
    floor: &FragmentFloor,
    faces: &'a Faces,
    near: &[u32],
    a: Point,
    b: Point,
) -> (Beyond, Option<&'a Face>) {
    let middle = nalgebra::center(&a, &b);
    // Borders may be cut short of a face's ends, so it is the line that counts.
    let off = |f: &Face| {
        [a, b, middle]
            .into_iter()
            .map(|p| (p - nearest_on_segment(p, f.start, f.end)).norm())
            .fold(0.0, f64::max)
    };
    let best = near
        .iter()
        .map(|&i| &faces.all[i as usize])
        .map(|f| (off(f), f))
        .filter(|(off, _)| *off < TOUCH)
        // Doors stand first among faces, so that a door in a wall is named before the wall.
        .min_by(|(x, _), (y, _)| (*x > 0.02).cmp(&(*y > 0.02)));
    if let Some((_, face)) = best {
        return (face.beyond, Some(face));
    }
    let mut zones = Vec::new();
    faces.zones.meeting(&Bounds::of([middle]), &mut zones);
    let off_zone = |k: usize| floor.dead_zones()[k].outer.border_distance(middle);
    let nearest = |zones: &mut dyn Iterator<Item = usize>| {
        zones.map(|k| (off_zone(k), k)).min_by(|x, y| x.0.total_cmp(&y.0))
    };
    let zone = nearest(&mut zones.into_iter().map(|k| k as usize))
        .filter(|(off, _)| *off < TOUCH)
        .or_else(|| nearest(&mut (0..floor.dead_zones().len())));
    match zone.map(|z| z.1) {
        Some(zone) => (Beyond::DeadZone(zone), None),
        // A sliver of rounding: whatever is nearest.
        None => faces.all.iter().min_by(|x, y| off(x).total_cmp(&off(y))).map_or(
            (
                Beyond::Face { blocker: Blocker::Floor { area: floor.area, item: 0 }, side: None },
                None,
            ),
            |f| (f.beyond, Some(f)),
        ),
    }
}

/// Ids from the corners' places in the Map, to the tenth of a millimetre: what lasts keeps its id, whatever comes or
/// goes elsewhere.
pub(super) fn ids(frames: &Mesh) -> Vec<PassframeId> {
    let hash = |cell: usize, round: u32| {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64; // FNV-1a
        let mut mix = |byte: u8| hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        for p in frames.corners(cell as u32) {
            for x in [p.x, p.y] {
                // The exact place tells slivers apart.
                let word = if round == 0 { (x * 100.0).round() as i64 as u64 } else { x.to_bits() };
                word.to_le_bytes().into_iter().for_each(&mut mix);
            }
        }
        if round > 0 {
            round.to_le_bytes().into_iter().for_each(&mut mix);
        }
        // The upper half depends on every byte.
        (hash >> 32) as u32
    };
    distinct(frames.len(), hash).into_iter().map(PassframeId).collect()
}

/// Numbers for things, no two alike, from what each hashes to in round after round: whoever meets nobody keeps the
/// number, all who meet go on to the next round. So a thing's number hangs on those that it meets and on no order; two of
/// a thousand have one 32-bit hash in one of nine thousand Fragments.
fn distinct(count: usize, hash: impl Fn(usize, u32) -> u32) -> Vec<u32> {
    let mut numbers = vec![0; count];
    let mut taken = HashSet::with_capacity(count);
    let mut open: Vec<usize> = (0..count).collect();
    let mut round = 0;
    while !open.is_empty() {
        let mut sorted: Vec<(u32, usize)> = open.drain(..).map(|i| (hash(i, round), i)).collect();
        sorted.sort_unstable();
        for alike in sorted.chunk_by(|a, b| a.0 == b.0) {
            match alike {
                &[(number, i)] if taken.insert(number) => numbers[i] = number,
                // The same in every round: nothing but the order is left to tell them apart.
                _ if round >= LAST_ROUND => {
                    for &(number, i) in alike {
                        numbers[i] = (number..=u32::MAX)
                            .chain(0..number)
                            .find(|&n| taken.insert(n))
                            .unwrap_or(number);
                    }
                }
                _ => open.extend(alike.iter().map(|a| a.1)),
            }
        }
        round += 1;
    }
    numbers
}

/// After so many rounds things that meet are the same in all that is hashed.
const LAST_ROUND: u32 = 16;

fn kinds(frames: &[Passframe]) -> Vec<PassframeKind> {
    let at_door =
        |f: &Passframe| f.borders.iter().any(|b| matches!(b.beyond, Beyond::Doorway { .. }));
    let crossable = |cell: usize| -> Vec<usize> {
        let crossed =
            frames[cell].borders.iter().filter(|b| b.across != NONE && b.crossing.is_some());
        crossed.map(|b| b.across as usize).collect()
    };
    let mut leads_out: Vec<bool> = frames.iter().map(at_door).collect();
    let mut open: Vec<usize> = (0..frames.len()).filter(|&i| leads_out[i]).collect();
    while let Some(cell) = open.pop() {
        for other in crossable(cell) {
            if !leads_out[other] {
                leads_out[other] = true;
                open.push(other);
            }
        }
    }
    let kind = |cell: usize| {
        if !leads_out[cell] {
            PassframeKind::Closed
        } else if at_door(&frames[cell]) {
            PassframeKind::Boundary
        } else if crossable(cell).len() <= 1 {
            PassframeKind::DeadEnd
        } else {
            PassframeKind::Passage
        }
    };
    (0..frames.len()).map(kind).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hashes that meet often: of a thing's own name and the round alone.
    fn poor(name: u32, round: u32) -> u32 {
        let hash = name.wrapping_mul(0x9e37_79b9).rotate_left(7 * round + 3);
        if round == 0 { hash % 40 } else { hash }
    }

    fn numbers(names: &[u32]) -> Vec<(u32, u32)> {
        let found = distinct(names.len(), |i, round| poor(names[i], round));
        let mut named: Vec<(u32, u32)> = names.iter().copied().zip(found).collect();
        named.sort_unstable();
        named
    }

    #[test]
    fn ids_that_meet_hang_on_no_order_and_on_nobody_else() {
        let names: Vec<u32> = (0..30).map(|k| k * k * 7 + 1).collect();
        let whole = numbers(&names);
        let met = names
            .iter()
            .filter(|&&n| names.iter().any(|&other| other != n && poor(other, 0) == poor(n, 0)));
        assert!(met.count() > 6);
        let distinct: HashSet<u32> = whole.iter().map(|n| n.1).collect();
        assert_eq!(distinct.len(), names.len());
        let turned: Vec<u32> = names.iter().rev().copied().collect();
        assert_eq!(numbers(&turned), whole);
        // Whoever goes changes only those that it met.
        for gone in &names {
            let rest: Vec<u32> = names.iter().copied().filter(|n| n != gone).collect();
            for (name, number) in numbers(&rest) {
                let meets = poor(name, 0) == poor(*gone, 0);
                assert!(meets || whole.contains(&(name, number)), "{name} without {gone}");
            }
        }
        // What hashes alike for ever is told apart all the same.
        assert_eq!(super::distinct(3, |_, _| u32::MAX), [u32::MAX, 0, 1]);
    }
}

//! What borders the Passframes of a Fragment: other Passframes, doorways, faces of things, walls and dead zones.
//!
//! Found when it is first asked for, from what the floor keeps ([`super::edging`]).

use crate::map::Permeability;
use crate::units::{InOrder as _, Point};

use super::blocker::{Blocker, Obstacle};
use super::buckets::Buckets;
use super::edging::Face;
use super::floor::FragmentFloor;
use super::mesh::NONE;
use super::passframe::{Beyond, Border, Passframe, PassframeKind};
use super::storey::Side;
use super::{Bounds, Polygon, nearest_on_segment};

impl FragmentFloor {
    /// The Passframes, sorted by place; see [`Passframe::id`].
    pub fn passframes(&self) -> &[Passframe] {
        self.passframes.get(|| passframes(self))
    }

    /// The Passframe that holds a point of the floor.
    #[must_use]
    pub fn passframe_at(&self, p: Point) -> Option<&Passframe> {
        self.frames.locate(p, 1e-3).map(|cell| &self.passframes()[cell as usize])
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
        let all = faces(floor);
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

/// All faces of a floor. Doors stand first, so that a door in a wall is named before the wall.
fn faces(floor: &FragmentFloor) -> Vec<Face> {
    let edging = &floor.edging;
    let face = |(start, end): (Point, Point), blocker: Blocker, side: usize| {
        let found = edging.marks.binary_search_by_key(&(blocker, side), |m| (m.blocker, m.side));
        let mark = found.ok().map(|i| &edging.marks[i]);
        Face {
            start,
            end,
            beyond: Beyond::Face { blocker, side: Some(side) },
            permeability: mark.map_or(Permeability::Impermeable, |m| m.permeability),
            names: mark.map_or_else(Vec::new, |m| m.names.clone()),
        }
    };
    let of_thing = |o: &Obstacle| {
        let edges = o.polygon.edges().enumerate();
        let sides = edges.map(|(number, edge)| match o.side {
            None => face(edge, o.blocker, number),
            Some(side) => face(edge, o.blocker, side),
        });
        let mut sides: Vec<Face> = sides.collect();
        if o.side.is_some() {
            // Behind a strip is the thing itself, or what its other sides look at.
            sides.remove(2);
        }
        sides
    };
    let of_side = |s: &Side| {
        let blocker = Blocker::Wall { area: floor.area, item: s.item, side: s.side };
        face((s.start, s.end), blocker, s.side)
    };
    let of_wall = |&(start, end): &(Point, Point)| {
        let beyond = Beyond::Face { blocker: Blocker::jamb(floor.area), side: None };
        let permeability = Permeability::Impermeable;
        Face { start, end, beyond, permeability, names: Vec::new() }
    };
    let mut faces = edging.doorways.clone();
    faces.extend(floor.obstacles().iter().flat_map(of_thing));
    faces.extend(edging.sides.iter().map(of_side));
    faces.extend(floor.walls.iter().map(of_wall));
    faces
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
fn passframes(floor: &FragmentFloor) -> Vec<Passframe> {
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

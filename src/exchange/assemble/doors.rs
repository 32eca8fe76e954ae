//! Doors, passages and windows as records, and the links of the Map that follow from them.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::map::{
    Door, DoorKind, DoorLeaf, DoorState, DoorStatus, Forms, Gender, HingeSide, MapLink, OpensTo,
    Permeability, SideRef, TypeKind,
};
use crate::report::{What, Why};
use crate::units::{AreaId, Cm, Deg, DoorId, Point, TypeId};
use crate::{Level, Opening, OpeningKind};

use super::build::{Doors, Maker, SOURCE, Storey, door_height};
use super::names;
use super::openings::what;
use super::wall::SideUse;

/// Of a leaf where the file does not tell, cm.
const THICKNESS: f64 = 4.0;

impl Maker<'_> {
    /// Makes the doors of a level, in the order of the file.
    pub(super) fn doors(&mut self, level: &Level, storey: &Storey) -> Doors {
        let widths = widths(level, storey);
        let count = level.openings.len();
        let mut doors = Doors {
            ids: vec![None; count],
            windows: vec![None; count],
            sides: BTreeMap::new(),
            into: vec![Vec::new(); count],
        };
        for (i, opening) in level.openings.iter().enumerate() {
            self.report.found(what(opening), 1);
            let (Some(rooms), Some(width)) = (storey.placed.mounted[i], widths[i]) else {
                continue;
            };
            self.report.taken(what(opening), 1);
            if opening.what == OpeningKind::Window {
                doors.windows[i] = Some(self.window_name(opening));
                continue;
            }
            let opens_left = opens_left(opening, rooms);
            let inside = |side: usize| (side == 0) == opens_left;
            doors.into[i] = rooms
                .iter()
                .enumerate()
                .filter_map(|(side, room)| Some(((*room)?, inside(side))))
                .collect();
            let wall = rooms
                .iter()
                .flatten()
                .map(|&room| storey.heights[room])
                .fold(f64::INFINITY, f64::min);
            doors.ids[i] = Some(self.door(opening, rooms, width, wall));
        }
        doors
    }

    fn window_name(&mut self, opening: &Opening) -> String {
        let name = names::tidy(&opening.name);
        if names::is_russian(&name) { name } else { self.names.numbered("Окно", "Window").name }
    }

    fn door(
        &mut self,
        opening: &Opening,
        rooms: [Option<usize>; 2],
        width: f64,
        wall: f64,
    ) -> DoorId {
        let id = DoorId(self.world.doors.len() as u32 + 1);
        let (base, base_en) = match opening.what {
            OpeningKind::Passage => ("Проход", "Passage"),
            _ => ("Дверь", "Door"),
        };
        let name = names::tidy(&opening.name);
        let named = if name.is_empty() {
            self.names.numbered(base, base_en)
        } else if names::is_russian(&name) {
            self.names.unique(&name, "")
        } else {
            self.names.numbered_with(base, &name)
        };
        // Leaves are counted from the right jamb, seen from the first Area that mounts the door.
        let first_is_left = match rooms {
            [Some(left), Some(right)] => left < right,
            [left, _] => left.is_some(),
        };
        let (kind, leaves, state) = leaves(opening, first_is_left);
        let door_type = Some(self.door_type(kind, leaves.len()));
        let mut properties = opening.properties.clone();
        properties.insert(SOURCE.to_owned(), opening.source.clone());
        let key = self.names.key("door", &opening.source);
        self.world.doors.insert(
            id,
            Door {
                id,
                key,
                name: named.name,
                name_en: named.name_en,
                door_type,
                kind,
                width: Cm::of(width),
                height: Cm::of(door_height(opening.height, wall)),
                leaves,
                state,
                properties,
                forms: Forms::new(),
            },
        );
        id
    }

    fn door_type(&mut self, kind: DoorKind, leaves: usize) -> TypeId {
        let (name, name_en, gender) = match (kind, leaves) {
            (DoorKind::Passage, _) => ("Проход", "passage", Gender::Masculine),
            (DoorKind::Sliding, _) => ("Раздвижная", "sliding", Gender::Feminine),
            (DoorKind::Hinged, 0 | 1) => ("Распашная", "hinged", Gender::Feminine),
            (DoorKind::Hinged, _) => ("Двустворчатая", "double", Gender::Feminine),
        };
        self.types.plain(TypeKind::Door, name, name_en, gender)
    }

    /// Binds the Areas of a level: openings to openings, and islands by walls.
    pub(super) fn links(&mut self, level: &Level, storey: &Storey, doors: &Doors) {
        let mut links = Vec::new();
        let place = |maker: &Self, area: AreaId, item: &str, side: &str| {
            let origin = origin(storey, area);
            let model = maker.world.areas.get(&area)?;
            let orthoframe = maker.world.orthoframes.get(&model.item(item)?.orthoframe)?;
            let (_, vector) = orthoframe.side(side)?;
            Some((origin + vector.start.coords, origin + vector.end.coords))
        };
        for sides in doors.sides.values() {
            if let [one, other] = &sides[..]
                && one.0 != other.0
                && let Some(from) = place(self, one.0, &one.1, &one.2)
                && let Some(to) = place(self, other.0, &other.1, &other.2)
            {
                links.push(link(
                    (one.0, side(&one.1, &one.2), from),
                    (other.0, side(&other.1, &other.2), to),
                ));
            }
        }
        for (area, anchor) in self.islands(storey, &links) {
            let wall = |maker: &Self, area: AreaId| {
                let (item, side) = solid_side(maker, area)?;
                let ends = place(maker, area, &item, &side)?;
                Some((area, self::side(&item, &side), ends))
            };
            if let (Some(from), Some(to)) = (wall(self, anchor), wall(self, area)) {
                links.push(link(from, to));
                let room = storey.areas.iter().position(|a| *a == Some(area));
                let source = room.map_or("", |r| level.rooms[r].source.as_str());
                self.report.noted(What::Room, source, Why::Island);
            }
        }
        if let Some(map) = self.world.maps.get_mut(&storey.map) {
            map.links = links.into_iter().map(Arc::new).collect();
        }
    }

    /// Areas that stand for groups which nothing binds to the first one, each with the Area to bind it to.
    fn islands(&self, storey: &Storey, links: &[MapLink]) -> Vec<(AreaId, AreaId)> {
        let areas: Vec<AreaId> = storey.areas.iter().flatten().copied().collect();
        let mut groups = Groups::of(&areas);
        for link in links {
            groups.join(link.area, link.to_area);
        }
        let Some(&first) = areas.first() else { return Vec::new() };
        let has_wall = |area: &AreaId| solid_side(self, *area).is_some();
        let anchor = areas
            .iter()
            .copied()
            .find(|&a| groups.root(a) == groups.root(first) && has_wall(&a))
            .unwrap_or(first);
        let mut found: Vec<(AreaId, AreaId)> = Vec::new();
        let mut seen = std::collections::BTreeSet::from([groups.root(first)]);
        for area in areas.iter().copied().filter(has_wall) {
            if seen.insert(groups.root(area)) {
                found.push((area, anchor));
            }
        }
        found
    }
}

fn side(item: &str, side: &str) -> SideRef {
    SideRef { item: item.to_owned(), side: side.to_owned() }
}

fn origin(storey: &Storey, area: AreaId) -> Point {
    // Areas of a level are numbered in the order of its rooms, with gaps for rooms that are none.
    let i = storey.areas.partition_point(|a| a.is_none_or(|a| a < area));
    let i = (i..storey.areas.len())
        .find(|&i| storey.areas[i] == Some(area))
        .or_else(|| storey.areas.iter().position(|&a| a == Some(area)));
    i.map_or(Point::origin(), |i| storey.origins[i])
}

fn solid_side(maker: &Maker<'_>, area: AreaId) -> Option<(String, String)> {
    maker.world.areas.get(&area)?.items.iter().find_map(|item| {
        let orthoframe = maker.world.orthoframes.get(&item.orthoframe)?;
        let wall = orthoframe.base.iter().find(|v| v.permeability == Permeability::Impermeable)?;
        Some((item.id.clone(), wall.id.clone()))
    })
}

type Placed = (AreaId, SideRef, (Point, Point));

/// A link with the offset that its sides have: see [`MapLink`] and [`crate::map::ItemLink`].
fn link((area, side, from): Placed, (to_area, to_side, to): Placed) -> MapLink {
    let direction = |(a, b): (Point, Point)| (b.y - a.y).atan2(b.x - a.x).to_degrees();
    let turn = Deg::of(direction(to) - direction(from)).signed();
    let is_reversed = turn.abs() > 90.0;
    let corner = if is_reversed { to.1 } else { to.0 };
    let offset = corner - from.0;
    MapLink {
        area,
        side,
        to_area,
        to_side,
        rel_x: rounded(offset.x),
        rel_y: rounded(offset.y),
        rel_z: Cm::ZERO,
        rel_a: Deg::of((if is_reversed { turn - 180.0 } else { turn } * 1e4).round() / 1e4),
    }
}

/// Openings coincide: what is less than a micrometre is nothing.
fn rounded(offset: f64) -> Cm {
    Cm::of((offset * 1e4).round() / 1e4)
}

/// Of each opening the width of its side, the least where its rooms differ by a hair.
fn widths(level: &Level, storey: &Storey) -> Vec<Option<f64>> {
    let mut widths: Vec<Option<f64>> = vec![None; level.openings.len()];
    for ring in storey.placed.walls.iter().flatten().flat_map(super::wall::Walls::outline) {
        for (k, &(start, used)) in ring.iter().enumerate() {
            if let SideUse::Opening(i) = used {
                let width = (ring[(k + 1) % ring.len()].0 - start).norm();
                widths[i] = Some(widths[i].map_or(width, |w| w.min(width)));
            }
        }
    }
    widths
}

/// Whether the leaves swing to the left of the line from the first jamb to the second.
fn opens_left(opening: &Opening, rooms: [Option<usize>; 2]) -> bool {
    match opening.what {
        OpeningKind::Door { opens: Some(opens), .. } => opens == OpensTo::Inside,
        _ => rooms[0].is_some(),
    }
}

fn leaves(opening: &Opening, first_is_left: bool) -> (DoorKind, Vec<DoorLeaf>, DoorState) {
    let OpeningKind::Door { kind, leaves, status, opening: share, .. } = &opening.what else {
        return (DoorKind::Passage, Vec::new(), DoorState::OPEN);
    };
    if *kind == DoorKind::Passage {
        return (DoorKind::Passage, Vec::new(), DoorState::OPEN);
    }
    let most = if *kind == DoorKind::Hinged { 90.0 } else { 100.0 };
    let limit = if *kind == DoorKind::Hinged { 270.0 } else { 100.0 };
    let usual = DoorLeaf {
        hinge: HingeSide::Right,
        share: 1.0,
        thickness: Cm::of(THICKNESS),
        max_open: most,
    };
    let mut leaves: Vec<DoorLeaf> = if leaves.is_empty() { vec![usual] } else { leaves.clone() };
    for leaf in &mut leaves {
        if leaf.max_open.is_nan() || leaf.max_open <= 0.0 {
            leaf.max_open = most;
        }
        leaf.max_open = leaf.max_open.min(limit);
        leaf.thickness = Cm::of(leaf.thickness.get().clamp(0.1, 50.0));
        leaf.share = if leaf.share > 0.0 { leaf.share } else { 0.01 };
    }
    let sum: f64 = leaves.iter().map(|leaf| leaf.share).sum();
    leaves.iter_mut().for_each(|leaf| leaf.share /= sum);
    if !first_is_left {
        leaves.reverse();
        for leaf in &mut leaves {
            leaf.hinge = match leaf.hinge {
                HingeSide::Right => HingeSide::Left,
                HingeSide::Left => HingeSide::Right,
            };
        }
    }
    let share = if share.is_finite() { share.clamp(0.0, 100.0) } else { 100.0 };
    let state = match status {
        DoorStatus::Open => DoorState { status: *status, opening: share },
        DoorStatus::Closed => DoorState::CLOSED,
        DoorStatus::Locked => DoorState::LOCKED,
    };
    (*kind, leaves, state)
}

/// Disjoint groups of Areas.
struct Groups {
    parent: std::collections::HashMap<AreaId, AreaId>,
}

impl Groups {
    fn of(areas: &[AreaId]) -> Self {
        Self { parent: areas.iter().map(|&a| (a, a)).collect() }
    }

    fn root(&self, mut area: AreaId) -> AreaId {
        while let Some(&parent) = self.parent.get(&area).filter(|&&p| p != area) {
            area = parent;
        }
        area
    }

    fn join(&mut self, one: AreaId, other: AreaId) {
        let (one, other) = (self.root(one), self.root(other));
        // The lower id is the root, and long chains do not arise in the order of files.
        self.parent.insert(one.max(other), one.min(other));
    }
}

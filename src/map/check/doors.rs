//! Doors (M7): their leaves and states, the sides on which they are mounted, the Areas that they join.

use std::collections::{BTreeMap, BTreeSet};

use crate::fault::{MORE_THAN_0, MapError, Record, Spot};
use crate::units::{AreaId, Bilingual, Cm, Gather as _, Piece, word};
use crate::{
    Door, DoorKind, DoorMount, DoorState, DoorStatus, OpensTo, Permeability, SideRef, TypeKind,
};

use super::group::{Group, PlacedSide};
use super::{Checker, TOLERANCE, area_title};

/// Shares of leaves may miss 1 by this much: people write 0.333.
const SHARE_TOLERANCE: f64 = 0.005;

impl<'w> Checker<'w> {
    pub(super) fn doors(&mut self) {
        let mut keys = BTreeSet::new();
        let id = |record: &Record| match record {
            Record::Door(id) => Some(*id),
            _ => None,
        };
        let asked = self.asked(("doors", &self.world.doors), id, |d| &d.key);
        if asked.is_empty() {
            return;
        }
        let mounts = self.area_mounts();
        let of_objects: BTreeSet<_> =
            self.world.objects.values().flat_map(|o| o.doors.iter().map(|m| m.door)).gather();
        let all_groups_read =
            !self.broken.iter().any(|r| matches!(r, Record::Area(_) | Record::Object(_)));
        for door in asked {
            let spot = Spot::of(Record::Door(door.id));
            self.key(&mut keys, &door.key, word!("door"), &spot);
            if !self.asks_for(Record::Door(door.id)) {
                continue;
            }
            if !self.is_broken(Record::Door(door.id)) {
                self.door(door, &spot);
            }
            let name = || door.name.clone();
            match mounts.get(&door.id).map(Vec::as_slice) {
                None if all_groups_read && !of_objects.contains(&door.id) => {
                    self.fault(MapError::DoorUnused { door: name() }, spot);
                }
                None => {}
                Some(mounts) => {
                    let count = mounts.len() + usize::from(of_objects.contains(&door.id));
                    match mounts {
                        _ if count > 2 => {
                            self.fault(MapError::DoorMounts { door: name(), count }, spot);
                        }
                        [one, other] if all_groups_read && one.area != other.area => {
                            self.joined(door, *one, *other);
                        }
                        _ => {}
                    }
                }
            }
        }
    }

    /// Every mount of every door that is looked at on an Area, in the order of the Areas.
    fn area_mounts(&self) -> BTreeMap<crate::units::DoorId, Vec<Mounted<'w>>> {
        let mut mounts: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for area in self.world.areas.values() {
            for (index, mount) in area.doors.iter().enumerate() {
                if !self.asks_for(Record::Door(mount.door)) {
                    continue;
                }
                let mounted = Mounted { area: area.id, index, mount };
                mounts.entry(mount.door).or_default().push(mounted);
            }
        }
        mounts
    }

    pub(super) fn door(&mut self, door: &Door, spot: &Spot) {
        let owner = Bilingual::named(word!("door-2"), &door.name);
        self.type_exists(TypeKind::Door, door.door_type, &owner, spot);
        for (what, size) in [("width", door.width.get()), ("height", door.height.get())] {
            let fits = size > 0.0 && Cm::new(size).is_ok();
            self.in_range(what, size, fits, MORE_THAN_0, spot.clone().field(what));
        }
        let leaves = |why: Piece| MapError::DoorLeaves { door: door.name.clone(), why: why.into() };
        let at = spot.clone().field("leaves");
        match (door.kind, door.leaves.is_empty()) {
            (DoorKind::Passage, false) => self.fault(leaves(word!("a-passage-has-no-leaves")), at),
            (DoorKind::Hinged | DoorKind::Sliding, true) => {
                self.fault(leaves(word!("there-is-not-one-leaf")), spot.clone());
            }
            _ => self.leaves(door, &at),
        }
        self.state(door, &door.state, spot);
    }

    fn leaves(&mut self, door: &Door, spot: &Spot) {
        for (i, leaf) in door.leaves.iter().enumerate() {
            let at = |field| spot.clone().index(i).field(field);
            let (share, thick) = (leaf.share, leaf.thickness.get());
            self.in_range(
                "share",
                share,
                share > 0.0 && share <= 1.0,
                word!("more-than-0-and-at-most-1"),
                at("share"),
            );
            let fits = (0.0..=50.0).contains(&thick);
            self.in_range("thickness", thick, fits, word!("from-0-to-50-cm"), at("thickness"));
            let (limit, range) = if door.kind == DoorKind::Hinged {
                (270.0, word!("more-than-0-and-at-most-270"))
            } else {
                (100.0, word!("more-than-0-and-at-most-100"))
            };
            let fits = leaf.max_open > 0.0 && leaf.max_open <= limit;
            self.in_range("max_open", leaf.max_open, fits, range, at("max_open"));
        }
        let sum: f64 = door.leaves.iter().map(|leaf| leaf.share).sum();
        if !door.leaves.is_empty() && (sum - 1.0).abs() > SHARE_TOLERANCE {
            let sum = (sum * 1000.0).round() / 1000.0;
            self.fault(MapError::LeafShares { door: door.name.clone(), sum }, spot.clone());
        }
    }

    /// A door's own state, or its state on one replica.
    pub(super) fn state(&mut self, door: &Door, state: &DoorState, spot: &Spot) {
        let opening = state.opening;
        let at = spot.clone().field("opening");
        let fits = (0.0..=100.0).contains(&opening);
        self.in_range("opening", opening, fits, word!("from-0-to-100-2"), at.clone());
        let status = match state.status {
            DoorStatus::Open => word!("open"),
            DoorStatus::Closed => word!("closed"),
            DoorStatus::Locked => word!("locked"),
        };
        let is_open = state.status == DoorStatus::Open;
        let contradicts = match door.kind {
            DoorKind::Passage => !is_open || opening < 100.0,
            DoorKind::Hinged | DoorKind::Sliding => !is_open && opening > 0.0,
        };
        if fits && contradicts {
            let (door, status) = (door.name.clone(), status.into());
            self.fault(MapError::DoorState { door, opening, status }, at);
        }
    }

    /// The mounts of one Object or Area: each on a side that fits it, each conditional side with a door.
    pub(super) fn mounts(&mut self, group: &Group<'w>) {
        let spot = Spot::of(group.record);
        let mut taken = BTreeSet::new();
        let mut doors = BTreeSet::new();
        for (i, mount) in group.doors.iter().enumerate() {
            let at = spot.clone().field("doors").index(i);
            let Some(door) = self.world.doors.get(&mount.door) else {
                self.exists(false, &group.title, word!("door-2"), mount.door.0, at);
                continue;
            };
            if !doors.insert(mount.door) {
                let error = MapError::DoorMounts { door: door.name.clone(), count: 2 };
                self.fault(error, at.clone());
            }
            let side = SideRef { item: mount.item.clone(), side: mount.side.clone() };
            if !taken.insert((&mount.item, &mount.side)) {
                let side = format!("{}.{}", mount.item, mount.side);
                let error = MapError::SideTwoDoors { owner: group.title.clone(), side };
                self.fault(error, at.clone());
            }
            self.mount(group, door, &side, at.field("side"));
        }
        self.sides_without_doors(group, &taken);
    }

    fn mount(&mut self, group: &Group<'w>, door: &Door, side: &SideRef, spot: Spot) {
        let Some((item, vector)) = self.side(group, side, spot.clone()) else { return };
        let owner = || group.title.clone();
        let side = format!("{}.{}", side.item, side.side);
        let why = match (door.kind, vector.permeability) {
            (DoorKind::Passage, Permeability::Permeable) => None,
            (DoorKind::Passage, _) => Some(word!("a-passage-takes-a-permeable-side")),
            (_, Permeability::Conditional) => None,
            (_, Permeability::Permeable) => Some(word!("the-side-is-permeable-without-a-door")),
            (_, Permeability::Impermeable) => Some(word!("the-side-is-impermeable")),
        };
        if let Some(why) = why.map(Bilingual::from) {
            let error =
                MapError::DoorOnWrongSide { owner: owner(), door: door.name.clone(), side, why };
            self.fault(error, spot);
            return;
        }
        if door.width.get() > vector.length().get() + TOLERANCE {
            let error = MapError::DoorTooWide {
                owner: owner(),
                door: door.name.clone(),
                width: door.width,
                side: side.clone(),
                length: vector.length(),
            };
            self.fault(error, spot.clone());
        }
        let wall = self.world.orthoframe_of(item).height;
        if door.height.get() > wall.get() + TOLERANCE {
            let error = MapError::DoorTooHigh {
                owner: owner(),
                door: door.name.clone(),
                height: door.height,
                side,
                wall,
            };
            self.fault(error, spot);
        }
    }

    fn sides_without_doors(&mut self, group: &Group<'_>, taken: &BTreeSet<(&String, &String)>) {
        for (i, item) in group.items.iter().enumerate() {
            for vector in &self.world.orthoframe_of(item).base {
                if vector.permeability == Permeability::Conditional
                    && !taken.contains(&(&item.id, &vector.id))
                {
                    let side = format!("{}.{}", item.id, vector.id);
                    let error = MapError::SideWithoutDoor { owner: group.title.clone(), side };
                    self.fault(error, Spot::of(group.record).field("items").index(i));
                }
            }
        }
    }

    /// The two mounts of a door between Areas: the same place of the Map, opposite directions.
    fn joined(&mut self, door: &Door, one: Mounted<'_>, other: Mounted<'_>) {
        let spots =
            [one, other].map(|m| Spot::of(Record::Area(m.area)).field("doors").index(m.index));
        let [spot, other_spot] = spots;
        if door.kind != DoorKind::Passage && one.mount.opens == other.mount.opens {
            let way = match one.mount.opens {
                OpensTo::Inside => word!("inside"),
                OpensTo::Outside => word!("outside"),
            };
            let error = MapError::DoorDirection { door: door.name.clone(), way: way.into() };
            self.contradiction(error, spot.clone(), other_spot.clone());
        }
        let placed = [one, other].map(|m| self.placed_mount(m));
        let [Some((map, a)), Some((other_map, b))] = placed else { return };
        if map != other_map || !a.faces(&b) {
            let words = |m: Mounted<'_>| {
                let area = area_title(self.world, m.area);
                format!("{area}.{}.{}", m.mount.item, m.mount.side)
            };
            let error = MapError::DoorApart {
                door: door.name.clone(),
                side: words(one),
                other: words(other),
            };
            self.contradiction(error, spot, other_spot);
        }
    }

    /// The side of a mount where it stands on its Map.
    fn placed_mount(&self, mounted: Mounted<'_>) -> Option<(crate::units::MapId, PlacedSide)> {
        let area = &self.world.areas[&mounted.area];
        let (map, item) = self.placed(mounted.area)?;
        let frame = self.world.maps[&map].items[item].frame;
        let item = area.item(&mounted.mount.item)?;
        if !self.can_be_measured(item.orthoframe) {
            return None;
        }
        let (_, side) = self.world.orthoframe_of(item).side(&mounted.mount.side)?;
        Some((map, PlacedSide::new(side, &frame.compose(&item.frame))))
    }
}

/// A mount and where it is written.
#[derive(Clone, Copy)]
struct Mounted<'w> {
    area: AreaId,
    index: usize,
    mount: &'w DoorMount,
}

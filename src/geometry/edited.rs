//! A floor that follows an edited building: rooms built, rebuilt and taken away, doors, kinds of things, zones.
//!
//! What a Fragment's floor tells of is told in [`super::digest`]: its Area, its doorways with the Areas behind them, doorways
//! near to these and what is behind them in turn, the things and zones that reach it. A Fragment of which none of this changed
//! is taken over; only its number, and those of doorways, may become others.
//!
//! **Invariant**: as that of [`super::plan`]: the plan is then as one built anew from the edited world.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};

use crate::map::{Area, Door, DoorState, Item, Object, World, Zone};
use crate::units::{AreaId, DoorId, Gather as _, ObjectId, OrFrId, ReplicaId};

use super::Bounds;
use super::buckets::Buckets;
use super::doorways::Doorways;
use super::floor::FragmentFloor;
use super::opening::Opening;
use super::openings::Openings;
use super::plan::FloorPlan;
use super::scene::PlacedArea;
use super::zone::{placed, shut_otherwise};

/// What differs between two buildings for the floor of a Map.
#[derive(Default)]
struct Touched {
    /// Areas of the Map that are there now, but otherwise than they were or not at all.
    rebuilt: BTreeMap<AreaId, PlacedArea>,
    gone: BTreeSet<AreaId>,
    /// Things that are others, or stand elsewhere on the Map.
    replicas: BTreeSet<ReplicaId>,
    /// Doors that are others, however they stand.
    doors: BTreeSet<DoorId>,
}

impl Touched {
    fn is_rebuilt(&self, area: AreaId) -> bool {
        self.rebuilt.contains_key(&area) || self.gone.contains(&area)
    }
}

impl FloorPlan {
    /// Follows a world to an edited one, with the openings of that as the rules let them join, none where they are as they
    /// were; `false` where a new floor is to be built: the Map is not on both, the robot is another, or it has a footprint.
    /// Nothing is changed then.
    pub fn follow_building(
        &mut self,
        before: &World,
        after: &World,
        openings: Option<&Openings>,
    ) -> bool {
        let is_known = before.maps.contains_key(&self.map) && after.maps.contains_key(&self.map);
        if !is_known || before.robot != after.robot || !self.robot.footprint.is_empty() {
            return false;
        }
        let touched = self.differing(before, after);
        let doorways = match openings {
            Some(openings) => Arc::new(Doorways::of(openings, self.map)),
            None => Arc::clone(&self.doorways),
        };
        let frame_of = |area: &AreaId| match touched.rebuilt.get(area) {
            Some(area) => Some(area.frame),
            None if touched.gone.contains(area) => None,
            None => self.scene.areas.get(area).map(|area| area.frame),
        };
        let placed_now = Self::place(after, &touched.replicas, frame_of);
        let mut boxes: Vec<Bounds> =
            placed_now.values().flatten().map(|replica| replica.reach().grown(0.2)).collect();
        let were = touched.replicas.iter().filter_map(|id| self.scene.replicas.get(id));
        boxes.extend(were.map(|replica| replica.reach().grown(0.2)));

        let places = self.doorways.places_in(&doorways);
        let changed = |own: &Doorways, other: &Doorways, places: &[Option<usize>]| -> Vec<bool> {
            let is_other = |doorway: &Arc<Opening>, place: Option<usize>| {
                let same = place.map(|n| &other.ways[n]);
                same.is_none_or(|same| !Arc::ptr_eq(same, doorway) && !same.is_shaped_as(doorway))
                    || doorway.door.is_some_and(|door| touched.doors.contains(&door))
            };
            own.ways.iter().zip(places).map(|(doorway, place)| is_other(doorway, *place)).collect()
        };
        let mut stale: BTreeSet<AreaId> = self.near(&boxes).into_iter().gather();
        let olds = changed(&self.doorways, &doorways, &places);
        stale.extend(self.told_by(&touched, &olds));
        let news = changed(&doorways, &self.doorways, &doorways.places_in(&self.doorways));
        let is_laid_out_alike = touched.rebuilt.is_empty()
            && touched.gone.is_empty()
            && !olds.into_iter().chain(news.iter().copied()).any(|is_changed| is_changed);

        let scene = Arc::make_mut(&mut self.scene);
        let index = Arc::make_mut(&mut self.index);
        for (id, placed) in placed_now {
            if let Some(gone) = scene.replicas.remove(&id) {
                index.remove(&gone);
            }
            if let Some(placed) = placed {
                index.insert(&placed);
                scene.replicas.insert(id, placed);
            }
        }
        for gone in &touched.gone {
            scene.areas.remove(gone);
        }
        stale.extend(touched.rebuilt.keys());
        scene.areas.extend(touched.rebuilt.iter().map(|(id, area)| (*id, area.clone())));
        self.doorways = doorways;
        stale.extend(self.told_by(&touched, &news));
        let zones = placed(after, &self.scene, self.map, Zone::is_standing);
        let shut = shut_otherwise(&self.zones, &zones);
        if !shut.is_empty() {
            stale.extend(self.near_areas(&shut));
        }
        self.zones = Arc::new(zones);
        stale.retain(|area| self.scene.areas.contains_key(area));
        if !is_laid_out_alike {
            self.renumber(after, &stale, &places, &news);
        } else if !stale.is_empty() {
            self.renew(after, &stale.into_iter().collect::<Vec<_>>());
        }
        let states = before.doors.changes(&after.doors).into_iter();
        let states: Vec<(DoorId, DoorState)> = states
            .filter_map(|(id, was, is)| Some((id, was?.state, is?.state)))
            .filter(|(_, was, is)| was != is)
            .map(|(id, _, is)| (id, is))
            .collect();
        if !states.is_empty() {
            self.set_doors(before, after, &states.into_iter().collect());
        }
        true
    }

    fn differing(&self, before: &World, after: &World) -> Touched {
        let parts: BTreeSet<OrFrId> =
            before.orthoframes.changes(&after.orthoframes).into_iter().map(|(id, ..)| id).gather();
        let uses = |items: &[Item]| items.iter().any(|i| parts.contains(&i.orthoframe));
        let mut touched = Touched::default();

        let areas = before.areas.changes(&after.areas).into_iter();
        let same = |was: &Area, is: &Area| was.items == is.items && was.doors == is.doors;
        let others = areas.filter(|(_, was, is)| !was.zip(*is).is_some_and(|(a, b)| same(a, b)));
        let mut others: BTreeSet<AreaId> = others.map(|(id, ..)| id).gather();
        if !parts.is_empty() {
            others.extend(after.areas_made_of(|part| parts.contains(&part)).map(|area| area.id));
        }
        let mut asked = others.clone();
        let items = before.items_changed(after).into_iter().filter(|(map, _)| *map == self.map);
        asked.extend(items.flat_map(|(_, items)| items.into_iter().flatten().map(|i| i.area)));
        let (mut moved, mut standing) = (BTreeSet::new(), BTreeSet::new());
        let items = after.maps[&self.map].items.iter().filter(|_| !asked.is_empty());
        for item in items.filter(|item| asked.contains(&item.area)) {
            standing.insert(item.area);
            let Some(area) = after.areas.get(&item.area) else { continue };
            let was = self.scene.areas.get(&item.area);
            let is_moved = was.is_none_or(|was| was.frame != item.frame);
            if is_moved {
                moved.insert(item.area);
            }
            if is_moved || others.contains(&item.area) {
                touched.rebuilt.insert(area.id, PlacedArea::new(after, area.id, item.frame));
            }
        }
        let stood = asked.difference(&standing).filter(|id| self.scene.areas.contains_key(id));
        touched.gone.extend(stood);

        let hung = |door: &(DoorId, Option<&Door>, Option<&Door>)| {
            let (_, was, is) = door;
            !was.zip(*is).is_some_and(|(was, is)| *is == Door { state: is.state, ..was.clone() })
        };
        let doors = before.doors.changes(&after.doors);
        touched.doors = doors.iter().filter(|d| hung(d)).map(|(id, ..)| *id).collect();
        let swung: BTreeSet<DoorId> = doors.iter().map(|(id, ..)| *id).gather();
        let remade = |object: &&Object| {
            uses(&object.items)
                || object.doors.iter().any(|mount| swung.contains(&mount.door))
                || before
                    .objects
                    .get(&object.id)
                    .is_none_or(|was| (&was.items, &was.doors) != (&object.items, &object.doors))
        };
        let objects = after.objects.values().filter(remade).map(|object| object.id);
        let objects: BTreeSet<ObjectId> = objects.gather();
        let changes = before.replicas.changes(&after.replicas).into_iter();
        touched.replicas.extend(changes.map(|(id, ..)| id));
        if !objects.is_empty() || !moved.is_empty() || !touched.gone.is_empty() {
            let made = after.replicas_of(|kind| objects.contains(&kind));
            let gone = &touched.gone;
            let standing = after.replicas_within(|at| moved.contains(&at) || gone.contains(&at));
            let others: Vec<ReplicaId> = made.chain(standing).map(|r| r.id).collect();
            touched.replicas.extend(others);
        }
        touched
    }

    /// The Areas on whose floors something is told of changed Areas and doorways.
    fn told_by(&self, touched: &Touched, is_changed: &[bool]) -> BTreeSet<AreaId> {
        let mut found = BTreeSet::new();
        for (doorway, is_changed) in self.doorways.ways.iter().zip(is_changed) {
            if !is_changed && !doorway.areas.iter().any(|&area| touched.is_rebuilt(area)) {
                continue;
            }
            found.extend(doorway.areas);
            if *is_changed {
                // The leaf may stand before a neighbour's door.
                found.extend(self.next_to(doorway));
            }
            for area in doorway.areas {
                let own = self.doorways.by_area.of(area).iter();
                for &(other, side) in own {
                    let other = &self.doorways.ways[other];
                    if other.may_tell(doorway, self.reach()) {
                        found.insert(other.areas[1 - side]);
                    }
                }
            }
        }
        found
    }

    /// Takes over the Fragments that are not stale, under their new numbers, and builds the others; `places` are those of the
    /// doorways before, and of those now it is told which are others.
    fn renumber(
        &mut self,
        world: &World,
        stale: &BTreeSet<AreaId>,
        places: &[Option<usize>],
        is_new: &[bool],
    ) {
        let areas: Vec<AreaId> = self.scene.areas.keys().copied().collect();
        let number = |area: &AreaId| areas.binary_search(area).ok().map(|n| n as u32);
        let numbers: Vec<Option<u32>> = self.fragments.iter().map(|f| number(&f.area)).collect();
        let mut portals = vec![Vec::new(); areas.len()];
        for (old, own) in std::mem::take(&mut self.network.portals).into_iter().enumerate() {
            let Some(new) = numbers[old] else { continue };
            let moved = own.into_iter().filter_map(|mut portal| {
                portal.from.0 = new;
                portal.to.0 = numbers[portal.to.0 as usize]?;
                portal.doorway = places[portal.doorway]?;
                Some(portal)
            });
            portals[new as usize] = moved.collect();
        }
        self.network.portals = portals;
        let fresh: Vec<AreaId> = stale.iter().copied().collect();
        let built = self.with_site(world, |site| super::plan::built::build_all(site, &fresh));
        let kept = std::mem::take(&mut self.fragments).into_iter();
        let kept = kept.filter(|f| !stale.contains(&f.area) && number(&f.area).is_some());
        self.fragments = kept.chain(built).collect();
        self.fragments.sort_by_key(|f| f.area);
        self.covered = vec![OnceLock::new(); areas.len()];
        self.straits = vec![Vec::new(); areas.len() + self.doorways.ways.len()];
        let mut admitted = vec![None; is_new.len()];
        for (place, admits) in places.iter().zip(&self.admits) {
            if let Some(place) = place.filter(|&place| !is_new[place]) {
                admitted[place] = Some(*admits);
            }
        }
        let admits = |(doorway, known): (&Arc<Opening>, Option<bool>)| {
            known.unwrap_or_else(|| self.with_site(world, |site| site.is_open(doorway)))
        };
        self.admits = self.doorways.ways.iter().zip(admitted).map(admits).collect();
        let mut known = vec![None; areas.len()];
        for (number, extent) in numbers.iter().zip(&*self.extents) {
            if let Some(number) = number {
                known[*number as usize] = Some(*extent);
            }
        }
        let extent = |(fragment, known): (&Arc<FragmentFloor>, Option<Bounds>)| {
            known
                .filter(|_| !stale.contains(&fragment.area))
                .unwrap_or_else(|| self.extent_of(fragment))
        };
        self.extents = Arc::new(self.fragments.iter().zip(known).map(extent).collect());
        self.by_place = Arc::new(Buckets::of(&self.extents));
        let fresh: Vec<usize> = fresh.iter().filter_map(|&area| self.number(area)).collect();
        self.connect(world, fresh);
    }

    /// The Areas of the scene that boxes come near to, whatever Fragments there are.
    fn near_areas(&self, boxes: &[Bounds]) -> Vec<AreaId> {
        let reach = self.reach();
        let is_near = |area: &&PlacedArea| {
            let mut mouths = self.doorways.by_area.of(area.id).iter();
            boxes.iter().any(|own| {
                area.prisms.iter().any(|p| p.bounds.meets(own))
                    || mouths.any(|&(d, _)| self.doorways.ways[d].mouth(reach).meets(own))
            })
        };
        self.scene.areas.values().filter(is_near).map(|area| area.id).collect()
    }
}

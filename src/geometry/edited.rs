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
use crate::units::{AreaId, DoorId, ObjectId, OrFrId, ReplicaId};

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
        let mut stale: BTreeSet<AreaId> = self.near(&boxes).into_iter().collect();
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
            before.orthoframes.changes(&after.orthoframes).into_iter().map(|(id, ..)| id).collect();
        let uses = |items: &[Item]| items.iter().any(|i| parts.contains(&i.orthoframe));
        let mut touched = Touched::default();

        let areas = before.areas.changes(&after.areas).into_iter();
        let same = |was: &Area, is: &Area| was.items == is.items && was.doors == is.doors;
        let others = areas.filter(|(_, was, is)| !was.zip(*is).is_some_and(|(a, b)| same(a, b)));
        let mut others: BTreeSet<AreaId> = others.map(|(id, ..)| id).collect();
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
        let swung: BTreeSet<DoorId> = doors.iter().map(|(id, ..)| *id).collect();
        let remade = |object: &&Object| {
            uses(&object.items)
                || object.doors.iter().any(|mount| swung.contains(&mount.door))
                || before
                    .objects
                    .get(&object.id)
                    .is_none_or(|was| (&was.items, &was.doors) != (&object.items, &object.doors))
        };
        let objects = after.objects.values().filter(remade).map(|object| object.id);
        let objects: BTreeSet<ObjectId> = objects.collect();
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
        let built = self.with_site(world, |site| super::plan::build_all(site, &fresh));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{Extent, Replica, ZoneKind};
    use crate::openings::STEP_REACH;
    use crate::site::DoorStates;
    use crate::units::{Cm, Frame, Point, ZoneId};

    fn dice(mut state: u64) -> impl FnMut(usize) -> usize {
        move |below| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as usize % below
        }
    }

    /// The value under a random key.
    macro_rules! any {
        ($throw:ident, $records:expr) => {{
            let keys: Vec<_> = $records.keys().copied().collect();
            let key = keys[$throw(keys.len())];
            $records.get_mut(&key).expect("chosen among them")
        }};
    }

    fn shifted(frame: &Frame, (x, y): (f64, f64)) -> Frame {
        Frame::new(frame.x.get() + x, frame.y.get() + y, frame.z.get(), frame.angle)
    }

    /// A room like another, somewhere else, with doors of its own.
    fn add_room(world: &mut World, throw: &mut impl FnMut(usize) -> usize, by: (f64, f64)) {
        let last = world.areas.keys().next_back().expect("some").0;
        let twin = any!(throw, world.areas).clone();
        let (id, key) = (AreaId(last + 1), format!("area-{}", last + 1));
        let mut doors = twin.doors.clone();
        for mount in &mut doors {
            let door = world.doors[&mount.door].clone();
            let last = world.doors.keys().next_back().expect("some").0;
            mount.door = DoorId(last + 1);
            world.doors.insert(mount.door, Door { id: mount.door, ..door });
        }
        let map = world
            .maps
            .values_mut()
            .find(|map| map.items.iter().any(|item| item.area == twin.id))
            .expect("every room stands on a map");
        let mut item =
            map.items.iter().find(|item| item.area == twin.id).expect("just found").clone();
        (item.area, item.frame) = (id, shifted(&item.frame, by));
        map.items.push(item);
        world.areas.insert(id, Area { id, key, doors, ..twin });
    }

    fn alter(world: &mut World, throw: &mut impl FnMut(usize) -> usize) {
        let (x, y) = (throw(300) as f64 - 150.0, throw(300) as f64 - 150.0);
        match throw(14) {
            0 => add_room(world, throw, (6.0 * x, 6.0 * y)),
            1 => {
                let by = [(400.0, 0.0), (0.0, 510.0)][throw(2)];
                add_room(world, throw, by);
            }
            2 => {
                let map = any!(throw, world.maps);
                let at = throw(map.items.len());
                map.items[at].frame = shifted(&map.items[at].frame, (x / 30.0, y / 30.0));
            }
            3 if world.areas.len() > 3 => {
                let id = any!(throw, world.areas).id;
                world.areas.remove(&id);
                world.replicas.retain(|_, r| r.area != id);
                for map in world.maps.values_mut() {
                    map.items.retain(|item| item.area != id);
                    map.links.retain(|link| link.area != id && link.to_area != id);
                }
            }
            4 | 5 => {
                let door = any!(throw, world.doors);
                match throw(4) {
                    0 => door.width = Cm::of(door.width.get() * 0.9),
                    1 => door.height = Cm::of(90.0 + throw(90) as f64),
                    2 => door.leaves.reverse(),
                    _ => door.state = [DoorState::OPEN, DoorState::CLOSED][throw(2)],
                }
            }
            6 => drop(any!(throw, world.areas).doors.pop()),
            7 => any!(throw, world.orthoframes).height = Cm::of(20.0 + throw(200) as f64),
            8 => {
                let part = any!(throw, world.orthoframes).id;
                let object = any!(throw, world.objects);
                object.items.iter_mut().take(1).for_each(|item| item.orthoframe = part);
            }
            9 => {
                let id = ZoneId(1 + throw(4) as u32);
                let map = any!(throw, world.maps).id;
                let area = any!(throw, world.areas).id;
                let at = |dx: f64, dy: f64| Point::new(x + dx, y + dy);
                let corners = vec![at(0.0, 0.0), at(90.0, 0.0), at(90.0, 60.0)];
                let extent =
                    [Extent::Polygon { map, corners }, Extent::Areas(vec![area])][throw(2)].clone();
                let zone = Zone {
                    id,
                    key: format!("zone-{}", id.0),
                    name: format!("Зона-{}", id.0),
                    name_en: String::new(),
                    kind: [ZoneKind::KeepOut, ZoneKind::Slow { speed: 9.0 }][throw(2)],
                    extent,
                    reason: String::new(),
                    reason_en: String::new(),
                    from: None,
                    until: None,
                    forms: Default::default(),
                };
                world.zones.insert(id, zone);
            }
            10 => drop(world.zones.pop_last()),
            _ => {
                let replica = any!(throw, world.replicas);
                replica.frame = shifted(&replica.frame, (x / 2.0, y / 2.0));
                if throw(3) == 0 {
                    let last = world.replicas.keys().next_back().expect("some").0;
                    let twin = any!(throw, world.replicas).clone();
                    let id = ReplicaId(last + 1);
                    world.replicas.insert(id, Replica { id, ..twin });
                }
            }
        }
    }

    fn same(followed: &FloorPlan, anew: &FloorPlan, how: &str) {
        assert_eq!(followed.scene, anew.scene, "{how}");
        assert_eq!(followed.zones, anew.zones, "{how}");
        assert_eq!(followed.doorways(), anew.doorways(), "{how}");
        assert_eq!(followed.blind_openings(), anew.blind_openings(), "{how}");
        for (one, other) in followed.fragments.iter().zip(&anew.fragments) {
            assert_eq!(one.area, other.area, "{how}");
            assert!(one == other, "{how}: {:?}", one.area);
        }
        assert_eq!(followed.fragments.len(), anew.fragments.len(), "{how}");
        assert_eq!(followed.network.portals, anew.network.portals, "{how}");
        assert_eq!(followed.network.pieces(), anew.network.pieces(), "{how}");
        assert_eq!(followed.admits, anew.admits, "{how}");
        assert_eq!(followed.open_doorways(), anew.open_doorways(), "{how}");
    }

    /// What [`Openings::follow`] is told of an edit.
    fn reshaped(before: &World, after: &World) -> (BTreeSet<AreaId>, BTreeSet<DoorId>) {
        let parts: BTreeSet<OrFrId> =
            before.orthoframes.changes(&after.orthoframes).into_iter().map(|(id, ..)| id).collect();
        let (was, is) = (before.placements(), after.placements());
        let all = before.areas.keys().chain(after.areas.keys()).copied();
        let is_other = |id: &AreaId| {
            let made = |area: &Area| (area.items.clone(), area.doors.clone());
            let [one, other] = [before, after].map(|world| world.areas.get(id).map(made));
            let uses = other.iter().flat_map(|(items, _)| items);
            was.get(id) != is.get(id)
                || uses.clone().any(|item| parts.contains(&item.orthoframe))
                || one != other
        };
        let doors = before.doors.changes(&after.doors).into_iter().map(|(id, ..)| id);
        (all.filter(is_other).collect(), doors.collect())
    }

    /// Whatever is built, rebuilt and taken away, the openings and the floor are then as those made anew.
    #[test]
    fn a_floor_follows_an_edited_building() {
        for (seed, map) in ["rb2", "lab", "two-storeys"].into_iter().enumerate() {
            let mut throw = dice(seed as u64 + 17);
            let first =
                World::load(format!("../../maps/{map}.toml")).expect("a map of the project");
            let build = |world: &World| -> Vec<FloorPlan> {
                let floor = |&map| FloorPlan::build(world, map, &world.robot, &DoorStates::new());
                world.maps.keys().map(floor).collect()
            };
            let (mut before, mut floors, mut kept) = (first.clone(), build(&first), 0);
            let mut openings = Openings::of(&first, STEP_REACH);
            for step in 0..STEPS {
                let mut after = before.clone();
                for _ in 0..=throw(2) {
                    alter(&mut after, &mut throw);
                }
                let (areas, doors) = reshaped(&before, &after);
                openings = openings
                    .follow(&before, &after, STEP_REACH, &areas, &doors)
                    .expect("the building is small");
                assert_eq!(openings, Openings::of(&after, STEP_REACH), "{map}, step {step}");
                let anew = build(&after);
                for (floor, anew) in floors.iter_mut().zip(&anew) {
                    let old = floor.fragments.clone();
                    assert!(floor.follow_building(&before, &after, Some(&openings)));
                    same(floor, anew, &format!("{map}, step {step}"));
                    let is_kept = |new: &&Arc<_>| old.iter().any(|old| Arc::ptr_eq(old, new));
                    kept += floor.fragments.iter().filter(is_kept).count();
                }
                before = after;
                if step % 12 == 11 {
                    (before, floors) = (first.clone(), build(&first));
                    openings = Openings::of(&first, STEP_REACH);
                }
            }
            assert!(kept > STEPS, "{map}: {kept} Fragments were taken over");
        }
    }

    const STEPS: usize = 60;
}

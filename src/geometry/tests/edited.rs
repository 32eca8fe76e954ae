//! A floor that follows edits of its building against one made anew.

use std::collections::BTreeSet;

use orthoframe_geometry::{Bounds, DoorStates, FloorPlan, Method, Openings, STEP_REACH, Target};
use orthoframe_map::{Area, Door, DoorState, Extent, Replica, World, Zone, ZoneKind};
use orthoframe_units::{AreaId, Cm, DoorId, Frame, OrFrId, Point, ReplicaId, ZoneId};

use crate::dice::{any, dice};

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
    let mut item = map.items.iter().find(|item| item.area == twin.id).expect("just found").clone();
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

fn same(world: &World, followed: &FloorPlan, anew: &FloorPlan, how: &str) {
    assert_eq!(followed.scene(), anew.scene(), "{how}");
    assert_eq!(followed.zones(), anew.zones(), "{how}");
    assert_eq!(followed.doorways(), anew.doorways(), "{how}");
    assert_eq!(followed.blind_openings(), anew.blind_openings(), "{how}");
    for (one, other) in followed.fragments().zip(anew.fragments()) {
        assert_eq!(one.area, other.area, "{how}");
        assert!(one == other, "{how}: {:?}", one.area);
    }
    assert_eq!(followed.fragments().len(), anew.fragments().len(), "{how}");
    assert_eq!(followed.open_doorways(), anew.open_doorways(), "{how}");
    // How all hangs together: of each Fragment the middle, from every other one.
    let middle = |bounds: &Bounds| bounds.min + (bounds.max - bounds.min) / 2.0;
    let middles: Vec<Point> = anew.fragments().map(|one| middle(&one.bounds)).collect();
    for from in &middles {
        for to in &middles {
            let joined = [followed, anew].map(|floor| floor.are_joined(*from, *to));
            assert_eq!(joined[0], joined[1], "{how}: {from} to {to}");
        }
    }
    for (from, to) in middles.iter().zip(middles.iter().skip(1)) {
        let [one, other] = [followed, anew]
            .map(|floor| floor.route(world, *from, Target::Point(*to), Method::Shortest));
        assert_eq!(format!("{one:?}"), format!("{other:?}"), "{how}: {from} to {to}");
    }
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
        let first = World::load(format!("../../maps/{map}.toml")).expect("a map of the project");
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
                let old = floor.clone();
                assert!(floor.follow_building(&before, &after, Some(&openings)));
                same(&after, floor, anew, &format!("{map}, step {step}"));
                let is_kept = |new: &&_| old.fragments().any(|old| std::ptr::eq(old, *new));
                kept += floor.fragments().filter(is_kept).count();
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

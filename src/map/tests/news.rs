//! The faults that an edit makes, against both maps checked whole.

use std::collections::BTreeSet;
use std::sync::Arc;

use orthoframe_map::{
    Area, DoorKind, DoorState, DoorStatus, Fault, MapErrors, NameIndex, Object, Orthoframe,
    Permeability, Place, Replica, World, check, news,
};
use orthoframe_units::{AreaId, Cm, Deg, DoorId, Frame, ObjectId, OrFrId, PlaceId, ReplicaId};

use crate::dice::{any, dice};

/// One edit of the building, sound or not.
fn rebuild(world: &mut World, throw: &mut impl FnMut(usize) -> usize) {
    let names: Vec<String> = world.names().map(|(_, name)| name.to_owned()).collect();
    let name = [names[throw(names.len())].clone(), format!("Имя-{}", throw(50))][throw(2)].clone();
    let (x, y) = (throw(600) as f64 - 300.0, throw(600) as f64 - 300.0);
    if world.areas.len() < 2
        || world.doors.is_empty()
        || world.maps.values().any(|map| map.items.is_empty())
    {
        return;
    }
    match throw(22) {
        0 => {
            let last = world.orthoframes.keys().next_back().expect("some").0;
            let part = any!(throw, world.orthoframes).clone();
            let (id, key) = (OrFrId(last + 1), format!("part-{}", throw(40)));
            world.orthoframes.insert(id, Orthoframe { id, key, ..part });
            let last = world.objects.keys().next_back().expect("some").0;
            let mut object = any!(throw, world.objects).clone();
            object.items.iter_mut().take(1).for_each(|item| item.orthoframe = id);
            let (id, key) = (ObjectId(last + 1), format!("object-{}", throw(40)));
            world.objects.insert(id, Object { id, key, name, ..object });
        }
        1 => any!(throw, world.orthoframes).height = Cm::of(throw(300) as f64 - 9.0),
        2 => {
            let part = any!(throw, world.orthoframes);
            if throw(2) == 0 {
                part.base.pop();
            } else {
                part.base[0].permeability = Permeability::Conditional;
            }
        }
        3 => any!(throw, world.objects).name = name,
        4 => any!(throw, world.areas).name = name,
        5 => any!(throw, world.doors).name = name,
        6 => any!(throw, world.areas).key = "kitchen".to_owned(),
        7 => drop(any!(throw, world.areas).properties.insert("ЦВЕТ".into(), name)),
        8 => {
            let id = PlaceId(900 + throw(9) as u32);
            let area = any!(throw, world.areas).id;
            let at = orthoframe_units::Point::new(x, y);
            let (name_en, forms) = (String::new(), Default::default());
            let place = Place { id, area, name, name_en, at, heading: None, serves: None, forms };
            world.places.insert(id, place);
        }
        9 => drop(world.places.pop_last()),
        10 | 11 => {
            let last = world.areas.keys().next_back().expect("some").0;
            let mut area = any!(throw, world.areas).clone();
            if throw(3) > 0 {
                area.doors.clear();
            }
            let (id, key) = (AreaId(last + 1), format!("area-{}", last + 1));
            let map = any!(throw, world.maps);
            let mut item = map.items[throw(map.items.len())].clone();
            (item.area, item.is_base) = (id, throw(9) == 0);
            let z = item.frame.z.get();
            item.frame = Frame::new(item.frame.x.get() + 9.0 * x, 9.0 * y, z, item.frame.angle);
            if throw(4) > 0 {
                map.items.push(item);
                // Linked as another is, or to what is no neighbour.
                for _ in 0..throw(3) {
                    if let Some(mut link) =
                        (!map.links.is_empty()).then(|| map.links[throw(map.links.len())].clone())
                    {
                        Arc::make_mut(&mut link).area = id;
                        let at = if throw(2) == 0 { map.links.len() } else { 0 };
                        map.links.insert(at, link);
                    }
                }
            }
            world.areas.insert(id, Area { id, key, name, ..area });
        }
        12 => {
            let map = any!(throw, world.maps);
            let at = throw(map.items.len());
            let item = &mut map.items[at];
            item.frame = Frame::new(x, y, item.frame.z.get(), item.frame.angle);
        }
        13 => {
            let id = any!(throw, world.areas).id;
            world.areas.remove(&id);
            if throw(4) > 0 {
                world.replicas.retain(|_, r| r.area != id);
                world.places.retain(|_, p| p.area != id);
                for map in world.maps.values_mut() {
                    map.items.retain(|item| item.area != id);
                    map.links.retain(|link| link.area != id && link.to_area != id);
                }
            }
        }
        14 => any!(throw, world.doors).width = Cm::of(throw(200) as f64 - 10.0),
        15 => any!(throw, world.doors).kind = DoorKind::Passage,
        16 => drop(any!(throw, world.areas).doors.pop()),
        17 => {
            let map = any!(throw, world.maps);
            match map.links.pop() {
                Some(mut link) if throw(2) == 0 => {
                    Arc::make_mut(&mut link).rel_x = Cm::of(x);
                    map.links.insert(0, link);
                }
                _ => {}
            }
        }
        18 => drop(any!(throw, world.objects).items.pop()),
        19 => any!(throw, world.doors).key = format!("door-{}", throw(6)),
        // An Area that stands twice.
        20 => {
            let map = any!(throw, world.maps);
            let mut item = map.items[throw(map.items.len())].clone();
            item.frame = Frame::new(x, [y, 1e9][throw(2)], 0.0, item.frame.angle);
            let at = throw(map.items.len() + 1);
            map.items.insert(at, item);
        }
        _ => {
            let used: BTreeSet<_> = world.replicas.values().map(|r| r.object).collect();
            world.objects.retain(|id, _| used.contains(id));
            world.robot.radius = Cm::of(throw(40) as f64 - 2.0);
        }
    }
}

/// One edit of things, sound or not.
fn alter(world: &mut World, throw: &mut impl FnMut(usize) -> usize) {
    let ids: Vec<ReplicaId> = world.replicas.keys().copied().collect();
    let [one, other] = [0, 1].map(|_| ids[throw(ids.len())]);
    let other = world.replicas[&other].clone();
    let doors: Vec<DoorId> = world.doors.keys().copied().collect();
    let door = doors[throw(doors.len())];
    let areas: Vec<AreaId> = world.areas.keys().copied().collect();
    let replica = world.replicas.get_mut(&one).expect("chosen among them");
    let (x, y) = (throw(900) as f64 - 200.0, throw(900) as f64 - 200.0);
    let z = [replica.frame.z.get(), throw(300) as f64 - 20.0][throw(2)];
    match throw(13) {
        0..=3 => replica.frame = Frame::new(x, y, z, Deg::of(throw(4) as f64 * 45.0)),
        4 => replica.area = areas[throw(areas.len())],
        5 => replica.name = [other.name, format!("Вещь-{}", throw(50))][throw(2)].clone(),
        6 => replica.name_en = [other.name_en, other.name][throw(2)].clone(),
        7 => drop(world.replicas.remove(&one)),
        8 => {
            let id = ReplicaId(ids[ids.len() - 1].0 + 1);
            let name = [other.name.clone(), format!("Вещь-{}", throw(50)), String::new()];
            let name = name[throw(3)].clone();
            world.replicas.insert(id, Replica { id, name, name_en: String::new(), ..other });
        }
        9 => replica.move_prob = throw(150) as u8,
        10 => {
            let id = [door, DoorId(9_999)][throw(2)];
            let opening = throw(130) as f64;
            let state = DoorState { status: DoorStatus::Open, opening };
            replica.door_states.insert(id, state);
        }
        11 => {
            let door = world.doors.get_mut(&door).expect("chosen among them");
            door.state.opening = throw(130) as f64;
        }
        _ => match throw(6) {
            0 => replica.object = ObjectId(9_999),
            1 => replica.area = AreaId(9_999),
            2 => world.places.values_mut().for_each(|p| p.serves = Some(one)),
            3 => world.areas.values_mut().for_each(|a| a.description.push('!')),
            _ => replica.object = other.object,
        },
    }
}

/// What an edit would spoil is found in what it changes as by checking the whole map, whatever was already odd in it.
#[test]
fn what_changed_is_checked_as_the_whole_is() {
    held_against_the_whole(|world, throw| alter(world, &mut |below| throw(below)), (50, 50, 100));
}

/// The same of the building.
#[test]
fn a_changed_building_is_checked_as_the_whole_is() {
    let alter = |world: &mut World, throw: &mut dyn FnMut(usize) -> usize| {
        let throw = &mut |below| throw(below);
        if throw(4) == 0 { alter(world, throw) } else { rebuild(world, throw) }
    };
    held_against_the_whole(alter, (50, 50, 100));
}

/// The same by checking both maps whole.
fn whole_news(before: &World, after: &World) -> Vec<Fault> {
    let known = check(before);
    check(after).into_iter().filter(|f| !known.iter().any(|k| k.error == f.error)).collect()
}

fn held_against_the_whole(
    alter: impl Fn(&mut World, &mut dyn FnMut(usize) -> usize),
    least: (usize, usize, usize),
) {
    for (seed, map) in ["../../maps/rb2.toml", "../../maps/lab.toml"].into_iter().enumerate() {
        let mut throw = dice(seed as u64 + 11);
        let first = World::load(map).expect("a map of the project");
        let (mut sound, mut faulty, mut odd) = (0, 0, 0);
        let mut before = first.clone();
        for step in 0..700 {
            let mut after = before.clone();
            for _ in 0..=throw(3) {
                alter(&mut after, &mut throw);
            }
            let found = news(&before, &after, || NameIndex::of(&before));
            assert_eq!(found, whole_news(&before, &after), "{map}, step {step}");
            odd += usize::from(!found.is_empty());
            if !(MapErrors { source: None, faults: check(&after) }).has_errors() {
                (before, sound) = (after, sound + 1);
            } else {
                faulty += 1;
            }
            if step % 100 == 99 || before.replicas.len() < 4 {
                before = first.clone();
            }
        }
        let found = (sound, faulty, odd);
        let is_enough = sound > least.0 && faulty > least.1 && odd > least.2;
        assert!(is_enough, "{map}: {found:?}");
    }
}

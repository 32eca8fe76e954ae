//! Relations that follow edits of their building against those derived anew.

use std::collections::BTreeSet;

use orthoframe_map::{Area, DoorState, Object, Orthoframe, Place, TypeKind, World};
use orthoframe_semantics::{RelationRules, Relations, Subject, derive};
use orthoframe_units::{AreaId, Cm, Deg, Frame, ObjectId, OrFrId, PlaceId, Point, ReplicaId};

use crate::dice::{any, dice};

fn shifted(frame: &Frame, by: (f64, f64)) -> Frame {
    Frame::new(frame.x.get() + by.0, frame.y.get() + by.1, frame.z.get(), frame.angle)
}

fn take_area_away(world: &mut World, id: AreaId) {
    world.areas.remove(&id);
    world.replicas.retain(|_, r| r.area != id);
    world.places.retain(|_, p| p.area != id);
    for map in world.maps.values_mut() {
        map.items.retain(|item| item.area != id);
        map.links.retain(|link| link.area != id && link.to_area != id);
    }
}

/// One edit of the building; it need not be a sound one.
fn alter(world: &mut World, throw: &mut impl FnMut(usize) -> usize) {
    let names: Vec<String> = world.names().map(|(_, name)| name.to_owned()).collect();
    let name = match throw(3) {
        0 => names[throw(names.len())].clone(),
        1 => world.objects.values().nth(throw(world.objects.len())).expect("some").name.clone(),
        _ => format!("Имя-{}", throw(40)),
    };
    let (x, y) = (throw(400) as f64 - 200.0, throw(400) as f64 - 200.0);
    match throw(22) {
        0 | 1 => {
            let last = world.orthoframes.keys().next_back().expect("some").0;
            let part = any!(throw, world.orthoframes).clone();
            let (id, key) = (OrFrId(last + 1), format!("part-{}", last + 1));
            let height = Cm::of(part.height.get() + 7.0);
            world
                .orthoframes
                .insert(id, Orthoframe { id, key, name: name.clone(), height, ..part });
            let last = world.objects.keys().next_back().expect("some").0;
            let mut object = any!(throw, world.objects).clone();
            object.items.iter_mut().take(1).for_each(|item| item.orthoframe = id);
            let (id, key) = (ObjectId(last + 1), format!("object-{}", last + 1));
            world.objects.insert(id, Object { id, key, name, ..object });
            let last = world.replicas.keys().next_back().expect("some").0;
            let twin = any!(throw, world.replicas).clone();
            let (new, name) = (ReplicaId(last + 1), format!("Новое-{last}"));
            let frame = shifted(&twin.frame, (x / 5.0, y / 5.0));
            let twin = orthoframe_map::Replica { id: new, object: id, name, frame, ..twin };
            world.replicas.insert(new, twin);
        }
        2 => any!(throw, world.orthoframes).height = Cm::of(20.0 + throw(200) as f64),
        3 => any!(throw, world.objects).name = name,
        4 => any!(throw, world.orthoframes).name = name,
        5 => any!(throw, world.areas).name = name,
        6 => any!(throw, world.doors).name = name,
        7 => drop(any!(throw, world.areas).properties.insert("ЦВЕТ".into(), name)),
        8 => drop(any!(throw, world.objects).properties.insert("ЦВЕТ".into(), name)),
        9 => drop(any!(throw, world.orthoframes).properties.insert("ЦВЕТ".into(), name)),
        10 => {
            let used: BTreeSet<_> = world.replicas.values().map(|r| r.object).collect();
            world.objects.retain(|id, _| used.contains(id));
            let areas = world.areas.values().flat_map(|a| &a.items);
            let items = world.objects.values().flat_map(|o| &o.items).chain(areas);
            let used: BTreeSet<_> = items.map(|item| item.orthoframe).collect();
            world.orthoframes.retain(|id, _| used.contains(id));
        }
        11 => {
            let id = PlaceId(900 + throw(50) as u32);
            let area = any!(throw, world.areas).id;
            let (name_en, forms) = (String::new(), Default::default());
            let at = Point::new(x, y);
            let place = Place { id, area, name, name_en, at, heading: None, serves: None, forms };
            world.places.insert(id, place);
        }
        12 => drop(world.places.pop_last()),
        13 | 14 => {
            let last = world.areas.keys().next_back().expect("some").0;
            let mut area = any!(throw, world.areas).clone();
            if throw(2) == 0 {
                area.doors.clear();
            }
            let (id, key) = (AreaId(last + 1), format!("area-{}", last + 1));
            let map = any!(throw, world.maps);
            let mut item = map.items[throw(map.items.len())].clone();
            item.area = id;
            item.frame = shifted(&item.frame, (4.0 * x, 4.0 * y));
            map.items.push(item);
            world.areas.insert(id, Area { id, key, name, ..area });
        }
        15 => {
            let map = any!(throw, world.maps);
            let at = throw(map.items.len());
            let by = (x / 20.0, y / 20.0);
            map.items[at].frame = shifted(&map.items[at].frame, by);
        }
        16 if world.areas.len() > 3 => {
            let id = any!(throw, world.areas).id;
            take_area_away(world, id);
        }
        17 => {
            let door = any!(throw, world.doors);
            match throw(3) {
                0 => door.width = Cm::of(door.width.get() * 0.9),
                1 => door.state = DoorState::CLOSED,
                _ => drop(door.properties.insert("ЦВЕТ".into(), name)),
            }
        }
        18 => drop(any!(throw, world.areas).doors.pop()),
        19 => {
            let map = any!(throw, world.maps);
            match map.links.pop() {
                Some(link) if throw(2) == 0 => map.links.insert(0, link),
                _ => {}
            }
        }
        20 => {
            let list = world.types.list_mut(TypeKind::Object);
            let count = list.entries.len().max(1);
            if let Some(entry) = list.entries.values_mut().nth(throw(count)) {
                entry.traits.push(["container", "portable"][throw(2)].to_owned());
            }
        }
        _ => {
            let object = any!(throw, world.objects).id;
            let replica = any!(throw, world.replicas);
            if throw(2) == 0 {
                replica.object = object;
            }
            replica.frame = Frame::new(x, y, replica.frame.z.get(), Deg::of(x));
        }
    }
}

fn same(followed: &Relations, anew: &Relations, world: &World, how: &str) {
    for (_, info) in anew.derived().relations() {
        let rows = |relations: &Relations| -> BTreeSet<String> {
            let tuples = relations.derived().tuples(&*info.name);
            tuples.into_iter().flatten().map(|t| format!("{:?}", t.values())).collect()
        };
        let [one, other] = [rows(followed), rows(anew)];
        let differs: Vec<_> = one.symmetric_difference(&other).take(6).collect();
        assert!(differs.is_empty(), "{how}, {}: {differs:?}", info.name);
    }
    assert_eq!(followed.openings(), anew.openings(), "{how}");
    assert!(followed.measurements() == anew.measurements(), "{how}");
    for subject in world.objects.keys().map(|id| Subject::Object(*id)) {
        let [one, other] = [followed, anew].map(|relations| relations.symbols().known(subject));
        assert_eq!(one, other, "{how}");
    }
    // All that is looked up by a thing or a room.
    let of_thing = |relations: &Relations, id: ReplicaId| {
        let borne: BTreeSet<ReplicaId> = relations.borne_by(id).collect();
        let bears = (borne, relations.bears_something(id), relations.goes_with(id));
        let within = (relations.lies_on_or_in(id), relations.shut_in(id));
        (relations.area_of(id), relations.support_of(id), bears, within)
    };
    for id in world.replicas.keys() {
        assert_eq!(of_thing(followed, *id), of_thing(anew, *id), "{how}");
    }
    for id in world.areas.keys() {
        assert_eq!(followed.on_floor_of(*id), anew.on_floor_of(*id), "{how}");
    }
    assert_eq!(followed.all_shut_in(), anew.all_shut_in(), "{how}");
}

/// Whatever is built, rebuilt, taken away or called otherwise: followed, all is as derived anew.
#[test]
fn an_edited_building_is_followed() {
    let rules = RelationRules::standard();
    for (seed, map) in ["rb2", "lab", "two-storeys"].into_iter().enumerate() {
        let mut throw = dice(seed as u64 + 5);
        let first = World::load(format!("../../maps/{map}.toml")).expect("a map of the project");
        let anew =
            |world: &World| derive(world, &rules, world.domain.profile).expect("the rules end");
        let (mut before, mut relations) = (first.clone(), anew(&first));
        let mut followed = 0;
        const STEPS: usize = 40;
        for step in 0..STEPS {
            let mut after = before.clone();
            for _ in 0..=throw(2) {
                alter(&mut after, &mut throw);
            }
            let how = format!("{map}, step {step}");
            let fresh = anew(&after);
            if relations.follow_world(&before, &after).expect("the rules end") {
                same(&relations, &fresh, &after, &how);
                followed += usize::from(!before.is_same_building(&after));
            } else {
                relations = fresh;
            }
            before = after;
            if step % 20 == 19 {
                (before, relations) = (first.clone(), anew(&first));
            }
        }
        assert!(followed > STEPS / 2, "{map}: {followed} of {STEPS}");
    }
}

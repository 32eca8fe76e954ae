//! Worlds made from others: renamed, mirrored, turned, with a room more. What works for one must work for all.

use std::collections::BTreeMap;
use std::sync::Arc;

use orthoframe_map::{
    Area, BaseVector, Door, DoorKind, DoorLeaf, DoorMount, DoorState, Entity, HingeSide, Item,
    MapItem, MapLink, OpensTo, Orthoframe, Permeability, Place, Replica, SideRef, World, check,
};
use orthoframe_units::{
    AreaId, Cm, Deg, DoorId, Frame, MapId, ObjectId, OrFrId, PlaceId, Point, ReplicaId,
};

/// The papers' flat.
pub(crate) fn rb2() -> World {
    World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml")).expect("rb2 is sound")
}

/// Every Map, Area, Door and Place under another name, in both languages. Replicas keep theirs.
pub(crate) fn renamed(world: &World) -> World {
    let mut world = world.clone();
    for map in world.maps.values_mut() {
        (map.name, map.name_en) = (format!("План-{}", map.id.0), format!("Plan {}", map.id.0));
    }
    for area in world.areas.values_mut() {
        let id = area.id.0;
        (area.name, area.name_en) = (format!("Палата-{id}0{id}"), format!("Ward {id}0{id}"));
        area.forms.clear();
    }
    for door in world.doors.values_mut() {
        let id = door.id.0;
        (door.name, door.name_en) = (format!("Дверь-{id}00"), format!("Door {id}00"));
        door.forms.clear();
    }
    for place in world.places.values_mut() {
        let id = place.id.0;
        (place.name, place.name_en) = (format!("Место-{id}"), format!("Spot {id}"));
        place.forms.clear();
    }
    world
}

/// Everything seen in a mirror that stands on the y axis: x becomes -x, left becomes right.
///
/// Sides keep their ids, so links and mounts stay as they are. Linked sides must be of equal length.
pub(crate) fn mirrored(world: &World) -> World {
    let mut world = world.clone();
    let flip_frame = |f: &mut Frame| (f.x, f.angle) = (-f.x, -f.angle);
    for frame in world.orthoframes.values_mut() {
        // Mirrored vectors run clockwise: turn each round, and their order too.
        for v in &mut frame.base {
            (v.start, v.end) =
                (Point::new(0.0 - v.end.x, v.end.y), Point::new(0.0 - v.start.x, v.start.y));
        }
        frame.base.reverse();
    }
    for object in world.objects.values_mut() {
        object.items.iter_mut().for_each(|item| flip_frame(&mut item.frame));
        object.links.iter_mut().for_each(|l| (l.rel_x, l.rel_a) = (-l.rel_x, -l.rel_a));
    }
    for area in world.areas.values_mut() {
        area.items.iter_mut().for_each(|item| flip_frame(&mut item.frame));
        area.links.iter_mut().for_each(|l| (l.rel_x, l.rel_a) = (-l.rel_x, -l.rel_a));
    }
    for map in world.maps.values_mut() {
        map.items.iter_mut().for_each(|item| flip_frame(&mut item.frame));
        for link in map.links.iter_mut().map(Arc::make_mut) {
            (link.rel_x, link.rel_a) = (-link.rel_x, -link.rel_a);
        }
    }
    world.domain.maps.iter_mut().for_each(|item| flip_frame(&mut item.frame));
    world.replicas.values_mut().for_each(|replica| flip_frame(&mut replica.frame));
    for place in world.places.values_mut() {
        place.at.x = 0.0 - place.at.x;
        place.heading = place.heading.map(|heading| Deg::of(180.0) - heading);
    }
    for door in world.doors.values_mut() {
        door.leaves.reverse();
        for leaf in &mut door.leaves {
            leaf.hinge = match leaf.hinge {
                HingeSide::Right => HingeSide::Left,
                HingeSide::Left => HingeSide::Right,
            };
        }
    }
    world
}

/// Every Map turned about its origin.
pub(crate) fn rotated(world: &World, angle: Deg) -> World {
    let mut world = world.clone();
    let turn = Frame { angle, ..Frame::IDENTITY };
    for map in world.maps.values_mut() {
        map.items.iter_mut().for_each(|item| item.frame = turn.compose(&item.frame));
        for link in map.links.iter_mut().map(Arc::make_mut) {
            let rel = turn.apply(Point::new(link.rel_x.get(), link.rel_y.get()));
            (link.rel_x, link.rel_y) = (Cm::of(rel.x), Cm::of(rel.y));
        }
    }
    world
}

/// Every room and thing under the name of its kind alone: «Комната», «Стул», as in a building that nobody numbered.
pub(crate) fn unnumbered(world: &World) -> World {
    let mut world = world.clone();
    let bare = |name: &mut String| {
        let cut = name.find(['-', ' ']).filter(|cut| name[*cut + 1..].chars().count() < 3);
        name.truncate(cut.unwrap_or(name.len()));
    };
    for area in world.areas.values_mut() {
        [&mut area.name, &mut area.name_en].into_iter().for_each(bare);
        area.forms.clear();
    }
    for replica in world.replicas.values_mut() {
        [&mut replica.name, &mut replica.name_en].into_iter().for_each(bare);
        replica.forms.clear();
    }
    world
}

/// The only Map twice, one floor above the other: all names but those of the floors and doors are borne twice.
pub(crate) fn doubled(world: &World) -> World {
    const ABOVE: u32 = 10_000;
    let mut world = world.clone();
    let map = world.maps.values_mut().next().expect("a Map");
    (map.name, map.name_en) = ("Первый этаж".into(), "First floor".into());
    let mut above = map.clone();
    above.id = MapId(map.id.0 + ABOVE);
    (above.name, above.name_en) = ("Второй этаж".into(), "Second floor".into());
    above.key.push_str("-2");
    above.items.iter_mut().for_each(|item| item.area.0 += ABOVE);
    for link in above.links.iter_mut().map(Arc::make_mut) {
        (link.area.0, link.to_area.0) = (link.area.0 + ABOVE, link.to_area.0 + ABOVE);
    }
    world.maps.insert(above.id, above);
    for area in world.areas.clone().into_values() {
        let mut area = Area { id: AreaId(area.id.0 + ABOVE), ..area };
        area.key.push_str("-2");
        area.doors.iter_mut().for_each(|mount| mount.door.0 += ABOVE);
        world.areas.insert(area.id, area);
    }
    for door in world.doors.clone().into_values() {
        let id = DoorId(door.id.0 + ABOVE);
        let name = format!("{}0", door.name);
        let name_en = format!("{}0", door.name_en);
        world.doors.insert(id, Door { id, name, name_en, forms: Default::default(), ..door });
    }
    for replica in world.replicas.clone().into_values() {
        let (id, area) = (ReplicaId(replica.id.0 + ABOVE), AreaId(replica.area.0 + ABOVE));
        world.replicas.insert(id, Replica { id, area, ..replica });
    }
    world
}

/// The papers' flat with a fifth room, Комната-X, behind a new door in the east wall of the corridor.
pub(crate) fn rb2_with_fifth_room() -> World {
    let mut world = rb2();
    let corridor = area_named(&world, "Коридор");
    let [Entity::Map(map)] = world.find("Квартира РБ-2")[..] else { panic!("one flat") };
    let side_of_door = split_east_wall(&mut world, corridor);

    let room = AreaId(next_id(world.areas.keys().map(|id| id.0)));
    let room_frame = OrFrId(next_id(world.orthoframes.keys().map(|id| id.0)));
    let door = DoorId(next_id(world.doors.keys().map(|id| id.0)));
    let corners = [(0, 0), (300, 0), (300, 420), (0, 420), (0, 160), (0, 70)];
    let corners = corners.map(|(x, y)| Point::new(f64::from(x), f64::from(y)));
    let mut base: Vec<_> = (0..corners.len())
        .map(|i| wall(&"ABCDEF"[i..=i], corners[i], corners[(i + 1) % corners.len()]))
        .collect();
    base[4].permeability = Permeability::Conditional;
    let like = &world.orthoframes[&world.areas[&corridor].items[0].orthoframe];
    let frame = Orthoframe {
        id: room_frame,
        key: "room-x".into(),
        name: "Пол Комнаты-X".into(),
        base,
        ..like.clone()
    };
    world.orthoframes.insert(room_frame, frame);
    world.doors.insert(door, hinged_door(door));
    world.areas.insert(room, fifth_room(room, room_frame, door));
    let mount = |side: &str, opens| DoorMount { item: "A".into(), side: side.into(), door, opens };
    let corridor_doors = &mut world.areas.get_mut(&corridor).expect("rb2 has a corridor").doors;
    corridor_doors.push(mount(&side_of_door, OpensTo::Outside));
    furnish(&mut world, room);
    bind(&mut world, map, corridor, &side_of_door, room);
    world
}

pub(crate) fn area_named(world: &World, name: &str) -> AreaId {
    match world.find(name)[..] {
        [Entity::Area(area)] => area,
        _ => panic!("no Area, or not one alone, is called {name}"),
    }
}

fn next_id(numbers: impl Iterator<Item = u32>) -> u32 {
    numbers.max().unwrap_or(0) + 1
}

fn wall(id: &str, start: Point, end: Point) -> BaseVector {
    BaseVector {
        id: id.into(),
        start,
        end,
        side_type: None,
        permeability: Permeability::Impermeable,
        names: Vec::new(),
        properties: BTreeMap::new(),
    }
}

/// Makes room for a door at y 70..160 of the corridor's east wall; gives the id of the new side.
fn split_east_wall(world: &mut World, corridor: AreaId) -> String {
    let frame = world.areas[&corridor].items[0].orthoframe;
    let base = &mut world.orthoframes.get_mut(&frame).expect("the corridor has a base").base;
    let at = base.iter().position(|v| v.id == "D").expect("the corridor has an east wall");
    let (foot, top) = (base[at].start, base[at].end);
    let [low, high] = [70.0, 160.0].map(|y| Point::new(foot.x, y));
    let mut door = wall("D2", low, high);
    door.permeability = Permeability::Conditional;
    base.splice(at..=at, [wall("D1", foot, low), door, wall("D3", high, top)]);
    "D2".into()
}

fn hinged_door(id: DoorId) -> Door {
    Door {
        id,
        key: "kx".into(),
        name: "Дверь-КX".into(),
        name_en: "Door KX".into(),
        door_type: None,
        kind: DoorKind::Hinged,
        width: Cm::of(90.0),
        height: Cm::of(205.0),
        leaves: vec![DoorLeaf {
            hinge: HingeSide::Right,
            share: 1.0,
            thickness: Cm::of(4.0),
            max_open: 90.0,
        }],
        state: DoorState::OPEN,
        properties: BTreeMap::new(),
        forms: BTreeMap::new(),
    }
}

fn fifth_room(id: AreaId, orthoframe: OrFrId, door: DoorId) -> Area {
    let frame = Frame::IDENTITY;
    Area {
        id,
        key: "room-x".into(),
        name: "Комната-X".into(),
        name_en: "Room X".into(),
        description: String::new(),
        area_type: None,
        items: vec![Item { id: "A".into(), orthoframe, frame, is_base: true }],
        links: Vec::new(),
        doors: vec![DoorMount { item: "A".into(), side: "E".into(), door, opens: OpensTo::Inside }],
        properties: BTreeMap::new(),
        forms: BTreeMap::new(),
    }
}

/// A bed, a bedside table and a place to serve it from.
fn furnish(world: &mut World, area: AreaId) {
    let object = |world: &World, key: &str| -> ObjectId {
        world.objects.values().find(|o| o.key == key).expect("an Object of rb2").id
    };
    for (key, name, name_en, x, y) in [
        ("bed", "Кровать-2", "Bed 2", 100.0, 220.0),
        ("bedside", "Тумбочка-3", "Bedside table 3", 50.0, 375.0),
    ] {
        let id = ReplicaId(next_id(world.replicas.keys().map(|id| id.0)));
        let replica = Replica {
            id,
            area,
            object: object(world, key),
            name: name.into(),
            name_en: name_en.into(),
            frame: Frame::new(x, y, 0.0, Deg::ZERO),
            move_prob: 0,
            properties: BTreeMap::new(),
            door_states: BTreeMap::new(),
            forms: BTreeMap::new(),
        };
        world.replicas.insert(id, replica);
    }
    let id = PlaceId(next_id(world.places.keys().map(|id| id.0)));
    let place = Place {
        id,
        area,
        name: "Точка-Х5".into(),
        name_en: "Point X5".into(),
        at: Point::new(200.0, 120.0),
        heading: None,
        serves: None,
        forms: BTreeMap::new(),
    };
    world.places.insert(id, place);
}

fn bind(world: &mut World, map: MapId, corridor: AreaId, east: &str, room: AreaId) {
    let (_, frame) = world.placement(corridor).expect("the corridor stands on the map");
    let side = |side: &str| SideRef { item: "A".into(), side: side.into() };
    let map = world.maps.get_mut(&map).expect("rb2 has a map");
    let at = frame.compose(&Frame::new(160.0, 0.0, 0.0, Deg::ZERO));
    map.items.push(MapItem { area: room, frame: at, is_base: false });
    map.links.push(Arc::new(MapLink {
        area: corridor,
        side: side(east),
        to_area: room,
        to_side: side("E"),
        rel_x: Cm::ZERO,
        rel_y: Cm::ZERO,
        rel_z: Cm::ZERO,
        rel_a: Deg::ZERO,
    }));
}

/// All the worlds that a capability should work in, with a word for messages.
pub(crate) fn variants() -> Vec<(&'static str, World)> {
    let rb2 = rb2();
    vec![
        ("renamed", renamed(&rb2)),
        ("mirrored", mirrored(&rb2)),
        ("turned by 90", rotated(&rb2, Deg::of(90.0))),
        ("turned by 33", rotated(&rb2, Deg::of(33.0))),
        ("mirrored, renamed and turned by 200", rotated(&renamed(&mirrored(&rb2)), Deg::of(200.0))),
        ("with a fifth room", rb2_with_fifth_room()),
        ("as it is", rb2),
    ]
}

#[test]
fn every_variant_is_sound() {
    for (how, world) in variants() {
        let faults = check(&world);
        assert!(faults.is_empty(), "{how}: {faults:#?}");
    }
}

#[test]
fn a_mirror_in_a_mirror_shows_the_thing_itself() {
    for (how, world) in variants() {
        assert_eq!(mirrored(&mirrored(&world)), world, "{how}");
        assert_ne!(mirrored(&world), world, "{how}");
    }
}

#[test]
fn four_quarter_turns_are_none() {
    let quarter = |world: &World| rotated(world, Deg::of(90.0));
    let world = rb2();
    assert_ne!(quarter(&world), world);
    assert_eq!(quarter(&quarter(&quarter(&quarter(&world)))), world);
}

#[test]
fn no_old_name_of_room_or_door_is_left() {
    let (old, new) = (rb2(), renamed(&rb2()));
    for (entity, name) in old.names() {
        let is_kept = matches!(entity, Entity::Replica(_));
        assert_eq!(new.find(name).is_empty(), !is_kept, "{name}");
    }
}

#[test]
fn a_mirrored_door_opens_on_the_other_side() {
    let (world, mirrored) = (rb2(), mirrored(&rb2()));
    for door in world.area_doors() {
        for area in world.door_areas(door.id) {
            let (right, left) = world.threshold(area, door.id).expect("mounted there");
            let twin = mirrored.threshold(area, door.id).expect("mounted there");
            let flip = |p: Point| Point::new(-p.x, p.y);
            assert_eq!(twin, (flip(left), flip(right)));
        }
    }
}

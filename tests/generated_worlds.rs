//! Worlds made at random, sound by construction: for properties that must hold of every map.

use std::collections::BTreeMap;
use std::sync::Arc;

use orthoframe_map::{
    Area, BaseVector, Case, Domain, DomainMap, Door, DoorKind, DoorLeaf, DoorMount, DoorState,
    Face, Gender, HingeSide, Item, ItemLink, LiftStop, Map, MapItem, MapLink, Object, OpensTo,
    Orthoframe, Permeability, Place, Profile, Properties, Replica, RobotProfile, SideRef,
    TypeEntry, TypeKind, TypeLists, World,
};
use orthoframe_units::{
    AreaId, Cm, Deg, DomainId, DoorId, Frame, MapId, ObjectId, OrFrId, PlaceId, Point, ReplicaId,
    TypeId,
};

/// Rooms are boxes of this size with openings between these heights of their sides.
const ROOM: f64 = 500.0;
const OPENING: (f64, f64) = (100.5, 212.25);

/// Random numbers from a seed (xorshift).
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 33) as usize % limit.max(1)
    }

    fn chance(&mut self) -> bool {
        self.below(2) == 0
    }

    /// A number with up to four decimals, or none.
    fn number(&mut self, low: f64, high: f64) -> f64 {
        let steps = [1.0, 10.0, 1e4][self.below(3)];
        let value = low + (high - low) * self.below(100_001) as f64 / 1e5;
        (value * steps).round() / steps
    }

    fn word(&mut self) -> String {
        const LETTERS: [char; 24] = [
            'а', 'Ё', 'й', 'Z', 'q', '-', '_', ' ', '"', '\'', '\\', '#', '=', '{', ']', '\n',
            '\t', '😀', '«', '\u{301}', '7', '\u{7f}', '\r', ':',
        ];
        (0..self.below(8)).map(|_| LETTERS[self.below(LETTERS.len())]).collect()
    }

    fn text(&mut self) -> String {
        if self.chance() { String::new() } else { self.word() }
    }

    fn properties(&mut self) -> Properties {
        (0..self.below(3)).map(|_| (self.word(), self.word())).collect()
    }

    fn forms(&mut self) -> BTreeMap<Case, String> {
        let cases = [Case::Nominative, Case::Genitive, Case::Prepositional];
        (0..self.below(3)).map(|_| (cases[self.below(3)], self.word())).collect()
    }

    /// Ascending ids with holes.
    fn ids(&mut self, count: usize) -> Vec<u32> {
        let mut last = 0;
        (0..count)
            .map(|_| {
                last += 1 + if self.below(4) == 0 { self.below(5) as u32 } else { 0 };
                last
            })
            .collect()
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> Option<T> {
        (!from.is_empty() && self.chance()).then(|| from[self.below(from.len())])
    }
}

/// A world that every seed determines.
pub(crate) fn world(seed: u64) -> World {
    let mut dice = Dice::new(seed);
    let mut world = World {
        domain: Domain {
            id: DomainId(1 + dice.below(3) as u32),
            key: ["domain", "дом", "house 1"][dice.below(3)].into(),
            name: dice.word() + "дом",
            name_en: dice.text(),
            description: dice.text(),
            profile: Profile::ALL[dice.below(2)],
            maps: Vec::new(),
            lifts: Vec::new(),
        },
        types: types(&mut dice),
        robot: RobotProfile { radius: Cm::of(dice.number(10.0, 40.0)), ..Default::default() },
        ..World::empty()
    };
    orthoframes(&mut world, &mut dice);
    objects(&mut world, &mut dice);
    rooms(&mut world, &mut dice);
    fill(&mut world, &mut dice);
    world
}

fn types(dice: &mut Dice) -> TypeLists {
    let mut types = TypeLists::default();
    for kind in TypeKind::ALL {
        let count = dice.below(4);
        for id in dice.ids(count) {
            let entry = TypeEntry {
                id: TypeId(id),
                name: format!("{}тип {id}", dice.word()),
                name_en: dice.text(),
                description: dice.text(),
                gender: dice.pick(&[Gender::Masculine, Gender::Feminine, Gender::Neuter]),
                animate: dice.chance(),
                synonyms: (0..dice.below(3)).map(|_| dice.word()).collect(),
                forms: dice.forms(),
                traits: (0..dice.below(3)).map(|_| dice.word()).collect(),
            };
            types.list_mut(kind).entries.insert(TypeId(id), entry);
        }
    }
    types
}

fn type_ids(world: &World, kind: TypeKind) -> Vec<TypeId> {
    world.types.list(kind).entries.keys().copied().collect()
}

/// Star-shaped bases, some given by letters, some with ids of their own.
fn orthoframes(world: &mut World, dice: &mut Dice) {
    let count = 1 + dice.below(5);
    for id in dice.ids(count) {
        let corners = 3 + dice.below(6);
        let step = std::f64::consts::TAU / corners as f64;
        let round = |x: f64| (x * 1e4).round() / 1e4;
        let corner = |i: usize, radius: f64| {
            let (sin, cos) = (step * i as f64).sin_cos();
            Point::new(round(radius * cos), round(radius * sin))
        };
        let raw: Vec<_> = (0..corners).map(|i| corner(i, dice.number(20.0, 40.0))).collect();
        let origin = raw[0];
        let points: Vec<_> = raw.iter().map(|p| Point::from(p - origin)).collect();
        let lettered = dice.chance();
        let name = |i: usize| {
            if lettered {
                char::from(b'A' + i as u8).to_string()
            } else {
                format!("грань \"{i}\"")
            }
        };
        let sides = type_ids(world, TypeKind::Side);
        let base = (0..corners)
            .map(|i| BaseVector {
                id: name(i),
                start: points[i],
                end: points[(i + 1) % corners],
                side_type: dice.pick(&sides),
                permeability: dice
                    .pick(&[Permeability::Permeable])
                    .unwrap_or(Permeability::Impermeable),
                names: (0..dice.below(3)).map(|_| dice.word()).collect(),
                properties: dice.properties(),
            })
            .collect();
        let id = OrFrId(id);
        let frame_types = type_ids(world, TypeKind::Orthoframe);
        let shapes = type_ids(world, TypeKind::Shape);
        let frame = Orthoframe {
            id,
            key: format!("фигура {}\"", id.0),
            name: format!("фигура {}\"", id.0) + &dice.text(),
            name_en: dice.text(),
            description: dice.text(),
            frame_type: dice.pick(&frame_types),
            shape: dice.pick(&shapes),
            base,
            height: Cm::of(dice.number(0.0, 60.0)),
            base_permeability: Permeability::Impermeable,
            roof_permeability: dice.pick(&[Permeability::Permeable]).unwrap_or_default(),
            roof_scale: if dice.chance() { 1.0 } else { dice.number(0.1, 2.0) },
            properties: dice.properties(),
        };
        world.orthoframes.insert(id, frame);
    }
}

/// Columns of Orthoframes, each linked to the one below.
fn objects(world: &mut World, dice: &mut Dice) {
    let shapes: Vec<OrFrId> = world.orthoframes.keys().copied().collect();
    let kinds = type_ids(world, TypeKind::Object);
    let count = 1 + dice.below(4);
    for id in dice.ids(count) {
        let first = shapes[dice.below(shapes.len())];
        let mut items =
            vec![Item { id: "A".into(), orthoframe: first, frame: Frame::IDENTITY, is_base: true }];
        let mut links = Vec::new();
        for i in 1..=dice.below(3) {
            let below = items.last().expect("the first is there").clone();
            let height = world.orthoframes[&below.orthoframe].height;
            let frame = Frame {
                x: Cm::of(dice.number(-5.0, 5.0)),
                y: Cm::of(dice.number(-5.0, 5.0)),
                z: below.frame.z + height,
                angle: Deg::of(dice.number(0.0, 359.0)),
            };
            links.push(ItemLink {
                item: below.id,
                face: Face::Roof,
                to_item: format!("часть {i}"),
                to_face: Face::Base,
                rel_x: frame.x - below.frame.x,
                rel_y: frame.y - below.frame.y,
                rel_z: Cm::ZERO,
                rel_a: frame.angle - below.frame.angle,
            });
            let orthoframe = shapes[dice.below(shapes.len())];
            items.push(Item { id: format!("часть {i}"), orthoframe, frame, is_base: false });
        }
        // The base item need not be the first.
        if dice.chance() {
            items.rotate_left(1);
        }
        let side = |side: &BaseVector| SideRef { item: "A".into(), side: side.id.clone() };
        let base = &world.orthoframes[&first].base;
        let object = Object {
            id: ObjectId(id),
            key: format!("вещь-{id}"),
            name: dice.word() + "вещь",
            name_en: dice.text(),
            description: dice.text(),
            object_type: dice.pick(&kinds),
            links,
            front: dice.chance().then(|| side(&base[0])),
            back: dice.chance().then(|| side(&base[1])),
            doors: Vec::new(),
            properties: dice.properties(),
            items,
        };
        world.objects.insert(object.id, object);
    }
}

/// One or two floors, each a row of rooms with a door or passage between neighbours, and a lift between floors.
fn rooms(world: &mut World, dice: &mut Dice) {
    let floors = 1 + dice.below(2);
    let mut lift = Vec::new();
    for floor in dice.ids(floors) {
        let count = 1 + dice.below(3);
        let mut map = Map {
            id: MapId(floor),
            key: format!("этаж.{floor}").replace('.', "-"),
            name: format!("Этаж-{floor}"),
            name_en: format!("Floor {floor}"),
            description: dice.text(),
            map_type: dice.pick(&type_ids(world, TypeKind::Map)),
            frame: dice.text(),
            items: Vec::new(),
            links: Vec::new(),
        };
        // Every joint opens in its own way.
        let joints: Vec<_> = (1..count).map(|_| hang(world, dice)).collect();
        let first = world.areas.keys().last().map_or(0, |id| id.0);
        for i in 0..count {
            let id = AreaId(first + 1 + i as u32);
            let west = i.checked_sub(1).map(|j| joints[j]);
            let east = joints.get(i).copied();
            let room = room(world, dice, id, west, east);
            world.areas.insert(id, room);
            let at = Frame::new(ROOM * i as f64, 0.0, 0.0, Deg::ZERO);
            map.items.push(MapItem { area: id, frame: at, is_base: i == 0 });
            if i > 0 {
                map.links.push(Arc::new(joint(AreaId(id.0 - 1), id)));
            }
        }
        lift.push(LiftStop { area: AreaId(first + 1) });
        let frame = match lift.len() {
            1 => Frame::IDENTITY,
            _ => Frame::new(dice.number(-9.0, 9.0), 0.0, 300.0, Deg::of(dice.number(0.0, 90.0))),
        };
        world.domain.maps.push(DomainMap { map: map.id, frame, is_base: lift.len() == 1 });
        world.maps.insert(map.id, map);
    }
    if lift.len() > 1 {
        world.domain.lifts.push((dice.word(), lift));
        if dice.chance() {
            world.domain.maps.reverse();
        }
    }
}

/// A door or passage that fits the openings.
fn hang(world: &mut World, dice: &mut Dice) -> (DoorId, DoorKind) {
    let id = DoorId(world.doors.keys().last().map_or(0, |id| id.0) + 1 + dice.below(2) as u32);
    let kind = [DoorKind::Hinged, DoorKind::Sliding, DoorKind::Passage][dice.below(3)];
    let leaf = |share| DoorLeaf {
        hinge: [HingeSide::Right, HingeSide::Left][usize::from(share > 0.4)],
        share,
        thickness: Cm::of(4.5),
        max_open: 95.5,
    };
    let shares: &[f64] = match kind {
        DoorKind::Passage => &[],
        _ => [&[1.0][..], &[0.25, 0.75]][dice.below(2)],
    };
    let states =
        [DoorState::OPEN, DoorState::CLOSED, DoorState { opening: 33.3, ..DoorState::OPEN }];
    let door = Door {
        id,
        key: format!("дверь {}", id.0),
        name: format!("Дверь-{}", id.0),
        name_en: if dice.chance() { format!("Door {}", id.0) } else { Default::default() },
        door_type: dice.pick(&type_ids(world, TypeKind::Door)),
        kind,
        width: Cm::of(dice.number(60.0, 110.0)),
        height: Cm::of(dice.number(190.0, 220.0)),
        leaves: shares.iter().map(|&share| leaf(share)).collect(),
        state: if kind == DoorKind::Passage { DoorState::OPEN } else { states[dice.below(3)] },
        properties: dice.properties(),
        forms: dice.forms(),
    };
    world.doors.insert(id, door);
    (id, kind)
}

type Joint = Option<(DoorId, DoorKind)>;

fn room(world: &mut World, dice: &mut Dice, id: AreaId, west: Joint, east: Joint) -> Area {
    let (low, high) = OPENING;
    let corners = [
        (0., 0.),
        (ROOM, 0.),
        (ROOM, low),
        (ROOM, high),
        (ROOM, ROOM),
        (0., ROOM),
        (0., high),
        (0., low),
    ];
    let point = |i: usize| Point::new(corners[i % 8].0, corners[i % 8].1);
    let opens = |joint: Joint| match joint {
        Some((_, DoorKind::Passage)) => Permeability::Permeable,
        Some(_) => Permeability::Conditional,
        None => Permeability::Impermeable,
    };
    let base = (0..8).map(|i| BaseVector {
        id: char::from(b'A' + i as u8).to_string(),
        start: point(i),
        end: point(i + 1),
        side_type: None,
        permeability: match i {
            2 => opens(east),
            6 => opens(west),
            _ => Permeability::Impermeable,
        },
        names: Vec::new(),
        properties: BTreeMap::new(),
    });
    let orthoframe = OrFrId(world.orthoframes.keys().last().map_or(1, |id| id.0 + 1));
    let like = world.orthoframes.values().next().expect("there are figures");
    let frame = Orthoframe {
        id: orthoframe,
        key: format!("room-{}", id.0),
        name: format!("room-{}", id.0),
        base: base.collect(),
        height: Cm::of(270.0),
        roof_scale: 1.0,
        ..like.clone()
    };
    world.orthoframes.insert(orthoframe, frame);
    let mount = |(joint, side, opens): (Joint, &str, OpensTo)| {
        joint.map(|(door, _)| DoorMount { item: "пол".into(), side: side.into(), door, opens })
    };
    let mounts = [(west, "G", OpensTo::Inside), (east, "C", OpensTo::Outside)];
    Area {
        id,
        key: format!("area {}", id.0),
        name: format!("{}Комната-{}", dice.word(), id.0),
        name_en: String::new(),
        description: dice.text(),
        area_type: dice.pick(&type_ids(world, TypeKind::Area)),
        items: vec![Item {
            id: "пол".into(), orthoframe, frame: Frame::IDENTITY, is_base: true
        }],
        links: Vec::new(),
        doors: mounts.into_iter().filter_map(mount).collect(),
        properties: dice.properties(),
        forms: dice.forms(),
    }
}

fn joint(area: AreaId, to_area: AreaId) -> MapLink {
    let side = |side: &str| SideRef { item: "пол".into(), side: side.into() };
    let zero = Cm::ZERO;
    MapLink {
        area,
        side: side("C"),
        to_area,
        to_side: side("G"),
        rel_x: zero,
        rel_y: zero,
        rel_z: zero,
        rel_a: Deg::ZERO,
    }
}

/// Replicas and places, their ids not in the order of the rooms.
fn fill(world: &mut World, dice: &mut Dice) {
    let areas: Vec<_> = world.areas.keys().copied().collect();
    let objects: Vec<_> = world.objects.keys().copied().collect();
    let count = dice.below(8);
    for id in dice.ids(count) {
        let replica = Replica {
            id: ReplicaId(id),
            area: areas[dice.below(areas.len())],
            object: objects[dice.below(objects.len())],
            name: format!("{}вещь-{id}", dice.word()),
            name_en: String::new(),
            frame: Frame::new(
                dice.number(150.0, 350.0),
                dice.number(150.0, 350.0),
                if dice.chance() { 0.0 } else { dice.number(0.0, 50.0) },
                Deg::of(dice.number(0.0, 359.0)),
            ),
            move_prob: dice.below(101) as u8,
            properties: dice.properties(),
            door_states: BTreeMap::new(),
            forms: dice.forms(),
        };
        world.replicas.insert(replica.id, replica);
    }
    let replicas: Vec<_> = world.replicas.keys().copied().collect();
    let count = dice.below(4);
    for id in dice.ids(count) {
        let place = Place {
            id: PlaceId(id),
            area: areas[dice.below(areas.len())],
            name: format!("Точка-{id}"),
            name_en: String::new(),
            at: Point::new(dice.number(1.0, 499.0), dice.number(1.0, 499.0)),
            heading: dice.chance().then(|| Deg::of(dice.number(0.0, 359.0))),
            serves: dice.pick(&replicas),
            forms: dice.forms(),
        };
        world.places.insert(place.id, place);
    }
    world.robot.start = dice.pick(&world.places.keys().copied().collect::<Vec<_>>());
}

//! Worlds made by a seed: every field filled, references sound, geometry plausible but not meant to be lived in.

use std::collections::BTreeMap;
use std::sync::Arc;

use orthoframe_map::{
    Area, BaseVector, Case, Domain, DomainMap, Door, DoorKind, DoorLeaf, DoorMount, DoorState,
    Face, Forms, Gender, HingeSide, Item, ItemLink, LiftStop, Map, MapItem, MapLink, Object,
    OpensTo, Orthoframe, Permeability, Place, Profile, Properties, Replica, RobotProfile, SideRef,
    TypeEntry, TypeList, TypeLists, World,
};
use orthoframe_units::{
    AreaId, Cm, Deg, DomainId, DoorId, Frame, MapId, ObjectId, OrFrId, PlaceId, Point, ReplicaId,
    TypeId,
};

/// A small pseudo-random generator (splitmix64): the same seed makes the same world on every machine.
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub(crate) fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % sides
    }

    fn chance(&mut self) -> bool {
        self.roll(2) == 0
    }

    /// Whole, halved or ragged numbers; now and then a negative zero.
    fn number(&mut self) -> f64 {
        match self.roll(8) {
            0 => -0.0,
            1 => self.roll(1_000_000) as f64 / 7.0 - 70_000.0,
            2 => self.roll(1000) as f64 / 2.0,
            _ => self.roll(1000) as f64 - 300.0,
        }
    }

    fn cm(&mut self) -> Cm {
        Cm::of(self.number())
    }

    fn deg(&mut self) -> Deg {
        Deg::of(if self.chance() { self.roll(4) as f64 * 90.0 } else { self.number() })
    }

    fn frame(&mut self) -> Frame {
        Frame { x: self.cm(), y: self.cm(), z: self.cm(), angle: self.deg() }
    }

    fn text(&mut self) -> String {
        let words = ["", "Стул", "стол у окна", "ё\u{301}", "a\0b", "room", "日本", "x y\nz", "«»"];
        words[self.roll(words.len() as u64) as usize].to_owned()
    }

    fn some<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.chance().then(|| make(self))
    }

    fn of<'a, K: Copy + 'a, V: 'a>(
        &mut self,
        things: impl IntoIterator<Item = (&'a K, &'a V)>,
    ) -> K {
        let ids: Vec<K> = things.into_iter().map(|(id, _)| *id).collect();
        assert!(!ids.is_empty(), "the generator makes each kind of thing first");
        ids[self.roll(ids.len() as u64) as usize]
    }

    fn type_of(&mut self, list: &TypeList) -> Option<TypeId> {
        self.some(|dice| dice.of(&list.entries))
    }

    fn permeability(&mut self) -> Permeability {
        Permeability::from_code(self.roll(3) as u8).expect("0, 1 and 2 are codes")
    }

    fn properties(&mut self) -> Properties {
        (0..self.roll(3)).map(|_| (self.text(), self.text())).collect()
    }

    fn forms(&mut self) -> Forms {
        let cases = [Case::Genitive, Case::Instrumental, Case::Prepositional];
        cases.into_iter().filter_map(|case| self.some(|d| (case, d.text()))).collect()
    }

    fn state(&mut self) -> DoorState {
        match self.roll(4) {
            0 => DoorState::LOCKED,
            1 => DoorState::CLOSED,
            _ => DoorState { opening: self.roll(101) as f64, ..DoorState::OPEN },
        }
    }
}

/// A world of some `size` replicas.
pub(crate) fn world(seed: u64, size: u32) -> World {
    let dice = &mut Dice::new(seed);
    let types = types(dice);
    let mut world = World {
        domain: Domain {
            id: DomainId(1),
            key: "дом".into(),
            name: dice.text(),
            name_en: dice.text(),
            description: dice.text(),
            profile: Profile::Detected,
            maps: Vec::new(),
            lifts: Vec::new(),
        },
        types,
        robot: RobotProfile { radius: dice.cm(), speed: dice.number(), ..RobotProfile::default() },
        ..World::empty()
    };
    // Ids have holes, as in a store with a past.
    for n in 0..2 + u32::try_from(dice.roll(5)).unwrap() {
        let orthoframe = orthoframe(dice, OrFrId(n * 3 + 1), &world.types);
        world.orthoframes.insert(orthoframe.id, orthoframe);
        let door = door(dice, DoorId(n * 2 + 1), &world.types);
        world.doors.insert(door.id, door);
    }
    for n in 0..1 + u32::try_from(dice.roll(4)).unwrap() {
        let (items, links, doors) = group(dice, &world);
        let object = Object {
            id: ObjectId(n * 5 + 2),
            key: format!("вещь-{n}"),
            name: dice.text(),
            name_en: dice.text(),
            description: dice.text(),
            object_type: dice.type_of(&world.types.object),
            front: dice.some(|_| side_of(&items)),
            back: dice.some(|_| side_of(&items)),
            items,
            links,
            doors,
            properties: dice.properties(),
        };
        world.objects.insert(object.id, object);
    }
    for n in 0..1 + u32::try_from(dice.roll(5)).unwrap() {
        let (items, links, doors) = group(dice, &world);
        let area = Area {
            id: AreaId(n * 2 + 1),
            key: format!("комната-{n}"),
            name: dice.text(),
            name_en: dice.text(),
            description: dice.text(),
            area_type: dice.type_of(&world.types.area),
            items,
            links,
            doors,
            properties: dice.properties(),
            forms: dice.forms(),
        };
        world.areas.insert(area.id, area);
    }
    for n in 0..size {
        let replica = replica(dice, n, &world);
        world.replicas.insert(replica.id, replica);
    }
    for n in 0..dice.roll(4) as u32 {
        let place = Place {
            id: PlaceId(n + 1),
            area: dice.of(&world.areas),
            name: format!("Точка-{n}"),
            name_en: dice.text(),
            at: Point::new(dice.number(), dice.number()),
            heading: dice.some(Dice::deg),
            serves: if world.replicas.is_empty() { None } else { Some(dice.of(&world.replicas)) },
            forms: dice.forms(),
        };
        world.places.insert(place.id, place);
    }
    world.robot.start = world.places.keys().next().copied();
    maps(dice, &mut world);
    world
}

fn types(dice: &mut Dice) -> TypeLists {
    let mut list = |prefix: &str| TypeList {
        entries: (0..1 + dice.roll(3) as u32)
            .map(|n| {
                let entry = TypeEntry {
                    id: TypeId(n * 2 + 1),
                    name: format!("{prefix}-{n}"),
                    name_en: dice.text(),
                    description: dice.text(),
                    gender: dice.some(|d| {
                        [Gender::Masculine, Gender::Feminine, Gender::Neuter][d.roll(3) as usize]
                    }),
                    animate: dice.chance(),
                    synonyms: (0..dice.roll(3)).map(|_| dice.text()).collect(),
                    forms: dice.forms(),
                    traits: (0..dice.roll(2)).map(|_| dice.text()).collect(),
                };
                (entry.id, entry)
            })
            .collect(),
    };
    TypeLists {
        orthoframe: list("часть"),
        shape: list("фигура"),
        side: list("грань"),
        object: list("вещь"),
        area: list("помещение"),
        map: list("этаж"),
        door: list("дверь"),
    }
}

fn orthoframe(dice: &mut Dice, id: OrFrId, types: &TypeLists) -> Orthoframe {
    let corners: Vec<Point> =
        (0..3 + dice.roll(4)).map(|_| Point::new(dice.number(), dice.number())).collect();
    let base = (0..corners.len()).map(|n| BaseVector {
        // Not in the order of the alphabet.
        id: format!("{}{n}", ["Z", "A", "м"][n % 3]),
        start: corners[n],
        end: corners[(n + 1) % corners.len()],
        side_type: dice.type_of(&types.side),
        permeability: dice.permeability(),
        names: (0..dice.roll(3)).map(|_| dice.text()).collect(),
        properties: dice.properties(),
    });
    let base = base.collect();
    Orthoframe {
        id,
        key: format!("ортофрейм-{}", id.0),
        name: dice.text(),
        name_en: dice.text(),
        description: dice.text(),
        frame_type: dice.type_of(&types.orthoframe),
        shape: dice.type_of(&types.shape),
        base,
        height: dice.cm(),
        base_permeability: dice.permeability(),
        roof_permeability: dice.permeability(),
        roof_scale: if dice.chance() { 1.0 } else { 0.75 },
        properties: dice.properties(),
    }
}

fn door(dice: &mut Dice, id: DoorId, types: &TypeLists) -> Door {
    let leaf = |dice: &mut Dice| DoorLeaf {
        hinge: if dice.chance() { HingeSide::Left } else { HingeSide::Right },
        share: 0.5,
        thickness: dice.cm(),
        max_open: dice.number(),
    };
    Door {
        id,
        key: format!("дверь-{}", id.0),
        name: dice.text(),
        name_en: dice.text(),
        door_type: dice.type_of(&types.door),
        kind: [DoorKind::Hinged, DoorKind::Sliding, DoorKind::Passage][dice.roll(3) as usize],
        width: dice.cm(),
        height: dice.cm(),
        leaves: (0..dice.roll(3)).map(|_| leaf(dice)).collect(),
        state: dice.state(),
        properties: dice.properties(),
        forms: dice.forms(),
    }
}

fn group(dice: &mut Dice, world: &World) -> (Vec<Item>, Vec<ItemLink>, Vec<DoorMount>) {
    let items: Vec<Item> = (0..1 + dice.roll(4))
        .map(|n| Item {
            id: format!("{}{n}", ["Я", "B"][n as usize % 2]),
            orthoframe: dice.of(&world.orthoframes),
            frame: if n == 0 { Frame::IDENTITY } else { dice.frame() },
            is_base: n == 0,
        })
        .collect();
    let links = items.windows(2).map(|pair| ItemLink {
        item: pair[1].id.clone(),
        face: [Face::Base, Face::Side("@roof".into()), Face::Side("A1".into())]
            [dice.roll(3) as usize]
            .clone(),
        to_item: pair[0].id.clone(),
        to_face: if dice.chance() { Face::Roof } else { Face::Side("@".into()) },
        rel_x: dice.cm(),
        rel_y: dice.cm(),
        rel_z: dice.cm(),
        rel_a: dice.deg(),
    });
    let links = links.collect();
    let doors = items
        .iter()
        .filter_map(|item| {
            dice.some(|d| DoorMount {
                item: item.id.clone(),
                side: "Z0".into(),
                door: d.of(&world.doors),
                opens: if d.chance() { OpensTo::Inside } else { OpensTo::Outside },
            })
        })
        .collect();
    (items, links, doors)
}

fn side_of(items: &[Item]) -> SideRef {
    SideRef { item: items[0].id.clone(), side: "A1".into() }
}

pub(crate) fn replica(dice: &mut Dice, n: u32, world: &World) -> Replica {
    Replica {
        id: ReplicaId(n * 2 + 1),
        area: dice.of(&world.areas),
        object: dice.of(&world.objects),
        name: format!("Вещь-{n}"),
        name_en: dice.text(),
        frame: dice.frame(),
        move_prob: dice.roll(101) as u8,
        properties: dice.properties(),
        door_states: if dice.chance() {
            BTreeMap::new()
        } else {
            BTreeMap::from([(dice.of(&world.doors), dice.state())])
        },
        forms: dice.forms(),
    }
}

fn maps(dice: &mut Dice, world: &mut World) {
    let areas: Vec<AreaId> = world.areas.keys().rev().copied().collect();
    for (n, areas) in (0..).zip(areas.chunks(2)) {
        let items: Vec<MapItem> = areas
            .iter()
            .map(|area| MapItem { area: *area, frame: dice.frame(), is_base: *area == areas[0] })
            .collect();
        let links = areas.windows(2).map(|pair| MapLink {
            area: pair[0],
            side: SideRef { item: world.areas[&pair[0]].items[0].id.clone(), side: "A1".into() },
            to_area: pair[1],
            to_side: SideRef { item: "нет".into(), side: "Z0".into() },
            rel_x: dice.cm(),
            rel_y: dice.cm(),
            rel_z: dice.cm(),
            rel_a: dice.deg(),
        });
        let map = Map {
            id: MapId(n * 2 + 1),
            key: format!("этаж-{n}"),
            links: links.map(Arc::new).collect(),
            items,
            name: dice.text(),
            name_en: dice.text(),
            description: dice.text(),
            map_type: dice.type_of(&world.types.map),
            frame: dice.text(),
        };
        world.domain.maps.push(DomainMap { map: map.id, frame: dice.frame(), is_base: n == 0 });
        world.maps.insert(map.id, map);
    }
    let stops = world.maps.values().map(|m| LiftStop { area: m.items[0].area }).collect();
    world.domain.lifts = vec![("Лифт".into(), stops), (dice.text(), Vec::new())];
}

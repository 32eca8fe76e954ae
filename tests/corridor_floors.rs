//! Corridors as Areas of a Map, built of rectangles: what a road graph says of outlines at any angle.

use std::collections::BTreeMap;

use orthoframe_corridor::{CorridorError, CorridorSystem, Shape, Variant, directions};
use orthoframe_geometry::{Openings, STEP_REACH};
use orthoframe_map::{
    Area, BaseVector, Domain, DomainMap, Item, Map, MapItem, Orthoframe, Permeability, Profile,
    TypeEntry, TypeLists, World,
};
use orthoframe_units::{AreaId, Cm, Deg, DomainId, Frame, MapId, OrFrId, Point, TypeId};

/// East, north, west, south.
pub(crate) const WAYS: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// A frame in the Map in which nothing is straight or near.
pub(crate) fn placed(turned: f64) -> Frame {
    Frame::new(123.4, -2000.0, 0.0, Deg::of(turned))
}

/// Builds Areas out of rectangles, each in its own coordinates of the lattice.
pub(crate) struct Builder {
    pub(crate) world: World,
    pub(crate) frame: Frame,
}

/// A doorway in a rectangle's side: which side (0 south, 1 east, 2 north, 3 west), its middle and width along it.
pub(crate) type Gap = (usize, i32, i32, Permeability);

impl Builder {
    pub(crate) fn area(&mut self, name: &str, corridor: bool) -> AreaId {
        let id = AreaId(self.world.areas.len() as u32 + 1);
        let area = Area {
            id,
            key: name.to_owned(),
            name: name.to_owned(),
            name_en: String::new(),
            description: String::new(),
            area_type: Some(TypeId(if corridor { 1 } else { 2 })),
            items: Vec::new(),
            links: Vec::new(),
            doors: Vec::new(),
            properties: BTreeMap::new(),
            forms: BTreeMap::new(),
        };
        self.world.areas.insert(id, area);
        let item = MapItem { area: id, frame: self.frame, is_base: id.0 == 1 };
        self.world.maps.get_mut(&MapId(1)).unwrap().items.push(item);
        id
    }

    /// Adds a rectangle `[x0, x1] × [y0, y1]` with its gaps.
    pub(crate) fn rectangle(&mut self, area: AreaId, [x0, y0, x1, y1]: [i32; 4], gaps: &[Gap]) {
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        let point = |(x, y): (i32, i32)| Point::new(f64::from(x), f64::from(y));
        let mut base = Vec::new();
        for side in 0..4 {
            let (a, b) = (corners[side], corners[(side + 1) % 4]);
            let ((dx, dy), forward) = (WAYS[side], side < 2);
            let mut at = a;
            let mut cuts: Vec<&Gap> = gaps.iter().filter(|g| g.0 == side).collect();
            cuts.sort_by_key(|g| if forward { g.1 } else { -g.1 });
            let mut add = |from: (i32, i32), to: (i32, i32), permeability| {
                if from != to {
                    let id = format!("v{}", base.len());
                    let (start, end) = (point(from), point(to));
                    let (names, properties) = (Vec::new(), BTreeMap::new());
                    base.push(BaseVector {
                        id,
                        start,
                        end,
                        side_type: None,
                        permeability,
                        names,
                        properties,
                    });
                }
            };
            for &&(_, middle, width, permeability) in &cuts {
                let on = |t: i32| if dx == 0 { (a.0, t) } else { (t, a.1) };
                let half = (dx + dy) * width / 2;
                add(at, on(middle - half), Permeability::Impermeable);
                add(on(middle - half), on(middle + half), permeability);
                at = on(middle + half);
            }
            add(at, b, Permeability::Impermeable);
        }
        let id = OrFrId(self.world.orthoframes.len() as u32 + 1);
        let frame = Orthoframe {
            id,
            key: format!("f{}", id.0),
            name: String::new(),
            name_en: String::new(),
            description: String::new(),
            frame_type: None,
            shape: None,
            base,
            height: Cm::of(250.0),
            base_permeability: Permeability::Impermeable,
            roof_permeability: Permeability::Impermeable,
            roof_scale: 1.0,
            properties: BTreeMap::new(),
        };
        self.world.orthoframes.insert(id, frame);
        let items = &mut self.world.areas.get_mut(&area).unwrap().items;
        let item = Item {
            id: format!("i{}", items.len()),
            orthoframe: id,
            frame: Frame::IDENTITY,
            is_base: items.is_empty(),
        };
        items.push(item);
    }

    /// A room before the doorway at `at`, in the direction `way` from it, a wall away.
    pub(crate) fn room(&mut self, name: &str, at: (i32, i32), way: usize, wall: i32) {
        let area = self.area(name, false);
        let (dx, dy) = WAYS[way];
        let (near, far) = (wall, wall + 60);
        let (ax, ay) = (at.0 + dx * near - dy * 40, at.1 + dy * near - dx * 40);
        let (bx, by) = (at.0 + dx * far + dy * 40, at.1 + dy * far + dx * 40);
        let middle = if dx == 0 { at.0 } else { at.1 };
        // The room's side that looks back at the corridor: opposite to `way`.
        let side = [3, 0, 1, 2][way];
        let rectangle = [ax.min(bx), ay.min(by), ax.max(bx), ay.max(by)];
        self.rectangle(area, rectangle, &[(side, middle, 80, Permeability::Conditional)]);
    }
}

pub(crate) fn empty_world() -> World {
    let map = Map {
        id: MapId(1),
        key: "этаж".into(),
        name: "Этаж 1".into(),
        name_en: String::new(),
        description: String::new(),
        map_type: None,
        frame: String::new(),
        items: Vec::new(),
        links: Vec::new(),
    };
    let domain = Domain {
        id: DomainId(1),
        key: "здание".into(),
        name: "Здание".into(),
        name_en: String::new(),
        description: String::new(),
        profile: Profile::Surveyed,
        maps: vec![DomainMap { map: MapId(1), frame: Frame::IDENTITY, is_base: true }],
        lifts: Vec::new(),
    };
    let mut types = TypeLists::default();
    for (id, name, traits) in
        [(1, "Коридор", vec!["corridor".to_owned()]), (2, "Комната", Vec::new())]
    {
        let entry = TypeEntry {
            id: TypeId(id),
            name: name.into(),
            name_en: String::new(),
            description: String::new(),
            gender: None,
            animate: false,
            synonyms: Vec::new(),
            forms: BTreeMap::new(),
            traits,
        };
        types.area.entries.insert(TypeId(id), entry);
    }
    World { domain, maps: [(MapId(1), map)].into_iter().collect(), types, ..World::empty() }
}

/// One corridor of any outline, doors at the middles of the given edges; described by what one sees.
fn outline(corners: &[(i32, i32)], doors: &[usize], turned: f64) -> String {
    let mut builder = Builder { world: empty_world(), frame: placed(turned) };
    let area = builder.area("Коридор", true);
    builder.rectangle(area, [0, 0, 1, 1], &[]);
    let point = |(x, y): (i32, i32)| Point::new(f64::from(x), f64::from(y));
    let mut base = Vec::new();
    for (edge, &a) in corners.iter().enumerate() {
        let (a, b) = (point(a), point(corners[(edge + 1) % corners.len()]));
        let along = (b - a).normalize() * 45.0;
        let middle = nalgebra::center(&a, &b);
        let mut stops = vec![a, b];
        if doors.contains(&edge) {
            stops = vec![a, middle - along, middle + along, b];
        }
        for (part, ends) in stops.windows(2).enumerate() {
            let door = stops.len() > 2 && part == 1;
            base.push(BaseVector {
                id: format!("{edge}.{part}"),
                start: ends[0],
                end: ends[1],
                side_type: None,
                permeability: if door {
                    Permeability::Conditional
                } else {
                    Permeability::Impermeable
                },
                names: if door { vec![format!("Д{edge}")] } else { Vec::new() },
                properties: BTreeMap::new(),
            });
        }
    }
    builder.world.orthoframes.get_mut(&OrFrId(1)).unwrap().base = base;
    let system = CorridorSystem::from_map(
        &builder.world,
        &Openings::of(&builder.world, STEP_REACH),
        MapId(1),
        &Shape::default(),
    )
    .unwrap();
    system.check_invariants();
    let name = |v| match system.vertex(v).entrance() {
        Some(entrance) => entrance.room.clone(),
        None => "+".to_owned(),
    };
    let mut seen: Vec<String> = system
        .arcs()
        .map(|arc| {
            let (tail, head) = (system.tail(arc).vertex, system.head(arc).vertex);
            format!("{}→{} {}", name(tail), name(head), system.code(arc).number())
        })
        .collect();
    seen.sort();
    seen.join(", ")
}

#[test]
fn corridors_of_one_outline_at_any_angle() {
    let ell = [(0, 0), (1200, 0), (1200, 900), (1000, 900), (1000, 200), (0, 200)];
    let tee =
        [(0, 0), (1200, 0), (1200, 200), (700, 200), (700, 900), (500, 900), (500, 200), (0, 200)];
    let cross = [
        (0, 0),
        (500, 0),
        (500, -500),
        (700, -500),
        (700, 0),
        (1200, 0),
        (1200, 200),
        (700, 200),
        (700, 700),
        (500, 700),
        (500, 200),
        (0, 200),
    ];
    let lobby = [(0, 0), (500, 0), (500, 400), (0, 400)];
    for turned in [0.0, 17.3, 90.0, 200.0] {
        let corner = expect_test::expect!["+→Д3 12, +→Д5 13, Д2→Д3 11, Д3→+ 5, Д3→Д2 13, Д5→+ 6"];
        corner.assert_eq(&outline(&ell, &[2, 3, 5], turned));
        let branch = expect_test::expect![
            "+→Д1 13, +→Д3 11, +→Д7 13, Д1→+ 3, Д3→+ 2, Д3→Д4 13, Д4→Д3 12, Д7→+ 4"
        ];
        branch.assert_eq(&outline(&tee, &[1, 3, 4, 7], turned));
        let crossing = expect_test::expect![
            "+→Д11 13, +→Д2 13, +→Д5 13, +→Д8 13, Д11→+ 1, Д2→+ 1, Д5→+ 1, Д8→+ 1"
        ];
        crossing.assert_eq(&outline(&cross, &[2, 5, 8, 11], turned));
        let square = expect_test::expect!["Д0→Д1 13, Д1→Д0 12"];
        square.assert_eq(&outline(&lobby, &[0, 1], turned));
    }
}

#[test]
fn corridors_that_touch_without_a_door_stay_apart_and_floors_too() {
    let mut builder = Builder { world: empty_world(), frame: placed(17.3) };
    let (one, two) = (builder.area("Первый", true), builder.area("Второй", true));
    builder.rectangle(one, [0, 0, 1000, 200], &[(0, 300, 80, Permeability::Conditional)]);
    builder.rectangle(two, [0, 200, 1000, 400], &[(2, 300, 80, Permeability::Conditional)]);
    builder.room("А", (300, 0), 3, 10);
    builder.room("Б", (300, 400), 1, 10);
    let mut world = builder.world;
    let route = |world: &World| {
        let system =
            CorridorSystem::from_world(world, &Openings::of(world, STEP_REACH), &Shape::default())
                .unwrap();
        directions(&system, "А", None, "Б", Variant::Single)
    };
    assert!(matches!(route(&world), Err(CorridorError::Unreachable { .. })));
    // The same rooms on two floors.
    let mut upper = world.maps[&MapId(1)].clone();
    let map = world.maps.get_mut(&MapId(1)).unwrap();
    upper.items = map.items.split_off(0).into_iter().filter(|i| i.area.0 % 2 == 0).collect();
    map.items = [1, 3]
        .map(|id| MapItem { area: AreaId(id), frame: placed(0.0), is_base: id == 1 })
        .to_vec();
    (upper.id, upper.name) = (MapId(2), "Этаж 2".into());
    world.maps.insert(MapId(2), upper);
    let error = route(&world).unwrap_err();
    let help = miette::Diagnostic::help(&error).unwrap().to_string();
    assert_eq!(help, "«А» – на «Этаж 1», «Б» – на «Этаж 2»: нужен лифт");
    assert!(matches!(
        CorridorSystem::from_map(
            &world,
            &Openings::of(&world, STEP_REACH),
            MapId(7),
            &Shape::default()
        ),
        Err(CorridorError::UnknownMap { map: 7 })
    ));
}

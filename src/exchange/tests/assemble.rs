//! Surveys with every sort of dirt become worlds, and what was done to them is told.

use orthoframe_exchange::{
    Kind, Level, Lift, Opening, OpeningKind, Report, Room, Spot, Survey, Synonyms, Thing,
    Treatment, assemble,
};
use orthoframe_map::plane::doubled_area;
use orthoframe_map::{
    DoorKind, DoorLeaf, DoorStatus, Fault, HingeSide, OpensTo, Permeability, World, check,
};
use orthoframe_units::{Cm, Deg, Point};

fn rect(x: f64, y: f64, w: f64, h: f64) -> Vec<Point> {
    [(x, y), (x + w, y), (x + w, y + h), (x, y + h)].map(|(x, y)| Point::new(x, y)).to_vec()
}

fn room(source: &str, kind: &str, outline: Vec<Point>) -> Room {
    Room { source: source.into(), kind: kind.into(), outline, ..Room::default() }
}

fn door(source: &str, p: (f64, f64), q: (f64, f64)) -> Opening {
    Opening {
        source: source.into(),
        name: String::new(),
        what: OpeningKind::Door {
            kind: DoorKind::Hinged,
            leaves: Vec::new(),
            opens: None,
            status: DoorStatus::Open,
            opening: 100.0,
        },
        jambs: [Point::new(p.0, p.1), Point::new(q.0, q.1)],
        rooms: None,
        height: None,
        sill: Cm::ZERO,
        properties: Default::default(),
    }
}

fn made(level: Level) -> (World, Report) {
    let survey = Survey { name: "дом".into(), levels: vec![level], ..Survey::default() };
    let mut report = Report::new("проба", "проба");
    let world = assemble(&survey, &Synonyms::built_in(), &mut report).expect("a world");
    let again = assemble(&survey, &Synonyms::built_in(), &mut Report::default());
    assert_eq!(again.expect("a world"), world, "two imports give the same");
    (world, report)
}

fn codes(report: &Report) -> Vec<String> {
    report.notes.iter().map(|n| format!("{} {}", n.source, n.why.code())).collect()
}

#[test]
fn rooms_wall_to_wall_and_across_a_thick_wall() {
    let level = Level {
        rooms: vec![
            room("a", "Bedroom", rect(0.0, 0.0, 400.0, 300.0)),
            room("b", "Kitchen", rect(400.0, 0.0, 300.0, 300.0)),
            room("c", "Bedroom", rect(0.0, 330.0, 400.0, 300.0)),
        ],
        openings: vec![
            door("ab", (400.0, 100.0), (400.0, 190.0)),
            door("ac", (100.0, 315.0), (190.0, 315.0)),
            door("out", (0.0, 90.0), (0.0, 10.0)),
        ],
        ..Level::default()
    };
    let (world, report) = made(level);
    assert!(report.is_clean(), "{report}");
    let names: Vec<&str> = world.areas.values().map(|a| a.name.as_str()).collect();
    assert_eq!(names, ["Спальня", "Кухня", "Спальня-2"]);
    let joined: Vec<usize> = world.doors.keys().map(|&d| world.door_areas(d).len()).collect();
    assert_eq!(joined, [2, 2, 1]);
    let map = world.maps.values().next().expect("one level");
    assert_eq!(map.links.len(), 2);
    assert!(map.links.iter().all(|l| l.rel_x == Cm::ZERO && l.rel_y == Cm::ZERO));
    assert_eq!(
        world.doors.values().map(|d| d.name.as_str()).collect::<Vec<_>>(),
        ["Дверь-1", "Дверь-2", "Дверь-3"]
    );
}

#[test]
fn dirt_goes_through_with_its_reasons() {
    let level = Level {
        rooms: vec![
            room("hall", "hall", rect(0.0, 0.0, 600.0, 400.0)),
            room("closet", "closet", rect(500.0, 300.0, 200.0, 100.0)),
            room("line", "hall", rect(0.0, 0.0, 500.0, 0.0)),
            room("again", "hall", rect(0.0, 0.0, 600.0, 400.0)),
            room("far", "office", rect(3000.0, 0.0, 300.0, 300.0)),
        ],
        openings: vec![
            door("inside", (300.0, 150.0), (300.0, 240.0)),
            door("nowhere", (2000.0, 0.0), (2000.0, 90.0)),
            door("point", (0.0, 100.0), (0.0, 100.0)),
            door("closet", (500.0, 310.0), (500.0, 390.0)),
            door("closet-again", (500.0, 315.0), (500.0, 385.0)),
        ],
        ..Level::default()
    };
    let (world, report) = made(level);
    assert_eq!(world.areas.len(), 3);
    assert_eq!(world.doors.len(), 1);
    let mut codes = codes(&report);
    codes.sort();
    assert_eq!(
        codes,
        [
            "again import::room_twice",
            "closet-again import::no_wall",
            "far import::island",
            "hall import::rooms_overlap",
            "inside import::within_room",
            "line import::no_outline",
            "nowhere import::no_room",
            "point import::too_narrow",
        ]
    );
}

#[test]
fn leaves_stay_where_they_hang_whichever_room_comes_first() {
    let hung = |first: Vec<Point>, second: Vec<Point>| {
        let mut opening = door("d", (400.0, 190.0), (400.0, 100.0));
        // Seen from the right room: the first jamb, above, is the right one. The leaf opens to the right.
        opening.what = OpeningKind::Door {
            kind: DoorKind::Hinged,
            leaves: vec![DoorLeaf {
                hinge: HingeSide::Right,
                share: 1.0,
                thickness: Cm::of(4.0),
                max_open: 90.0,
            }],
            opens: Some(OpensTo::Inside),
            status: DoorStatus::Open,
            opening: 100.0,
        };
        let level = Level {
            rooms: vec![room("1", "hall", first), room("2", "office", second)],
            openings: vec![opening],
            ..Level::default()
        };
        let (world, _) = made(level);
        let door = world.doors.values().next().expect("a door").clone();
        let mounts: Vec<_> = world
            .door_mounts(door.id)
            .map(|(a, m)| (world.areas[&a].name.clone(), m.opens))
            .collect();
        (door.leaves[0].hinge, mounts)
    };
    let (left, right) = (rect(0.0, 0.0, 400.0, 300.0), rect(400.0, 0.0, 300.0, 300.0));
    let (hinge, mounts) = hung(right.clone(), left.clone());
    assert_eq!(hinge, HingeSide::Right);
    assert_eq!(mounts[0], ("Холл".to_owned(), OpensTo::Inside));
    let (hinge, mounts) = hung(left, right);
    assert_eq!(hinge, HingeSide::Left);
    assert_eq!(mounts[1], ("Кабинет".to_owned(), OpensTo::Inside));
}

#[test]
fn things_places_courts_and_storeys() {
    let kind = |word: &str| Kind { source: word.into(), word: word.into(), ..Kind::default() };
    let thing = |source: &str, kind, x, y, room| Thing {
        source: source.into(),
        name: String::new(),
        kind,
        at: Point::new(x, y),
        z: Cm::ZERO,
        angle: Deg::ZERO,
        room,
        move_prob: None,
        properties: Default::default(),
    };
    let mut court = room("court", "hall", rect(0.0, 0.0, 800.0, 800.0));
    court.holes = vec![rect(300.0, 300.0, 200.0, 200.0)];
    let lower = Level {
        source: "L1".into(),
        rooms: vec![court, room("stairs", "stairs", rect(800.0, 0.0, 300.0, 300.0))],
        openings: vec![door("d", (800.0, 100.0), (800.0, 200.0))],
        things: vec![
            thing("chair", 0, 100.0, 100.0, None),
            thing("in-court", 0, 400.0, 400.0, None),
            thing("in-wall", 0, 5.0, 700.0, Some(0)),
            thing("elsewhere", 1, 900.0, 150.0, Some(0)),
        ],
        spots: vec![Spot {
            source: "p".into(),
            name: String::new(),
            kind: String::new(),
            at: Point::new(50.0, 50.0),
            heading: None,
            is_start: false,
        }],
        ..Level::default()
    };
    let upper = Level {
        source: "L2".into(),
        elevation: Cm::of(320.0),
        rooms: vec![room("stairs-2", "stairs", rect(800.0, 0.0, 300.0, 300.0))],
        ..Level::default()
    };
    let survey = Survey {
        name: "дом".into(),
        levels: vec![lower, upper],
        kinds: vec![kind("chair"), kind("gizmo")],
        lifts: vec![Lift {
            source: "s".into(),
            name: "лестница".into(),
            stops: vec![(0, 1), (1, 0)],
            is_told: true,
        }],
        ..Survey::default()
    };
    let mut report = Report::default();
    let world = assemble(&survey, &Synonyms::built_in(), &mut report).expect("a world");
    assert!(world.areas.values().next().is_some_and(|a| a.items.len() >= 2));
    let seams = world.orthoframes.values().flat_map(|o| &o.base);
    assert!(seams.filter(|v| v.permeability == Permeability::Permeable).count() >= 2);
    assert_eq!(world.domain.lifts.len(), 1);
    assert_eq!(world.domain.maps[1].frame.z, Cm::of(320.0));
    // The upper floor stands over its stairs: both in the coordinates of the file.
    assert_eq!(world.domain.maps[1].frame.x, Cm::ZERO);
    let upper = world.maps.values().nth(1).expect("two storeys");
    assert_eq!(upper.items[0].frame.x, Cm::of(800.0));
    let names: Vec<&str> = world.replicas.values().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["Стул-1", "Стул-2", "Gizmo-1"], "{report}");
    assert_eq!(world.places.len(), 1);
    assert!(codes(&report).contains(&"in-court import::outside".to_owned()), "{report}");
    assert_eq!(report.count(Treatment::Skipped), 1);
    assert!(!codes(&report).iter().any(|c| c.ends_with("island")), "{report}");
}

#[test]
fn a_court_is_cut_into_pieces_that_share_their_cuts() {
    let mut court = room("court", "hall", rect(0.0, 0.0, 600.0, 400.0));
    court.holes = vec![rect(100.0, 100.0, 50.0, 50.0), rect(300.0, 200.0, 50.0, 50.0)];
    let (world, _) = made(Level { rooms: vec![court], ..Level::default() });
    let [area] = *world.areas.values().collect::<Vec<_>>() else { panic!("{:?}", world.areas) };
    let pieces = || area.items.iter().map(|item| (item, &world.orthoframes[&item.orthoframe]));
    let floor: f64 =
        pieces().map(|(_, piece)| doubled_area(&piece.corners().collect::<Vec<_>>()) / 2.0).sum();
    assert!((floor - 235_000.0).abs() < 1.0, "{floor}");
    // No base crosses itself, or the map has a fault.
    assert!(check(&world).iter().all(Fault::is_warning));
    let mut cuts = Vec::new();
    for (item, piece) in pieces() {
        let seams = piece.base.iter().filter(|v| v.permeability == Permeability::Permeable);
        cuts.extend(seams.map(|v| [v.start, v.end].map(|end| item.frame.apply(end))));
    }
    assert!(!cuts.is_empty());
    let near = |p: Point, q: Point| (p - q).norm() < 1e-6;
    for [start, end] in &cuts {
        assert!(cuts.iter().any(|[p, q]| near(*p, *end) && near(*q, *start)), "{start} {end}");
    }
}

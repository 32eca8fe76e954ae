//! The assembler against dirt of every size: whatever rooms, openings and things a survey holds, a world comes of it
//! that passes every check, and rooms that are only a little out of place all arrive.

use orthoframe_exchange::{
    ImportError, Kind, Level, Opening, OpeningKind, Part, Report, Room, Survey, Synonyms, Thing,
    assemble,
};
use orthoframe_map::{DoorKind, DoorStatus, Permeability, Properties, check};
use orthoframe_units::{Cm, Deg, Point, Vector};

use crate::generated_worlds::Dice;

/// A number between two others.
fn between(dice: &mut Dice, low: f64, high: f64) -> f64 {
    low + (high - low) * dice.below(1_000_001) as f64 / 1e6
}

/// How far corners are out of place, cm: the rounding of files, of drawings, of hands.
const DIRT: [f64; 9] = [0.0, 0.01, 0.06, 0.1, 0.2, 0.6, 2.0, 8.0, 60.0];

/// Buildings that are tried.
const SEEDS: u64 = 300;

struct Plan {
    level: Level,
    /// The rooms of the grid, before those that were thrown upon it.
    rooms: usize,
    dirt: f64,
}

/// Rooms in rows and columns, turned by any angle, their corners out of place; doors on their walls; more rooms,
/// openings and things anywhere.
fn plan(dice: &mut Dice) -> Plan {
    let dirt = DIRT[dice.below(DIRT.len())];
    let turn = [0.0, between(dice, 0.0, 3.0), std::f64::consts::FRAC_PI_4][dice.below(3)];
    let far = [0.0, 5000.0, 800_000.0][dice.below(3)];
    let place = |x: f64, y: f64| {
        let (sin, cos) = turn.sin_cos();
        Point::new(x * cos - y * sin + far, x * sin + y * cos - far / 2.0)
    };
    let lines = |dice: &mut Dice| -> Vec<f64> {
        let mut at = 0.0;
        (0..=1 + dice.below(4))
            .map(|_| {
                let here = at;
                at += between(dice, 150.0, 1200.0);
                here
            })
            .collect()
    };
    let (xs, ys) = (lines(dice), lines(dice));
    let shifted = |dice: &mut Dice, p: Point| {
        p + Vector::new(between(dice, -dirt, dirt), between(dice, -dirt, dirt))
    };
    let mut level = Level { source: "0".into(), ..Level::default() };
    let mut doors: Vec<[Point; 2]> = Vec::new();
    for (i, x) in xs.windows(2).enumerate() {
        for (j, y) in ys.windows(2).enumerate() {
            let corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])];
            let mut outline: Vec<Point> = Vec::new();
            for (k, (cx, cy)) in corners.into_iter().enumerate() {
                outline.push(shifted(dice, place(cx, cy)));
                if dice.below(3) == 0 {
                    // A corner on the straight wall.
                    let (nx, ny) = corners[(k + 1) % 4];
                    let t = between(dice, 0.1, 0.9);
                    outline.push(shifted(dice, place(cx + (nx - cx) * t, cy + (ny - cy) * t)));
                }
            }
            let source = format!("room-{i}-{j}");
            level.rooms.push(Room { source, outline, ..Room::default() });
            let (mid_x, mid_y) = (x[0].midpoint(x[1]), y[0].midpoint(y[1]));
            doors.push([place(x[1], mid_y - 40.0), place(x[1], mid_y + 40.0)]);
            doors.push([place(mid_x - 40.0, y[1]), place(mid_x + 40.0, y[1])]);
        }
    }
    let rooms = level.rooms.len();
    let (width, depth) = (xs[xs.len() - 1], ys[ys.len() - 1]);
    let anywhere = |dice: &mut Dice| {
        place(between(dice, -50.0, width + 50.0), between(dice, -50.0, depth + 50.0))
    };
    for n in 0..[0, 0, 3][dice.below(3)] {
        let outline = (0..3 + dice.below(6)).map(|_| anywhere(dice)).collect();
        let holes = (0..dice.below(2)).map(|_| (0..4).map(|_| anywhere(dice)).collect()).collect();
        level.rooms.push(Room { source: format!("thrown-{n}"), outline, holes, ..Room::default() });
    }
    for _ in 0..dice.below(4) {
        let from = anywhere(dice);
        doors.push([
            from,
            from + Vector::new(between(dice, -90.0, 90.0), between(dice, -90.0, 90.0)),
        ]);
    }
    for (n, jambs) in doors.into_iter().enumerate() {
        let jambs = jambs.map(|p| shifted(dice, p));
        level.openings.push(opening(format!("opening-{n}"), jambs, dice.below(4)));
    }
    for n in 0..dice.below(6) {
        level.things.push(Thing {
            source: format!("thing-{n}"),
            name: String::new(),
            kind: 0,
            at: anywhere(dice),
            z: Cm::ZERO,
            angle: Deg::of(between(dice, 0.0, 360.0)),
            room: None,
            move_prob: None,
            properties: Properties::new(),
        });
    }
    Plan { level, rooms, dirt }
}

fn opening(source: String, jambs: [Point; 2], sort: usize) -> Opening {
    let what = match sort {
        0 => OpeningKind::Passage,
        1 => OpeningKind::Window,
        _ => OpeningKind::Door {
            kind: DoorKind::Hinged,
            leaves: Vec::new(),
            opens: None,
            status: DoorStatus::Open,
            opening: 100.0,
        },
    };
    let (name, properties) = (String::new(), Properties::new());
    Opening { source, name, what, jambs, rooms: None, height: None, sill: Cm::ZERO, properties }
}

fn chest() -> Kind {
    let outline = [(-40.0, -20.0), (40.0, -20.0), (40.0, 20.0), (-40.0, 20.0)];
    let outline = outline.map(|(x, y)| Point::new(x, y)).to_vec();
    let part = Part {
        word: String::new(),
        outline,
        bottom: Cm::ZERO,
        height: Cm::of(80.0),
        permeability: Permeability::Impermeable,
    };
    Kind { source: "chest".into(), word: "chest".into(), parts: vec![part], ..Kind::default() }
}

#[test]
fn rooms_that_overlap_by_any_amount_are_parted() {
    let mut refused = Vec::new();
    for seed in 0..SEEDS {
        let mut dice = Dice::new(seed);
        let Plan { level, rooms, dirt } = plan(&mut dice);
        let is_thrown = level.rooms.len() > rooms;
        let survey = Survey { levels: vec![level], kinds: vec![chest()], ..Survey::default() };
        let mut report = Report::default();
        match assemble(&survey, &Synonyms::built_in(), &mut report) {
            Ok(world) => {
                let faults: Vec<_> =
                    check(&world).into_iter().filter(|f| !f.is_warning()).collect();
                assert!(faults.is_empty(), "{seed}: {faults:?}");
                if dirt < 10.0 && !is_thrown {
                    assert_eq!(world.areas.len(), rooms, "{seed}: dirt {dirt}\n{report}");
                }
            }
            Err(ImportError::Map(e)) => {
                let what: Vec<_> = e.faults.iter().map(|f| f.error.to_string()).collect();
                refused.push(format!("{seed}, dirt {dirt}: {}", what.join("; ")));
            }
            Err(e) => refused.push(format!("{seed}, dirt {dirt}: {e}")),
        }
    }
    assert!(refused.is_empty(), "{} refused:\n{}", refused.len(), refused.join("\n"));
}

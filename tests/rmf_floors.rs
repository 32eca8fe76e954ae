//! Open-RMF: what is floor in a drawing, and where its rooms end.

use orthoframe::engine::Engine;
use orthoframe_exchange::{Survey, read_rmf};
use orthoframe_map::World;
use orthoframe_units::{Point, Source};

use crate::frames::on_the_map;
use crate::imports::contains;

/// A storey of 10 by 8 m with a corridor below and a room above it, in metres; `more` says what else is drawn.
fn storey(floors: &str, more: &str) -> Source {
    let text = format!(
        r#"name: hotel
coordinate_system: cartesian_meters
levels:
  L2:
    elevation: 4.0
    vertices:
      - [20, 30, 0, ""]
      - [30, 30, 0, ""]
      - [30, 38, 0, ""]
      - [20, 38, 0, ""]
      - [20, 32, 0, ""]
      - [24, 32, 0, ""]
      - [24.9, 32, 0, ""]
      - [30, 32, 0, ""]
      - [23, 34, 0, ""]
      - [26, 34, 0, ""]
      - [26, 37, 0, ""]
      - [23, 37, 0, ""]
    walls:
      - [0, 1, {{}}]
      - [1, 7, {{}}]
      - [7, 2, {{}}]
      - [2, 3, {{}}]
      - [3, 4, {{}}]
      - [4, 0, {{}}]
{more}
{floors}
lifts: {{}}
"#
    );
    Source::new("hotel.building.yaml", text)
}

fn world_of(source: &Source) -> (World, Survey) {
    let survey = read_rmf(source).unwrap_or_else(|e| panic!("{e:?}"));
    let synonyms = orthoframe_exchange::Synonyms::built_in();
    let mut report = orthoframe_exchange::Report::default();
    let world = orthoframe_exchange::assemble(&survey, &synonyms, &mut report);
    (world.unwrap_or_else(|e| panic!("{e:?}")), survey)
}

fn is_floor(world: &World, p: Point) -> bool {
    world.areas.keys().flat_map(|&a| on_the_map(world, a)).any(|ring| contains(&ring, p))
}

/// A well in a hotel's upper storey, drawn as a hole, or by floors that lead round it.
#[test]
fn what_the_drawing_leaves_out_is_no_floor() {
    let wall = "      - [4, 7, {}]";
    let whole = "    floors:\n      - vertices: [0, 1, 2, 3]";
    let holes = "    holes:\n      - vertices: [8, 9, 10, 11]";
    let round = "    floors:\n      - vertices: [0, 1, 7, 4]\n      - vertices: [4, 7, 2, 10, 9, 8, 11, 3]\n      - vertices: [10, 2, 3, 11]";
    let (well, beside) = (Point::new(2450.0, 3550.0), Point::new(2100.0, 3550.0));
    let (world, survey) = world_of(&storey(whole, wall));
    assert!(is_floor(&world, well) && survey.notes.is_empty(), "{:?}", survey.notes);
    for floors in [format!("{whole}\n{holes}"), round.to_owned()] {
        let (world, survey) = world_of(&storey(&floors, wall));
        assert!(!is_floor(&world, well), "{floors}");
        assert!(
            is_floor(&world, beside) && is_floor(&world, Point::new(2800.0, 3550.0)),
            "{floors}"
        );
        assert_eq!(world.areas.len(), 2);
        let told: Vec<String> = survey.notes.iter().map(|n| n.text.to_string()).collect();
        assert_eq!(told, ["по рисунку здесь нет пола: 9.0 м² у (24.50; 35.50) м"], "{floors}");
        // A way from one side of the well to the other leads round it.
        let engine = Engine::in_memory(world, None).expect("rules are sound");
        let answer = engine
            .route("2150,3550", "2850,3550", orthoframe::engine::Method::Shortest)
            .expect("places");
        let route = answer.route.expect("a way round the well");
        let (a, b) = (Point::new(2300.0, 3400.0), Point::new(2600.0, 3700.0));
        for leg in route.points.windows(2) {
            for t in 0..=20 {
                let p = leg[0] + (leg[1] - leg[0]) * (f64::from(t) / 20.0);
                assert!(!(p.x > a.x && p.x < b.x && p.y > a.y && p.y < b.y), "{p}");
            }
        }
    }
}

#[test]
fn a_doorway_that_nobody_drew_is_told_with_its_place() {
    let floors = "    floors:\n      - vertices: [0, 1, 2, 3]";
    let (world, survey) = world_of(&storey(floors, "      - [4, 5, {}]\n      - [6, 7, {}]"));
    assert_eq!(world.areas.len(), 1);
    let told: Vec<String> = survey.notes.iter().map(|n| n.text.to_string()).collect();
    let place = "90 см у (24.45; 32.00) м";
    assert_eq!(
        told,
        [format!("в стене проём без двери: помещения по обе стороны стали одним; {place}")]
    );
    // The right half of the wall is missing.
    let (world, survey) = world_of(&storey(floors, "      - [4, 5, {}]"));
    assert_eq!(world.areas.len(), 1);
    assert!(
        survey.notes.iter().any(|n| n.text.to_string().contains("600 см")),
        "{:?}",
        survey.notes
    );
}

//! What a scan shows of a made building is what is there.

use nalgebra::{Isometry2, Vector2};

use orthoframe_geometry::{DoorStates, FloorPlan, Polygon};
use orthoframe_map::World;
use orthoframe_sensing::{Bound, Chart, Fit, Line, Localiser, Operative, Options, telling_move};
use orthoframe_units::Point;
use orthoframe_vectors::scan::{Noise, Sensor};

fn sensor(field: f64) -> Sensor {
    let step = std::f64::consts::PI / 360.0;
    let count = (field / 0.5) as usize;
    Sensor::new(-field.to_radians() / 2.0, step, count, (2.0, 3000.0), Noise::default())
        .expect("a sensor")
}

#[test]
fn the_seen_floor_is_free_floor_and_its_faces_are_those_of_the_map() {
    let world =
        World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/rb2.toml")).expect("rb2");
    let map = *world.maps.keys().next().expect("it has a map");
    let plan = FloorPlan::build(&world, map, &world.robot, &DoorStates::new());
    let (sight, chart) = (plan.sight(&world, 30.0), Chart::of_map(&world, &plan, 30.0));
    let mut random = fastrand::Rng::with_seed(5);
    let (mut seen, mut named, mut faces) = (0, 0, 0);
    for number in 0..60 {
        let at = Point::new(random.f64() * 900.0, random.f64() * 700.0);
        if !plan.fragments().any(|floor| floor.fits(at)) {
            continue;
        }
        let sensor = sensor(if number % 2 == 0 { 360.0 } else { 180.0 });
        let pose = Isometry2::new(at.coords, random.f64() * std::f64::consts::TAU);
        let ranges: Vec<f64> = (0..sensor.count())
            .map(|beam| {
                let direction = pose.rotation.angle() + sensor.bearing(beam);
                let noise = (random.f64() + random.f64() - 1.0) * 1.5;
                sight.beam(at, direction, 3000.0).distance + noise
            })
            .collect();
        let named_as = |blocker: orthoframe_geometry::Blocker| format!("{blocker:?}");
        let shown = Operative::of(&sensor, &ranges, &pose, &world.robot, &chart, &named_as)
            .expect("floor is seen");
        seen += 1;
        for (start, end, bound) in shown.outline() {
            let middle = nalgebra::center(&start, &end);
            let range = (middle - at).norm();
            if let Bound::Face(face) = bound {
                // Its own error stays within a hundredth of the range, and the laser's own noise.
                let off = chart.nearest(middle).map_or(40.0, |(_, foot)| (foot - middle).norm());
                assert!(off <= 0.01 * range + 4.0, "{number}: {off:.1} cm at {range:.0}");
                faces += 1;
                named += usize::from(face.is_some());
            }
        }
        // Passframes are convex, do not leave what is seen, and together with dead zones are all of it.
        let outline = Polygon::from(&shown);
        let free: f64 = shown.passframes().iter().map(|f| f.polygon.signed_area()).sum();
        let floor = shown.plan().fragments().next().expect("one area");
        let dead: f64 = floor.dead_zones().iter().map(orthoframe_geometry::Region::area).sum();
        let whole = outline.signed_area();
        assert!(
            whole > 0.0 && (free + dead - whole).abs() <= 0.02 * whole,
            "{free} {dead} {whole}"
        );
        for frame in shown.passframes() {
            assert!(frame.polygon.is_convex(1e-3), "{number}");
            assert!(outline.contains(frame.polygon.centroid(), 0.5), "{number}");
            for border in &frame.borders {
                let bound = shown.bound(&border.beyond);
                let is_named = matches!(bound, Some(Bound::Face(Some(_))));
                assert_eq!(!border.names.is_empty(), is_named, "{number}: {border:?}");
            }
        }
    }
    assert!(seen >= 20 && named * 100 >= 97 * faces, "{seen} {named} {faces}");
}

#[test]
fn a_move_is_told_that_tells_two_rooms_apart() {
    let room = |x: f64| {
        let corners = [(x, 0.0), (x + 400.0, 0.0), (x + 400.0, 300.0), (x, 300.0)];
        let corners = corners.map(|(x, y)| nalgebra::Point2::new(x, y));
        (0..4).map(move |n| Line::between(corners[n], corners[(n + 1) % 4]))
    };
    let mut lines: Vec<Line> = room(0.0).chain(room(2000.0)).collect();
    // In one of them a cupboard stands behind the robot.
    let cupboard = [(0.0, 90.0), (60.0, 90.0), (60.0, 210.0), (0.0, 210.0)];
    let cupboard = cupboard.map(|(x, y)| nalgebra::Point2::new(x, y));
    lines.extend((0..4).map(|n| Line::between(cupboard[n], cupboard[(n + 1) % 4])));
    let chart = Chart::new(lines);
    let localiser = Localiser::new(&chart, Options::default());
    let fit = |x: f64| {
        let pose = Isometry2::new(Vector2::new(x, 150.0), 0.0);
        let ranges: Vec<f64> =
            (0..360).map(|beam| chart.cast(&pose, sensor(180.0).bearing(beam), 3000.0).0).collect();
        localiser.near(&sensor(180.0), &ranges, pose).expect("it fits")
    };
    let fits: Vec<Fit> = vec![fit(200.0), fit(2200.0)];
    let told = telling_move(&chart, &fits, 25.0).expect("turning round shows the cupboard");
    assert!(told.tells > 0.99 && told.turn.abs() > 1.0, "{told:?}");
    // Of two rooms that are wholly alike nothing tells.
    let alike = Chart::new(room(0.0).chain(room(2000.0)).collect());
    assert_eq!(telling_move(&alike, &fits, 25.0), None);
    assert_eq!(telling_move(&chart, &fits[..1], 25.0), None);
}

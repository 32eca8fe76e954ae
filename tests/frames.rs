//! An imported map keeps the coordinates of its file: what the file has somewhere is there on the Map, and in what is
//! written of the Map again.

use std::collections::BTreeMap;

use orthoframe::engine::Engine;
use orthoframe_exchange::{
    Assets, Options, Survey, file_text, read, read_osmag, read_procthor, read_rmf, read_virtualhome,
};
use orthoframe_map::World;
use orthoframe_units::{AreaId, Cm, Point, Source};

use crate::files::shared;
use crate::imports::{contains, source};

/// Corners of a room where they stand on its Map.
pub(crate) fn on_the_map(world: &World, area: AreaId) -> Vec<Vec<Point>> {
    let (_, frame) = world.placement(area).expect("every room stands on a map");
    let place = |ring: Vec<Point>| ring.into_iter().map(|p| frame.apply(p)).collect();
    world.area_polygons(area).into_iter().map(place).collect()
}

/// The rooms of a world by the file's ids, with their corners on their Maps.
fn rooms_by_source(world: &World) -> BTreeMap<(String, u32), Vec<Vec<Point>>> {
    let entry = |(&id, area): (&AreaId, &orthoframe_map::Area)| {
        let (map, _) = world.placement(id).expect("placed");
        ((source(&area.properties).to_owned(), map.0), on_the_map(world, id))
    };
    world.areas.iter().map(entry).collect()
}

/// What a reader says of a place in its file stands there on the Map: rooms, and named places to the last digit.
fn keeps_the_frame(name: &str, survey: &Survey, world: &World) {
    let rooms = rooms_by_source(world);
    let (mut known, mut same) = (0, 0);
    let levels = survey.levels.iter().filter(|l| !l.rooms.is_empty());
    for (level, map) in levels.zip(world.domain.maps.iter()) {
        let x_y = (map.frame.x, map.frame.y);
        assert_eq!(x_y, (Cm::ZERO, Cm::ZERO), "{name}: storeys lie in one frame");
        assert!(!world.maps[&map.map].frame.is_empty(), "{name}");
        for room in &level.rooms {
            let Some(rings) = rooms.get(&(room.source.clone(), map.map.0)) else { continue };
            known += 1;
            let corners: Vec<&Point> = rings.iter().flatten().collect();
            let near = |p: &Point| corners.iter().any(|q| (*q - p).norm() < 1.0);
            same += usize::from(
                room.outline.iter().filter(|p| near(p)).count() * 2 >= room.outline.len(),
            );
        }
        for spot in &level.spots {
            let at = |place: &orthoframe_map::Place| {
                let (_, frame) = world.placement(place.area).expect("placed");
                (frame.apply(place.at) - spot.at).norm() < 1e-6
            };
            let is_out = !level.rooms.iter().any(|r| contains(&r.outline, spot.at));
            assert!(is_out || world.places.values().any(at), "{name}: {}", spot.source);
        }
    }
    assert!(known > 0 && same * 100 >= known * 95, "{name}: {same} of {known}");
}

#[test]
fn every_reader_keeps_the_coordinates_of_its_file() {
    type Reader = fn(&Source) -> Survey;
    let readers: [(&str, Reader); 5] = [
        ("rmf/office.building.yaml", |s| read_rmf(s).expect("sound")),
        ("rmf/triple_H.building.yaml", |s| read_rmf(s).expect("sound")),
        ("osmag/SIST_1.osm", |s| read_osmag(s).expect("sound")),
        ("procthor/house_3.json", |s| read_procthor(s, &sizes()).expect("sound")),
        ("virtualhome/TestScene2_graph.json", |s| read_virtualhome(s).expect("sound")),
    ];
    for (name, reader) in readers {
        let Some(path) = shared(name) else { continue };
        let survey = reader(&file_text(&path).expect("readable"));
        let world = read(&path, &Options::default()).expect("readable").world;
        keeps_the_frame(name, &survey, &world);
    }
}

/// The sizes of ProcTHOR's things.
fn sizes() -> Assets {
    let path = shared("procthor/asset-database.json").expect("beside the houses");
    Assets::read(&file_text(&path).expect("readable")).expect("sound")
}

/// Against the files themselves, not their readers.
#[test]
fn rooms_and_places_stand_where_the_file_has_them() {
    if let Some(path) = shared("procthor/house_3.json") {
        let world = read(&path, &Options::default()).expect("readable").world;
        let house: serde_json::Value =
            serde_json::from_str(file_text(&path).expect("readable").text()).expect("JSON");
        let corners: Vec<Point> =
            world.areas.keys().flat_map(|&a| on_the_map(&world, a)).flatten().collect();
        for p in house["rooms"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|r| r["floorPolygon"].as_array().unwrap())
        {
            let at = Point::new(p["x"].as_f64().unwrap() * 100.0, p["z"].as_f64().unwrap() * 100.0);
            assert!(corners.iter().any(|q| (q - at).norm() < 1.0), "{at}");
        }
    }
    for name in ["rmf/triple_H.building.yaml", "rmf/office.building.yaml"] {
        let Some(path) = shared(name) else { continue };
        let world = read(&path, &Options::default()).expect("readable").world;
        let text = file_text(&path).expect("readable");
        let file: serde_json::Value = serde_saphyr::from_str(text.text()).expect("YAML");
        let level = file["levels"].as_object().unwrap().values().next().unwrap();
        let vertices = level["vertices"].as_array().unwrap();
        let pixels = |i: &serde_json::Value| {
            let v = &vertices[usize::try_from(i.as_u64().unwrap()).unwrap()];
            Point::new(v[0].as_f64().unwrap(), v[1].as_f64().unwrap())
        };
        // Metres of a pixel, as the measurements tell; y runs down in the picture and up on the Map.
        let measured = level["measurements"].as_array().into_iter().flatten().map(|m| {
            m[2]["distance"][1].as_f64().unwrap() / (pixels(&m[0]) - pixels(&m[1])).norm()
        });
        let scales: Vec<f64> = measured.collect();
        let scale =
            if scales.is_empty() { 0.05 } else { scales.iter().sum::<f64>() / scales.len() as f64 };
        let mut known = 0;
        for vertex in vertices {
            let name = vertex[3].as_str().unwrap_or_default();
            let place = world.places.values().find(|p| !name.is_empty() && p.name_en == name);
            let Some(place) = place else { continue };
            let (_, frame) = world.placement(place.area).expect("placed");
            let (x, y) = (vertex[0].as_f64().unwrap(), vertex[1].as_f64().unwrap());
            let at = Point::new(x * scale * 100.0, -y * scale * 100.0);
            assert!((frame.apply(place.at) - at).norm() < 1e-6, "{name}");
            known += 1;
        }
        assert!(known > 3, "{known}");
    }
}

/// A grid whose origin is far from any room's corner, turned too: where the robot of the grid's frame stands, `where`
/// and `route` find it, and all exports come out in that frame again.
#[test]
fn a_grid_keeps_its_frame_through_import_and_export() {
    for (origin, turn) in [((-31.0, -5.4), 0.0), ((12.35, 800.0), 0.0), ((3.0, -7.0), 0.7_f64)] {
        let dir = tempfile::tempdir().expect("a folder");
        // Two rooms of 4 by 3 m at 5 cm, from cell (20, 20), with a doorway of 90 cm between them.
        let (width, height) = (220_usize, 100_usize);
        let is_free = |x: usize, y: usize| {
            let in_rooms = (20..100).contains(&x) || (104..184).contains(&x);
            in_rooms && (20..80).contains(&y) || (100..104).contains(&x) && (40..58).contains(&y)
        };
        let mut picture = format!("P5\n{width} {height}\n255\n").into_bytes();
        for y in (0..height).rev() {
            picture.extend((0..width).map(|x| if is_free(x, y) { 254 } else { 0 }));
        }
        std::fs::write(dir.path().join("flat.pgm"), picture).expect("written");
        let (x0, y0) = origin;
        let yaml = format!(
            "image: flat.pgm\nresolution: 0.05\norigin: [{x0}, {y0}, {turn}]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
        );
        let path = dir.path().join("flat.yaml");
        std::fs::write(&path, yaml).expect("written");
        let world = read(&path, &Options::default()).expect("a grid").world;
        assert_eq!(world.areas.len(), 2);
        // Metres of the picture, as the navigation of a robot counts them.
        let metres = |x: f64, y: f64| {
            let (sin, cos) = turn.sin_cos();
            Point::new(x0 + x * cos - y * sin, y0 + x * sin + y * cos)
        };
        let (left, right) = (metres(3.0, 2.5), metres(7.2, 2.5));
        let engine = Engine::in_memory(world.clone(), None).expect("rules are sound");
        let text = |p: Point| format!("{},{}", p.x * 100.0, p.y * 100.0);
        let found = engine.locate_name(&text(left)).expect("a room");
        let (_, other) = (engine.locate_name(&text(right)).expect("a room"), metres(0.4, 0.4));
        assert!(engine.locate_name(&text(other)).is_err(), "in the wall");
        assert!((found.at - left * 100.0).norm() < 1e-6);
        let answer = engine.route(&text(left), &text(right), orthoframe::engine::Method::Shortest);
        let route = answer.expect("places").route.expect("a way");
        let gate = metres(5.1, 2.45) * 100.0;
        let near = |legs: &[Point]| {
            (0..=50).any(|t| {
                (legs[0] + (legs[1] - legs[0]) * (f64::from(t) / 50.0) - gate).norm() < 40.0
            })
        };
        assert!(route.points.windows(2).any(near), "{:?}", route.points);
        // Out again.
        let map = *world.maps.keys().next().expect("one floor");
        let grid = engine.export_grid(map, 5.0).expect("a grid");
        let sheet =
            orthoframe_exchange::ros::sheet(&Source::new("again.yaml", &grid.yaml)).expect("ours");
        let header =
            grid.pgm.iter().enumerate().filter(|(_, b)| **b == b'\n').nth(2).expect("a head").0 + 1;
        let columns: usize = String::from_utf8_lossy(&grid.pgm[..header])
            .split_whitespace()
            .nth(1)
            .and_then(|n| n.parse().ok())
            .expect("a width");
        let rows = (grid.pgm.len() - header) / columns;
        let pixel = |p: Point| {
            let at = (p * 100.0 - sheet.origin.origin()) / 5.0;
            let (x, y) = (at.x.floor() as usize, at.y.floor() as usize);
            grid.pgm[header + (rows - 1 - y) * columns + x]
        };
        assert_eq!((pixel(left), pixel(right), pixel(metres(5.1, 2.45))), (254, 254, 254));
        assert_ne!(pixel(metres(5.1, 1.4)), 254, "the wall between the rooms");
        let written = dir.path().join("again.geojson");
        std::fs::write(&written, engine.export_geojson().expect("written")).expect("written");
        let again = read(&written, &Options::default()).expect("ours").world;
        let rooms = |world: &World, p: Point| {
            world
                .areas
                .keys()
                .filter(|&&a| on_the_map(world, a).iter().any(|r| contains(r, p * 100.0)))
                .count()
        };
        for p in [left, right, other, metres(5.1, 1.4)] {
            assert_eq!(rooms(&again, p), rooms(&world, p), "{p}");
        }
        let graph: serde_json::Value =
            serde_json::from_str(&engine.export_route_graph(map).expect("a graph")).expect("JSON");
        let nodes = graph["features"].as_array().expect("features").iter();
        let nodes: Vec<Point> = nodes
            .filter(|f| f["geometry"]["type"] == "Point")
            .map(|f| &f["geometry"]["coordinates"])
            .map(|c| Point::new(c[0].as_f64().unwrap(), c[1].as_f64().unwrap()))
            .collect();
        assert!(
            nodes.len() >= 4
                && nodes.iter().all(|&p| rooms(&world, p) > 0 || (p - gate / 100.0).norm() < 0.6)
        );
        // The map file says whose coordinates these are, and reads back.
        let toml = world.to_toml();
        assert!(toml.contains("flat.yaml"), "{toml}");
        assert_eq!(World::load(save(dir.path(), &toml)).expect("our own"), world);
    }
}

/// A robot notes what it saw where it stands in the frame of the map, and finds it there again: in each room, turned or not.
#[test]
fn an_observation_is_taken_and_given_in_the_frame_of_the_map() {
    use orthoframe_store::{Change, Timestamp};
    use orthoframe_units::{Deg, Frame};

    let dir = tempfile::tempdir().expect("a directory");
    let mut world = crate::worlds::rb2();
    // The file of the map has the flat turned.
    let moved = Frame::new(0.0, 0.0, 0.0, Deg::of(90.0));
    for item in world.maps.values_mut().flat_map(|map| &mut map.items) {
        item.frame = moved.compose(&item.frame);
    }
    let file = save(dir.path(), &world.to_toml());
    let mut engine = Engine::open(&dir.path().join("store"), None).expect("a store");
    engine.import(&file, &Change::new("тест", Timestamp(1), "карта")).expect("a map");
    let corners: Vec<(AreaId, Point)> = world
        .areas
        .keys()
        .flat_map(|&area| {
            let ring = on_the_map(&world, area).remove(0);
            let middle = ring.iter().fold(Point::origin(), |m, p| m + p.coords / ring.len() as f64);
            contains(&ring, middle).then_some((area, middle))
        })
        .collect();
    assert!(corners.len() > 2);
    for (n, (area, at)) in corners.iter().enumerate() {
        let pose = Frame::new(at.x, at.y, 12.0, Deg::of(30.0));
        let when = Timestamp(10 + n as i64);
        engine.observe_on_map("Зонт-1", (None, pose), 0.9, "робот", when).expect("seen");
        let found = engine.where_is("Зонт-1", when).expect("known").belief.place;
        assert_eq!(found.area, *area);
        let (_, there) = engine.on_map(&found).expect("a map").expect("placed");
        assert!((there.origin() - at).norm() < 0.02, "{there:?} {at}");
        assert!((there.angle.get() - 30.0).abs() < 0.02 && (there.z.get() - 12.0).abs() < 0.02);
    }
    let outside = Frame::new(9_000.0, 9_000.0, 0.0, Deg::of(0.0));
    assert!(engine.observe_on_map("Зонт-1", (None, outside), 0.9, "робот", Timestamp(99)).is_err());
}

fn save(dir: &std::path::Path, text: &str) -> std::path::PathBuf {
    let path = dir.join("again.toml");
    std::fs::write(&path, text).expect("written");
    path
}

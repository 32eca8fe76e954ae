//! Hostile files: whatever bytes a reader is given, it answers with a survey or a fault, in bounded time and memory.
//!
//! The bodies are those of the fuzz targets (`fuzz/bodies.rs`); here a seeded mutator drives them, so that every run
//! tries the same bytes.

use std::path::{Path, PathBuf};

use orthoframe_exchange::{self as exchange, ReadError};
use orthoframe_units::Source;

use crate::files::project;
use crate::generated_worlds::Dice;

#[path = "../fuzz/bodies.rs"]
mod bodies;

/// Mutations of one reader.
const ROUNDS: usize = 400;

/// Files under a folder of the crate, or of the shared data, that end so; the small ones first.
fn files(folder: &str, endings: &[&str]) -> Vec<Vec<u8>> {
    let mut open = vec![project(folder)];
    let mut found = Vec::new();
    while let Some(dir) = open.pop() {
        for entry in std::fs::read_dir(&dir).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else if endings.iter().any(|e| path.to_string_lossy().ends_with(e)) {
                found.push(path);
            }
        }
    }
    found.sort();
    let mut texts: Vec<Vec<u8>> =
        found.iter().map(|p: &PathBuf| std::fs::read(p).expect("a file is readable")).collect();
    texts.retain(|t| t.len() < 40_000);
    texts.sort_by_key(Vec::len);
    texts
}

/// A corridor and four rooms as a binary grey map.
fn picture() -> Vec<u8> {
    let (width, height) = (120, 106);
    let mut pixels = vec![0_u8; width * height];
    let mut fill = |x0: usize, y0: usize, x1: usize, y1: usize| {
        (y0..y1).for_each(|y| pixels[y * width + x0..y * width + x1].fill(254));
    };
    fill(4, 38, 116, 68);
    for (x0, x1) in [(4, 58), (62, 116)] {
        fill(x0, 4, x1, 34);
        fill(x0, 72, x1, 102);
        fill(x0 + 20, 34, x0 + 37, 38);
        fill(x0 + 20, 68, x0 + 37, 72);
    }
    let mut bytes = format!("P5\n# made by a test\n{width} {height}\n255\n").into_bytes();
    bytes.extend(pixels);
    bytes
}

const SHEET: &[u8] = b"image: a.pgm\nresolution: 0.05\norigin: [-1.5, 2, 0.3]\nnegate: 0\n\
                       occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n";

/// A house and a graph that are small enough to mutate by hundreds.
const HOUSE: &str = r#"{"rooms":[{"id":"room|2","roomType":"Kitchen","floorPolygon":[{"x":0,"y":0,"z":0},{"x":0,"y":0,"z":4},{"x":5,"y":0,"z":4},{"x":5,"y":0,"z":0}]}],"walls":[],"doors":[],"windows":[],"objects":[{"id":"Chair|1","assetId":"Chair_1","position":{"x":1,"y":0.4,"z":1},"rotation":{"x":0,"y":90,"z":0},"children":[]}]}"#;
const GRAPH: &str = r#"{"nodes":[{"id":1,"class_name":"kitchen","category":"Rooms","properties":[],"states":[],"bounding_box":{"center":[0,1,0],"size":[5,2.5,4]}},{"id":2,"class_name":"chair","category":"Furniture","properties":["SITTABLE"],"states":["CLEAN"],"bounding_box":{"center":[1,0.4,1],"size":[0.5,0.9,0.5]}}],"edges":[{"from_id":2,"to_id":1,"relation_type":"INSIDE"}]}"#;
const EVENT: &str = r#"{"objects":[{"objectId":"Floor|0|0|0","objectType":"Floor","position":{"x":0,"y":0,"z":0},"axisAlignedBoundingBox":{"center":{"x":0,"y":0,"z":0},"size":{"x":5,"y":0.1,"z":4}}},{"objectId":"Chair|1|0|1","objectType":"Chair","position":{"x":1,"y":0,"z":1},"rotation":{"x":0,"y":90,"z":0},"axisAlignedBoundingBox":{"center":{"x":1,"y":0.4,"z":1},"size":{"x":0.5,"y":0.9,"z":0.5}}}]}"#;

/// Two rooms with a door between them on two floors, a lift, a chair.
const YARD: &str = r#"coordinate_system: cartesian_meters
name: yard
levels:
  L1: &floor
    elevation: 0
    vertices:
      - [0, 0, 0, ""]
      - [6, 0, 0, ""]
      - [6, 4, 0, ""]
      - [0, 4, 0, ""]
      - [3, 0, 0, ""]
      - [3, 4, 0, ""]
      - [3, 1, 0, ""]
      - [3, 2, 0, ""]
      - [1, 1, 0, "charger", {is_charger: [4, true]}]
    walls:
      - [0, 4, {}]
      - [4, 1, {}]
      - [1, 2, {}]
      - [2, 5, {}]
      - [5, 3, {}]
      - [3, 0, {}]
      - [4, 6, {}]
      - [7, 5, {}]
    doors:
      - [6, 7, {motion_axis: [1, start], motion_degrees: [3, 90], motion_direction: [2, 1], name: [1, main], type: [1, hinged]}]
    models:
      - {model_name: OfficeChairBlack, name: chair, static: true, x: 1, y: 2, yaw: 0.5, z: 0}
  L2:
    <<: *floor
    elevation: 3
lifts:
  shaft: {depth: 1.2, width: 1.2, x: 5, y: 3, yaw: 0, lowest_floor: L1, highest_floor: L2, reference_floor_name: L1, doors: {front: {door_type: 2, motion_axis_orientation: 0, width: 0.9, x: 0, y: 0.7}}, level_doors: {L1: [front], L2: [front]}}
"#;

/// Two areas with a passage.
const BLOCK: &str = r#"<?xml version='1.0' encoding='UTF-8'?>
<osm version='0.6'>
  <node id='-1' lat='31.17900' lon='121.59100'><tag k='name' v='root'/></node>
  <node id='-2' lat='31.17900' lon='121.59105'/>
  <node id='-3' lat='31.17905' lon='121.59105'/>
  <node id='-4' lat='31.17905' lon='121.59100'/>
  <node id='-5' lat='31.17900' lon='121.59110'/>
  <node id='-6' lat='31.17905' lon='121.59110'/>
  <node id='-7' lat='31.17902' lon='121.59105'/>
  <node id='-8' lat='31.17903' lon='121.59105'/>
  <way id='-11'><nd ref='-1'/><nd ref='-2'/><nd ref='-7'/><nd ref='-8'/><nd ref='-3'/><nd ref='-4'/><nd ref='-1'/>
    <tag k='name' v='A1'/><tag k='level' v='1'/><tag k='indoor' v='room'/><tag k='osmAG:type' v='area'/><tag k='osmAG:areaType' v='room'/></way>
  <way id='-12'><nd ref='-2'/><nd ref='-5'/><nd ref='-6'/><nd ref='-3'/><nd ref='-8'/><nd ref='-7'/><nd ref='-2'/>
    <tag k='name' v='A2'/><tag k='level' v='1'/><tag k='indoor' v='room'/><tag k='osmAG:type' v='area'/><tag k='osmAG:areaType' v='room'/></way>
  <way id='-13'><nd ref='-7'/><nd ref='-8'/>
    <tag k='level' v='1'/><tag k='osmAG:from' v='A1'/><tag k='osmAG:to' v='A2'/><tag k='osmAG:type' v='passage'/></way>
</osm>
"#;

fn corpus(name: &str) -> Vec<Vec<u8>> {
    let seeds = match name {
        "geojson" => files("tests/golden/formats", &[".geojson"]),
        "ifc" => files("tests/golden/formats", &[".ifc"]),
        "ros_grid" => vec![picture()],
        "ros_sheet" => vec![SHEET.to_vec()],
        "procthor" => vec![HOUSE.into()],
        "thor" => vec![EVENT.into()],
        "virtualhome" => vec![GRAPH.into()],
        "pyrobosim" => files("tests/golden/pyrobosim", &["/flat.yaml"]),
        "rmf" => vec![YARD.into()],
        "osmag" => vec![BLOCK.into()],
        "map_file" => files("maps", &["box.toml", "room.toml"]),
        other => panic!("{other} has no corpus"),
    };
    assert!(!seeds.is_empty(), "{name} has no corpus");
    seeds
}

/// Words that have broken readers before.
const WORDS: [&str; 24] = [
    "1e300",
    "-1e300",
    "1e999",
    "NaN",
    ".nan",
    ".inf",
    "-0",
    "null",
    "true",
    "\"\"",
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    "'",
    "\\X2\\",
    "$",
    "#1",
    "999999999999999999999",
    "\0",
    "\u{FEFF}",
    "*a",
];

fn mutated(dice: &mut Dice, seeds: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = seeds[dice.below(seeds.len())].clone();
    for _ in 0..=dice.below(4) {
        let length = bytes.len();
        let at = dice.below(length + 1);
        let to = (at + dice.below(40)).min(length);
        match dice.below(8) {
            0 if at < length => bytes[at] ^= 1 << dice.below(8),
            1 if at < length => bytes[at] = dice.below(256) as u8,
            2 => drop(bytes.drain(at..to)),
            3 => drop(bytes.splice(at..to, WORDS[dice.below(WORDS.len())].bytes())),
            4 => {
                let piece = bytes[at..to].repeat(1 + dice.below(30));
                drop(bytes.splice(at..at, piece));
            }
            5 => {
                let other = &seeds[dice.below(seeds.len())];
                let from = dice.below(other.len() + 1);
                let end = (from + dice.below(200)).min(other.len());
                drop(bytes.splice(at..at, other[from..end].iter().copied()));
            }
            6 => {
                // One number becomes another.
                let digit = (at..length).find(|i| bytes[*i].is_ascii_digit());
                if let Some(digit) = digit {
                    let word = WORDS[dice.below(7)];
                    drop(bytes.splice(digit..=digit, word.bytes()));
                }
            }
            _ => bytes.truncate(at),
        }
    }
    bytes
}

#[test]
fn mutated_files_are_read_or_refused() {
    let mut read = 0;
    for (name, body) in bodies::BODIES {
        let seeds = corpus(name);
        assert!(seeds.iter().any(|seed| body(seed).is_ok()), "{name} reads none of its corpus");
        let mut dice = Dice::new(20_260_101);
        for round in 0..ROUNDS {
            let bytes = mutated(&mut dice, &seeds);
            let outcome = std::panic::catch_unwind(|| body(&bytes));
            let Ok(outcome) = outcome else {
                let path = std::env::temp_dir().join(format!("hostile-{name}-{round}"));
                std::fs::write(&path, &bytes).expect("the find is kept");
                panic!("{name}, round {round}: a panic; the bytes are in {}", path.display());
            };
            read += usize::from(outcome.is_ok());
        }
    }
    // A mutator that only makes rubbish would test the first line of each reader.
    assert!(read > ROUNDS, "{read}");
}

#[test]
fn files_that_break_off_are_read_or_refused() {
    for (name, body) in bodies::BODIES {
        for seed in corpus(name) {
            let step = (seed.len() / 60).max(1);
            for end in (0..seed.len()).step_by(step) {
                let _ = body(&seed[..end]);
            }
        }
    }
}

fn golden(name: &str) -> Vec<u8> {
    std::fs::read(project("tests/golden/formats").join(name)).expect("a golden case")
}

fn shown<T>(outcome: Result<T, ReadError>) -> String {
    outcome.map_or_else(|e| e.to_string(), |_| "читается".to_owned())
}

#[test]
fn every_encoding_of_a_text_gives_the_same_survey() {
    let bytes = golden("plain_metres/input.geojson");
    let text = String::from_utf8(bytes.clone()).expect("UTF-8");
    let read = |bytes: Vec<u8>| {
        let source = exchange::decode("input.geojson", bytes).expect("a text");
        exchange::geojson::read(&source).expect("a building")
    };
    let plain = read(bytes.clone());
    let utf16: Vec<u8> =
        std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> =
        std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(u16::to_be_bytes).collect();
    let cyrillic = |c: char| match c {
        'Ё' => 0xA8,
        'ё' => 0xB8,
        'А'..='я' => (c as u32 - 0x410 + 0xC0) as u8,
        c => c as u8,
    };
    let windows: Vec<u8> = text.chars().map(cyrillic).collect();
    for other in [[b"\xEF\xBB\xBF".to_vec(), bytes].concat(), utf16, big, windows] {
        assert_eq!(read(other), plain);
    }
}

#[test]
fn what_is_no_building_is_refused_with_the_reason() {
    let geojson = |text: &str| shown(exchange::geojson::read(&Source::new("x", text)));
    let ifc = |text: &str| shown(exchange::ifc::read(&Source::new("x", text)));
    assert_eq!(geojson(""), "GeoJSON: текст оборван (EOF while parsing a value)");
    assert_eq!(geojson("{}"), "GeoJSON: нет членов «type» и «features»");
    assert_eq!(
        geojson(r#"{"type": "Topology"}"#),
        "GeoJSON: «type» здесь «Topology», а нужен FeatureCollection"
    );
    assert_eq!(
        geojson(r#"{"type": "FeatureCollection", "features": []}"#),
        "GeoJSON: нет ни одного помещения"
    );
    assert_eq!(ifc("solid cube"), "IFC: текст не начинается с ISO-10303-21");
    assert_eq!(
        ifc("ISO-10303-21;HEADER;ENDSEC;DATA;\n#1=IFCSPACE('a'"),
        "IFC: текст оборван посреди записи"
    );
    assert_eq!(
        ifc("ISO-10303-21;HEADER;ENDSEC;DATA;\n#1=IFCWALL('a');\nENDSEC;END-ISO-10303-21;"),
        "IFC: в модели нет помещений (IfcSpace)"
    );
    let bytes = exchange::decode("map.pgm", b"P5\n1 1\n255\n\x00".to_vec());
    assert_eq!(shown(bytes), "«map.pgm» – картинка, а масштаба она не говорит");
    let bytes = exchange::decode("map.txt", b"no map\n\x00".to_vec());
    assert_eq!(shown(bytes), "«map.txt» – не текст: байт 7 равен 0x00");
}

#[test]
fn faults_of_json_are_shown_in_their_place() {
    let text = "{\"type\": \"FeatureCollection\",\n \"Помещения\": \"Кухня\", ?}";
    let Err(ReadError::Syntax { at, text, .. }) = exchange::geojson::read(&Source::new("x", text))
    else {
        panic!("no JSON at all")
    };
    assert_eq!(text.position(at.offset()), (2, 24));
}

#[test]
fn deep_nesting_costs_no_stack() {
    let json = format!("{{\"type\":\"FeatureCollection\",\"features\":{}", "[".repeat(300_000));
    assert!(
        shown(exchange::geojson::read(&Source::new("x", &json)))
            .starts_with("GeoJSON: текст оборван")
    );
    let deep = "(".repeat(300_000);
    let step = format!("ISO-10303-21;DATA;\n#1=IFCSPACE({deep}");
    let said = shown(exchange::ifc::read(&Source::new("x", &step)));
    assert_eq!(said, "IFC: текст оборван посреди записи");
    let yaml = "image: ".to_owned() + &"[".repeat(100_000);
    assert!(exchange::ros::sheet(&Source::new("x", &yaml)).is_err());
}

#[test]
fn bombs_of_references_do_not_go_off() {
    let mut yaml = String::from("a: &a [x,x,x,x,x,x,x,x,x]\n");
    for level in ["b", "c", "d", "e", "f", "g", "h", "i"] {
        let below = char::from(level.as_bytes()[0] - 1);
        yaml += &format!("{level}: &{level} [{}]\n", vec![format!("*{below}"); 9].join(","));
    }
    assert!(exchange::ros::sheet(&Source::new("x", &yaml)).is_err());
    // Shapes that map shapes that map shapes, twenty each, forty deep.
    let mut step = String::from("ISO-10303-21;HEADER;ENDSEC;DATA;\n");
    for n in 0..40 {
        let items = vec![format!("#{}", 100 + 10 * (n + 1)); 20].join(",");
        let (item, map, shape) = (100 + 10 * n, 101 + 10 * n, 102 + 10 * n);
        step += &format!(
            "#{item}=IFCMAPPEDITEM(#{map},$);\n#{map}=IFCREPRESENTATIONMAP($,#{shape});\n"
        );
        step += &format!("#{shape}=IFCSHAPEREPRESENTATION($,'Body','x',({items}));\n");
    }
    step += "#1=IFCSHAPEREPRESENTATION($,'Body','x',(#100));\n#2=IFCPRODUCTDEFINITIONSHAPE($,$,(#1));\n";
    // A placement that stands in itself.
    step += "#3=IFCLOCALPLACEMENT(#3,$);\n#4=IFCSPACE('s',$,'1',$,$,#3,#2,$,$,$,$);\n";
    step += "#5=IFCRELAGGREGATES('r',$,$,$,#4,(#4));\nENDSEC;END-ISO-10303-21;";
    let said = shown(exchange::ifc::read(&Source::new("x", &step)));
    assert_eq!(said, "IFC: ни у одного помещения (IfcSpace) нет контура");
}

#[test]
fn coordinates_beyond_any_building_are_left_out() {
    let room = |id: &str, size: &str| {
        format!(
            r#"{{"type":"Feature","id":"{id}","properties":{{"type":"room"}},"geometry":{{"type":"Polygon","coordinates":[[[0,0],[{size},0],[{size},4],[0,4],[0,0]]]}}}}"#
        )
    };
    let rooms = [room("good", "5"), room("huge", "1e300"), room("more", "1e999")].join(",");
    let text = format!(r#"{{"type":"FeatureCollection","features":[{rooms}]}}"#);
    let survey = exchange::geojson::read(&Source::new("x", text)).expect("one room is sound");
    let ids: Vec<&str> = survey.levels[0].rooms.iter().map(|r| r.source.as_str()).collect();
    assert_eq!(ids, ["good"]);
    let told: Vec<&str> = survey.remarks.iter().map(|r| r.source.as_str()).collect();
    assert!(told.contains(&"huge") && told.contains(&"features[2]"), "{told:?}");
}

#[test]
fn two_million_vertices_are_refused_quickly() {
    let mut ring = String::with_capacity(40 << 20);
    for n in 0..2_000_000 {
        let angle = f64::from(n) * std::f64::consts::TAU / 2e6;
        ring += &format!("[{:.5},{:.5}],", 500.0 * angle.cos(), 500.0 * angle.sin());
    }
    let text = format!(
        r#"{{"type":"FeatureCollection","features":[{{"type":"Feature","id":"ring","properties":{{}},"geometry":{{"type":"Polygon","coordinates":[[{ring}[500,0]]]}}}}]}}"#
    );
    let said = shown(exchange::geojson::read(&Source::new("x", text)));
    assert!(said.starts_with("GeoJSON: нет ни одного помещения; ring: контур из "), "{said}");
}

#[test]
fn a_file_is_known_by_its_content_and_read_by_path() {
    let read = |path: &Path| exchange::read(path, &exchange::Options::default());
    let folder = project("tests/golden/formats");
    for (case, rooms) in [
        ("imdf_station", 9),
        ("plain_metres/input.geojson", 3),
        ("osm_indoor/input.geojson", 7),
        ("ifc2x3_flat/input.ifc", 2),
        ("ifc4_two_storeys/input.ifc", 4),
    ] {
        let imported = read(&folder.join(case)).unwrap_or_else(|e| panic!("{case}: {e}"));
        assert_eq!(imported.world.areas.len(), rooms, "{case}");
    }
    let dir = tempfile::tempdir().expect("a folder");
    std::fs::write(dir.path().join("office.yaml"), SHEET).expect("written");
    std::fs::write(dir.path().join("a.pgm"), picture()).expect("written");
    let imported = read(&dir.path().join("office.yaml")).expect("a grid");
    assert_eq!((imported.world.areas.len(), imported.world.doors.len()), (5, 4));
    std::fs::remove_file(dir.path().join("a.pgm")).expect("removed");
    let said = read(&dir.path().join("office.yaml")).map(|_| ()).unwrap_err().to_string();
    assert!(said.contains("a.pgm") && said.contains("не читается"), "{said}");
}

//! Drawings of the rb2 flat: everything named is there and legible, pictures have letters, the same input gives the
//! same bytes.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::{Drawing, Lens, Method, State};
use orthoframe_corridor::{CorridorSystem, Shape, Variant, figure};
use orthoframe_draw::{
    CorridorArc, CorridorDrawing, CorridorMark, CorridorSign, CorridorVertex, corridor_svg,
    text_width,
};
use orthoframe_exchange::{Level, Options, Report, Room, Survey, Synonyms, assemble, read};
use orthoframe_geometry::{Openings, STEP_REACH};
use orthoframe_map::{Format, World};
use orthoframe_units::{Language, Point, Source};

use crate::files::shared;
use crate::worlds::rb2;

fn engine() -> Engine {
    Engine::in_memory(rb2(), None).expect("rules that are built in")
}

/// Texts of an SVG with their places, sizes and turns: `(text, x, y, size)`.
fn texts(svg: &str) -> Vec<(String, f64, f64, f64)> {
    let attribute = |tag: &str, name: &str| {
        let from = tag.find(&format!(" {name}=\""))? + name.len() + 3;
        tag[from..].split('"').next()?.parse::<f64>().ok()
    };
    svg.split("<text ")
        .skip(1)
        .filter_map(|rest| {
            let (tag, after) = rest.split_once('>')?;
            let tag = format!(" {tag}");
            let text = after.split("</text>").next()?.trim().to_owned();
            Some((
                text,
                attribute(&tag, "x")?,
                attribute(&tag, "y")?,
                attribute(&tag, "font-size")?,
            ))
        })
        .collect()
}

#[test]
fn a_plan_names_every_room_and_every_piece_of_furniture() {
    let engine = engine();
    let world = engine.world().unwrap();
    let (map, _) = engine.sheet_named(None).unwrap();
    let svg = engine.draw(map, &Drawing::default()).unwrap();
    let shown: Vec<String> = texts(&svg).into_iter().map(|t| t.0).collect();
    let rooms = world.areas.values().map(|a| &a.name);
    let places = world.places.values().map(|p| &p.name);
    for name in rooms.chain(places) {
        assert!(shown.contains(name), "{name} is not on the plan");
    }
    let things: Vec<&String> = world.replicas.values().map(|r| &r.name).collect();
    let named = things.iter().filter(|n| shown.contains(n)).count();
    assert!(named * 100 >= things.len() * 95, "{named} of {} things are named", things.len());
}

#[test]
fn a_room_of_its_own_leaves_the_others_out() {
    let engine = engine();
    let (map, only) = engine.sheet_named(Some("Комната-В")).unwrap();
    let svg = engine.draw(map, &Drawing { only, ..Drawing::default() }).unwrap();
    assert!(svg.contains("Диван-1") && !svg.contains("Кровать-1"));
}

/// The lowest point of the ways of doors' leaves, which are drawn in dashes.
fn lowest_dash(svg: &str) -> f64 {
    let paths = svg.split("<path ").skip(1).filter_map(|rest| rest.split("/>").next());
    let dashed = paths.filter(|tag| tag.contains("stroke-dasharray"));
    let lowest = dashed.filter_map(|tag| {
        let data = tag.split("d=\"").nth(1)?.split('"').next()?;
        let numbers = data.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
        let numbers: Vec<f64> = numbers.filter_map(|n| n.parse().ok()).collect();
        numbers.chunks(2).filter_map(|pair| pair.get(1)).copied().reduce(f64::max)
    });
    lowest.fold(0.0, f64::max)
}

/// The front door of the flat opens outwards, below the plan: the legend stands lower still.
#[test]
fn the_legend_keeps_clear_of_the_doors() {
    let engine = engine();
    let (map, _) = engine.sheet_named(None).unwrap();
    for all in [false, true] {
        let drawing = Drawing { floor: all, network: all, ..Drawing::default() };
        let svg = engine.draw(map, &drawing).unwrap();
        let swing = lowest_dash(&svg);
        let shown = texts(&svg);
        let words = ["мебель", "подвижное", "место", "заперто"];
        for word in words {
            let (_, _, y, size) = shown.iter().find(|t| t.0 == word).expect(word);
            assert!(y - size > swing, "{word} stands at {y}, the door reaches to {swing}");
        }
    }
}

#[test]
fn english_letters_where_the_map_has_them() {
    let engine = engine();
    let (map, _) = engine.sheet_named(None).unwrap();
    let drawing = Drawing { language: Language::English, ..Drawing::default() };
    let shown = texts(&engine.draw(map, &drawing).unwrap());
    assert!(shown.iter().any(|t| t.0 == "Room V"));
    assert!(shown.iter().any(|t| t.0.ends_with(" m²")));
}

#[test]
fn an_object_has_three_views_with_its_sizes() {
    let engine = engine();
    for name in ["Стеллаж-1", "Книжный стеллаж", "bookshelf"] {
        let shown: Vec<String> = texts(&engine.draw_object(name, Language::Russian).unwrap())
            .into_iter()
            .map(|t| t.0)
            .collect();
        for wanted in ["Фасад", "Профиль", "План", "190", "90", "30", "50", "45", "A", "E"]
        {
            assert!(shown.iter().any(|t| t == wanted), "{name}: {wanted} is missing in {shown:?}");
        }
    }
    assert!(engine.draw_object("Стеллаж-99", Language::Russian).is_err());
}

/// A table on a plate with a tilted front must come out upright: its façade is as wide as its front.
#[test]
fn a_facade_is_seen_from_the_marked_front() {
    let text = r#"
        format = 1
        [orthoframe.floor]
        rect = [400, 300]
        height = 270
        [orthoframe.block]
        rect = [80, 30]
        height = 110
        [object.chest]
        name = "Сундук"
        items = [{ id = "A", orthoframe = "block" }]
        front = "A.B"
        [area.study]
        name = "Кабинет"
        items = [{ id = "A", orthoframe = "floor" }]
        [map.flat]
        items = [{ area = "study" }]
    "#;
    let world = World::parse(&Source::new("chest.toml", text), Format::Toml).unwrap();
    let engine = Engine::in_memory(world, None).unwrap();
    let shown = texts(&engine.draw_object("Сундук", Language::Russian).unwrap());
    let below_facade = shown.iter().find(|t| t.0 == "30").expect("the façade's width");
    let below_profile = shown.iter().find(|t| t.0 == "80").expect("the profile's width");
    assert!(below_facade.1 < below_profile.1);
}

#[test]
fn a_view_shows_what_is_before_the_eye_and_not_what_is_behind_it() {
    let engine = engine();
    let (map, _) = engine.sheet_named(None).unwrap();
    let lens = |pose: &str| Lens {
        pose: State::parse_pose(pose).unwrap(),
        height: 120.0,
        field: 90.0,
        range: 1200.0,
    };
    let seen = |pose: &str| {
        let svg = engine.draw_view(map, lens(pose), Language::Russian).unwrap();
        texts(&svg).into_iter().map(|t| t.0).collect::<Vec<_>>()
    };
    let ahead = seen("370,140,120");
    assert!(ahead.contains(&"Диван-1".to_owned()) && ahead.contains(&"Стул-1".to_owned()));
    assert!(!ahead.contains(&"Шкаф-1".to_owned()), "the wardrobe stands behind: {ahead:?}");
    assert!(!ahead.contains(&"Кровать-1".to_owned()), "a wall hides the bed: {ahead:?}");
    assert!(seen("370,140,-90").contains(&"Шкаф-1".to_owned()));
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let (one, other) = (engine(), engine());
    let (map, _) = one.sheet_named(None).unwrap();
    let all = Drawing { floor: true, network: true, ..Drawing::default() };
    assert_eq!(one.draw(map, &all).unwrap(), other.draw(map, &all).unwrap());
}

#[cfg(feature = "pictures")]
#[test]
fn a_png_has_its_letters_without_any_font_of_the_machine() {
    let picture = |svg: &str| {
        let png = orthoframe_draw::png(svg, Some(400)).expect("a good drawing");
        assert!(png.starts_with(b"\x89PNG"));
        png
    };
    let engine = engine();
    let svg = engine.draw_object("Стеллаж-1", Language::Russian).unwrap();
    // Without the texts the picture is another one.
    let bare: String =
        svg.split("<text ").map(|part| part.split_once("</text>").map_or(part, |p| p.1)).collect();
    assert_ne!(picture(&svg), picture(&bare));
    assert!(orthoframe_draw::png("not a drawing", None).is_err());
    assert!(orthoframe_draw::png(&svg, Some(u32::MAX)).is_err());
}

/// Where much stands close together, what bears no name bears a number, told below the plan; no letters are too small.
#[test]
fn what_has_no_place_for_its_name_is_told_by_a_number() {
    let Some(path) = shared("virtualhome/TestScene2_graph.json") else { return };
    let imported = read(&path, &Options::default()).unwrap();
    let engine = Engine::in_memory(imported.world, None).unwrap();
    let world = engine.world().unwrap();
    let (map, _) = engine.sheet_named(None).unwrap();
    let svg = engine.draw(map, &Drawing::default()).unwrap();
    let shown = texts(&svg);
    let number = |text: &str| text.parse::<usize>().ok().filter(|&n| n > 0);
    let below = shown.iter().find(|t| t.0 == "мебель").unwrap().2;
    let on_plan: Vec<usize> =
        shown.iter().filter(|t| t.2 < below).filter_map(|t| number(&t.0)).collect();
    let listed: Vec<usize> =
        shown.iter().filter(|t| t.2 > below).filter_map(|t| number(&t.0)).collect();
    assert!(listed.len() > 20, "{}", listed.len());
    assert_eq!(listed, (1..=listed.len()).collect::<Vec<_>>());
    let mut sorted = on_plan;
    sorted.sort_unstable();
    assert_eq!(sorted, listed);
    // Each is the number of one thing, which is named nowhere else.
    for replica in world.replicas.values() {
        assert!(shown.iter().filter(|t| t.0 == replica.name).count() < 2, "{}", replica.name);
    }
    let number_after = |name: &str| -> f64 {
        svg.split(name).nth(1).and_then(|rest| rest.split([' ', '"']).next()?.parse().ok()).unwrap()
    };
    let pixels = number_after(" width=\"") / number_after("viewBox=\"0 0 ");
    let smallest = shown.iter().map(|t| t.3 * pixels).fold(f64::INFINITY, f64::min);
    assert!(smallest > 7.9, "letters of {smallest} pixels");
}

/// One text of a drawing as it lies on the sheet: what it says, its letters' size, and the box of its letters.
#[derive(Debug)]
struct Written {
    text: String,
    size: f64,
    /// left, top, right, bottom; none where it slants.
    frame: Option<[f64; 4]>,
}

fn attribute<'t>(tag: &'t str, name: &str) -> Option<&'t str> {
    let from = tag.find(&format!(" {name}=\""))? + name.len() + 3;
    tag[from..].split('"').next()
}

fn number(tag: &str, name: &str) -> Option<f64> {
    attribute(tag, name)?.parse().ok()
}

/// Width and height of the sheet, in the units of its texts.
fn sheet(svg: &str) -> (f64, f64) {
    let head = format!(" {}", svg.split('>').next().unwrap());
    let mut sizes = attribute(&head, "viewBox").unwrap().split(' ').skip(2);
    let mut next = || sizes.next().unwrap().parse::<f64>().unwrap();
    (next(), next())
}

fn written(svg: &str) -> Vec<Written> {
    let one = |rest: &str| {
        let (tag, after) = rest.split_once('>')?;
        let tag = format!(" {tag}");
        let text = after.split("</text>").next()?.trim();
        let text = text.replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">");
        let (x, y, size) = (number(&tag, "x")?, number(&tag, "y")?, number(&tag, "font-size")?);
        let wide = text_width(&text, size, attribute(&tag, "font-weight") == Some("bold"));
        // Of the letters without their rim, from the foot to the head.
        let (low, high) = (y, y - 0.72 * size);
        let middle = attribute(&tag, "text-anchor") == Some("middle");
        let left = if middle { x - wide / 2.0 } else { x };
        let turn = attribute(&tag, "transform").map(|t| t.trim_start_matches("rotate("));
        let turn = turn.and_then(|t| t.split([' ', ')']).next()?.parse::<f64>().ok());
        let frame = match turn {
            None => Some([left, high, left + wide, low]),
            Some(turn) if (turn + 90.0).abs() < 1e-6 => {
                Some([x - 0.72 * size, y - wide / 2.0, x, y + wide / 2.0])
            }
            Some(_) => None,
        };
        Some(Written { text, size, frame })
    };
    svg.split("<text ").skip(1).filter_map(one).filter(|w| !w.text.is_empty()).collect()
}

/// With ORTHOFRAME_DRAWINGS=DIR what is drawn is kept there, to be looked at.
fn keep(name: &str, svg: &str) {
    let Some(dir) = std::env::var_os("ORTHOFRAME_DRAWINGS") else { return };
    let dir = std::path::Path::new(&dir);
    std::fs::create_dir_all(dir).unwrap();
    let file: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    std::fs::write(dir.join(format!("{file}.svg")), svg).unwrap();
    #[cfg(feature = "pictures")]
    std::fs::write(dir.join(format!("{file}.png")), orthoframe_draw::png(svg, None).unwrap())
        .unwrap();
}

/// What every drawing keeps: its letters can be read at the size of the sheet, none is cut by the border, and no two
/// texts lie on one another.
fn check_texts(name: &str, svg: &str) {
    keep(name, svg);
    let (width, height) = sheet(svg);
    let texts = written(svg);
    assert!(!texts.is_empty(), "{name}");
    for w in &texts {
        let share = w.size / width.max(height);
        assert!(share >= 0.004, "{name}: «{}» is {share:.4} of the sheet", w.text);
        if let Some([left, top, right, bottom]) = w.frame {
            let is_whole =
                left >= -0.5 && top >= -0.5 && right <= width + 0.5 && bottom <= height + 0.5;
            assert!(is_whole, "{name}: {w:?} is cut by a sheet of {width} x {height}");
        }
    }
    for (k, one) in texts.iter().enumerate() {
        for other in &texts[k + 1..] {
            let (Some(a), Some(b)) = (one.frame, other.frame) else { continue };
            let slack = 0.06 * one.size.min(other.size);
            let over = |i: usize| a[i + 2].min(b[i + 2]) - a[i].max(b[i]);
            assert!(over(0) <= slack || over(1) <= slack, "{name}: {one:?} lies on {other:?}");
        }
    }
}

/// The classes of shapes, and those that the legend explains.
fn classes(svg: &str) -> (BTreeSet<String>, BTreeSet<String>) {
    let (mut drawn, mut told) = (BTreeSet::new(), BTreeSet::new());
    for tag in svg.split('<').skip(1).filter(|tag| !tag.starts_with("text")) {
        let Some(class) = attribute(tag, "class") else { continue };
        match class.strip_prefix("key") {
            Some(of) => told.insert(of.trim().to_owned()),
            None => drawn.insert(class.to_owned()),
        };
    }
    (drawn, told)
}

/// Whatever is drawn stands in the legend, and nothing else does. Rooms bear their names, and strokes that make a bed of
/// a box are pictures; corridors are the ground on which a road graph lies, and thin lines lead from a name to its thing.
fn check_legend(name: &str, svg: &str) {
    let plain = ["room", "sign", "scale", "corridor", "name"];
    let (drawn, told) = classes(svg);
    let drawn: BTreeSet<_> = drawn.into_iter().filter(|c| !plain.contains(&c.as_str())).collect();
    let told: BTreeSet<_> = told.into_iter().filter(|c| !c.is_empty()).collect();
    assert_eq!(drawn, told, "{name}");
}

fn ids(svg: &str) -> BTreeMap<String, usize> {
    let mut ids = BTreeMap::new();
    for id in svg.split('<').filter_map(|tag| attribute(tag, "id")) {
        *ids.entry(id.to_owned()).or_default() += 1;
    }
    ids
}

/// A building of many rooms in a grid.
fn large(columns: usize, rows: usize) -> World {
    let room = |n: usize| {
        let (x, y) = ((n % columns) as f64 * 520.0, (n / columns) as f64 * 420.0);
        let corners = [(0.0, 0.0), (500.0, 0.0), (500.0, 400.0), (0.0, 400.0)];
        Room {
            source: n.to_string(),
            name: format!("E1b-F{}-{n:03}", n / columns),
            kind: "office".to_owned(),
            outline: corners.map(|(dx, dy)| Point::new(x + dx, y + dy)).into(),
            ..Room::default()
        }
    };
    let level = Level { rooms: (0..columns * rows).map(room).collect(), ..Level::default() };
    let survey = Survey { levels: vec![level], ..Survey::default() };
    assemble(&survey, &Synonyms::built_in(), &mut Report::default()).unwrap()
}

/// Worlds small and large, of ours and of others; the largest with ORTHOFRAME_LONG alone.
fn worlds() -> Vec<(String, World)> {
    let mut worlds = vec![("rb2".to_owned(), rb2()), ("large".to_owned(), large(20, 8))];
    let mut files = vec!["cases/office-two-storeys.toml", "procthor/house_4.json"];
    if crate::files::long() {
        files.extend([
            "rmf/clinic.building.yaml",
            "rmf/office.building.yaml",
            "osmag/SIST_1.osm",
            "virtualhome/TestScene2_graph.json",
        ]);
    }
    for file in files {
        if let Some(path) = shared(file) {
            worlds.push((file.to_owned(), read(&path, &Options::default()).unwrap().world));
        }
    }
    worlds
}

#[test]
fn plans_can_be_read_and_their_legends_tell_all() {
    for (name, world) in worlds() {
        let engine = Engine::in_memory(world, None).unwrap();
        let world = engine.world().unwrap();
        let sheets = engine.sheets_named(None).unwrap();
        assert_eq!(sheets.len(), world.maps.len(), "{name}: a sheet for each storey");
        for (map, only) in sheets {
            for all in [false, true] {
                let drawing = Drawing { only, floor: all, network: all, ..Drawing::default() };
                let svg = engine.draw(map, &drawing).unwrap();
                let name = format!("{name}, {map:?}, floor {all}");
                check_texts(&name, &svg);
                check_legend(&name, &svg);
                let ids = ids(&svg);
                assert!(ids.values().all(|n| *n == 1), "{name}: {ids:?}");
                let on_map = |area| world.placement(area).is_some_and(|(on, _)| on == map);
                let rooms = world.areas.keys().filter(|a| on_map(**a));
                assert!(rooms.into_iter().all(|a| ids.contains_key(&format!("room-{}", a.0))));
                let things = world.replicas.values().filter(|r| on_map(r.area));
                for thing in things {
                    assert!(ids.contains_key(&format!("thing-{}", thing.id.0)), "{}", thing.name);
                }
                let places = world.places.values().filter(|p| on_map(p.area));
                assert!(places.into_iter().all(|p| ids.contains_key(&format!("place-{}", p.id.0))));
            }
        }
    }
}

#[test]
fn a_route_shows_its_way_and_its_goal() {
    let engine = engine();
    let journey = engine.journey("Точка-А", "Коридор", Method::Shortest).unwrap();
    let leg = &journey.legs[0];
    let points = leg.route.as_ref().unwrap().points.clone();
    let end = *points.last().unwrap();
    let legs = vec![(1, points)];
    let drawing = Drawing { legs, has_goal: true, ..Drawing::default() };
    let svg = engine.draw(leg.map, &drawing).unwrap();
    check_texts("route", &svg);
    check_legend("route", &svg);
    let of = |class: &str| svg.matches(&format!("class=\"{class}\"")).count();
    assert!(of("goal") >= 2 && of("route") >= 2 && of("start") == 1, "goal, arrows and start");
    // Where the way does not end on the sheet there is no goal.
    let legs = vec![(1, vec![end, Point::new(end.x + 50.0, end.y)])];
    let cut_off = engine.draw(leg.map, &Drawing { legs, ..Drawing::default() }).unwrap();
    assert!(!cut_off.contains("class=\"goal\""));
}

/// Movable is what has the trait, not what is likely to be moved.
#[test]
fn only_what_has_the_trait_is_drawn_as_movable() {
    let engine = engine();
    let world = engine.world().unwrap();
    let (map, _) = engine.sheet_named(None).unwrap();
    let svg = engine.draw(map, &Drawing::default()).unwrap();
    for thing in world.replicas.values() {
        let id = format!("id=\"thing-{}\"", thing.id.0);
        let tag = svg.split('<').find(|tag| tag.contains(&id)).expect(&thing.name);
        let class = attribute(tag, "class").unwrap();
        let has = |class_of: &str| class.split(' ').any(|c| c == class_of);
        assert!(!has("movable") || world.has_trait(thing.id, "movable"), "{}", thing.name);
        assert!(!has("portable") || world.has_trait(thing.id, "portable"), "{}", thing.name);
    }
}

#[test]
fn a_view_tells_from_where_it_is_seen() {
    let engine = engine();
    let (map, _) = engine.sheet_named(None).unwrap();
    let pose = State::parse_pose("370,140,120").unwrap();
    let lens = Lens { pose, height: 120.0, field: 90.0, range: 1200.0 };
    for (language, words) in [
        (Language::Russian, ["Комната-В", "(370; 140)", "120°", "90°"]),
        (Language::English, ["Room V", "(370, 140)", "120°", "90°"]),
    ] {
        let svg = engine.draw_view(map, lens, language).unwrap();
        let texts = written(&svg);
        let is_caption = |w: &&Written| words.iter().all(|word| w.text.contains(word));
        assert!(texts.iter().any(|w| is_caption(&w)), "{texts:?}");
        check_texts("view", &svg);
    }
}

#[test]
fn every_object_is_lettered_where_it_can_be_read() {
    let engine = engine();
    let world = engine.world().unwrap();
    for object in world.objects.values() {
        let svg = engine.draw_object(&object.name, Language::Russian).unwrap();
        keep(&object.key, &svg);
        let letters: BTreeSet<String> = written(&svg)
            .iter()
            .flat_map(|w| w.text.split(", ").map(str::to_owned).collect::<Vec<_>>())
            .collect();
        for item in &object.items {
            assert!(letters.contains(&item.id), "{}: no letter {}", object.name, item.id);
        }
    }
}

/// Road graphs of maps, of which doors face each other, stand close together here and far apart there.
#[test]
fn road_graphs_can_be_read() {
    let mut worlds = worlds();
    for file in ["cases/corridor_mine.json", "osmag/SIST_1.osm", "rmf/clinic.building.yaml"] {
        let is_new = worlds.iter().all(|(name, _)| name != file);
        if let Some(path) = shared(file).filter(|_| is_new) {
            let found = read(&path, &Options::default()).expect("a map");
            worlds.push((file.to_owned(), found.world));
        }
    }
    let mut count = 0;
    for (name, world) in worlds {
        for &map in world.maps.keys() {
            let Ok(system) = CorridorSystem::from_map(
                &world,
                &Openings::of(&world, STEP_REACH),
                map,
                &Shape::default(),
            ) else {
                continue;
            };
            for variant in [Variant::Single, Variant::Double] {
                let Ok(figure) = figure(&system, variant, &[]) else { continue };
                count += 1;
                let vertex = |v: orthoframe_corridor::FigureVertex| CorridorVertex {
                    at: v.at,
                    mark: if v.is_junction {
                        CorridorMark::Junction
                    } else {
                        CorridorMark::Entrance
                    },
                    label: v.label,
                    name: v.name,
                    name_towards: v.name_towards,
                };
                let arc = |a: orthoframe_corridor::FigureArc| CorridorArc {
                    from: a.from,
                    to: a.to,
                    label: a.label,
                    on_way: a.on_way,
                    faint: a.is_u_turn,
                };
                let signs = [
                    (CorridorSign::Entrance, "вход"),
                    (CorridorSign::Junction, "соединение"),
                    (CorridorSign::Arc, "дуга"),
                    (CorridorSign::Way, "путь"),
                    (CorridorSign::UTurn, "разворот"),
                ];
                let named: BTreeSet<String> = figure
                    .vertices
                    .iter()
                    .map(|v| v.name.clone())
                    .filter(|n| !n.is_empty())
                    .collect();
                let drawing = CorridorDrawing {
                    title: name.clone(),
                    vertices: figure.vertices.into_iter().map(vertex).collect(),
                    arcs: figure.arcs.into_iter().map(arc).collect(),
                    codes: (1..20).map(|n| (n.to_string(), format!("код {n}"))).collect(),
                    signs: signs.map(|(sign, word)| (sign, word.to_owned())).into(),
                    notes: vec!["Поезжайте прямо.".to_owned()],
                };
                let svg = corridor_svg(&drawing);
                let name = format!("{name}, {map:?}, {variant:?}");
                check_texts(&name, &svg);
                check_legend(&name, &svg);
                assert_eq!(svg, corridor_svg(&drawing), "{name}");
                let shown: BTreeSet<String> = written(&svg).into_iter().map(|w| w.text).collect();
                assert!(named.is_subset(&shown), "{name}: every room is named");
                let codes: BTreeSet<&String> =
                    drawing.arcs.iter().map(|a| &a.label).filter(|l| !l.is_empty()).collect();
                for code in codes {
                    assert!(shown.contains(&format!("код {code}")), "{name}: {code} is told");
                }
            }
        }
    }
    assert!(count > 1, "{count}");
}

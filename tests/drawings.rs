//! Drawings of the rb2 flat: everything named is there and legible, pictures have letters, the same input gives the
//! same bytes.

use orthoframe::Engine;
use orthoframe::engine::{Drawing, Lens, parse_pose};
use orthoframe::exchange::{Options, read};
use orthoframe::map::{Format, World};
use orthoframe::units::{Language, Source};

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
        pose: parse_pose(pose).unwrap(),
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
        let png = orthoframe::draw::png(svg, Some(400)).expect("a good drawing");
        assert!(png.starts_with(b"\x89PNG"));
        png
    };
    let engine = engine();
    let svg = engine.draw_object("Стеллаж-1", Language::Russian).unwrap();
    // Without the texts the picture is another one.
    let bare: String =
        svg.split("<text ").map(|part| part.split_once("</text>").map_or(part, |p| p.1)).collect();
    assert_ne!(picture(&svg), picture(&bare));
    assert!(orthoframe::draw::png("not a drawing", None).is_err());
    assert!(orthoframe::draw::png(&svg, Some(u32::MAX)).is_err());
}

/// Where much stands close together, what bears no name bears a number, told below the plan; no letters are too small.
#[test]
fn what_has_no_place_for_its_name_is_told_by_a_number() {
    let path = std::path::Path::new("../shared/data/virtualhome/TestScene2_graph.json");
    if !path.exists() {
        return;
    }
    let imported = read(path, &Options::default()).unwrap();
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

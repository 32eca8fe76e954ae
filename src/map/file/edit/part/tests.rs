//! The part against the whole: generated edits of every sort.

use std::fmt::Write as _;

use super::super::{EditReading, NextIds, Work};
use super::*;
use crate::dice::dice;
use crate::units::Source;
use crate::{Format, NameIndex};

/// A step of some sort, sound or not.
fn step(world: &World, throw: &mut impl FnMut(usize) -> usize) -> String {
    let names: Vec<&str> = world.names().map(|(_, name)| name).collect();
    let things: Vec<&str> = world.replicas.values().map(|r| r.name.as_str()).collect();
    let areas: Vec<&str> = world.areas.values().map(|a| a.key.as_str()).collect();
    let objects: Vec<&str> = world.objects.values().map(|o| o.key.as_str()).collect();
    let doors: Vec<&str> = world.doors.values().map(|d| d.name.as_str()).collect();
    let pick =
        |throw: &mut dyn FnMut(usize) -> usize, all: &[&str]| all[throw(all.len())].to_owned();
    let any = throw(8) == 0;
    let thing = pick(throw, if any { &names } else { &things });
    let (x, y) = (throw(500) as i64 - 60, throw(500) as i64 - 60);
    match throw(12) {
        0 => format!("move = \"{thing}\"\nby = [{}, {}]\n", x % 20, y % 20),
        1 => format!("move = \"{thing}\"\nto = [{x}, {y}]\ncarry = true\n"),
        2 => {
            let area = pick(throw, &areas);
            format!("move = \"{thing}\"\nto = [{x}, {y}]\narea = \"{area}\"\n")
        }
        3 => format!("turn = \"{thing}\"\nby = {x}\n"),
        4 => format!("remove = \"{thing}\"\n"),
        5 => {
            let to = [pick(throw, &names), format!("Вещь-{}", throw(9))][throw(2)].clone();
            format!("rename = \"{thing}\"\nto = \"{to}\"\n")
        }
        6 => format!("rename = \"{thing}\"\nen = \"Thing {}\"\n", throw(9)),
        7 => format!("set = \"{thing}\"\nproperty = \"ЦВЕТ\"\nvalue = \"Красный\"\n"),
        8 => format!("unset = \"{thing}\"\nproperty = \"ЦВЕТ\"\n"),
        9 => format!("set = \"{thing}\"\nmove_prob = {}\n", throw(140)),
        10 => {
            let (door, is) = (pick(throw, &doors), ["open", "closed", "ajar"][throw(3)]);
            let on = [String::new(), format!("on = \"{thing}\"\n")][throw(2)].clone();
            format!("state = \"{door}\"\nis = \"{is}\"\n{on}")
        }
        _ => {
            let (object, area) = (pick(throw, &objects), pick(throw, &areas));
            let name = [thing, format!("Вещь-{}", throw(9))][throw(2)].clone();
            let place = format!("object = \"{object}\"\narea = \"{area}\"\nat = [{x}, {y}]\n");
            format!("place = \"{name}\"\n{place}")
        }
    }
}

/// A step of some sort that changes the building, or a section of what is new; sound or not.
fn rebuild(world: &World, throw: &mut impl FnMut(usize) -> usize) -> String {
    macro_rules! any {
        ($records:ident, $field:ident) => {{
            let all: Vec<&str> = world.$records.values().map(|r| r.$field.as_str()).collect();
            if all.is_empty() { "нет" } else { all[throw(all.len())] }.to_owned()
        }};
    }
    let names: Vec<&str> = world.names().map(|(_, name)| name).collect();
    let name = names[throw(names.len())].to_owned();
    let (area, other) = (any!(areas, name), any!(areas, key));
    let (door, object, part) = (any!(doors, key), any!(objects, key), any!(orthoframes, key));
    let (thing, place, map) = (any!(replicas, name), any!(places, name), any!(maps, key));
    let (x, y, n) = (throw(500) as i64 - 60, throw(500) as i64 - 60, throw(90));
    let any = [&area, &door, &object, &part, &thing, &place, &map, &name][throw(8)].clone();
    let side = ["A", "B", "C", "D"][throw(4)];
    match throw(24) {
        0 => format!("[[edit]]\nrename = \"{any}\"\nto = \"Имя {n}\"\n"),
        1 => format!("[[edit]]\nrename = \"{any}\"\nen = \"Name {n}\"\nkind = \"area\"\n"),
        2 | 3 => format!("[[edit]]\nremove = \"{any}\"\n"),
        4 => format!("[[edit]]\nremove = \"{area}\"\nkind = \"area\"\n"),
        5 => format!("[[edit]]\nremove = \"{object}\"\nkind = \"object\"\n"),
        6 => format!("[[edit]]\nremove = \"{door}\"\nkind = \"door\"\n"),
        7 => format!(
            "[[edit]]\npoint = \"Место {n}\"\narea = \"{area}\"\nat = [{x}, {y}]\nserves = \"{thing}\"\n"
        ),
        8 => format!("[[edit]]\nmove = \"{place}\"\nby = [3, -3]\n"),
        9 => format!("[[edit]]\nbind = \"{door}\"\nto = \"{area}\"\nside = \"{side}\"\n"),
        10 => format!("[[edit]]\nunbind = \"{door}\"\n"),
        11 => format!("[[edit]]\nunbind = \"{door}\"\nfrom = \"{area}\"\n"),
        12 => format!(
            "[[edit]]\nitem = \"Z{n}\"\nof = \"{object}\"\northoframe = \"{part}\"\nat = [{n}, 0]\n"
        ),
        13 => {
            format!("[[edit]]\nlink = \"{area}.{side}\"\nto = \"{other}.{side}\"\nrel = [0, 0]\n")
        }
        14 => {
            let links = world.maps.values().flat_map(|map| &map.links);
            let ends: Vec<[String; 2]> = links
                .map(|l| {
                    let [a, b] = [&world.areas[&l.area], &world.areas[&l.to_area]];
                    let end = |area: &Area, side: &crate::SideRef| match &area.items[..] {
                        [_] => format!("{}.{}", area.name, side.side),
                        _ => format!("{}.{}.{}", area.name, side.item, side.side),
                    };
                    [end(a, &l.side), end(b, &l.to_side)]
                })
                .collect();
            if ends.is_empty() {
                return String::new();
            }
            let [from, to] = &ends[throw(ends.len())];
            format!("[[edit]]\nunlink = \"{to}\"\nto = \"{from}\"\n")
        }
        15 => format!("[[edit]]\nstand = \"{area}\"\nmap = \"{map}\"\nat = [{x}, {y}]\n"),
        16 => format!("[[edit]]\ninclude = \"{map}\"\nat = [{x}, {y}]\n"),
        17 => {
            format!("[[edit]]\nlift = \"Лифт {}\"\nstops = [\"{area}\", \"{other}\"]\n", n % 3)
        }
        18 => format!(
            "[[edit]]\nzone = \"Зона {}\"\nkind = \"closed\"\nrooms = [\"{area}\"]\n",
            n % 9
        ),
        19 => format!("[[edit]]\nset = \"{any}\"\nproperty = \"ЦВЕТ\"\nvalue = \"{name}\"\n"),
        20 => format!(
            "[[edit]]\nset = \"{part}\"\nside = \"{side}\"\nproperty = \"ЦВЕТ\"\nvalue = \"Синий\"\n"
        ),
        21 => format!(
            "[orthoframe.o{n}]\nrect = [{}, 20]\nheight = 9\n[object.k{n}]\nname = \"Вид {n}\"\nitems = [{{ id = \"A\", orthoframe = \"o{n}\" }}]\n[door.d{n}]\nname = \"Дверь {n}\"\nkind = \"passage\"\nwidth = 80\nheight = 200\n",
            x.abs() + 1
        ),
        22 => format!(
            "[area.a{n}]\nname = \"Зал {n}\"\nitems = [{{ id = \"A\", orthoframe = \"{part}\" }}]\nreplicas = [{{ name = \"Вещь {n}\", object = \"{object}\", at = [{x}, {y}] }}]\n[[edit]]\nstand = \"a{n}\"\nmap = \"{map}\"\nat = [{}, {y}]\n",
            x + 9000
        ),
        _ => format!(
            "[[type.object]]\nname = \"Тип {n}\"\n[object.t{n}]\ntype = \"Тип {n}\"\nitems = [{{ id = \"A\", orthoframe = \"{part}\" }}]\n"
        ),
    }
}

/// A step that changes walls, or where rooms stand, or that tells of a place in the frame of the Map; sound or not.
fn rewall(world: &World, throw: &mut impl FnMut(usize) -> usize) -> String {
    let areas: Vec<&Area> = world.areas.values().collect();
    let area = areas[throw(areas.len())];
    let (name, item) = (&area.name, &area.items[throw(area.items.len())]);
    let base = &world.orthoframe_of(item).base;
    let side = &base[throw(base.len())];
    let (x, y, n) = (throw(900) as i64 - 60, throw(900) as i64 - 60, throw(90));
    match throw(9) {
        0..=4 => {
            let long = side.length().get() as usize;
            let (from, to) = (throw(long / 3 + 1), long / 2 + throw(long / 2 + 2));
            let door = [String::new(), "permeability = \"conditional\"\n".to_owned()];
            let (item, side, door) = (&item.id, &side.id, &door[throw(2)]);
            format!(
                "[[edit]]\ncut = \"{name}\"\nside = \"{item}.{side}\"\nfrom = {from}\nto = {to}\n{door}"
            )
        }
        5 => {
            let inner = |p: crate::units::Point| item.frame.apply(p);
            let shifted = |(k, v): (usize, &BaseVector)| {
                let (p, by) = (inner(v.start), if k == n % base.len() { 3.0 } else { 0.0 });
                format!("[{}, {}]", p.x + by, p.y)
            };
            let points: Vec<String> = base.iter().enumerate().map(shifted).collect();
            let (points, item) = (points.join(", "), &item.id);
            format!("[[edit]]\nshape = \"{name}\"\nitem = \"{item}\"\npoints = [{points}]\n")
        }
        6 => format!("[[edit]]\nstand = \"{name}\"\nat = [{x}, {y}]\nrelink = true\n"),
        7 => {
            let object = world.objects.values().nth(n % world.objects.len()).expect("some");
            let object = &object.key;
            format!(
                "[[edit]]\nplace = \"Вещь {n}\"\nobject = \"{object}\"\narea = \"{name}\"\npose = [{x}, {y}]\n"
            )
        }
        _ => format!(
            "[[edit]]\npoint = \"Место {n}\"\narea = \"{name}\"\npose = [{x}, {y}]\nheading = 90\n"
        ),
    }
}

/// Worked into the part of which it speaks, an edit comes to the same map and the same faults, at the same places, as
/// worked into the whole.
#[test]
fn a_part_comes_to_what_the_whole_comes_to() {
    let steps = |world: &World, throw: &mut dyn FnMut(usize) -> usize| {
        let mut text = String::new();
        for _ in 0..=throw(3) {
            let _ = write!(text, "[[edit]]\n{}", step(world, &mut |n| throw(n)));
        }
        text
    };
    let buildings = |world: &World, throw: &mut dyn FnMut(usize) -> usize| {
        let mut all: Vec<String> =
            (0..=throw(2)).map(|_| rebuild(world, &mut |n| throw(n))).collect();
        // A section cannot stand twice.
        all.dedup_by_key(|text| text.split('\n').next().unwrap_or_default().to_owned());
        all.concat()
    };
    let walls = |world: &World, throw: &mut dyn FnMut(usize) -> usize| {
        (0..1 + throw(2)).map(|_| rewall(world, &mut |n| throw(n))).collect()
    };
    for (seed, map) in ["rb2", "lab", "two-storeys"].into_iter().enumerate() {
        compare(map, seed as u64 + 300, 120, walls);
        compare(map, seed as u64 + 3, 150, steps);
        compare(map, seed as u64 + 30, 120, buildings);
    }
}

/// A text of edits of a world.
type Texts = fn(&World, &mut dyn FnMut(usize) -> usize) -> String;

fn compare(map: &str, seed: u64, turns: usize, texts: Texts) {
    let mut throw = dice(seed);
    let path = format!("../../maps/{map}.toml");
    let first = World::load(&path).expect("a map of the project");
    let mut world = first.clone();
    let (mut parts, mut sound, mut faulty) = (0, 0, 0);
    for turn in 0..turns {
        let text = texts(&world, &mut throw);
        let source = Source::new("edit.toml", text.clone());
        let Ok(edits) = super::super::node::parse(&text, Format::Toml) else { continue };
        let (exact, ids) = (NameIndex::of(&world), NextIds::after(&world));
        let naming = Naming { exact: &exact, in_other_words: &|_| Vec::new() };
        let (world_now, judge) = (&world, &|_: &World| Vec::new());
        let (source, edits, ids) = (&source, &edits, &ids);
        let work = Work { world: world_now, source, edits, ids, naming, judge };
        let whole = work.on(None).expect("the whole is gone through");
        let part = part_of(&world, edits, &naming).and_then(|part| work.on(Some(&part)));
        if let Some(part) = part {
            parts += 1;
            let told = |reading: &EditReading| -> Vec<String> {
                let faults = reading.faults.faults.iter();
                faults.map(|f| format!("{f} {:?}", f.spans)).collect()
            };
            assert_eq!(told(&part), told(&whole), "{map}, {turn}: {text}");
            assert_eq!(part.world, whole.world, "{map}, {turn}: {text}");
            assert_eq!(part.carriers, whole.carriers, "{map}, {turn}: {text}");
            (sound, faulty) = match part.world {
                Some(_) => (sound + 1, faulty),
                None => (sound, faulty + 1),
            };
        } else if whole.faults.faults.is_empty() {
            panic!("{map}, {turn}: it goes into the whole alone: {text}");
        }
        if let Some(edited) = whole.world.filter(|w| w.replicas.len() > 4) {
            world = edited;
        }
        // Some turns leave little to be edited.
        if turn % 40 == 39 {
            world = first.clone();
        }
    }
    assert!(parts > 50 && sound > 15 && faulty > 10, "{map}: {parts} {sound} {faulty}");
}

//! Generated edits of every sort, sound or not.

use std::fmt::Write as _;

use orthoframe_map::schema::{OrthoframeFile, SideTraitsFile, Table};
use orthoframe_map::{
    Area, BaseVector, Edit, EditReading, Edits, Fault, Format, NameIndex, Naming, NewRecord,
    NextIds, World, edit,
};
use orthoframe_units::Source;

use crate::dice::dice;

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
                    let end = |area: &Area, side: &orthoframe_map::SideRef| match &area.items[..] {
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
            let inner = |p: orthoframe_units::Point| item.frame.apply(p);
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

/// A step about a zone, a lift, a Map, the robot or a new record that others speak of; sound or not.
fn relay(world: &World, throw: &mut impl FnMut(usize) -> usize) -> String {
    let areas: Vec<&Area> = world.areas.values().collect();
    let (area, other) = (&areas[throw(areas.len())].name, &areas[throw(areas.len())].key);
    let objects: Vec<&str> = world.objects.values().map(|o| o.key.as_str()).collect();
    let object = objects[throw(objects.len())];
    let doors: Vec<&str> = world.doors.values().map(|o| o.key.as_str()).collect();
    let door = doors[throw(doors.len())];
    let zones: Vec<&str> = world.zones.values().map(|z| z.name.as_str()).collect();
    let n = throw(6);
    let zone = match zones.len() {
        0 => format!("Зона {n}"),
        many => [zones[throw(many)].to_owned(), format!("Зона {n}")][throw(2)].clone(),
    };
    let (x, y) = (throw(400) as i64, throw(400) as i64);
    let square = format!("[[{x}, {y}], [{}, {y}], [{}, {}]]", x + 50, x + 50, y + 50);
    let kind = ["closed", "keep-out", "slow", "one-way"][throw(4)];
    let number = ["", "", "speed = 20\n", "heading = 90\n"][throw(4)];
    match throw(16) {
        0 => format!("[[edit]]\nzone = \"{zone}\"\nkind = \"{kind}\"\n{number}points = {square}\n"),
        1 => format!(
            "[[edit]]\nzone = \"{zone}\"\nkind = \"{kind}\"\n{number}rooms = [\"{area}\", \"{other}\"]\n"
        ),
        2 => format!(
            "[[edit]]\nzone = \"{zone}\"\n{number}reason = \"так {n}\"\nuntil = \"2026-11-2{n}T18:00Z\"\n"
        ),
        3 => {
            format!("[[edit]]\nzone = \"{zone}\"\npoints = {square}\nreason = \"\"\nfrom = \"\"\n")
        }
        4 => format!("[[edit]]\nmove = \"{zone}\"\nby = [{n}, -2]\n"),
        5 => format!("[[edit]]\nrename = \"{zone}\"\nto = \"Зона {}\"\n", throw(6)),
        6 => format!("[[edit]]\nremove = \"{zone}\"\n"),
        7 => format!("[[edit]]\nremove = \"{area}\"\n"),
        8 => format!("[[edit]]\nlift = \"Лифт {n}\"\nstops = [\"{area}\", \"{other}\"]\n"),
        9 => format!("[robot]\nradius = {}\nheight = {}\nspeed = {n}\n", 10 + n, 100 + n),
        10 => format!(
            "[robot]\nstart = \"Место {n}\"\n[[edit]]\npoint = \"Место {n}\"\narea = \"{area}\"\nat = [{x}, {y}]\nheading = {x}\n"
        ),
        11 => format!(
            "[[edit]]\nplace = \"Шкаф {n}\"\nobject = \"{object}\"\narea = \"{area}\"\nat = [{x}, {y}, {n}]\ndoors = {{ {door} = {{ state = \"closed\" }} }}\nproperties = {{ ЦВЕТ = \"Белый\" }}\nmove_prob = {}\n",
            n * 22
        ),
        12 => format!(
            "[[edit]]\nrename = \"{area}\"\nto = \"Зал {n}\"\nforms = {{ gen = \"Зала {n}\" }}\n"
        ),
        13 => format!("[zone.z{n}]\nkind = \"closed\"\nrooms = [\"{other}\"]\n"),
        14 => format!("[[edit]]\nremove = \"{door}\"\nkind = \"door\"\n"),
        _ => format!("[[edit]]\nstand = \"{area}\"\nat = [{x}, {y}]\nbase = {}\n", throw(2) == 0),
    }
}

/// An edit is the same as a value and as a text, and makes a map that a map file can say; what is done in one list is what is
/// done one after another.
#[test]
fn an_edit_comes_to_the_same_however_it_is_told() {
    let steps = |world: &World, throw: &mut dyn FnMut(usize) -> usize| {
        let mut text = String::new();
        for _ in 0..=throw(3) {
            let _ = write!(text, "[[edit]]\n{}", step(world, &mut |n| throw(n)));
        }
        text
    };
    let buildings = |world: &World, throw: &mut dyn FnMut(usize) -> usize| {
        apart((0..=throw(2)).map(|_| rebuild(world, &mut |n| throw(n))).collect())
    };
    let zones = |world: &World, throw: &mut dyn FnMut(usize) -> usize| {
        apart((0..=throw(2)).map(|_| relay(world, &mut |n| throw(n))).collect())
    };
    let walls = |world: &World, throw: &mut dyn FnMut(usize) -> usize| {
        (0..1 + throw(2)).map(|_| rewall(world, &mut |n| throw(n))).collect()
    };
    for (seed, map) in ["rb2", "lab", "two-storeys"].into_iter().enumerate() {
        tell(map, seed as u64 + 3000, 200, zones);
        tell(map, seed as u64 + 300, 120, walls);
        tell(map, seed as u64 + 3, 150, steps);
        tell(map, seed as u64 + 30, 120, buildings);
    }
}

/// A section cannot stand twice.
fn apart(mut all: Vec<String>) -> String {
    all.dedup_by_key(|text| text.split('\n').next().unwrap_or_default().to_owned());
    all.concat()
}

/// A text of edits of a world.
type Texts = fn(&World, &mut dyn FnMut(usize) -> usize) -> String;

fn done(world: &World, edits: &Edits) -> EditReading {
    let naming = Naming { exact: &NameIndex::of(world), in_other_words: &|_| Vec::new() };
    edit(world, edits, &NextIds::after(world), naming)
}

fn tell(map: &str, seed: u64, turns: usize, texts: Texts) {
    let mut throw = dice(seed);
    let path = format!("../../maps/{map}.toml");
    let first = World::load(&path).expect("a map of the project");
    let mut world = first.clone();
    let (mut sound, mut faulty) = (0, 0);
    for turn in 0..turns {
        let text = texts(&world, &mut throw);
        let edits = Edits::read(&Source::new("edit.toml", text.clone()), Format::Toml);
        let whole = done(&world, &edits);
        if edits.is_whole() {
            let values: Vec<Edit> = edits.values().cloned().collect();
            let as_values = done(&world, &values.clone().into());
            let told = |reading: &EditReading| {
                let mut all: Vec<String> =
                    reading.faults.faults.iter().map(ToString::to_string).collect();
                all.sort();
                all
            };
            assert_eq!(told(&as_values), told(&whole), "{map}, {turn}: {text}");
            assert_eq!(as_values.world, whole.world, "{map}, {turn}: {text}");
            assert_eq!(as_values.carriers, whole.carriers, "{map}, {turn}: {text}");
            let one_by_one = values.iter().try_fold(world.clone(), |world, value| {
                done(&world, &vec![value.clone()].into()).world
            });
            let gives_ids_again = text.contains("remove");
            if let (Some(one_by_one), Some(whole), false) =
                (one_by_one, &whole.world, gives_ids_again)
            {
                assert_eq!(one_by_one, *whole, "{map}, {turn}: {text}");
            }
        }
        let Some(edited) = whole.world else {
            assert!(whole.faults.has_errors(), "{map}, {turn}: {text}");
            faulty += 1;
            continue;
        };
        sound += 1;
        let again = World::parse(&Source::new("map.toml", edited.to_toml()), Format::Toml);
        assert_eq!(again.as_ref().ok(), Some(&edited), "{map}, {turn}: {text}");
        // Some turns leave little to be edited.
        world = if turn % 40 == 39 || edited.replicas.len() < 5 { first.clone() } else { edited };
    }
    assert!(sound > 15 && faulty > 10, "{map}: {sound} {faulty}");
}

/// Of several steps none is lost without a word: what one makes of a thing that it leaves in pieces is told at the step.
#[test]
fn what_a_step_leaves_in_pieces_is_told_in_a_list_of_many() {
    let world = World::load("../../maps/rb2.toml").expect("a map of the project");
    let told = |text: &str| {
        let reading = done(&world, &Edits::read(&Source::new("edit.toml", text), Format::Toml));
        assert!(reading.world.is_none(), "{text}");
        let one = |f: &Fault| format!("{:?} {f}", reading.faults.position(f).expect("a place"));
        reading.faults.faults.iter().map(one).collect::<Vec<_>>()
    };
    let unread = "[door.d]\nwidth = 80\nheight = 200\n[[edit]]\nbind = \"d\"\nto = \"room-v\"\nside = \"A\"\n";
    assert_eq!(told(unread), ["(1, 7) не хватает поля «kind»"]);
    let side = ("A".to_owned(), SideTraitsFile::default());
    let twice = OrthoframeFile { side: Table(vec![side.clone(), side]), ..Default::default() };
    let twice = Edit::New(Box::new(NewRecord::Orthoframe("slab".to_owned(), twice)));
    assert!(done(&world, &vec![twice].into()).faults.has_errors(), "a key that is there twice");
    let start = world.places.values().find(|p| Some(p.id) == world.robot.start).expect("it starts");
    let room = &world.areas[&start.area].name;
    let gone = format!("[robot]\nspeed = 20\n[[edit]]\nremove = \"{room}\"\n");
    assert!(told(&gone).iter().any(|f| f.contains(&start.name)), "{gone}");
    let zones = "[zone.z]\nkind = \"closed\"\nrooms = [\"corridor\"]\n[[edit]]\nzone = \"z\"\nkind = \"slow\"\n";
    assert_eq!(told(zones), ["(1, 7) не хватает поля «speed»"]);
}

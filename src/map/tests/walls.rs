//! Walls cut, and corners put elsewhere, on maps of ours and on made ones.

use orthoframe_map::{Edits, Format, NameIndex, Naming, NextIds, Permeability, World, edit};
use orthoframe_units::{AreaId, Point, Source};

fn rb2() -> World {
    World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/rb2.toml"))
        .expect("the map is sound")
}

fn edited(world: &World, text: &str) -> Result<World, String> {
    let source = Source::new("edits.toml", text);
    let naming = Naming { exact: &NameIndex::of(world), in_other_words: &|_| Vec::new() };
    let done = edit(world, &Edits::read(&source, Format::Toml), &NextIds::after(world), naming);
    let faults = || done.faults.faults.iter().map(|f| f.error.to_string()).collect::<Vec<_>>();
    done.world.ok_or_else(|| faults().join("; "))
}

fn size(world: &World, area: AreaId) -> f64 {
    let doubled = |corners: &Vec<Point>| {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>()
    };
    world.area_polygons(area).iter().map(doubled).sum::<f64>() / 2.0
}

#[test]
fn a_stretch_cut_out_of_any_wall_changes_no_room_and_no_door() {
    let world = rb2();
    let mut cuts = 0;
    for area in world.areas.values() {
        for item in &area.items {
            for side in &world.orthoframe_of(item).base {
                let length = side.length().get();
                let has_door = area.doors.iter().any(|m| m.item == item.id && m.side == side.id);
                if has_door || length < 10.0 {
                    continue;
                }
                for (from, to, more) in [(0.0, length, 0), (0.0, 5.0, 1), (2.0, 6.0, 2)] {
                    let text = format!(
                        "[[edit]]\ncut = {:?}\nside = \"{}.{}\"\nfrom = {from}\nto = {to}\nas = \"neu\"\n",
                        area.name, item.id, side.id
                    );
                    let cut = edited(&world, &text).unwrap_or_else(|why| panic!("{text}: {why}"));
                    let base = cut.areas[&area.id].item(&item.id).map(|i| cut.orthoframe_of(i));
                    let base = base.expect("the item stays");
                    assert_eq!(base.base.len(), world.orthoframe_of(item).base.len() + more);
                    let (_, new) = base.side("neu").expect("it was cut");
                    assert!((new.length().get() - (to - from)).abs() < 1e-6, "{text}");
                    for other in world.areas.keys() {
                        let (was, is) = (size(&world, *other), size(&cut, *other));
                        assert!((was - is).abs() < 1e-3, "{text}: {was} {is}");
                    }
                    for door in world.doors.keys() {
                        for room in world.door_areas(*door) {
                            assert_eq!(world.threshold(room, *door), cut.threshold(room, *door));
                        }
                    }
                    cuts += 1;
                }
            }
        }
    }
    assert!(cuts > 20, "{cuts}");
}

#[test]
fn a_stretch_beyond_the_wall_and_a_side_that_is_none_are_refused_at_their_place() {
    let world = rb2();
    let room = world.areas.values().next().expect("there is one");
    let side = &world.orthoframe_of(&room.items[0]).base[0];
    let text = |side: &str, from: f64, to: f64| {
        let (name, item) = (&room.name, &room.items[0].id);
        format!("[[edit]]\ncut = {name:?}\nside = \"{item}.{side}\"\nfrom = {from}\nto = {to}\n")
    };
    let length = side.length().get();
    for (side, from, to) in [
        (side.id.as_str(), 10.0, length + 5.0),
        (side.id.as_str(), -9.0, 20.0),
        (side.id.as_str(), 20.0, 20.0),
        ("nichts", 0.0, 20.0),
    ] {
        assert!(edited(&world, &text(side, from, to)).is_err(), "{side} {from} {to}");
    }
}

#[test]
fn a_room_takes_the_corners_that_it_is_given_and_leaves_those_of_others() {
    let old = rb2();
    let neighbour = old.areas.values().next().expect("there is one");
    let item = &neighbour.items[0];
    let walls = old.orthoframe_of(item).base.iter();
    let wall = walls.clone().find(|v| v.permeability == Permeability::Impermeable);
    let wall = format!("{}.{}.{}", neighbour.name, item.id, wall.expect("there is a wall").id);
    let tied = |key: &str, y: u32| {
        let stands = format!("[[edit]]\nstand = {key:?}\nat = [5000, {y}]\n");
        format!("{stands}[[edit]]\nlink = \"{key}.A.A\"\nto = {wall:?}\n{stands}relink = true\n")
    };
    let text = format!(
        r#"
        [orthoframe.square]
        height = 270
        rect = [400, 300]
        [area.one]
        name = "Раз"
        items = [{{ id = "A", orthoframe = "square", angle = 90, at = [300, 0] }}]
        [area.two]
        name = "Два"
        items = [{{ id = "A", orthoframe = "square" }}]
        {}{}"#,
        tied("one", 5000),
        tied("two", 7000)
    );
    let world = edited(&old, &text).expect("two rooms of one shape");
    let room = |world: &World, name: &str| {
        let area = world.areas.values().find(|area| area.name == name).expect("it is there");
        world.area_polygons(area.id).remove(0)
    };
    let shape = "[[edit]]\nshape = \"Раз\"\npoints = [[300, 0], [300, 400], [0, 450], [0, 0]]\n";
    let shaped = edited(&world, shape).expect("four corners");
    let corners: Vec<[f64; 2]> = room(&shaped, "Раз").iter().map(|p| [p.x, p.y]).collect();
    for (is, wanted) in corners.iter().zip([[300.0, 0.0], [300.0, 400.0], [0.0, 450.0], [0.0, 0.0]])
    {
        assert!((is[0] - wanted[0]).hypot(is[1] - wanted[1]) < 1e-6, "{corners:?}");
    }
    assert_eq!(room(&shaped, "Два"), room(&world, "Два"));
    let fewer = "[[edit]]\nshape = \"Раз\"\npoints = [[300, 0], [300, 400], [0, 0]]\n";
    assert!(edited(&world, fewer).is_err());
}

/// Where all things, places and rooms but one are on their Maps.
fn standing(world: &World, but: AreaId) -> Vec<(String, [f64; 4])> {
    let placed = |area: AreaId| world.placement(area).expect("every room stands on a map").1;
    let things = world.replicas.values().map(|r| {
        let on = placed(r.area).compose(&r.frame);
        (r.name.clone(), [on.x.get(), on.y.get(), on.z.get(), on.angle.get()])
    });
    let places = world.places.values().map(|p| {
        let at = placed(p.area).apply(p.at);
        (p.name.clone(), [at.x, at.y, 0.0, 0.0])
    });
    let rooms = world.areas.values().filter(|area| area.id != but).flat_map(|area| {
        let corners = world.area_polygons(area.id).concat().into_iter();
        corners.map(|p| placed(area.id).apply(p)).map(|p| (area.name.clone(), [p.x, p.y, 0.0, 0.0]))
    });
    things.chain(places).chain(rooms).collect()
}

fn is_same(was: &[(String, [f64; 4])], is: &[(String, [f64; 4])]) -> bool {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6;
    was.len() == is.len()
        && was.iter().zip(is).all(|((a, p), (b, q))| a == b && p.iter().zip(q).all(near))
}

/// The corners of the parts of an Area as they stand in it, by the item's id.
fn corners(world: &World, area: AreaId) -> Vec<(String, Vec<Point>)> {
    let items = world.areas[&area].items.iter();
    let of = |item: &orthoframe_map::Item| {
        let corners = world.orthoframe_of(item).corners();
        (item.id.clone(), corners.map(|p| item.frame.apply(p)).collect())
    };
    items.map(of).collect()
}

/// Puts every corner of every room elsewhere, those at the origins among them; how many edits there were, and how many of
/// these of corners at the origin of their room.
fn put_elsewhere(world: &World, by: [f64; 2]) -> (usize, usize) {
    let (mut done, mut at_origin) = (0, 0);
    for area in world.areas.values() {
        let before = standing(world, area.id);
        for (item, was) in corners(world, area.id) {
            for moved in 0..was.len() {
                let mut wanted = was.clone();
                (wanted[moved].x, wanted[moved].y) =
                    (wanted[moved].x + by[0], wanted[moved].y + by[1]);
                let points: Vec<String> =
                    wanted.iter().map(|p| format!("[{}, {}]", p.x, p.y)).collect();
                let text = format!(
                    "[[edit]]\nshape = {:?}\nitem = {item:?}\npoints = [{}]\n",
                    area.name,
                    points.join(", ")
                );
                let after = match edited(world, &text) {
                    Ok(after) => after,
                    Err(why) => {
                        // A door that would not fit, a room that would lie over another: never the origin.
                        assert!(!why.contains("начале координат"), "{text}: {why}");
                        continue;
                    }
                };
                assert!(is_same(&before, &standing(&after, area.id)), "{text}");
                for (id, is) in corners(&after, area.id) {
                    let own = was_of(world, area.id, &id);
                    let wanted = if id == item { &wanted } else { &own };
                    assert!(
                        is.iter().zip(wanted).all(|(p, q)| (p - q).norm() < 1e-6),
                        "{text}: {is:?}"
                    );
                }
                // What is written reads back as the same map.
                let file = Source::new("map.toml", after.to_toml());
                let again = World::parse(&file, Format::Toml).expect("it is sound");
                assert!(is_same(&standing(&after, area.id), &standing(&again, area.id)));
                done += 1;
                at_origin += usize::from(was[moved].coords.norm() < 0.01);
            }
        }
    }
    (done, at_origin)
}

fn was_of(world: &World, area: AreaId, item: &str) -> Vec<Point> {
    let all = corners(world, area);
    all.into_iter().find(|(id, _)| id == item).expect("no item goes").1
}

#[test]
fn a_corner_at_the_origin_is_put_elsewhere_and_all_that_stands_there_stays() {
    let mut sums = (0, 0);
    for map in ["rb2", "lab", "two-storeys"] {
        let path = format!("{}/../../maps/{map}.toml", env!("CARGO_MANIFEST_DIR"));
        let world = World::load(path).expect("the map is sound");
        for by in [[0.0, 3.0], [4.0, 0.0], [-2.0, -2.0], [2.5, 1.5]] {
            let (done, at_origin) = put_elsewhere(&world, by);
            sums = (sums.0 + done, sums.1 + at_origin);
        }
    }
    assert!(sums.0 > 60 && sums.1 > 5, "{sums:?}");
}

/// A room whose base item stands turned, with another part linked to it, which gives the Map its coordinates too.
#[test]
fn a_room_of_two_parts_gives_up_the_origin_of_its_map() {
    let text = r#"
        format = 1
        [orthoframe.square]
        height = 270
        rect = [400, 300]
        [orthoframe.annex]
        height = 270
        rect = [200, 400]
        [object.box]
        name = "Ящик"
        items = [{ id = "A", orthoframe = "cube" }]
        [orthoframe.cube]
        height = 30
        rect = [30, 30]
        [area.one]
        name = "Раз"
        items = [
            { id = "A", orthoframe = "square", angle = 90, at = [300, 0] },
            { id = "B", orthoframe = "annex", at = [300, 0] },
        ]
        links = [{ from = "A.A", to = "B.D" }]
        replicas = [{ name = "Ящик-1", object = "box", at = [100, 100] }]
        places = [{ name = "Пост", at = [200, 200] }]
        [map.floor]
        name = "Этаж"
        items = [{ area = "one", angle = 90, at = [400, 0] }]
        [robot]
        start = "Пост"
    "#;
    let world = World::parse(&Source::new("map.toml", text), Format::Toml);
    let world = world.unwrap_or_else(|faults| panic!("{faults}"));
    for by in [[0.0, 30.0], [15.0, 0.0], [-20.0, -25.0]] {
        let (done, at_origin) = put_elsewhere(&world, by);
        assert!(done >= 4 && at_origin >= 1, "{by:?}: {done} {at_origin}");
    }
    let stands = "[[edit]]\nstand = \"Раз\"\nat = [340, 25]\nrelink = true\n";
    let moved = edited(&world, stands).expect("the map keeps its coordinates");
    assert_eq!(moved.maps.values().next().expect("there is one").frame, "floor");
    let told = "[[edit]]\nstand = \"Раз\"\nat = [340, 25]\n";
    assert!(edited(&world, told).is_err(), "a file says what it means");
}

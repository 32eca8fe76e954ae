//! What stands on, hangs over, lies under or in what.

use std::collections::BTreeSet;

use expect_test::expect;
use orthoframe_map::{Entity, World};
use orthoframe_semantics::{Profile, Relations, derive};

use super::{RULES, check, list, room};

type Pairs = BTreeSet<(String, String)>;

fn pairs(relations: &Relations, name: &str) -> Pairs {
    let tuples = relations.tuples(name).unwrap_or_else(|e| panic!("{e}"));
    tuples.into_iter().map(|t| (t[0].to_string(), t[1].to_string())).collect()
}

/// BORNE_BY and GOES_WITH against the obvious slow way: step by step up every stack.
pub(super) fn check_closures(world: &World, relations: &Relations) {
    let id = |name: &str| {
        let replica = |e| if let Entity::Replica(id) = e { Some(id) } else { None };
        world.find(name).into_iter().find_map(replica).expect("a thing of the world")
    };
    let is_portable = |name: &str| world.has_trait(id(name), "portable");
    let is_covering = |name: &str| {
        let thing = relations.measurements().of_thing(id(name)).expect("it is measured");
        let furnishes =
            ["support", "seat", "container"].iter().any(|t| world.has_trait(id(name), t));
        thing.top - thing.bottom <= 200 && !furnishes
    };
    let (holds, on_top) = (pairs(relations, "LIES_ON_OR_IN"), pairs(relations, "ON_TOP_OF"));
    let (mut borne, mut goes) = (Pairs::new(), Pairs::new());
    for replica in world.replicas.values() {
        let anchor = &replica.name;
        let over = |under: &str| -> Vec<String> {
            holds.iter().filter(|(_, y)| y == under).map(|(x, _)| x.clone()).collect()
        };
        let mut open: Vec<String> =
            on_top.iter().filter(|(_, y)| y == anchor).map(|(x, _)| x.clone()).collect();
        while let Some(thing) = open.pop() {
            if is_portable(&thing) {
                open.extend(over(&thing));
            } else if is_covering(&thing) {
                open.extend(on_top.iter().filter(|(_, y)| *y == thing).map(|(x, _)| x.clone()));
            }
            borne.insert((thing, anchor.clone()));
        }
        let mut open = if is_portable(anchor) { over(anchor) } else { Vec::new() };
        while let Some(thing) = open.pop() {
            open.extend(over(&thing));
            goes.insert((thing, anchor.clone()));
        }
    }
    assert_eq!(pairs(relations, "BORNE_BY"), borne);
    assert_eq!(pairs(relations, "GOES_WITH"), goes);
}

/// A cup on a saucer on a tray is on the table under them too; the table on the carpet lends it to nothing.
#[test]
fn what_lies_on_a_tray_is_on_the_table() {
    check(
        r#"
{ name = "ковёр", object = "carpet", at = [150, 150] },
{ name = "стол", object = "table", at = [200, 200, 1] },
{ name = "поднос", object = "tray", at = [220, 210, 76], angle = 10 },
{ name = "блюдце", object = "saucer", at = [240, 225, 78] },
{ name = "чашка", object = "cup", at = [242, 228, 80] },
"#,
        "BORNE_BY GOES_WITH",
        &expect![[r#"
            BORNE_BY: блюдце, поднос
            BORNE_BY: блюдце, стол
            BORNE_BY: поднос, стол
            BORNE_BY: стол, ковёр
            BORNE_BY: чашка, блюдце
            BORNE_BY: чашка, поднос
            BORNE_BY: чашка, стол
            GOES_WITH: блюдце, поднос
            GOES_WITH: чашка, блюдце
            GOES_WITH: чашка, поднос
        "#]],
    );
}

const STACK: &str = "ON_TOP_OF ABOVE UNDER INSIDE";

#[test]
fn a_cup_on_a_saucer_on_a_tray_on_a_table() {
    check(
        r#"
{ name = "стол", object = "table", at = [200, 200] },
{ name = "поднос", object = "tray", at = [220, 210, 75], angle = 10 },
{ name = "блюдце", object = "saucer", at = [240, 225, 77] },
{ name = "чашка", object = "cup", at = [242, 228, 79] },
"#,
        STACK,
        &expect![[r#"
            ON_TOP_OF: блюдце, поднос
            ON_TOP_OF: поднос, стол
            ON_TOP_OF: чашка, блюдце
        "#]],
    );
}

#[test]
fn a_table_has_a_floor_below_and_room_above() {
    // A cat between the legs, a lamp above the top, a carpet beneath the legs: the lamp is not above the carpet.
    check(
        r#"
{ name = "ковёр", object = "carpet", at = [150, 150] },
{ name = "стол", object = "table", at = [200, 200, 1] },
{ name = "кот", object = "cat", at = [230, 225, 1] },
{ name = "люстра", object = "lamp", at = [240, 220, 200] },
"#,
        STACK,
        &expect![[r#"
            ON_TOP_OF: кот, ковёр
            ON_TOP_OF: стол, ковёр
            ABOVE: люстра, стол
            UNDER: кот, стол
        "#]],
    );
}

#[test]
fn books_in_a_bookcase_and_on_it() {
    check(
        r#"
{ name = "стеллаж", object = "bookcase", at = [100, 100] },
{ name = "том-1", object = "book", at = [110, 108, 60] },
{ name = "том-2", object = "book", at = [115, 108, 60] },
{ name = "том-3", object = "book", at = [110, 108, 110] },
{ name = "том-4", object = "book", at = [110, 108, 190] },
{ name = "том-5", object = "book", at = [110, 60, 0] },
"#,
        "RESTS_ON ON_TOP_OF ABOVE UNDER INSIDE NEXT_TO",
        &expect![[r#"
            RESTS_ON: том-1, стеллаж
            RESTS_ON: том-2, стеллаж
            RESTS_ON: том-3, стеллаж
            RESTS_ON: том-4, стеллаж
            ON_TOP_OF: том-4, стеллаж
            INSIDE: том-1, стеллаж
            INSIDE: том-2, стеллаж
            INSIDE: том-3, стеллаж
            NEXT_TO: стеллаж, том-5
            NEXT_TO: том-1, том-2
            NEXT_TO: том-2, том-1
            NEXT_TO: том-5, стеллаж
        "#]],
    );
}

#[test]
fn boxes_within_boxes() {
    // The stick reaches out of the open box; the cube on the chest is not in it; the book is in the box in the corner table.
    check(
        r#"
{ name = "ящик", object = "box", at = [100, 100] },
{ name = "швабра", object = "stick", at = [110, 110] },
{ name = "сундук", object = "drawer", at = [300, 100] },
{ name = "том", object = "book", at = [310, 110, 5] },
{ name = "куб", object = "cube", at = [300, 100, 40] },
{ name = "большой", object = "ell", at = [400, 300] },
{ name = "малый", object = "box", at = [410, 310, 20] },
{ name = "вложенный", object = "book", at = [420, 320, 21] },
{ name = "в углу", object = "cat", at = [480, 420] },
"#,
        STACK,
        &expect![[r#"
            ON_TOP_OF: куб, сундук
            INSIDE: вложенный, большой
            INSIDE: вложенный, малый
            INSIDE: малый, большой
            INSIDE: том, сундук
            INSIDE: швабра, ящик
        "#]],
    );
}

#[test]
fn one_direct_support_the_highest_then_the_smallest() {
    check(
        r#"
{ name = "куб-1", object = "cube", at = [100, 100] },
{ name = "куб-2", object = "cube", at = [140, 100] },
{ name = "поднос", object = "tray", at = [115, 105, 40] },
{ name = "ковёр", object = "carpet", at = [300, 100] },
{ name = "подстилка", object = "tray", at = [310, 110, 1] },
{ name = "чашка", object = "cup", at = [320, 120, 3] },
"#,
        "RESTS_ON ON_TOP_OF",
        &expect![[r#"
            RESTS_ON: поднос, куб-1
            RESTS_ON: подстилка, ковёр
            RESTS_ON: чашка, подстилка
            ON_TOP_OF: поднос, куб-1
            ON_TOP_OF: подстилка, ковёр
            ON_TOP_OF: чашка, подстилка
        "#]],
    );
}

#[test]
fn tolerance_follows_the_profile() {
    let lifted = room(
        0.0,
        r#"
{ name = "куб", object = "cube", at = [100, 100] },
{ name = "чашка", object = "cup", at = [115, 115, 45] },
"#,
    );
    let on = |profile| {
        let relations = derive(&lifted, &RULES, profile).expect("rules end");
        list(&relations, "ON_TOP_OF ABOVE")
    };
    expect![[r#"
        ABOVE: чашка, куб
    "#]]
    .assert_eq(&on(Profile::Surveyed));
    expect![[r#"
        ON_TOP_OF: чашка, куб
    "#]]
    .assert_eq(&on(Profile::Detected));
}

#[test]
fn a_frustum_bears_on_its_roof_alone() {
    // The pouf's roof has a fifth of its base's size: a tray is centred on it, a cup over its slope is not.
    check(
        r#"
{ name = "пуф", object = "cone", at = [200, 200] },
{ name = "поднос", object = "tray", at = [183, 215, 60] },
{ name = "пуф-2", object = "cone", at = [400, 200] },
{ name = "чашка", object = "cup", at = [440, 220, 60] },
"#,
        "ON_TOP_OF",
        &expect![[r#"
            ON_TOP_OF: поднос, пуф
        "#]],
    );
}

/// What lies on a tablecloth is on the table under it, also what is on a tray on the cloth.
#[test]
fn what_lies_on_a_tablecloth_is_on_the_table() {
    check(
        r#"
{ name = "стол", object = "table", at = [200, 200] },
{ name = "скатерть", object = "cloth", at = [215, 205, 75] },
{ name = "поднос", object = "tray", at = [230, 210, 75.5] },
{ name = "чашка", object = "cup", at = [242, 228, 77.5] },
{ name = "книга", object = "book", at = [290, 225, 75.5] },
"#,
        "BORNE_BY GOES_WITH",
        &expect![[r#"
            BORNE_BY: книга, скатерть
            BORNE_BY: книга, стол
            BORNE_BY: поднос, скатерть
            BORNE_BY: поднос, стол
            BORNE_BY: скатерть, стол
            BORNE_BY: чашка, поднос
            BORNE_BY: чашка, скатерть
            BORNE_BY: чашка, стол
            GOES_WITH: чашка, поднос
        "#]],
    );
}

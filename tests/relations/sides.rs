//! What is next to, near or leaning against what, and on which side of it.

use expect_test::expect;
use orthoframe_semantics::Around;
use orthoframe_units::{Deg, Point, Pose};

use super::{check, derived, room};

#[test]
fn next_to_and_beside_and_what_stands_between() {
    // cube-3 stands at the other end of the wardrobe; cube-4 diagonally; cube-5 too far.
    check(
        r#"
{ name = "куб-1", object = "cube", at = [100, 100] },
{ name = "куб-2", object = "cube", at = [150, 105] },
{ name = "шкаф", object = "wardrobe", at = [300, 100] },
{ name = "куб-3", object = "cube", at = [410, 110] },
{ name = "куб-4", object = "cube", at = [195, 150] },
{ name = "куб-5", object = "cube", at = [100, 300] },
"#,
        "NEXT_TO BESIDE",
        &expect![[r#"
            NEXT_TO: куб-1, куб-2
            NEXT_TO: куб-2, куб-1
            NEXT_TO: куб-2, куб-4
            NEXT_TO: куб-3, шкаф
            NEXT_TO: куб-4, куб-2
            NEXT_TO: шкаф, куб-3
            BESIDE: куб-1, куб-2
            BESIDE: куб-2, куб-1
            BESIDE: куб-3, шкаф
            BESIDE: шкаф, куб-3
        "#]],
    );
    check(
        r#"
{ name = "куб-1", object = "cube", at = [100, 100] },
{ name = "доска", object = "stick", at = [143, 118] },
{ name = "куб-2", object = "cube", at = [150, 100] },
"#,
        "NEXT_TO",
        &expect![[r#"
            NEXT_TO: доска, куб-1
            NEXT_TO: доска, куб-2
            NEXT_TO: куб-1, доска
            NEXT_TO: куб-2, доска
        "#]],
    );
}

#[test]
fn close_to_counts_surfaces_not_centres() {
    check(
        r#"
{ name = "шкаф", object = "wardrobe", at = [100, 100] },
{ name = "куб-1", object = "cube", at = [325, 100] },
{ name = "куб-2", object = "cube", at = [100, 295] },
"#,
        "CLOSE_TO",
        &expect![[r#"
            CLOSE_TO: куб-1, шкаф
            CLOSE_TO: шкаф, куб-1
        "#]],
    );
}

#[test]
fn a_broom_leans_a_bookcase_does_not() {
    check(
        r#"
{ name = "шкаф", object = "wardrobe", at = [100, 100] },
{ name = "стеллаж", object = "bookcase", at = [203, 100] },
{ name = "швабра", object = "stick", at = [97, 120], move_prob = 90 },
{ name = "палка", object = "stick", at = [140, 155], move_prob = 90 },
{ name = "веха", object = "stick", at = [500, 400], move_prob = 90 },
"#,
        "LEANING_AGAINST NEXT_TO",
        &expect![[r#"
            LEANING_AGAINST: палка, шкаф
            LEANING_AGAINST: швабра, шкаф
            NEXT_TO: стеллаж, шкаф
            NEXT_TO: шкаф, стеллаж
        "#]],
    );
}

#[test]
fn left_and_right_are_the_anchors_own() {
    // The wardrobe faces -y of its frame; the second stands turned by 180°.
    check(
        r#"
{ name = "шкаф", object = "wardrobe", at = [300, 300] },
{ name = "лево", object = "cube", at = [430, 310] },
{ name = "право", object = "cube", at = [230, 310] },
{ name = "перед", object = "cube", at = [330, 200] },
{ name = "зад", object = "cube", at = [330, 400] },
{ name = "круг", object = "round", at = [600, 100] },
"#,
        "LEFT_OF RIGHT_OF IN_FRONT_OF BEHIND",
        &expect![[r#"
            LEFT_OF: круг, шкаф
            LEFT_OF: лево, шкаф
            RIGHT_OF: право, шкаф
            IN_FRONT_OF: перед, шкаф
            BEHIND: зад, шкаф
        "#]],
    );
    check(
        r#"
{ name = "шкаф", object = "wardrobe", at = [400, 360], angle = 180 },
{ name = "лево", object = "cube", at = [230, 310] },
"#,
        "LEFT_OF RIGHT_OF IN_FRONT_OF BEHIND",
        &expect![[r#"
            LEFT_OF: лево, шкаф
        "#]],
    );
}

#[test]
fn left_for_the_viewer_is_not_left_of_the_thing() {
    // The wardrobe faces down; the viewer stands above it and looks down: his left is its left no more.
    let world = room(
        0.0,
        r#"
{ name = "шкаф", object = "wardrobe", at = [300, 300] },
{ name = "куб", object = "cube", at = [430, 310] },
"#,
    );
    let relations = derived(&world);
    let map = *world.maps.keys().next().expect("one map");
    let seen = |y: f64| -> String {
        let robot = Pose { at: Point::new(390.0, y), heading: Deg::ZERO };
        let around = Around::new(&world).with_robot(Some((map, robot)));
        let told = |side: &str| {
            let rows = relations.ask(&around, &format!("?- {side}_FOR_VIEWER(X, A)")).unwrap();
            rows.iter().map(|row| format!("{side}_FOR_VIEWER: {}, {}\n", row[0], row[1])).collect()
        };
        ["IN_FRONT", "BEHIND", "LEFT", "RIGHT"]
            .map(told)
            .into_iter()
            .collect::<Vec<String>>()
            .concat()
    };
    expect![[r#"
        LEFT_FOR_VIEWER: шкаф, куб
        RIGHT_FOR_VIEWER: куб, шкаф
    "#]]
    .assert_eq(&seen(50.0));
    expect![[r#"
        LEFT_FOR_VIEWER: куб, шкаф
        RIGHT_FOR_VIEWER: шкаф, куб
    "#]]
    .assert_eq(&seen(550.0));
    assert!(relations.holds("LEFT_OF", &["куб", "шкаф"]));
}

//! What must hold in any room, however it is furnished.

use std::collections::BTreeSet;

use orthoframe_map::World;
use orthoframe_semantics::{Measurements, Pair, Profile, Reach, RelationRules, Relations, derive};
use orthoframe_units::{Deg, Frame, ReplicaId};
use proptest::prelude::*;

use super::{RULES, derived, room};

/// Kind, x, y, z and angle of a thing.
type Placed = (usize, i32, i32, i32, i32);

fn placed() -> impl Strategy<Value = Placed> {
    let heights = prop::sample::select(vec![0, 0, 1, 2, 10, 40, 41, 60, 75, 76, 77, 110, 190, 200]);
    let angles = prop::sample::select(vec![0, 0, 90, 180, 270, 30, 77]);
    (0usize..16, 0..420, 0..320, heights, angles)
}

const KINDS: [&str; 17] = [
    "table", "tray", "saucer", "cup", "bookcase", "book", "cube", "box", "drawer", "stick",
    "carpet", "cloth", "cat", "lamp", "ell", "stool", "cone",
];

/// Things in places that a checked map would refuse too: within each other, and through the walls.
fn furnished(things: &[Placed]) -> World {
    let mut lines = String::new();
    for (n, (kind, ..)) in things.iter().enumerate() {
        let object = KINDS[*kind];
        let line = format!(
            r#"{{ name = "вещь-{n}", object = "{object}", at = [300, 300], move_prob = 50 }},"#
        );
        lines.push_str(&line);
        lines.push('\n');
    }
    let mut world = room(0.0, &lines);
    for (replica, to) in world.replicas.values_mut().zip(things) {
        replica.frame = frame(to);
    }
    world
}

fn frame(to: &Placed) -> Frame {
    Frame::new(f64::from(to.1), f64::from(to.2), f64::from(to.3), Deg::of(f64::from(to.4)))
}

fn moved(world: &World, n: usize, to: Placed) -> (World, ReplicaId) {
    let mut world = world.clone();
    let id = *world.replicas.keys().nth(n).expect("the world has so many");
    let replica = world.replicas.get_mut(&id).expect("its own key");
    replica.frame = frame(&to);
    (world, id)
}

type Edges = BTreeSet<(String, String)>;

fn edges(relations: &Relations, name: &str) -> Edges {
    let tuples = relations.tuples(name).expect("a standard relation");
    tuples
        .iter()
        .map(|t| (t[0].to_string(), t[1].to_string()))
        .filter(|e| e.1 != "Комната" && e.0 != "Комната")
        .collect()
}

fn is_acyclic(edges: &Edges) -> bool {
    // Whoever stands under nothing that is left goes first.
    let mut left = edges.clone();
    loop {
        let held: BTreeSet<String> = left.iter().map(|e| e.0.clone()).collect();
        let before = left.len();
        left.retain(|e| held.contains(&e.1));
        if left.is_empty() {
            return true;
        }
        if left.len() == before {
            return false;
        }
    }
}

fn check_invariants(relations: &Relations) {
    let four = ["INSIDE", "ON_TOP_OF", "ABOVE", "UNDER"].map(|n| edges(relations, n));
    for (i, a) in four.iter().enumerate() {
        for (x, y) in a {
            assert_ne!(x, y);
            for b in &four[i..] {
                let other = (y.clone(), x.clone());
                assert!(!b.contains(&other), "{x} {y} both ways");
            }
            for b in &four[i + 1..] {
                assert!(!b.contains(&(x.clone(), y.clone())), "{x} {y} twice");
            }
        }
    }
    let supports = edges(relations, "RESTS_ON");
    let supported: BTreeSet<&String> = supports.iter().map(|e| &e.0).collect();
    assert_eq!(supported.len(), supports.len(), "one direct support");
    for acyclic in [&supports, &four[0], &four[1]] {
        assert!(is_acyclic(acyclic), "{acyclic:?}");
    }
    for symmetric in ["NEXT_TO", "BESIDE", "CLOSE_TO"].map(|n| edges(relations, n)) {
        assert!(
            symmetric.iter().all(|(x, y)| x != y && symmetric.contains(&(y.clone(), x.clone())))
        );
    }
    assert!(edges(relations, "BESIDE").is_subset(&edges(relations, "NEXT_TO")));
    for stronger in &four {
        assert!(stronger.is_disjoint(&edges(relations, "NEXT_TO")));
    }
    let sectors = ["LEFT_OF", "RIGHT_OF", "IN_FRONT_OF", "BEHIND"].map(|n| edges(relations, n));
    for (i, a) in sectors.iter().enumerate() {
        assert!(sectors[i + 1..].iter().all(|b| a.is_disjoint(b)));
    }
    let inside = relations.tuples("CONTAINS").expect("standard").len();
    let outside = relations.tuples("OUTSIDE").expect("standard").len();
    assert_eq!(inside + outside, relations.tuples("INSTANCE_OF").expect("standard").len());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn precedence_order_and_symmetry_hold_in_any_room(things in prop::collection::vec(placed(), 1..30)) {
        let world = furnished(&things);
        for profile in [Profile::Surveyed, Profile::Detected] {
            check_invariants(&derive(&world, &RULES, profile).expect("rules end"));
        }
    }

    #[test]
    fn near_pairs_are_all_that_pairs_alone_would_give(things in prop::collection::vec(placed(), 2..12)) {
        // The obvious slow way: every pair in a world of its own.
        let world = furnished(&things);
        let measured = Measurements::of(&world, Reach::default());
        let ids: Vec<ReplicaId> = world.replicas.keys().copied().collect();
        for (i, &a) in ids.iter().enumerate() {
            for &b in &ids[i + 1..] {
                let mut two = world.clone();
                two.replicas.retain(|&id, _| id == a || id == b);
                let alone = Measurements::of(&two, Reach::default()).of_pair(a, b).cloned();
                let here = measured.of_pair(a, b).cloned();
                let strip = |p: Option<Pair>| p.map(|mut p| {
                    p.beside.iter_mut().for_each(|b| b.between.clear());
                    p
                });
                prop_assert_eq!(strip(here), strip(alone));
            }
        }
    }

    #[test]
    fn a_move_gives_what_measuring_anew_gives(
        things in prop::collection::vec(placed(), 2..20),
        moves in prop::collection::vec((0usize..20, placed()), 1..6),
    ) {
        let mut world = furnished(&things);
        let mut measured = Measurements::of(&world, Reach::default());
        let mut relations = derived(&world);
        for (n, to) in moves {
            let (after, id) = moved(&world, n % things.len(), to);
            let change = measured.update(&after, id);
            let anew = Measurements::of(&after, Reach::default());
            prop_assert!(measured == anew);
            // What is said to have changed is what has changed.
            prop_assert!(change.removed.keys().all(|k| k.0 == id || k.1 == id || change.added.contains(k)));
            prop_assert!(relations.update(&after, id).expect("rules end"));
            let fresh = derived(&after);
            for count in fresh.counts() {
                prop_assert_eq!(
                    relations.tuples(&count.name).expect("same rules"),
                    fresh.tuples(&count.name).expect("same rules")
                );
            }
            for &id in after.replicas.keys() {
                prop_assert_eq!(relations.area_of(id), fresh.area_of(id));
                prop_assert_eq!(relations.support_of(id), fresh.support_of(id));
                prop_assert_eq!(relations.bears_something(id), fresh.bears_something(id));
            }
            // What was kept is taken up again, pairs not yet measured.
            if n % 2 == 0 {
                let bytes = relations.save().expect("no edit waits");
                let rules = RelationRules::standard();
                relations = Relations::restore(&after, &rules, Profile::Surveyed, &bytes)
                    .expect("the same rules");
                prop_assert!(
                    Relations::restore(&after, &rules, Profile::Detected, &bytes).is_none()
                );
            }
            world = after;
        }
    }
}

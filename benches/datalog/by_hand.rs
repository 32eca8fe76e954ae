//! The programs of [`super::programs`] written by hand on datafrog. Each returns the number of derived tuples.

use datafrog::{Iteration, Relation};

use super::inputs::{Box8, Edge};

/// Those of `all` that are not in `without`. Through a variable, because `Relation::from_antijoin` of datafrog 2.0.1
/// looks at the recent tuples of its input, and a relation has none.
fn absent(all: &Relation<(u32, ())>, without: &Relation<u32>) -> Relation<u32> {
    let mut iteration = Iteration::new();
    let from = iteration.variable::<(u32, ())>("from");
    let rest = iteration.variable::<u32>("rest");
    from.insert(all.clone());
    while iteration.changed() {
        rest.from_antijoin(&from, without, |&key, &()| key);
    }
    rest.complete()
}

pub(crate) fn closure(edges: &[Edge]) -> usize {
    let edge: Relation<Edge> = edges.iter().collect();
    let mut iteration = Iteration::new();
    let path_by_end = iteration.variable::<Edge>("path_by_end");
    // path(a, b) :- edge(a, b).
    path_by_end.extend(edge.iter().map(|&(a, b)| (b, a)));
    while iteration.changed() {
        // path(a, c) :- path(a, b), edge(b, c).   Stored by its end: (b, a).
        path_by_end.from_join(&path_by_end, &edge, |_b, &a, &c| (c, a));
    }
    path_by_end.complete().len()
}

pub(crate) fn same_generation(parents: &[Edge]) -> usize {
    let child: Relation<Edge> = parents.iter().collect();
    let mut iteration = Iteration::new();
    let same = iteration.variable::<Edge>("same");
    let half = iteration.variable::<Edge>("half");
    // same(x, y) :- parent(p, x), parent(p, y), x != y.
    same.insert(Relation::from_vec(
        Relation::from_join(&child, &child, |_p, &x, &y| (x, y))
            .iter()
            .filter(|(x, y)| x != y)
            .copied()
            .collect(),
    ));
    while iteration.changed() {
        // same(x, y) :- parent(a, x), same(a, b), parent(b, y).   half: (b, x).
        half.from_join(&same, &child, |_a, &b, &x| (b, x));
        same.from_join(&half, &child, |_b, &x, &y| (x, y));
    }
    same.complete().len()
}

/// `out(a, d) :- r(a, b), s(b, c), t(c, d), a < 100, d > a.`
pub(crate) fn three_way(r: &[Edge], s: &[Edge], t: &[Edge]) -> usize {
    let r_by_b: Relation<Edge> = r.iter().filter(|(a, _)| *a < 100).map(|&(a, b)| (b, a)).collect();
    let s: Relation<Edge> = s.iter().collect();
    let t: Relation<Edge> = t.iter().collect();
    let rs: Relation<Edge> = Relation::from_join(&r_by_b, &s, |_b, &a, &c| (c, a));
    let all: Relation<Edge> = Relation::from_join(&rs, &t, |_c, &a, &d| (a, d));
    all.iter().filter(|(a, d)| d > a).count()
}

/// `source(x)`: nothing leads there; `degree(x, n)`: so many edges go out; `busy(x)`: at least three.
pub(crate) fn counts(edges: &[Edge]) -> usize {
    let edge: Relation<Edge> = edges.iter().collect();
    let node: Relation<u32> = edges.iter().flat_map(|&(a, b)| [a, b]).collect();
    let target: Relation<u32> = edges.iter().map(|&(_, b)| b).collect();
    let keyed: Relation<(u32, ())> = node.iter().map(|&n| (n, ())).collect();
    let source: Relation<u32> = absent(&keyed, &target);
    let mut degree = Vec::new();
    for same in edge.elements.chunk_by(|x, y| x.0 == y.0) {
        degree.push((same[0].0, same.len() as u32));
    }
    let degree: Relation<(u32, u32)> = degree.into();
    let busy: Relation<u32> = degree.iter().filter(|(_, n)| *n >= 3).map(|&(x, _)| x).collect();
    // quiet(x) :- node(x), !busy(x), !source(x).
    let not_busy: Relation<(u32, ())> = absent(&keyed, &busy).iter().map(|&n| (n, ())).collect();
    let quiet = absent(&not_busy, &source);
    node.len() + source.len() + degree.len() + busy.len() + quiet.len()
}

type InRoom = (u32, [i32; 7]);

pub(crate) fn spatial(boxes: &[Box8], doors: &[Edge]) -> usize {
    let in_room = |b: &Box8| -> InRoom {
        let c = |n: usize| b[n] as i32;
        (c(1) as u32, [c(0), c(2), c(3), c(4), c(5), c(6), c(7)])
    };
    let boxes: Relation<InRoom> = boxes.iter().map(in_room).collect();
    let door: Relation<Edge> = doors.iter().collect();
    let pairs = |holds: &dyn Fn(&[i32; 7], &[i32; 7]) -> bool| -> Relation<Edge> {
        let mut found = Vec::new();
        for room in boxes.elements.chunk_by(|a, b| a.0 == b.0) {
            for (_, a) in room {
                for (_, b) in room {
                    if a[0] != b[0] && holds(a, b) {
                        found.push((a[0] as u32, b[0] as u32));
                    }
                }
            }
        }
        found.into()
    };
    let on = pairs(&|a, b| {
        a[5] == b[5] + b[6] && a[1] < b[3] && b[1] < a[3] && a[2] < b[4] && b[2] < a[4]
    });
    let inside = pairs(&|a, b| {
        b[1] <= a[1]
            && a[3] <= b[3]
            && b[2] <= a[2]
            && a[4] <= b[4]
            && b[5] <= a[5]
            && a[5] + a[6] <= b[5] + b[6]
    });
    let touching = pairs(&|a, b| {
        a[1] <= b[3]
            && b[1] <= a[3]
            && a[2] <= b[4]
            && b[2] <= a[4]
            && a[5] <= b[5] + b[6]
            && b[5] <= a[5] + a[6]
    });
    let near = pairs(&|a, b| {
        a[1] <= b[3] + 50
            && b[1] <= a[3] + 50
            && a[2] <= b[4] + 50
            && b[2] <= a[4] + 50
            && a[5] <= b[5] + b[6] + 50
            && b[5] <= a[5] + a[6] + 50
    });
    let left_of = pairs(&|a, b| {
        a[3] <= b[1]
            && b[1] <= a[3] + 100
            && a[2] < b[4]
            && b[2] < a[4]
            && a[5] < b[5] + b[6]
            && b[5] < a[5] + a[6]
    });
    let mut iteration = Iteration::new();
    let supported_by_end = iteration.variable::<Edge>("supported_by");
    supported_by_end.extend(on.iter().map(|&(a, b)| (b, a)));
    let reach_by_end = iteration.variable::<Edge>("reach");
    reach_by_end.extend(door.iter().map(|&(a, b)| (b, a)));
    while iteration.changed() {
        supported_by_end.from_join(&supported_by_end, &on, |_b, &a, &c| (c, a));
        reach_by_end.from_join(&reach_by_end, &door, |_b, &a, &c| (c, a));
    }
    let has_top: Relation<u32> = on.iter().map(|&(_, b)| b).collect();
    let has_near: Relation<u32> = near.iter().map(|&(a, _)| a).collect();
    let all: Relation<(u32, ())> = boxes.iter().map(|(_, b)| (b[0] as u32, ())).collect();
    let clear: Relation<u32> = absent(&all, &has_top);
    let isolated: Relation<u32> = absent(&all, &has_near);
    let direct = on.len() + inside.len() + touching.len() + near.len() + left_of.len();
    direct
        + supported_by_end.complete().len()
        + reach_by_end.complete().len()
        + has_top.len()
        + has_near.len()
        + clear.len()
        + isolated.len()
}

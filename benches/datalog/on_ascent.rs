//! The programs of [`super::programs`] compiled by `ascent`. Each returns the number of derived tuples.

use ascent::aggregators::count;
use ascent::ascent;

use super::inputs::{Box8, Edge};

ascent! {
    struct Closure;
    relation edge(u32, u32);
    relation path(u32, u32);
    path(a, b) <-- edge(a, b);
    path(a, c) <-- path(a, b), edge(b, c);
}

pub(crate) fn closure(edges: &[Edge]) -> usize {
    let mut program = Closure { edge: edges.to_vec(), ..Closure::default() };
    program.run();
    program.path.len()
}

ascent! {
    struct SameGeneration;
    relation parent(u32, u32);
    relation same(u32, u32);
    same(x, y) <-- parent(p, x), parent(p, y), if x != y;
    same(x, y) <-- parent(a, x), same(a, b), parent(b, y);
}

pub(crate) fn same_generation(parents: &[Edge]) -> usize {
    let mut program = SameGeneration { parent: parents.to_vec(), ..SameGeneration::default() };
    program.run();
    program.same.len()
}

ascent! {
    struct ThreeWay;
    relation r(u32, u32);
    relation s(u32, u32);
    relation t(u32, u32);
    relation out(u32, u32);
    out(a, d) <-- r(a, b), if *a < 100, s(b, c), t(c, d), if d > a;
}

pub(crate) fn three_way(r: &[Edge], s: &[Edge], t: &[Edge]) -> usize {
    let (r, s, t) = (r.to_vec(), s.to_vec(), t.to_vec());
    let mut program = ThreeWay { r, s, t, ..ThreeWay::default() };
    program.run();
    program.out.len()
}

ascent! {
    struct Counts;
    relation edge(u32, u32);
    relation node(u32);
    relation target(u32);
    relation source(u32);
    relation degree(u32, usize);
    relation busy(u32);
    relation quiet(u32);
    node(x), node(y) <-- edge(x, y);
    target(y) <-- edge(_, y);
    source(x) <-- node(x), !target(x);
    degree(x, n) <-- edge(x, _), agg n = count() in edge(x, _);
    busy(x) <-- degree(x, n), if *n >= 3;
    quiet(x) <-- node(x), !busy(x), !source(x);
}

pub(crate) fn counts(edges: &[Edge]) -> usize {
    let mut program = Counts { edge: edges.to_vec(), ..Counts::default() };
    program.run();
    let Counts { node, source, degree, busy, quiet, .. } = program;
    node.len() + source.len() + degree.len() + busy.len() + quiet.len()
}

ascent! {
    struct Spatial;
    relation boxes(i32, i32, i32, i32, i32, i32, i32, i32);
    relation door(u32, u32);
    relation on_top_of(i32, i32);
    relation inside(i32, i32);
    relation touching(i32, i32);
    relation near(i32, i32);
    relation left_of(i32, i32);
    relation supported_by(i32, i32);
    relation has_top(i32);
    relation clear(i32);
    relation has_near(i32);
    relation isolated(i32);
    relation reach(u32, u32);
    on_top_of(a, b) <-- boxes(a, r, ax1, ay1, ax2, ay2, az, _), boxes(b, r, bx1, by1, bx2, by2, bz, bh),
        if a != b, if *az == bz + bh, if ax1 < bx2, if bx1 < ax2, if ay1 < by2, if by1 < ay2;
    inside(a, b) <-- boxes(a, r, ax1, ay1, ax2, ay2, az, ah), boxes(b, r, bx1, by1, bx2, by2, bz, bh),
        if a != b, if bx1 <= ax1, if ax2 <= bx2, if by1 <= ay1, if ay2 <= by2, if bz <= az, if az + ah <= bz + bh;
    touching(a, b) <-- boxes(a, r, ax1, ay1, ax2, ay2, az, ah), boxes(b, r, bx1, by1, bx2, by2, bz, bh),
        if a != b, if ax1 <= bx2, if bx1 <= ax2, if ay1 <= by2, if by1 <= ay2, if *az <= bz + bh, if *bz <= az + ah;
    near(a, b) <-- boxes(a, r, ax1, ay1, ax2, ay2, az, ah), boxes(b, r, bx1, by1, bx2, by2, bz, bh),
        if a != b, if *ax1 <= bx2 + 50, if *bx1 <= ax2 + 50, if *ay1 <= by2 + 50, if *by1 <= ay2 + 50,
        if *az <= bz + bh + 50, if *bz <= az + ah + 50;
    left_of(a, b) <-- boxes(a, r, ax1, ay1, ax2, ay2, az, ah), boxes(b, r, bx1, by1, bx2, by2, bz, bh),
        if a != b, if ax2 <= bx1, if *bx1 <= ax2 + 100, if ay1 < by2, if by1 < ay2, if *az < bz + bh, if *bz < az + ah;
    supported_by(a, b) <-- on_top_of(a, b);
    supported_by(a, c) <-- supported_by(a, b), on_top_of(b, c);
    has_top(b) <-- on_top_of(_, b);
    clear(b) <-- boxes(b, _, _, _, _, _, _, _), !has_top(b);
    has_near(a) <-- near(a, _);
    isolated(a) <-- boxes(a, _, _, _, _, _, _, _), !has_near(a);
    reach(a, b) <-- door(a, b);
    reach(a, c) <-- reach(a, b), door(b, c);
}

pub(crate) fn spatial(all: &[Box8], doors: &[Edge]) -> usize {
    let row = |b: &Box8| {
        let [i, r, x1, y1, x2, y2, z, h] = b.map(|word| word as i32);
        (i, r, x1, y1, x2, y2, z, h)
    };
    let boxes = all.iter().map(row).collect();
    let mut p = Spatial { boxes, door: doors.to_vec(), ..Spatial::default() };
    p.run();
    let direct =
        p.on_top_of.len() + p.inside.len() + p.touching.len() + p.near.len() + p.left_of.len();
    let closures = p.supported_by.len() + p.reach.len();
    direct + closures + p.has_top.len() + p.has_near.len() + p.clear.len() + p.isolated.len()
}

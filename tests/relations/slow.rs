//! Relations against an independent slow reading of SPEC R1: every pair of Orthoframes, polygons clipped edge by edge,
//! from a table of shapes that is written out here once more.
//!
//! What lies within a hair of a threshold is not judged, for the two ways round differently.

use std::collections::BTreeSet;

use orthoframe_map::World;
use orthoframe_semantics::{Profile, Relations, derive};
use orthoframe_units::{Deg, Frame};
use proptest::prelude::*;

use super::{RULES, room};

type P = [f64; 2];

/// A convex prism over the floor of the room.
struct Prism {
    corners: Vec<P>,
    bottom: f64,
    top: f64,
    roof: Vec<P>,
}

struct Shape {
    prisms: Vec<Prism>,
    /// The way it faces.
    front: Option<P>,
    /// Mean of width and depth.
    size: f64,
}

/// Name, prisms, front.
type Described = (&'static str, &'static [[f64; 6]], Option<P>);

/// Objects of [`super::PRELUDE`] that hold nothing and let nothing in: prisms (x, y, width, depth, bottom, height), front.
const SHAPES: [Described; 10] = [
    (
        "table",
        &[
            [0., 0., 6., 6., 0., 72.],
            [114., 0., 6., 6., 0., 72.],
            [114., 74., 6., 6., 0., 72.],
            [0., 74., 6., 6., 0., 72.],
            [0., 0., 120., 80., 72., 3.],
        ],
        Some([0., -1.]),
    ),
    ("tray", &[[0., 0., 50., 30., 0., 2.]], None),
    ("cube", &[[0., 0., 40., 40., 0., 40.]], None),
    ("stick", &[[0., 0., 4., 4., 0., 120.]], None),
    ("carpet", &[[0., 0., 300., 200., 0., 1.]], None),
    ("cloth", &[[0., 0., 90., 70., 0., 0.5]], None),
    ("cat", &[[0., 0., 40., 15., 0., 25.]], None),
    ("wardrobe", &[[0., 0., 100., 60., 0., 200.]], Some([0., -1.])),
    (
        "stool",
        &[
            [0., 0., 30., 30., 0., 40.],
            [-5., -5., 40., 40., 40., 5.],
            [-5., 31., 40., 4., 45., 50.],
        ],
        Some([0., -1.]),
    ),
    ("cone", &[], None),
];

/// Kind, x, y, z and angle of a thing.
type Placed = (usize, i32, i32, i32, i32);

fn placed() -> impl Strategy<Value = Placed> {
    let heights = prop::sample::select(vec![0, 0, 0, 1, 2, 3, 40, 41, 45, 60, 75, 76, 77, 95, 200]);
    let angles = prop::sample::select(vec![0, 0, 90, 180, 270, 30, 77]);
    (0usize..SHAPES.len(), 0..420, 0..320, heights, angles)
}

fn shape(of: &Placed) -> Shape {
    let (kind, x, y, z, angle) = *of;
    let (sin, cos) = f64::from(angle).to_radians().sin_cos();
    let place =
        |p: P| [f64::from(x) + p[0] * cos - p[1] * sin, f64::from(y) + p[0] * sin + p[1] * cos];
    let (name, boxes, front) = SHAPES[kind];
    let prism = |b: &[f64; 6]| {
        let corners: Vec<P> =
            [[b[0], b[1]], [b[0] + b[2], b[1]], [b[0] + b[2], b[1] + b[3]], [b[0], b[1] + b[3]]]
                .map(place)
                .into();
        let bottom = f64::from(z) + b[4];
        Prism { roof: corners.clone(), corners, bottom, top: bottom + b[5] }
    };
    let mut prisms: Vec<Prism> = boxes.iter().map(prism).collect();
    if name == "cone" {
        // A frustum of 24 sides, 60 cm wide and high, a fifth as wide at the top.
        // The first corner stands at the origin, the second on +x.
        let start = turn_of(-6.5);
        let ring = |radius: f64| -> Vec<P> {
            let corner = |n: i32| {
                let at = start + turn_of(f64::from(n));
                let (x, y) = (
                    radius * at.cos() - 30.0 * start.cos(),
                    radius * at.sin() - 30.0 * start.sin(),
                );
                place([x, y])
            };
            (0..24).map(corner).collect()
        };
        let bottom = f64::from(z);
        prisms.push(Prism { corners: ring(30.0), roof: ring(6.0), bottom, top: bottom + 60.0 });
    }
    let front = front.map(|f| [f[0] * cos - f[1] * sin, f[0] * sin + f[1] * cos]);
    let extent = |axis: usize| {
        let ends = |b: &[f64; 6]| (b[axis], b[axis] + b[axis + 2]);
        let all = || boxes.iter().map(ends);
        all().map(|e| e.1).fold(0.0, f64::max) - all().map(|e| e.0).fold(0.0, f64::min)
    };
    // Across the flats from side to side, as 24 sides stand.
    let size = if boxes.is_empty() {
        60.0 * turn_of(0.5).cos()
    } else {
        f64::midpoint(extent(0), extent(1))
    };
    Shape { prisms, front, size }
}

/// Corners of a polygon of 24, as an angle.
fn turn_of(corners: f64) -> f64 {
    corners * std::f64::consts::TAU / 24.0
}

fn cross(o: P, a: P, b: P) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

fn edges(of: &[P]) -> impl Iterator<Item = (P, P)> {
    (0..of.len()).map(|n| (of[n], of[(n + 1) % of.len()]))
}

fn area(of: &[P]) -> f64 {
    edges(of).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

fn contains(of: &[P], p: P) -> bool {
    edges(of).all(|(a, b)| cross(a, b, p) >= 0.0)
}

/// What two convex polygons have in common: one clipped by each edge of the other.
fn common(a: &[P], b: &[P]) -> f64 {
    let mut left: Vec<P> = a.to_vec();
    for (from, to) in edges(b) {
        let mut next = Vec::new();
        for (p, q) in edges(&left) {
            let (dp, dq) = (cross(from, to, p), cross(from, to, q));
            if dp >= 0.0 {
                next.push(p);
            }
            if dp * dq < 0.0 {
                let t = dp / (dp - dq);
                next.push([p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t]);
            }
        }
        left = next;
        if left.is_empty() {
            return 0.0;
        }
    }
    area(&left)
}

fn to_segment(p: P, a: P, b: P) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let t = (((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
    (p[0] - a[0] - t * dx).hypot(p[1] - a[1] - t * dy)
}

fn in_plan(a: &[P], b: &[P]) -> f64 {
    if common(a, b) > 0.0 {
        return 0.0;
    }
    let to = |x: &[P], y: &[P]| {
        let ways = x.iter().flat_map(|&p| edges(y).map(move |(s, e)| to_segment(p, s, e)));
        ways.fold(f64::INFINITY, f64::min)
    };
    to(a, b).min(to(b, a))
}

impl Shape {
    fn bottom(&self) -> f64 {
        self.prisms.iter().map(|p| p.bottom).fold(f64::INFINITY, f64::min)
    }

    fn top(&self) -> f64 {
        self.prisms.iter().map(|p| p.top).fold(f64::NEG_INFINITY, f64::max)
    }

    fn foot(&self) -> impl Iterator<Item = &Prism> {
        let bottom = self.bottom();
        self.prisms.iter().filter(move |p| p.bottom <= bottom + 0.5)
    }

    /// Each of these shapes is as wide as its widest Orthoframe, but for the feet of the stool that lie under its seat.
    fn widest(&self) -> &Prism {
        let by_area = |a: &&Prism, b: &&Prism| area(&a.corners).total_cmp(&area(&b.corners));
        self.prisms.iter().max_by(by_area).expect("a shape has prisms")
    }

    fn centre(&self) -> P {
        let corners = &self.widest().corners;
        let sum = corners.iter().fold([0.0, 0.0], |s, p| [s[0] + p[0], s[1] + p[1]]);
        [sum[0] / corners.len() as f64, sum[1] / corners.len() as f64]
    }

    /// SPEC R1: between surfaces, in space.
    fn distance(&self, other: &Self) -> f64 {
        let mut least = f64::INFINITY;
        for p in &self.prisms {
            for q in &other.prisms {
                let upright = (p.bottom - q.top).max(q.bottom - p.top).max(0.0);
                least = least.min(in_plan(&p.corners, &q.corners).hypot(upright));
            }
        }
        least
    }

    /// Share of the foot over each roof, and whether the centre is over it; with the gap and the roof's prism.
    fn over<'a>(&self, other: &'a Self) -> Vec<(f64, f64, bool, &'a Prism)> {
        let whole: f64 = self.foot().map(|p| area(&p.corners)).sum();
        let roofs = other.prisms.iter().map(|under| {
            let covered: f64 = self.foot().map(|p| common(&p.corners, &under.roof)).sum();
            let centred = contains(&under.roof, self.centre());
            (self.bottom() - under.top, covered / whole, centred, under)
        });
        roofs.filter(|(_, share, centred, _)| *share > 0.0 || *centred).collect()
    }

    /// Degrees from the front at which a point lies, by the sectors of 90° at the corners of the extents.
    fn bearing(&self, p: P) -> Option<f64> {
        let ahead = self.front?;
        let left = [-ahead[1], ahead[0]];
        let beyond = |way: P| {
            let along = |q: P| q[0] * way[0] + q[1] * way[1];
            let all = || self.prisms.iter().flat_map(|p| &p.corners).map(|&c| along(c));
            let (low, high) =
                (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
            (along(p) - high).max(0.0) + (along(p) - low).min(0.0)
        };
        let (forward, sideways) = (beyond(ahead), beyond(left));
        (forward.hypot(sideways) > 1e-3).then(|| sideways.atan2(forward).to_degrees())
    }
}

fn is_near(value: f64, threshold: f64) -> bool {
    (value - threshold).abs() < 0.02
}

/// What must hold, and what must not, of the pairs that can be judged.
#[derive(Default)]
struct Judged {
    holds: BTreeSet<(String, usize, usize)>,
    fails: BTreeSet<(String, usize, usize)>,
}

impl Judged {
    fn say(&mut self, relation: &str, a: usize, b: usize, holds: bool) {
        let into = if holds { &mut self.holds } else { &mut self.fails };
        into.insert((relation.to_owned(), a, b));
    }
}

/// The direct support: the highest roof within 2 cm of the foot, of equals the smaller base; none when that is not clear.
fn support(shapes: &[Shape], a: usize) -> Option<Option<usize>> {
    let mut found: Vec<(f64, f64, usize)> = Vec::new();
    for (b, below) in shapes.iter().enumerate().filter(|(b, _)| *b != a) {
        for (gap, share, centred, roof) in shapes[a].over(below) {
            let lift = shapes[a].bottom() - f64::midpoint(roof.bottom, roof.top);
            if gap.abs() < 2.05
                && (is_near(share, 0.5) || is_near(gap.abs(), 2.0) || is_near(lift, 0.0))
            {
                return None;
            }
            // What starts lower cannot stand on what starts higher.
            let later = shapes[a].bottom() - below.bottom();
            if later.abs() < 0.02 && gap.abs() <= 2.0 {
                return None;
            }
            if gap.abs() <= 2.0 && (share >= 0.5 || centred) && lift >= 0.0 && later > 0.0 {
                found.push((gap, area(&below.widest().corners), b));
            }
        }
    }
    found.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.total_cmp(&y.1)));
    match found.as_slice() {
        [] => Some(None),
        [first, ..] => {
            let rivals = found.iter().filter(|f| f.2 != first.2);
            let unclear =
                rivals.into_iter().any(|f| is_near(f.0, first.0) && is_near(f.1, first.1));
            (!unclear).then_some(Some(first.2))
        }
    }
}

fn judge(shapes: &[Shape]) -> Judged {
    let mut judged = Judged::default();
    for (a, shape) in shapes.iter().enumerate() {
        let held = support(shapes, a);
        if let Some(held) = held {
            (0..shapes.len()).filter(|b| *b != a).for_each(|b| {
                judged.say("RESTS_ON", a, b, held == Some(b));
            });
        }
        above(shapes, a, held, &mut judged);
        for (b, anchor) in shapes.iter().enumerate().filter(|(b, _)| *b != a) {
            let distance = shape.distance(anchor);
            if !is_near(distance, 130.0) {
                judged.say("CLOSE_TO", a, b, distance <= 130.0);
            }
            sector(shape, anchor, (a, b), distance, &mut judged);
            next(shapes, (a, b), distance, &mut judged);
        }
    }
    judged
}

/// Nearest below of those that a fifth of the foot is over, farther than a support may be.
fn above(shapes: &[Shape], a: usize, held: Option<Option<usize>>, judged: &mut Judged) {
    let mut hangs: Vec<(f64, usize)> = Vec::new();
    for (b, below) in shapes.iter().enumerate().filter(|(b, _)| *b != a) {
        for (gap, share, _, _) in shapes[a].over(below) {
            let level = (shapes[a].bottom() - below.bottom()).abs() < 0.02;
            if gap > -2.1 && (is_near(share, 0.2) || is_near(gap.abs(), 2.0) || level) {
                return;
            }
            if gap >= -2.0 && share >= 0.2 && shapes[a].bottom() > below.bottom() {
                hangs.push((gap, b));
            }
        }
    }
    let Some(held) = held else { return };
    let nearest = hangs.iter().map(|h| h.0).fold(f64::INFINITY, f64::min);
    for b in (0..shapes.len()).filter(|b| *b != a) {
        let here = hangs.iter().any(|h| h.1 == b && h.0 <= nearest + 1e-6);
        judged.say("ABOVE", a, b, held.is_none() && here && nearest > 2.0);
    }
}

/// By the anchor's own front: a sector of 90°, a common height, at most two metres apart.
fn sector(
    shape: &Shape,
    anchor: &Shape,
    (a, b): (usize, usize),
    distance: f64,
    judged: &mut Judged,
) {
    let common = shape.top().min(anchor.top()) - shape.bottom().max(anchor.bottom());
    // Both in the room, which is 8 by 6 m.
    let in_room = |p: P| p[0] > 0.1 && p[1] > 0.1 && p[0] < 799.9 && p[1] < 599.9;
    if !in_room(shape.centre()) || !in_room(anchor.centre()) {
        return;
    }
    let Some(bearing) = anchor.bearing(shape.centre()) else { return };
    let edge = [45.0, 135.0].iter().any(|e| (bearing.abs() - e).abs() < 0.02);
    if edge || is_near(distance, 200.0) || is_near(common, 0.0) {
        return;
    }
    let sees = common > 0.0 && distance <= 200.0;
    let sectors = [
        ("IN_FRONT_OF", bearing.abs() < 45.0),
        ("BEHIND", bearing.abs() > 135.0),
        ("LEFT_OF", bearing > 45.0 && bearing < 135.0),
        ("RIGHT_OF", bearing < -45.0 && bearing > -135.0),
    ];
    sectors.into_iter().for_each(|(name, within)| judged.say(name, a, b, sees && within));
}

/// A common height, and surfaces no farther apart than a sixth of the sizes, 10 to 60 cm; of pairs that nothing can be between.
fn next(shapes: &[Shape], (a, b): (usize, usize), distance: f64, judged: &mut Judged) {
    let (x, y) = (&shapes[a], &shapes[b]);
    let bounds = |of: &[&Shape]| {
        let corners = of.iter().flat_map(|shape| &shape.prisms).flat_map(|prism| &prism.corners);
        corners
            .fold([f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY], |b, c| {
                [b[0].min(c[0]), b[1].min(c[1]), b[2].max(c[0]), b[3].max(c[1])]
            })
    };
    let both = bounds(&[x, y]);
    let in_room = both[0] > 0.1 && both[1] > 0.1 && both[2] < 799.9 && both[3] < 599.9;
    let is_clear =
        shapes.iter().enumerate().filter(|(n, _)| *n != a && *n != b).all(|(_, third)| {
            let third = bounds(&[third]);
            third[0] > both[2] || third[2] < both[0] || third[1] > both[3] || third[3] < both[1]
        });
    let common = x.top().min(y.top()) - x.bottom().max(y.bottom());
    let level = common / (x.top() - x.bottom()).min(y.top() - y.bottom());
    let limit = ((x.size + y.size) / 4.0).clamp(30.0, 60.0);
    if in_room && is_clear && (level - 0.333).abs() > 0.002 && !is_near(distance, limit) {
        judged.say("NEXT_TO", a, b, level > 0.333 && distance < limit);
    }
}

fn furnished(things: &[Placed]) -> World {
    let line = |(n, thing): (usize, &Placed)| {
        let object = SHAPES[thing.0].0;
        format!(r#"{{ name = "вещь-{n}", object = "{object}", at = [300, 300], move_prob = 50 }},"#)
    };
    let lines: Vec<String> = things.iter().enumerate().map(line).collect();
    let mut world = room(0.0, &lines.join("\n"));
    for (replica, to) in world.replicas.values_mut().zip(things) {
        let [x, y, z] = [to.1, to.2, to.3].map(f64::from);
        replica.frame = Frame::new(x, y, z, Deg::of(f64::from(to.4)));
    }
    world
}

/// Pairs that stand in one of the relations that those by sides give way to.
fn is_piled(relations: &Relations, a: &str, b: &str) -> bool {
    ["INSIDE", "ON_TOP_OF", "ABOVE", "UNDER", "LEANING_AGAINST"]
        .iter()
        .any(|name| relations.holds(name, &[a, b]) || relations.holds(name, &[b, a]))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn relations_are_what_measuring_every_pair_by_hand_gives(things in prop::collection::vec(placed(), 1..14)) {
        let world = furnished(&things);
        let shapes: Vec<Shape> = things.iter().map(shape).collect();
        let relations = derive(&world, &RULES, Profile::Surveyed).expect("rules end");
        let judged = judge(&shapes);
        super::stacks::check_closures(&world, &relations);
        for (wanted, pairs) in [(true, &judged.holds), (false, &judged.fails)] {
            for (name, a, b) in pairs {
                let (x, y) = (format!("вещь-{a}"), format!("вещь-{b}"));
                let by_side = !matches!(name.as_str(), "RESTS_ON" | "ABOVE" | "CLOSE_TO");
                if by_side && is_piled(&relations, &x, &y) {
                    continue;
                }
                prop_assert_eq!(
                    relations.holds(name, &[&x, &y]), wanted,
                    "{} {} {}: {:?} {:?}", x, name, y, things[*a], things[*b]
                );
            }
        }
    }
}

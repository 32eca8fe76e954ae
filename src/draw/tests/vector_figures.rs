//! The figures of paper 3, drawn from what the code finds: the tree of the map (fig. 1), what becomes of it when a thing moves
//! and when it comes apart (fig. 2), and a picture as vector models (fig. 3). They stand in docs/vectors; `UPDATE_EXPECT=1`
//! draws them anew.

use std::path::Path;

use expect_test::expect_file;
use nalgebra::{Rotation2, Vector2};
use orthoframe_draw::{SeenDrawing, SeenSegment, SeenSign, TreeNode, seen_svg, tree_svg};
use orthoframe_units::Point;
use orthoframe_vectors::picture::Picture;
use orthoframe_vectors::{
    Change, Equality, Model, Motion, Node, Odometry, Scene, Segment, Transition, TreeNode as Branch,
};

fn check(name: &str, svg: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/vectors").join(name);
    expect_file![path].assert_eq(svg);
}

fn ring(points: &[(f64, f64)], is_closed: bool) -> Vec<Segment<2>> {
    let at = |k: usize| Vector2::new(points[k % points.len()].0, points[k % points.len()].1);
    let count = if is_closed { points.len() } else { points.len() - 1 };
    (0..count).map(|k| Segment::given(at(k), at(k + 1), 0.5)).collect()
}

/// A cupboard 120 cm wide, the door its last segment, the hinge at the origin.
fn cupboard() -> Vec<Segment<2>> {
    ring(&[(60.0, 0.0), (120.0, 0.0), (120.0, 60.0), (0.0, 60.0), (0.0, 0.0), (60.0, 0.0)], false)
}

fn stool() -> Vec<Segment<2>> {
    ring(&[(0.0, 0.0), (45.0, 0.0), (38.0, 40.0), (7.0, 40.0)], true)
}

fn corner() -> Vec<Segment<2>> {
    ring(&[(-60.0, 200.0), (380.0, 200.0), (380.0, -120.0)], false)
}

fn placed(segments: &[Segment<2>], x: f64, y: f64, turn: f64) -> Vec<Segment<2>> {
    let place = Transition::<2>::from_parts(Vector2::new(x, y).into(), Rotation2::new(turn));
    segments.iter().map(|s| s.moved(&Motion::from_isometry(place, 1.0))).collect()
}

/// What is seen: the cupboard with its door at an angle, the stool somewhere, the corner of the room.
fn view(door: f64, stool_at: (f64, f64, f64)) -> Vec<Vec<Segment<2>>> {
    let mut case = cupboard();
    let last = case.len() - 1;
    case[last] = placed(&case[last..], 0.0, 0.0, door)[0];
    let (x, y, turn) = stool_at;
    vec![corner(), case, placed(&stool(), x, y, turn)]
}

/// The map as its tree, a segment with its invariants beside the one before it.
fn node(branch: &Branch<2>, invariants: &[String]) -> TreeNode {
    let place = |frame: &Transition<2>| {
        let (v, turn) = (frame.translation.vector, frame.rotation.angle().to_degrees());
        format!("({:.0}, {:.0}), {turn:.0}°", v.x, v.y)
    };
    let lines = match &branch.node {
        Node::Robot => vec!["Robot".to_owned()],
        Node::Scene => vec!["Scene".to_owned()],
        Node::Thing(id, frame) => vec![format!("M{}", id.0 + 1), format!("P {}", place(frame))],
        Node::Part(k, frame) => vec![format!("S{}", k + 1), format!("Q {}", place(frame))],
        Node::Segment(k, s) => {
            let own = format!("σ{} {:.0} см", k + 1, s.length());
            std::iter::once(own).chain(invariants.get(*k).cloned()).collect()
        }
    };
    let below = branch.below.iter().map(|child| {
        let leaves: Vec<Segment<2>> = branch
            .below
            .iter()
            .filter_map(|b| if let Node::Segment(_, s) = b.node { Some(s) } else { None })
            .collect();
        node(child, &told(&leaves))
    });
    TreeNode { lines, below: below.collect(), is_same: matches!(branch.node, Node::Scene) }
}

/// λ and tg Δγ of each segment to the one before it; a right angle has no tangent.
fn told(leaves: &[Segment<2>]) -> Vec<String> {
    let between = |pair: &[Segment<2>]| {
        let (a, b) = (pair[0].vector(), pair[1].vector());
        let (cross, dot) = (a.perp(&b), a.dot(&b));
        let tangent = if dot.abs() < 1e-6 * cross.abs() {
            "∞".to_owned()
        } else {
            format!("{:.2}", cross / dot)
        };
        format!("λ {:.2}, tg {tangent}", b.norm() / a.norm())
    };
    let first = (!leaves.is_empty()).then(String::new);
    first.into_iter().chain(leaves.windows(2).map(between)).collect()
}

fn tree(scene: &Scene<2>) -> TreeNode {
    node(&scene.tree(), &[])
}

fn scene() -> Scene<2> {
    let mut scene = Scene::new(Equality::at(0.999));
    for thing in view(0.0, (220.0, 20.0, 0.2)) {
        scene.add(&Model::of_contour(thing));
    }
    scene
}

fn drawn(segment: &Segment<2>, group: Option<usize>, is_before: bool) -> SeenSegment {
    let is_true = segment.ends.map(|end| end.is_true());
    let (from, to) = (Point::from(segment.start), Point::from(segment.end));
    SeenSegment { from, to, is_true, group, is_before }
}

fn signs() -> Vec<(SeenSign, String)> {
    [
        (SeenSign::TrueEnd, "конец самой вещи"),
        (SeenSign::Observer, "наблюдатель"),
        (SeenSign::Before, "было"),
        (SeenSign::Moved, "сдвинулось само"),
    ]
    .map(|(sign, text)| (sign, text.to_owned()))
    .to_vec()
}

#[test]
fn figure_1_the_tree_of_the_map() {
    let scene = scene();
    let tree = tree(&scene);
    assert!(tree.below[0].is_same && tree.below[0].below.len() == 3);
    check("fig1-tree.svg", &tree_svg("Рис. 1. Робот, сцена, вещи, отрезки", &tree));
}

/// How the scene was, how it is after an observation, and what the scene found of it.
fn changed(door: f64, stool_at: (f64, f64, f64)) -> (Scene<2>, Vec<Change<2>>, SeenDrawing) {
    let mut scene = scene();
    let before: Vec<Model<2>> = (0..3).map(|k| scene.seen(k)).collect();
    let seen = view(door, stool_at).concat();
    let stands = Odometry::Exact(Transition::identity());
    let report = scene.observe(&Model::of_contour(seen), stands);
    let mut drawing = SeenDrawing {
        observer: Some(Point::new(150.0, -150.0)),
        scale: Some((100.0, "1 м".to_owned())),
        signs: signs(),
        ..SeenDrawing::default()
    };
    for (k, was) in before.iter().enumerate() {
        let is = scene.seen(k);
        for (s, t) in was.segments().iter().zip(is.segments()) {
            let off = t.at(0.5) - s.at(0.5);
            let moved = off.norm() > 3.0;
            drawing.segments.extend(moved.then(|| drawn(s, None, true)));
            drawing.segments.push(drawn(t, moved.then_some(k), false));
            drawing.moves.extend(moved.then(|| (Point::from(s.at(0.5)), Point::from(t.at(0.5)))));
        }
    }
    (scene, report.changes, drawing)
}

#[test]
fn figure_2_a_thing_that_moved() {
    let (scene, changes, mut drawing) = changed(0.0, (236.0, 36.0, 0.5));
    assert!(matches!(changes[..], [Change::Moved { .. }]), "{changes:?}");
    assert!((0..3).all(|k| scene.depth(k) == 1));
    drawing.title = "Рис. 2, случай 1. Вещь сдвинулась: новая матрица P, отрезки те же".to_owned();
    check("fig2-moved.svg", &seen_svg(&drawing));
    check(
        "fig2-moved-tree.svg",
        &tree_svg("Рис. 2, случай 1. Дерево той же глубины", &tree(&scene)),
    );
}

#[test]
fn figure_2_a_thing_that_came_apart() {
    let (scene, changes, mut drawing) = changed(-0.4, (220.0, 20.0, 0.2));
    let apart = |c: &Change<2>| matches!(c, Change::Reconfigured { parts: 2, .. });
    assert!(changes.iter().any(apart), "{changes:?}");
    assert_eq!((scene.depth(0), scene.depth(1), scene.depth(2)), (1, 2, 1));
    drawing.title = "Рис. 2, случай 2. Дверца шкафа: S1 и S2 движутся сами".to_owned();
    check("fig2-apart.svg", &seen_svg(&drawing));
    check(
        "fig2-apart-tree.svg",
        &tree_svg("Рис. 2, случай 2. Дерево выросло на уровень", &tree(&scene)),
    );
}

/// A frame with things of straight edges, some of them with holes, blurred by a pixel and with noise.
fn frame(wide: usize, tall: usize) -> Picture {
    let shapes: [(&[(f64, f64)], u8); 5] = [
        (&[(40.0, 40.0), (150.0, 30.0), (170.0, 120.0), (110.0, 90.0), (60.0, 140.0)], 200),
        (
            &[
                (220.0, 40.0),
                (360.0, 40.0),
                (360.0, 70.0),
                (290.0, 70.0),
                (290.0, 160.0),
                (220.0, 160.0),
            ],
            170,
        ),
        (&[(60.0, 190.0), (180.0, 170.0), (190.0, 260.0), (70.0, 275.0)], 220),
        (&[(90.0, 200.0), (150.0, 195.0), (155.0, 240.0), (95.0, 248.0)], 40),
        (&[(250.0, 200.0), (330.0, 180.0), (370.0, 230.0), (320.0, 275.0), (260.0, 260.0)], 190),
    ];
    let inside = |shape: &[(f64, f64)], x: f64, y: f64| {
        let edges = (0..shape.len()).map(|k| (shape[k], shape[(k + 1) % shape.len()]));
        let crossed = edges.filter(|(p, q)| {
            (p.1 > y) != (q.1 > y) && x < p.0 + (y - p.1) / (q.1 - p.1) * (q.0 - p.0)
        });
        crossed.count() % 2 == 1
    };
    let light = |x: f64, y: f64| {
        shapes.iter().rfind(|(shape, _)| inside(shape, x, y)).map_or(40.0, |(_, v)| f64::from(*v))
    };
    let mut noise = 12345_u32;
    let mut pixels = Vec::with_capacity(wide * tall);
    for k in 0..wide * tall {
        let (x, y) = ((k % wide) as f64, (k / wide) as f64);
        let samples = [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)];
        let mean = samples.iter().map(|(dx, dy)| light(x + dx, y + dy)).sum::<f64>() / 4.0;
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        pixels.push((mean + f64::from(noise >> 24) * 0.04 - 5.0).clamp(0.0, 255.0) as u8);
    }
    Picture::new(wide as u32, tall as u32, pixels).expect("as many pixels as it is wide and tall")
}

#[test]
fn figure_3_a_picture_as_vector_models() {
    let picture = frame(420, 300);
    let contours = picture.contours(picture.level());
    let models: Vec<Model<2>> = contours.into_iter().map(Model::of_contour).collect();
    let sizes: Vec<usize> = models.iter().map(Model::len).collect();
    // The blur may cut a corner by an edge of some pixels.
    let edges = |m: &Model<2>| m.segments().iter().filter(|s| s.length() > 5.0).count();
    let mut sorted: Vec<usize> = models.iter().map(edges).collect();
    sorted.sort_unstable();
    assert_eq!(sorted, [4, 4, 5, 5, 6], "the edges that were drawn");
    let segments = models.iter().enumerate();
    let segments =
        segments.flat_map(|(k, m)| m.segments().iter().map(move |s| drawn(s, Some(k), false)));
    let count: usize = sizes.iter().sum();
    let drawing = SeenDrawing {
        title: format!(
            "Рис. 3. Кадр {} × {}: моделей {}, отрезков {count}",
            420,
            300,
            models.len()
        ),
        segments: segments.collect(),
        scale: Some((100.0, "100 точек".to_owned())),
        signs: signs(),
        ..SeenDrawing::default()
    };
    check("fig3-screen.svg", &seen_svg(&drawing));
}

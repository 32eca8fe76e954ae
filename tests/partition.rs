//! How few the Passframes are: against the fewest convex pieces that there can be, found the slow ways.

use orthoframe_geometry::*;
use orthoframe_map::DoorState;
use orthoframe_units::*;

use crate::floor_properties::{Random, random_world};
use crate::floors::{Builder, p, rectangle};
use crate::footprint::shaped;

/// Positive when a, b, c turn left.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    let (u, v) = (b - a, c - b);
    u.perp(&v) / (u.norm() * v.norm()).max(1e-12)
}

const STRAIGHT: f64 = 1e-7;

/// The corners of a region: those that do not lie on a straight line, by contour.
fn contours(region: &Region) -> Vec<Vec<Point>> {
    let corners = |c: &Polygon| {
        let n = c.corners.len();
        let at = |i: usize| c.corners[i % n];
        (0..n).filter(|&i| turn(at(i + n - 1), at(i), at(i + 1)).abs() > STRAIGHT).map(at).collect()
    };
    region.contours().map(corners).collect()
}

/// Whether a segment between two corners lies in the region and touches no border on its way.
fn sees(region: &Region, a: Point, b: Point) -> bool {
    let crosses = region.contours().flat_map(Polygon::edges).any(|(u, v)| {
        let (su, sv) = (turn(a, b, u) * (u - b).norm(), turn(a, b, v) * (v - b).norm());
        let (sa, sb) = (turn(u, v, a) * (a - v).norm(), turn(u, v, b) * (b - v).norm());
        su.abs() > 1e-6
            && sv.abs() > 1e-6
            && su * sv < 0.0
            && sa.abs() > 1e-6
            && sb.abs() > 1e-6
            && sa * sb < 0.0
    });
    let inside = |k: i32| {
        let q = a + (b - a) * (f64::from(k) / 8.0);
        region.contains(q, 0.0) && region.contours().all(|c| c.border_distance(q) > 1e-6)
    };
    let through_a_corner = region.contours().flat_map(|c| &c.corners).any(|&c| {
        (c - a).norm() > 1e-6
            && (c - b).norm() > 1e-6
            && (c - nearest_on_segment(c, a, b)).norm() < 1e-6
    });
    !crosses && !through_a_corner && (1..8).all(inside)
}

/// The fewest convex pieces of a polygon without holes, cut from corner to corner: the best of all pieces at an
/// edge, again and again (after Greene 1983).
fn fewest(region: &Region) -> usize {
    let corners = contours(region).remove(0);
    let n = corners.len();
    let is_chord = |i: usize, j: usize| {
        j == i + 1 || (i, j) == (0, n - 1) || sees(region, corners[i], corners[j])
    };
    let joined: Vec<Vec<bool>> =
        (0..n).map(|i| (0..n).map(|j| i < j && is_chord(i, j)).collect()).collect();
    // pieces[i][j]: the fewest for the corners from i to j, cut off by the chord between them.
    let mut pieces = vec![vec![usize::MAX; n]; n];
    (0..n - 1).for_each(|i| pieces[i][i + 1] = 0);
    for width in 2..n {
        for i in 0..n - width {
            let j = i + width;
            if joined[i][j] {
                pieces[i][j] = 1 + chain(&corners, &joined, &pieces, i, j);
            }
        }
    }
    pieces[0][n - 1]
}

/// The fewest pieces behind a convex chain of chords from i to j.
fn chain(c: &[Point], joined: &[Vec<bool>], pieces: &[Vec<usize>], i: usize, j: usize) -> usize {
    let left = |a: usize, b: usize, d: usize| turn(c[a], c[b], c[d]) > -STRAIGHT;
    // best[a][b]: the chain so far ends with the chord from a to b.
    let mut best = vec![vec![usize::MAX; j + 1]; j + 1];
    let mut least = usize::MAX;
    for b in i + 1..=j {
        for a in i..b {
            let cost = pieces[a][b];
            if !joined[a][b] || cost == usize::MAX || (a, b) == (i, j) {
                continue;
            }
            let before = if a == i {
                // At its first corner the chain leaves to the left of the chord that comes from j.
                if b < j && left(j, i, b) { Some(0) } else { None }
            } else {
                (i..a)
                    .filter(|&z| best[z][a] < usize::MAX && left(z, a, b))
                    .map(|z| best[z][a])
                    .min()
            };
            let Some(before) = before else { continue };
            best[a][b] = before + cost;
            if b == j && left(a, j, i) {
                least = least.min(best[a][b]);
            }
        }
    }
    least
}

/// Whether a region with holes can be cut into so few convex pieces, from corner to corner: a solver picks chords
/// that do not cross and leave no corner turning inwards. Pieces are one more than chords, less one for every hole.
fn can_be_cut_into(region: &Region, pieces: usize) -> bool {
    let mut corners: Vec<[Point; 3]> = Vec::new();
    for contour in contours(region) {
        let n = contour.len();
        corners
            .extend((0..n).map(|i| [contour[(i + n - 1) % n], contour[i], contour[(i + 1) % n]]));
    }
    let inward = |c: &[Point; 3]| turn(c[0], c[1], c[2]) < -STRAIGHT;
    let mut chords: Vec<(usize, usize)> = Vec::new();
    for (i, a) in corners.iter().enumerate() {
        for (j, b) in corners.iter().enumerate().skip(i + 1) {
            let apart = (b[1] - a[1]).norm() > 1e-6;
            if apart && (inward(a) || inward(b)) && sees(region, a[1], b[1]) {
                chords.push((i, j));
            }
        }
    }
    let mut clauses: Vec<Vec<i32>> = Vec::new();
    let literal = |chord: usize| chord as i32 + 1;
    for (k, &(i, j)) in chords.iter().enumerate() {
        for (l, &(u, v)) in chords.iter().enumerate().skip(k + 1) {
            let [a, b, c, d] = [i, j, u, v].map(|n| corners[n][1]);
            let crosses =
                turn(a, b, c) * turn(a, b, d) < -1e-12 && turn(c, d, a) * turn(c, d, b) < -1e-12;
            if crosses {
                clauses.push(vec![-literal(k), -literal(l)]);
            }
        }
    }
    for (i, corner) in corners.iter().enumerate().filter(|(_, c)| inward(c)) {
        // Angles counter-clockwise from the border that leaves the corner to the one that arrives.
        let [before, at, after] = *corner;
        let angle = |p: Point| {
            let (u, v) = (after - at, p - at);
            u.perp(&v).atan2(u.dot(&v)).rem_euclid(std::f64::consts::TAU)
        };
        let whole = angle(before);
        let rays: Vec<(f64, i32)> = (chords.iter().enumerate())
            .filter(|(_, c)| c.0 == i || c.1 == i)
            .map(|(k, c)| (angle(corners[if c.0 == i { c.1 } else { c.0 }][1]), literal(k)))
            .collect();
        let half = std::f64::consts::PI + 1e-9;
        for (from, own) in rays.iter().map(|r| (r.0, Some(r.1))).chain([(0.0, None)]) {
            if whole - from > half {
                let next = rays.iter().filter(|r| r.0 > from + 1e-9 && r.0 - from <= half);
                clauses.push(own.map(|l| -l).into_iter().chain(next.map(|r| r.1)).collect());
            }
        }
    }
    has_choice(chords.len(), &clauses, pieces + region.holes.len() - 1)
}

/// Whether the clauses can be satisfied with at most `most` of the first `count` variables.
fn has_choice(count: usize, clauses: &[Vec<i32>], most: usize) -> bool {
    use batsat::{BasicSolver, Lit, SolverInterface, lbool};
    let mut solver = BasicSolver::default();
    let mut fresh = || Lit::new(solver.new_var_default(), true);
    let chosen: Vec<Lit> = (0..count).map(|_| fresh()).collect();
    // Sinz's counter: sums[i][j] if more than j of the first i + 1 are chosen.
    let sums: Vec<Vec<Lit>> = (0..count).map(|_| (0..most).map(|_| fresh()).collect()).collect();
    let mut add = |mut clause: Vec<Lit>| solver.add_clause_reuse(&mut clause);
    for clause in clauses {
        let literals = clause.iter().map(|&l| {
            let lit = chosen[l.unsigned_abs() as usize - 1];
            if l < 0 { !lit } else { lit }
        });
        add(literals.collect());
    }
    for i in 0..count {
        if most == 0 {
            add(vec![!chosen[i]]);
            continue;
        }
        add(vec![!chosen[i], sums[i][0]]);
        if i == 0 {
            continue;
        }
        for j in 0..most {
            add(vec![!sums[i - 1][j], sums[i][j]]);
            if j > 0 {
                add(vec![!chosen[i], !sums[i - 1][j - 1], sums[i][j]]);
            }
        }
        add(vec![!chosen[i], !sums[i - 1][most - 1]]);
    }
    solver.solve_limited(&[]) == lbool::TRUE
}

/// How many Passframes the pieces of a Fragment's free floor have.
fn counts(floor: &FragmentFloor) -> Vec<(Region, usize)> {
    let own = |r: &Region| {
        floor.passframes().iter().filter(|f| r.contains(f.polygon.centroid(), 0.0)).count()
    };
    floor
        .free()
        .into_iter()
        .map(|r| {
            let count = own(&r);
            (r, count)
        })
        .collect()
}

/// A room with bays and columns along its walls, and nothing on its floor.
fn room_with_bays(seed: u64) -> Builder {
    let mut random = Random(seed);
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(900.0, 700.0), Frame::IDENTITY, &[]);
    for x in [0.0, 150.0, 300.0, 450.0, 600.0, 750.0] {
        for top in [false, true] {
            let (w, d) = (random.between(40.0, 100.0), random.between(30.0, 250.0));
            if random.unit() < 0.7 {
                let y = if top { 700.0 - d } else { 0.0 };
                b.put(hall, x + random.between(0.0, 30.0), y, w, d, 0.0, 100.0);
            }
        }
    }
    b.world.robot.radius = Cm::of(15.0);
    b
}

#[test]
fn the_slow_ways_agree_with_what_is_known() {
    let region = |corners: &[(f64, f64)]| Region {
        outer: Polygon::new(corners.iter().map(|&(x, y)| p(x, y)).collect()),
        holes: vec![],
    };
    let square = region(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)]);
    let ell = region(&[(0., 0.), (4., 0.), (4., 2.), (2., 2.), (2., 4.), (0., 4.)]);
    // A plus sign: four inward corners, two cuts.
    let plus = region(&[
        (1., 0.),
        (2., 0.),
        (2., 1.),
        (3., 1.),
        (3., 2.),
        (2., 2.),
        (2., 3.),
        (1., 3.),
        (1., 2.),
        (0., 2.),
        (0., 1.),
        (1., 1.),
    ]);
    for (region, wanted) in [(&square, 1), (&ell, 2), (&plus, 3)] {
        assert_eq!(fewest(region), wanted);
        assert!(can_be_cut_into(region, wanted));
        assert!(wanted == 1 || !can_be_cut_into(region, wanted - 1));
    }
    let mut pillar = Polygon::new(vec![p(1., 1.), p(3., 1.), p(3., 3.), p(1., 3.)]);
    pillar.corners.reverse();
    let ring = Region { holes: vec![pillar], ..square };
    assert!(can_be_cut_into(&ring, 4) && !can_be_cut_into(&ring, 3));
}

/// Of random worlds, in the ordinary run of a third of them.
#[test]
fn passframes_are_few() {
    let worlds = if crate::files::long() { 6 } else { 2 };
    let (mut looked_at, mut exact, mut least) = (0, 0, 0);
    for seed in 0..worlds {
        let mut closed = random_world(seed + 500);
        closed.world.doors.values_mut().for_each(|d| d.state = DoorState::CLOSED);
        let mut long = random_world(seed + 20);
        shaped(&mut long, seed as usize, &mut Random(seed));
        for b in [room_with_bays(seed), random_world(seed), closed, long] {
            let plan = FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new());
            for (region, frames) in plan.fragments().flat_map(counts) {
                // The most pieces of which 1.2 times are fewer than the Passframes.
                let fewer = (frames as f64 / 1.2).ceil() as usize - 1;
                assert!(
                    fewer == 0 || !can_be_cut_into(&region, fewer),
                    "seed {seed}: {frames} Passframes where {fewer} pieces do"
                );
                looked_at += 1;
                let is_small = region.holes.is_empty() && contours(&region)[0].len() <= 18;
                if is_small {
                    let fewest = fewest(&region);
                    assert!(can_be_cut_into(&region, fewest));
                    exact += frames;
                    least += fewest;
                }
            }
        }
    }
    eprintln!("{looked_at} floors; of small ones {exact} Passframes, {least} pieces at least");
    assert!(looked_at > 4 * worlds && exact as f64 <= 1.1 * least as f64, "{exact} of {least}");
}

/// A hall of these corners with things of these corners in it, turned as a whole; the robot is small.
fn hall(corners: &[Point], things: &[Vec<Point>], turn: f64) -> Builder {
    let mut b = Builder::new();
    let hall = b.area("Зал", corners, Frame::IDENTITY, &[]);
    for corners in things {
        let object = b.object(&[(corners, 0.0, 100.0)]);
        b.place_object(hall, object, Frame::IDENTITY);
    }
    b.world.robot.radius = Cm::of(6.0);
    b.moved(0.0, 0.0, turn)
}

/// A box of `w` × `d` about a point, turned.
fn thing(x: f64, y: f64, w: f64, d: f64, turn: f64) -> Vec<Point> {
    let frame = Frame::new(x, y, 0.0, Deg::of(turn));
    let corners = [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)];
    corners.map(|(i, j)| frame.apply(p(i * w / 2.0, j * d / 2.0))).to_vec()
}

/// A star of so many tips.
fn star(tips: usize, inner: f64) -> Vec<Point> {
    let at = |k: usize| {
        let radius = if k.is_multiple_of(2) { 500.0 } else { inner };
        let (sin, cos) = (std::f64::consts::PI * k as f64 / tips as f64).sin_cos();
        p(radius * cos, radius * sin)
    };
    (0..2 * tips).map(at).collect()
}

/// A corridor 60 wide that winds inwards.
fn spiral(turns: usize) -> Vec<Point> {
    let (mut left, mut right) = (Vec::new(), Vec::new());
    let (mut at, mut along) = (p(0., 0.), Vector::new(1., 0.));
    for k in 0..turns {
        let across = Vector::new(-along.y, along.x);
        let length = 900.0 - 100.0 * (k / 2) as f64;
        if k == 0 {
            right.push(at - across * 30.0);
            left.push(at + across * 30.0);
        }
        at += along * length;
        right.push(at - across * 30.0 + along * 30.0);
        left.push(at + across * 30.0 - along * 30.0);
        if k + 1 == turns {
            // The end runs straight across.
            let last = left.len() - 1;
            left[last] = at + across * 30.0 + along * 30.0;
        }
        along = across;
    }
    left.reverse();
    right.extend(left);
    right
}

/// A comb whose teeth lean.
fn comb(teeth: usize, lean: f64) -> Vec<Point> {
    let mut corners = vec![p(0., 0.), p(100.0 * teeth as f64, 0.)];
    for k in (0..teeth).rev() {
        let x = 100.0 * k as f64;
        corners.extend([
            p(x + 80., 100.),
            p(x + 80. + lean, 300.),
            p(x + 20. + lean, 300.),
            p(x + 20., 100.),
        ]);
    }
    corners
}

fn corridors(kind: usize) -> Vec<Point> {
    let of = |c: &[(f64, f64)]| c.iter().map(|&(x, y)| p(x, y)).collect();
    match kind {
        0 => of(&[(0., 0.), (800., 0.), (800., 150.), (150., 150.), (150., 700.), (0., 700.)]),
        1 => of(&[
            (0., 0.),
            (900., 0.),
            (900., 150.),
            (520., 150.),
            (520., 700.),
            (370., 700.),
            (370., 150.),
            (0., 150.),
        ]),
        _ => of(&[
            (0., 0.),
            (900., 0.),
            (900., 600.),
            (750., 600.),
            (750., 150.),
            (150., 150.),
            (150., 600.),
            (0., 600.),
        ]),
    }
}

/// Boxes thrown into 1000 × 800, straight or turned.
fn thrown(count: usize, seed: u64, turned: bool) -> Vec<Vec<Point>> {
    let mut random = Random(seed);
    (0..count)
        .map(|_| {
            let (x, y) = (random.between(80., 920.), random.between(80., 720.));
            let (w, d) = (random.between(30., 140.), random.between(20., 80.));
            let turn = if turned { random.between(0., 180.) } else { 0. };
            thing(x, y, w, d, turn)
        })
        .collect()
}

#[test]
fn shapes_of_every_sort_are_cut_into_few() {
    let mut shapes: Vec<(String, Builder)> = Vec::new();
    for turn in [0.0, 31.7] {
        for teeth in [3, 6, 10] {
            for lean in [0.0, 60.0] {
                shapes.push((
                    format!("comb {teeth} {lean} {turn}"),
                    hall(&comb(teeth, lean), &[], turn),
                ));
            }
        }
        for (tips, inner) in [(5, 190.0), (7, 300.0), (12, 350.0)] {
            shapes.push((format!("star {tips} {turn}"), hall(&star(tips, inner), &[], turn)));
        }
        for turns in [3, 6, 9] {
            shapes.push((format!("spiral {turns} {turn}"), hall(&spiral(turns), &[], turn)));
        }
        for kind in 0..3 {
            let desks = [
                thing(300., 75., 60., 40., 23.),
                thing(650., 60., 50., 50., 0.),
                thing(75., 400., 40., 60., 71.),
            ];
            shapes.push((format!("corridor {kind} {turn}"), hall(&corridors(kind), &[], turn)));
            shapes.push((format!("desks {kind} {turn}"), hall(&corridors(kind), &desks, turn)));
        }
        for (count, turned) in [(5, false), (5, true), (8, true)] {
            for seed in 0..2 {
                let room = rectangle(1000.0, 800.0);
                let name = format!("room of {count} {turned} {seed} {turn}");
                shapes.push((name, hall(&room, &thrown(count, seed, turned), turn)));
            }
        }
    }
    let mut looked_at = 0;
    for (name, b) in shapes {
        let plan = FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new());
        for (region, frames) in plan.fragments().flat_map(counts) {
            let fewer = (frames as f64 / 1.2).ceil() as usize - 1;
            assert!(
                fewer == 0 || !can_be_cut_into(&region, fewer),
                "{name}: {frames} Passframes where {fewer} pieces do"
            );
            looked_at += 1;
        }
    }
    assert!(looked_at > 40, "{looked_at}");
}

/// Turned by an odd angle, a comb has its teeth in one line still: one Passframe for each, and one for the back.
#[test]
fn a_turned_comb_is_cut_as_a_straight_one() {
    for (teeth, lean) in [(3, 0.0), (10, 0.0), (10, 60.0)] {
        for turn in [0.0, 17.3, 31.7, 45.0, 123.4] {
            let b = hall(&comb(teeth, lean), &[], turn);
            let plan = FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new());
            let frames = plan.fragments().next().expect("the hall").passframes();
            assert_eq!(frames.len(), teeth + 1, "{teeth} {lean} {turn}");
            assert!(frames.iter().all(|f| f.polygon.is_convex(1e-9)));
        }
    }
}

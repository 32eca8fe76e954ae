//! How few the Passframes are: against the fewest convex pieces that there can be, found the slow ways.

use orthoframe::geometry::*;
use orthoframe::map::DoorState;
use orthoframe::units::*;

use crate::floor_properties::{Random, random_world};
use crate::floors::{Builder, p, rectangle};

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

#[test]
fn passframes_are_few() {
    let (mut looked_at, mut exact, mut least) = (0, 0, 0);
    for seed in 0..6 {
        let mut closed = random_world(seed + 500);
        closed.world.doors.values_mut().for_each(|d| d.state = DoorState::CLOSED);
        for b in [room_with_bays(seed), random_world(seed), closed] {
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
    assert!(looked_at > 25 && exact as f64 <= 1.1 * least as f64, "{exact} of {least}");
}

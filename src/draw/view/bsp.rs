//! Facets in space put in order from far to near by a binary space partition, exactly: what crosses is cut.
//!
//! After Fuchs, Kedem, Naylor, "On visible surface generation by a priori tree structures" (1980).
//!
//! **Invariant.** A facet that comes later in the order is hidden by no facet that comes before it.

use nalgebra::{Point3, Vector3};

/// On a plane within this, in cm.
const THICKNESS: f64 = 1e-4;

/// A convex flat polygon in space.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Facet {
    pub corners: Vec<Point3<f64>>,
    /// Edge `i` starts at corner `i`: whether it is one of the body's own, not a cut.
    pub is_edge: Vec<bool>,
    pub normal: Vector3<f64>,
    /// Whose it is, for the caller.
    pub owner: usize,
}

impl Facet {
    /// None for corners that span no plane.
    pub(super) fn new(corners: Vec<Point3<f64>>, owner: usize) -> Option<Self> {
        // Newell's normal, which any flat polygon has.
        let normal = (0..corners.len()).fold(Vector3::zeros(), |n, i| {
            let (p, q) = (corners[i], corners[(i + 1) % corners.len()]);
            n + Vector3::new(
                (p.y - q.y) * (p.z + q.z),
                (p.z - q.z) * (p.x + q.x),
                (p.x - q.x) * (p.y + q.y),
            )
        });
        let normal = normal.try_normalize(1e-6)?;
        Some(Self { is_edge: vec![true; corners.len()], corners, normal, owner })
    }

    fn plane(&self) -> Plane {
        Plane { normal: self.normal, offset: self.normal.dot(&self.corners[0].coords) }
    }

    /// The part on the side of a plane to which its normal points.
    pub(super) fn clipped(&self, plane: &Plane) -> Option<Self> {
        self.split(plane).0
    }

    /// Whether it lies in a plane and looks to its back.
    pub(super) fn lies_against(&self, plane: &Plane) -> bool {
        const FLUSH: f64 = 2e-3;
        self.normal.dot(&plane.normal) < 0.0
            && self.corners.iter().all(|p| plane.height(p).abs() < FLUSH)
    }

    /// The parts in front of and behind a plane.
    fn split(&self, plane: &Plane) -> (Option<Self>, Option<Self>) {
        let heights: Vec<f64> = self.corners.iter().map(|p| plane.height(p)).collect();
        let part = |sign: f64| {
            let mut corners = Vec::new();
            let mut is_edge = Vec::new();
            let n = self.corners.len();
            for i in 0..n {
                let j = (i + 1) % n;
                let (a, b) = (heights[i] * sign, heights[j] * sign);
                let cut = || self.corners[i] + (self.corners[j] - self.corners[i]) * (a / (a - b));
                if a >= -THICKNESS {
                    corners.push(self.corners[i]);
                    is_edge.push(self.is_edge[i]);
                    if a > THICKNESS && b < -THICKNESS {
                        // From here along the cut.
                        corners.push(cut());
                        is_edge.push(false);
                    } else if b < -THICKNESS {
                        *is_edge.last_mut().expect("just pushed") = false;
                    }
                } else if b > THICKNESS {
                    corners.push(cut());
                    is_edge.push(self.is_edge[i]);
                }
            }
            (corners.len() >= 3).then(|| Self { corners, is_edge, ..self.clone() })
        };
        (part(1.0), part(-1.0))
    }
}

/// `normal · p = offset`
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    pub normal: Vector3<f64>,
    pub offset: f64,
}

impl Plane {
    fn height(&self, p: &Point3<f64>) -> f64 {
        self.normal.dot(&p.coords) - self.offset
    }
}

struct Node {
    plane: Plane,
    on: Vec<Facet>,
    front: Option<usize>,
    behind: Option<usize>,
}

/// Puts facets in order from far to near as seen from `eye`. Facets of one plane keep the order in which they came.
pub(super) fn far_to_near(facets: Vec<Facet>, eye: Point3<f64>) -> Vec<Facet> {
    // What lies lowest hides nothing, and comes first: the lines of what stands on it stay whole.
    let heights = || facets.iter().flat_map(|f| f.corners.iter().map(|p| p.z));
    let lowest = heights().fold(eye.z, f64::min) + THICKNESS;
    let lies_lowest = |facet: &Facet| facet.corners.iter().all(|p| p.z <= lowest);
    let (mut order, facets): (Vec<Facet>, Vec<Facet>) = facets.into_iter().partition(lies_lowest);

    let mut nodes: Vec<Node> = Vec::new();
    // Sets of facets still to be parted, each with the node and the side that it will hang on.
    let mut waiting = vec![(facets, None::<(usize, bool)>)];
    while let Some((set, parent)) = waiting.pop() {
        let Some(plane) = divider(&set) else { continue };
        let (mut on, mut front, mut behind) = (Vec::new(), Vec::new(), Vec::new());
        for facet in set {
            let heights = facet.corners.iter().map(|p| plane.height(p));
            let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
            match (high > THICKNESS, low < -THICKNESS) {
                (false, false) => on.push(facet),
                (true, false) => front.push(facet),
                (false, true) => behind.push(facet),
                (true, true) => {
                    let (one, other) = facet.split(&plane);
                    front.extend(one);
                    behind.extend(other);
                }
            }
        }
        let index = nodes.len();
        nodes.push(Node { plane, on, front: None, behind: None });
        match parent {
            Some((parent, true)) => nodes[parent].front = Some(index),
            Some((parent, false)) => nodes[parent].behind = Some(index),
            None => {}
        }
        waiting.push((front, Some((index, true))));
        waiting.push((behind, Some((index, false))));
    }
    let mut steps: Vec<(usize, bool)> =
        if nodes.is_empty() { Vec::new() } else { vec![(0, false)] };
    while let Some((index, is_open)) = steps.pop() {
        if is_open {
            order.append(&mut nodes[index].on);
            continue;
        }
        let node = &nodes[index];
        let (near, far) = if node.plane.height(&eye) >= 0.0 {
            (node.front, node.behind)
        } else {
            (node.behind, node.front)
        };
        // A stack: what is pushed last comes first.
        steps.extend(near.map(|i| (i, false)));
        steps.push((index, true));
        steps.extend(far.map(|i| (i, false)));
    }
    order
}

/// The plane of the facet, out of a few spread over the set, that cuts the fewest others.
fn divider(set: &[Facet]) -> Option<Plane> {
    const TRIED: usize = 9;
    const AGAINST: usize = 120;
    let step = (set.len() / TRIED).max(1);
    let against = (set.len() / AGAINST).max(1);
    let cost = |plane: &Plane| {
        let (mut cuts, mut balance) = (0_i64, 0_i64);
        for facet in set.iter().step_by(against) {
            let (mut front, mut behind) = (false, false);
            for p in &facet.corners {
                let height = plane.height(p);
                front |= height > THICKNESS;
                behind |= height < -THICKNESS;
            }
            cuts += i64::from(front && behind);
            balance += i64::from(front) - i64::from(behind);
        }
        8 * cuts + balance.abs()
    };
    set.iter().step_by(step).map(Facet::plane).min_by_key(cost)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, z: f64, along_x: bool, owner: usize) -> Facet {
        let far = if along_x { (x + 10.0, y) } else { (x, y + 10.0) };
        let corners = [(x, y, z), (far.0, far.1, z), (far.0, far.1, z + 10.0), (x, y, z + 10.0)];
        Facet::new(corners.map(|(x, y, z)| Point3::new(x, y, z)).into(), owner).expect("a square")
    }

    #[test]
    fn near_walls_come_after_far_ones_and_crossing_ones_are_cut() {
        let eye = Point3::new(5.0, -100.0, 5.0);
        let walls = vec![
            square(0.0, 0.0, 0.0, true, 0),
            square(0.0, 20.0, 0.0, true, 1),
            square(0.0, 10.0, 0.0, true, 2),
            square(5.0, -5.0, 0.0, false, 3),
        ];
        let order = far_to_near(walls, eye);
        let at = |owner: usize| order.iter().position(|f| f.owner == owner).expect("all are there");
        assert!(at(1) < at(2) && at(2) < at(0));
        // The wall that stands across wall 0 is cut by it, or cuts it.
        assert!(order.len() > 4);
    }

    #[test]
    fn the_order_is_that_of_distance_along_random_beams() {
        let mut seed = 7_u64;
        let mut random = |n: u64| {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((seed >> 33) % n) as f64
        };
        let facets: Vec<Facet> = (0..60)
            .map(|i| square(random(100), 20.0 + random(80), random(20), i % 2 == 0, i))
            .collect();
        let eye = Point3::new(50.0, 0.0, 12.0);
        let order = far_to_near(facets, eye);
        for _ in 0..300 {
            let ray = Vector3::new(random(100) - 50.0, 60.0, random(30) - 15.0).normalize();
            // The last facet that a beam meets in the order is the nearest one.
            let hits: Vec<f64> = order.iter().filter_map(|f| hit(f, eye, ray)).collect();
            if let Some(last) = hits.last() {
                let nearest = hits.iter().copied().fold(f64::INFINITY, f64::min);
                assert!(last - nearest < 1e-3, "{last} {nearest}");
            }
        }
    }

    /// How far off a beam meets a facet, well within it.
    fn hit(f: &Facet, eye: Point3<f64>, ray: Vector3<f64>) -> Option<f64> {
        let along = f.normal.dot(&ray);
        if along.abs() < 1e-9 {
            return None;
        }
        let t = f.normal.dot(&(f.corners[0] - eye)) / along;
        let p = eye + ray * t;
        let n = f.corners.len();
        let inside = (0..n).all(|i| {
            let (a, b) = (f.corners[i], f.corners[(i + 1) % n]);
            f.normal.dot(&(b - a).cross(&(p - a))) > 1e-3 * (b - a).norm()
        });
        (t > 0.0 && inside).then_some(t)
    }
}

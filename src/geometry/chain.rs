//! The chain of Passframes, and the doorways, that a way passes (W3).
//!
//! A way is followed from Passframe to Passframe over the edges by which it leaves them: what that costs depends on the
//! way alone. Where it leaves the Passframes, as in a strait, it is cut at all Passframes near it instead.

use crate::units::{AreaId, InOrder as _, Point};

use super::floor::FragmentFloor;
use super::mesh::NONE;
use super::nearest_on_segment;
use super::opening::Opening;
use super::passframe::PassframeId;
use super::plan::FloorPlan;
use super::route::Route;

/// What a way passes, in order.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Passed {
    pub chain: Vec<(AreaId, PassframeId)>,
    /// By their index in [`FloorPlan::doorways`].
    pub doorways: Vec<usize>,
}

impl FloorPlan {
    /// The Passframes and doorways that a way of this plan passes.
    #[must_use]
    pub fn passed(&self, route: &Route) -> Passed {
        let [Some(&first), Some(&last)] = [route.points.first(), route.points.last()] else {
            return Passed::default();
        };
        let number = |p: Point| self.anchor(p, None, None).map(|anchor| anchor.cell.0);
        let (Some(from), Some(to)) = (number(first), number(last)) else {
            return Passed::default();
        };
        self.walked(&route.points, from)
            .unwrap_or_else(|| self.clipped(&route.points, &self.network.between(from, to)))
    }

    /// What a way passes, from one to the next, beginning in a Fragment; none where the way leaves the Passframes, as
    /// straits do.
    fn walked(&self, points: &[Point], first: u32) -> Option<Passed> {
        /// Shorter stretches, in cm, only touch a Passframe.
        const TOUCHED: f64 = 1e-3;
        let (mut chain, mut doorways) = (Vec::new(), Vec::new());
        let (mut number, mut floor) = (first, self.covered(first));
        let mut cell = floor.frames.locate(points[0], 1e-3)?;
        for leg in points.windows(2) {
            let (a, b) = (leg[0], leg[1]);
            let length = (b - a).norm();
            let mut from = 0.0_f64;
            // Round a corner where many cells meet, a way might turn in circles.
            for steps in 0.. {
                let way_out = floor.frames.way_out(cell, a, b);
                let to = way_out.map_or(1.0, |(share, _)| share.max(from));
                if (to - from) * length > TOUCHED || length < TOUCHED {
                    let frame = (floor.area, floor.ids[cell as usize]);
                    if chain.last() != Some(&frame) {
                        chain.push(frame);
                    }
                }
                from = to;
                let Some((_, edge)) = way_out else { break };
                if (1.0 - from) * length <= TOUCHED {
                    break;
                }
                let across = floor.frames.across(cell).get(edge);
                if across != NONE {
                    cell = across;
                } else {
                    let near = TOUCHED / length;
                    let passes = |&(doorway, _): &(usize, usize)| {
                        let at = crossing(a, b, &self.doorways()[doorway]);
                        at.is_some_and(|at| (at - from).abs() <= 20.0 * near)
                    };
                    let &(doorway, side) = self.doorways_at(number).iter().find(|d| passes(d))?;
                    doorways.push(doorway);
                    number = self.number(self.doorways()[doorway].areas[1 - side])? as u32;
                    floor = self.covered(number);
                    cell = floor.frames.locate(a + (b - a) * (from + near).min(1.0), 1e-3)?;
                }
                if steps > floor.frames.len() + 8 {
                    return None;
                }
            }
        }
        Some(Passed { chain, doorways })
    }

    /// The same, found by cutting the way at all Passframes near it.
    fn clipped(&self, points: &[Point], among: &[u32]) -> Passed {
        let (mut chain, mut doorways) = (Vec::new(), Vec::new());
        let fragments: Vec<&FragmentFloor> = among.iter().map(|&n| self.covered(n)).collect();
        let is_among = |&a: &AreaId| fragments.binary_search_by_key(&a, |f| f.area).is_ok();
        let mut near: Vec<usize> = fragments
            .iter()
            .flat_map(|f| f.exits.iter().filter_map(|e| self.doorway_at(f.area, e.doorway)))
            .chain(self.network.straits.iter().flat_map(|s| s.doorways.iter().map(|d| d.0)))
            .filter(|&d| self.doorways()[d].areas.iter().all(is_among))
            .collect();
        near.sort_unstable();
        near.dedup();
        // The Passframe in which the last leg ended: convex, so that a leg with both ends in it lies in it.
        let mut last: Option<(&FragmentFloor, u32)> = None;
        let (mut cells, mut passed, mut crossed) = (Vec::new(), Vec::new(), Vec::new());
        for leg in points.windows(2) {
            if last.is_some_and(|(f, cell)| leg.iter().all(|&p| f.frames.holds(cell, p, 0.0))) {
                continue;
            }
            let length = (leg[1] - leg[0]).norm();
            let reach = super::Bounds::of([leg[0], leg[1]]).grown(1.0);
            passed.clear();
            for fragment in fragments.iter().filter(|f| f.bounds.grown(100.0).meets(&reach)) {
                fragment.frames.near_segment(leg[0], leg[1], &mut cells);
                for &cell in &cells {
                    let Some((from, to)) = fragment.frames.clip(cell, leg[0], leg[1]) else {
                        continue;
                    };
                    if (to - from) * length > 1e-3 || length < 1e-3 {
                        passed.push((from + to, *fragment, cell));
                    }
                }
            }
            passed.order_by(|a, b| a.0.total_cmp(&b.0));
            for &(_, fragment, cell) in &passed {
                last = Some((fragment, cell));
                let frame = (fragment.area, fragment.ids[cell as usize]);
                if chain.last() != Some(&frame) {
                    chain.push(frame);
                }
            }
            crossed.clear();
            let crossing = |i: usize| crossing(leg[0], leg[1], &self.doorways()[i]);
            crossed.extend(near.iter().filter_map(|&i| Some((crossing(i)?, i))));
            crossed.order_by(|a, b| a.0.total_cmp(&b.0));
            for &(_, doorway) in &crossed {
                if doorways.last() != Some(&doorway) {
                    doorways.push(doorway);
                }
            }
        }
        Passed { chain, doorways }
    }
}

/// Where, as a share of its length, a leg crosses a doorway's line.
fn crossing(from: Point, to: Point, doorway: &Opening) -> Option<f64> {
    let (a, b) = doorway.line();
    let side = |p: Point| (b - a).perp(&(p - a));
    let (before, after) = (side(from), side(to));
    if before * after > 0.0 || (before - after).abs() < 1e-9 {
        return None;
    }
    let t = before / (before - after);
    let p = from + (to - from) * t;
    ((p - nearest_on_segment(p, a, b)).norm() < 0.01).then_some(t)
}

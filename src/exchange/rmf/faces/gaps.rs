//! Gaps in drawn walls over which two rooms are one: as narrow as a doorway, or wider.

use std::collections::HashMap;

use super::{DOORWAY, Graph, LEAST_ROOM, MOST_EDGES, MOST_LEADS, OPEN, REACH, TURN, WELD};
use crate::map::plane::{doubled_area, meeting};
use crate::units::{InOrder as _, Point};

impl Graph {
    /// Where a wall that ends in the open goes on in its own line, or meets another wall, no farther than `reach`: the
    /// gap from its end, the narrowest first.
    fn gaps(&self, reach: f64) -> Vec<(usize, Point)> {
        let degrees = self.degrees();
        let (turn, mut gaps) = (TURN.to_radians().cos(), Vec::<(f64, usize, Point)>::new());
        for &edge in &self.edges {
            for (end, from) in [(edge.0, edge.1), (edge.1, edge.0)] {
                let p = self.points[end];
                let Some(way) = (p - self.points[from]).try_normalize(1e-9) else { continue };
                if degrees[end] != 1 || edge.2 != 0 {
                    continue;
                }
                let is_ahead = |q: &Point| {
                    let (v, far) = (q - p, (q - p).norm());
                    far > WELD && far <= reach && v.dot(&way) >= far * turn
                };
                let others = || self.edges.iter().filter(|e| e.0 != end && e.1 != end);
                let ray = (p + way * WELD, p + way * reach);
                let met = others().filter_map(|&e| meeting(ray, self.ends(e)));
                let ends = others().flat_map(|&e| [self.points[e.0], self.points[e.1]]);
                let ahead = met.chain(ends).filter(is_ahead);
                let nearest = ahead.min_by(|a, b| (a - p).norm().total_cmp(&(b - p).norm()));
                gaps.extend(nearest.map(|q| ((q - p).norm(), end, q)));
            }
        }
        gaps.order_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // From both its ends it is one gap.
        let mut known: Vec<(Point, Point)> = Vec::new();
        let near = |a: Point, b: Point| (a - b).norm() <= WELD;
        gaps.retain(|&(_, end, q)| {
            let p = self.points[end];
            let is_new = !known.iter().any(|&(a, b)| near(a, q) && near(b, p));
            known.push((p, q));
            is_new
        });
        gaps.into_iter().map(|(_, end, q)| (end, q)).take(MOST_LEADS).collect()
    }

    /// This graph with open edges over gaps.
    pub(super) fn led(&self, gaps: &[(usize, Point)]) -> Self {
        let mut graph = self.clone();
        for &(end, q) in gaps {
            let to = graph.node(q);
            if to != end {
                graph.edges.push((end, to, OPEN));
            }
        }
        graph.split();
        graph.dedup();
        graph
    }

    /// Which gaps part the floor into two rooms, or a room from the outside, when all of them are closed.
    fn parting(&self, gaps: &[(usize, Point)]) -> Vec<bool> {
        let mut graph = self.led(gaps);
        let ends: Vec<(usize, usize)> = gaps.iter().map(|&(end, q)| (end, graph.node(q))).collect();
        let (_, cycles) = graph.bound();
        let mut sides: HashMap<(usize, usize), f64> = HashMap::new();
        for cycle in &cycles {
            let ring: Vec<Point> = cycle.iter().map(|&(n, _)| graph.points[n]).collect();
            let area = doubled_area(&ring) / 2.0;
            for (i, &(node, _)) in cycle.iter().enumerate() {
                sides.insert((node, cycle[(i + 1) % cycle.len()].0), area);
            }
        }
        // Of the border of all walls the outside lies beyond.
        let is_room = |area: &f64| *area < 0.0 || *area >= LEAST_ROOM;
        let parts = |a: usize, b: usize| {
            let areas = [sides.get(&(a, b)), sides.get(&(b, a))];
            areas.iter().all(|area| area.is_some_and(is_room))
                && areas.iter().flatten().any(|area| **area > 0.0)
        };
        ends.into_iter().map(|(a, b)| parts(a, b)).collect()
    }

    /// Gaps as narrow as a doorway that would part rooms, all of them closed together.
    pub(super) fn narrow_gaps(&self) -> Vec<(Point, Point)> {
        if self.edges.len() > MOST_EDGES {
            return Vec::new();
        }
        let mut gaps = self.gaps(DOORWAY);
        loop {
            let parting = self.parting(&gaps);
            if parting.iter().all(|&parts| parts) {
                break;
            }
            // One that shuts off a niche may have kept others from parting anything.
            let mut kept = parting.into_iter();
            gaps.retain(|_| kept.next().unwrap_or(false));
        }
        gaps.iter().map(|&(end, q)| (self.points[end], q)).collect()
    }

    /// The gaps wider than a doorway over which two rooms are one, each by itself.
    pub(super) fn wide_gaps(&self) -> Vec<(Point, Point)> {
        if self.edges.len() > MOST_EDGES {
            return Vec::new();
        }
        let gaps = self.gaps(REACH);
        let is_wide = |gap: &(usize, Point)| (gap.1 - self.points[gap.0]).norm() > DOORWAY;
        let wide = gaps.into_iter().filter(is_wide);
        let wide = wide.filter(|gap| self.parting(&[*gap]) == [true]);
        wide.map(|(end, q)| (self.points[end], q)).collect()
    }
}

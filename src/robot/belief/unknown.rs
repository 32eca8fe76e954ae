//! What the robot met and nobody knows: things with the outlines that were seen, and ways that are barred for now.
//!
//! **Invariant**: it is forgotten as a whole, with all that it was held to bar.

use crate::geometry::{Bounds, Polygon};
use crate::obstacle::{is_obstacle, stand_obstacle};
use crate::units::{Point, ReplicaId};
use crate::vehicle::Outlines;

use super::Belief;

/// Of more unknown things no way past them is looked for.
const MOST_UNKNOWN: usize = 40;
/// An unknown thing whose corners moved by no more is as it was, cm.
const SAME: f64 = 5.0;

impl Belief {
    /// Stands things there that were seen and that nobody knows, in place of what was seen there before; whether that was
    /// otherwise.
    pub(crate) fn stand(&mut self, seen: &Outlines) -> bool {
        let (mut changed, mut is_news) = (Vec::new(), false);
        for pieces in seen.things.iter().take(MOST_UNKNOWN.saturating_sub(self.unknown.len())) {
            let Some(middle) = pieces.first().map(Polygon::centroid) else { continue };
            let bounds = pieces.iter().map(Polygon::bounds).reduce(|a, b| a.union(&b));
            let Some(bounds) = bounds else { continue };
            let Some(area) = self.scene().area_at(middle) else { continue };
            // Where the robot stands nothing else does.
            let (at, reach) = (self.pose.at, self.floor().reach());
            if pieces.iter().any(|p| p.contains(at, 0.0) || p.border_distance(at) < reach) {
                continue;
            }
            let Some((_, frame)) = self.world.placement(area) else { continue };
            let known = self.scene().replicas.values();
            let known = known.filter(|thing| is_obstacle(thing.id) && thing.bounds.meets(&bounds));
            let known: Vec<(ReplicaId, Bounds)> = known.map(|one| (one.id, one.bounds)).collect();
            let is_same = |(_, old): &(ReplicaId, Bounds)| {
                (old.min - bounds.min).norm() <= SAME && (old.max - bounds.max).norm() <= SAME
            };
            if known.iter().any(is_same) {
                continue;
            }
            is_news = true;
            for (old, _) in known {
                self.world.replicas.remove(&old);
                changed.push(old);
            }
            let own = |piece: &Polygon| piece.corners.iter().map(|p| frame.invert(*p)).collect();
            let pieces: Vec<Vec<Point>> = pieces.iter().map(own).collect();
            let top = seen.top - frame.z.get();
            let stood = stand_obstacle(&mut self.world, area, &pieces, top);
            self.unknown.extend(stood);
            changed.extend(stood);
        }
        if !changed.is_empty() {
            self.rebuild(&changed);
        }
        is_news
    }

    /// As [`Belief::no_way_to`], for something that nobody knows and that may go away again.
    pub(crate) fn no_way_for_now(&mut self, name: String) -> bool {
        self.is_barred = true;
        self.no_way_to(name)
    }

    /// The middles of unknown things that it met, as far as they were seen.
    pub(crate) fn unknown_places(&self) -> Vec<Point> {
        let placed = self.unknown.iter().filter_map(|id| self.scene().replicas.get(id));
        placed.map(|one| nalgebra::center(&one.bounds.min, &one.bounds.max)).collect()
    }

    pub(crate) fn has_met_unknown(&self) -> bool {
        !self.unknown.is_empty() || self.is_barred
    }

    /// What nobody knows may have been somebody, who is elsewhere by now.
    pub(crate) fn forget_unknown(&mut self) {
        let gone = std::mem::take(&mut self.unknown);
        self.world.replicas.retain(|id, _| !gone.contains(id));
        self.rebuild(&gone);
        self.reopen_ways();
    }

    /// What bars which way is not known any more; a rehearsal finds again what is barred all the same.
    pub(crate) fn reopen_ways(&mut self) {
        self.is_barred = false;
        self.unreachable.clear();
        self.no_return.clear();
    }
}

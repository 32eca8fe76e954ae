//! What the robot met and nobody knows: things with the outlines that were seen or felt, and ways that are barred for now.
//!
//! **Invariant**: what was seen is forgotten as a whole, with all that it was held to bar; what was touched and not seen is
//! nobody who walks on, and stays.

use crate::geometry::{Bounds, Polygon, nearest_on_segment};
use crate::obstacle::{is_obstacle, stand_obstacle};
use crate::units::{Point, ReplicaId};
use crate::vehicle::Outlines;

use super::Belief;

/// Of more unknown things no way past them is looked for.
const MOST_UNKNOWN: usize = 40;
/// An unknown thing whose corners moved by no more is as it was, cm: so much two looks of one laser differ.
const SAME: f64 = 5.0;
/// What is left of a thing beside the robot keeps off it by so much more than it must, cm.
const OFF: f64 = 0.5;

impl Belief {
    /// Stands things there that were met and that nobody knows; what is seen stands in place of what was seen there before.
    /// Whether that was otherwise.
    pub(crate) fn stand(&mut self, met: &Outlines) -> bool {
        let (mut changed, mut is_news) = (Vec::new(), false);
        let left = MOST_UNKNOWN.saturating_sub(self.unknown.len() + self.felt.len());
        let seen = met.things.iter().map(|pieces| (pieces, false));
        let all = seen.chain(met.felt.iter().map(|pieces| (pieces, true)));
        for (pieces, is_felt) in all.take(left) {
            // Where the robot stands nothing else does.
            let (at, reach) = (self.pose.at, self.floor().reach() + OFF);
            let pieces: Vec<Polygon> =
                pieces.iter().filter_map(|piece| kept_off(piece, at, reach)).collect();
            let Some(middle) = pieces.first().map(Polygon::centroid) else { continue };
            let bounds = pieces.iter().map(Polygon::bounds).reduce(|a, b| a.union(&b));
            let Some(bounds) = bounds else { continue };
            let Some(area) = self.scene().area_at(middle) else { continue };
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
            for (old, _) in known.iter().filter(|(old, _)| !is_felt && !self.felt.contains(old)) {
                self.world.replicas.remove(old);
                changed.push(*old);
            }
            let own = |piece: &Polygon| piece.corners.iter().map(|p| frame.invert(*p)).collect();
            let pieces: Vec<Vec<Point>> = pieces.iter().map(own).collect();
            let top = met.top - frame.z.get();
            let stood = stand_obstacle(&mut self.world, area, &pieces, top);
            let list = if is_felt { &mut self.felt } else { &mut self.unknown };
            list.extend(stood);
            changed.extend(stood);
        }
        if !changed.is_empty() {
            self.rebuild(&changed);
        }
        is_news
    }

    /// The same for what it did not meet on its way, beside what is known to stand there.
    pub(crate) fn stand_beside(&mut self, seen: &Outlines) {
        let known: Vec<Bounds> =
            self.obstacles().iter().flat_map(|(_, all)| all.iter().map(Polygon::bounds)).collect();
        let is_new = |pieces: &&Vec<Polygon>| {
            !pieces.iter().any(|piece| known.iter().any(|old| old.meets(&piece.bounds())))
        };
        let things = seen.things.iter().filter(is_new).cloned().collect();
        self.stand(&Outlines { things, felt: Vec::new(), top: seen.top });
    }

    /// As [`Belief::no_way_to`], for something that nobody knows and that may go away again.
    pub(crate) fn no_way_for_now(&mut self, name: String) -> bool {
        self.is_barred = true;
        self.no_way_to(name)
    }

    /// What was seen on no map stands about: what this mission met, and what was known before it.
    pub(crate) fn obstacles(&self) -> Vec<(ReplicaId, Vec<Polygon>)> {
        let placed = self.scene().replicas.values().filter(|thing| is_obstacle(thing.id));
        let pieces =
            placed.map(|one| (one.id, one.prisms.iter().map(|p| p.polygon.clone()).collect()));
        pieces.collect()
    }

    /// Whether this mission met it itself.
    pub(crate) fn has_met(&self, obstacle: ReplicaId) -> bool {
        self.unknown.contains(&obstacle) || self.felt.contains(&obstacle)
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

/// What of a convex piece lies no nearer to a point, on the side on which it is; none where it is about the point.
fn kept_off(piece: &Polygon, at: Point, reach: f64) -> Option<Polygon> {
    let feet = piece.edges().map(|(a, b)| nearest_on_segment(at, a, b) - at);
    let nearest = feet.min_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    let distance = nearest.norm();
    if piece.contains(at, 0.0) || distance < 1e-6 {
        return None;
    }
    let beyond = |p: Point| (p - at).dot(&nearest) / distance - reach;
    let mut corners = Vec::new();
    for (a, b) in piece.edges() {
        let (from, to) = (beyond(a), beyond(b));
        if from >= 0.0 {
            corners.push(a);
        }
        if (from < 0.0) != (to < 0.0) {
            corners.push(a + (b - a) * (from / (from - to)));
        }
    }
    let left = Polygon::new(corners);
    (left.corners.len() >= 3 && left.signed_area().abs() > 1.0).then_some(left)
}

//! Superlatives: of things that fit a description the biggest, the nearest, the third from the left.

use super::Knowledge;
use crate::question::Doubt;
use crate::question::query::{Best, Extreme, Rel, Restriction, Thing};
use crate::units::{InOrder as _, Vector};

impl Knowledge<'_> {
    /// The things at some places of a superlative's order: from the first place asked for, so many.
    pub(super) fn best(
        &self,
        best: &Best,
        mut found: Vec<Thing>,
        of_anything: bool,
        (rank, count): (u64, u64),
        loose: bool,
    ) -> Result<Vec<Thing>, Doubt> {
        let mut ranked: Vec<(f64, Thing)> = match best.extreme {
            Extreme::Nearest | Extreme::Farthest => {
                let anchors = match &best.anchor {
                    Some(noun) => {
                        let place = Restriction { rel: Rel::To, anchors: vec![], negated: false };
                        self.anchors(&place, noun, loose)?
                    }
                    None => vec![Thing::Robot],
                };
                // "The nearest thing to the egg" is not the counter under it.
                if let (Extreme::Nearest, [anchor], true) =
                    (best.extreme, &anchors[..], of_anything)
                {
                    let below = self.support_chain(*anchor);
                    found
                        .retain(|t| !below.contains(t) && !self.support_chain(*t).contains(anchor));
                }
                let way = match anchors[..] {
                    [anchor] if found.iter().all(|t| t.is_gone_to()) => {
                        self.ways_to(&mut found, anchor)
                    }
                    _ => Vec::new(),
                };
                if way.is_empty()
                    && let (Extreme::Nearest, [anchor], 1) = (best.extreme, &anchors[..], rank)
                {
                    return Ok(self.nearest(self.this_side(found, *anchor, count), *anchor, count));
                }
                let sign = if best.extreme == Extreme::Nearest { 1.0 } else { -1.0 };
                let away = |t: Thing| {
                    let all =
                        anchors.iter().filter(|a| **a != t).filter_map(|a| self.distance(t, *a));
                    all.reduce(f64::min)
                };
                match way.is_empty() {
                    true => found.iter().filter_map(|t| Some((sign * away(*t)?, *t))).collect(),
                    false => way.into_iter().map(|(far, thing)| (sign * far, thing)).collect(),
                }
            }
            Extreme::LeftMost | Extreme::RightMost => self.outermost(&found, best.extreme),
            Extreme::Most | Extreme::Fewest => {
                let Some(counted) = &best.anchor else { return Ok(found) };
                let all = self.counted_at(counted, &found)?;
                let sign = if best.extreme == Extreme::Most { -1.0 } else { 1.0 };
                let number = |t: Thing| self.having(&all, t) as f64;
                found.iter().map(|t| (sign * number(*t), *t)).collect()
            }
            extreme => {
                let extreme = self.by_place_or_size(extreme, &found);
                let sign = if extreme.is_less() { 1.0 } else { -1.0 };
                found.iter().filter_map(|t| Some((sign * self.measure(extreme, *t)?, *t))).collect()
            }
        };
        ranked.order_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if best.extreme == Extreme::Midmost {
            let middle = ranked.len() / 2;
            let one = (ranked.len() % 2 == 1).then(|| ranked[middle].1);
            return Ok(one.into_iter().collect());
        }
        let places = |n: u64| usize::try_from(n).unwrap_or(usize::MAX).max(1);
        // The second biggest comes after all that are equally the biggest.
        for _ in 1..places(rank) {
            let Some(&(first, _)) = ranked.first() else { break };
            ranked.retain(|(m, _)| *m > first + 1e-6);
        }
        let Some(limit) = ranked.get(places(count).min(ranked.len()).saturating_sub(1)) else {
            return Ok(Vec::new());
        };
        let limit = limit.0;
        // Equal ones are all the biggest.
        Ok(ranked.into_iter().take_while(|(m, _)| *m <= limit + 1e-6).map(|(_, t)| t).collect())
    }

    /// Rooms and places with how far it is to drive to each from another thing, of those to which there is a way; who asks
    /// from within a room does not ask of that.
    fn ways_to(&self, found: &mut Vec<Thing>, from: Thing) -> Vec<(f64, Thing)> {
        let own = self.opening(from).is_none().then(|| self.area_of(from)).flatten();
        found.retain(|t| *t != from && (t.area().is_none() || t.area() != own));
        found.iter().filter_map(|t| Some((self.driven(from, *t)?, *t))).collect()
    }

    /// Of some things those in the room of another, where there are so many: what is behind a wall is not near.
    pub(super) fn this_side(&self, found: Vec<Thing>, anchor: Thing, count: u64) -> Vec<Thing> {
        let Some(room) = anchor.replica().and_then(|_| self.area_of(anchor)) else { return found };
        let here = |t: &&Thing| **t != anchor && self.area_of(**t) == Some(room);
        let near: Vec<Thing> = found.iter().filter(here).copied().collect();
        if near.len() as u64 >= count.max(1) { near } else { found }
    }

    /// The things nearest to another, so many and those equally near. Distances between surfaces are measured only as
    /// long as the middles of things are not too far apart for any nearer one.
    fn nearest(&self, found: Vec<Thing>, anchor: Thing, count: u64) -> Vec<Thing> {
        let reach = |t: Thing| {
            let extent = t.replica().and_then(|id| self.relations.extent(id));
            extent.map(|e| e.width.hypot(e.depth))
        };
        let middle = self.point(anchor).zip(reach(anchor));
        let at_least = |t: Thing| match (middle, self.point(t), reach(t)) {
            (Some(((map, at), own)), Some((other, p)), Some(reach)) if map == other => {
                (p - at).norm() - own - reach
            }
            _ => 0.0,
        };
        let mut bounded: Vec<(f64, Thing)> =
            found.into_iter().filter(|t| *t != anchor).map(|t| (at_least(t), t)).collect();
        bounded.order_by(|a, b| a.0.total_cmp(&b.0));
        let wanted = usize::try_from(count).unwrap_or(usize::MAX).max(1);
        let mut measured: Vec<(f64, Thing)> = Vec::new();
        for (least, thing) in bounded {
            if measured.get(wanted - 1).is_some_and(|(worst, _)| least > worst + 1e-6) {
                break;
            }
            let Some(distance) = self.distance(thing, anchor) else { continue };
            let at = measured.partition_point(|(d, t)| (*d, *t) < (distance, thing));
            measured.insert(at, (distance, thing));
        }
        let limit = measured.get(wanted.min(measured.len()).saturating_sub(1)).map(|(d, _)| *d);
        let near = measured.into_iter().take_while(|(d, _)| limit.is_some_and(|l| *d <= l + 1e-6));
        near.map(|(_, thing)| thing).collect()
    }

    /// Things in the order in which the robot sees them, from the left or from the right.
    pub(in crate::question) fn outermost(
        &self,
        found: &[Thing],
        extreme: Extreme,
    ) -> Vec<(f64, Thing)> {
        let Some((map, pose)) = self.senses.robot() else { return Vec::new() };
        let placed: Vec<(Vector, Thing)> = found
            .iter()
            .filter_map(|t| {
                self.point(*t).filter(|(m, _)| *m == map).map(|(_, p)| (p - pose.at, *t))
            })
            .collect();
        let middle: Vector = placed.iter().filter_map(|(v, _)| v.try_normalize(1e-6)).sum();
        let sign = if extreme == Extreme::LeftMost { -1.0 } else { 1.0 };
        placed.iter().map(|(v, t)| (sign * middle.perp(v).atan2(middle.dot(v)), *t)).collect()
    }
}

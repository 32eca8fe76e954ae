//! Two things against each other: how far apart, which over, under or within which, and from what side seen.

use std::collections::BTreeMap;

use crate::geometry::Bounds;
use crate::geometry::contact::{
    Footprint, Gap, bounds_distance, escape, facing_overlap, gap, overlap_area,
};
use crate::units::{AreaId, ReplicaId};

use super::super::body::{Block, Body, Kind};
use super::{Measurements, cm, hundredths, per_mille, tenths};

/// `a` stands or hangs over the roof of a block of `b`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Over {
    pub block: usize,
    pub solid: bool,
    /// Foot less roof.
    pub gap: i64,
    /// Share of `a`'s foot that is over the roof.
    pub share: i64,
    /// Whether `a`'s centre is over the roof.
    pub centred: bool,
    /// Foot less the block's middle height.
    pub lift: i64,
}

/// `a` is below the base of a block of `b`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Below {
    pub block: usize,
    pub solid: bool,
    /// Base less the highest roof of `a` beneath it.
    pub gap: i64,
    /// Share of `a`'s outline that is beneath the block.
    pub share: i64,
}

/// Through what a thing got into another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Into {
    /// The type of the Object says that it holds things.
    Container,
    /// Some face of the block is permeable or a door.
    Hollow,
    /// The block's roof is permeable.
    OpenTop,
}

/// `a` lies within `b`, or nearly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Within {
    /// None for the whole of a container.
    pub block: Option<usize>,
    pub opening: Into,
    /// How far `a` sticks out sideways.
    pub escape: i64,
    /// How far `a` reaches below the bottom; negative above it.
    pub beneath: i64,
    /// How far `a` reaches above the top; negative below it.
    pub above: i64,
    /// Volume of `a` over that of what holds it.
    pub bulk: i64,
    /// Share of `a`'s own volume that is inside.
    pub held: i64,
}

/// What is measured of one thing against another: (upper, lower), (inner, outer), (seen, anchor).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Directed {
    pub over: Vec<Over>,
    pub below: Vec<Below>,
    pub within: Vec<Within>,
    /// Hundredths of a degree from the front of the other, counter-clockwise positive.
    pub bearing: Option<i64>,
    /// From the middle of this thing to the hull of the other, from its bottom to its top.
    pub apart: Option<i64>,
    /// Of what is over the other: from that one's middle, in the plan.
    pub middle: Option<i64>,
}

/// What stands between two things that are beside each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Between {
    Replica(ReplicaId),
    /// A wall of this Area.
    Wall(AreaId),
}

/// Two things beside each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Beside {
    /// Overlap of the sides that they turn to each other, share of the shorter.
    pub facing: i64,
    /// What stands between, and the share of the common height that it fills.
    pub between: BTreeMap<Between, i64>,
}

/// All that is measured of a pair of things, the lower id first.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// Between surfaces, in space.
    pub distance: i64,
    /// Common height, share of the lower thing's.
    pub level: i64,
    pub beside: Option<Box<Beside>>,
    /// The first seen from the second.
    pub first: Directed,
    /// The second seen from the first.
    pub second: Directed,
    /// Where the surfaces are nearest in the plan; what stands between is looked for there.
    pub(super) way: Gap,
}

impl Measurements {
    pub(super) fn pair(&self, a: &Body, b: &Body) -> Option<Pair> {
        let sideways = bounds_distance(&a.bounds, &b.bounds);
        let upright = (a.bottom - b.top).max(b.bottom - a.top);
        let crossing = sideways <= 0.0;
        let level = level(a, b);
        let faces = a.front.is_some() || b.front.is_some();
        let in_sector = |d: f64| {
            d <= cm(self.reach.sector)
                && faces
                && level.is_some()
                && self.singles[&a.id].area() == self.singles[&b.id].area()
        };
        let least = sideways.hypot(upright.max(0.0));
        let reach = cm(self.reach.distance.max(self.reach.apart));
        if !(crossing || least <= reach || in_sector(least)) {
            return None;
        }
        let (distance, way) = surface_distance(a, b);
        let mut pair = Pair {
            distance: tenths(distance),
            level: level.unwrap_or(0),
            beside: None,
            first: Directed::default(),
            second: Directed::default(),
            way,
        };
        if crossing {
            pair.first = self.contacts(a, b);
            pair.second = self.contacts(b, a);
        }
        if in_sector(distance) {
            let bearing =
                |seen: &Body, anchor: &Body| anchor.bearing_of(seen.centre).map(hundredths);
            pair.first.bearing = bearing(a, b);
            pair.second.bearing = bearing(b, a);
        }
        if self.reach.apart > 0 {
            let near = |d: &i64| *d <= self.reach.apart;
            pair.first.apart = Some(tenths(apart(a, b))).filter(near);
            pair.second.apart = Some(tenths(apart(b, a))).filter(near);
        }
        if level.is_some() && pair.distance <= self.reach.beside {
            pair.beside = Some(Box::new(Beside {
                facing: per_mille(facing_overlap(&a.hull, &b.hull)),
                between: BTreeMap::new(),
            }));
        }
        let says_something = pair.distance <= self.reach.distance
            || pair.first != Directed::default()
            || pair.second != Directed::default();
        says_something.then_some(pair)
    }

    fn contacts(&self, a: &Body, b: &Body) -> Directed {
        let mut found = Directed::default();
        let (kind_a, kind_b) = (&self.kinds[&a.object], &self.kinds[&b.object]);
        let sink = cm(self.reach.sink);
        let later = rests_later(a, kind_a, b, kind_b);
        for (index, block) in b.blocks.iter().enumerate() {
            if later && a.bottom - block.top >= -sink {
                found.over.extend(over(a, kind_a, index, block));
            }
            if block.bottom - a.bottom >= -sink {
                found
                    .below
                    .extend(below(a, kind_a, index, block).filter(|u| u.gap >= -self.reach.sink));
            }
            if block.hollow {
                let hold = std::slice::from_ref(block.widest());
                let opening = if block.open_top { Into::OpenTop } else { Into::Hollow };
                let volume = block.widest().area * (block.top - block.bottom);
                let within = self.within(a, kind_a, hold, (block.bottom, block.top), volume);
                found.within.extend(within.map(|w| Within { block: Some(index), opening, ..w }));
            }
        }
        if kind_b.container {
            let within = self.within(a, kind_a, &b.outline, (b.bottom, b.top), kind_b.volume);
            found.within.extend(within);
        }
        if !found.over.is_empty() {
            let away = a.outline.iter().map(|f| f.distance_to(b.centre)).reduce(f64::min);
            let narrow = kind_b.size.0.min(kind_b.size.1);
            found.middle = away.filter(|away| *away <= narrow / 2.0).map(tenths);
        }
        found
    }

    fn within(
        &self,
        a: &Body,
        kind: &Kind,
        hold: &[Footprint],
        (bottom, top): (f64, f64),
        volume: f64,
    ) -> Option<Within> {
        let reach = cm(self.reach.escape);
        let bounds = hold.iter().fold(Bounds::EMPTY, |b, f| b.union(&f.bounds)).grown(reach);
        let fits = bounds.contains(a.bounds.min) && bounds.contains(a.bounds.max);
        if !fits || bottom - a.bottom > reach || a.bottom > top {
            return None;
        }
        let held_by: Vec<&Footprint> = hold.iter().collect();
        let sticks_out = a.outline.iter().map(|f| escape(f, &held_by)).fold(0.0, f64::max);
        let height = a.top - a.bottom;
        let upright = if height > 0.0 {
            (a.top.min(top) - a.bottom.max(bottom)).max(0.0) / height
        } else {
            // What lies flat on the top is on it.
            f64::from(u8::from(bottom <= a.bottom && a.bottom < top))
        };
        let flat = a.outline.iter().flat_map(|f| hold.iter().map(move |h| overlap_area(f, h)));
        let held = upright * (flat.sum::<f64>() / kind.outline_area).min(1.0);
        (sticks_out <= reach).then(|| Within {
            block: None,
            opening: Into::Container,
            escape: tenths(sticks_out),
            beneath: tenths(bottom - a.bottom),
            above: tenths(a.top - top),
            // Rounded down, so that less than the whole is less than 1000.
            bulk: if volume > 0.0 { (kind.volume / volume * 1000.0) as i64 } else { 1000 },
            held: per_mille(held),
        })
    }
}

/// Whether `a` can rest on `b`: it starts higher, or level with it has the smaller base. This order keeps support acyclic.
fn rests_later(a: &Body, kind_a: &Kind, b: &Body, kind_b: &Kind) -> bool {
    let levels = a.bottom.total_cmp(&b.bottom);
    let bases = kind_b.outline_area.total_cmp(&kind_a.outline_area);
    levels.then(bases).then(a.id.cmp(&b.id)).is_gt()
}

fn over(a: &Body, kind: &Kind, index: usize, block: &Block) -> Option<Over> {
    let roof = block.roof();
    let common: f64 = kind.foot.iter().map(|&i| overlap_area(&a.blocks[i].base, roof)).sum();
    let share = per_mille((common / kind.foot_area).min(1.0));
    let centred = roof.contains(a.centre);
    (share > 0 || centred).then(|| Over {
        block: index,
        solid: block.solid_roof,
        gap: tenths(a.bottom - block.top),
        share,
        centred,
        lift: tenths(a.bottom - f64::midpoint(block.bottom, block.top)),
    })
}

fn below(a: &Body, kind: &Kind, index: usize, block: &Block) -> Option<Below> {
    let beneath = |part: &&Block| overlap_area(part.widest(), &block.base) > 0.5;
    let highest = a.blocks.iter().filter(beneath).map(|part| part.top).reduce(f64::max)?;
    let common: f64 = a.outline.iter().map(|f| overlap_area(f, &block.base)).sum();
    let share = per_mille((common / kind.outline_area).min(1.0));
    (share > 0).then(|| Below {
        block: index,
        solid: block.solid_base,
        gap: tenths(block.bottom - highest),
        share,
    })
}

/// Common height of two things as a share of the lower one; none when one ends where the other begins.
pub(crate) fn level(a: &Body, b: &Body) -> Option<i64> {
    let common = a.top.min(b.top) - a.bottom.max(b.bottom);
    let lower = (a.top - a.bottom).min(b.top - b.bottom);
    if lower <= 0.0 {
        // A flat thing is on a level with what it cuts.
        return (common >= 0.0 && (a.top - a.bottom).max(b.top - b.bottom) > 0.0).then_some(1000);
    }
    (common > 0.0).then(|| per_mille(common / lower))
}

/// Shortest distance in space, and the way in the plan between the two nearest Orthoframes.
pub(crate) fn surface_distance(a: &Body, b: &Body) -> (f64, Gap) {
    let mut best: Option<(f64, Gap)> = None;
    for p in &a.blocks {
        for q in &b.blocks {
            let upright = (p.bottom - q.top).max(q.bottom - p.top).max(0.0);
            let (f, g) = (p.widest(), q.widest());
            let least = bounds_distance(&f.bounds, &g.bounds).hypot(upright);
            if best.is_some_and(|(d, _)| least >= d - 1e-9) {
                continue;
            }
            let way = gap(f, g);
            let distance = way.distance.hypot(upright);
            if best.is_none_or(|(d, _)| distance < d) {
                best = Some((distance, way));
            }
        }
    }
    best.expect("a body has at least one Orthoframe")
}

/// From the middle of `a` to the box round `b`: its hull, from its bottom to its top.
fn apart(a: &Body, b: &Body) -> f64 {
    let middle = f64::midpoint(a.bottom, a.top);
    let upright = (b.bottom - middle).max(middle - b.top).max(0.0);
    b.hull.distance_to(a.centre).hypot(upright)
}

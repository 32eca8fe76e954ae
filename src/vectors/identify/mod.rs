//! Knowing a thing again from another side (SPEC V19-V21; paper 3, section 4).
//!
//! The observation's invariants lead to candidates, a candidate to a motion, and under the motion the whole view is
//! held against the whole stored model. The paper compares every pair of the view with every pair of the tree; here a
//! hash of invariants (`link`) names the candidates. A few links suffice, and nothing is missed by it: where at most
//! e segments of a view may be foreign to a thing, of e + 1 links that share no segment one is the thing's own.
//!
//! # Invariants
//!
//! What is answered was verified against the full model (`verify`); the hash decides only what is looked at. The
//! answers are those of [`exhaustive`], which looks at everything.

mod answer;
mod exhaustive;
mod link;
mod seeds;
mod table;
mod verify;

use std::{borrow::Cow, collections::HashMap};

pub use answer::{Counters, Identification, Placement, Search, ThingId};
pub use exhaustive::exhaustive;
pub use link::Scale;
pub(crate) use seeds::Seeds;

use crate::{Equality, Euclid, Model, Segment, Space};
use link::{Key, Kind, Link, canonical, links};
use table::{Posting, Table};
use verify::{Correspondence, Hypothesis, Trial};

/// How views are identified.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    pub scale: Scale,
    /// How far along the contour links go: 1, the next segment; 2, three in a row; 3, over two hidden ones.
    pub reach: usize,
    /// Whether views with cut ends find things by links whose lengths they do not know: twice the memory.
    pub cut_ends: bool,
    /// Of V11, by which the segments of a view are equal to stored ones.
    pub confidence: f64,
    /// Share of a view's segments that a thing must explain; the others may be foreign.
    pub explained: f64,
    /// Probability from which on one placement among all that fit is the answer.
    pub certainty: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            scale: Scale::Known,
            reach: 3,
            cut_ends: true,
            confidence: 0.999,
            explained: 0.8,
            certainty: 0.99,
        }
    }
}

impl Options {
    /// How many segments of a view of `count` may be foreign.
    pub(crate) fn misses(&self, count: usize) -> usize {
        ((1.0 - self.explained.clamp(0.0, 1.0)) * count as f64 + 1e-9).floor() as usize
    }
}

/// Where the models are that an index names: stored ones, or ones made when asked for.
pub trait Library<const D: usize> {
    fn model(&self, thing: ThingId) -> Option<Cow<'_, Model<D>>>;
}

impl<const D: usize> Library<D> for [Model<D>] {
    fn model(&self, thing: ThingId) -> Option<Cow<'_, Model<D>>> {
        self.get(thing.0 as usize).map(Cow::Borrowed)
    }
}

/// Geometric hashing over the models of a library.
#[derive(Debug, Clone)]
pub struct Index<const D: usize> {
    options: Options,
    equality: Equality,
    table: Table,
    /// Things by slot; what was removed leaves its slot empty.
    slots: Vec<Option<ThingId>>,
    slot_of: HashMap<ThingId, u32>,
    /// All ends of all models are true.
    whole: bool,
    /// The greatest deviation of a stored coordinate, in cm.
    deviation: f64,
}

impl<const D: usize> Index<D>
where
    Euclid<D>: Space<D>,
{
    #[must_use]
    pub fn new(options: Options) -> Self {
        let equality = Equality::at(options.confidence);
        Self {
            options,
            equality,
            table: Table::default(),
            slots: Vec::new(),
            slot_of: HashMap::new(),
            whole: true,
            deviation: 0.0,
        }
    }

    /// The index of a whole library, things numbered as they come.
    #[must_use]
    pub fn of(models: &[Model<D>], options: Options) -> Self {
        let mut index = Self::new(options);
        for (k, model) in models.iter().enumerate() {
            index.add(ThingId(k as u32), model, Table::append);
        }
        index.merge();
        index
    }

    #[must_use]
    pub const fn options(&self) -> &Options {
        &self.options
    }

    /// Things in the index.
    #[must_use]
    pub fn len(&self) -> usize {
        self.slot_of.len()
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.slot_of.is_empty()
    }

    /// Links stored, of all kinds.
    #[must_use]
    pub fn links(&self) -> usize {
        self.table.len()
    }

    /// Room for so many links at once.
    pub fn reserve(&mut self, links: usize) {
        self.table.reserve(links);
    }

    /// Sorts what was added; asking works without, but slower.
    pub fn merge(&mut self) {
        self.table.merge();
    }

    /// Adds a thing, or replaces it.
    pub fn insert(&mut self, thing: ThingId, model: &Model<D>) {
        self.add(thing, model, Table::insert);
    }

    fn add(
        &mut self,
        thing: ThingId,
        model: &Model<D>,
        mut put: impl FnMut(&mut Table, &Key, u32, (u16, u16)),
    ) {
        self.remove(thing);
        let slot = self.slots.len() as u32;
        self.slots.push(Some(thing));
        self.slot_of.insert(thing, slot);
        self.whole &= model.is_whole();
        self.deviation = self.deviation.max(model.deviation());
        for link in links(model, self.options.reach) {
            // A posting counts segments in 16 bits; no one thing has as many.
            let (Ok(a), Ok(b)) = (u16::try_from(link.a), u16::try_from(link.b)) else { continue };
            for kind in self.kinds_stored(&link) {
                let (swap, _) = canonical(&link.shape, kind, 0.0, 0.0);
                let shape = if swap { link.shape.swapped() } else { link.shape };
                let key = Key::of::<D>(&shape, kind, self.options.scale, 0.0, 0.0);
                put(&mut self.table, &key, slot, if swap { (b, a) } else { (a, b) });
            }
        }
    }

    /// Forgets a thing; its links stay behind, and lead nowhere.
    pub fn remove(&mut self, thing: ThingId) {
        if let Some(slot) = self.slot_of.remove(&thing) {
            self.slots[slot as usize] = None;
        }
    }

    fn kinds_stored(&self, link: &Link) -> impl Iterator<Item = Kind> + use<D> {
        let kinds = match (link.shape.corner, link.shape.is_whole()) {
            (true, true) => {
                [Some(Kind::Corner), self.options.cut_ends.then_some(Kind::WholeAsTurn)]
            }
            (true, false) => [Some(Kind::Turn), None],
            (false, true) => {
                [Some(Kind::Whole), self.options.cut_ends.then_some(Kind::WholeAsPart)]
            }
            (false, false) => [Some(Kind::Part), None],
        };
        kinds.into_iter().flatten()
    }

    /// Which thing a view shows, and from where (V19, V20).
    #[must_use]
    pub fn identify<L: Library<D> + ?Sized>(&self, library: &L, view: &Model<D>) -> Search<D> {
        let mut counters = Counters::default();
        let mut found: Vec<(ThingId, Hypothesis<D>)> = Vec::new();
        let (links, enough) = self.plan(view);
        for (_, link, keys) in links {
            for (key, swapped) in keys {
                let mut candidates: Vec<Posting> = Vec::new();
                self.table.find(&key, &mut counters, |posting| candidates.push(*posting));
                // As the view tells the link, by which the exact comparison goes.
                let told = if swapped { self.key(&link, key.kind) } else { key };
                for posting in candidates {
                    let Some(thing) = self.slots[posting.slot as usize] else { continue };
                    let Some(model) = library.model(thing) else { continue };
                    let (first, second) = (usize::from(posting.first), usize::from(posting.second));
                    let stored = if swapped { (second, first) } else { (first, second) };
                    if let Some(seeds) = fits(&link, &told, &model, stored, &self.options) {
                        self.consider(view, &model, thing, seeds, &mut found, &mut counters);
                    }
                }
            }
        }
        let answer = decide(found, view, &self.options, self.len());
        Search { answer, counters, complete: enough && self.whole }
    }

    /// The links to ask for: the cheapest that share no segment, not even one between, one more than segments may be
    /// foreign; all of them, where there are not as many.
    fn plan(&self, view: &Model<D>) -> (Vec<Priced>, bool) {
        let cost = |keys: &[(Key, bool)]| -> f64 {
            keys.iter()
                .map(|(key, _)| key.cells() + self.table.count(key.kind) as f64 * key.share())
                .sum()
        };
        let mut all: Vec<_> = link::links_of_view(view, self.options.reach)
            .map(|link| (link, self.keys(&link)))
            .map(|(link, keys)| (cost(&keys), link, keys))
            .collect();
        all.sort_by(|a: &(f64, Link, _), b| a.0.total_cmp(&b.0));
        let Some(chosen) = cheapest(view.len(), &all, self.options.misses(view.len()) + 1) else {
            return (all, false);
        };
        let kept =
            all.into_iter().enumerate().filter(|(k, _)| chosen.contains(k)).map(|(_, link)| link);
        (kept.collect(), true)
    }

    /// The keys under which a link of a view may be stored, and whether each tells it from `b`.
    fn keys(&self, link: &Link) -> Vec<(Key, bool)> {
        let kinds: &[Kind] = match (link.shape.corner, link.shape.is_whole()) {
            (true, true) => &[Kind::Corner, Kind::Turn],
            (true, false) => &[Kind::WholeAsTurn, Kind::Turn],
            (false, true) => &[Kind::Whole, Kind::Part],
            (false, false) => &[Kind::WholeAsPart, Kind::Part],
        };
        // Of a normal error, so much is not exceeded with the confidence of V11, two coordinates together.
        let radius = self.equality.radius(2);
        let mut keys = Vec::with_capacity(4);
        for &kind in kinds.iter().filter(|&&kind| self.table.count(kind) > 0) {
            let (swap, either) = canonical(&link.shape, kind, radius, self.deviation);
            for swapped in [false, true] {
                if either || swapped == swap {
                    let shape = if swapped { link.shape.swapped() } else { link.shape };
                    keys.push((
                        Key::of::<D>(&shape, kind, self.options.scale, radius, self.deviation),
                        swapped,
                    ));
                }
            }
        }
        keys
    }

    fn key(&self, link: &Link, kind: Kind) -> Key {
        Key::of::<D>(&link.shape, kind, self.options.scale, self.equality.radius(2), self.deviation)
    }

    /// Verifies a candidate, unless it is one of the placements found.
    fn consider(
        &self,
        view: &Model<D>,
        model: &Model<D>,
        thing: ThingId,
        seeds: [Correspondence; 2],
        found: &mut Vec<(ThingId, Hypothesis<D>)>,
        counters: &mut Counters,
    ) {
        if found.iter().any(|(of, h)| *of == thing && seeds.iter().all(|s| h.pairs.contains(s))) {
            return;
        }
        let misses = self.options.misses(view.len());
        let trial =
            Trial { view, model, equality: &self.equality, scale: self.options.scale, misses };
        if let Some(hypothesis) =
            trial.seed(seeds).and_then(|motion| trial.verify(motion, seeds, counters))
        {
            found.push((thing, hypothesis));
        }
    }
}

/// A link with what it costs to ask for its keys.
type Priced = (f64, Link, Vec<(Key, bool)>);

/// Which `wanted` certain links of a view share no segment and cost least together; `None` where there are not as many.
fn cheapest(segments: usize, links: &[Priced], wanted: usize) -> Option<Vec<usize>> {
    // best[c][k]: least cost of c links among the first k segments, and the link that ends there, if one does.
    let mut best = vec![vec![(f64::INFINITY, None); segments + 1]; wanted + 1];
    best[0].fill((0.0, None));
    for k in 1..=segments {
        for row in &mut best[1..] {
            row[k] = (row[k - 1].0, None);
        }
        for (l, (cost, link, _)) in links.iter().enumerate() {
            if link.certain && link.b + 1 == k && link.a < link.b {
                for c in 1..=wanted {
                    let with = best[c - 1][link.a].0 + cost;
                    if with < best[c][k].0 {
                        best[c][k] = (with, Some(l));
                    }
                }
            }
        }
    }
    let (mut c, mut k) = (wanted, segments);
    best[c][k].0.is_finite().then_some(())?;
    let mut chosen = Vec::with_capacity(wanted);
    while c > 0 {
        match best[c][k].1 {
            Some(l) => {
                chosen.push(l);
                (c, k) = (c - 1, links[l].1.a);
            }
            None => k -= 1,
        }
    }
    Some(chosen)
}

/// The correspondences of a link with segments `p`, `q` of a stored model, if all invariants agree.
fn fits<const D: usize>(
    link: &Link,
    told: &Key,
    model: &Model<D>,
    (p, q): (usize, usize),
    options: &Options,
) -> Option<[Correspondence; 2]>
where
    Euclid<D>: Space<D>,
{
    let Options { scale, reach, .. } = *options;
    let backward = link::runs_backward(model, p, q, reach);
    let shape = if backward {
        link::shape(model, q, p, link.shape.corner)?.swapped()
    } else {
        link::shape(model, p, q, link.shape.corner)?
    };
    let stored = Key::of::<D>(&shape, told.kind, scale, 0.0, 0.0);
    told.admits(&stored).then_some([(link.a, p, backward), (link.b, q, backward)])
}

/// The answer that placements give (V20).
///
/// Each is weighed by its evidence against the others and against a thing that is not stored, every thing as likely
/// beforehand. One is the answer when it has the certainty asked for, at least three lines that are not one line, and
/// a place: two walls fit every corner.
pub(crate) fn decide<const D: usize>(
    found: Vec<(ThingId, Hypothesis<D>)>,
    view: &Model<D>,
    options: &Options,
    things: usize,
) -> Identification<D>
where
    Euclid<D>: Space<D>,
{
    let mut found = found;
    found.sort_by(|a, b| {
        b.1.evidence.total_cmp(&a.1.evidence).then(a.0.cmp(&b.0)).then(a.1.pairs.cmp(&b.1.pairs))
    });
    let mut kept: Vec<(ThingId, Hypothesis<D>)> = Vec::with_capacity(found.len());
    for (thing, hypothesis) in found {
        if !kept.iter().any(|(of, h)| *of == thing && same_place(&h.pairs, &hypothesis.pairs)) {
            kept.push((thing, hypothesis));
        }
    }
    let found = kept;
    let Some(best) = found.first().map(|h| h.1.evidence) else { return Identification::Unknown };
    let unknown = (things.max(1) as f64).ln();
    let most = best.max(unknown);
    let total: f64 =
        found.iter().map(|h| (h.1.evidence - most).exp()).sum::<f64>() + (unknown - most).exp();
    let mut placements: Vec<Placement<D>> = found
        .into_iter()
        .map(|(thing, h)| Placement {
            thing,
            explained: h.pairs.len() as f64 / view.len().max(1) as f64,
            probability: (h.evidence - most).exp() / total,
            motion: h.motion,
            pairs: h.pairs,
            information: h.information,
            evidence: h.evidence,
        })
        .collect();
    let first = &placements[0];
    if first.probability >= options.certainty && lines(view, first) >= 3 {
        return Identification::Unique(placements.swap_remove(0));
    }
    Identification::Ambiguous(placements)
}

/// Whether two placements on one thing are one: most of either lies on the same segments; the rest was a close call.
pub(crate) fn same_place(a: &[Correspondence], b: &[Correspondence]) -> bool {
    let shared = a.iter().filter(|pair| b.contains(pair)).count();
    2 * shared > a.len().max(b.len())
}

/// How many different lines the explained segments of a view lie on.
fn lines<const D: usize>(view: &Model<D>, placement: &Placement<D>) -> usize {
    // The longest first: whatever is somewhere near lies on the line of a short one, for all that is known of it.
    let mut told: Vec<&Segment<D>> =
        placement.pairs.iter().map(|&(k, ..)| &view.segments()[k]).collect();
    told.sort_by(|a, b| b.length().total_cmp(&a.length()));
    let mut found: Vec<&Segment<D>> = Vec::new();
    for segment in told {
        let on = |line: &&Segment<D>| {
            let Some(u) = line.vector().try_normalize(1e-9) else { return false };
            let slack = 4.0 * segment.covariance.deviation().hypot(line.covariance.deviation());
            [segment.start, segment.end].iter().all(|p| {
                let from = p - line.start;
                let along = from.dot(&u);
                // Further out the line is known less well.
                let reach =
                    1.0 + along.abs().max((along - line.length()).abs()) / line.length().max(1e-9);
                (from - u * along).norm() <= slack * reach
            })
        };
        if !found.iter().any(on) {
            found.push(segment);
        }
    }
    found.len()
}

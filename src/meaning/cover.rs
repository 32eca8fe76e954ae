//! Frames over a sentence: the cheapest ways to cover all its words by the parts of one frame.
//!
//! A cover has no gaps: each word stands in a part of the frame, or is one that the language lists as passed over. In a
//! language of free order a frame is a bag of parts, and an unusual order has its price. Where it is only offered what may
//! have been meant, other words are left out as well ([`Left`]), each at its price.

use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

use super::chart::Chart;
use super::features::Features;
use super::file::Repeat;
use super::grammar::{Frame, Slot, Tongue};
use super::sense::{Bound, Sense, Signatures};
use super::term::Form;
use super::words::Edge;
use crate::units::InOrder as _;

/// Covers that are kept at each state.
const KEPT: usize = 4;
/// What a form costs at most.
const DEAREST: u32 = 6;
/// Parts of a frame, as many as a mask has bits.
const MOST_PARTS: usize = 32;

/// A form with its price and the line that read it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Found {
    pub(crate) form: Form,
    pub(crate) cost: u32,
    pub(crate) place: String,
    /// The words that stand in parts of the frame, first to last.
    pub(crate) used: Vec<usize>,
}

/// What it costs to leave out words of a sentence; none for what may not be.
pub(crate) struct Left {
    /// All words before one.
    pub(crate) before: Vec<Option<u32>>,
    /// A word within what asks.
    pub(crate) within: Vec<Option<u32>>,
    /// All words from one on.
    pub(crate) behind: Vec<Option<u32>>,
    /// What a cover costs at most.
    pub(crate) dearest: u32,
}

/// What has been filled so far, the last part first: the part, its words, and what they mean where they are no words of
/// the frame's own.
enum Filled<'c> {
    Nothing,
    Part(usize, Range<usize>, Option<&'c Edge>, Rc<Self>),
}

struct Cover<'c> {
    cost: u32,
    /// The part that was filled last.
    last: usize,
    is_unordered: bool,
    filled: Rc<Filled<'c>>,
}

impl Clone for Cover<'_> {
    fn clone(&self) -> Self {
        Self { filled: Rc::clone(&self.filled), ..*self }
    }
}

/// The readings of a sentence, the cheapest first, each form once.
pub(crate) fn readings(chart: &Chart<'_>, tongue: &Tongue, roles: &Signatures) -> Vec<Found> {
    let end = chart.tokens.len();
    let only = |place: usize| (0..=end).map(|at| (at == place).then_some(0)).collect();
    let (before, within, behind) = (only(0), vec![None; end], only(end));
    readings_without(chart, tongue, roles, &Left { before, within, behind, dearest: DEAREST })
}

/// The readings of what is left of a sentence where words are left out, the cheapest first, each form once.
pub(crate) fn readings_without(
    chart: &Chart<'_>,
    tongue: &Tongue,
    roles: &Signatures,
    left: &Left,
) -> Vec<Found> {
    let mut found: Vec<Found> = Vec::new();
    for frame in &tongue.frames {
        if frame.parts.len() <= MOST_PARTS && may_begin(chart, frame) {
            covers(chart, tongue, frame, roles, left, &mut found);
        }
    }
    found.order_by_key(|one| one.cost);
    let mut distinct: Vec<Found> = Vec::new();
    for one in found {
        if distinct.iter().all(|other| other.form != one.form) {
            distinct.push(one);
        }
    }
    distinct
}

/// Whether everything that a frame needs is somewhere in the sentence.
fn may_begin(chart: &Chart<'_>, frame: &Frame) -> bool {
    let needs = frame.parts.iter().filter(|(_, r)| matches!(r, Repeat::Once | Repeat::Some));
    needs.into_iter().all(|(slot, _)| match slot {
        Slot::Words(runs) => {
            (0..chart.tokens.len()).any(|from| chart.ends_of(runs, from).next().is_some())
        }
        Slot::Part { category, .. } => chart.has(*category),
    })
}

fn covers<'c>(
    chart: &'c Chart<'_>,
    tongue: &Tongue,
    frame: &Frame,
    roles: &Signatures,
    left: &Left,
    found: &mut Vec<Found>,
) {
    let end = chart.tokens.len();
    let needed: u32 = (frame.parts.iter().enumerate())
        .filter(|(_, (_, repeat))| matches!(repeat, Repeat::Once | Repeat::Some))
        .fold(0, |mask, (n, _)| mask | 1 << n);
    let mut states: Vec<BTreeMap<u32, Vec<Cover<'c>>>> = vec![BTreeMap::new(); end + 1];
    for at in 0..=end {
        if let Some(before) = left.before[at] {
            let (cost, filled) = (frame.cost + before, Rc::new(Filled::Nothing));
            let start = Cover { cost, last: 0, is_unordered: false, filled };
            put(&mut states[at], 0, start, left.dearest);
        }
        for (mask, covers) in std::mem::take(&mut states[at]) {
            for cover in covers {
                if let (true, Some(tail)) = (mask & needed == needed, left.behind[at]) {
                    let cost = cover.cost + tail;
                    if cost <= left.dearest
                        && let Some((form, used)) = form_of(frame, &cover, roles)
                    {
                        found.push(Found { form, cost, place: frame.place.clone(), used });
                    }
                }
                if at == end {
                    continue;
                }
                let is_begun = matches!(*cover.filled, Filled::Part(..));
                let dropped = left.within[at].filter(|_| is_begun).map(|cost| (at + 1, cost));
                for (to, cost) in skipped(chart, tongue, at).into_iter().chain(dropped) {
                    let cover = Cover { cost: cover.cost + cost, ..cover.clone() };
                    put(&mut states[to], mask, cover, left.dearest);
                }
                for (n, (slot, repeat)) in frame.parts.iter().enumerate() {
                    let is_filled = mask & 1 << n != 0;
                    let repeats = matches!(repeat, Repeat::Any | Repeat::Some);
                    let is_back = n < cover.last;
                    if (is_filled && !repeats) || (is_back && !tongue.free) {
                        continue;
                    }
                    let mut step = |to: usize, cost: u32, edge: Option<&'c Edge>| {
                        let disorder = u32::from(is_back && !cover.is_unordered);
                        let filled = Filled::Part(n, at..to, edge, Rc::clone(&cover.filled));
                        let filled = Rc::new(filled);
                        let next = Cover {
                            cost: cover.cost + cost + disorder,
                            last: n,
                            is_unordered: cover.is_unordered || is_back,
                            filled,
                        };
                        put(&mut states[to], mask | 1 << n, next, left.dearest);
                    };
                    match slot {
                        Slot::Words(runs) => {
                            chart.ends_of(runs, at).for_each(|to| step(to, 0, None));
                        }
                        Slot::Part { category, features, .. } => {
                            let fits = |e: &&Edge| !(e.features & *features).is_empty();
                            for edge in chart.at(at, *category).filter(fits) {
                                step(edge.to, edge.cost, Some(edge));
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Where one stands after words that may be passed over, and for how much. Commas between the parts say nothing.
fn skipped(chart: &Chart<'_>, tongue: &Tongue, at: usize) -> Vec<(usize, u32)> {
    let token = &chart.tokens[at];
    let mark = (token.key == ",").then_some((at + 1, 0));
    let runs = tongue.skipped.get(&token.key).into_iter().flatten();
    let fits = |(run, cost): &(Vec<String>, u32)| {
        let said = chart.tokens.get(at..at + run.len())?;
        said.iter().map(|t| &t.key).eq(run.iter()).then_some((at + run.len(), *cost))
    };
    mark.into_iter().chain(runs.filter_map(fits)).collect()
}

fn put<'c>(state: &mut BTreeMap<u32, Vec<Cover<'c>>>, mask: u32, cover: Cover<'c>, dearest: u32) {
    if cover.cost > dearest {
        return;
    }
    let kept = state.entry(mask).or_default();
    let at = kept.partition_point(|other| other.cost <= cover.cost);
    if at < KEPT {
        kept.insert(at, cover);
        kept.truncate(KEPT);
    }
}

/// What a cover means, and the words that it is of.
fn form_of(frame: &Frame, cover: &Cover<'_>, roles: &Signatures) -> Option<(Form, Vec<usize>)> {
    let mut bound: Vec<Option<Bound>> = vec![None; frame.variables];
    let mut used = Vec::new();
    let mut next = &*cover.filled;
    while let Filled::Part(n, words, edge, before) = next {
        next = before;
        used.extend(words.clone().rev());
        let (Slot::Part { variable: Some(variable), features, .. }, Some(edge)) =
            (&frame.parts[*n].0, edge)
        else {
            continue;
        };
        let own = Bound { sense: edge.sense.clone(), features: edge.features & *features };
        let place = &mut bound[usize::from(*variable)];
        // Of a part that repeats all is said together.
        *place = Some(match (place.take(), own) {
            (None, own) => own,
            (
                Some(Bound { sense: Sense::Mods(later), .. }),
                Bound { sense: Sense::Mods(own), .. },
            ) => {
                let sense = Sense::Mods(own.into_iter().chain(later).collect());
                Bound { sense, features: Features::ALL }
            }
            _ => return None,
        });
    }
    used.reverse();
    Some((frame.meaning.value(&bound, roles)?.form()?, used))
}

//! Names that are like a text, for what was mistyped.
//!
//! Invariant: the likest first; what is less than half alike is not offered.

use super::FormIndex;
use super::spelled::Spelled;
use crate::units::InOrder as _;
use std::hash::Hash;

impl<T: Clone + Eq + Hash> FormIndex<T> {
    /// Names like `text`, the nearest first: a slip of the pen in any form, or a name that holds all its words.
    #[must_use]
    pub fn near(&self, text: &str, limit: usize) -> Vec<&str> {
        let wanted = Letters::of(Spelled::of(text).key);
        let mut best: Vec<(f64, u32)> = Vec::new();
        if wanted.length == 0 || wanted.length > 4 * self.longest_key.max(8) || limit == 0 {
            return Vec::new();
        }
        // With very many names only those are compared whose stem is like the beginning of the text.
        let many = self.names.len() > MANY_NAMES;
        let mut joined = String::new();
        for (key, postings) in &self.forms {
            let stem_is_like = || {
                let head: String = wanted.key.chars().take(key.chars().count() + 1).collect();
                Letters::of(head).likeness(key, 0.7).is_some()
            };
            if many && !stem_is_like() {
                continue;
            }
            for posting in postings {
                let stem = &self.stems[posting.stem as usize];
                if posting.part {
                    let needed = if best.len() == limit { best[limit - 1].0 } else { 0.6 };
                    let Some(likeness) = wanted.likeness(key, needed) else { continue };
                    for &name in stem.all.iter().take(limit) {
                        self.keep(&mut best, limit, likeness, name);
                    }
                    continue;
                }
                for (tag, members) in &stem.members {
                    let needed = if best.len() == limit { best[limit - 1].0 } else { 0.6 };
                    joined.clear();
                    joined.push_str(key);
                    if !tag.is_empty() {
                        joined.push(' ');
                        joined.push_str(tag);
                    }
                    let Some(likeness) = wanted.likeness(&joined, needed) else { continue };
                    for &name in members {
                        self.keep(&mut best, limit, likeness, name);
                    }
                }
            }
        }
        best.into_iter().map(|(_, name)| self.shown(name)).collect()
    }

    /// The one word of a name's forms that a mistyped word is a single slip away from: a letter too many, one missing, one
    /// for another, two exchanged. None where several words of different names are.
    #[must_use]
    pub fn respelt(&self, word: &str) -> Option<String> {
        let wanted = Letters::of(Spelled::of(word).key);
        // By the key, with the form as it is written and whose it is.
        let mut found: Vec<(&str, &str, u32)> = Vec::new();
        for (key, postings) in &self.forms {
            for (n, part) in key.split(' ').enumerate() {
                let (counts, length) = Letters::count(part);
                let apart: u32 =
                    wanted.counts.iter().zip(&counts).map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
                if apart > 2 || length.abs_diff(wanted.length) > 1 {
                    continue;
                }
                if strsim::damerau_levenshtein(&wanted.key, part) != 1 {
                    continue;
                }
                let written = postings.iter().filter_map(|posting| {
                    let form = posting.form.split(' ').nth(n)?;
                    Some((part, form, posting.stem))
                });
                found.extend(written);
            }
        }
        // Of the forms of one word that which begins and ends as was written.
        let alike = |key: &str| {
            let ends = key.chars().last() == wanted.key.chars().last();
            (ends, key.chars().next() == wanted.key.chars().next())
        };
        found.order_by(|a, b| {
            let likest = alike(b.0).cmp(&alike(a.0)).then(a.0.cmp(b.0));
            let plainest = a.1.len().cmp(&b.1.len()).then(b.1.cmp(a.1));
            likest.then(plainest).then(a.2.cmp(&b.2))
        });
        let (key, form, _) = *found.first()?;
        let own: Vec<u32> = found.iter().filter(|f| f.0 == key).map(|f| f.2).collect();
        found.iter().all(|f| f.0 == key || own.contains(&f.2)).then(|| form.to_owned())
    }

    /// Keeps the best names, each id once, in order; equal ones by the order of insertion.
    fn keep(&self, best: &mut Vec<(f64, u32)>, limit: usize, likeness: f64, name: u32) {
        let id = &self.names[name as usize].id;
        match best.iter().position(|(_, other)| self.names[*other as usize].id == *id) {
            Some(at) if best[at].0 >= likeness => return,
            Some(at) => drop(best.remove(at)),
            None => {}
        }
        best.push((likeness, name));
        best.order_by(|(a, x), (b, y)| b.total_cmp(a).then(x.cmp(y)));
        best.truncate(limit);
    }
}

/// From so many names on, near misses are sought among those of a like stem only.
const MANY_NAMES: usize = 5_000;

/// A key with its letters counted, so that most others are seen to be far without comparing.
pub(super) struct Letters {
    key: String,
    length: usize,
    counts: [u8; 64],
}

impl Letters {
    fn of(key: String) -> Self {
        let (counts, length) = Self::count(&key);
        Self { key, length, counts }
    }

    pub(super) fn count(key: &str) -> ([u8; 64], usize) {
        let mut counts = [0_u8; 64];
        let mut length = 0;
        for c in key.chars() {
            let slot = &mut counts[c as usize % 64];
            *slot = slot.saturating_add(1);
            length += 1;
        }
        (counts, length)
    }

    /// How alike two keys are, from 0 to 1; none when surely not more than `needed`.
    fn likeness(&self, other: &str, needed: f64) -> Option<f64> {
        let (counts, length) = Self::count(other);
        let longest = self.length.max(length) as f64;
        let holds = self.length >= 3
            && (other.contains(&self.key) || (length >= 4 && self.key.contains(other)));
        if holds {
            let likeness = 0.75 + 0.2 * self.length.min(length) as f64 / longest;
            return (likeness >= needed).then_some(likeness);
        }
        let missing: u32 =
            self.counts.iter().zip(&counts).map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
        // An edit mends two of these differences at most.
        if 1.0 - f64::from(missing.div_ceil(2)) / longest < needed {
            return None;
        }
        let likeness = strsim::normalized_damerau_levenshtein(&self.key, other);
        (likeness >= needed).then_some(likeness)
    }
}

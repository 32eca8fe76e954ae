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
                let (letters, length) = Letters::kinds(part);
                let differ = (wanted.kinds ^ letters).count_ones();
                if differ > 2 || length.abs_diff(wanted.length) > 1 || wanted.apart(part) > 2 {
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
struct Letters {
    key: String,
    length: usize,
    /// Which letters there are, a bit for each of 64 kinds.
    kinds: u64,
    /// How many of each kind.
    counts: [u8; 64],
}

impl Letters {
    fn of(key: String) -> Self {
        let (kinds, length) = Self::kinds(&key);
        let counts = Self::count(&key);
        Self { key, length, kinds, counts }
    }

    fn kinds(key: &str) -> (u64, usize) {
        key.chars().fold((0, 0), |(kinds, length), c| (kinds | 1 << (c as u32 % 64), length + 1))
    }

    fn count(key: &str) -> [u8; 64] {
        let mut counts = [0_u8; 64];
        for c in key.chars() {
            let slot = &mut counts[c as usize % 64];
            *slot = slot.saturating_add(1);
        }
        counts
    }

    /// How many letters one has and the other has not.
    fn apart(&self, other: &str) -> u32 {
        let counts = Self::count(other);
        self.counts.iter().zip(&counts).map(|(a, b)| u32::from(a.abs_diff(*b))).sum()
    }

    /// How alike two keys are, from 0 to 1; none when surely not more than `needed`.
    fn likeness(&self, other: &str, needed: f64) -> Option<f64> {
        let (kinds, length) = Self::kinds(other);
        let longest = self.length.max(length) as f64;
        // Looking for one text in another takes longest: where a letter is lacking it is not there.
        let is_within = |kinds: u64, of: u64, text: &str, whole: &str| {
            kinds & !of == 0 && text.len() <= whole.len() && whole.contains(text)
        };
        let holds = self.length >= 3
            && (is_within(self.kinds, kinds, &self.key, other)
                || (length >= 4 && is_within(kinds, self.kinds, other, &self.key)));
        if holds {
            let likeness = 0.75 + 0.2 * self.length.min(length) as f64 / longest;
            return (likeness >= needed).then_some(likeness);
        }
        // An edit mends two of the differences at most.
        let is_far = |differences: u32| 1.0 - f64::from(differences.div_ceil(2)) / longest < needed;
        if is_far((self.kinds ^ kinds).count_ones()) || is_far(self.apart(other)) {
            return None;
        }
        let likeness = strsim::normalized_damerau_levenshtein(&self.key, other);
        (likeness >= needed).then_some(likeness)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left out without comparing would not have been like enough.
    #[test]
    fn likeness_is_what_comparing_tells() {
        let words = [
            "стол",
            "столы",
            "стул",
            "кофейный столик",
            "ст",
            "око",
            "окно",
            "котел",
            "кот",
            "a",
            "table",
            "bedside table",
            "tabel",
            "room c",
            "комната c",
            "комната-в",
            "столик",
            "",
        ];
        for wanted in words.iter().filter(|word| !word.is_empty()) {
            let letters = Letters::of((*wanted).to_owned());
            for other in words {
                let (own, length) = (wanted.chars().count(), other.chars().count());
                let holds =
                    own >= 3 && (other.contains(wanted) || (length >= 4 && wanted.contains(other)));
                let likeness = match holds {
                    true => 0.75 + 0.2 * own.min(length) as f64 / own.max(length) as f64,
                    false => strsim::normalized_damerau_levenshtein(wanted, other),
                };
                for needed in [0.0, 0.4, 0.6, 0.7, 0.9] {
                    let told = letters.likeness(other, needed);
                    let expected = (likeness >= needed).then_some(likeness);
                    assert_eq!(told, expected, "{wanted} {other} {needed}");
                }
            }
        }
    }
}

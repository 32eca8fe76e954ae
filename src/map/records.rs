//! Records by id, as a map that is copied by sharing: a copy takes over what does not change, and what differs between
//! two of them is found where they do not share.
//!
//! Sorted chunks of records behind counters, and one list of the chunks: a copy counts once, a change writes one chunk
//! and the list. A persistent tree of another's would do as well but for [`Records::values_mut`], which none offers.
//!
//! **Invariant**: chunks are in the order of their keys, none is empty, and each bears its first key.

use crate::units::Gather as _;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// A chunk that grows beyond this is halved.
const MOST: usize = 64;
/// Chunks of what is made at once: some records can be added before any is halved.
const MADE: usize = 48;

/// Records that stand together.
#[derive(Clone)]
struct Chunk<K, V> {
    records: Vec<(K, V)>,
    /// For each [`Records::of_groups`] the groups of its records, sorted; found when first asked for, and shared with the chunk.
    groups: [OnceLock<Box<[u32]>>; 2],
}

impl<K, V> Chunk<K, V> {
    fn of(records: Vec<(K, V)>) -> Arc<Self> {
        Arc::new(Self { records, groups: [const { OnceLock::new() }; 2] })
    }
}

impl<K, V> Deref for Chunk<K, V> {
    type Target = Vec<(K, V)>;

    fn deref(&self) -> &Self::Target {
        &self.records
    }
}

/// The records of a chunk, to be changed: others that share it keep theirs.
fn change<K: Clone, V: Clone>(chunk: &mut Arc<Chunk<K, V>>) -> &mut Vec<(K, V)> {
    let chunk = Arc::make_mut(chunk);
    chunk.groups = Default::default();
    &mut chunk.records
}

/// Chunks, each with its first key.
type Chunks<K, V> = Vec<(K, Arc<Chunk<K, V>>)>;

/// A sorted map whose copies share what they have in common. Copying costs nothing, a change what it changes.
#[derive(Clone)]
pub struct Records<K, V> {
    chunks: Arc<Chunks<K, V>>,
    len: usize,
}

/// What two maps have under a key, where it differs: before and after.
pub type Change<'a, K, V> = (K, Option<&'a V>, Option<&'a V>);

impl<K, V> Default for Records<K, V> {
    fn default() -> Self {
        Self { chunks: Arc::default(), len: 0 }
    }
}

impl<K: Copy + Ord, V> Records<K, V> {
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The number of the chunk where a key stands or would stand.
    fn chunk_of(&self, key: &K) -> usize {
        self.chunks.partition_point(|(first, _)| first <= key).saturating_sub(1)
    }

    #[must_use]
    pub fn get(&self, key: &K) -> Option<&V> {
        let (_, chunk) = self.chunks.get(self.chunk_of(key))?;
        let at = chunk.binary_search_by(|(k, _)| k.cmp(key)).ok()?;
        Some(&chunk[at].1)
    }

    #[must_use]
    pub fn contains_key(&self, key: &K) -> bool {
        self.get(key).is_some()
    }

    /// In the order of the keys.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (&K, &V)> + Clone {
        self.chunks.iter().flat_map(|(_, chunk)| chunk.iter().map(|(k, v)| (k, v)))
    }

    pub fn keys(&self) -> impl DoubleEndedIterator<Item = &K> + Clone {
        self.iter().map(|(k, _)| k)
    }

    pub fn values(&self) -> impl DoubleEndedIterator<Item = &V> + Clone {
        self.iter().map(|(_, v)| v)
    }

    /// The records that are of a group that is wanted, in the order of the keys. `number` tells the way of grouping, which is
    /// always the same for it: of chunks that did not change it is known of which groups their records are.
    pub(super) fn of_groups<'a>(
        &'a self,
        number: usize,
        groups: fn(&V, &mut dyn FnMut(u32)),
        is_wanted: impl Fn(u32) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = &'a V> + 'a {
        let may_have = move |chunk: &&Chunk<K, V>| {
            let known = chunk.groups[number].get_or_init(|| {
                let mut all = BTreeSet::new();
                for (_, v) in chunk.iter() {
                    groups(v, &mut |group| {
                        all.insert(group);
                    });
                }
                all.into_iter().collect()
            });
            known.iter().any(|of| is_wanted(*of))
        };
        let chunks = self.chunks.iter().map(|(_, chunk)| &**chunk).filter(may_have);
        let all = chunks.flat_map(|chunk| chunk.iter().map(|(_, v)| v));
        all.filter(move |v| {
            let mut is_any = false;
            groups(v, &mut |group| is_any |= is_wanted(group));
            is_any
        })
    }

    /// What differs from this map to another, in the order of the keys; looked for only where they share nothing.
    #[must_use]
    pub fn changes<'a>(&'a self, after: &'a Self) -> Vec<Change<'a, K, V>>
    where
        V: PartialEq,
    {
        let (mut was, mut is) = (self.chunks.as_slice(), after.chunks.as_slice());
        let (mut old, mut new) = (Vec::new(), Vec::new());
        if Arc::ptr_eq(&self.chunks, &after.chunks) {
            return Vec::new();
        }
        // A chunk that both share has the same key in both, so that the walk meets it in both at once.
        loop {
            let (one, other) = (was.first(), is.first());
            match (one, other) {
                (None, None) => break,
                (Some((_, a)), Some((_, b))) if Arc::ptr_eq(a, b) => {
                    (was, is) = (&was[1..], &is[1..]);
                }
                (Some((a, chunk)), other) if other.is_none_or(|(b, _)| a <= b) => {
                    old.extend(chunk.iter());
                    was = &was[1..];
                }
                (_, Some((_, chunk))) => {
                    new.extend(chunk.iter());
                    is = &is[1..];
                }
                (Some(_), None) => unreachable!("taken by the arm before"),
            }
        }
        let (mut old, mut new) = (old.into_iter().peekable(), new.into_iter().peekable());
        let mut found = Vec::new();
        loop {
            let order = match (old.peek(), new.peek()) {
                (None, None) => return found,
                (Some(_), None) => std::cmp::Ordering::Less,
                (None, Some(_)) => std::cmp::Ordering::Greater,
                (Some((a, _)), Some((b, _))) => a.cmp(b),
            };
            let was = if order.is_le() { old.next() } else { None };
            let is = if order.is_ge() { new.next() } else { None };
            let key = was.or(is).map(|(key, _)| *key);
            let (was, is) = (was.map(|(_, v)| v), is.map(|(_, v)| v));
            if let (Some(key), true) = (key, was != is) {
                found.push((key, was, is));
            }
        }
    }
}

impl<K: Copy + Ord, V: Clone> Records<K, V> {
    pub fn get_mut(&mut self, key: &K) -> Option<&mut V> {
        let number = self.chunk_of(key);
        let at = self.chunks.get(number)?.1.binary_search_by(|(k, _)| k.cmp(key)).ok()?;
        let chunk = change(&mut Arc::make_mut(&mut self.chunks)[number].1);
        Some(&mut chunk[at].1)
    }

    /// Puts a record in; answers the one that it replaces.
    pub fn insert(&mut self, key: K, value: V) -> Option<V> {
        let number = self.chunk_of(&key);
        let chunks = Arc::make_mut(&mut self.chunks);
        let Some((first, chunk)) = chunks.get_mut(number) else {
            chunks.push((key, Chunk::of(vec![(key, value)])));
            self.len = 1;
            return None;
        };
        let chunk = change(chunk);
        match chunk.binary_search_by(|(k, _)| k.cmp(&key)) {
            Ok(at) => return Some(std::mem::replace(&mut chunk[at].1, value)),
            Err(at) => chunk.insert(at, (key, value)),
        }
        *first = chunk[0].0;
        self.len += 1;
        if chunk.len() > MOST {
            // What is added in order fills its chunks.
            let at = if number + 1 == chunks.len() { MADE } else { MOST / 2 };
            let rest = change(&mut chunks[number].1).split_off(at);
            chunks.insert(number + 1, (rest[0].0, Chunk::of(rest)));
        }
        None
    }

    pub fn remove(&mut self, key: &K) -> Option<V> {
        let number = self.chunk_of(key);
        let at = self.chunks.get(number)?.1.binary_search_by(|(k, _)| k.cmp(key)).ok()?;
        let chunks = Arc::make_mut(&mut self.chunks);
        let (first, chunk) = &mut chunks[number];
        let chunk = change(chunk);
        let (_, gone) = chunk.remove(at);
        self.len -= 1;
        match chunk.first() {
            Some((key, _)) => *first = *key,
            None => drop(chunks.remove(number)),
        }
        Some(gone)
    }

    pub fn pop_last(&mut self) -> Option<(K, V)> {
        let last = *self.keys().next_back()?;
        self.remove(&last).map(|gone| (last, gone))
    }

    /// All records, to be changed: nothing of this map is shared afterwards.
    pub fn values_mut(&mut self) -> impl DoubleEndedIterator<Item = &mut V> {
        let chunks = Arc::make_mut(&mut self.chunks);
        chunks.iter_mut().flat_map(|(_, chunk)| change(chunk).iter_mut().map(|(_, v)| v))
    }

    /// Keeps the records for which this holds.
    pub fn retain(&mut self, mut is_kept: impl FnMut(&K, &mut V) -> bool) {
        let all = std::mem::take(self).into_iter();
        *self = all.filter_map(|(key, mut v)| is_kept(&key, &mut v).then_some((key, v))).collect();
    }

    pub fn clear(&mut self) {
        *self = Self::default();
    }

    pub fn into_values(self) -> impl DoubleEndedIterator<Item = V> {
        self.into_iter().map(|(_, v)| v)
    }
}

impl<K: Copy + Ord, V: Clone> IntoIterator for Records<K, V> {
    type Item = (K, V);
    type IntoIter = std::vec::IntoIter<(K, V)>;

    fn into_iter(self) -> Self::IntoIter {
        let chunks = Arc::unwrap_or_clone(self.chunks).into_iter();
        let all: Vec<_> =
            chunks.flat_map(|(_, chunk)| Arc::unwrap_or_clone(chunk).records).collect();
        all.into_iter()
    }
}

impl<'a, K: Copy + Ord, V> IntoIterator for &'a Records<K, V> {
    type Item = (&'a K, &'a V);
    type IntoIter = Box<dyn DoubleEndedIterator<Item = (&'a K, &'a V)> + 'a>;

    fn into_iter(self) -> Self::IntoIter {
        Box::new(self.iter())
    }
}

impl<K: Copy + Ord, V: Clone> From<BTreeMap<K, V>> for Records<K, V> {
    fn from(sorted: BTreeMap<K, V>) -> Self {
        let len = sorted.len();
        let mut chunks = Vec::with_capacity(len.div_ceil(MADE));
        let mut sorted = sorted.into_iter().peekable();
        while let Some(&(first, _)) = sorted.peek() {
            chunks.push((first, Chunk::of(sorted.by_ref().take(MADE).collect())));
        }
        Self { chunks: Arc::new(chunks), len }
    }
}

impl<K: Copy + Ord, V: Clone> FromIterator<(K, V)> for Records<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(records: I) -> Self {
        records.into_iter().gather::<BTreeMap<K, V>>().into()
    }
}

impl<K: Copy + Ord, V: Clone> Extend<(K, V)> for Records<K, V> {
    fn extend<I: IntoIterator<Item = (K, V)>>(&mut self, records: I) {
        for (key, value) in records {
            self.insert(key, value);
        }
    }
}

impl<K: Copy + Ord, V> std::ops::Index<&K> for Records<K, V> {
    type Output = V;

    fn index(&self, key: &K) -> &V {
        self.get(key).expect("no record has this id")
    }
}

impl<K: Copy + Ord, V: PartialEq> PartialEq for Records<K, V> {
    fn eq(&self, other: &Self) -> bool {
        self.len == other.len && self.changes(other).is_empty()
    }
}

impl<K: Copy + Ord + fmt::Debug, V: fmt::Debug> fmt::Debug for Records<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of numbers that looks like chance.
    fn dice(mut state: u64) -> impl FnMut(u64) -> u64 {
        move |below| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        }
    }

    fn check(records: &Records<u32, u64>, plain: &BTreeMap<u32, u64>) {
        assert!(records.iter().eq(plain.iter()) && records.len() == plain.len());
        assert!(records.iter().rev().eq(plain.iter().rev()));
        for (first, chunk) in records.chunks.iter() {
            assert!(!chunk.is_empty() && chunk.len() <= MOST && chunk[0].0 == *first);
        }
        // Whatever was asked of copies and before changes.
        for wanted in [0, 3] {
            let of = |v: &u64| [(*v % 50) as u32, (*v % 70) as u32];
            let each = |v: &u64, put: &mut dyn FnMut(u32)| {
                [(*v % 50) as u32, (*v % 70) as u32].into_iter().for_each(put);
            };
            let found = records.of_groups(0, each, |group| group == wanted);
            assert!(found.eq(plain.values().filter(|v| of(v).contains(&wanted))));
        }
    }

    /// Every way to change it leaves what a plain map holds, copies made before stay as they were, and what differs is
    /// found whatever is shared.
    #[test]
    fn it_is_a_map_and_its_copies_stay() {
        let mut throw = dice(7);
        let (mut records, mut plain) = (Records::new(), BTreeMap::new());
        let mut kept: Vec<(Records<u32, u64>, BTreeMap<u32, u64>)> = Vec::new();
        for step in 0..6_000_u64 {
            let key = throw(900) as u32;
            match throw(if step % 2_000 < 1_000 { 5 } else { 9 }) {
                0..=2 => assert_eq!(records.insert(key, step), plain.insert(key, step)),
                3 => match (records.get_mut(&key), plain.get_mut(&key)) {
                    (Some(a), Some(b)) => (*a, *b) = (step, step),
                    (a, b) => assert_eq!(a, b),
                },
                4 if step % 37 == 0 => assert_eq!(records.pop_last(), plain.pop_last()),
                4 if step % 91 == 0 => {
                    records.values_mut().for_each(|v| *v += 1);
                    plain.values_mut().for_each(|v| *v += 1);
                }
                4 if step % 97 == 0 => {
                    records.retain(|k, v| (u64::from(*k) + *v) % 7 != 0);
                    plain.retain(|k, v| (u64::from(*k) + *v) % 7 != 0);
                }
                _ => assert_eq!(records.remove(&key), plain.remove(&key)),
            }
            assert_eq!(records.get(&key), plain.get(&key));
            if step % 50 == 0 {
                check(&records, &plain);
                kept.push((records.clone(), plain.clone()));
            }
        }
        kept.push((records, plain));
        for (records, plain) in &kept {
            check(records, plain);
        }
        for _ in 0..400 {
            let [(one, a), (other, b)] =
                [throw(1 << 20), throw(1 << 20)].map(|n| &kept[n as usize % kept.len()]);
            let keys = a.keys().chain(b.keys()).collect::<std::collections::BTreeSet<_>>();
            let differing = keys.into_iter().filter(|k| a.get(k) != b.get(k));
            let plain: Vec<_> = differing.map(|k| (*k, a.get(k), b.get(k))).collect();
            assert_eq!(one.changes(other), plain);
            assert_eq!(one == other, plain.is_empty());
            let made: Records<u32, u64> = b.clone().into();
            assert_eq!(&made, other);
        }
    }

    #[test]
    fn a_change_of_a_copy_writes_one_chunk() {
        let records: Records<u32, u64> = (0..10_000).map(|n| (n, 0)).collect();
        let mut copy = records.clone();
        *copy.get_mut(&5_000).expect("it is there") = 1;
        let shared = records.chunks.iter().zip(copy.chunks.iter());
        let written = shared.filter(|(a, b)| !Arc::ptr_eq(&a.1, &b.1)).count();
        assert_eq!(written, 1);
        assert_eq!(records.changes(&copy), [(5_000, Some(&0), Some(&1))]);
    }
}

//! Order of a few things, by one function of machine code for all of them.
//!
//! The standard library's sort is compiled anew, some five kilobytes, for each closure that it is given; where little is sorted that
//! is a fifth of a crate's code and of the time that compiling it takes. Here the places are sorted and the things follow. What
//! sorts thousands keeps to the standard library. So is it with trees, which it makes of what it has sorted: here they grow.

use std::cmp::Ordering;

/// Stable sort of slices, for where time does not matter.
pub trait InOrder<T> {
    /// As [`sort`](slice::sort).
    fn order(&mut self)
    where
        T: Ord;

    /// As [`sort_by`](slice::sort_by).
    fn order_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering);

    /// As [`sort_by_key`](slice::sort_by_key).
    fn order_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K);
}

impl<T> InOrder<T> for [T] {
    fn order(&mut self)
    where
        T: Ord,
    {
        self.order_by(T::cmp);
    }

    fn order_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering) {
        arrange(self.len(), &mut Compared { things: self, compare });
    }

    fn order_by_key<K: Ord>(&mut self, mut key: impl FnMut(&T) -> K) {
        self.order_by(|one, other| key(one).cmp(&key(other)));
    }
}

/// Trees that grow.
pub trait Gather: Iterator + Sized {
    /// As [`collect`](Iterator::collect), one after another: of things with equal keys the last stays.
    fn gather<C: Default + Extend<Self::Item>>(self) -> C {
        let mut gathered = C::default();
        gathered.extend(self);
        gathered
    }
}

impl<I: Iterator> Gather for I {}

/// Things of whatever kind at their places.
trait Places {
    fn compare(&mut self, one: usize, other: usize) -> Ordering;

    fn swap(&mut self, one: usize, other: usize);
}

struct Compared<'a, T, F> {
    things: &'a mut [T],
    compare: F,
}

impl<T, F: FnMut(&T, &T) -> Ordering> Places for Compared<'_, T, F> {
    fn compare(&mut self, one: usize, other: usize) -> Ordering {
        (self.compare)(&self.things[one], &self.things[other])
    }

    fn swap(&mut self, one: usize, other: usize) {
        self.things.swap(one, other);
    }
}

/// Up to so many things need no list of their places.
const FEW: usize = 8;

fn arrange(count: usize, places: &mut dyn Places) {
    if count <= FEW {
        for end in 1..count {
            let mut at = end;
            while at > 0 && places.compare(at - 1, at).is_gt() {
                places.swap(at - 1, at);
                at -= 1;
            }
        }
        return;
    }
    // Whose thing comes to each place.
    let mut from: Vec<usize> = (0..count).collect();
    from.sort_by(|&one, &other| places.compare(one, other));
    for start in 0..count {
        let mut at = start;
        loop {
            let next = std::mem::replace(&mut from[at], at);
            if next == start {
                break;
            }
            places.swap(at, next);
            at = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that repeat themselves, without a crate for chance.
    fn things(count: usize, kinds: u64, mut seed: u64) -> Vec<(u64, usize)> {
        (0..count)
            .map(|number| {
                seed = seed
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                ((seed >> 33) % kinds, number)
            })
            .collect()
    }

    #[test]
    fn the_order_is_that_of_the_standard_library() {
        for count in 0..70 {
            for kinds in [1, 2, 5, 1_000] {
                let things = things(count, kinds, count as u64 * 31 + kinds);
                let mut expected = things.clone();
                expected.sort_by_key(|thing| thing.0);
                let mut by_key = things.clone();
                by_key.order_by_key(|thing| thing.0);
                assert_eq!(by_key, expected);
                expected.sort_by(|a, b| b.cmp(a));
                let mut by = things.clone();
                by.order_by(|a, b| b.cmp(a));
                assert_eq!(by, expected);
                expected.sort();
                let mut plain = things;
                plain.order();
                assert_eq!(plain, expected);
            }
        }
    }

    /// Whatever a comparison says, or if it fails midway, nothing is lost or doubled.
    #[test]
    fn nothing_is_lost_by_a_comparison_that_fails() {
        for count in [0, 1, 5, 9, 40] {
            let mut left = 2 * count;
            let mut all: Vec<String> = (0..count).map(|number| number.to_string()).collect();
            let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
                all.order_by(|a, b| {
                    left = usize::checked_sub(left, 1).expect("fails on purpose");
                    b.cmp(a)
                });
            }));
            assert!(outcome.is_err() || count < 9);
            all.sort_by_key(|text| text.parse::<usize>().expect("a number"));
            assert_eq!(all, (0..count).map(|number| number.to_string()).collect::<Vec<_>>());
        }
    }
}

//! Sets of small numbers as bits of words, the least number first.

/// How many words a set of numbers below `count` takes.
pub(super) fn words(count: usize) -> usize {
    count.div_ceil(64)
}

pub(super) fn has(set: &[u64], number: usize) -> bool {
    set[number / 64] >> (number % 64) & 1 == 1
}

pub(super) fn put(set: &mut [u64], number: usize) {
    set[number / 64] |= 1 << (number % 64);
}

pub(super) fn take(set: &mut [u64], number: usize) {
    set[number / 64] &= !(1 << (number % 64));
}

/// Adds the members of another set.
pub(super) fn unite(set: &mut [u64], more: &[u64]) {
    set.iter_mut().zip(more).for_each(|(word, more)| *word |= more);
}

/// Keeps what another set has as well.
pub(super) fn keep_common(set: &mut [u64], other: &[u64]) {
    set.iter_mut().zip(other).for_each(|(word, other)| *word &= other);
}

/// Ascending.
pub(super) fn members(set: &[u64]) -> impl Iterator<Item = usize> {
    set.iter().enumerate().flat_map(|(at, &word)| of_word(word).map(move |bit| at * 64 + bit))
}

/// What two sets both have, ascending.
pub(super) fn common(set: &[u64], other: &[u64]) -> impl Iterator<Item = usize> {
    let words = set.iter().zip(other).enumerate();
    words.flat_map(|(at, (&word, &other))| of_word(word & other).map(move |bit| at * 64 + bit))
}

/// The members of one word's set, ascending.
pub(super) fn of_word(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let first = (word != 0).then(|| word.trailing_zeros() as usize);
        word &= word.wrapping_sub(1);
        first
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_has_what_was_put_and_not_taken() {
        let mut set = vec![0; words(130)];
        [0, 63, 64, 129].into_iter().for_each(|number| put(&mut set, number));
        assert_eq!(members(&set).collect::<Vec<_>>(), [0, 63, 64, 129]);
        take(&mut set, 64);
        assert!(has(&set, 63) && !has(&set, 64) && !has(&set, 65));
        let mut other = vec![0; words(130)];
        put(&mut other, 129);
        put(&mut other, 5);
        let mut both = set.clone();
        unite(&mut both, &other);
        keep_common(&mut set, &other);
        assert_eq!(members(&both).collect::<Vec<_>>(), [0, 5, 63, 129]);
        assert_eq!(members(&set).collect::<Vec<_>>(), [129]);
    }
}

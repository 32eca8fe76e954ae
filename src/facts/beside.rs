//! New pairs of a relation that is kept as bits, found by several threads at once.
//!
//! Pairs come in runs whose bits stand in one word of 64. A thread looks at a word when it comes to it and puts its new
//! bits there when it leaves it, all at once; what another thread has put meanwhile is that one's.

use super::row::Row;
use super::seen::Seen;
use super::sink::{Branch, Sink, Taken};
use super::word::Word;

pub(super) struct Beside<'a, const N: usize> {
    seen: &'a Seen,
    new: Vec<Row<N>>,
    /// Beyond the range of `seen`.
    outside: Vec<Row<N>>,
    /// The word of bits that the last pair was in; none before the first.
    word: Option<usize>,
    /// What stood there already.
    known: u64,
    /// What was new there: the last rows of `new`.
    found: u64,
}

impl<'a, const N: usize> Beside<'a, N> {
    pub(super) fn new(seen: &'a Seen) -> Self {
        Self { seen, new: Vec::new(), outside: Vec::new(), word: None, known: 0, found: 0 }
    }

    /// Puts the new bits into their word, and gives up the rows of those that another thread has put there first.
    fn leave(&mut self) {
        let Some(word) = self.word.filter(|_| self.found != 0) else { return };
        let lost = self.seen.put(word, self.found);
        if lost != 0 {
            let tail = self.new.split_off(self.new.len() - self.found.count_ones() as usize);
            let seen = self.seen;
            let is_kept =
                |row: &Row<N>| seen.place(row).is_some_and(|at| lost >> (at % 64) & 1 == 0);
            self.new.extend(tail.into_iter().filter(is_kept));
        }
        self.found = 0;
    }
}

impl<const N: usize> Sink for Beside<'_, N> {
    #[inline]
    fn push(&mut self, row: &[Word]) {
        let row = Row::of(row);
        let Some(at) = self.seen.place(&row) else { return self.outside.push(row) };
        let (word, bit) = (at / 64, 1 << (at % 64));
        if self.word != Some(word) {
            self.leave();
            self.word = Some(word);
            self.known = self.seen.look(word);
        }
        if (self.known | self.found) & bit == 0 {
            self.found |= bit;
            self.new.push(row);
        }
    }

    fn len(&self) -> usize {
        self.new.len() + self.outside.len()
    }

    fn bytes(&self) -> usize {
        Sink::bytes(&self.new) + Sink::bytes(&self.outside)
    }
}

impl<const N: usize> Branch for Beside<'_, N> {
    fn taken(mut self: Box<Self>) -> Taken {
        self.leave();
        Box::new((self.new, self.outside))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_two_that_find_a_pair_one_has_it() {
        let all: Vec<Row<2>> = (0..40).flat_map(|x| (0..40).map(move |y| Row([x, y]))).collect();
        let seen = Seen::over(all.iter()).expect("dense pairs are kept as bits");
        let (mut one, mut other) = (Beside::<2>::new(&seen), Beside::<2>::new(&seen));
        // Both look at a word before either leaves it.
        for row in &all {
            one.push(&row.0);
            other.push(&row.0);
            if row.0[1].is_multiple_of(3) {
                one.push(&row.0);
            }
        }
        one.push(&[77, 0]);
        let rows = |of: Beside<'_, 2>| {
            *Box::new(of).taken().downcast::<(Vec<Row<2>>, Vec<Row<2>>)>().expect("rows of pairs")
        };
        let ((mut first, outside), (second, _)) = (rows(one), rows(other));
        assert_eq!(outside, [Row([77, 0])]);
        first.extend(second);
        first.sort_unstable();
        assert_eq!(first, all);
    }
}

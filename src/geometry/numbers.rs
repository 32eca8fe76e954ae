//! Lists of numbers that are mostly small: cells and corners by their places in a Fragment.

use super::kept_value::Kept;

/// No number.
pub(super) const NONE: u32 = u32::MAX;

/// Numbers below 2^32 in order, each in 16 bits where all fit.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Numbers {
    /// [`NONE`] is the greatest of 16 bits.
    Short(Box<[u16]>),
    Long(Box<[u32]>),
}

/// Some that follow one another.
#[derive(Debug, Clone, Copy)]
pub(super) enum Part<'a> {
    Short(&'a [u16]),
    Long(&'a [u32]),
}

fn widened(number: u16) -> u32 {
    if number == u16::MAX { NONE } else { u32::from(number) }
}

impl Numbers {
    pub(super) fn of(numbers: &[u32]) -> Self {
        let is_short = |&n: &u32| n == NONE || n < u32::from(u16::MAX);
        if numbers.iter().all(is_short) {
            Self::Short(numbers.iter().map(|&n| n as u16).collect())
        } else {
            Self::Long(numbers.into())
        }
    }

    pub(super) fn all(&self) -> Part<'_> {
        self.part(0..self.len())
    }

    pub(super) fn part(&self, span: std::ops::Range<usize>) -> Part<'_> {
        match self {
            Self::Short(numbers) => Part::Short(&numbers[span]),
            Self::Long(numbers) => Part::Long(&numbers[span]),
        }
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::Short(numbers) => numbers.len(),
            Self::Long(numbers) => numbers.len(),
        }
    }

    pub(super) fn get(&self, at: usize) -> u32 {
        match self {
            Self::Short(numbers) => widened(numbers[at]),
            Self::Long(numbers) => numbers[at],
        }
    }
}

impl Default for Numbers {
    fn default() -> Self {
        Self::of(&[])
    }
}

impl<'a> Part<'a> {
    pub(super) fn len(self) -> usize {
        match self {
            Self::Short(numbers) => numbers.len(),
            Self::Long(numbers) => numbers.len(),
        }
    }

    pub(super) fn get(self, at: usize) -> u32 {
        match self {
            Self::Short(numbers) => widened(numbers[at]),
            Self::Long(numbers) => numbers[at],
        }
    }

    pub(super) fn iter(self) -> impl Iterator<Item = u32> + 'a {
        (0..self.len()).map(move |at| self.get(at))
    }
}

impl Kept for Numbers {
    fn put(&self, out: &mut Vec<u8>) {
        self.all().iter().collect::<Vec<u32>>().put(out);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Vec::take(bytes).map(|numbers: Vec<u32>| Self::of(&numbers))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_as_they_were_put_in() {
        let most = u32::from(u16::MAX);
        for (numbers, is_short) in [
            (vec![], true),
            (vec![0, NONE, most - 1, 7], true),
            (vec![3, most, NONE], false),
            (vec![NONE - 1], false),
        ] {
            let kept = Numbers::of(&numbers);
            assert_eq!(matches!(kept, Numbers::Short(_)), is_short);
            assert_eq!(kept.all().iter().collect::<Vec<_>>(), numbers);
            assert!((0..numbers.len()).all(|at| kept.get(at) == numbers[at]));
            let mut bytes = Vec::new();
            kept.put(&mut bytes);
            assert_eq!(Numbers::take(&mut &bytes[..]), Some(kept));
        }
    }
}

//! States packed one behind the other, each kept once and found by what it is.

/// All states have as many words.
pub(super) struct Packed {
    words: usize,
    states: Vec<u64>,
    /// Numbers of states by their hashes (open addressing, linear probing); a power of two of slots.
    slots: Vec<u32>,
    count: usize,
}

const FREE: u32 = u32::MAX;

impl Packed {
    pub(super) fn new(words: usize) -> Self {
        Self { words: words.max(1), states: Vec::new(), slots: vec![FREE; 1 << 10], count: 0 }
    }

    pub(super) fn bytes(&self) -> usize {
        self.states.capacity() * 8 + self.slots.len() * 4
    }

    pub(super) fn state(&self, number: u32) -> &[u64] {
        &self.states[number as usize * self.words..][..self.words]
    }

    pub(super) fn find(&self, state: &[u64]) -> Option<u32> {
        let known = self.slots[self.slot(state)];
        (known != FREE).then_some(known)
    }

    /// The number of a state, and whether it is new.
    pub(super) fn insert(&mut self, state: &[u64]) -> (u32, bool) {
        let slot = self.slot(state);
        let known = self.slots[slot];
        if known != FREE {
            return (known, false);
        }
        let number = self.count as u32;
        self.slots[slot] = number;
        self.states.extend_from_slice(state);
        self.count += 1;
        if self.count * 3 > self.slots.len() * 2 {
            self.slots = vec![FREE; self.slots.len() * 2];
            for number in 0..self.count as u32 {
                let slot = self.slot(self.state(number));
                self.slots[slot] = number;
            }
        }
        (number, true)
    }

    /// Where a state is, or where there is room for it.
    fn slot(&self, state: &[u64]) -> usize {
        let mixed = state.iter().fold(0_u64, |mixed, word| {
            (mixed ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29)
        });
        let mask = self.slots.len() - 1;
        let mut slot = (mixed ^ mixed >> 32) as usize & mask;
        while self.slots[slot] != FREE && self.state(self.slots[slot]) != state {
            slot = (slot + 1) & mask;
        }
        slot
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::samples::Random;

    #[test]
    fn a_state_has_one_number() {
        let (mut packed, mut known) = (Packed::new(2), HashMap::new());
        let mut random = Random(7);
        for _ in 0..20_000 {
            let state = [random.below(90) as u64, random.below(90) as u64];
            let next = known.len() as u32;
            let number = *known.entry(state).or_insert(next);
            assert_eq!(packed.insert(&state), (number, number == next));
            assert_eq!(packed.state(number), state);
        }
        assert_eq!(packed.count, known.len());
    }
}

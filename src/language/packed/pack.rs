//! The automaton of words as the published dictionary has it, told anew in columns (see `automaton.rs`).

use std::collections::HashMap;

use fst::raw::Fst;

use super::automaton::{
    COLUMNS, END, ENDS, FAR, FINAL, FREQUENCIES, FREQUENCY_AT, FREQUENCY_BITS, HAS_FREQUENCY,
    HAS_READINGS, HAS_SPELLING, IS_FAR, IS_LISTED, LETTERS, LISTED, MARKS, NEW, READINGS_HIGH,
    READINGS_LOW, SHAPES, SPELLING_AT, SPELLINGS, TARGET_AT,
};

#[derive(Clone, PartialEq, Eq, Hash)]
struct Node {
    end: Option<u64>,
    /// Letter, value, and the target's number from one on; zero for the end.
    transitions: Vec<(u8, u64, usize)>,
}

/// Its nodes, children first, of equal ones the first alone: the builder of the crate fst forgets most that it has seen, and
/// a third of its nodes are there already.
fn minimal(automaton: &Fst<&[u8]>) -> Vec<Node> {
    const END_ADDRESS: usize = 0;
    let mut addresses = vec![automaton.root().addr()];
    let mut seen = std::collections::HashSet::from([addresses[0]]);
    let mut next = 0;
    while let Some(&address) = addresses.get(next) {
        next += 1;
        for transition in automaton.node(address).transitions() {
            if transition.addr != END_ADDRESS && seen.insert(transition.addr) {
                addresses.push(transition.addr);
            }
        }
    }
    // A node stands in the file after all that it leads to.
    addresses.sort_unstable();
    let mut numbers = HashMap::from([(END_ADDRESS, 0)]);
    let mut known: HashMap<Node, usize> = HashMap::new();
    let mut nodes = Vec::new();
    for address in addresses {
        let node = automaton.node(address);
        let end = node.is_final().then(|| node.final_output().value());
        let transitions = node.transitions().map(|t| (t.inp, t.out.value(), numbers[&t.addr]));
        let node = Node { end, transitions: transitions.collect() };
        let number = *known.entry(node.clone()).or_insert_with(|| {
            nodes.push(node);
            nodes.len()
        });
        numbers.insert(address, number);
    }
    nodes
}

#[derive(Default)]
struct Columns {
    columns: [Vec<u8>; COLUMNS],
    frequency: u64,
}

impl Columns {
    fn push(&mut self, column: usize, number: u64, bytes: usize) {
        self.columns[column].extend_from_slice(&number.to_le_bytes()[..bytes]);
    }

    /// Tells a value's parts; which it has.
    fn push_value(&mut self, value: u64) -> u8 {
        let mut parts = 0;
        let readings = value & ((1 << FREQUENCY_AT) - 1);
        if readings != 0 {
            parts |= HAS_READINGS;
            self.push(READINGS_LOW, readings & 0xffff, 2);
            self.push(READINGS_HIGH, readings >> 16, 1);
        }
        let frequency = value >> FREQUENCY_AT & ((1 << FREQUENCY_BITS) - 1);
        if frequency != 0 {
            parts |= HAS_FREQUENCY;
            // The step from the last, by the shorter way round; its sign is the lowest bit.
            const UNUSED: u32 = 64 - FREQUENCY_BITS;
            let step = ((frequency.wrapping_sub(self.frequency) << UNUSED) as i64) >> UNUSED;
            self.push(FREQUENCIES, (step << 1 ^ step >> 63) as u64, 3);
            self.frequency = frequency;
        }
        let spelling = value >> SPELLING_AT;
        if spelling != 0 {
            parts |= HAS_SPELLING;
            self.push(SPELLINGS, spelling, 3);
        }
        parts
    }
}

/// The columns of an automaton.
pub(crate) fn columns(automaton: &Fst<&[u8]>) -> [Vec<u8>; COLUMNS] {
    let mut columns = Columns::default();
    let mut waiting = Vec::new();
    let mut after_letter: HashMap<u8, (u64, HashMap<usize, u64>)> = HashMap::new();
    for (number, node) in (1..).zip(minimal(automaton)) {
        let count = u8::try_from(node.transitions.len()).expect("fewer letters than 64");
        assert!(count < 64, "fewer letters than 64");
        columns.push(SHAPES, u64::from(count | if node.end.is_some() { FINAL } else { 0 }), 1);
        if let Some(end) = node.end {
            let parts = columns.push_value(end);
            columns.push(ENDS, u64::from(parts), 1);
        }
        let mut is_new = vec![false; node.transitions.len()];
        for (is_new, (.., target)) in is_new.iter_mut().zip(&node.transitions).rev() {
            *is_new = waiting.last() == Some(target);
            if *is_new {
                waiting.pop();
            }
        }
        for ((letter, value, target), is_new) in node.transitions.into_iter().zip(is_new) {
            let (length, list) = after_letter.entry(letter).or_default();
            let told = match list.get(&target) {
                _ if is_new => NEW,
                _ if target == 0 => END,
                Some(&place) if place <= u64::from(u16::MAX) => {
                    columns.push(LISTED, place, 2);
                    IS_LISTED
                }
                _ => {
                    columns.push(FAR, (number - target) as u64, 3);
                    IS_FAR
                }
            };
            if matches!(told, NEW | IS_FAR) {
                list.entry(target).or_insert(*length);
                *length += 1;
            }
            let parts = columns.push_value(value);
            columns.push(LETTERS, u64::from(letter), 1);
            columns.push(MARKS, u64::from(parts | told << TARGET_AT), 1);
        }
        waiting.push(number);
    }
    columns.columns
}

//! The automaton from a word's letters to its value, out of columns of like things, of which each packs better than all of
//! them as they stand in the file.
//!
//! Nodes come children first. A node that no node before has led to is led to by the last that needs one, so that of most
//! targets nothing need be told; of the rest, most are told by their place among all that the same letter has led to.

use std::io::{Error, Result};

use super::bytes::{number, take};

/// What a node is: the number of its transitions, and whether a word ends in it.
pub(crate) const SHAPES: usize = 0;
/// The letter of each transition.
pub(crate) const LETTERS: usize = 1;
/// Of each transition [`Target`] and, above, which parts its value has.
pub(crate) const MARKS: usize = 2;
/// Which parts the value of each end of a word has.
pub(crate) const ENDS: usize = 3;
/// Parts of values: 16 bits and 8 of where the readings begin; 20 of where the frequencies do, beside the last; 20 of where
/// a letter ё stands.
pub(crate) const READINGS_LOW: usize = 4;
pub(crate) const READINGS_HIGH: usize = 5;
pub(crate) const FREQUENCIES: usize = 6;
pub(crate) const SPELLINGS: usize = 7;
/// Targets by their places after the same letter, and by how many nodes they lie before.
pub(crate) const LISTED: usize = 8;
pub(crate) const FAR: usize = 9;
pub(crate) const COLUMNS: usize = 10;

pub(crate) const FINAL: u8 = 0x80;
pub(crate) const FREQUENCY_BITS: u32 = 20;
/// Where a value's parts begin.
pub(crate) const FREQUENCY_AT: u32 = 24;
pub(crate) const SPELLING_AT: u32 = 44;
/// The bits of a mark that tell which parts a value has; above them stands the target.
pub(crate) const HAS_READINGS: u8 = 1;
pub(crate) const HAS_FREQUENCY: u8 = 2;
pub(crate) const HAS_SPELLING: u8 = 4;
pub(crate) const TARGET_AT: u8 = 3;

/// How a transition's target is told.
pub(crate) const NEW: u8 = 0;
pub(crate) const END: u8 = 1;
pub(crate) const IS_LISTED: u8 = 2;
pub(crate) const IS_FAR: u8 = 3;

struct Transition {
    letter: u8,
    value: u64,
    /// The node's number from one on; zero is the end, which stands nowhere.
    target: usize,
}

/// The automaton in the format of the crate fst (version 3), every node in its general form.
pub(crate) fn restored(mut columns: [&[u8]; COLUMNS], keys: u64, sum: u32) -> Result<Vec<u8>> {
    const VERSION: u64 = 3;
    const KIND: u64 = 0;
    let mut file = [VERSION.to_le_bytes(), KIND.to_le_bytes()].concat();
    file.reserve(8 << 20);
    // Where each node's last byte stands.
    let mut addresses: Vec<usize> = vec![0];
    let mut waiting: Vec<usize> = Vec::new();
    let mut after_letter: Vec<Vec<usize>> = vec![Vec::new(); 256];
    let mut frequency = 0;
    let mut transitions: Vec<Transition> = Vec::new();
    while !columns[SHAPES].is_empty() {
        let shape = take(&mut columns[SHAPES], 1)?[0];
        let end = if shape & FINAL == 0 {
            None
        } else {
            let parts = take(&mut columns[ENDS], 1)?[0];
            Some(value(&mut columns, parts, &mut frequency)?)
        };
        let letters = take(&mut columns[LETTERS], usize::from(shape & !FINAL))?;
        let marks = take(&mut columns[MARKS], letters.len())?;
        let new = marks.iter().filter(|mark| *mark >> TARGET_AT == NEW).count();
        let first = waiting.len().checked_sub(new).ok_or_else(unsound)?;
        let mut fresh = waiting.drain(first..);
        transitions.clear();
        for (&letter, &mark) in letters.iter().zip(marks) {
            let list = &mut after_letter[usize::from(letter)];
            let target = match mark >> TARGET_AT {
                NEW => fresh.next().ok_or_else(unsound)?,
                END => 0,
                IS_LISTED => {
                    let place = number::<2>(&mut columns[LISTED])? as usize;
                    *list.get(place).ok_or_else(unsound)?
                }
                _ => {
                    let before = number::<3>(&mut columns[FAR])? as usize;
                    addresses.len().checked_sub(before).ok_or_else(unsound)?
                }
            };
            if matches!(mark >> TARGET_AT, NEW | IS_FAR) {
                list.push(target);
            }
            let value = value(&mut columns, mark, &mut frequency)?;
            transitions.push(Transition { letter, value, target });
        }
        drop(fresh);
        push_node(&mut file, end, &transitions, &addresses)?;
        waiting.push(addresses.len());
        addresses.push(file.len() - 1);
    }
    let root = addresses.last().copied().unwrap_or_default() as u64;
    file.extend(keys.to_le_bytes());
    file.extend(root.to_le_bytes());
    file.extend(sum.to_le_bytes());
    Ok(file)
}

fn value(columns: &mut [&[u8]; COLUMNS], parts: u8, frequency: &mut u64) -> Result<u64> {
    let mut value = 0;
    if parts & HAS_READINGS != 0 {
        value |= number::<2>(&mut columns[READINGS_LOW])?;
        value |= number::<1>(&mut columns[READINGS_HIGH])? << 16;
    }
    if parts & HAS_FREQUENCY != 0 {
        let folded = number::<3>(&mut columns[FREQUENCIES])?;
        let step = (folded >> 1) ^ (folded & 1).wrapping_neg();
        *frequency = frequency.wrapping_add(step) & ((1 << FREQUENCY_BITS) - 1);
        value |= *frequency << FREQUENCY_AT;
    }
    if parts & HAS_SPELLING != 0 {
        value |= number::<3>(&mut columns[SPELLINGS])? << SPELLING_AT;
    }
    Ok(value)
}

fn push_node(
    file: &mut Vec<u8>,
    end: Option<u64>,
    transitions: &[Transition],
    addresses: &[usize],
) -> Result<()> {
    /// From so many transitions on a node has a table of them by letter.
    const INDEXED: usize = 33;
    let start = file.len();
    let mut largest_step = 0;
    let mut largest_value = end.unwrap_or_default();
    for transition in transitions {
        largest_step = largest_step.max(step(start, transition, addresses)?);
        largest_value = largest_value.max(transition.value);
    }
    let step_bytes = bytes_of(largest_step).max(1);
    let value_bytes = bytes_of(largest_value);
    if let Some(end) = end {
        file.extend(&end.to_le_bytes()[..value_bytes]);
    }
    for transition in transitions.iter().rev() {
        file.extend(&transition.value.to_le_bytes()[..value_bytes]);
    }
    for transition in transitions.iter().rev() {
        let step = step(start, transition, addresses)?;
        file.extend(&step.to_le_bytes()[..step_bytes]);
    }
    file.extend(transitions.iter().rev().map(|transition| transition.letter));
    if transitions.len() >= INDEXED {
        let mut index = [0xff; 256];
        for (place, transition) in (0..).zip(transitions) {
            index[usize::from(transition.letter)] = place;
        }
        file.extend(index);
    }
    file.push((step_bytes << 4 | value_bytes) as u8);
    if transitions.is_empty() {
        file.push(0);
    }
    file.push(u8::from(end.is_some()) << 6 | transitions.len() as u8);
    Ok(())
}

/// How far a transition's target lies before a node that begins at `start`; zero for the end.
fn step(start: usize, transition: &Transition, addresses: &[usize]) -> Result<u64> {
    match transition.target {
        0 => Ok(0),
        target => Ok((start - addresses.get(target).ok_or_else(unsound)?) as u64),
    }
}

fn bytes_of(number: u64) -> usize {
    number.checked_ilog2().map_or(0, |bits| bits as usize / 8 + 1)
}

fn unsound() -> Error {
    Error::other("the dictionary's automaton is unsound")
}

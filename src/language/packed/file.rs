//! A dictionary file of the crate rumorph (format 8): a header of sixteen bytes, then sections, each its length in eight
//! bytes, its bytes, and zeros up to a multiple of eight.

use std::io::Result;

use super::automaton::{self, COLUMNS};
use super::bytes::{counted, number, take};

/// The length of what stands before the sections; its last four bytes are the sum of all that follows it.
pub(crate) const HEADER: usize = 16;
pub(crate) const SECTIONS: usize = 17;
pub(crate) const ALIGNMENT: usize = 8;

/// Sections that are carried otherwise than as they stand, by their places.
///
/// The automaton from a word's letters to where its readings are: its columns, the number of its words and its own sum.
pub(crate) const WORDS: usize = 10;
/// Readings, of four bytes each, a form's and a table's: the forms of all, then the tables.
pub(crate) const READINGS: usize = 11;

/// The file of what is carried of it.
pub(crate) fn restored(mut carried: &[u8]) -> Result<Vec<u8>> {
    let mut file = take(&mut carried, HEADER)?.to_vec();
    file.reserve(12 << 20);
    for section in 0..SECTIONS {
        match section {
            WORDS => {
                let mut columns = [&[][..]; COLUMNS];
                for column in &mut columns {
                    *column = counted(&mut carried)?;
                }
                let words = number::<8>(&mut carried)?;
                let sum = number::<4>(&mut carried)? as u32;
                push_section(&mut file, &automaton::restored(columns, words, sum)?);
            }
            READINGS => {
                let halves = counted(&mut carried)?;
                let (forms, tables) = halves.split_at(halves.len() / 4 * 2);
                let pairs = forms.chunks_exact(2).zip(tables.chunks_exact(2));
                let readings: Vec<u8> = pairs.flat_map(|(f, t)| [f[0], f[1], t[0], t[1]]).collect();
                push_section(&mut file, &readings);
            }
            _ => push_section(&mut file, counted(&mut carried)?),
        }
    }
    Ok(file)
}

fn push_section(file: &mut Vec<u8>, section: &[u8]) {
    file.extend_from_slice(&(section.len() as u64).to_le_bytes());
    file.extend_from_slice(section);
    file.resize(file.len().next_multiple_of(ALIGNMENT), 0);
}

//! Packs the dictionary of word forms for the program to carry.

mod automaton;
mod bytes;
mod file;
mod pack;

use std::io::Write as _;

use bytes::{counted, take};
use file::{ALIGNMENT, HEADER, READINGS, SECTIONS, WORDS};
use lzma_rust2::{LzmaOptions, LzmaWriter};

/// Sections that only guesses at words that are not in the dictionary use: an automaton of endings, their readings, a model
/// of contexts.
const ENDINGS: usize = 14;
const OF_GUESSES: [usize; 2] = [15, 16];

fn main() {
    for source in ["automaton.rs", "build.rs", "bytes.rs", "file.rs", "pack.rs"] {
        println!("cargo::rerun-if-changed={source}");
    }
    let carried = carried(rumorph_dict_ru::DICTIONARY).expect("a dictionary of format 8");
    let packed = packed(&carried).expect("memory for 10 MB");
    let out = std::env::var_os("OUT_DIR").expect("cargo names it");
    let path = std::path::Path::new(&out).join("ru.dict.lzma");
    std::fs::write(&path, packed).expect("cargo's own folder can be written to");
}

fn packed(carried: &[u8]) -> std::io::Result<Vec<u8>> {
    // What it saves is paid once a build.
    const LEVEL: u32 = 9;
    // Most of its columns are of numbers of two bytes.
    let options = LzmaOptions { lp: 1, pb: 1, nice_len: 273, ..LzmaOptions::with_preset(LEVEL) };
    let mut packed = LzmaWriter::new_use_header(Vec::new(), &options, Some(carried.len() as u64))?;
    packed.write_all(carried)?;
    packed.finish()
}

/// What [`file::restored`] makes a dictionary file of.
fn carried(mut published: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut carried = take(&mut published, HEADER)?.to_vec();
    let mut of_words = 0;
    for place in 0..SECTIONS {
        let section = counted(&mut published)?;
        take(&mut published, section.len().next_multiple_of(ALIGNMENT) - section.len())?;
        match place {
            WORDS => {
                let automaton = fst::raw::Fst::new(section).expect("an automaton");
                for column in pack::columns(&automaton) {
                    push(&mut carried, &column);
                }
                carried.extend((automaton.len() as u64).to_le_bytes());
                of_words = carried.len();
                carried.extend([0; 4]);
            }
            READINGS => {
                let halves =
                    |half: usize| section.chunks_exact(4).flat_map(move |r| [r[half], r[half + 1]]);
                push(&mut carried, &halves(0).chain(halves(2)).collect::<Vec<_>>());
            }
            ENDINGS => push(&mut carried, fst::Map::default().as_fst().as_bytes()),
            place if OF_GUESSES.contains(&place) => push(&mut carried, &[]),
            _ => push(&mut carried, section),
        }
    }
    // The sums of the automaton and of the file are known when both stand there.
    let mut restored = &file::restored(&carried)?[HEADER..];
    for _ in 0..WORDS {
        let section = counted(&mut restored)?;
        take(&mut restored, section.len().next_multiple_of(ALIGNMENT) - section.len())?;
    }
    let words = fst::raw::Fst::new(counted(&mut restored)?).expect("an automaton");
    if let Err(fst::Error::Fst(fst::raw::Error::ChecksumMismatch { got, .. })) = words.verify() {
        carried[of_words..of_words + 4].copy_from_slice(&got.to_le_bytes());
    }
    let sum = crc32fast::hash(&file::restored(&carried)?[HEADER..]);
    carried[HEADER - 4..HEADER].copy_from_slice(&sum.to_le_bytes());
    Ok(carried)
}

fn push(carried: &mut Vec<u8>, bytes: &[u8]) {
    carried.extend((bytes.len() as u64).to_le_bytes());
    carried.extend_from_slice(bytes);
}

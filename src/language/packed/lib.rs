//! The dictionary of Russian word forms, carried packed: 16 MB less of a program.
//!
//! What is carried is the published dictionary without what guesses at words that it does not have, which nobody here asks
//! for: its automaton of words with equal ends told once, laid out in columns (`automaton`), and compressed.

use std::io::{Read as _, Result};

use lzma_rust2::LzmaReader;

mod automaton;
mod bytes;
mod file;

/// The dictionary as a file of the crate rumorph.
///
/// # Errors
///
/// What the decoder says of bytes that are none of its.
pub fn unpacked() -> Result<Vec<u8>> {
    const PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/ru.dict.lzma"));
    let mut carried = Vec::new();
    LzmaReader::new_mem_limit(PACKED, u32::MAX, None)?.read_to_end(&mut carried)?;
    file::restored(&carried)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use fst::Streamer as _;
    use rumorph::{Analysis, Dictionary, Source};

    use super::bytes::{counted, take};
    use super::file::{ALIGNMENT, HEADER, SECTIONS, WORDS};

    fn sections(mut file: &[u8]) -> Vec<&[u8]> {
        take(&mut file, HEADER).expect("a header");
        let mut section = || {
            let section = counted(&mut file).expect("a whole section");
            let zeros = section.len().next_multiple_of(ALIGNMENT) - section.len();
            take(&mut file, zeros).expect("what fills it up");
            section
        };
        (0..SECTIONS).map(|_| section()).collect()
    }

    #[test]
    fn what_is_carried_is_the_dictionary_as_it_was_published_but_for_its_guesses() {
        let unpacked = super::unpacked().expect("a whole frame");
        let (ours, published) = (sections(&unpacked), sections(rumorph_dict_ru::DICTIONARY));
        let differ = (0..SECTIONS).filter(|&place| ours[place] != published[place]);
        // Beside the automaton of words that of endings, their readings and the model of contexts.
        assert_eq!(differ.collect::<Vec<_>>(), [WORDS, 14, 15, 16]);

        let automaton = fst::Map::new(ours[WORDS]).expect("an automaton");
        automaton.as_fst().verify().expect("its own sum");
        let published = fst::Map::new(published[WORDS]).expect("an automaton");
        let (mut ours, mut theirs) = (automaton.stream(), published.stream());
        let mut words = 0;
        while let Some(word) = theirs.next() {
            assert_eq!(ours.next(), Some(word));
            words += 1;
        }
        assert!(ours.next().is_none());
        assert_eq!(words, automaton.len());
    }

    #[test]
    fn words_have_the_readings_that_the_published_dictionary_knows() {
        let ours = Dictionary::from_bytes(&super::unpacked().expect("a whole frame"));
        let ours = ours.expect("a dictionary");
        let published = Dictionary::bundled().expect("a dictionary");
        let known = |dictionary: &Dictionary, word: &str| -> Vec<Analysis> {
            let readings = dictionary.analyze(word).into_iter();
            readings.filter(|reading| reading.source == Source::Dictionary).collect()
        };
        let words = include_str!("../words/lexicon.txt").split_whitespace().chain([
            "пень",
            "пня",
            "актёр",
            "актер",
            "стали",
            "ещё",
            "еще",
            "совершенного",
            "Ивановой",
            "стола-1",
            "квазистол",
            "ыыы",
        ]);
        let mut read = BTreeMap::new();
        for word in words {
            let readings = known(&published, word);
            assert_eq!(known(&ours, word), readings, "{word}");
            read.insert(word, readings.len());
        }
        assert!(read["стали"] > 1 && read["пня"] > 0 && read["ыыы"] == 0);
    }
}

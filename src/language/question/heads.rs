//! Words that are only the ends of names: «шкаф» on a map of bookcases («книжный шкаф») and cabinets.
//!
//! Invariant: such a word means whatever the language calls so, and not the one sort alone whose name ends with it.

use super::lexicon::{Extension, KindId, Lexicon, Meaning};
use crate::units::name_key;
use crate::words::{NounPhrase, Spelling, WordHints, english};

impl Lexicon {
    /// Words of the language that end the names of some kinds and are none themselves, where their English is the name of
    /// others: each means all of these.
    pub(super) fn add_heads(&mut self) {
        let mut found: Vec<(&str, Vec<KindId>)> = Vec::new();
        for (word, translated) in english::nouns() {
            let ended = self.ended_by(word);
            let new = |id: &KindId| {
                let kind = self.kind(*id);
                let called = |own: &String| name_key(own) == name_key(&kind.english);
                let is_ended = |e: &KindId| self.kind(*e).extension == kind.extension;
                translated.iter().any(called) && !ended.iter().any(is_ended)
            };
            let types = (0..self.kinds.len()).filter_map(|n| u16::try_from(n).ok()).map(KindId);
            let types = types.filter(|id| !ended.is_empty() && self.is_type(*id));
            let mut all: Vec<KindId> = types.filter(new).collect();
            if !all.is_empty() {
                all.extend(ended);
                found.push((word, all));
            }
        }
        for (word, kinds) in found {
            let general = NounPhrase::parse(word, &WordHints::default());
            for kind in kinds {
                let (extension, english) =
                    (self.kind(kind).extension, self.kind(kind).english.clone());
                let id = self.push(extension, general.clone(), &english);
                self.nouns.insert(&general, Meaning::Kind(id));
            }
        }
    }

    /// The types whose names a word ends; none where it is a name itself.
    fn ended_by(&self, word: &str) -> Vec<KindId> {
        let hits = self.nouns.find(word);
        if hits.iter().any(|hit| hit.spelling != Spelling::Part) {
            return Vec::new();
        }
        let types = hits.iter().filter_map(|hit| match hit.id {
            Meaning::Kind(id) if self.is_type(*id) => Some(*id),
            _ => None,
        });
        types.collect()
    }

    fn is_type(&self, id: KindId) -> bool {
        matches!(self.kind(id).extension, Extension::ObjectType(_))
    }
}

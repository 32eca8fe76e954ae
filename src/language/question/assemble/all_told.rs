//! All of those that were told, where "all" stands without its noun: «Все ли открыты?», "Are all open?"
//!
//! Invariant: it means what was told, and never all that there is; that is "everything".

use super::{Frame, Referent, Subject, things};
use crate::question::mark::{Mark, Pronoun};
use crate::question::query::Noun;
use crate::question::{Doubt, vocabulary};
use crate::sets::set;

impl Frame<'_, '_> {
    /// «Все ли открыты?», "Are all open?": of all those that were told; "everything" is all that there is.
    pub(super) fn all_of_those_told(
        &mut self,
        at: usize,
        referent: &Referent<'_>,
    ) -> Result<(), Doubt> {
        let bare = self.nouns.is_empty() && self.spots.is_empty() && self.property.is_none();
        let claims = self.has(Mark::All) && bare && !self.values.is_empty();
        let asks = |(mark, _): &(Mark, usize)| mark.asks() || matches!(mark, Mark::List);
        if !claims || self.marks.iter().any(asks) || self.says_everything() {
            return Ok(());
        }
        let keys = &self.sentence.keys;
        let is_all = |n: &usize| matches!(vocabulary::longest(&keys[*n..]), Some((_, Mark::All)));
        let said = (0..keys.len()).find(is_all);
        let word = said.map_or("", |n| self.sentence.said(&(n..n + 1)));
        let meant = referent(Pronoun::They, None);
        if meant.is_empty() {
            return Err(Doubt::NoReferent { word: word.to_owned() });
        }
        let noun = Noun { all: true, ..things(meant, word) };
        self.nouns.push(Subject { noun, at, negated: false, nominative: true });
        Ok(())
    }

    /// "Is everything shut?", «Всё закрыто?»: by the word itself, or by the neuter of what is claimed.
    fn says_everything(&self) -> bool {
        let (keys, text) = (&self.sentence.keys, self.sentence.text);
        let claimed = |key: &str| self.lexicon.values.meaning(key).is_some();
        keys.iter().zip(&self.sentence.words).any(|(key, word)| {
            let whole = set!("Everything").contains(&key.as_str());
            whole && (key.is_ascii() || text[word.clone()].contains(['ё', 'Ё']))
                || key.ends_with('о') && claimed(key)
        })
    }
}

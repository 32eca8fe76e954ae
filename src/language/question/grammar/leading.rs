//! What leads somewhere is a door: "the other one that leads to the bedroom", «та, что ведёт в гостиную».
//!
//! Invariant: only a word that stands for a noun becomes one, and only by a clause behind it.

use super::pointing::stands_for_one;
use super::{Found, Sentence, Tok, Token};
use crate::question::lexicon::{Extension, Lexicon};
use crate::question::mark::{Mark, Pronoun};
use crate::question::numbered::genders;
use crate::sets::set;
use crate::words::Language;

impl Sentence<'_> {
    /// Puts a door, or a passage where a Russian word is masculine, for what a clause says to lead somewhere.
    pub(super) fn tell_openings(&mut self, lexicon: &Lexicon) {
        let leads = |two: &[Token]| {
            two[0].kind == Tok::Mark(Mark::Lead) && matches!(two[1].kind, Tok::Mark(Mark::Link(_)))
        };
        let Some(lead) = self.tokens.windows(2).position(leads) else { return };
        let verb = self.tokens[lead].from as usize;
        let begins = match verb.checked_sub(1).map(|before| self.keys[before].as_str()) {
            Some(before) if set!("RelativeWord").contains(&before) => verb - 1,
            _ if set!("LeadingWord").contains(&self.keys[verb].as_str()) => verb,
            _ => return,
        };
        let Some(at) = self.tokens.iter().rposition(|token| token.to as usize <= begins) else {
            return;
        };
        let head = self.tokens[at];
        let word = self.keys[head.to as usize - 1].as_str();
        let parted = self.language == Language::English || self.comma_between(begins, begins);
        let stands = match head.kind {
            Tok::Mark(Mark::One) => !set!("SeveralOnes").contains(&word),
            Tok::Mark(Mark::Other) => stands_for_one(word),
            _ => false,
        };
        if head.to as usize != begins || !stands || !parted {
            return;
        }
        let genders = genders(&self.keys[head.to as usize - 1..head.to as usize]);
        let extension = match &genders[..] {
            [Pronoun::He] => Extension::Passages,
            all if all.is_empty() || all.contains(&Pronoun::She) => Extension::Doors,
            _ => return,
        };
        let Some(kind) = lexicon.kind_of(&extension) else { return };
        let kinds = lexicon.with_narrower(kind, self.language);
        self.nouns.push(Found { kinds, is_general: true, ..Found::default() });
        let noun = Token { kind: Tok::Noun(self.nouns.len() as u32 - 1), ..head };
        match head.kind {
            Tok::Mark(Mark::One) => self.tokens[at] = noun,
            _ => self.tokens.insert(at + 1, noun),
        }
    }
}

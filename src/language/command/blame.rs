//! What stands in the way of a command, and the words that it is laid to.

use std::collections::HashSet;
use std::hash::Hash;
use std::ops::Range;

use super::Misheard;
use super::assemble::Reader;
use super::clauses::Clause;
use super::grammar::{Argument, Reference};
use super::vocabulary::verbs;
use crate::units::{OwnText, Source, nearest_name};
use crate::words::{Language, word_keys};

impl<T: Clone + Eq + Hash> Reader<'_, '_, T> {
    pub(super) fn unknown(&self, argument: &Argument<'_, T>) -> Misheard {
        let (reference, at) = self.shown(&argument.words);
        let index = self.listener.index;
        let mut near: Vec<String> = index.near(&reference, 3).into_iter().map(Into::into).collect();
        if let (true, Some((_, last))) = (near.is_empty(), reference.rsplit_once(' ')) {
            near = index.near(last, 3).into_iter().map(Into::into).collect();
        }
        let mut told = HashSet::new();
        near.retain(|name| is_alike(name, &reference) && told.insert(name.clone()));
        Misheard::UnknownName { reference, near, text: self.source(), at }
    }

    /// A sentence without a verb: the first strange word is to blame, and else the thing named with nothing to do.
    pub(super) fn no_verb(&self, clause: &Clause<'_, '_, T>) -> Misheard {
        let strange = clause.before.iter().find(|a| matches!(a.reference, Reference::Unknown));
        match strange.or(clause.before.first()) {
            Some(argument) if matches!(argument.reference, Reference::Unknown) => {
                let first = argument.words.start..argument.words.start + 1;
                let (word, _) = self.shown(&first);
                let hint = nearest_name(&word, verbs()).map_or_else(
                    || "начните с того, что сделать: «Принеси …», «Поезжай в …», «Открой …»".into(),
                    |verb| format!("может быть, «{verb}»?"),
                );
                self.not_understood(&first, hint)
            }
            Some(argument) => {
                self.incomplete(&argument.words, ("что с этим сделать", "what to do with it"))
            }
            None => self.incomplete(&(0..self.sentence.words.len()), ("что сделать", "what to do")),
        }
    }

    pub(super) fn unable(&self, words: &Range<usize>) -> Misheard {
        let (word, at) = self.shown(words);
        Misheard::Unable { word, text: self.source(), at }
    }

    pub(super) fn not_understood(&self, words: &Range<usize>, hint: String) -> Misheard {
        let (word, at) = self.shown(words);
        Misheard::NotUnderstood { word, hint, text: self.source(), at }
    }

    pub(super) fn incomplete(
        &self,
        words: &Range<usize>,
        (question, english): (&'static str, &'static str),
    ) -> Misheard {
        let (_, at) = self.shown(words);
        Misheard::Incomplete { question, english, text: self.source(), at }
    }

    pub(super) fn shown(&self, words: &Range<usize>) -> (String, miette::SourceSpan) {
        let span = self.sentence.span(words);
        (self.sentence.text[span.clone()].to_owned(), (span.start, span.len()).into())
    }

    pub(super) fn source(&self) -> Source {
        Source::own(OwnText::Order, self.sentence.text)
    }
}

/// Whether a word of a name is like one of a reference in its letters: what a name is found by besides may be anything.
/// Names in other letters cannot be compared.
fn is_alike(name: &str, reference: &str) -> bool {
    /// Of letters, and no meaning, from 0 to 1: «вилку» is no «миска» (0.6), «чашку» is «чашка» (0.8).
    const ALIKE: f64 = 0.7;
    let (names, said) = (word_keys(name), word_keys(reference));
    let like =
        |a: &String| said.iter().any(|b| strsim::normalized_damerau_levenshtein(a, b) >= ALIKE);
    Language::of(name) != Language::of(reference) || names.iter().any(like)
}

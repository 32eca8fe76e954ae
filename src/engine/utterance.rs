//! What is said in one breath: its orders and questions, all of which are read before the first is carried out.

use crate::language::Language;
use crate::language::command::Misheard;
use crate::language::question::{Doubt, Memory, Unanswered, conditional};

use crate::units::told;

use super::{Error, State};

impl State {
    /// The orders and questions of a text, to be heard one after the other; none where it is one or the other. A part
    /// that begins with the verb of an order is an order.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub fn parts_of(&self, text: &str, memory: &Memory) -> Result<Option<Vec<String>>, Error> {
        if conditional(text).is_some() {
            return Ok(None);
        }
        let Some(sentences) = self.sentences_that_order_and_ask(text)? else {
            return self.orders_and_questions(text, memory);
        };
        let mut parts = Vec::new();
        for sentence in sentences {
            match self.orders_and_questions(&sentence, memory)? {
                Some(more) => parts.extend(more),
                None => parts.push(sentence),
            }
        }
        Ok(Some(parts))
    }

    /// Reads all parts of an utterance, so that none is begun where another cannot be followed. What is asked behind
    /// an order is answered after it: which of several is meant, and what is above, may differ then.
    ///
    /// # Errors
    /// Which part is not understood, or names what the map lacks, and why.
    pub fn read_ahead(&self, parts: &[String], memory: &Memory) -> Result<(), Error> {
        let mut after = memory.clone();
        let mut ordered = false;
        for (n, part) in parts.iter().enumerate() {
            if self.is_command(part)? {
                match self.understand_in(part, &mut after) {
                    Ok(_) => {}
                    // Nothing is begun before it or behind it: one may ask back.
                    Err(Error::Misheard(Misheard::WhichOf(_) | Misheard::Ambiguous { .. }))
                        if !ordered && n + 1 == parts.len() => {}
                    Err(error) => return Err(error),
                }
                ordered = true;
                continue;
            }
            let Err(unanswered) = self.ask(part, &mut after)? else { continue };
            let later = matches!(
                unanswered.doubt,
                Doubt::Ambiguous { .. } | Doubt::TooFew { .. } | Doubt::NoStorey { .. }
            );
            let verb_behind = || self.understand_in(part, &mut after.clone()).is_ok();
            if (ordered && later) || (n + 1 == parts.len() && !ordered) || verb_behind() {
                continue;
            }
            return Err(Misheard::NoneSuch(Box::new(not_begun(part, unanswered))).into());
        }
        Ok(())
    }
}

fn not_begun(part: &str, unanswered: Unanswered) -> Unanswered {
    let why = &unanswered.text;
    let text = told!(Language::of(part), "nothing-was-begun", part, why);
    Unanswered { text, ..unanswered }
}

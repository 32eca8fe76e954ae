//! Orders that are told and wait for a yes, since it is not sure that they are meant.

use crate::language::Language;
use crate::language::command::is_order;
use crate::language::question::{Conditional, Unanswered};
use crate::units::told;

use super::{Error, Hearing, Outcome, Reply};

impl Hearing<'_, '_> {
    /// "If there is a banana, bring it, otherwise bring an apple": that the map has none is no proof that there is none, so
    /// that the other order waits for a yes.
    pub(super) fn condition_unknown(
        &mut self,
        conditional: &Conditional,
        unanswered: Unanswered,
    ) -> Result<(), Error> {
        let lacks = unanswered.doubt.kind() == "unknown" && unanswered.names.is_empty();
        let lacks = lacks && !conditional.waits && !conditional.denies();
        let Some(order) = conditional.otherwise.clone().filter(|_| lacks) else {
            return self.reply(Reply::unanswered(unanswered));
        };
        self.offer(order, &unanswered.text, unanswered.language)
    }

    /// "Wash up: carry the plates to the sink": a heading may mean more than the order behind it, which waits for a yes where
    /// the heading is not understood.
    pub(super) fn headed(&mut self, line: &str) -> Result<bool, Error> {
        let Some((heading, order)) = line.split_once(": ") else { return Ok(false) };
        let memory = &self.dialogue.memory;
        let heard = |text: &str| self.engine.understand_in(text, &mut memory.clone());
        if !is_order(order)
            || heard(order).is_err()
            || heard(line).is_ok()
            || heard(heading).is_ok()
        {
            return Ok(false);
        }
        let Err(unanswered) = self.engine.ask(heading, &mut memory.clone())? else {
            return Ok(false);
        };
        self.offer(order.to_owned(), &unanswered.text, unanswered.language)?;
        Ok(true)
    }

    /// An order that waits for a yes, behind the reason why.
    pub(super) fn offer(
        &mut self,
        order: String,
        told: &str,
        language: Language,
    ) -> Result<(), Error> {
        let text = told!(language, "shall-i-do-this", told, order);
        self.dialogue.offered = Some(order.clone());
        self.put(Outcome::Offered { order }, &text, language)
    }
}

//! Orders that are told and wait for a yes, since it is not sure that they are meant; questions that may have been.

use crate::language::command::{Command, Misheard, is_order};
use crate::language::question::{Aside, Conditional, Doubt, Unanswered, rank_alone};
use crate::language::{Language, word_ranges};
use crate::units::{capitalized, told};

use super::{Dialogue, Engine, Error, Hearing, Outcome, Reply};

/// What may have been meant, and waits for a yes.
#[derive(Debug, Clone)]
pub(super) enum Offered {
    Order(String),
    /// The likeliest first.
    Questions(Vec<String>),
}

/// The question that a line chooses of those that were offered: yes to the only one, or its number.
pub(super) fn chosen(line: &str, said: Option<Aside>, offered: &[String]) -> Option<String> {
    match (offered, said) {
        ([only], Some(Aside::Yes)) => Some(only.clone()),
        _ => offered.get(rank_alone(line)?.checked_sub(1)?).cloned(),
    }
}

impl Dialogue {
    /// What is said where a question is not understood: why, and the questions near to it that have an answer, which then
    /// wait for a yes.
    pub(super) fn offer_questions(
        &mut self,
        engine: &Engine,
        line: &str,
        unanswered: Unanswered,
    ) -> Result<Reply, Error> {
        let offers = match &unanswered.doubt {
            Doubt::NotUnderstood { .. } | Doubt::Unheeded { .. } => {
                engine.questions_near(line, true, &mut self.memory)?
            }
            // Of what the map lacks nothing else is asked, but in an aside.
            Doubt::Unknown { .. } | Doubt::NoReferent { .. } | Doubt::Windows => {
                engine.questions_near(line, false, &mut self.memory)?
            }
            _ => Vec::new(),
        };
        self.offered = (!offers.is_empty()).then(|| Offered::Questions(offers.clone()));
        Ok(Reply::unanswered(unanswered.offering(offers)))
    }
}

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

    /// «Включи стиралку, я забыла»: the order within a line of which a part is not understood waits for a yes, and a question
    /// within it is answered or offered; whether there is either.
    pub(super) fn offer_core(
        &mut self,
        line: &str,
        error: &Error,
        language: Language,
    ) -> Result<bool, Error> {
        let is_unheard = matches!(
            error,
            Error::Misheard(Misheard::UnknownName { .. } | Misheard::NotUnderstood { .. })
        );
        if !is_unheard {
            return Ok(false);
        }
        let memory = &self.dialogue.memory;
        // What is left of a few words may be anything.
        let said = word_ranges(line).len();
        let does = |core: &str| {
            let heard = self.engine.understand_in(core, &mut memory.clone());
            word_ranges(core).len() * 2 >= said
                && (is_order(core) || self.engine.is_command(core).unwrap_or(false))
                && heard.is_ok_and(|commands| !commands.contains(&Command::Stop))
        };
        let cores = self.engine.cores(line)?;
        if let Some((core, rest)) = cores.into_iter().find(|(core, _)| does(core)) {
            let told = told!(language, "i-do-not-understand-the-rest", rest);
            self.offer(capitalized(core), &told, language)?;
            return Ok(true);
        }
        // "Are the lamps on? I can't remember if I switched them off"
        let asks = self.engine.question_within(line, &mut memory.clone())?.is_some();
        if asks {
            self.ask(line)?;
        }
        Ok(asks)
    }

    /// An order that waits for a yes, behind the reason why.
    pub(super) fn offer(
        &mut self,
        order: String,
        told: &str,
        language: Language,
    ) -> Result<(), Error> {
        let text = told!(language, "shall-i-do-this", told, order);
        self.dialogue.offered = Some(Offered::Order(order.clone()));
        self.put(Outcome::Offered { order }, &text, language)
    }
}

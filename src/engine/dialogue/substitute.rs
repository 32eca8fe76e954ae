//! An order for what is not there, met by the nearest that is: offered, and carried out only when the person agrees.
//!
//! **Invariant**: what is offered has been carried out in a simulated world that nobody keeps, and speaks of the substitute.

use crate::engine::Error;
use crate::language::command::Misheard;
use crate::language::question::{Doubt, Noun};
use crate::language::{Case, Language, word_ranges};
use crate::map::Entity;
use crate::units::{ReplicaId, name_key, told};

use super::super::lexicon::named;
use super::{Hearing, Outcome};

/// So many substitutes are tried.
const MOST_TRIED: usize = 6;

impl Hearing<'_, '_> {
    /// Offers what comes nearest to what an order asks for in vain; whether there is any.
    pub(super) fn offer_nearest(
        &mut self,
        line: &str,
        error: &Error,
        language: Language,
    ) -> Result<bool, Error> {
        let Error::Misheard(Misheard::NoneSuch(unanswered)) = error else { return Ok(false) };
        let Doubt::NoneSuch { noun } = &unanswered.doubt else { return Ok(false) };
        let nearest = self.engine.substitutes(noun, language)?;
        for substitute in nearest.into_iter().take(MOST_TRIED) {
            let Some(order) = self.with_substitute(line, noun, substitute, language)? else {
                continue;
            };
            let name = named(self.engine.world()?, Entity::Replica(substitute));
            let name = name.form(Case::Nominative, language);
            let none = unanswered.text.trim_end_matches('.');
            let text = told!(language, "would-serve-shall-i-do", none, name, order);
            self.dialogue.offered = Some(super::Offered::Order(order.clone()));
            self.put(Outcome::Offered { order }, &text, language)?;
            return Ok(true);
        }
        Ok(false)
    }

    /// The order with a thing in the place of what it describes, where that can be carried out.
    fn with_substitute(
        &self,
        line: &str,
        noun: &Noun,
        substitute: ReplicaId,
        language: Language,
    ) -> Result<Option<String>, Error> {
        let words = word_ranges(line);
        let key = |range: &std::ops::Range<usize>| name_key(&line[range.clone()]);
        let keys: Vec<String> = words.iter().map(key).collect();
        let head: Vec<String> = word_ranges(&noun.text)
            .iter()
            .map(|range| name_key(&noun.text[range.clone()]))
            .collect();
        let at = keys.windows(head.len().max(1)).rposition(|row| *row == head[..]);
        let Some(at) = at.filter(|_| !head.is_empty()) else { return Ok(None) };
        let end = words[at + head.len() - 1].end;
        let world = self.engine.world()?;
        let name = named(world, Entity::Replica(substitute));
        // It stands as what is done something with. What is said of it before its noun goes with that, as far as the
        // order has a sense then.
        let cases = [Case::Accusative, Case::Nominative];
        let forms = cases.map(|case| name.form(case, language));
        for (first, name) in (0..=at).rev().flat_map(|first| forms.iter().map(move |f| (first, f)))
        {
            let order = format!("{}{name}{}", &line[..words[first].start], &line[end..]);
            let mut memory = self.dialogue.memory.clone();
            let Ok(commands) = self.engine.understand_in(&order, &mut memory) else { continue };
            let speaks = commands
                .iter()
                .any(|c| c.what().is_some_and(|what| what.id == Entity::Replica(substitute)));
            if !speaks {
                continue;
            }
            let mut robot = self.engine.simulator(None)?;
            let stop = &self.dialogue.stop;
            let task = self.engine.carry_out_with(&commands, &mut robot, &mut |_| {}, stop);
            let is_done = task.is_ok_and(|task| task.ending.is_done());
            return Ok(is_done.then_some(order));
        }
        Ok(None)
    }
}

//! What is given as a task alone: an order, or several, and nothing that is only asked.

use crate::engine::Error;
use crate::language::command::{has_verb, in_time, is_order, waiting};
use crate::language::question::{Corrected, conditional, unaddressed};

use super::{Event, Given, Hearing, Outcome};

impl Hearing<'_, '_> {
    pub(super) fn order(&mut self, task: &str) -> Result<(), Error> {
        if let Some(said) = waiting(&unaddressed(task))
            && self.of_waiting(said, false, self.dialogue.language)?
        {
            return Ok(());
        }
        match self.engine.corrected(task, &self.dialogue.memory)? {
            Some(Corrected::Meant(meant)) => return self.order(&meant),
            Some(Corrected::Cancelled) => return self.stop(true, self.dialogue.language),
            Some(Corrected::Unclear(_)) => return self.one_order(task),
            None => {}
        }
        let task = &*unaddressed(task);
        let parts = match self.engine.parts_of(task, &self.dialogue.memory)? {
            // «Проверь, открыт ли холодильник» orders nothing but an answer.
            Some(parts) if parts.len() == 1 => return self.ask(&parts[0]),
            None if !self.engine.is_command(task)?
                && self.engine.asks_something(task)?
                && !self.ends_in_an_order(task) =>
            {
                return self.ask(task);
            }
            Some(parts) if parts.len() > 1 => {
                if let Err(error) = self.engine.read_ahead(&parts, &self.dialogue.memory) {
                    return self.refuse(error, self.dialogue.language);
                }
                parts
            }
            _ => vec![task.to_owned()],
        };
        for part in &parts {
            let orders = parts.len() == 1 || self.engine.is_command(part)?;
            match (orders, self.has_failed()) {
                // What is asked may speak of where the robot was sent.
                (false, _) => self.ask(part)?,
                (true, true) => self.not_begun(part)?,
                (true, false) => self.one_order(part)?,
            }
        }
        Ok(())
    }

    /// «Все подушки с кровати положи на диван»: a question may begin so, and this orders.
    fn ends_in_an_order(&self, task: &str) -> bool {
        let heard = || self.engine.understand_in(task, &mut self.dialogue.memory.clone());
        has_verb(task) && !task.contains('?') && heard().is_ok()
    }

    fn one_order(&mut self, order: &str) -> Result<(), Error> {
        let language = self.dialogue.language;
        let in_order =
            in_time(order, &self.engine.rules.paraphrases()).filter(|order| is_order(order));
        let order = in_order.as_deref().unwrap_or(order);
        let mut idle = None;
        if let Some(conditional) = conditional(order)
            && let Ok((holds, answer)) =
                self.engine.holds(&conditional, &mut self.dialogue.memory.clone())?
        {
            let (text, spoken) = (answer.text.clone(), answer.language);
            self.put(Outcome::Condition { holds, answer: Box::new(answer) }, &text, spoken)?;
            let then = if holds { &conditional.then } else { &conditional.otherwise };
            let nothing =
                [then, &conditional.first, &conditional.also].iter().all(|order| order.is_none());
            idle = nothing.then(|| conditional.undone());
        }
        if idle.is_none() {
            (self.tell)(self.engine, &Event::Ordered(order));
        }
        let commands = match self.engine.understand_in(order, &mut self.dialogue.memory) {
            Ok(commands) => commands,
            Err(error) => return self.refuse(error, language),
        };
        match idle {
            Some(text) => {
                let task = self.engine.carry_out(&commands, &mut |_| {})?;
                self.done(order, task, Some(text), language)
            }
            None => self.carry_out(order, &commands, &Given::Now, language),
        }
    }
}

//! One order of a dialogue: understood, asked back, or carried out.

use crate::engine::Error;
use crate::engine::task::thing_of;
use crate::language::Language;
use crate::language::command::{Command, Misheard};
use crate::language::question::{Conditional, Thing, hinged};
use crate::map::Entity;
use crate::units::told;

use super::{Event, Given, Hearing, Outcome};

impl Hearing<'_, '_> {
    /// Does what a line orders; an order that asked back, which this does not answer, is left.
    pub(super) fn command(&mut self, line: &str, awaited: bool) -> Result<(), Error> {
        let candidates = self.dialogue.memory.asked_about().to_vec();
        let answers = |command: &Command<Entity>| match command {
            Command::Stop => true,
            other => thing_of(other).is_some_and(|id| candidates.contains(&Thing::Entity(id))),
        };
        let heard = self.engine.understand_in(line, &mut self.dialogue.memory.clone());
        if !heard.is_ok_and(|commands| commands.iter().any(answers)) {
            self.leave_order()?;
        }
        self.obey(line, awaited)
    }

    /// An order that asked back is done no more.
    pub(super) fn leave_order(&mut self) -> Result<(), Error> {
        let asked = !self.dialogue.memory.asked_about().is_empty();
        match self.dialogue.open.take().filter(|_| asked) {
            Some(order) => self.not_begun(&order),
            None => Ok(()),
        }
    }

    pub(super) fn obey(&mut self, line: &str, awaited: bool) -> Result<(), Error> {
        let language = Language::of(line);
        if let Some(hinged) = hinged(line)
            && let Some(so) = self.dialogue.memory.is_so()
            && hinged.given(so).is_none()
        {
            return self.put(Outcome::Waiting, Conditional::nothing_to_do(language), language);
        }
        (self.tell)(self.engine, &Event::Ordered(line));
        let commands = match self.engine.understand_in(line, &mut self.dialogue.memory) {
            Ok(commands) => commands,
            Err(error) => {
                // "Put it back" means what this line spoke of, and nothing that was spoken of before.
                let asks_back = matches!(
                    &error,
                    Error::Misheard(Misheard::WhichOf(_) | Misheard::Ambiguous { .. })
                );
                self.dialogue.memory.mishear();
                if asks_back {
                    self.dialogue.open = Some(line.to_owned());
                } else {
                    self.engine.hear_of(line, &mut self.dialogue.memory)?;
                }
                let is_offered = self.offer_nearest(line, &error, language)?
                    || self.offer_core(line, &error, language)?;
                return match is_offered {
                    true => Ok(()),
                    false => self.refuse_order(line, error, language),
                };
            }
        };
        match &commands[..] {
            // "Never mind the plates, where are the forks?"
            [Command::Stop] if let Some(asked) = asked_behind(line) => {
                if awaited {
                    self.stop(awaited, language)?;
                }
                self.hear_one(asked, false)
            }
            [Command::Stop] => self.stop(awaited, language),
            [Command::Wait] => {
                self.put(Outcome::Waiting, &told!(language, "i-am-waiting"), language)
            }
            [Command::ComeBack] => {
                self.put(Outcome::NeverLeft, &told!(language, "i-never-left"), language)
            }
            [Command::Report] => {
                let asked = told!(language, "where-are-you");
                let text = match self.engine.ask(&asked, &mut self.dialogue.memory)? {
                    Ok(answer) => answer.text,
                    Err(unanswered) => unanswered.text,
                };
                self.put(Outcome::Reported, &text, language)
            }
            _ => self.carry_out(line, &commands, &Given::Now, language),
        }
    }
}

/// What is asked behind words that stop: "Never mind the plates, where are the forks?"
fn asked_behind(line: &str) -> Option<&str> {
    let (_, behind) = line.split_once([',', '.', ';', '!', '–', '—'])?;
    Some(behind.trim()).filter(|behind| behind.ends_with('?'))
}

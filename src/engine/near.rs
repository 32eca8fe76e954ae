//! What may have been asked where a line was not understood, to be offered: a question within it, one in its words, or what it
//! asks without its slips of the pen.

use crate::language::question::{Memory, Query, Said};
use crate::meaning;
use crate::units::capitalized;

use super::talk::RobotSenses;
use super::{Error, State};

impl State {
    /// Questions in words of a text that was not understood, which have an answer: see [`meaning::Grammar::near`]. `broken`:
    /// within what asks words may be left out as well.
    ///
    /// # Errors
    /// As [`State::ask`].
    pub(super) fn questions_near(
        &self,
        text: &str,
        broken: bool,
        memory: &mut Memory,
    ) -> Result<Vec<String>, Error> {
        const MOST: usize = 2;
        if let Some((question, _)) = self.question_within(text, memory)? {
            return Ok(vec![question]);
        }
        let now = self.around()?;
        let (world, relations, lexicon) = (now.world(), now.relations()?, &now.mind().lexicon);
        let map = meaning::Map { world, relations, lexicon, words: now.words() };
        let mut found: Vec<(String, Query)> = Vec::new();
        for question in now.rules.grammar().near(&map, text, broken) {
            let Some(query) = self.known(&question, Memory::default())? else { continue };
            // Another way to ask the same is no other question.
            if found.iter().all(|(_, other)| *other != query) {
                found.push((question, query));
            }
            if found.len() == MOST {
                break;
            }
        }
        if found.is_empty() {
            found.extend(self.question_respelt(text, memory)?);
        }
        Ok(found.into_iter().map(|(question, _)| question).collect())
    }

    /// What a line asks without a part of it that is not understood. `memory` then knows what stands before.
    pub(super) fn question_within(
        &self,
        text: &str,
        memory: &mut Memory,
    ) -> Result<Option<(String, Query)>, Error> {
        let senses = RobotSenses { engine: self };
        let asker = self.asker(&senses)?;
        for (told, asked) in asker.asked_within(text) {
            let mut heard = Memory::default();
            asker.hear_of(told, &mut heard);
            if !asker.asks_of_something(asked) || asker.read(asked, &heard).is_err() {
                continue;
            }
            if let Some(query) = self.known(asked, heard)? {
                asker.hear_of(told, memory);
                return Ok(Some((capitalized(asked), query)));
            }
        }
        Ok(None)
    }

    /// What a line asks, whole or in part, if what may be slips of the pen in it are such.
    fn question_respelt(
        &self,
        text: &str,
        memory: &mut Memory,
    ) -> Result<Option<(String, Query)>, Error> {
        let senses = RobotSenses { engine: self };
        let asker = self.asker(&senses)?;
        let Some(respelt) = asker.perhaps_respelt(text) else { return Ok(None) };
        if asker.read(&respelt, &Memory::default()).is_err() {
            return self.question_within(&respelt, memory);
        }
        let query = self.known(&respelt, Memory::default())?;
        Ok(query.map(|query| (capitalized(&respelt), query)))
    }

    /// The query of a question that the map has an answer to.
    fn known(&self, question: &str, mut memory: Memory) -> Result<Option<Query>, Error> {
        let answer = self.ask(question, &mut memory)?;
        let answer = answer.ok().filter(|answer| answer.said != Said::Unknown);
        Ok(answer.map(|answer| answer.query))
    }
}

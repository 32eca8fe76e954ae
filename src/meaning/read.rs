//! From a sentence to its readings, and from these to the one answer that they give, if they give one.

use super::chart::Chart;
use super::cover::readings;
use super::grammar::Grammar;
use super::outcome::{Answer, NoAnswer, Outcome, Reading};
use super::query::{Asking, Rows};
use super::words::{Map, Sentence, tokens};
use crate::language::Language;

/// Readings that cost so much more than the cheapest are meant by nobody.
pub const MARGIN: u32 = 1;
/// Words of the longest sentence that is read.
const LONGEST: usize = 200;
/// Readings that are run at most.
const MOST_RUN: usize = 8;

impl Grammar {
    /// What a sentence may mean, the cheapest first; none where it is not understood.
    #[must_use]
    pub fn read(&self, map: &Map<'_>, text: &str) -> Vec<Reading> {
        let Some(tokens) = tokens(text).filter(|all| !all.is_empty() && all.len() <= LONGEST)
        else {
            return Vec::new();
        };
        let Map { world, lexicon, words, .. } = *map;
        let language = Language::of(text);
        let sentence = Sentence { text, tokens: &tokens, language, world, lexicon, words };
        for (name, tongue) in self.tongues_for(language) {
            let edges = sentence.edges(tongue, &self.signatures);
            let chart = Chart::of(&tokens, edges, tongue, &self.signatures);
            let found = readings(&chart, tongue, &self.signatures);
            if !found.is_empty() {
                let tongue = name.to_owned();
                let reading = |f: crate::cover::Found| {
                    let tongue = tongue.clone();
                    Reading { form: f.form, cost: f.cost, frame: f.place, tongue }
                };
                return found.into_iter().map(reading).collect();
            }
        }
        Vec::new()
    }

    /// Runs what a sentence asks, by its readings as [`Grammar::read`] gives them. Of several within the [`MARGIN`] all are
    /// run: where they come to the same, that is the answer.
    pub fn answer(
        &self,
        map: &Map<'_>,
        readings: Vec<Reading>,
        run: &mut dyn FnMut(&str) -> Rows,
    ) -> Outcome {
        let Some(cheapest) = readings.first().map(|reading| reading.cost) else {
            return Outcome::NotUnderstood;
        };
        let near = readings.into_iter().filter(|r| r.cost <= cheapest + MARGIN);
        let mut answers: Vec<Answer> = Vec::new();
        for reading in near.take(MOST_RUN) {
            let mut asking = Asking { grammar: self, map, run: &mut *run, rules: Vec::new() };
            let found = asking.answer(&reading.form);
            let rules = asking.rules;
            // A reading that comes to nothing the program can tell does not hide another.
            if let Err(NoAnswer::Failed(_)) = found {
                return Outcome::Refused(Box::new(Answer { reading, rules, found }));
            }
            if answers.iter().all(|other| other.found != found) {
                answers.push(Answer { reading, rules, found });
            }
        }
        // A reading that speaks of what is not there, or is not one, is not meant where another is as good.
        let fails = |answer: &Answer| {
            matches!(&answer.found, Err(NoAnswer::NoneSuch | NoAnswer::Ambiguous(_)))
        };
        if answers.iter().any(|answer| answer.found.is_ok()) {
            answers.retain(|answer| !fails(answer));
        }
        match answers.len() {
            1 => match answers.swap_remove(0) {
                answer if answer.found.is_ok() => Outcome::Answered(Box::new(answer)),
                answer => Outcome::Refused(Box::new(answer)),
            },
            _ => Outcome::Several(answers),
        }
    }
}

//! What a rule did in an evaluation, as it is told.

use std::fmt;
use std::time::Duration;

use super::syntax::Span;
use crate::units::{Bilingual, InOrder as _, Language, told};

/// One rule's part in an evaluation; a recursive rule has a line for each premise that it starts with.
#[derive(Debug, Clone)]
pub struct RuleTrace {
    /// `rules.dl:3:1`
    pub place: String,
    /// The relation that it derives.
    pub relation: String,
    /// The premises in the order in which they are joined.
    pub joins: Vec<Join>,
    /// Rounds in which it ran.
    pub runs: usize,
    /// Tuples it found, those found before counted again.
    pub found: usize,
    pub time: Duration,
    pub(super) at: Span,
}

/// A step of a rule: what is read, or done with what was read.
#[derive(Debug, Clone)]
pub struct Join {
    /// In how many aggregates it stands.
    pub(super) depth: usize,
    pub(super) what: Bilingual,
    /// How many rows there were when the rule first ran.
    pub(super) size: Option<Bilingual>,
    /// Rows that a comparison excludes are passed over.
    pub(super) is_filtered: bool,
}

impl Join {
    /// `edge by a: 3 rows`
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        let mut told = self.what.say(language).to_owned();
        if let Some(size) = &self.size {
            told = format!("{told}: {}", size.say(language));
        }
        if self.is_filtered {
            told += &told!(language, "filtered-by-a-comparison");
        }
        told
    }
}

impl RuleTrace {
    pub(super) fn is_of(&self, at: Span, joins: &[Join]) -> bool {
        let same =
            |(one, other): (&Join, &Join)| one.depth == other.depth && one.what == other.what;
        self.at == at && self.joins.len() == joins.len() && self.joins.iter().zip(joins).all(same)
    }

    /// The time, the rule and what it found, and under it a line for each join.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        let Self { place, relation, runs, found, .. } = self;
        let milliseconds = format!("{:>10.3}", self.time.as_secs_f64() * 1000.0);
        let milliseconds = match language {
            Language::Russian => milliseconds.replace('.', ","),
            Language::English => milliseconds,
        };
        let mut told = told!(language, "rule-took", milliseconds, relation, place, runs, found);
        for join in &self.joins {
            let indent = 15 + 2 * join.depth;
            told += &format!("\n{:indent$}{}", "", join.say(language));
        }
        told
    }
}

impl fmt::Display for RuleTrace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.say(Language::Russian))
    }
}

/// Lines, the longest time first.
#[must_use]
pub(super) fn sorted(mut all: Vec<RuleTrace>) -> Vec<RuleTrace> {
    all.order_by_key(|line| std::cmp::Reverse(line.time));
    all
}

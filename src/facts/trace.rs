//! What a rule did in an evaluation, as it is told.

use std::fmt;
use std::time::Duration;

use super::syntax::Span;

/// One rule's part in an evaluation; a recursive rule has a line for each premise that it starts with.
#[derive(Debug, Clone)]
pub struct RuleTrace {
    /// `rules.dl:3:1`
    pub place: String,
    /// The relation that it derives.
    pub relation: String,
    /// The premises in the order in which they are joined.
    pub joins: Vec<String>,
    /// Rounds in which it ran.
    pub runs: usize,
    /// Tuples it found, those found before counted again.
    pub found: usize,
    pub time: Duration,
    pub(super) at: Span,
}

impl fmt::Display for RuleTrace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let milliseconds = self.time.as_secs_f64() * 1000.0;
        writeln!(
            f,
            "{milliseconds:>9.3} мс  {} «{}»: запусков {}, найдено {}",
            self.place, self.relation, self.runs, self.found
        )?;
        self.joins.iter().try_for_each(|join| writeln!(f, "              {join}"))
    }
}

/// Lines, the longest time first.
#[must_use]
pub(super) fn sorted(mut all: Vec<RuleTrace>) -> Vec<RuleTrace> {
    all.sort_by_key(|line| std::cmp::Reverse(line.time));
    all
}

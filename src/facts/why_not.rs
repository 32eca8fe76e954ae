//! Why a tuple does not hold: the rule instance that came closest, and what failed in it.
//!
//! A failed premise that rules derive is asked about in turn, down to a comparison that failed with its numbers or to
//! what was simply not told. How the instance is found stands in [`super::nearest`].

use std::fmt;

use super::database::{FactError, RelationKey};
use super::nearest::{Best, Search};
use super::program::{Clause, Literal, VariableId};
use super::proof::{Explainer, Premise, Proof, RuleInstance, premise, row_of, rule_instance};
use super::relations::RelationId;
use super::value;
use super::word::{Value, Word};

/// The answer to "why not".
#[derive(Debug, Clone, PartialEq)]
pub enum WhyNot {
    /// It does hold.
    Holds,
    /// No rule derives this relation: it holds what it is told, and was not told this.
    NotTold,
    Nearest(FailedRule),
}

/// The rule instance that came closest to deriving the tuple.
#[derive(Debug, Clone, PartialEq)]
pub struct FailedRule {
    pub rule: RuleInstance,
    /// All premises in the order of the rule, each with whether it holds; none where that could not be told,
    /// because a failed premise left a variable open.
    pub premises: Vec<(Premise, Option<bool>)>,
    /// Why premises failed, by their positions in `premises`. A comparison, or a tuple that was simply not told,
    /// says it itself.
    pub below: Vec<(usize, Below)>,
}

/// Why a premise failed.
#[derive(Debug, Clone, PartialEq)]
pub enum Below {
    /// The tuple is missing: the rule that came closest to deriving one.
    Missing(FailedRule),
    /// The tuple should be absent and is there.
    There(Proof),
}

impl FailedRule {
    /// The premises that failed; the first is the one to name.
    pub fn failed(&self) -> impl Iterator<Item = &Premise> {
        self.premises.iter().filter(|(_, holds)| *holds == Some(false)).map(|(premise, _)| premise)
    }
}

/// Rules below rules at most.
const MAX_DEPTH: usize = 24;

/// The patterns that the rules above were to derive.
type Above = Vec<(RelationId, Vec<Word>)>;

impl Explainer {
    /// The rule that came closest to deriving the tuple, and the premise that failed.
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn why_not(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<WhyNot, FactError> {
        let (relation, row) = self.encode(relation, tuple)?;
        if self.holds(relation, &row) {
            return Ok(WhyNot::Holds);
        }
        let nearest = self.nearest(relation, &row, &mut Vec::new());
        Ok(nearest.map_or(WhyNot::NotTold, WhyNot::Nearest))
    }

    /// The rule that came closest to deriving a tuple that fits the pattern, [`NO_WORD`](super::word::NO_WORD) standing for any word.
    fn nearest(
        &mut self,
        relation: RelationId,
        row: &[Word],
        above: &mut Above,
    ) -> Option<FailedRule> {
        if above.len() >= MAX_DEPTH || above.iter().any(|(r, known)| *r == relation && known == row)
        {
            return None;
        }
        let best = self.best(relation, row)?;
        above.push((relation, row.to_vec()));
        let failed = self.failed_rule(&best, above);
        above.pop();
        Some(failed)
    }

    fn failed_rule(&mut self, best: &Best, above: &mut Above) -> FailedRule {
        let program = self.program.clone();
        // The rule as written: its own variables come first among those of the turned one.
        let clause: &Clause = &program.clauses[best.clause];
        let own = &best.registers[..clause.variables.len()];
        let mut premises: Vec<(Premise, Option<bool>)> = Vec::new();
        let mut below = Vec::new();
        for (literal, holds) in clause.body.iter().zip(&best.holds) {
            let words = &mut self.finished.words;
            if let Some(premise) = premise(&program, clause, literal, own, words) {
                if *holds == Some(false)
                    && let Some(why) = self.below(literal, own, above)
                {
                    below.push((premises.len(), why));
                }
                premises.push((premise, *holds));
            }
        }
        // A head that does not fit the tuple fails like a premise.
        let behind = best.holds.iter().enumerate().skip(clause.body.len());
        for (n, holds) in behind.filter(|(_, holds)| **holds == Some(false)) {
            let turned = self.asked[&best.clause].clause.clone();
            let Literal::Compare(compare) = &turned.body[n] else { continue };
            let register = |v: VariableId| best.registers[v as usize];
            let words = &mut self.finished.words;
            let text = program
                .excerpt(clause.at)
                .2
                .split(":-")
                .next()
                .unwrap_or_default()
                .trim()
                .to_owned();
            let sides = (
                value::compute(&compare.left, &register, words),
                value::compute(&compare.right, &register, words),
            );
            let premise = match sides {
                (Some(left), Some(right)) => Premise::Compared {
                    text,
                    left: words.value(left, compare.kind),
                    op: compare.op,
                    right: words.value(right, compare.kind),
                },
                _ => Premise::Unknown { text },
            };
            premises.push((premise, *holds));
        }
        let rule = rule_instance(&program, clause, own, &self.finished.words);
        FailedRule { rule, premises, below }
    }

    /// Why a failed premise failed.
    fn below(&mut self, literal: &Literal, registers: &[Word], above: &mut Above) -> Option<Below> {
        match literal {
            Literal::Atom(atom) => {
                let row = row_of(atom, registers);
                self.nearest(atom.relation, &row, above).map(Below::Missing)
            }
            Literal::Not(atom) => {
                let search = Search::new(registers.to_vec(), 0, false);
                let mut row = self.matching(atom, &search).into_iter().next()?;
                row.truncate(atom.args.len());
                self.prove(atom.relation, row.into()).map(Below::There)
            }
            Literal::Compare(_) | Literal::Aggregate(_) | Literal::Range(_) => None,
        }
    }
}

/// As an indented tree: `+` holds, `-` failed, `?` could not be told; below a failed premise what failed in turn.
impl fmt::Display for FailedRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut open: Vec<(usize, &Self, usize)> = vec![(0, self, 0)];
        writeln!(f, "← {}:{}", self.rule.source, self.rule.line)?;
        while let Some((depth, rule, at)) = open.pop() {
            let Some((premise, holds)) = rule.premises.get(at) else { continue };
            let mark = match holds {
                Some(true) => '+',
                Some(false) => '-',
                None => '?',
            };
            let indent = "  ".repeat(depth + 1);
            write!(f, "{indent}{mark} {premise}")?;
            open.push((depth, rule, at + 1));
            match rule.below.iter().find(|(of, _)| *of == at).map(|(_, why)| why) {
                Some(Below::Missing(next)) => {
                    writeln!(f, "  ← {}:{}", next.rule.source, next.rule.line)?;
                    open.push((depth + 1, next, 0));
                }
                Some(Below::There(proof)) => {
                    writeln!(f)?;
                    for line in proof.to_string().lines() {
                        writeln!(f, "{indent}    {line}")?;
                    }
                }
                None => writeln!(f)?,
            }
        }
        Ok(())
    }
}

//! Why a tuple does not hold: the rule instance that came closest, and what failed in it.
//!
//! A failed premise that rules derive is asked about in turn, down to a comparison that failed with its numbers or to
//! what was simply not told. How the instance is found stands in [`super::nearest`].

use std::fmt;

use super::database::{FactError, RelationKey};
use super::nearest::{Best, Search};
use super::program::{Clause, Literal, RelationId, VariableId};
use super::proof::{Explainer, Premise, Proof, RuleInstance, premise, row_of, rule_instance};
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

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::Program;
    use crate::units::Source;

    const RULES: &str = r#"
.decl зазор(а: symbol, б: symbol, мм: number) .input зазор
.decl сплошной(б: symbol) .input сплошной
.decl внутри(а: symbol, б: symbol) .input внутри
.decl сверху(а: symbol, б: symbol) = ON_TOP_OF
.decl опора(а: symbol, б: symbol)
.decl занят(б: symbol, n: number)
.output опора .output занят
сверху(A, B) :- зазор(A, B, G), G >= -60, G <= 60, сплошной(B), !внутри(A, B).
опора(A, B) :- сверху(A, B).
опора(A, C) :- опора(A, B), сверху(B, C).
занят(B, N) :- сплошной(B), N = count : { сверху(_, B) }, N > 0.
"#;

    fn explainer() -> Explainer {
        let program = Program::parse(&Source::new("опора.dl", RULES.trim_start())).unwrap();
        let mut facts = program.database();
        for (a, b, gap) in [
            ("чашка", "блюдце", 0),
            ("блюдце", "стол", 5),
            ("лампа", "стол", 140),
            ("кот", "шкаф", -20),
        ] {
            facts.insert("зазор", &[a.into(), b.into(), gap.into()]).unwrap();
        }
        for b in ["блюдце", "стол", "шкаф"] {
            facts.insert("сплошной", &[b.into()]).unwrap();
        }
        facts.insert("внутри", &["кот".into(), "шкаф".into()]).unwrap();
        program.evaluate(&facts).unwrap().explain()
    }

    fn check_why(relation: &str, tuple: &[Value], expected: &Expect) {
        let proof = explainer().why(relation, tuple).unwrap();
        expected.assert_eq(&proof.map_or("не выполняется\n".into(), |proof| proof.to_string()));
    }

    fn check_why_not(relation: &str, tuple: &[Value], expected: &Expect) {
        let shown = match explainer().why_not(relation, tuple).unwrap() {
            WhyNot::Nearest(rule) => {
                let mut shown = format!("{}:{}\n", rule.rule.source, rule.rule.line);
                for (premise, holds) in &rule.premises {
                    let mark = match holds {
                        Some(true) => '+',
                        Some(false) => '-',
                        None => '?',
                    };
                    shown += &format!("{mark} {premise}\n");
                }
                shown
            }
            other => format!("{other:?}\n"),
        };
        expected.assert_eq(&shown);
    }

    #[test]
    fn a_proof_goes_down_to_the_measurements() {
        check_why(
            "опора",
            &["чашка".into(), "стол".into()],
            &expect![[r#"
            опора("чашка", "стол")  ← опора.dl:10
              опора("чашка", "блюдце")  ← опора.dl:9
                сверху("чашка", "блюдце")  ← опора.dl:8
                  зазор("чашка", "блюдце", 0)
                  G >= -60: 0 >= -60
                  G <= 60: 0 <= 60
                  сплошной("блюдце")
                  !внутри("чашка", "блюдце")
              сверху("блюдце", "стол")  ← опора.dl:8
                зазор("блюдце", "стол", 5)
                G >= -60: 5 >= -60
                G <= 60: 5 <= 60
                сплошной("стол")
                !внутри("блюдце", "стол")
        "#]],
        );
    }

    #[test]
    fn a_proof_shows_counts() {
        check_why(
            "занят",
            &["стол".into(), 1.into()],
            &expect![[r#"
                занят("стол", 1)  ← опора.dl:11
                  сплошной("стол")
                  count : { сверху(_, B) } = 1
                  N = count : { сверху(_, B) }: 1 = 1
                  N > 0: 1 > 0
            "#]],
        );
        check_why(
            "занят",
            &["стол".into(), 2.into()],
            &expect![[r#"
            не выполняется
        "#]],
        );
    }

    #[test]
    fn a_number_beyond_its_threshold_is_named() {
        check_why_not(
            "ON_TOP_OF",
            &["лампа".into(), "стол".into()],
            &expect![[r#"
            опора.dl:8
            + зазор("лампа", "стол", 140)
            + G >= -60: 140 >= -60
            - G <= 60: 140 <= 60
            + сплошной("стол")
            + !внутри("лампа", "стол")
        "#]],
        );
    }

    #[test]
    fn what_stands_against_it_is_named() {
        check_why_not(
            "сверху",
            &["кот".into(), "шкаф".into()],
            &expect![[r#"
            опора.dl:8
            + зазор("кот", "шкаф", -20)
            + G >= -60: -20 >= -60
            + G <= 60: -20 <= 60
            + сплошной("шкаф")
            - !внутри("кот", "шкаф")
        "#]],
        );
    }

    #[test]
    fn a_missing_tuple_is_named_and_what_hangs_on_it_left_open() {
        check_why_not(
            "сверху",
            &["чашка".into(), "шкаф".into()],
            &expect![[r#"
            опора.dl:8
            - зазор("чашка", "шкаф", _)
            ? G >= -60
            ? G <= 60
            + сплошной("шкаф")
            + !внутри("чашка", "шкаф")
        "#]],
        );
        check_why_not(
            "зазор",
            &["чашка".into(), "шкаф".into(), 3.into()],
            &expect![[r#"
            NotTold
        "#]],
        );
        check_why_not(
            "опора",
            &["чашка".into(), "никто".into()],
            &expect![[r#"
            опора.dl:9
            - сверху("чашка", "никто")
        "#]],
        );
        check_why_not(
            "занят",
            &["шкаф".into(), 4.into()],
            &expect![[r#"
                опора.dl:11
                + сплошной("шкаф")
                + count : { сверху(_, B) } = 0
                - N = count : { сверху(_, B) }: 4 = 0
                + N > 0: 4 > 0
            "#]],
        );
    }
}

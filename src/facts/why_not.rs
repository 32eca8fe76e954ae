//! Why a tuple does not hold: the rule instance that came closest, and what failed in it.
//!
//! Each rule of the relation is matched with the tuple, and its premises are tried in the order in which
//! their variables become known. A failed premise does not end the search but is noted, so that an instance
//! with one failure is found even when that premise comes first. The instance with the fewest failures
//! wins; among equals the one whose failed comparison misses by least. A failed premise that rules derive is
//! asked about in turn, down to a comparison that failed with its numbers or to what was simply not told.

use std::fmt;

use super::database::{FactError, RelationKey};
use super::kept::View;
use super::plan::{Task, Version, plan};
use super::program::{
    Aggregate, Atom, Clause, Compare, Expr, Literal, RelationId, Term, VariableId,
};
use super::proof::{Explainer, Premise, Proof, RuleInstance, premise, row_of, rule_instance};
use super::syntax::{Aggregation, Comparison};
use super::value;
use super::word::{NO_WORD, Value, Word, Words};

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

/// Premises tried at most for one question, over all rules.
const MAX_TRIED: usize = 200_000;
/// Of them for instances in which a premise fails although other values would let it hold.
const MAX_TRIED_WITHOUT: usize = 20_000;
/// Rules below rules at most.
const MAX_DEPTH: usize = 24;

/// How far an instance is from success: failures and premises not judged, then the relative miss of a comparison.
type Distance = (usize, f64);

/// The patterns that the rules above were to derive.
type Above = Vec<(RelationId, Vec<Word>)>;

struct Best {
    distance: Distance,
    clause: usize,
    registers: Vec<Word>,
    holds: Vec<Option<bool>>,
}

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

    /// The rule that came closest to deriving a tuple that fits the pattern, [`NO_WORD`] standing for any word.
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
        let clauses: Vec<usize> = (0..self.program.clauses.len())
            .filter(|n| self.program.clauses[*n].head == relation)
            .collect();
        let mut best: Option<Best> = None;
        let mut tried = 0;
        for (clause, goes_without) in
            clauses.iter().map(|n| (*n, false)).chain(clauses.iter().map(|n| (*n, true)))
        {
            if goes_without && best.as_ref().is_none_or(|best| best.distance.0 <= 1) {
                break;
            }
            if goes_without && clause == clauses[0] {
                tried = MAX_TRIED - MAX_TRIED_WITHOUT;
            }
            self.ask(clause);
            let asked = self.asked(clause);
            let mut registers = vec![NO_WORD; asked.clause.variables.len()];
            for (v, word) in asked.head.iter().zip(row) {
                registers[*v as usize] = *word;
            }
            let body = asked.clause.body.clone();
            let holds = vec![None; body.len()];
            let search = Search { holds, registers, distance: (0, 0.0), goes_without };
            let open: Vec<usize> = (0..body.len()).collect();
            self.search(clause, &body, open, search, &mut best, &mut tried);
        }
        let best = best?;
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
                let registers = registers.to_vec();
                let (holds, distance) = (Vec::new(), (0, 0.0));
                let search = Search { registers, holds, distance, goes_without: false };
                let mut row = self.matching(atom, &search).into_iter().next()?;
                row.truncate(atom.args.len());
                self.prove(atom.relation, row.into()).map(Below::There)
            }
            Literal::Compare(_) | Literal::Aggregate(_) | Literal::Range(_) => None,
        }
    }

    /// Tries all ways to go on from a partial instance, and keeps the best complete one.
    fn search(
        &mut self,
        clause: usize,
        body: &[Literal],
        mut open: Vec<usize>,
        mut search: Search,
        best: &mut Option<Best>,
        tried: &mut usize,
    ) {
        self.settle(clause, body, &mut open, &mut search);
        *tried += 1;
        if best.as_ref().is_some_and(|best| best.distance <= search.distance) {
            return;
        }
        let known = |n: &usize| match &body[*n] {
            Literal::Atom(atom) => search.known_columns(atom).len() * 64 / atom.args.len().max(1),
            _ => 0,
        };
        let atoms = open.iter().copied().filter(|n| matches!(body[*n], Literal::Atom(_)));
        // The best known atom next; of equals the first.
        let Some(next) = atoms.rev().max_by_key(known) else {
            search.distance.0 += open.len();
            // What was gone without must fail for the values that others gave.
            let fails = |n: usize, this: &mut Self| match &body[n] {
                Literal::Atom(atom) => this.matching(atom, &search).is_empty(),
                _ => true,
            };
            if search.goes_without
                && !(0..body.len()).all(|n| search.holds[n] != Some(false) || fails(n, self))
            {
                return;
            }
            if best.as_ref().is_none_or(|best| search.distance < best.distance) {
                let Search { registers, holds, distance, .. } = search;
                *best = Some(Best { distance, clause, registers, holds });
            }
            return;
        };
        open.retain(|n| *n != next);
        let Literal::Atom(atom) = &body[next] else { return };
        let taken = self.matching(atom, &search).into_iter().filter_map(|row| {
            let mut further = search.clone();
            further.holds[next] = Some(true);
            further.take(atom, &row).then_some(further)
        });
        let ways: Vec<Search> = taken.collect();
        if ways.is_empty() {
            search.fail(next, f64::INFINITY);
            self.search(clause, body, open, search, best, tried);
            return;
        }
        for further in ways {
            self.search(clause, body, open.clone(), further, best, tried);
            if *tried > MAX_TRIED {
                return;
            }
        }
        if search.goes_without {
            search.fail(next, f64::INFINITY);
            self.search(clause, body, open, search, best, tried);
        }
    }

    /// Judges and computes everything whose variables are known.
    fn settle(
        &mut self,
        clause: usize,
        body: &[Literal],
        open: &mut Vec<usize>,
        search: &mut Search,
    ) {
        let mut n = 0;
        while n < open.len() {
            let number = open[n];
            let judged = match &body[number] {
                Literal::Atom(_) => None,
                Literal::Compare(compare) => search.compare(compare, &mut self.finished.words),
                Literal::Not(atom) => search.knows_all(atom).then(|| {
                    let is_absent = self.matching(atom, search).is_empty();
                    if is_absent { Judged::Holds } else { Judged::Fails(f64::INFINITY) }
                }),
                Literal::Range(range) => {
                    let register = |v: VariableId| search.registers[v as usize];
                    let target = register(range.target);
                    let is_known = |expr: &Expr| expr.all_variables(|v| register(v) != NO_WORD);
                    let ready = target != NO_WORD && range.bounds.exprs().all(is_known);
                    ready.then(|| {
                        let words = &mut self.finished.words;
                        let number = words.to_number(target);
                        let numbers = value::numbers(&range.bounds, &register, words);
                        let is_there = numbers.is_some_and(|numbers| numbers.contains(number));
                        if is_there { Judged::Holds } else { Judged::Fails(f64::INFINITY) }
                    })
                }
                Literal::Aggregate(aggregate) => {
                    let ready =
                        aggregate.shared.iter().all(|v| search.registers[*v as usize] != NO_WORD);
                    ready.then(|| self.count(clause, aggregate, search))
                }
            };
            match judged {
                Some(Judged::Holds) => search.holds[number] = Some(true),
                Some(Judged::Fails(miss)) => search.fail(number, miss),
                None => {
                    n += 1;
                    continue;
                }
            }
            open.remove(n);
            n = 0;
        }
    }

    /// The rows that fit an atom as far as its variables are known.
    fn matching(&mut self, atom: &Atom, search: &Search) -> Vec<Vec<Word>> {
        const MAX_ROWS: usize = 10_000;
        let known = search.known_columns(atom);
        let key: Vec<Expr> =
            known.iter().map(|(column, _)| Expr::Variable(*column as u32)).collect();
        let words: Vec<Word> = known.iter().map(|(_, word)| *word).collect();
        self.finished.find(atom.relation, &key, &words, MAX_ROWS)
    }

    /// Runs an aggregate over the finished relations.
    fn count(&mut self, clause: usize, aggregate: &Aggregate, search: &mut Search) -> Judged {
        let turned = &self.asked(clause).clause;
        let alone = Clause { body: aggregate.body.clone(), ..turned.clone() };
        let versions = vec![Version::Finished; alone.body.len()];
        let mut wanted: Vec<VariableId> = Vec::new();
        super::ground::used_variables(&alone.body, aggregate.value.as_ref(), &mut |v| {
            wanted.push(v)
        });
        let task = Task {
            clause: &alone,
            versions: &versions,
            first: None,
            bound: &aggregate.shared,
            wanted: &wanted,
        };
        let mut plan = plan(&task, &self.finished);
        self.finished.provide(&plan);
        plan.count_all();
        let mut count = super::run::Count::default();
        let mut each = |registers: &[Word], words: &mut Words| {
            let number = match &aggregate.value {
                Some(value) => value::number(value, &|v| registers[v as usize], words),
                None => Some(0),
            };
            number.into_iter().for_each(|number| count.add(number));
            true
        };
        let mut registers = search.registers.clone();
        self.finished.run(&plan, View::After, &[], &mut registers, &mut each);
        match count.value(aggregate.function) {
            Some(number) => {
                search.registers[aggregate.target as usize] = self.finished.words.number(number);
                Judged::Holds
            }
            // The least of nothing is no number; the rule needs one.
            None if aggregate.function == Aggregation::Count => Judged::Holds,
            None => Judged::Fails(f64::INFINITY),
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

enum Judged {
    Holds,
    /// With the relative distance to success.
    Fails(f64),
}

/// A partial instance.
#[derive(Debug, Clone)]
struct Search {
    registers: Vec<Word>,
    holds: Vec<Option<bool>>,
    distance: Distance,
    /// Whether premises may fail that some values would let hold.
    goes_without: bool,
}

impl Search {
    fn fail(&mut self, literal: usize, miss: f64) {
        self.holds[literal] = Some(false);
        self.distance.0 += 1;
        self.distance.1 += miss.min(1e9);
    }

    fn word(&self, term: &Term) -> Option<Word> {
        match term {
            Term::Any => None,
            Term::Constant(word) => Some(*word),
            Term::Variable(v) => Some(self.registers[*v as usize]).filter(|word| *word != NO_WORD),
        }
    }

    fn known_columns(&self, atom: &Atom) -> Vec<(usize, Word)> {
        let columns = atom.args.iter().enumerate();
        columns.filter_map(|(n, term)| self.word(term).map(|word| (n, word))).collect()
    }

    fn knows_all(&self, atom: &Atom) -> bool {
        atom.args.iter().all(|term| *term == Term::Any || self.word(term).is_some())
    }

    /// Gives the atom's variables the row's words; false when one variable would need two.
    fn take(&mut self, atom: &Atom, row: &[Word]) -> bool {
        atom.args.iter().zip(row).all(|(term, word)| match term {
            Term::Variable(v) => {
                let register = &mut self.registers[*v as usize];
                if *register == NO_WORD {
                    *register = *word;
                }
                *register == *word
            }
            _ => true,
        })
    }

    fn compare(&mut self, compare: &Compare, words: &mut Words) -> Option<Judged> {
        let register = |v: VariableId| self.registers[v as usize];
        let is_known = |expr: &Expr| expr.all_variables(|v| register(v) != NO_WORD);
        match (is_known(&compare.left), is_known(&compare.right)) {
            (true, true) => {
                let left = value::compute(&compare.left, &register, words);
                let right = value::compute(&compare.right, &register, words);
                Some(match (left, right) {
                    (Some(left), Some(right)) => judge(compare, left, right, words),
                    _ => Judged::Fails(f64::INFINITY),
                })
            }
            (false, true) => self.assign(compare, &compare.left, &compare.right, words),
            (true, false) => self.assign(compare, &compare.right, &compare.left, words),
            (false, false) => None,
        }
    }

    fn assign(
        &mut self,
        compare: &Compare,
        to: &Expr,
        from: &Expr,
        words: &mut Words,
    ) -> Option<Judged> {
        let Expr::Variable(v) = to else { return None };
        if compare.op != Comparison::Equal {
            return None;
        }
        Some(match value::compute(from, &|v| self.registers[v as usize], words) {
            Some(word) => {
                self.registers[*v as usize] = word;
                Judged::Holds
            }
            None => Judged::Fails(f64::INFINITY),
        })
    }
}

fn judge(compare: &Compare, left: Word, right: Word, words: &Words) -> Judged {
    if value::holds(compare.op, compare.kind.is_number(), left, right, words) {
        return Judged::Holds;
    }
    if !compare.kind.is_number() {
        return Judged::Fails(f64::INFINITY);
    }
    let (left, right) = (words.to_number(left) as f64, words.to_number(right) as f64);
    Judged::Fails((left - right).abs() / left.abs().max(right.abs()).max(1.0))
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::facts::Program;
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

//! The rule instance that comes closest to deriving a tuple.
//!
//! Each rule of the relation is matched with the tuple, and its premises are tried in the order in which
//! their variables become known. A failed premise does not end the search but is noted, so that an instance
//! with one failure is found even when that premise comes first. The instance with the fewest failures
//! wins; among equals the one whose failed comparison misses by least. Where more than one premise fails so, the
//! rules are gone through once more, each premise in turn left out although something fits it.

use super::growing::Version;
use super::kept::View;
use super::plan::{Task, plan};
use super::program::{Aggregate, Atom, Clause, Compare, Expr, Literal, Term, VariableId};
use super::proof::Explainer;
use super::relations::RelationId;
use super::syntax::{Aggregation, Comparison};
use super::value;
use super::word::{NO_WORD, Word, Words};

/// Premises tried at most for one question, over all rules.
const MAX_TRIED: usize = 200_000;
/// Of them for instances in which a premise fails although other values would let it hold.
const MAX_TRIED_WITHOUT: usize = 20_000;

/// How far an instance is from success: failures and premises not judged, then the relative miss of a comparison.
type Distance = (usize, f64);

/// A complete instance.
pub(super) struct Best {
    distance: Distance,
    pub(super) clause: usize,
    pub(super) registers: Vec<Word>,
    pub(super) holds: Vec<Option<bool>>,
}

impl Explainer {
    /// The instance of the relation's rules that comes closest to a tuple that fits the pattern, [`NO_WORD`] standing for
    /// any word; none where no rule derives the relation.
    pub(super) fn best(&mut self, relation: RelationId, row: &[Word]) -> Option<Best> {
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
            let search = Search::new(registers, body.len(), goes_without);
            let open: Vec<usize> = (0..body.len()).collect();
            self.search(clause, &body, open, search, &mut best, &mut tried);
        }
        best
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
        self.judge_bound(clause, body, &mut open, &mut search);
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
    fn judge_bound(
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
                // An atom may give the variable another value, for which the comparison alone fails.
                Literal::Compare(compare)
                    if search.goes_without
                        && search.sets(compare).is_some_and(|v| stands_in(v, body, open)) =>
                {
                    None
                }
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
    pub(super) fn matching(&mut self, atom: &Atom, search: &Search) -> Vec<Vec<Word>> {
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
        super::program::used_variables(&alone.body, aggregate.value.as_ref(), &mut |v| {
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
        match count.value(aggregate.function, aggregate.kind) {
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

enum Judged {
    Holds,
    /// With the relative distance to success.
    Fails(f64),
}

/// A partial instance.
#[derive(Debug, Clone)]
pub(super) struct Search {
    registers: Vec<Word>,
    holds: Vec<Option<bool>>,
    distance: Distance,
    /// Whether premises may fail that some values would let hold.
    goes_without: bool,
}

impl Search {
    pub(super) fn new(registers: Vec<Word>, premises: usize, goes_without: bool) -> Self {
        Self { registers, holds: vec![None; premises], distance: (0, 0.0), goes_without }
    }

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

    /// The open variable that the comparison would give a value.
    fn sets(&self, compare: &Compare) -> Option<VariableId> {
        let open = |side: &Expr| match side {
            Expr::Variable(v) if self.registers[*v as usize] == NO_WORD => Some(*v),
            _ => None,
        };
        open(&compare.left).or(open(&compare.right)).filter(|_| compare.op == Comparison::Equal)
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

/// Whether a variable stands in an atom that is still to be tried.
fn stands_in(v: VariableId, body: &[Literal], open: &[usize]) -> bool {
    let atoms = open.iter().filter_map(|n| match &body[*n] {
        Literal::Atom(atom) => Some(atom),
        _ => None,
    });
    atoms.flat_map(|atom| &atom.args).any(|arg| *arg == Term::Variable(v))
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

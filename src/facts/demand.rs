//! Only what a question needs: relations derived call by call.
//!
//! A call is a relation with words for some of its columns. A relation without recursion answers a call by running its
//! clauses with those words in their heads; what they read in turn is called with the words known by then. A group of
//! recursive relations answers by magic sets ([`super::magic`]): the clauses of the group, guarded by the calls that
//! come up on the way, to their fixpoint. Every answered call is kept in a table. So negation and aggregates need no
//! care: what they read lies in a lower stratum, and its call is complete before it is looked at.
//!
//! Where a rule reads only whether a call has rows, as behind a negation, the first that is found ends the call.
//!
//! Where a relation is called for a good part of all there is, it is called once for all and its rows are told apart
//! by the columns in question: asking more than evaluation would have found costs about as much as evaluation.
//!
//! **Invariant**: a kept call has exactly the rows of the least fixpoint that fit its key.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use foldhash::fast::RandomState;

use super::called::{Called, Flat, Lookup, Mask, columns_of};
use super::computed::{AskError, Computed};
use super::finished::{Outside, share};
use super::growing::Version;
use super::head::Head;
use super::kept::{Kept, View};
use super::limits::{MAX_ROWS, Watch};
use super::magic::Magic;
use super::plan::{Plan, Request, Statistics, Task, UNKNOWN_SHARE, plan_with_cost};
use super::program::{Clause, Expr, Program, VariableId};
use super::relations::RelationId;
use super::rows::heap;
use super::run::{Goal, Source, run};
use super::slots::KeptIndex;
use super::strata::reads;
use super::syntax::Span;
use super::tables::Tables;
use super::turned::turned;
use super::word::{NO_WORD, Word, Words};
use crate::units::{Bilingual, Language, told};

/// Calls within calls at most: each takes its part of the stack.
const MAX_DEPTH: usize = 48;

/// Calls of one relation by the same columns that are answered one by one, whatever the relation's size.
const FEW_CALLS: usize = 64;

/// How much larger than what it reads a recursive relation is taken to be.
const GROWTH: f64 = 32.0;

/// How a relation comes by its rows.
#[derive(Clone, Copy)]
enum Kind<'a> {
    /// All of them are kept.
    Stored,
    Computed(&'a dyn Computed),
    /// By clauses, besides what is given.
    Derived,
}

/// The relations of a program, asked call by call.
pub(super) struct Demand<'a> {
    pub(super) program: &'a Program,
    pub(super) kept: &'a Kept,
    kinds: Vec<Kind<'a>>,
    /// The clauses of each derived relation.
    clauses: HashMap<RelationId, Vec<usize>>,
    /// The relations of each recursive group, by relation.
    groups: HashMap<RelationId, Rc<[RelationId]>>,
    pub(super) watch: Rc<Watch>,
    state: RefCell<State>,
    depth: Cell<usize>,
}

#[derive(Default)]
struct State {
    tables: Tables,
    plans: HashMap<(usize, Mask, Wanted), Rc<CallPlan>, RandomState>,
    magic: HashMap<(RelationId, Mask), Rc<Magic>>,
    sizes: HashMap<RelationId, f64>,
    error: Option<AskError>,
}

/// What a call asks for.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Wanted {
    Rows,
    /// Whether there is a row: the first that is found is enough.
    Any,
}

/// A clause with its head's columns of a mask known.
struct CallPlan {
    clause: Clause,
    head: Vec<VariableId>,
    plan: Plan,
    /// Those of the plan's requests.
    indexes: Indexes,
}

type Indexes = Box<[Option<Arc<KeptIndex>>]>;

impl CallPlan {
    /// The clause's variables, those of the call with their words.
    fn registers(&self, mask: Mask, key: &[Word]) -> Vec<Word> {
        let mut registers = vec![NO_WORD; self.clause.variables.len()];
        for (column, word) in columns_of(mask).zip(key) {
            registers[self.head[column] as usize] = *word;
        }
        registers
    }
}

impl<'a> Demand<'a> {
    /// `is_stored` says of the relations of `kept` which are there as a whole; the others are derived, their kept rows
    /// given.
    pub(super) fn new(
        program: &'a Program,
        kept: &'a Kept,
        known: usize,
        is_stored: &dyn Fn(RelationId) -> bool,
        computed: &[(RelationId, &'a dyn Computed)],
        watch: Rc<Watch>,
    ) -> Self {
        let kind = |n: usize| match n < known && is_stored(RelationId(n as u32)) {
            true => Kind::Stored,
            false => Kind::Derived,
        };
        let mut kinds: Vec<Kind<'a>> = (0..program.relations.len()).map(kind).collect();
        for (relation, by) in computed {
            kinds[relation.index()] = Kind::Computed(*by);
        }
        let mut clauses: HashMap<RelationId, Vec<usize>> = HashMap::new();
        for (n, clause) in program.clauses.iter().enumerate() {
            if matches!(kinds[clause.head.index()], Kind::Derived) {
                clauses.entry(clause.head).or_default().push(n);
            }
        }
        let mut groups = HashMap::new();
        for stratum in program.strata.iter() {
            let is_own = |of: &RelationId| stratum.relations.contains(of);
            let mut is_recursive = false;
            for n in &stratum.clauses {
                let clause = &program.clauses[*n];
                if matches!(kinds[clause.head.index()], Kind::Derived) {
                    reads(&clause.body, false, &mut |of, _, _| is_recursive |= is_own(&of));
                }
            }
            if is_recursive {
                let group: Rc<[RelationId]> = stratum.relations.as_slice().into();
                groups.extend(stratum.relations.iter().map(|of| (*of, Rc::clone(&group))));
            }
        }
        Self {
            program,
            kept,
            kinds,
            clauses,
            groups,
            watch,
            state: RefCell::default(),
            depth: Cell::new(0),
        }
    }

    /// What went wrong in any call.
    pub(super) fn error(&self) -> Option<AskError> {
        self.state.borrow().error.clone()
    }

    fn fail(&self, error: AskError) {
        self.state.borrow_mut().error.get_or_insert(error);
        self.watch.stop();
    }

    pub(super) fn clauses_of(&self, relation: RelationId) -> &[usize] {
        self.clauses.get(&relation).map_or(&[], Vec::as_slice)
    }

    /// Whether a relation's rows may be given besides what its clauses derive.
    pub(super) fn has_given(&self, relation: RelationId) -> bool {
        relation.index() < self.kept.len() && self.kept.rows(relation).len() > 0
    }

    fn columns(&self, relation: RelationId) -> usize {
        self.program.info(relation).columns.len()
    }

    /// Whether a relation is computed or wholly kept: a proof ends there.
    pub(super) fn is_ground(&self, relation: RelationId) -> bool {
        !matches!(self.kinds[relation.index()], Kind::Derived)
    }

    pub(super) fn is_stored(&self, relation: RelationId) -> bool {
        matches!(self.kinds[relation.index()], Kind::Stored)
    }

    fn answer(
        &self,
        relation: RelationId,
        mask: Mask,
        key: &[Word],
        words: &mut Words,
    ) -> Rc<Flat> {
        match self.kinds[relation.index()] {
            Kind::Computed(by) => self.compute(by, relation, mask, key, words),
            Kind::Stored => self.given(relation, mask, key, words),
            Kind::Derived if self.groups.contains_key(&relation) => {
                self.magic(relation, mask, key, words)
            }
            Kind::Derived => self.derive(relation, mask, key, words),
        }
    }

    /// Kept rows that fit a key.
    fn given(&self, relation: RelationId, mask: Mask, key: &[Word], _: &mut Words) -> Rc<Flat> {
        let mut flat = Flat::new(self.columns(relation));
        self.each_given(relation, mask, key, &mut |row| flat.push(row));
        Rc::new(flat)
    }

    fn each_given(
        &self,
        relation: RelationId,
        mask: Mask,
        key: &[Word],
        f: &mut dyn FnMut(&[Word]),
    ) {
        if !self.has_given(relation) {
            return;
        }
        let exprs: Vec<Expr> = columns_of(mask).map(|c| Expr::Variable(c as u32)).collect();
        let index = self.kept.shared_index(relation, &exprs);
        let source = self.kept.source(relation, index.as_ref(), None, View::After);
        let mut slots = Vec::new();
        source.collect(key, &mut slots);
        slots.into_iter().for_each(|slot| f(source.rows.row(slot)));
    }

    fn compute(
        &self,
        by: &dyn Computed,
        relation: RelationId,
        mask: Mask,
        key: &[Word],
        words: &mut Words,
    ) -> Rc<Flat> {
        let info = self.program.info(relation);
        if !by.ways().iter().any(|(needs, _)| needs & mask == *needs) {
            self.fail(self.blocked_error(relation, by, None));
            return Rc::default();
        }
        let mut known = vec![None; info.columns.len()];
        for (column, word) in columns_of(mask).zip(key) {
            if *word == NO_WORD {
                return Rc::new(Flat::new(info.columns.len()));
            }
            known[column] = Some(words.value(*word, info.columns[column].kind));
        }
        let mut rows = heap(info.columns.len());
        let mut row = Vec::new();
        by.rows(&known, &mut |values| {
            debug_assert_eq!(values.len(), info.columns.len(), "{}", info.name);
            row.clear();
            let kinds = info.columns.iter().map(|column| column.kind);
            let words_of = values.iter().zip(kinds);
            row.extend(words_of.map(|(value, kind)| words.of(value, kind).unwrap_or(NO_WORD)));
            // What a computation gives besides what it was asked is no answer.
            let fits = columns_of(mask).zip(key).all(|(column, word)| row[column] == *word);
            if fits && row.len() == info.columns.len() {
                rows.push(&row);
            }
        });
        let rows = rows.sort();
        let mut flat = Flat::new(info.columns.len());
        (0..rows.len()).for_each(|at| flat.push(rows.row(at)));
        Rc::new(flat)
    }

    /// A call of a relation without recursion.
    fn derive(
        &self,
        relation: RelationId,
        mask: Mask,
        key: &[Word],
        words: &mut Words,
    ) -> Rc<Flat> {
        let columns = self.columns(relation);
        let mut rows = heap(columns);
        self.each_given(relation, mask, key, &mut |row| rows.push(&row[..columns]));
        for number in self.clauses_of(relation) {
            let Some(planned) = self.planned(*number, mask, Wanted::Rows) else {
                return Rc::default();
            };
            let mut registers = planned.registers(mask, key);
            let limit = self.program.info(relation).limit_size.unwrap_or(MAX_ROWS);
            let watch = Rc::clone(&self.watch);
            let mut head = Head::new(self.program, &planned.clause, limit, rows.as_sink(), &watch);
            self.run_with(&planned.indexes, &planned.plan, &mut registers, words, &mut head);
            if self.watch.is_over() {
                self.watch.found(rows.len());
                self.fail_at(*number);
                break;
            }
        }
        let rows = rows.sort();
        let limit = self.watch.limits().rows;
        if let Some(last) = self.clauses_of(relation).last()
            && rows.len() > limit
        {
            let last = &self.program.clauses[*last];
            self.fail(AskError::Evaluate(self.program.too_many(last, limit)));
        }
        let mut flat = Flat::new(columns);
        (0..rows.len()).for_each(|at| flat.push(rows.row(at)));
        Rc::new(flat)
    }

    /// Whether a call of a relation without recursion has a row.
    fn derives(&self, relation: RelationId, mask: Mask, key: &[Word], words: &mut Words) -> bool {
        let mut found = false;
        self.each_given(relation, mask, key, &mut |_| found = true);
        for number in self.clauses_of(relation) {
            if found {
                break;
            }
            let Some(planned) = self.planned(*number, mask, Wanted::Any) else { return false };
            let mut registers = planned.registers(mask, key);
            let mut first = |_: &[Word], _: &mut Words| true;
            let CallPlan { plan, indexes, .. } = &*planned;
            found = self.run_with(indexes, plan, &mut registers, words, &mut first);
            if self.watch.is_over() {
                self.watch.found(0);
                self.fail_at(*number);
            }
        }
        found
    }

    /// Says that a limit was reached in a clause; the innermost call says so first.
    fn fail_at(&self, number: usize) {
        let clause = &self.program.clauses[number];
        if let Err(error) = self.program.check_limits(clause, &self.watch) {
            self.fail(error.into());
        }
    }

    /// What a call within calls comes to; none where they go too deep.
    fn deeper<T>(&self, relation: RelationId, call: impl FnOnce() -> T) -> Option<T> {
        if self.depth.get() >= MAX_DEPTH {
            self.fail(AskError::TooDeep { relation: self.program.info(relation).name.clone() });
            return None;
        }
        self.depth.set(self.depth.get() + 1);
        let found = call();
        self.depth.set(self.depth.get() - 1);
        Some(found)
    }

    fn planned(&self, number: usize, mask: Mask, wanted: Wanted) -> Option<Rc<CallPlan>> {
        if let Some(known) = self.state.borrow().plans.get(&(number, mask, wanted)) {
            return Some(Rc::clone(known));
        }
        let clause = &self.program.clauses[number];
        let info = self.program.info(clause.head);
        let (mut clause, head, _) = turned(clause, &info.columns);
        clause.args = head.iter().map(|v| Expr::Variable(*v)).collect();
        let bound: Vec<VariableId> = columns_of(mask).map(|column| head[column]).collect();
        let columns: &[VariableId] = match wanted {
            Wanted::Rows => &head,
            Wanted::Any => &[],
        };
        let plan = self.plan(&clause, &bound, columns)?;
        let indexes = self.indexes(&plan);
        let planned = Rc::new(CallPlan { clause, head, plan, indexes });
        self.state.borrow_mut().plans.insert((number, mask, wanted), Rc::clone(&planned));
        Some(planned)
    }

    /// The plan of a clause over finished relations; none where it would have to ask a computed relation as that cannot
    /// be asked.
    pub(super) fn plan(
        &self,
        clause: &Clause,
        bound: &[VariableId],
        wanted: &[VariableId],
    ) -> Option<Plan> {
        let versions = vec![Version::Finished; clause.body.len()];
        let task = Task { clause, versions: &versions, first: None, bound, wanted };
        let (plan, cost) = plan_with_cost(&task, self);
        if cost.is_finite() {
            return Some(plan);
        }
        self.blocked(clause);
        None
    }

    /// Says which relation of a clause cannot be asked in any order.
    pub(super) fn blocked(&self, clause: &Clause) {
        let mut computed = None;
        reads(&clause.body, false, &mut |of, _, at| {
            if let Kind::Computed(by) = self.kinds.get(of.index()).unwrap_or(&Kind::Stored) {
                computed.get_or_insert((of, *by, at));
            }
        });
        if let Some((relation, by, at)) = computed {
            self.fail(self.blocked_error(relation, by, Some(at)));
        }
    }

    fn blocked_error(&self, relation: RelationId, by: &dyn Computed, at: Option<Span>) -> AskError {
        let info = self.program.info(relation);
        let way = |mask: &Mask| {
            let names = columns_of(*mask).filter_map(|column| info.columns.get(column));
            names.map(|column| column.name.as_str()).collect()
        };
        let ways = by.ways();
        let is_least =
            |mask: &Mask| ways.iter().all(|(other, _)| other == mask || other & mask != *other);
        let least = ways.iter().map(|(mask, _)| mask).filter(|mask| is_least(mask));
        let least: Vec<Vec<&str>> = least.map(way).collect();
        let needs = |language: Language| {
            let and = told!(language, "and");
            let ways: Vec<String> = least.iter().map(|names| names.join(&and)).collect();
            ways.join(&told!(language, "or"))
        };
        AskError::Blocked {
            relation: info.name.clone(),
            needs: Bilingual::both(needs),
            place: at.map(|at| self.program.place(at) + ": ").unwrap_or_default(),
        }
    }

    /// Runs a plan over finished relations.
    pub(super) fn run(
        &self,
        plan: &Plan,
        registers: &mut [Word],
        words: &mut Words,
        goal: &mut dyn Goal,
    ) -> bool {
        self.run_with(&self.indexes(plan), plan, registers, words, goal)
    }

    fn indexes(&self, plan: &Plan) -> Indexes {
        plan.requests.iter().map(|request| self.index(request)).collect()
    }

    fn run_with(
        &self,
        indexes: &[Option<Arc<KeptIndex>>],
        plan: &Plan,
        registers: &mut [Word],
        words: &mut Words,
        goal: &mut dyn Goal,
    ) -> bool {
        let sources = plan.requests.iter().zip(indexes);
        let sources: Vec<Source<'_>> =
            sources.map(|(request, index)| self.source(request, index.as_ref())).collect();
        run(&plan.steps, &sources, registers, words, &self.watch, goal)
    }

    /// A call of a recursive relation.
    fn magic(&self, relation: RelationId, mask: Mask, key: &[Word], words: &mut Words) -> Rc<Flat> {
        let columns = self.columns(relation);
        if let Some(found) = self.state.borrow().tables.beside((relation, mask), key, columns) {
            return found;
        }
        let known = self.state.borrow().magic.get(&(relation, mask)).map(Rc::clone);
        let magic = known.unwrap_or_else(|| {
            let group = &self.groups[&relation];
            let magic = Rc::new(Magic::new(self, group, relation, mask));
            self.state.borrow_mut().magic.insert((relation, mask), Rc::clone(&magic));
            magic
        });
        match magic.evaluate(self, key, words) {
            Ok(answers) => {
                let mut flat = Flat::new(columns);
                // The first way is that of the call.
                if let Some((_, own)) = answers.first() {
                    for at in 0..own.rows.len() {
                        let row = own.rows.row(at);
                        if columns_of(mask).map(|column| &row[column]).eq(key) {
                            flat.push(row);
                        }
                    }
                }
                let mut state = self.state.borrow_mut();
                for (way, besides) in answers.into_iter().filter(|(_, one)| one.calls.len() > 1) {
                    state.tables.keep_besides(way, besides);
                }
                Rc::new(flat)
            }
            Err(error) => {
                self.fail(error.into());
                Rc::default()
            }
        }
    }

    /// Whether so many different calls are a good part of all that there can be.
    fn is_worth_all(&self, relation: RelationId, mask: Mask, calls: usize) -> bool {
        mask != 0
            && calls >= FEW_CALLS
            && matches!(self.kinds[relation.index()], Kind::Derived)
            && calls as f64 * 4.0 > self.distinct(relation, 0)
            && self.can_ask_for_all(relation, &mut Vec::new())
    }

    /// Whether a relation of a lower stratum has rows enough for evaluation only, whatever it is asked.
    pub(super) fn is_finite(&self, relation: RelationId) -> bool {
        self.can_ask_for_all(relation, &mut Vec::new())
    }

    /// No computed relation, which may not be asked for all, and no growth without end that a key would bound.
    fn can_ask_for_all(&self, relation: RelationId, seen: &mut Vec<RelationId>) -> bool {
        if seen.contains(&relation) {
            return true;
        }
        seen.push(relation);
        match self.kinds[relation.index()] {
            Kind::Stored => true,
            Kind::Computed(_) => false,
            Kind::Derived => self.clauses_of(relation).iter().all(|number| {
                let clause = &self.program.clauses[*number];
                let computes = clause.args.iter().any(|arg| matches!(arg, Expr::Call(..)));
                let mut all = !(computes && self.groups.contains_key(&relation));
                reads(&clause.body, false, &mut |of, _, _| {
                    all = all && self.can_ask_for_all(of, seen);
                });
                all
            }),
        }
    }

    /// Answers all calls of a relation by some columns at once.
    fn answer_all(&self, relation: RelationId, mask: Mask, words: &mut Words) {
        let all = self.rows(relation, 0, &[], words);
        let columns = self.columns(relation);
        self.state.borrow_mut().tables.keep_all((relation, mask), &all, columns);
    }

    /// The size of a derived relation is taken for that of the largest that it reads.
    fn derived_size(&self, relation: RelationId) -> f64 {
        if let Some(known) = self.state.borrow().sizes.get(&relation) {
            return *known;
        }
        // Recursion ends here.
        self.state.borrow_mut().sizes.insert(relation, 16.0);
        let mut most: f64 = 16.0;
        for number in self.clauses_of(relation) {
            reads(&self.program.clauses[*number].body, false, &mut |of, _, _| {
                most = most.max(self.size(of));
            });
        }
        // Closures are larger than what they close.
        let grows = if self.groups.contains_key(&relation) { GROWTH } else { 1.0 };
        self.state.borrow_mut().sizes.insert(relation, most * grows);
        most * grows
    }
}

impl Lookup for Demand<'_> {
    fn rows(&self, relation: RelationId, mask: Mask, key: &[Word], words: &mut Words) -> Rc<Flat> {
        let way = (relation, mask);
        let known = self.state.borrow().tables.rows(way, key, self.columns(relation));
        if let Some(known) = known {
            return known;
        }
        if self.watch.is_over() {
            return Rc::default();
        }
        let calls = self.state.borrow().tables.calls(way);
        if self.is_worth_all(relation, mask, calls) {
            self.answer_all(relation, mask, words);
            return self.rows(relation, mask, key, words);
        }
        let deeper = || self.answer(relation, mask, key, words);
        let Some(rows) = self.deeper(relation, deeper) else { return Rc::default() };
        self.state.borrow_mut().tables.keep(way, key, Rc::clone(&rows));
        rows
    }

    fn has_rows(&self, relation: RelationId, mask: Mask, key: &[Word], words: &mut Words) -> bool {
        let way = (relation, mask);
        let known = self.state.borrow().tables.has_rows(way, key);
        if let Some(known) = known {
            return known;
        }
        let is_derived = matches!(self.kinds[relation.index()], Kind::Derived)
            && !self.groups.contains_key(&relation);
        let calls = self.state.borrow().tables.calls(way);
        if !is_derived || self.watch.is_over() || self.is_worth_all(relation, mask, calls) {
            return self.rows(relation, mask, key, words).len > 0;
        }
        let deeper = || self.derives(relation, mask, key, words);
        let Some(has_rows) = self.deeper(relation, deeper) else { return false };
        self.state.borrow_mut().tables.keep_tested(way, key, has_rows);
        has_rows
    }
}

impl Outside for Demand<'_> {
    fn has(&self, relation: RelationId) -> bool {
        relation.index() < self.kinds.len()
    }

    fn index(&self, request: &Request) -> Option<Arc<KeptIndex>> {
        match request {
            Request::Index { relation, key, .. } if self.is_stored(*relation) => {
                self.kept.shared_index(*relation, key)
            }
            _ => None,
        }
    }

    fn source<'s>(&'s self, request: &'s Request, index: Option<&'s Arc<KeptIndex>>) -> Source<'s> {
        let (relation, key, columns) = match request {
            Request::Whole(relation) => (*relation, None, None),
            Request::Index { relation, key, columns } => {
                (*relation, Some(key), Some(columns.as_slice()))
            }
            Request::Growing { relation, .. } => (*relation, None, None),
        };
        if self.is_stored(relation) {
            return Source::Kept(self.kept.source(relation, index, columns, View::After));
        }
        let column = |part: &Expr| match part {
            Expr::Variable(column) => 1 << column,
            _ => 0,
        };
        let mask = key.map(|key| key.iter().map(column).fold(0, |all, one: Mask| all | one));
        Source::Called(Called { lookup: self, relation, mask, columns })
    }
}

impl Statistics for Demand<'_> {
    fn size(&self, relation: RelationId) -> f64 {
        match self.kinds.get(relation.index()) {
            Some(Kind::Stored) => self.kept.size(relation),
            Some(Kind::Computed(_)) | None => 1e3,
            Some(Kind::Derived) => self.derived_size(relation),
        }
    }

    fn distinct(&self, relation: RelationId, column: usize) -> f64 {
        match self.kinds.get(relation.index()) {
            Some(Kind::Stored) => self.kept.distinct(relation, column),
            Some(Kind::Derived) if self.groups.contains_key(&relation) => {
                (self.size(relation) / GROWTH).max(1.0)
            }
            _ => (self.size(relation) / 2.0).max(1.0),
        }
    }

    fn share(
        &self,
        relation: RelationId,
        column: usize,
        holds: &dyn Fn(Word, &Words) -> bool,
    ) -> f64 {
        match self.kinds.get(relation.index()) {
            Some(Kind::Stored) => {
                let rows = self.kept.rows(relation).base();
                share(&*rows, column, &|word| holds(word, &self.kept.words))
            }
            _ => UNKNOWN_SHARE,
        }
    }

    fn computes_keys(&self) -> bool {
        false
    }

    fn fan_out(&self, relation: RelationId, columns: &[usize]) -> Option<f64> {
        let Some(Kind::Computed(by)) = self.kinds.get(relation.index()) else { return None };
        let known = columns.iter().fold(0, |mask: Mask, column| mask | 1 << column);
        let ways = by.ways().iter().filter(|(needs, _)| needs & known == *needs);
        Some(ways.map(|(_, rows)| *rows).fold(f64::INFINITY, f64::min))
    }
}

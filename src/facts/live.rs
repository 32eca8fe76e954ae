//! A result that is kept in step with its input facts, tuple by tuple.
//!
//! Delete and rederive (Gupta, Mumick, Subrahmanian 1993), stratum by stratum. What lower strata lost and won names
//! the tuples that may fall and the tuples that may rise. A tuple that may fall is tried by running its rules
//! backwards: in a stratum without recursion that suffices. In a recursive stratum a tuple could hold itself up
//! through others, so first everything that hangs on a fallen tuple falls too, and then what still has a rule that
//! derives it, and all that follows from it, rises again. Negation and aggregates read lower strata only, so that what
//! they lost and won is known. A stratum of which a good part would fall is evaluated anew, which is then cheaper.
//!
//! The cost grows with the number of tuples that may fall or rise and with what they join, not with the size of the
//! relations.
//!
//! **Invariant**: after every update the result equals an evaluation of the same database from scratch.

use std::collections::{HashMap, HashSet};

use super::database::{Database, FactError, RelationKey};
use super::delta::{Deltas, Planned, Touch, turned_rows};
use super::derived::{Derived, Tuple};
use super::evaluate::{EvaluateError, Evaluation};
use super::head::Rows;
use super::kept::View;
use super::limits::{Limits, MAX_ROWS, Watch};
use super::program::{Program, Stratum};
use super::relations::RelationId;
use super::rows::Stored;
use super::strata::reads;
use super::word::{NO_WORD, Value, Word, Words};

type Row = Box<[Word]>;

/// A program, its input facts and what follows from them.
#[derive(Debug, Clone)]
pub struct Live {
    program: Program,
    database: Database,
    derived: Derived,
    deltas: Deltas,
    /// Facts of the text.
    written: HashSet<(RelationId, Row)>,
    /// Input tuples that were inserted or removed since the last update.
    touched: HashSet<(RelationId, Row)>,
    /// What the last update changed.
    last: HashMap<RelationId, Lines>,
}

/// Rows that an update added and removed.
#[derive(Debug, Clone, Default)]
struct Lines {
    added: Vec<Row>,
    removed: Vec<Row>,
}

impl Live {
    /// # Errors
    /// [`EvaluateError`] as from [`Program::evaluate`].
    pub fn new(program: Program, mut database: Database) -> Result<Self, EvaluateError> {
        database.consolidate();
        let derived = program.evaluate(&database)?;
        Ok(Self::resume(program, database, derived))
    }

    /// From a result of this database.
    pub(super) fn resume(program: Program, mut database: Database, derived: Derived) -> Self {
        // The database goes on from the result's words, so that kept rows keep their meaning.
        database.words = derived.kept.words.share();
        let written = program.facts.iter().map(|fact| (fact.relation, fact.words.clone()));
        Self {
            deltas: Deltas::new(&program),
            written: written.collect(),
            program,
            database,
            derived,
            touched: HashSet::new(),
            last: HashMap::new(),
        }
    }

    /// Makes the plans and indexes that updates need, which otherwise the first updates make as they need them.
    pub fn prepare(&mut self) {
        let kept = &mut self.derived.kept;
        for trigger in 0..self.deltas.triggers().len() {
            self.deltas.trigger(trigger, kept);
        }
        for clause in 0..self.program.clauses.len() {
            self.deltas.backwards(&self.program, clause, kept);
        }
    }

    /// Adds an input tuple; false when it was there. Takes effect at the next [`Self::update`].
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn insert(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<bool, FactError> {
        let (relation, row) = self.database.encode(relation, tuple)?;
        let changed = self.database.insert_row(relation, &row);
        self.touch(relation, row, changed);
        Ok(changed)
    }

    /// Takes an input tuple out; false when it was not there. Takes effect at the next [`Self::update`].
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn remove(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<bool, FactError> {
        let (relation, row) = self.database.find_row(relation, tuple)?;
        let changed = self.database.remove_row(relation, &row);
        self.touch(relation, row, changed);
        Ok(changed)
    }

    /// The relations that an edit cannot be followed through tuple by tuple: those with a choice domain, a `.limitsize`,
    /// subsumption or `autoinc()`, and what is recursive with them. They are evaluated anew when something that they
    /// read has changed; which tuple a choice keeps may then be another one, as in an evaluation from scratch.
    pub fn evaluated_anew(&self) -> impl Iterator<Item = RelationId> {
        let beyond = |stratum: &&Stratum| self.program.is_beyond_edits(stratum);
        self.program.strata.iter().filter(beyond).flat_map(|stratum| stratum.relations.clone())
    }

    /// Whether an edit waits for [`Self::update`].
    pub(super) fn has_edits(&self) -> bool {
        !self.touched.is_empty()
    }

    fn touch(&mut self, relation: RelationId, row: Vec<Word>, changed: bool) {
        if changed {
            self.touched.insert((relation, row.into()));
        }
    }

    /// Brings the result up to the input facts, and tells which relations changed.
    ///
    /// # Errors
    /// [`EvaluateError`]; the result then still stands for the input before the update, which may be tried again.
    pub fn update(&mut self) -> Result<Vec<RelationId>, EvaluateError> {
        self.last.clear();
        if self.touched.is_empty() {
            return Ok(Vec::new());
        }
        // Input tuples may have brought new words.
        self.derived.kept.words = self.database.words.share();
        self.derived.kept.take_shelf();
        let told = self.told();
        let mut update = Update {
            program: &self.program,
            database: &self.database,
            written: &self.written,
            derived: &mut self.derived,
            deltas: &mut self.deltas,
            told: &told,
        };
        let done = self.program.strata.iter().try_for_each(|stratum| update.stratum(stratum));
        if let Err(fault) = done {
            self.derived.kept.roll_back();
            return Err(fault);
        }
        for (n, given) in self.derived.given.iter_mut().enumerate() {
            if let (Some(given), Some(lines)) = (given, told.get(&RelationId(n as u32))) {
                for row in &lines.removed {
                    given.remove(row);
                }
                for row in &lines.added {
                    given.insert(row);
                }
            }
        }
        self.note_changes();
        if self.derived.kept.commit() {
            self.deltas.plan_anew();
        }
        self.derived.kept.words.consolidate();
        self.database.words = self.derived.kept.words.share();
        self.touched.clear();
        let mut changed: Vec<RelationId> = self.last.keys().copied().collect();
        changed.sort_unstable();
        Ok(changed)
    }

    /// The told tuples that really came or went since the last update.
    fn told(&self) -> HashMap<RelationId, Lines> {
        let mut told: HashMap<RelationId, Lines> = HashMap::new();
        for (relation, row) in &self.touched {
            let is_told = self.database.contains_row(*relation, row)
                || self.written.contains(&(*relation, row.clone()));
            if is_told == self.derived.is_told(*relation, row) {
                continue;
            }
            let lines = told.entry(*relation).or_default();
            let side = if is_told { &mut lines.added } else { &mut lines.removed };
            side.push(row.clone());
        }
        told
    }

    fn note_changes(&mut self) {
        let kept = &self.derived.kept;
        for (relation, info) in self.program.relations() {
            let edit = kept.edit(relation);
            if edit.is_empty() {
                continue;
            }
            let row = |slot: &u32| kept.rows(relation).row(*slot)[..info.columns.len()].into();
            let mut lines = Lines {
                added: edit.added.iter().map(row).collect(),
                removed: edit.removed.iter().map(row).collect(),
            };
            lines.added.sort_unstable();
            lines.removed.sort_unstable();
            self.last.insert(relation, lines);
        }
    }

    /// The tuples of a relation that the last update added.
    pub fn added(&self, relation: RelationId) -> impl Iterator<Item = Tuple<'_>> {
        let rows = self.last.get(&relation).into_iter().flat_map(|lines| &lines.added);
        rows.map(move |row| self.derived.tuple(relation, row))
    }

    /// The tuples of a relation that the last update removed.
    pub fn removed(&self, relation: RelationId) -> impl Iterator<Item = Tuple<'_>> {
        let rows = self.last.get(&relation).into_iter().flat_map(|lines| &lines.removed);
        rows.map(move |row| self.derived.tuple(relation, row))
    }

    /// What followed at the last update.
    #[must_use]
    pub fn derived(&self) -> &Derived {
        &self.derived
    }

    /// The input facts, changes since the last update included.
    #[must_use]
    pub fn database(&self) -> &Database {
        &self.database
    }

    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }
}

impl Program {
    /// Whether what a stratum derives cannot be told from what changed: which tuples a `.limitsize` or a choice keeps and
    /// which numbers are given depends on the order of evaluation, and what a subsumption took out is not known any more.
    fn is_beyond_edits(&self, stratum: &Stratum) -> bool {
        let keeps_some = |relation: &RelationId| {
            let info = self.info(*relation);
            info.limit_size.is_some() || !info.choices.is_empty()
        };
        stratum.relations.iter().any(keeps_some)
            || !stratum.subsumptions.is_empty()
            || stratum.clauses.iter().any(|n| self.clauses[*n].counts_on())
    }
}

/// An update under way.
struct Update<'a> {
    program: &'a Program,
    database: &'a Database,
    written: &'a HashSet<(RelationId, Row)>,
    derived: &'a mut Derived,
    deltas: &'a mut Deltas,
    told: &'a HashMap<RelationId, Lines>,
}

/// What a tuple takes that an update adds, near enough.
const BYTES_A_TUPLE: usize = 128;

/// More may have to be given up than evaluation from scratch would cost.
struct TooMuch;

impl Update<'_> {
    fn stratum(&mut self, stratum: &Stratum) -> Result<(), EvaluateError> {
        if !self.is_affected(stratum) {
            return Ok(());
        }
        let is_own = |relation: RelationId| stratum.relations.contains(&relation);
        let mut is_recursive = false;
        for clause in stratum.clauses.iter().map(|n| &self.program.clauses[*n]) {
            reads(&clause.body, false, &mut |r, _, _| is_recursive |= is_own(r));
        }
        if self.program.is_beyond_edits(stratum) || self.edit(stratum, is_recursive)?.is_err() {
            return self.anew(stratum);
        }
        for relation in &stratum.relations {
            let size = self.derived.kept.rows(*relation).len();
            let own = stratum.clauses.iter().map(|n| &self.program.clauses[*n]);
            let last = own.rev().find(|clause| clause.head == *relation);
            if let Some(last) = last.filter(|_| size >= MAX_ROWS) {
                return Err(self.program.too_many(last, MAX_ROWS));
            }
        }
        Ok(())
    }

    fn is_affected(&self, stratum: &Stratum) -> bool {
        let mut affected = stratum.relations.iter().any(|r| self.told.contains_key(r));
        // One more number here is another number in every later rule that counts on.
        affected |= stratum.clauses.iter().any(|n| self.program.clauses[*n].counts_on());
        for clause in &stratum.clauses {
            let body = &self.program.clauses[*clause].body;
            reads(body, false, &mut |r, _, _| affected |= !self.derived.kept.edit(r).is_empty());
        }
        affected
    }

    fn edit(
        &mut self,
        stratum: &Stratum,
        is_recursive: bool,
    ) -> Result<Result<(), TooMuch>, EvaluateError> {
        let size: usize = stratum.relations.iter().map(|r| self.derived.kept.rows(*r).len()).sum();
        let most = size / 4 + 64;
        let mut falling: HashSet<(RelationId, Row)> = HashSet::new();
        let mut queue: Vec<(RelationId, Row)> = Vec::new();
        for relation in &stratum.relations {
            let lines = self.told.get(relation).into_iter().flat_map(|lines| &lines.removed);
            lines.for_each(|row| queue.push((*relation, row.clone())));
        }
        self.touched_heads(stratum, View::Before, &mut queue);
        while !queue.is_empty() {
            let mut new = Vec::new();
            for (relation, row) in std::mem::take(&mut queue) {
                if self.derived.kept.holds(relation, &row, View::Before)
                    && falling.insert((relation, row.clone()))
                {
                    new.push((relation, row));
                }
            }
            if falling.len() > most {
                return Ok(Err(TooMuch));
            }
            if is_recursive {
                self.follow(stratum, &new, View::Before, &mut queue);
            }
        }
        for (relation, row) in &falling {
            self.derived.kept.take(*relation, row);
        }
        let mut rising: Vec<(RelationId, Row)> = Vec::new();
        for (relation, row) in falling {
            if self.is_told(relation, &row) || self.is_derived(stratum, relation, &row) {
                rising.push((relation, row));
            }
        }
        for relation in &stratum.relations {
            let lines = self.told.get(relation).into_iter().flat_map(|lines| &lines.added);
            lines.for_each(|row| rising.push((*relation, row.clone())));
        }
        self.touched_heads(stratum, View::After, &mut rising);
        let mut added = 0;
        let watch = Watch::new(Limits::default());
        while !rising.is_empty() {
            let mut new = Vec::new();
            for (relation, row) in std::mem::take(&mut rising) {
                if self.derived.kept.add(relation, &row) {
                    new.push((relation, row));
                }
            }
            added += new.len();
            if let Some(clause) = stratum.clauses.first() {
                let clause = &self.program.clauses[*clause];
                if added >= MAX_ROWS {
                    return Err(self.program.too_many(clause, MAX_ROWS));
                }
                watch.found(added);
                if watch.weigh(added * BYTES_A_TUPLE) {
                    self.program.check_limits(clause, &watch)?;
                }
            }
            if is_recursive {
                self.follow(stratum, &new, View::After, &mut rising);
            }
        }
        Ok(Ok(()))
    }

    /// Heads of the stratum's clauses that changes of lower strata touch: before the update those that may fall,
    /// after it those that may rise.
    fn touched_heads(&mut self, stratum: &Stratum, view: View, found: &mut Vec<(RelationId, Row)>) {
        let triggers = self.deltas.triggers();
        let mut lower: Vec<RelationId> = Vec::new();
        for clause in &stratum.clauses {
            let body = &self.program.clauses[*clause].body;
            reads(body, false, &mut |r, _, _| {
                if !stratum.relations.contains(&r) && !lower.contains(&r) {
                    lower.push(r);
                }
            });
        }
        lower.retain(|r| !self.derived.kept.edit(*r).is_empty());
        for relation in lower {
            for number in self.deltas.of(relation) {
                let trigger = &triggers[number];
                if !stratum.clauses.contains(&trigger.number) {
                    continue;
                }
                let (added, removed) = match (trigger.touch, view) {
                    (Touch::Positive, View::Before) | (Touch::Negated, View::After) => {
                        (false, true)
                    }
                    (Touch::Positive, View::After) | (Touch::Negated, View::Before) => {
                        (true, false)
                    }
                    (Touch::Counted, _) => (true, true),
                };
                let rows = self.changed(relation, added, removed);
                self.heads(number, &rows, view, found);
            }
        }
    }

    fn changed(&self, relation: RelationId, added: bool, removed: bool) -> Vec<Row> {
        let kept = &self.derived.kept;
        let (rows, edit) = (kept.rows(relation), kept.edit(relation));
        let columns = self.program.info(relation).columns.len();
        let added = edit.added.iter().filter(|_| added);
        let slots = added.chain(edit.removed.iter().filter(|_| removed));
        slots.map(|slot| rows.row(*slot)[..columns].into()).collect()
    }

    /// Heads that follow from rows of the stratum itself.
    fn follow(
        &mut self,
        stratum: &Stratum,
        rows: &[(RelationId, Row)],
        view: View,
        found: &mut Vec<(RelationId, Row)>,
    ) {
        let triggers = self.deltas.triggers();
        for relation in &stratum.relations {
            let of = rows.iter().filter(|(r, _)| r == relation);
            let own: Vec<Row> = of.map(|(_, row)| row.clone()).collect();
            if own.is_empty() {
                continue;
            }
            for number in self.deltas.of(*relation) {
                if stratum.clauses.contains(&triggers[number].number) {
                    self.heads(number, &own, view, found);
                }
            }
        }
    }

    fn heads(
        &mut self,
        trigger: usize,
        rows: &[Row],
        view: View,
        found: &mut Vec<(RelationId, Row)>,
    ) {
        if rows.is_empty() {
            return;
        }
        let planned = self.deltas.trigger(trigger, &mut self.derived.kept);
        let Planned { clause, plan, .. } = &*planned;
        let turned = turned_rows(plan, rows, rows[0].len());
        let mut heads = Rows::default();
        heads.fill(self.program, clause, |goal| {
            let mut registers = vec![0; clause.variables.len()];
            self.derived.kept.run(plan, view, &turned, &mut registers, goal);
        });
        found.extend(heads.rows.into_iter().map(|row| (clause.head, row)));
    }

    fn is_told(&self, relation: RelationId, row: &Row) -> bool {
        self.database.contains_row(relation, row) || self.written.contains(&(relation, row.clone()))
    }

    /// Whether a clause of the stratum derives the row after the update.
    fn is_derived(&mut self, stratum: &Stratum, relation: RelationId, row: &Row) -> bool {
        let clauses = stratum.clauses.iter().filter(|n| self.program.clauses[**n].head == relation);
        for number in clauses {
            let planned = self.deltas.backwards(self.program, *number, &mut self.derived.kept);
            let mut registers = vec![NO_WORD; planned.clause.variables.len()];
            for (v, word) in planned.head.iter().zip(row) {
                registers[*v as usize] = *word;
            }
            let mut yes = |_: &[Word], _: &mut Words| true;
            let kept = &mut self.derived.kept;
            if kept.run(&planned.plan, View::After, &[], &mut registers, &mut yes) {
                return true;
            }
        }
        false
    }

    /// Evaluates the stratum from nothing.
    fn anew(&mut self, stratum: &Stratum) -> Result<(), EvaluateError> {
        let program = self.program;
        let mut evaluation =
            Evaluation::of(program, self.database, &stratum.relations, Limits::default());
        evaluation.finished.words = std::mem::take(&mut self.derived.kept.words);
        for clause in &stratum.clauses {
            reads(&program.clauses[*clause].body, false, &mut |relation, _, _| {
                if !stratum.relations.contains(&relation) {
                    let rows = self.derived.kept.shared(relation);
                    evaluation.finished.rows[relation.0 as usize] = Some(rows);
                }
            });
        }
        let done = evaluation.stratum(stratum);
        self.derived.kept.words = std::mem::take(&mut evaluation.finished.words);
        done?;
        for relation in &stratum.relations {
            let Some(now) = evaluation.finished.rows[relation.0 as usize].take() else { continue };
            let columns = program.info(*relation).columns.len();
            let now = now.stored();
            let before = self.derived.kept.rows(*relation).rows().stored();
            let gone = missing(&*before, &*now, columns);
            let came = missing(&*now, &*before, columns);
            for row in &gone {
                self.derived.kept.take(*relation, row);
            }
            for row in &came {
                self.derived.kept.add(*relation, row);
            }
        }
        self.deltas.plan_anew();
        Ok(())
    }
}

/// Rows of one that the other lacks.
fn missing(of: &dyn Stored, other: &dyn Stored, columns: usize) -> Vec<Row> {
    let mut all = of.starting(&[]);
    let mut found: Vec<Row> = Vec::new();
    while let Some(slot) = all.next(of) {
        if other.find(of.row(slot)).is_none() {
            found.push(of.row(slot)[..columns].into());
        }
    }
    found
}

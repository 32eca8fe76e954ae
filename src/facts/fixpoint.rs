//! A recursive stratum, round by round, semi-naively.
//!
//! Each round joins what the last round found, with datafrog's variables keeping recent rows apart from stable ones. A rule
//! with several atoms of the stratum runs once for each: that atom over the recent rows, those before it over the stable
//! ones, those behind it over both.

use std::cell::Ref;
use std::collections::HashMap;
use std::time::Instant;

use datafrog::Iteration;

use super::apart::handed_on;
use super::evaluate::{EvaluateError, Evaluation, no_parts, own_atoms};
use super::growing::{self, Growing, Version};
use super::limits::MAX_ROWS;
use super::plan::{Plan, Request};
use super::program::{Clause, Stratum};
use super::relations::RelationId;
use super::rows::RowSet;
use super::spread::Makes;
use super::subsume::{Chosen, Dominated, Pruned, choosing};
use super::word::Word;

/// How often the time from which a join is divided the rounds of a recursive relation go on in one thread, before they
/// are: most relations are done by then.
const ROUNDS_ALONE: u32 = 2;

/// With fewer rows they always go on in one thread: not even the clock is looked at.
const FEWEST_ALONE: usize = 10_000;

/// For relations with choice domains the combinations that have their tuple.
type Choices = HashMap<RelationId, Chosen>;

impl Evaluation<'_> {
    pub(super) fn fixpoint(
        &mut self,
        stratum: &Stratum,
        clauses: &[&Clause],
    ) -> Result<(), EvaluateError> {
        let program = self.program;
        let (mut iteration, mut orders) = (Iteration::new(), Iteration::new());
        let is_pruned = !stratum.subsumptions.is_empty();
        let mut choices = Choices::new();
        let mut growing: HashMap<RelationId, Box<dyn Growing>> = HashMap::new();
        for relation in &stratum.relations {
            let info = program.info(*relation);
            let columns = info.columns.len();
            let rows: Box<dyn Growing> = match is_pruned {
                true => Box::new(Pruned::new(columns)),
                false => growing::growing(&mut iteration, &info.name, columns),
            };
            let given = &self.given[relation.index()];
            let mut chosen = self.chosen(*relation);
            for at in 0..given.len() {
                let mut sink = rows.sink();
                let row = &given.row(at)[..columns];
                choosing(&mut *sink, chosen.as_mut()).as_sink().push(row);
            }
            choices.extend(chosen.map(|chosen| (*relation, chosen)));
            growing.insert(*relation, rows);
        }
        let is_own = |relation: RelationId| stratum.relations.contains(&relation);
        let is_any_order = clauses.iter().all(|clause| Makes::of(clause) == Makes::Nothing);
        let mut rounds: Vec<(&Clause, Plan)> = Vec::new();
        // For each relation the clause that was the last to find something.
        let mut last: HashMap<RelationId, &Clause> = HashMap::new();
        for clause in clauses {
            let own: Vec<usize> = own_atoms(clause, &is_own).collect();
            if own.is_empty() {
                let versions = vec![Version::Finished; clause.body.len()];
                let mut plan = self.plan(clause, &versions, None);
                self.finished.provide(&mut plan);
                let limit = self.limit(clause.head);
                let mut sink = growing[&clause.head].sink();
                let mut sink = choosing(&mut *sink, choices.get_mut(&clause.head));
                let parts = no_parts(&plan);
                self.emit(clause, &plan, &parts, limit, is_any_order, sink.as_sink());
                self.check_limits(clause)?;
                last.insert(clause.head, clause);
            }
            self.rounds(clause, &own, &mut rounds);
        }
        let mut pruning: Vec<(&Clause, Plan)> = Vec::new();
        for n in &stratum.subsumptions {
            let clause = &program.subsumptions[*n].clause;
            let own: Vec<usize> = own_atoms(clause, &is_own).collect();
            self.rounds(clause, &own, &mut pruning);
        }
        // The number of the order that each growing source is read in.
        let mut orders_of = |rounds: &[(&Clause, Plan)]| -> Vec<Vec<usize>> {
            let mut of_plan = |plan: &Plan| {
                let order = |request: &Request| match request {
                    Request::Growing { relation, first, version } => {
                        let rows = growing.get_mut(relation);
                        rows.map_or(0, |rows| rows.order(&mut orders, first, *version))
                    }
                    _ => 0,
                };
                plan.requests.iter().map(order).collect()
            };
            rounds.iter().map(|(_, plan)| of_plan(plan)).collect()
        };
        let (pruning_orders, orders_of) = (orders_of(&pruning), orders_of(&rounds));
        let finished = self.finished.bytes();
        let spread_from = self.finished.watch.limits().spread_from;
        let alone = match stratum.relations.as_slice() {
            [one]
                if is_any_order
                    && !is_pruned
                    && choices.is_empty()
                    && self.finished.outside.is_none() =>
            {
                handed_on(*one, program.info(*one).columns.len(), &rounds)
                    .map(|column| (*one, column))
            }
            _ => None,
        };
        let since = Instant::now();
        loop {
            growing.values_mut().for_each(|rows| rows.flush());
            if is_pruned {
                self.prune(stratum, &pruning, &pruning_orders, &mut growing)?;
                if !growing.values().any(|rows| rows.has_recent()) {
                    break;
                }
            } else if !iteration.changed() {
                break;
            }
            growing.values_mut().for_each(|rows| rows.follow());
            // Now each row counts once.
            for relation in &stratum.relations {
                let clause = last.get(relation);
                clause.map_or(Ok(()), |clause| self.check_size(clause, growing[relation].len()))?;
            }
            orders.changed();
            let held = finished + growing.values().map(|rows| rows.bytes()).sum::<usize>();
            self.finished.watch.hold(held);
            if let Some((relation, column)) = alone
                && (growing[&relation].len() >= FEWEST_ALONE || spread_from.is_zero())
                && self.finished.watch.threads() > 1
                && since.elapsed() >= ROUNDS_ALONE * spread_from
                && let Some(rows) = growing.remove(&relation)
            {
                return self.apart(relation, column, &rounds, rows);
            }
            for ((clause, plan), orders) in rounds.iter().zip(&orders_of) {
                let limit = self.limit(clause.head);
                let is_limited = limit < MAX_ROWS;
                let held = if is_limited { growing[&clause.head].len() } else { 0 };
                let room = limit.saturating_sub(held);
                let parts = parts(plan, orders, &growing);
                let rows = &growing[&clause.head];
                let (before, found) = {
                    let mut sink = rows.sink();
                    let before = sink.len();
                    let mut choosing = choosing(&mut *sink, choices.get_mut(&clause.head));
                    self.emit(clause, plan, &parts, room, is_any_order, choosing.as_sink());
                    (before, sink.len())
                };
                if found > before {
                    last.insert(clause.head, clause);
                }
                self.finished.watch.found(rows.len() + found);
                if let Err(error) = self.check_limits(clause) {
                    let more = |of: &RelationId| if *of == clause.head { found } else { 0 };
                    let reached = growing.iter().map(|(of, rows)| (*of, rows.len() + more(of)));
                    self.reached = reached.collect();
                    return Err(error);
                }
                // What a sink has no place for is no result.
                if rows.len() + found > MAX_ROWS {
                    return Err(program.too_many(clause, MAX_ROWS));
                }
            }
        }
        // What is put together takes its own memory.
        let whole = growing.iter().map(|(relation, rows)| {
            rows.bytes() + rows.len() * program.info(*relation).columns.len() * size_of::<Word>()
        });
        self.finished.watch.hold(finished + whole.sum::<usize>());
        if let Some((clause, _)) = rounds.first() {
            self.check_limits(clause)?;
        }
        for (relation, rows) in growing {
            self.finished.rows[relation.index()] =
                Some(rows.complete(self.finished.watch.threads()));
        }
        Ok(())
    }

    /// A plan for each atom of the stratum itself: that one over the rows of the last round.
    fn rounds<'c>(
        &mut self,
        clause: &'c Clause,
        own: &[usize],
        rounds: &mut Vec<(&'c Clause, Plan)>,
    ) {
        for recent in own {
            let mut plan = self.plan(clause, &versions(clause, own, *recent), Some(*recent));
            self.finished.provide(&mut plan);
            rounds.push((clause, plan));
        }
    }

    /// Takes out of the relations what is subsumed, of which one tuple at least is of the last round.
    fn prune(
        &mut self,
        stratum: &Stratum,
        pruning: &[(&Clause, Plan)],
        orders: &[Vec<usize>],
        growing: &mut HashMap<RelationId, Box<dyn Growing>>,
    ) -> Result<(), EvaluateError> {
        let mut gone: HashMap<RelationId, Dominated> = HashMap::new();
        for ((clause, plan), orders) in pruning.iter().zip(orders) {
            let of = stratum.subsumptions.iter().map(|n| &self.program.subsumptions[*n]);
            let relation = of.clone().find(|of| std::ptr::eq(&of.clause, *clause));
            let Some(relation) = relation.map(|of| of.relation) else { continue };
            let parts = parts(plan, orders, growing);
            let gone = gone.entry(relation).or_default();
            self.emit(clause, plan, &parts, MAX_ROWS, false, gone);
            self.check_limits(clause)?;
        }
        for (relation, gone) in gone {
            if let Some(rows) = growing.get_mut(&relation) {
                rows.prune(&gone.rows);
            }
        }
        Ok(())
    }
}

/// What the atoms of a clause range over, one of the stratum's own over the rows of the last round.
pub(super) fn versions(clause: &Clause, own: &[usize], recent: usize) -> Vec<Version> {
    let mut versions = vec![Version::Finished; clause.body.len()];
    for n in own {
        versions[*n] = match n.cmp(&recent) {
            std::cmp::Ordering::Less => Version::Stable,
            std::cmp::Ordering::Equal => Version::Recent,
            std::cmp::Ordering::Greater => Version::All,
        };
    }
    versions
}

/// The rows behind each growing source of a plan.
fn parts<'a>(
    plan: &Plan,
    orders: &[usize],
    growing: &'a HashMap<RelationId, Box<dyn Growing>>,
) -> Vec<Vec<Ref<'a, dyn RowSet>>> {
    let parts = plan.requests.iter().zip(orders).map(|(request, order)| {
        let Request::Growing { relation, version, .. } = request else { return Vec::new() };
        let rows = &growing[relation];
        match version {
            Version::Recent => rows.recent(*order),
            Version::Stable => rows.stable(*order),
            Version::All | Version::Finished => {
                let mut all = rows.stable(*order);
                all.extend(rows.recent(*order));
                all
            }
        }
    });
    parts.collect()
}

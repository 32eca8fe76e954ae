//! What an evaluation did: for each rule the joins that were chosen, with the sizes met, how often it ran, what it found
//! and how long that took.

use std::time::Duration;

use super::evaluate::Evaluation;
use super::growing::Version;
use super::plan::{Plan, Request};
use super::program::{Clause, Expr};
use super::relations::RelationId;
use super::step::Step;
use super::trace::{Join, RuleTrace};
use crate::units::{Bilingual, Piece, said, word};

impl Evaluation<'_> {
    /// Notes a run of a clause.
    pub(super) fn trace(&mut self, clause: &Clause, plan: &Plan, found: usize, time: Duration) {
        let Some(mut all) = self.traced.take() else { return };
        let joins = self.joins(plan);
        match all.iter_mut().find(|line| line.is_of(clause.at, &joins)) {
            Some(line) => {
                line.runs += 1;
                line.found += found;
                line.time += time;
            }
            None => all.push(RuleTrace {
                place: self.program.place(clause.at),
                relation: self.program.info(clause.head).name.clone(),
                joins,
                runs: 1,
                found,
                time,
                at: clause.at,
            }),
        }
        self.traced = Some(all);
    }

    fn joins(&self, plan: &Plan) -> Vec<Join> {
        let mut joins = Vec::new();
        let mut ends = Vec::new();
        for (n, step) in plan.steps.iter().enumerate() {
            while ends.last() == Some(&n) {
                ends.pop();
            }
            let depth = ends.len();
            let mut is_filtered = false;
            let (what, size) = match step {
                Step::Scan(scan) => {
                    is_filtered = !scan.filters.is_empty();
                    self.request(&plan.requests[scan.source], scan.key.len())
                }
                Step::Absent { source, key } => {
                    let (what, size) = self.request(&plan.requests[*source], key.len());
                    (prefixed(word!("no"), &what), size)
                }
                Step::Filter(_) => (said!("comparison"), None),
                Step::Each { .. } => (said!("numbers-in-order"), None),
                Step::Aggregate { function, end, .. } => {
                    ends.push(*end);
                    (prefixed(word!("aggregate"), &function.word().into()), None)
                }
                Step::Let { .. } | Step::Reached => continue,
            };
            joins.push(Join { depth, what, size, is_filtered });
        }
        joins
    }

    /// What is read and by which columns; of what is finished, how much.
    fn request(&self, request: &Request, keys: usize) -> (Bilingual, Option<Bilingual>) {
        let column = |relation: RelationId, n: usize| {
            self.program.info(relation).columns.get(n).map_or("…", |column| column.name.as_str())
        };
        let (relation, key, part): (RelationId, Vec<&str>, _) = match request {
            Request::Whole(relation) => {
                (*relation, (0..keys).map(|n| column(*relation, n)).collect(), None)
            }
            Request::Index { relation, key, .. } => {
                let name = |expr: &Expr| match expr {
                    Expr::Variable(n) => column(*relation, *n as usize),
                    _ => "…",
                };
                (*relation, key.iter().map(name).collect(), None)
            }
            Request::Growing { relation, first, version } => {
                let part = match version {
                    Version::Recent => word!("new-rows"),
                    Version::Stable => word!("earlier-rows"),
                    Version::All | Version::Finished => word!("all-rows"),
                };
                (*relation, first.iter().map(|n| column(*relation, *n)).collect(), Some(part))
            }
        };
        let name = &self.program.info(relation).name;
        let relation_told = match key.is_empty() {
            true => name.clone().into(),
            false => said!("relation-by", name, key = key.join(", ")),
        };
        if let Some(part) = part {
            return (said!("relation-in-part", relation = relation_told, part), None);
        }
        let size = self.finished.rows[relation.index()].as_ref().map(|rows| match rows.len() {
            1 => said!("n-1-row"),
            len => said!("rows", len),
        });
        (relation_told, size)
    }
}

fn prefixed(word: Piece, what: &Bilingual) -> Bilingual {
    Bilingual::both(|language| format!("{} {}", word.say(language), what.say(language)))
}

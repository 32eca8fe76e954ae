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
use crate::units::{Bilingual, Language};

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
                    (prefixed(("нет", "no"), &what), size)
                }
                Step::Filter(_) => (("сравнение", "comparison").into(), None),
                Step::Each { .. } => (("числа по порядку", "numbers in order").into(), None),
                Step::Aggregate { function, end, .. } => {
                    ends.push(*end);
                    (prefixed(("счёт", "aggregate"), &function.word().into()), None)
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
                    Version::Recent => ("новые строки", "new rows"),
                    Version::Stable => ("прежние строки", "earlier rows"),
                    Version::All | Version::Finished => ("все строки", "all rows"),
                };
                (*relation, first.iter().map(|n| column(*relation, *n)).collect(), Some(part))
            }
        };
        let name = &self.program.info(relation).name;
        let (mut russian, mut english) = (name.clone(), name.clone());
        if !key.is_empty() {
            let key = key.join(", ");
            (russian, english) = (format!("{name} по {key}"), format!("{name} by {key}"));
        }
        if let Some((in_russian, in_english)) = part {
            let (russian, english) =
                (format!("{russian}: {in_russian}"), format!("{english}: {in_english}"));
            return (Bilingual::new(russian, english), None);
        }
        let size = self.finished.rows[relation.index()].as_ref().map(|rows| match rows.len() {
            1 => ("строк 1", "1 row").into(),
            len => Bilingual::new(format!("строк {len}"), format!("{len} rows")),
        });
        (Bilingual::new(russian, english), size)
    }
}

fn prefixed((russian, english): (&str, &str), what: &Bilingual) -> Bilingual {
    let said = |word, language| format!("{word} {}", what.say(language));
    Bilingual::new(said(russian, Language::Russian), said(english, Language::English))
}

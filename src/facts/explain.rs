//! What an evaluation did: for each rule the joins that were chosen, with the sizes met, how often it ran, what it found
//! and how long that took.

use std::fmt::Write as _;
use std::time::Duration;

use super::evaluate::Evaluation;
use super::plan::{Plan, Request};
use super::program::{Clause, Expr, Program, RelationId};
use super::run::Step;
use super::trace::{RuleTrace, sorted};

impl Evaluation<'_> {
    /// Notes a run of a clause.
    pub(super) fn trace(&mut self, clause: &Clause, plan: &Plan, found: usize, time: Duration) {
        let Some(mut all) = self.traced.take() else { return };
        let joins = self.joins(plan);
        let names = |joins: &[String]| {
            joins.iter().map(|join| join.split(':').next().map(str::to_owned)).collect::<Vec<_>>()
        };
        let same =
            |line: &&mut RuleTrace| line.at == clause.at && names(&line.joins) == names(&joins);
        match all.iter_mut().find(same) {
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

    fn joins(&self, plan: &Plan) -> Vec<String> {
        let mut joins = Vec::new();
        let mut depth = 0;
        let mut ends = Vec::new();
        for (n, step) in plan.steps.iter().enumerate() {
            while ends.last() == Some(&n) {
                ends.pop();
                depth -= 1;
            }
            let told = match step {
                Step::Scan(scan) => {
                    let mut told = self.request(&plan.requests[scan.source], scan.key.len());
                    if !scan.filters.is_empty() {
                        let _ = write!(told, ", отбор сравнением");
                    }
                    told
                }
                Step::Absent { source, key } => {
                    format!("нет {}", self.request(&plan.requests[*source], key.len()))
                }
                Step::Filter(_) => "сравнение".to_owned(),
                Step::Each { .. } => "числа по порядку".to_owned(),
                Step::Aggregate { function, end, .. } => {
                    let told = format!("счёт {}", function.word());
                    joins.push(format!("{}{told}", "  ".repeat(depth)));
                    ends.push(*end);
                    depth += 1;
                    continue;
                }
                Step::Let { .. } | Step::Reached => continue,
            };
            joins.push(format!("{}{told}", "  ".repeat(depth)));
        }
        joins
    }

    fn request(&self, request: &Request, keys: usize) -> String {
        let size = |relation: RelationId| match self.finished.rows[relation.index()].as_ref() {
            Some(rows) => format!("{} строк", rows.len()),
            None => "растёт".to_owned(),
        };
        let column = |relation: RelationId, n: usize| {
            self.program.info(relation).columns.get(n).map_or("…", |column| column.name.as_str())
        };
        let (relation, key): (RelationId, Vec<&str>) = match request {
            Request::Whole(relation) => {
                (*relation, (0..keys).map(|n| column(*relation, n)).collect())
            }
            Request::Index { relation, key, .. } => {
                let name = |expr: &Expr| match expr {
                    Expr::Variable(n) => column(*relation, *n as usize),
                    _ => "…",
                };
                (*relation, key.iter().map(name).collect())
            }
            Request::Growing { relation, first, version } => {
                let all: Vec<&str> = first.iter().map(|n| column(*relation, *n)).collect();
                let by = if all.is_empty() {
                    String::new()
                } else {
                    format!(" по {}", all.join(", "))
                };
                let name = &self.program.info(*relation).name;
                let part = match version {
                    super::plan::Version::Recent => "новые строки",
                    super::plan::Version::Stable => "прежние строки",
                    _ => "все строки",
                };
                return format!("{name}{by}: {part}");
            }
        };
        let name = &self.program.info(relation).name;
        match key.is_empty() {
            true => format!("{name}: все, {}", size(relation)),
            false => format!("{name} по {}: {}", key.join(", "), size(relation)),
        }
    }
}

impl Program {
    /// As [`Self::evaluate_within`], and what each rule did, the longest first.
    ///
    /// # Errors
    /// As [`Self::evaluate_within`].
    pub fn evaluate_traced(
        &self,
        database: &super::Database,
        limits: super::Limits,
    ) -> Result<(super::Derived, Vec<RuleTrace>), super::EvaluateError> {
        let (derived, traced) = self.run(database, limits, true)?;
        Ok((derived, sorted(traced)))
    }
}

//! What actions cost, by the numbers and the values of functions that rules and problem give.

use std::collections::HashMap;

use super::domain::{Domain, Schema, SchemaCost, SchemaTerm};
use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use super::problem::Problem;
use super::resolve::{Resolved, ThingId};
use super::task::{Operator, Task};
use crate::units::name_key;

/// What an action over these objects costs. A value that the problem does not give is nothing, as planners read it;
/// [`without_price`] tells of it.
pub(super) fn cost(schema: &Schema, resolved: &Resolved, objects: &[ThingId]) -> u32 {
    if schema.cost.is_empty() {
        return 1;
    }
    let part = |cost| price(cost, resolved, objects).unwrap_or(0);
    schema.cost.iter().map(part).fold(0, u32::saturating_add)
}

fn price(cost: &SchemaCost, resolved: &Resolved, objects: &[ThingId]) -> Option<u32> {
    match cost {
        SchemaCost::Number(number) => Some(*number),
        SchemaCost::Function { name, args } => {
            let value = |term: &SchemaTerm| match term {
                SchemaTerm::Constant(name) => resolved.index[&name_key(name)],
                SchemaTerm::Parameter(parameter) => objects[*parameter as usize],
            };
            let args: Vec<ThingId> = args.iter().map(value).collect();
            resolved.values.get(&(name.clone(), args)).copied()
        }
    }
}

/// That the problem does not say what operators of its task cost, if so: these count as free.
///
/// # Errors
/// All names of the problem that mean nothing to the rules, at once.
pub fn without_price(
    domain: &Domain,
    problem: &Problem,
    task: &Task,
) -> Result<Option<RuleFault>, RuleFaults> {
    let by_function = |cost: &SchemaCost| matches!(cost, SchemaCost::Function { .. });
    if !domain.schemas.iter().any(|schema| schema.cost.iter().any(by_function)) {
        return Ok(None);
    }
    let resolved = problem.resolve(domain)?;
    let schemas: HashMap<&str, &Schema> =
        domain.schemas.iter().map(|schema| (schema.name.as_str(), schema)).collect();
    let lacks = |operator: &&Operator| {
        let thing = |name: &std::sync::Arc<str>| resolved.index.get(&name_key(name)).copied();
        let things: Option<Vec<ThingId>> = operator.args.iter().map(thing).collect();
        let (Some(things), Some(schema)) = (things, schemas.get(&*operator.name)) else {
            return false;
        };
        schema.cost.iter().any(|cost| price(cost, &resolved, &things).is_none())
    };
    let mut lacking = task.operators.iter().filter(lacks);
    let Some(first) = lacking.next() else { return Ok(None) };
    let error = RuleError::NoPrice { action: first.to_string(), more: lacking.count() };
    Ok(Some(RuleFault::placeless(error)))
}

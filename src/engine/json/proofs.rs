//! Why something holds, or does not, as data.

use serde_json::{Value, json};

use super::values::tuple;
use crate::engine::{Error, QueryAnswer, State};
use crate::facts::{self, Because, Below, FailedRule, Premise, Proof, WhyNot};
use crate::language::Language;
use crate::semantics::Relations;

/// The proof of a relation, or what failed of the rule that came nearest: `holds`, and `proof` or `nearest`.
///
/// # Errors
/// There is no map, or it knows no such relation, or nothing of such a name.
pub fn why(state: &State, relation: &str, of: &[&str], language: Language) -> Result<Value, Error> {
    let relations = state.relations()?;
    let nearest = match state.why(relation, of)? {
        Ok(proof) => {
            return Ok(json!({ "holds": true, "proof": self::proof(relations, &proof, language) }));
        }
        Err(WhyNot::Nearest(rule)) => failed_rule(relations, &rule, language),
        Err(WhyNot::NotTold | WhyNot::Holds) => Value::Null,
    };
    Ok(json!({ "holds": false, "nearest": nearest }))
}

/// What a question in the rules' language found; `proofs` where they were asked for.
///
/// # Errors
/// There is no map.
pub fn query(
    state: &State,
    answer: &QueryAnswer,
    with_proofs: bool,
    language: Language,
) -> Result<Value, Error> {
    let relations = state.relations()?;
    let rows: Vec<_> = answer.rows.iter().map(|row| tuple(row)).collect();
    let mut view = json!({ "columns": answer.columns, "rows": rows });
    if with_proofs {
        view["proofs"] = answer.proofs.iter().map(|p| proof(relations, p, language)).collect();
    }
    if !answer.unknown.is_empty() {
        view["unknown"] = json!(answer.unknown);
    }
    Ok(view)
}

/// A fact with the name of its relation in a language.
pub(super) fn display(
    relations: &Relations,
    name: &str,
    values: &[facts::Value],
    language: Language,
) -> Value {
    json!({ "relation": relations.display_name(name, language), "args": tuple(values) })
}

/// A step an object; a premise that is a fact names its step by number.
fn proof(relations: &Relations, proof: &Proof, language: Language) -> Value {
    let step = |n: usize| {
        let step = &proof.steps[n];
        let mut view = json!({
            "relation": relations.display_name(&step.fact.name, language),
            "args": tuple(&step.fact.values),
            "height": step.height,
        });
        match &step.because {
            Because::Told => view["because"] = json!("measured"),
            Because::Written { source, line } => {
                view["because"] = json!({ "source": source, "line": line });
            }
            Because::Rule { rule, premises } => {
                let premises: Vec<Value> =
                    premises.iter().map(|p| premise(relations, p, language)).collect();
                view["because"] = json!({
                    "source": rule.source, "line": rule.line, "rule": rule.text, "premises": premises,
                });
            }
        }
        view
    };
    Value::Array((0..proof.steps.len()).map(step).collect())
}

fn premise(relations: &Relations, premise: &Premise, language: Language) -> Value {
    let open = |values: &[Option<facts::Value>]| -> Vec<Value> {
        let value = |v: &Option<facts::Value>| match v {
            Some(v) => tuple(std::slice::from_ref(v))[0].clone(),
            None => Value::Null,
        };
        values.iter().map(value).collect()
    };
    let one = |value: &facts::Value| tuple(std::slice::from_ref(value))[0].clone();
    match premise {
        Premise::Fact(step) => json!({ "step": step }),
        Premise::Pattern { name, values } => {
            json!({ "relation": relations.display_name(name, language), "args": open(values) })
        }
        Premise::Absent { name, values } => {
            json!({ "not": { "relation": relations.display_name(name, language), "args": open(values) } })
        }
        Premise::Compared { text, left, op, right } => json!({
            "text": text, "left": one(left), "op": op.sign(), "right": one(right),
        }),
        Premise::Counted { text, value } => {
            json!({ "text": text, "value": value.as_ref().map(one) })
        }
        Premise::Unknown { text } => json!({ "text": text }),
    }
}

/// A rule that did not hold, and which of its premises do.
fn failed_rule(relations: &Relations, failed: &FailedRule, language: Language) -> Value {
    let premises = failed.premises.iter().enumerate().map(|(n, (premise, holds))| {
        let mut view = self::premise(relations, premise, language);
        view["holds"] = json!(holds);
        match failed.below.iter().find(|(of, _)| *of == n).map(|(_, why)| why) {
            Some(Below::Missing(rule)) => view["nearest"] = failed_rule(relations, rule, language),
            Some(Below::There(proof)) => view["proof"] = self::proof(relations, proof, language),
            None => {}
        }
        view
    });
    json!({
        "source": failed.rule.source,
        "line": failed.rule.line,
        "rule": failed.rule.text,
        "premises": premises.collect::<Vec<_>>(),
    })
}

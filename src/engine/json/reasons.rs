//! Why something holds or not as a person is shown it, as data: in words, with what was measured and where.

use serde_json::{Value, json};

use super::proofs::display;
use super::values::{merge, point};
use crate::engine::{Error, State};
use crate::facts::{Because, Premise, ProofStep, WhyNot};
use crate::language::Language;

/// The proof of a relation, or the rule that came closest, each with its measurements; [`why`](super::why) has all premises.
///
/// # Errors
/// There is no map, or it knows no such relation, or nothing of such a name.
pub fn reasons(
    state: &State,
    relation: &str,
    of: &[&str],
    language: Language,
) -> Result<Value, Error> {
    let (world, relations) = (state.world()?, state.relations()?);
    let reason = state.reason(relation, of, language)?;
    let measures = reason.measurements.iter().map(|m| {
        json!({
            "of": m.of, "map": world.maps[&m.map].name, "ends": m.ends.map(point),
            "length_cm": m.length, "text": m.text, "fails": m.fails,
        })
    });
    let mut view = match &reason.because {
        Ok(proof) => {
            let step = |step: &ProofStep| {
                let mut view = display(relations, &step.fact.name, &step.fact.values, language);
                view["height"] = json!(step.height);
                match &step.because {
                    Because::Told => view["measured"] = json!(true),
                    Because::Written { .. } => view["written"] = json!(true),
                    Because::Rule { rule, premises } => {
                        view["rule"] = json!(rule.text);
                        view["compared"] = premises.iter().filter_map(compared).collect();
                    }
                }
                view
            };
            json!({ "holds": true, "steps": proof.steps.iter().map(step).collect::<Vec<_>>() })
        }
        Err(WhyNot::Nearest(rule)) => {
            let failed = rule.premises.iter().filter(|(_, holds)| *holds == Some(false));
            let failed: Vec<Value> = failed.filter_map(|(premise, _)| compared(premise)).collect();
            json!({
                "holds": false, "rule": rule.rule.text, "failed": failed, "text": rule.to_string(),
            })
        }
        Err(WhyNot::NotTold | WhyNot::Holds) => json!({ "holds": false }),
    };
    merge(
        &mut view,
        json!({
            "words": reason.text, "about": reason.about, "measures": measures.collect::<Vec<_>>(),
        }),
    );
    Ok(view)
}

/// A premise that compares two numbers.
fn compared(premise: &Premise) -> Option<Value> {
    match premise {
        Premise::Compared { text, left, op, right } => Some(json!({
            "text": text, "left": left.to_string(), "op": op.sign(), "right": right.to_string(),
        })),
        _ => None,
    }
}

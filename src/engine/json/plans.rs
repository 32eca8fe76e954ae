//! Plans, why none is shorter, and plans carried out, as data.

use serde::Serialize;
use serde_json::{Value, json};

use crate::engine::narration::outcome;
use crate::engine::{PlanStep, Replanned, Solved, World, in_rule_text, name_in, steps};
use crate::graphplan::{Attempt, Limit, NoPlanReason, Outcome, Plan, Way};
use crate::language::Language;
use crate::robot::{Reason, Refused, Shortness};
use crate::semantics::planning::InitialFact;
use crate::strips::{Preference, Replayed, Said, Wording};
use crate::units::Fault as _;

#[derive(Debug, Serialize)]
struct StepView {
    action: String,
    args: Vec<String>,
}

/// A plan, or why there is none. Things of the map have the English names that it gives them.
pub fn plan(solved: &Solved, world: Option<&World>) -> Value {
    let name = |name: &str| match world {
        Some(world) => name_in(world, name, Language::English),
        None => name.to_owned(),
    };
    let english = solved.wording(Language::English, &name);
    let steps: Vec<Vec<StepView>> = steps(solved)
        .into_iter()
        .map(|step| {
            step.into_iter().map(|PlanStep { action, args }| StepView { action, args }).collect()
        })
        .collect();
    let mut view = json!({
        "outcome": outcome(&solved.outcome),
        "parallel_steps": steps.len(),
        "actions": steps.iter().map(Vec::len).sum::<usize>(),
        "steps": steps,
        "optimal": solved.is_shortest && matches!(solved.outcome, Outcome::Plan(_)),
        "assumptions": solved.assumptions.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "assumptions_en": solved.assumptions_with(&english),
        "explanation": solved.explanation(Language::Russian),
        "explanation_en": solved.explanation_with(&english),
    });
    if solved.is_of_whole_actions {
        view["whole_actions"] = json!(true);
    }
    if let Some(time) = solved.time {
        let seconds = |hundredths: u64| hundredths as f64 / 100.0;
        view["seconds"] = json!(seconds(time.takes));
        view["at_least_seconds"] = json!(seconds(time.at_least));
        view["quickest"] = json!(time.is_least());
    }
    if let Some(wishes) = &solved.wishes {
        let told = |all: &[Preference]| -> Vec<Value> {
            let weight = |thousandths: u64| thousandths as f64 / 1000.0;
            all.iter().map(|one| json!({"name": one.name, "weight": weight(one.weight)})).collect()
        };
        view["preferences"] = json!({
            "met": told(&wishes.met),
            "unmet": told(&wishes.unmet),
            "proven_least": wishes.is_least,
        });
    }
    if let Some(Reason::NoWay(refused)) = &solved.reason {
        let refused = refused.iter().map(|Refused { action, why }| {
            let why = |language| why.as_ref().map(|why| why.say(language));
            json!({
                "action": action.to_string(),
                "action_en": english.action(action),
                "explanation": why(Language::Russian),
                "explanation_en": why(Language::English),
            })
        });
        view["no_way"] = refused.collect();
    }
    match &solved.outcome {
        Outcome::NoPlan { leveled_off_at, reason } => {
            let fact = |id: &_| solved.task.fact(*id).to_string();
            view["leveled_off_at"] = json!(leveled_off_at);
            view["reason"] = match reason {
                NoPlanReason::Unreachable(facts) => {
                    json!({"unreachable": facts.iter().map(fact).collect::<Vec<_>>()})
                }
                NoPlanReason::Exclusive(pairs) => {
                    json!({"exclusive": pairs.iter().map(|(a, b)| [fact(a), fact(b)]).collect::<Vec<_>>()})
                }
                NoPlanReason::Together(facts) => {
                    json!({"together": facts.iter().map(fact).collect::<Vec<_>>()})
                }
            };
        }
        Outcome::LimitReached(known) => {
            view["limit"] = json!(match known.limit {
                Limit::Time => "time",
                Limit::Memory => "memory",
                Limit::Steps => "steps",
                Limit::Stopped => "stopped",
                Limit::Effort => "effort",
            });
            view["at_least_steps"] = json!(known.at_least);
            view["at_most_steps"] = json!(known.plan.as_ref().map(|plan| plan.steps.len()));
            view["tried"] = known.tried.iter().map(tried).collect();
        }
        Outcome::Plan(_) if !solved.is_shortest && solved.time.is_none() => {
            view["at_least_steps"] = json!(solved.at_least);
        }
        Outcome::Plan(_) => {}
    }
    view
}

/// A way that was tried, and how far it came.
fn tried(attempt: &Attempt) -> Value {
    let Attempt { way, times, levels, nodes, effort } = attempt;
    let way = match way {
        Way::Grounding => "grounding",
        Way::Graph => "graph",
        Way::Proof => "proof",
        Way::Forward => "forward",
    };
    json!({"way": way, "times": times, "levels": levels, "nodes": nodes, "effort": effort})
}

/// Why no plan has fewer steps.
fn shortness(why: &Shortness, english: &Wording<'_>) -> Value {
    let fact = |fact: &Said| json!({"fact": fact.to_string(), "fact_en": english.fact(fact)});
    let alone = why.alone.iter().map(|(goal, steps)| {
        json!({"goal": goal.to_string(), "goal_en": english.fact(goal), "parallel_steps": steps})
    });
    json!({
        "one_after_the_other": why.row.iter().map(fact).collect::<Vec<_>>(),
        "goals_alone": alone.collect::<Vec<_>>(),
    })
}

/// The plan after assumptions were withdrawn, and what became of the one before.
pub(crate) fn replanned(replanned: &Replanned, world: Option<&World>) -> Value {
    let before = steps(&replanned.before);
    let mut view = plan(&replanned.after, world);
    view["withdrawn"] =
        json!(replanned.withdrawn.iter().map(ToString::to_string).collect::<Vec<_>>());
    view["before"] = json!({
        "outcome": outcome(&replanned.before.outcome),
        "parallel_steps": before.len(),
        "actions": before.iter().map(Vec::len).sum::<usize>(),
        "rested_on_it": replanned.rested_on(),
    });
    view["learned_before"] = json!(replanned.learned_before);
    view
}

/// A plan carried out, as far as it goes.
pub(crate) fn replayed(replayed: &Replayed) -> Value {
    let steps: Vec<Value> = replayed
        .steps
        .iter()
        .map(|(step, directives)| {
            let actions: Vec<StepView> = directives
                .iter()
                .map(|d| StepView { action: d.action.clone(), args: d.args.clone() })
                .collect();
            json!({"step": step, "actions": actions})
        })
        .collect();
    let broken = replayed.broken.as_ref().map(|broken| {
        let faults: Vec<Value> = broken
            .faults
            .0
            .iter()
            .map(|fault| {
                let code = miette::Diagnostic::code(fault).map(|code| code.to_string());
                let place = fault.position();
                json!({
                    "code": code,
                    "message": fault.error.to_string(),
                    "message_en": fault.error.tell(Language::English),
                    "line": place.map(|(_, line, _)| line),
                    "column": place.map(|(_, _, column)| column),
                })
            })
            .collect();
        json!({"step": broken.step, "faults": faults})
    });
    json!({
        "outcome": if broken.is_none() { "sound" } else { "broken" },
        "parallel_steps": replayed.steps.len(),
        "cost": serde_json::from_str::<serde_json::Number>(&replayed.cost_shown()).ok(),
        "steps": steps,
        "broken": broken,
    })
}

/// A plan whose search was broken off, with what would help.
#[must_use]
pub(crate) fn with_remedies(mut view: Value, remedies: &[&str]) -> Value {
    view["help"] = json!(remedies);
    view
}

/// A plan with why none has fewer steps.
#[must_use]
pub(crate) fn with_shortness(mut view: Value, why: &Shortness, english: &Wording<'_>) -> Value {
    view["why_not_shorter"] = shortness(why, english);
    view
}

/// A plan that is found while a shorter one is sought.
#[must_use]
pub(crate) fn better_plan(plan: &Plan) -> Value {
    let (steps, actions) = (plan.steps.len(), plan.action_count());
    json!({"event": "plan", "parallel_steps": steps, "actions": actions})
}

/// So many steps are needed at the least.
#[must_use]
pub(crate) fn higher_bound(at_least: usize) -> Value {
    json!({"event": "bound", "at_least_steps": at_least})
}

/// What the map gives to planning.
#[must_use]
pub(crate) fn given_facts(facts: &[InitialFact]) -> Value {
    let fact = |fact: &InitialFact| {
        let args: Vec<&str> = fact.arguments.iter().map(|a| a.name.as_str()).collect();
        let kinds: Vec<&str> = fact.arguments.iter().map(|a| a.kind).collect();
        json!({
            "predicate": fact.predicate, "args": args, "types": kinds, "assumed": fact.assumed,
            "text": in_rule_text(fact),
        })
    };
    json!({"facts": facts.iter().map(fact).collect::<Vec<_>>()})
}

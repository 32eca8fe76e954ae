//! What a dialogue replied, as data: answers, doubts, tasks carried out.

use serde_json::{Value, json};

use super::events::ReportView;
use super::plans::plan;
use super::values::{pose, round};
use crate::engine::{
    Answer, Engine, Error, Heard, Outcome as Heeded, Queue, Reply, TaskAnswer, TaskEnding,
    Unanswered, World, surprise_in_words,
};
use crate::language::Language;
use crate::robot::GoalFact;

/// What a dialogue replied: an answer with its rule and proofs, a task with its steps, else the outcome and its words.
///
/// # Errors
/// As [`State::ask`](crate::engine::State::ask).
pub fn reply(engine: &Engine, reply: &Reply) -> Result<Value, Error> {
    Ok(match &reply.outcome {
        Heeded::Answered(found) => answer(engine, found)?,
        Heeded::Unanswered(unanswered) => doubt(unanswered),
        Heeded::Task(done) => task(engine.world()?, done),
        Heeded::Queued { task } | Heeded::Begun { task } => {
            json!({ "outcome": reply.outcome.word(), "task": task, "text": reply.text })
        }
        Heeded::Cancelled { tasks } => {
            json!({ "outcome": reply.outcome.word(), "tasks": tasks, "text": reply.text })
        }
        Heeded::Waits(waiting) => {
            let mut view = queue(waiting);
            view["outcome"] = json!(reply.outcome.word());
            view["text"] = json!(reply.text);
            view
        }
        other => json!({ "outcome": other.word(), "text": reply.text }),
    })
}

/// The tasks that wait.
pub fn queue(queue: &Queue) -> Value {
    let tasks = queue.tasks.iter().map(|task| {
        json!({
            "task": task.id, "text": task.text, "by": task.by, "at": task.at.to_string(),
            "is_begun": task.is_begun,
        })
    });
    json!({
        "tasks": tasks.collect::<Vec<_>>(),
        "paused": queue.paused.map(|at| at.to_string()),
    })
}

/// All that came of a line, in its order.
///
/// # Errors
/// As [`State::ask`](crate::engine::State::ask).
pub fn heard(engine: &Engine, heard: &Heard) -> Result<Vec<Value>, Error> {
    heard.replies.iter().map(|one| reply(engine, one)).collect()
}

/// The answer as data: outcome, query, bindings, facts with their proofs.
///
/// # Errors
/// As [`State::ask`](crate::engine::State::ask).
pub fn answer(engine: &Engine, answer: &Answer) -> Result<Value, Error> {
    let mut facts = Vec::new();
    for fact in answer.facts.iter().take(20) {
        facts.push(json!({
            "relation": fact.relation,
            "args": fact.args,
            "holds": fact.holds,
            "proof": engine.proof_of(fact, answer.language)?,
        }));
    }
    Ok(json!({
        "outcome": answer.said.word(),
        "kind": answer.query.kind(),
        "rule": engine.rule_of(answer)?,
        "bindings": answer.symbols,
        "number": answer.number,
        "facts": facts,
        "text": answer.text,
    }))
}

/// Why there is no answer, and what may have been meant.
pub fn doubt(unanswered: &Unanswered) -> Value {
    json!({
        "outcome": unanswered.doubt.kind(),
        "candidates": unanswered.names,
        "offers": unanswered.offers,
        "text": unanswered.text,
    })
}

/// A task carried out, or shown impossible.
pub fn task(world: &World, answer: &TaskAnswer) -> Value {
    let goals = |all: &[GoalFact]| -> Vec<Value> {
        all.iter().map(|g| json!({"predicate": g.predicate, "args": g.args})).collect()
    };
    let mut view = json!({
        "outcome": answer.word(),
        "map": world.maps[&answer.map].name,
        "goal": goals(&answer.goal),
        "start": pose(answer.start),
        "end": pose(answer.end),
        "end_map": world.maps[&answer.end_map].name,
        "seconds": round(answer.seconds),
        "length_cm": round(answer.reports.iter().map(|r| r.length).sum()),
        "replans": answer.replans,
        "directives": answer.reports.iter().map(|r| ReportView::of(world, r)).collect::<Vec<_>>(),
    });
    match &answer.ending {
        TaskEnding::NoPlan(planned) => {
            view["plan"] = plan(&planned.solved, Some(world));
        }
        TaskEnding::Stuck(surprise) => {
            view["explanation"] = json!(surprise_in_words(world, surprise, Language::Russian));
            view["explanation_en"] = json!(surprise_in_words(world, surprise, Language::English))
        }
        TaskEnding::Failed(failure) => {
            view["code"] = json!(miette::Diagnostic::code(failure).map(|code| code.to_string()));
            view["explanation"] = json!(failure.say(Language::Russian));
            view["explanation_en"] = json!(failure.say(Language::English));
        }
        TaskEnding::Done | TaskEnding::AlreadyTrue | TaskEnding::Stopped => {}
    }
    if !answer.left.is_empty() {
        let left = answer.left.iter().map(|(goal, _)| json!(goal.args)).collect::<Vec<_>>();
        view["left"] = json!(left);
    }
    if !answer.not_begun.is_empty() {
        view["not_begun"] = json!(goals(&answer.not_begun));
    }
    if let Some(position) = &answer.reported {
        view["ru"] = json!(position.say(Language::Russian));
        view["en"] = json!(position.say(Language::English));
    }
    view
}

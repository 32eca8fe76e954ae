//! Tasks as they are planned, wait, are driven and end, and who drives, as data.

use serde::Serialize;
use serde_json::{Value, json};

use super::values::merge;
use crate::language::Language;
use crate::store::Timestamp;

/// A task that is known to whoever drives.
#[derive(Debug, Serialize)]
pub(crate) struct TaskView<'t> {
    pub task: u64,
    pub text: &'t str,
    pub by: &'t str,
    pub state: &'t str,
    pub revision: u64,
    pub plan: &'t Value,
    pub is_begun: bool,
    pub is_released: bool,
    pub is_kept: bool,
    /// When it was given, where the store keeps it.
    pub at: Option<String>,
}

impl TaskView<'_> {
    #[must_use]
    pub(crate) fn to_json(&self) -> Value {
        json!(self)
    }
}

/// How a task ended.
#[derive(Debug, Default, Serialize)]
pub(crate) struct TaskEnd {
    pub state: String,
    pub text_end: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replies: Option<Vec<Value>>,
    /// Why what it did is not in the store.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_noted: Option<String>,
    /// The file of its recording.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recorded: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_recorded: Option<String>,
    /// It is to be gone on with.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub waits: bool,
    pub stopped_by: Option<String>,
}

/// A task that was shown, now that it has ended.
#[must_use]
pub(crate) fn ended(mut task: Value, end: &TaskEnd) -> Value {
    merge(&mut task, json!(end));
    task
}

/// What is driven, what waits, what ended, who drives.
#[must_use]
pub(crate) fn tasks(
    driven: Option<&Value>,
    waiting: &Waiting,
    ended: impl IntoIterator<Item = Value>,
    lease: &Value,
) -> Value {
    json!({
        "task": driven,
        "queue": waiting.tasks,
        "paused": waiting.paused.map(|at| at.to_string()),
        "ended": ended.into_iter().collect::<Vec<_>>(),
        "lease": lease,
    })
}

/// Tasks that wait, as [`TaskView`]s, and since when nothing begins.
#[derive(Debug)]
pub(crate) struct Waiting {
    pub tasks: Vec<Value>,
    pub paused: Option<Timestamp>,
}

/// The tasks that wait, alone.
#[must_use]
pub(crate) fn waiting(waiting: &Waiting) -> Value {
    json!({ "tasks": waiting.tasks, "paused": waiting.paused.map(|at| at.to_string()) })
}

/// Who drives, and for how long without a word.
#[must_use]
pub(crate) fn lease(holder: &str, session: u64, seconds: u64) -> Value {
    json!({ "holder": holder, "session": session, "seconds": seconds })
}

/// An event of a task, with which it is.
#[must_use]
pub(crate) fn of_task(mut event: Value, task: Option<u64>) -> Value {
    event["task"] = json!(task);
    event
}

/// What is known has changed, by a task where it names one.
#[must_use]
pub(crate) fn known_changed(task: Option<u64>) -> Value {
    task.map_or_else(|| json!({}), |task| json!({ "task": task }))
}

/// A stop was raised, by whom, and whether anything was driven.
#[must_use]
pub(crate) fn stop_raised(by: &str, is_running: bool) -> Value {
    json!({ "by": by, "is_running": is_running })
}

/// Told to whoever raised it.
#[must_use]
pub(crate) fn stop(is_running: bool) -> Value {
    json!({ "is_running": is_running })
}

/// A task was stopped.
#[must_use]
pub(crate) fn stopped(by: &str, task: u64) -> Value {
    json!({ "by": by, "task": task })
}

/// A task that is driven, and what bars its way; nothing, where that is over.
pub(crate) fn barred(task: &mut Value, barred: Value) {
    task["barred"] = barred;
}

/// What was said of what bars the way: `clear`, `give_up` or `silence`.
#[must_use]
pub(crate) fn cleared(answer: &str, task: u64) -> Value {
    json!({ "event": "answered", "answer": answer, "task": task })
}

/// How a task went, where its directives alone are known: they, and the events of its plan.
#[must_use]
pub(crate) fn as_it_went(directives: &[Value], events: &[&Value]) -> Value {
    let sum = |field: &str| directives.iter().filter_map(|one| one[field].as_f64()).sum::<f64>();
    json!({
        "directives": directives, "seconds": sum("seconds"), "length_cm": sum("length_cm"),
        "events": events,
    })
}

/// A task of a recording.
#[must_use]
pub(crate) fn played_again(mut task: Value, plan: &Value) -> Value {
    merge(&mut task, json!({ "plan": plan, "is_replayed": true }));
    task
}

/// A reply that is no answer: what came of a line, and its words.
#[must_use]
pub(crate) fn said(outcome: &str, text: &str, language: Option<Language>) -> Value {
    let mut view = json!({ "outcome": outcome, "text": text });
    if let Some(language) = language {
        view["language"] = json!(language.pick("ru", "en"));
    }
    view
}

/// What a line came to: its replies, what they lack while the robot is under way, and the plan that waits for a word.
#[must_use]
pub(crate) fn line(
    replies: &[Value],
    revision: u64,
    caution: Option<&str>,
    task: Option<Value>,
) -> Value {
    let mut view = json!({ "replies": replies, "revision": revision });
    if let Some(caution) = caution {
        view["caution"] = json!(caution);
    }
    if let Some(task) = task {
        view["task"] = task;
    }
    view
}

/// What is answered about the map as it stood at a revision.
#[must_use]
pub(crate) fn of_the_past(revision: u64, text: &str, replies: &Value) -> Value {
    json!({ "revision": revision, "text": text, "replies": replies })
}

/// Anything with what is to be said of it.
#[must_use]
pub(crate) fn with_text(mut view: Value, text: &str) -> Value {
    view["text"] = json!(text);
    view
}

/// What was done and has nothing else to tell.
#[must_use]
pub(crate) fn done(outcome: &str) -> Value {
    json!({ "outcome": outcome })
}

/// A reason for what was asked the other way about.
#[must_use]
pub(crate) fn with_note(mut view: Value, note: &str) -> Value {
    view["note"] = json!(note);
    view
}

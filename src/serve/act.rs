//! What is asked and changes something: talk, tasks, edits.

use std::sync::Arc;

use axum::extract::{Path, State as Of};
use axum::http::StatusCode;
use axum::{Extension, Json};
use serde::Deserialize;
use serde_json::Value;

use crate::engine::{Change, Engine, Error, Format, Mode, When, change_now, json as views};
use crate::map::Edits;
use crate::units::{Language, OwnText, Source, said};

use super::drive::Declined;
use super::fault::Fault;
use super::gate::{Role, Session};
use super::read::language;
use super::{House, apart, asked};

pub(super) type Answer = Result<Json<Value>, Fault>;

#[derive(Debug, Deserialize)]
pub(super) struct Said {
    text: String,
    lang: Option<String>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Order {
    before: Option<u64>,
}

/// Of a way that is barred.
#[derive(Debug, Deserialize)]
pub(super) struct Cleared {
    is_clear: bool,
}

/// One of the tasks that wait; all, where it names none.
#[derive(Debug, Deserialize)]
pub(super) struct Which {
    task: Option<u64>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Lease {
    /// `take`, `keep` or `give`.
    r#do: String,
}

/// An edit: sections of a map file for what is new, and steps; see docs/cli.md.
#[derive(Debug, Deserialize)]
pub(super) struct Edit {
    /// The revision that it was made on.
    on: u64,
    #[serde(default)]
    reason: String,
    /// Check and tell what would change; write nothing.
    #[serde(default)]
    r#try: bool,
    #[serde(flatten)]
    text: serde_json::Map<String, Value>,
}

/// An undo, a redo, a return.
#[derive(Debug, Deserialize)]
pub(super) struct Step {
    on: u64,
    #[serde(default)]
    reason: String,
    /// What to undo, where that is not the last; what to return to.
    revision: Option<u64>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Verdict {
    on: u64,
    /// `confirm` or `reject`.
    verdict: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Invitation {
    role: Role,
    name: String,
}

/// Hears a line.
pub(super) async fn say(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(said): Json<Said>,
) -> Answer {
    let language = language(said.lang.as_deref());
    asked(move |stop| {
        let text = said.text.trim();
        match house.tasks.of_queue(&session, text, language)? {
            Some(done) => Ok(done),
            None => house.tasks.say(&session, text, language, stop),
        }
    })
    .await
    .map(Json)
}

/// Says yes to a plan.
pub(super) async fn confirm(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Path(id): Path<u64>,
) -> Answer {
    apart(move || Ok(house.tasks.confirm(&session, id))).await?.map(Json).map_err(Fault::from)
}

impl From<Declined> for Fault {
    fn from(declined: Declined) -> Self {
        match declined {
            Declined::Unknown => unknown(),
            Declined::Expired { replies, task } => {
                Self::new(StatusCode::CONFLICT, "serve::expired", said!("the-map-or-what-the"))
                    .with("task", task)
                    .with("replies", replies)
            }
            Declined::Leased { holder, seconds } => Self::new(
                StatusCode::CONFLICT,
                "serve::leased",
                said!("drives-the-robot-s-more", holder, seconds),
            )
            .with("holder", holder)
            .with("seconds", seconds),
            Declined::Busy => {
                Self::new(StatusCode::CONFLICT, "serve::busy", said!("the-robot-is-busy-plan"))
            }
            Declined::Failed(error) => Self::of(&error),
        }
    }
}

pub(super) fn unknown() -> Fault {
    Fault::new(StatusCode::NOT_FOUND, "serve::no_such_task", said!("there-is-no-such-task"))
}

/// Drops a plan or a queued task, or stops the one that is driven.
pub(super) async fn cancel(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Path(id): Path<u64>,
) -> Answer {
    let of = Arc::clone(&house);
    let is_known = apart(move || Ok(of.tasks.cancel(&session, id))).await?;
    if is_known { Ok(Json(house.tasks.view())) } else { Err(unknown()) }
}

/// Says whether the way is clear before which a task waits, or is given up.
pub(super) async fn cleared(
    Of(house): Of<Arc<House>>,
    Path(id): Path<u64>,
    Json(said): Json<Cleared>,
) -> Answer {
    house.tasks.answer_barred(id, said.is_clear)?;
    Ok(Json(house.tasks.view()))
}

/// Puts a queued task elsewhere in the queue.
pub(super) async fn reorder(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Path(id): Path<u64>,
    Json(order): Json<Order>,
) -> Answer {
    let of = Arc::clone(&house);
    let is_known = apart(move || Ok(of.tasks.reorder(&session, id, order.before))).await?;
    if is_known { Ok(Json(house.tasks.view())) } else { Err(unknown()) }
}

/// Holds what is driven and what waits.
pub(super) async fn pause(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
) -> Answer {
    let of = Arc::clone(&house);
    apart(move || {
        of.tasks.pause(&session);
        Ok(())
    })
    .await?;
    Ok(Json(house.tasks.view()))
}

/// Goes on with what waits, or with one task.
pub(super) async fn resume(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(which): Json<Which>,
) -> Answer {
    let of = Arc::clone(&house);
    apart(move || Ok(of.tasks.go_on(&session, which.task))).await??;
    Ok(Json(house.tasks.view()))
}

/// Has an order wait.
pub(super) async fn later(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(said): Json<Said>,
) -> Answer {
    let of = Arc::clone(&house);
    apart(move || of.tasks.later(&session, said.text.trim())).await?;
    Ok(Json(house.tasks.view()))
}

/// Puts what waits in the order of the shortest way.
pub(super) async fn sort(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
) -> Answer {
    let of = Arc::clone(&house);
    apart(move || of.tasks.sort(&session)).await?;
    Ok(Json(house.tasks.view()))
}

/// Stops the robot at once.
pub(super) async fn stop(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
) -> Json<Value> {
    // The stop is raised before anything is written.
    let stopped = tokio::task::spawn_blocking(move || house.tasks.stop(&session.name)).await;
    Json(views::stop(stopped.unwrap_or_default()))
}

/// What is driven, what waits, what ended.
pub(super) async fn tasks(Of(house): Of<Arc<House>>) -> Json<Value> {
    Json(house.tasks.view())
}

/// Takes, keeps or gives back the right to drive.
pub(super) async fn lease(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(lease): Json<Lease>,
) -> Answer {
    match lease.r#do.as_str() {
        "give" => Ok(Json(house.tasks.give_back(&session))),
        "take" | "keep" => Ok(Json(house.tasks.lease(&session)?)),
        _ => Err(Fault::new(
            StatusCode::UNPROCESSABLE_ENTITY,
            "serve::lease",
            said!("this-is-take-keep-or"),
        )),
    }
}

/// What came of a change of the map.
enum Written {
    Done(Value),
    /// Others came first; these are their revisions, with what they changed.
    Stale {
        revision: u64,
        theirs: Value,
    },
}

/// Does what changes the map, where it still is what the change was made on.
pub(super) async fn write(
    house: &House,
    on: u64,
    work: impl FnOnce(&mut Engine) -> Result<Value, Error> + Send + 'static,
) -> Answer {
    let written = house.desk.ask(move |engine| {
        let revision = engine.revision();
        if revision != on {
            let theirs = theirs(engine, on)?;
            return Ok(Written::Stale { revision, theirs });
        }
        work(engine).map(Written::Done)
    });
    match written.await?.map_err(|error| Fault::of(&error))? {
        Written::Done(view) => Ok(Json(view)),
        Written::Stale { revision, theirs } => Err(Fault::new(
            StatusCode::CONFLICT,
            "serve::stale",
            said!("while-you-edited-others-changed"),
        )
        .with("on", on)
        .with("revision", revision)
        .with("theirs", theirs)),
    }
}

/// The revisions after one, with what each changed.
fn theirs(engine: &Engine, on: u64) -> Result<Value, Error> {
    let mut all = Vec::new();
    for revision in engine.revisions()?.into_iter().filter(|r| r.number > on) {
        let number = revision.number;
        let before = When::Revision(number - 1);
        let changed = engine.diff(before, When::Revision(number))?;
        all.push((revision, changed));
    }
    Ok(views::others(&all, Language::Russian))
}

fn by(session: &Session, reason: &str) -> Change {
    change_now(&session.name, reason)
}

/// Edits the map: one transaction, checked as a whole.
pub(super) async fn edit(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(edit): Json<Edit>,
) -> Answer {
    let change = by(&session, &edit.reason);
    let mode = if edit.r#try { Mode::DryRun } else { Mode::Commit };
    let text = Value::Object(edit.text).to_string();
    edited(&house, edit.on, text, change, mode).await.map(Json)
}

/// Tries or writes an edit that was made on a revision.
pub(super) async fn edited(
    house: &House,
    on: u64,
    text: String,
    change: Change,
    mode: Mode,
) -> Result<Value, Fault> {
    let written = write(house, on, move |engine| {
        let edits = Edits::read(&Source::own(OwnText::Edit, text), Format::Json);
        let edited = engine.edit(&edits, &change, mode)?;
        Ok(views::edited(&edited, Language::Russian))
    });
    written.await.map(|Json(view)| view)
}

/// Takes back the last edit that stands, or a certain one.
pub(super) async fn undo(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(step): Json<Step>,
) -> Answer {
    let change = by(&session, &step.reason);
    write(&house, step.on, move |engine| {
        Ok(views::changed("undone", &engine.undo(step.revision, &change)?))
    })
    .await
}

/// Brings back what the last undo took.
pub(super) async fn redo(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(step): Json<Step>,
) -> Answer {
    let change = by(&session, &step.reason);
    write(&house, step.on, move |engine| Ok(views::changed("redone", &engine.redo(&change)?))).await
}

/// Makes the map what it was at a revision.
pub(super) async fn restore(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(step): Json<Step>,
) -> Answer {
    let change = by(&session, &step.reason);
    write(&house, step.on, move |engine| {
        let to = When::Revision(step.revision.unwrap_or(step.on));
        Ok(views::changed("restored", &engine.return_to(to, &change)?))
    })
    .await
}

fn no_verdict() -> Fault {
    Fault::new(
        StatusCode::UNPROCESSABLE_ENTITY,
        "serve::verdict",
        said!("this-is-confirm-or-reject"),
    )
}

/// Says that a thing stands where it is believed to, or where the map has it.
pub(super) async fn decide(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Path(name): Path<String>,
    Json(said): Json<Verdict>,
) -> Answer {
    let change = by(&session, "");
    let is_confirmed = match said.verdict.as_str() {
        "confirm" => true,
        "reject" => false,
        _ => return Err(no_verdict()),
    };
    let done = write(&house, said.on, move |engine| {
        if is_confirmed {
            return Ok(views::changed("confirmed", &engine.confirm(&name, &change)?));
        }
        engine.reject(&name, &change)?;
        Ok(views::rejected(engine.revision()))
    });
    let done = done.await?;
    house.events.tell("known", &views::known_changed(None));
    Ok(done)
}

/// Writes an edit that an assistant proposed, or drops it.
pub(super) async fn judge(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Path(id): Path<String>,
    Json(said): Json<Verdict>,
) -> Answer {
    let Some(waits) = house.proposed.get(&id) else {
        return Err(Fault::new(
            StatusCode::NOT_FOUND,
            "serve::no_such_edit",
            said!("there-is-no-such-edit"),
        ));
    };
    let done = match said.verdict.as_str() {
        "confirm" => {
            // Its own reason counts, where nobody gives another.
            let text = Value::Object(waits.edit).to_string();
            edited(&house, said.on, text, by(&session, ""), Mode::Commit).await?
        }
        "reject" => views::rejected(house.desk.state().revision()),
        _ => return Err(no_verdict()),
    };
    house.proposed.drop(&id);
    house.events.tell("proposed", &views::edit_named(&id));
    Ok(Json(done))
}

/// Edits that assistants proposed, each with what it would change now.
pub(super) async fn proposed(Of(house): Of<Arc<House>>) -> Answer {
    let mut all = Vec::new();
    for (id, waits) in house.proposed.all() {
        let now = house.desk.state().revision();
        let text = Value::Object(waits.edit.clone()).to_string();
        let tried = edited(&house, now, text, change_now("", ""), Mode::DryRun).await;
        let (differences, fault) = match tried {
            Ok(tried) => (tried["differences"].clone(), Value::Null),
            Err(fault) => (Value::Array(Vec::new()), fault.body().clone()),
        };
        let (on, edit) = (waits.on, waits.edit);
        all.push(views::ProposedEdit { id, on, edit, differences, fault });
    }
    Ok(Json(views::proposed_edits(&all)))
}

/// Puts the robot back to the map's start, in a map as surveyed.
pub(super) async fn reset(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
) -> Answer {
    let change = by(&session, "reset");
    house.desk.ask(move |engine| engine.reset_robot(&change)).await??;
    house.events.tell("known", &views::known_changed(None));
    Ok(Json(views::done("reset")))
}

/// A one-time token for somebody else, of at most one's own role.
pub(super) async fn invite(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    Json(asked): Json<Invitation>,
) -> Answer {
    let name: String = asked.name.trim().chars().take(60).collect();
    let role = asked.role.min(session.role);
    let token = house.gate.invite(role, if name.is_empty() { "?" } else { &name });
    let token = token.map_err(|error| {
        let text = error.to_string();
        Fault::new(StatusCode::INTERNAL_SERVER_ERROR, "serve::random", text)
    })?;
    Ok(Json(views::invitation(&token, role.word())))
}

/// Ends the session.
pub(super) async fn leave(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
) -> Json<Value> {
    house.tasks.give_back(&session);
    house.gate.leave(&session);
    Json(views::done("left"))
}

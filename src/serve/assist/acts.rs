//! What acts or adds: plans, and drives that a person agreed to; observations; edits that are proposed.

use std::collections::BTreeSet;
use std::time::SystemTime;

use serde::Deserialize;
use serde_json::Value;

use crate::engine::{Mode, change_now, json as views, rehearsal, waiting};
use crate::units::{Deg, Frame, Language, said, told};

use super::super::fault::Fault;
use super::super::proposed::Waits;
use super::super::{act, asked, desk};
use super::approval::{Word, ask};
use super::call::{Answer, Call, Said, Told, refuse, said};
use super::driven::Driven;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Plan {
    id: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Seen {
    thing: String,
    x: Option<f64>,
    y: Option<f64>,
    #[serde(default)]
    z: f64,
    #[serde(default)]
    angle: f64,
    map: Option<String>,
    #[serde(default)]
    absent: bool,
    sure: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Edit {
    edit: serde_json::Map<String, Value>,
    #[serde(default)]
    reason: String,
    on: Option<u64>,
}

impl Call<'_> {
    pub(super) async fn plan(&self, order: Said) -> Answer {
        let (house, session) = (self.house(), self.session.clone());
        let language = order.language();
        let text = order.text.trim();
        // Nothing goes on by a line: `run` alone drives, with a person's word.
        if waiting(text).is_some() {
            return Err(refuse("assist::queue", said!("the-queue-is-the-operators")));
        }
        let text = text.to_owned();
        let heard = asked(move |stop| house.tasks.say(&session, &text, language, stop));
        let view = heard.await?;
        let text = match view.get("task") {
            Some(task) => plan_in_words(task, language),
            None => said(&view["replies"]),
        };
        Ok(Told::Value(views::with_text(view, &text)))
    }

    pub(super) async fn carry_out(&self, plan: Plan) -> Answer {
        let house = self.house();
        let Some(task) = house.tasks.planned(plan.id) else {
            return Err(act::unknown());
        };
        let about = format!("run {}", plan.id);
        let order = task["text"].as_str().unwrap_or_default();
        let question = plan_in_words(&task, Language::of(order));
        if let Some(waits) = self.approved(&about, &question).await? {
            return Ok(waits);
        }
        let driven = Driven::begin(house, self.session.clone(), plan.id).await?;
        if self.context.client_capabilities().is_some_and(|can| can.supports_tasks()) {
            return Ok(Told::Begun(Box::new(driven.into_task(&self.assistant.tasks))));
        }
        driven.within(self.context).await.map(Told::Value)
    }

    /// A person's yes is none; what is to be returned, where it is not there yet.
    async fn approved(&self, about: &str, question: &str) -> Result<Option<Told>, Fault> {
        let by = (self.request, self.context);
        let (asked, trusts) = (&self.assistant.asked, self.assistant.trusts_host);
        let word = ask(asked, trusts, by, about, question).await.map_err(|error| {
            let told = error.to_string();
            refuse("assist::asking", told)
        })?;
        match word {
            Word::Yes => Ok(None),
            Word::Ask(question) => Ok(Some(Told::Waits(question))),
            Word::No => Err(refuse("assist::declined", said!("the-person-did-not-agree"))),
            Word::NobodyToAsk => {
                Err(refuse("assist::nobody_to_ask", said!("there-is-nobody-to-ask")))
            }
        }
    }

    pub(super) async fn observe(&self, seen: Seen) -> Answer {
        let at = match (seen.absent, seen.x, seen.y) {
            (true, None, None) => None,
            (false, Some(x), Some(y)) => Some(Frame::new(x, y, seen.z, Deg::of(seen.angle))),
            _ => {
                return Err(refuse("assist::place", said!("it-takes-x-and-y")));
            }
        };
        let sure = seen.sure.unwrap_or(0.9);
        let observer = self.session.name.clone();
        let house = self.house();
        let noted = house.desk.ask(move |engine| {
            let when = SystemTime::now().into();
            match at {
                Some(frame) => {
                    let place = (seen.map.as_deref(), frame);
                    engine.observe_on_map(&seen.thing, place, sure, &observer, when)
                }
                None => engine.observe(&seen.thing, None, sure, &observer, when),
            }
        });
        noted.await?.map_err(|error| Fault::of(&error))?;
        house.events.tell("known", &views::known_changed(None));
        Ok(Told::Value(views::done("noted")))
    }

    pub(super) async fn propose_edit(&self, proposed: Edit) -> Answer {
        let house = self.house();
        let on = proposed.on.unwrap_or_else(|| house.desk.state().revision());
        let text = Value::Object(proposed.edit.clone()).to_string();
        let change = change_now(&self.session.name, &proposed.reason);
        let tried = act::edited(&house, on, text.clone(), change.clone(), Mode::DryRun).await?;
        if tried["differences"].as_array().is_none_or(Vec::is_empty) {
            return Err(refuse("assist::nothing", said!("this-edit-changes-nothing")));
        }
        let question = edit_in_words(&tried, &proposed.reason);
        let about = format!("edit on {on}: {text}");
        match self.approved(&about, &question).await {
            Ok(Some(waits)) => return Ok(waits),
            Ok(None) => {}
            Err(fault) if fault.body()["code"] == "assist::nobody_to_ask" => {
                let mut edit = proposed.edit;
                // Who writes it is its author; who thought of it is told in the reason.
                let reason = format!("{}: {}", self.session.name, proposed.reason);
                edit.insert("reason".to_owned(), reason.into());
                return self.laid_beside(Waits { on, edit }, tried).await;
            }
            Err(fault) => return Err(fault),
        }
        act::edited(&house, on, text, change, Mode::Commit).await.map(Told::Value)
    }

    /// Leaves an edit that nobody could be asked about for the operator: in the console, and as a file that
    /// `ortho edit --file` takes.
    async fn laid_beside(&self, waits: Waits, tried: Value) -> Answer {
        let at =
            SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, |d| d.as_millis());
        let house = self.house();
        let laid = tokio::task::spawn_blocking(move || house.proposed.lay(waits, at));
        let (id, file) = match laid.await {
            Ok(Ok(laid)) => laid,
            Ok(Err(error)) => {
                let told = error.to_string();
                return Err(refuse("assist::disk", told));
            }
            Err(_) => return Err(desk::Gone.into()),
        };
        self.house().events.tell("proposed", &views::edit_named(&id));
        let by_file = file.as_ref().map_or_else(String::new, |file| {
            format!(", or by `ortho edit --file {}`", file.display())
        });
        let text = format!(
            "The edit is sound and not written: nobody could be asked. The operator can write it in the console{by_file}."
        );
        Ok(Told::Value(views::laid_beside(tried, &id, file.as_deref(), &text)))
    }
}

/// An edit as it is shown to a person, in the language of its reason: what it changes, what it leaves where it is, what
/// there is to doubt.
fn edit_in_words(tried: &Value, reason: &str) -> String {
    let language = if reason.is_empty() { Language::English } else { Language::of(reason) };
    let list = |field: &str| tried[field].as_array().into_iter().flatten();
    let mut lines = vec![reason];
    let field = language.pick("ru", "en");
    lines.extend(list("differences").filter_map(|difference| difference[field].as_str()));
    let left: Vec<&str> = list("left_behind").filter_map(Value::as_str).collect();
    let left = format!("{}: {}", told!(language, "stays-behind"), left.join(", "));
    if list("left_behind").next().is_some() {
        lines.push(&left);
    }
    lines.extend(list("told").filter_map(|warning| warning["message"].as_str()));
    lines.retain(|line| !line.is_empty());
    lines.join("\n")
}

/// A plan as it is shown to a person.
fn plan_in_words(task: &Value, language: Language) -> String {
    let plan = &task["plan"];
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let field = language.pick("ru", "en");
    let order = told!(language, "task");
    let mut lines = vec![format!("{order}: {}", text(&task["text"]))];
    lines.push(text(&plan[format!("proof_{field}")]));
    let steps = rehearsal::plans_of(plan).filter_map(|plan| plan["steps"].as_array()).flatten();
    let steps = steps.filter_map(|step| step.as_array()).flatten();
    for (number, step) in (1..).zip(steps) {
        lines.push(format!("{number}. {}", text(&step[format!("do_{field}")])));
    }
    let assumed = rehearsal::plans_of(plan).map(|plan| &plan[format!("assumptions_{field}")]);
    let mut seen = BTreeSet::new();
    let assumed = assumed.filter_map(Value::as_array).flatten().map(text);
    let assumed: Vec<String> = assumed.filter(|one| seen.insert(one.clone())).collect();
    if !assumed.is_empty() {
        let head = told!(language, "assuming");
        lines.push(format!("{head}: {}", assumed.join("; ")));
    }
    for (what, head) in
        [("opens", told!(language, "it-opens")), ("carries", told!(language, "it-takes-or-pushes"))]
    {
        let names = plan[what].as_array().into_iter().flatten();
        let names: Vec<String> = names.map(|name| text(&name[field])).collect();
        if !names.is_empty() {
            lines.push(format!("{head}: {}", names.join(", ")));
        }
    }
    if plan["more"] != 0 {
        lines.push(told!(language, "first-part"));
    }
    lines.join("\n")
}

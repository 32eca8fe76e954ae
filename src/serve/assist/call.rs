//! One call: which piece of the house answers it, and what it came to.

use std::sync::Arc;

use axum::http::StatusCode;
use rmcp::model::{CallToolRequestParams, InputRequiredResult, Task};
use rmcp::service::{RequestContext, RoleServer};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::engine::json as views;
use crate::units::Language;

use super::super::fault::Fault;
use super::super::gate::Session;
use super::super::{House, apart, read};
use super::client::Assistant;

/// What a call came to.
pub(super) enum Told {
    Value(Value),
    /// PNG, and what it shows.
    Picture(Vec<u8>, Value),
    /// The client's user is to be asked first.
    Waits(Box<InputRequiredResult>),
    /// It goes on by itself; the client asks how far it is.
    Begun(Box<Task>),
}

pub(super) type Answer = Result<Told, Fault>;

/// One call.
pub(super) struct Call<'c> {
    pub(super) assistant: &'c Assistant,
    pub(super) session: &'c Session,
    pub(super) request: &'c CallToolRequestParams,
    pub(super) context: &'c RequestContext<RoleServer>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Said {
    pub(super) text: String,
    lang: Option<String>,
}

impl Said {
    /// The language to answer in: where nobody says, that of the letters.
    pub(super) fn language(&self) -> Language {
        match self.lang.as_deref() {
            Some("ru") => Language::Russian,
            Some(_) => Language::English,
            None => Language::of(&self.text),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Nothing {}

pub(super) fn refuse(code: &str, russian: &str, english: &str) -> Fault {
    Fault::new(StatusCode::UNPROCESSABLE_ENTITY, code, russian, english)
}

fn arguments<T: DeserializeOwned>(given: Value) -> Result<T, Fault> {
    serde_json::from_value(given).map_err(|error| {
        let (ru, en) = (format!("аргументы: {error}"), format!("arguments: {error}"));
        refuse("assist::arguments", &ru, &en)
    })
}

/// What was replied, as one text.
pub(super) fn said(replies: &Value) -> String {
    let all = replies.as_array().into_iter().flatten();
    all.filter_map(|reply| reply["text"].as_str()).collect::<Vec<_>>().join("\n")
}

impl Call<'_> {
    pub(super) fn house(&self) -> Arc<House> {
        Arc::clone(&self.assistant.house)
    }

    pub(super) async fn run(&self, name: &str, given: Value) -> Answer {
        match name {
            "ask" => self.ask(arguments(given)?).await,
            "query" => self.query(arguments(given)?).await,
            "where_is" => self.where_is(arguments(given)?).await,
            "relations" => self.relations(arguments(given)?).await,
            "why" => self.reasons(arguments(given)?, true).await,
            "why_not" => self.reasons(arguments(given)?, false).await,
            "route" => self.route(arguments(given)?).await,
            "map" => self.map(arguments(given)?).await,
            "history" => self.history(arguments(given)?).await,
            "as_of" => self.as_of(arguments(given)?).await,
            "tasks" => {
                let Nothing {} = arguments(given)?;
                Ok(Told::Value(self.house().tasks.view()))
            }
            "proposals" => {
                let Nothing {} = arguments(given)?;
                read::proposed(&self.house()).await.map(Told::Value)
            }
            "plan" => self.plan(arguments(given)?).await,
            "run" => self.carry_out(arguments(given)?).await,
            "stop" => {
                let Nothing {} = arguments(given)?;
                let (house, by) = (self.house(), self.session.name.clone());
                let is_running = apart(move || Ok(house.tasks.stop(&by))).await?;
                Ok(Told::Value(views::stop(is_running)))
            }
            "observe" => self.observe(arguments(given)?).await,
            "propose_edit" => self.propose_edit(arguments(given)?).await,
            other => unreachable!("the table has no {other}"),
        }
    }
}

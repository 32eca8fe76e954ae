//! One call: which piece of the house answers it, and what it came to.

use std::sync::Arc;

use axum::http::StatusCode;
use rmcp::model::{CallToolRequestParams, InputRequiredResult, Task};
use rmcp::service::{RequestContext, RoleServer};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::engine::json as views;
use crate::units::{Bilingual, Language};

use super::super::fault::Fault;
use super::super::gate::Session;
use super::super::{House, apart, read};
use super::arguments;
use super::client::Assistant;
use super::tools::Row;

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

pub(super) fn refuse(code: &str, said: impl Into<Bilingual>) -> Fault {
    Fault::new(StatusCode::UNPROCESSABLE_ENTITY, code, said)
}

fn taken<T: DeserializeOwned>(given: Value) -> T {
    serde_json::from_value(given).expect("what fits the schema of its tool is read")
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

    pub(super) async fn run(&self, row: &Row, given: Map<String, Value>) -> Answer {
        arguments::check(row.name, &row.takes(), &given)?;
        let given = Value::Object(given);
        // A stop waits for nothing.
        if row.name != "stop" {
            self.house().desk.fresh().await?;
        }
        match row.name {
            "ask" => self.ask(taken(given)).await,
            "query" => self.query(taken(given)).await,
            "where_is" => self.where_is(taken(given)).await,
            "relations" => self.relations(taken(given)).await,
            "why" => self.reasons(taken(given), true).await,
            "why_not" => self.reasons(taken(given), false).await,
            "route" => self.route(taken(given)).await,
            "map" => self.map(taken(given)).await,
            "history" => self.history(taken(given)).await,
            "as_of" => self.as_of(taken(given)).await,
            "tasks" => Ok(Told::Value(self.house().tasks.view())),
            "proposals" => read::proposed(&self.house()).await.map(Told::Value),
            "plan" => self.plan(taken(given)).await,
            "run" => self.carry_out(taken(given)).await,
            "stop" => {
                let (house, by) = (self.house(), self.session.name.clone());
                let is_running = apart(move || Ok(house.tasks.stop(&by))).await?;
                Ok(Told::Value(views::stop(is_running)))
            }
            "observe" => self.observe(taken(given)).await,
            "propose_edit" => self.propose_edit(taken(given)).await,
            other => unreachable!("the table has no {other}"),
        }
    }
}

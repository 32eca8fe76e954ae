//! A person's word before anything is done: asked for through the client's program.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use rmcp::model::{
    CallToolRequestParams, ElicitRequest, ElicitRequestParams, ElicitationAction, InputRequest,
    InputRequests, InputRequiredResult, ProtocolVersion,
};
use rmcp::service::{RequestContext, RoleServer};
use serde_json::json;

use crate::units::{Language, word};

use super::super::gate;

/// What came of asking.
#[derive(Debug)]
pub(super) enum Word {
    Yes,
    No,
    /// The client's program is to ask, and to call again with the answer.
    Ask(Box<InputRequiredResult>),
    /// It cannot ask, and whoever started the server did not say that it asks by itself.
    NobodyToAsk,
}

/// Questions that were handed out, by what the client must give back, and what each is about.
#[derive(Debug, Default)]
pub(super) struct Asked(Mutex<BTreeMap<String, String>>);

/// So many questions may be open; the oldest to be forgotten is any.
const MOST_OPEN: usize = 256;

impl Asked {
    fn hand_out(&self, about: &str) -> std::io::Result<String> {
        let secret = gate::random()?;
        let mut open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if open.len() >= MOST_OPEN {
            open.pop_first();
        }
        open.insert(secret.clone(), about.to_owned());
        Ok(secret)
    }

    /// Whether this was handed out for that; it is good once.
    fn take_back(&self, secret: &str, about: &str) -> bool {
        let mut open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        open.get(secret).is_some_and(|of| of == about) && open.remove(secret).is_some()
    }
}

const FIELD: &str = "approve";

fn form(question: &str) -> ElicitRequestParams {
    let word = word!("do-it");
    let [russian, english] = [Language::Russian, Language::English].map(|l| word.say(l));
    let description = format!("{russian} · {english}");
    let schema = json!({
        "type": "object",
        "properties": {
            FIELD: { "type": "boolean", "title": "Do it", "description": description },
        },
        "required": [FIELD],
    });
    ElicitRequestParams::FormElicitationParams {
        meta: None,
        message: question.to_owned(),
        requested_schema: serde_json::from_value(schema).expect("it is a flat form"),
    }
}

/// Asks whether something is to be done. `about` names it; a yes to one thing is none to another.
pub(super) async fn ask(
    asked: &Asked,
    trusts_host: bool,
    (request, context): (&CallToolRequestParams, &RequestContext<RoleServer>),
    about: &str,
    question: &str,
) -> Result<Word, rmcp::ErrorData> {
    let said = |action: bool, content: &serde_json::Value| match action && content[FIELD] == true {
        true => Word::Yes,
        false => Word::No,
    };
    if let (Some(answers), Some(state)) = (&request.input_responses, &request.request_state) {
        if !asked.take_back(state, about) {
            return Err(rmcp::ErrorData::invalid_params("this was not asked", None));
        }
        let answer = &answers.get(FIELD).cloned().unwrap_or_default();
        return Ok(said(answer["action"] == "accept", &answer["content"]));
    }
    let can = context.client_capabilities().and_then(|all| all.elicitation);
    let can = can.is_some_and(|can| can.form.is_some() || can.url.is_none());
    if !can {
        return Ok(if trusts_host { Word::Yes } else { Word::NobodyToAsk });
    }
    let version = context.protocol_version();
    if version.is_some_and(|v| v.as_str() >= ProtocolVersion::V_2026_07_28.as_str()) {
        let secret = asked.hand_out(about).map_err(|error| {
            rmcp::ErrorData::internal_error(format!("no random numbers: {error}"), None)
        })?;
        let question = InputRequest::Elicitation(ElicitRequest::new(form(question)));
        let questions = InputRequests::from([(FIELD.to_owned(), question)]);
        return Ok(Word::Ask(Box::new(InputRequiredResult::new(Some(questions), Some(secret)))));
    }
    let answer = context.peer.create_elicitation(form(question)).await;
    let answer = answer.map_err(|error| {
        rmcp::ErrorData::internal_error(format!("the user could not be asked: {error}"), None)
    })?;
    Ok(said(answer.action == ElicitationAction::Accept, &answer.content.unwrap_or_default()))
}

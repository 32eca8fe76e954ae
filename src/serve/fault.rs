//! Refusals as a program and a person read them.

use axum::Json;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use miette::Diagnostic;
use serde_json::{Value, json};

use crate::engine::{Error, json as views};
use crate::units::{Bilingual, Language, said, told};

use super::desk::Gone;

/// Why a request is not followed.
#[derive(Debug)]
pub(super) struct Fault {
    status: StatusCode,
    body: Value,
}

impl Fault {
    /// In both languages, with a stable code.
    #[must_use]
    pub(super) fn new(status: StatusCode, code: &str, said: impl Into<Bilingual>) -> Self {
        let said = said.into();
        let [russian, english] = [Language::Russian, Language::English].map(|l| said.say(l));
        let body = json!({
            "outcome": "refused", "code": code, "message": russian, "message_en": english,
        });
        Self { status, body }
    }

    /// Whoever asks may not.
    #[must_use]
    pub(super) fn of_role() -> Self {
        Self::new(StatusCode::FORBIDDEN, "serve::role", said!("your-role-is-not-enough"))
    }

    /// Arguments of a tool that it does not take, all at once.
    #[must_use]
    pub(super) fn of_arguments(tool: &str, faults: &[Bilingual]) -> Self {
        let told = |language: Language| {
            let all: Vec<&str> = faults.iter().map(|fault| fault.say(language)).collect();
            told!(language, "call-of", tool, faults = all.join("; "))
        };
        let each: Vec<Value> = faults
            .iter()
            .map(|fault| {
                let [russian, english] =
                    [Language::Russian, Language::English].map(|language| fault.say(language));
                json!({ "message": russian, "message_en": english })
            })
            .collect();
        let told = Bilingual::both(told);
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, "assist::arguments", told).with("faults", each)
    }

    /// What is sent: code, message, help, in both languages.
    #[must_use]
    pub(super) fn body(&self) -> &Value {
        &self.body
    }

    /// With what else is to be known.
    #[must_use]
    pub(super) fn with(mut self, field: &str, value: impl Into<Value>) -> Self {
        self.body[field] = value.into();
        self
    }

    /// An error of the engine.
    #[must_use]
    pub(super) fn of(error: &Error) -> Self {
        let status = if error.is_input() {
            StatusCode::UNPROCESSABLE_ENTITY
        } else {
            StatusCode::INTERNAL_SERVER_ERROR
        };
        let text = |found: Option<Box<dyn std::fmt::Display + '_>>| found.map(|t| t.to_string());
        let mut faults = views::faults(error);
        for (fault, english) in faults.iter_mut().zip(views::faults(&*error.in_english())) {
            fault["message_en"] = english["message"].clone();
            fault["help_en"] = english["help"].clone();
        }
        let one = |field: &str| match &faults[..] {
            [only] => only[field].as_str().map(str::to_owned),
            _ => None,
        };
        let body = json!({
            "outcome": "refused",
            "code": text(error.code()).or(one("code")),
            "message": one("message").unwrap_or_else(|| error.say(Language::Russian)),
            // What is said of a request names things as English does.
            "message_en": match error {
                Error::Request(_) | Error::Misheard(_) => error.say(Language::English),
                _ => one("message_en").unwrap_or_else(|| error.say(Language::English)),
            },
            "help": text(error.help()).or(one("help")),
            "help_en": one("help_en"),
            "faults": faults,
        });
        Self { status, body }
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::of(&error)
    }
}

impl From<Gone> for Fault {
    fn from(_: Gone) -> Self {
        Self::new(
            StatusCode::SERVICE_UNAVAILABLE,
            "serve::gone",
            said!("the-engine-has-stopped-restart"),
        )
    }
}

impl IntoResponse for Fault {
    fn into_response(self) -> Response {
        (self.status, Json(self.body)).into_response()
    }
}

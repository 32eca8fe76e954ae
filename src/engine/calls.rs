//! The calls of assistants, one JSON object a line, in a file beside the store: who called, what for, what it came to.

use std::fs::File;
use std::io::{BufRead as _, BufReader, ErrorKind};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::store::Timestamp;
use crate::units::{Language, is_input, told};

use super::RequestError;

/// A call as it is noted: when it was made, though it is noted when it has ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Call {
    pub(crate) at: Timestamp,
    pub(crate) client: String,
    pub(crate) tool: String,
    pub(crate) arguments: Value,
    pub(crate) outcome: Ending,
}

/// What a call came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Ending {
    Answered,
    Refused,
    /// A person is asked first.
    Asked,
    /// It goes on by itself.
    Begun,
    /// The client took it back, or left.
    Cancelled,
}

impl Ending {
    fn say(self, language: Language) -> String {
        match self {
            Self::Answered => told!(language, "call-answered"),
            Self::Refused => told!(language, "call-refused"),
            Self::Asked => told!(language, "call-asks"),
            Self::Begun => told!(language, "call-begun"),
            Self::Cancelled => told!(language, "call-cancelled"),
        }
    }
}

impl Call {
    /// `query {"query":"?- …"} – дан ответ`
    pub(crate) fn say(&self, language: Language) -> String {
        let arguments = match &self.arguments {
            Value::Object(given) if given.is_empty() => String::new(),
            given => format!(" {given}"),
        };
        format!("{}{arguments} – {}", self.tool, self.outcome.say(language))
    }
}

/// Where the calls of a store are noted.
pub(crate) fn file(store: &Path) -> PathBuf {
    let mut name = store.as_os_str().to_owned();
    name.push(".calls.jsonl");
    PathBuf::from(name)
}

/// The calls that are noted in a file, the oldest first, and how many of its lines cannot be read: a disk that was full, or
/// a machine that stopped, leaves half a line.
///
/// # Errors
/// The disk refused. A file that is not there holds no calls.
pub(crate) fn noted(file: &Path) -> Result<(Vec<Call>, usize), RequestError> {
    let refused = |error: std::io::Error| RequestError::File {
        path: file.display().to_string(),
        reason: error.to_string().into(),
        is_input: is_input(error.kind()),
    };
    let lines = match File::open(file) {
        Ok(opened) => BufReader::new(opened).split(b'\n'),
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok((Vec::new(), 0)),
        Err(error) => return Err(refused(error)),
    };
    let (mut calls, mut unread) = (Vec::new(), 0);
    for line in lines {
        match serde_json::from_slice(&line.map_err(refused)?) {
            Ok(call) => calls.push(call),
            Err(_) => unread += 1,
        }
    }
    // They are noted as they end.
    calls.sort_by_key(|call: &Call| call.at);
    Ok((calls, unread))
}

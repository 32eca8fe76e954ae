//! The calls of assistants, one JSON object a line, in a file beside the store.

use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::SystemTime;

use serde_json::{Value, json};

use crate::store::Timestamp;

/// Of one argument so much is noted.
const MOST: usize = 2000;

/// See the head of this file.
#[derive(Debug)]
pub(super) struct Calls {
    /// None for a store that ends with the program.
    file: Option<PathBuf>,
    /// One line at a time.
    lock: Mutex<()>,
}

impl Calls {
    pub(super) fn new(file: Option<PathBuf>) -> Self {
        Self { file, lock: Mutex::default() }
    }

    /// A disk that refuses costs the note, not the answer.
    pub(super) fn note(&self, client: &str, tool: &str, arguments: &Value, outcome: &str) {
        tracing::info!(client, tool, outcome, "called");
        let Some(file) = &self.file else { return };
        let at: Timestamp = SystemTime::now().into();
        let whole = arguments.to_string();
        let arguments =
            if whole.len() > MOST { json!({ "bytes": whole.len() }) } else { arguments.clone() };
        let line = json!({
            "at": at.to_string(), "client": client, "tool": tool, "arguments": arguments,
            "outcome": outcome,
        });
        let _one = self.lock.lock().unwrap_or_else(PoisonError::into_inner);
        let opened = OpenOptions::new().create(true).append(true).open(file);
        let written = opened.and_then(|mut file| file.write_all(format!("{line}\n").as_bytes()));
        if let Err(error) = written {
            tracing::warn!(%error, "a call is not noted");
        }
    }
}

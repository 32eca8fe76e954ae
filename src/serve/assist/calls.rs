//! Notes the calls of assistants (`engine::calls`).

use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use serde_json::{Value, json};

use crate::engine::calls::{Call, Ending};
use crate::store::Timestamp;

/// Of one argument so much is noted.
const MOST: usize = 2000;

/// Where calls are noted.
#[derive(Debug)]
pub(super) struct Calls {
    /// None for a store that ends with the program.
    pub(super) file: Option<PathBuf>,
    /// One line at a time.
    lock: Mutex<()>,
}

impl Calls {
    pub(super) fn new(file: Option<PathBuf>) -> Self {
        Self { file, lock: Mutex::default() }
    }

    /// Notes what a call came to that was made at a moment. A disk that refuses costs the note, not the answer.
    pub(super) fn note(
        &self,
        at: Timestamp,
        client: &str,
        tool: &str,
        arguments: &Value,
        outcome: Ending,
    ) {
        tracing::info!(client, tool, ?outcome, "called");
        let Some(file) = &self.file else { return };
        let whole = arguments.to_string();
        let arguments =
            if whole.len() > MOST { json!({ "bytes": whole.len() }) } else { arguments.clone() };
        let (client, tool) = (client.to_owned(), tool.to_owned());
        let call = Call { at, client, tool, arguments, outcome };
        let line = serde_json::to_string(&call).expect("a call has no keys but texts");
        let _one = self.lock.lock().unwrap_or_else(PoisonError::into_inner);
        let opened = OpenOptions::new().create(true).append(true).open(file);
        let written = opened.and_then(|mut file| file.write_all(format!("{line}\n").as_bytes()));
        if let Err(error) = written {
            tracing::warn!(%error, "a call is not noted");
        }
    }
}

//! Edits that an assistant proposes and nobody could be asked about: they wait for the operator.
//!
//! **Invariant.** Each is a file that `ortho edit --file` takes, beside a store that lasts; nothing of it is in the map before
//! somebody who may edit has said so.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde_json::{Map, Value};

use crate::units::{InOrder as _, write_file};

/// So many wait at the most; beyond, the oldest is forgotten here, and its file is left.
const MOST: usize = 200;
/// The longest of them, in bytes.
const LONGEST: u64 = 1 << 20;

/// An edit that waits for a word.
#[derive(Debug, Clone)]
pub(super) struct Waits {
    /// The revision that it was made on.
    pub(super) on: u64,
    /// As an edit file has it, with its reason.
    pub(super) edit: Map<String, Value>,
}

#[derive(Debug)]
pub(super) struct Proposed {
    folder: Option<PathBuf>,
    waiting: Mutex<BTreeMap<String, Waits>>,
}

impl Proposed {
    /// What an earlier run of the program left, and what will come.
    #[must_use]
    pub(super) fn in_folder(folder: Option<PathBuf>) -> Self {
        let mut waiting = BTreeMap::new();
        let files = folder.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten();
        for file in files.flatten() {
            let name = file.file_name();
            let Some(id) = name.to_str().and_then(|name| name.strip_suffix(".json")) else {
                continue;
            };
            let Some(on) = revision(id) else { continue };
            let is_short = file.metadata().is_ok_and(|about| about.len() <= LONGEST);
            // What is no edit is somebody else's file.
            if is_short
                && let Ok(text) = std::fs::read_to_string(file.path())
                && let Ok(edit) = serde_json::from_str(&text)
            {
                waiting.insert(id.to_owned(), Waits { on, edit });
            }
        }
        Self { folder, waiting: Mutex::new(waiting) }
    }

    fn waiting(&self) -> MutexGuard<'_, BTreeMap<String, Waits>> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lays an edit beside the store; its id, and its file where the store lasts.
    ///
    /// # Errors
    /// The disk refused.
    pub(super) fn lay(&self, waits: Waits, at: u128) -> std::io::Result<(String, Option<PathBuf>)> {
        let mut waiting = self.waiting();
        let id = (0..)
            .map(|n| format!("{}-{}", waits.on, at + n))
            .find(|id| !waiting.contains_key(id))
            .expect("some moment is free");
        let file = self.folder.as_ref().map(|folder| folder.join(format!("{id}.json")));
        if let (Some(folder), Some(file)) = (&self.folder, &file) {
            std::fs::create_dir_all(folder)?;
            write_file(file, Value::Object(waits.edit.clone()).to_string().as_bytes())?;
        }
        waiting.insert(id.clone(), waits);
        while waiting.len() > MOST {
            waiting.pop_first();
        }
        Ok((id, file))
    }

    /// All that wait, the earliest first.
    pub(super) fn all(&self) -> Vec<(String, Waits)> {
        let waiting = self.waiting();
        let mut all: Vec<(String, Waits)> =
            waiting.iter().map(|(id, waits)| (id.clone(), waits.clone())).collect();
        all.order_by_key(|(id, _)| moment(id));
        all
    }

    pub(super) fn get(&self, id: &str) -> Option<Waits> {
        self.waiting().get(id).cloned()
    }

    /// One waits no longer. False where there is none.
    pub(super) fn drop(&self, id: &str) -> bool {
        let is_known = self.waiting().remove(id).is_some();
        // What is taken was known here, so that its id is a name of ours and no path.
        if let Some(folder) = self.folder.as_ref().filter(|_| is_known) {
            let _gone = std::fs::remove_file(folder.join(format!("{id}.json")));
        }
        is_known
    }
}

/// «7-1700000000000» was made on revision 7.
fn revision(id: &str) -> Option<u64> {
    let (on, at) = id.split_once('-')?;
    at.parse::<u128>().ok()?;
    on.parse().ok()
}

/// Its revision and moment, as numbers.
fn moment(id: &str) -> Option<(u64, u128)> {
    let (_, at) = id.split_once('-')?;
    Some((revision(id)?, at.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_proposed_outlives_the_program_until_it_is_decided() {
        let folder = tempfile::tempdir().expect("a folder").path().join("store.proposed");
        let edit = |reason: &str| {
            let edit = serde_json::json!({ "reason": reason, "edit": [{ "remove": "Чашка-1" }] });
            Waits { on: 4, edit: edit.as_object().expect("it is one").clone() }
        };
        let proposed = Proposed::in_folder(Some(folder.clone()));
        let (first, file) = proposed.lay(edit("a"), 9).expect("it is written");
        let (second, _) = proposed.lay(edit("b"), 9).expect("it is written");
        assert_ne!(first, second);
        assert!(file.is_some_and(|file| file.exists()));
        std::fs::write(folder.join("note.json"), "{}").expect("it is written");
        std::fs::write(folder.join("4-11.json"), "no edit").expect("it is written");
        let again = Proposed::in_folder(Some(folder.clone()));
        let reasons: Vec<Value> =
            again.all().into_iter().map(|(_, w)| w.edit["reason"].clone()).collect();
        assert_eq!(reasons, ["a", "b"]);
        assert!(again.drop(&first) && !again.drop(&first) && !again.drop("../note"));
        assert_eq!(Proposed::in_folder(Some(folder)).all().len(), 1);
    }
}

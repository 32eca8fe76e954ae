//! What is driven, recorded: a file of each task in one folder (docs/recordings.md).
//!
//! **Invariant.** A disk that refuses costs the recording, never the drive; the task's end tells of it.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::engine::{Error, Event, Recording, State};
use crate::store::Timestamp;

/// See the head of this file.
#[derive(Debug)]
pub(super) struct Recorded {
    pub(super) file: PathBuf,
    recording: Recording,
}

impl Recorded {
    /// Begins a file, named by the moment and the task.
    ///
    /// # Errors
    /// There is no map, or the disk refused.
    pub(super) fn begin(folder: &Path, task: u64, state: &State) -> Result<Self, Error> {
        // Where there is none, the file cannot be made either, which says why.
        let _ = std::fs::create_dir_all(folder);
        let now: Timestamp = SystemTime::now().into();
        // A colon is no letter of a file's name everywhere.
        let name = format!("{}-{task}.mcap", now.to_string().replace(':', "-"));
        let (file, mut recording) = (folder.join(name), Recording::begin());
        recording.to_file(&file, state)?;
        Ok(Self { file, recording })
    }

    pub(super) fn tell(&mut self, state: &State, event: &Event<'_>) {
        self.recording.tell(state, event);
    }

    /// # Errors
    /// It is not whole.
    pub(super) fn end(self) -> Result<(), Error> {
        self.recording.end()
    }
}

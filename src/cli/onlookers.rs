//! Who is told of a drive beside the person at the terminal: a recording, and whoever wants the plan as a tree.

use std::path::{Path, PathBuf};

use crate::engine::{Engine, Event, Progress, Recording};
use crate::units::write_file;

use super::args::RecordArgs;
use super::fault::Failure;

impl RecordArgs {
    /// # Errors
    /// The file cannot be written.
    pub(super) fn begin(&self, engine: &Engine) -> Result<Onlookers, Failure> {
        let mut onlookers = Onlookers::default();
        if let Some(path) = &self.record {
            let mut recording = Recording::begin();
            recording.to_file(path, engine)?;
            onlookers.recording = Some(recording);
        }
        Ok(onlookers)
    }
}

/// Who is told of a drive beside the person at the terminal.
#[derive(Debug, Default)]
pub(super) struct Onlookers {
    recording: Option<Recording>,
    /// Where the first plan is to be written as a behaviour tree.
    tree: Option<PathBuf>,
    failure: Option<Failure>,
}

impl Onlookers {
    /// The same, and the first plan is written as a behaviour tree.
    pub(super) fn writing(self, tree: Option<&Path>) -> Self {
        Self { tree: tree.map(Path::to_owned), ..self }
    }

    pub(super) fn tell(&mut self, engine: &Engine, event: &Event<'_>) {
        if let Some(recording) = &mut self.recording {
            recording.tell(engine, event);
        }
        if let Event::Progress { progress: Progress::Planned(planned), .. } = event
            && let Some(path) = self.tree.take()
        {
            match engine.behaviour_tree(planned) {
                Ok(Some(text)) => {
                    let written = write_file(&path, text.as_bytes());
                    self.failure = written.err().map(|error| Failure::file(&path, &error));
                }
                // A later part of the order may have a plan.
                Ok(None) => self.tree = Some(path),
                Err(error) => self.failure = Some(error.into()),
            }
        }
    }

    /// # Errors
    /// Something could not be written.
    pub(super) fn end(&mut self) -> Result<(), Failure> {
        let recorded = self.recording.take().map_or(Ok(()), Recording::end);
        self.failure.take().map_or(Ok(()), Err).and(recorded.map_err(Failure::from))
    }
}

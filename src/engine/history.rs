//! The history of the map: revisions, what changed between them, undo and redo (D3).

use std::sync::Arc;

use crate::store::{
    Change, Difference, Forgotten, ImportReport, Revision, Store, StoreError, Timestamp,
};
use crate::units::{Bilingual, said, word};

use super::edit::Spares;
use super::{Engine, Error, RequestError, State};

/// A point of the history as a person names it: a revision's number, or a moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum When {
    Revision(u64),
    Moment(Timestamp),
}

impl std::str::FromStr for When {
    type Err = Bilingual;

    /// `17`, `2026-11-21`, `2026-11-21T09:30:00Z`.
    fn from_str(text: &str) -> Result<Self, Bilingual> {
        if let Ok(number) = text.parse() {
            return Ok(Self::Revision(number));
        }
        let moment = text.parse::<Timestamp>().map(Self::Moment);
        moment.map_err(|_unread| said!("neither-number-nor-time", text))
    }
}

impl Engine {
    /// The store behind the map.
    ///
    /// # Errors
    /// The engine has none: it holds its map in memory.
    pub fn store(&self) -> Result<&Store, Error> {
        self.store.as_ref().ok_or_else(|| in_memory().into())
    }

    /// All revisions, the oldest first.
    ///
    /// # Errors
    /// The store cannot be read.
    pub fn revisions(&self) -> Result<Vec<Revision>, Error> {
        Ok(self.store()?.revisions()?)
    }

    /// The number of the revision that was in force.
    ///
    /// # Errors
    /// The store cannot be read.
    pub fn revision_of(&self, when: When) -> Result<u64, Error> {
        Ok(match when {
            When::Revision(number) => number,
            When::Moment(moment) => self.store()?.revision_at(moment)?,
        })
    }

    /// The same store and rules with the map as it stood then, in memory.
    ///
    /// # Errors
    /// There is no such revision, or there was no map yet.
    pub fn as_of(self, when: When) -> Result<Self, Error> {
        let revision = self.revision_of(when)?;
        let world = self.store()?.world_as_of(revision)?.ok_or(RequestError::BeforeTheMap)?;
        let then = State::new(None, Arc::clone(&self.state.rules), Some(world));
        let (state, spares) = (Arc::new(then), Spares::default());
        Ok(Self { store: None, state, waiting: self.waiting, spares, opened: self.opened })
    }

    /// What changed between two points of the history.
    ///
    /// # Errors
    /// There is no such revision.
    pub fn diff(&self, from: When, to: When) -> Result<Vec<Difference>, Error> {
        let (from, to) = (self.revision_of(from)?, self.revision_of(to)?);
        Ok(self.store()?.diff(from, to)?)
    }

    /// Takes back the last edit that still stands, or a certain one.
    ///
    /// # Errors
    /// There is nothing to undo, or later edits stand on it.
    pub fn undo(&mut self, revision: Option<u64>, change: &Change) -> Result<ImportReport, Error> {
        let store = self.writable()?;
        let report = match revision {
            Some(revision) => store.undo_revision(revision, change)?,
            None => store.undo(change)?,
        };
        self.reread()?;
        Ok(report)
    }

    /// Brings back what the last undo took.
    ///
    /// # Errors
    /// There is nothing to redo.
    pub fn redo(&mut self, change: &Change) -> Result<ImportReport, Error> {
        let report = self.writable()?.redo(change)?;
        self.reread()?;
        Ok(report)
    }

    /// Makes the map what it was then: a new edit, which can be undone as well.
    ///
    /// # Errors
    /// There is no such revision.
    pub fn return_to(&mut self, when: When, change: &Change) -> Result<ImportReport, Error> {
        let revision = self.revision_of(when)?;
        let report = self.writable()?.return_to(revision, change)?;
        self.reread()?;
        Ok(report)
    }

    /// Drops what only revisions before this one can see. Returns how many versions of records went.
    ///
    /// # Errors
    /// There is no such revision, or the disk refused.
    pub fn forget_before(&mut self, when: When, change: &Change) -> Result<Forgotten, Error> {
        let revision = self.revision_of(when)?;
        Ok(self.writable()?.forget_before(revision, change)?)
    }

    /// Takes the map over from the store, with what was derived from it.
    pub(super) fn reread(&mut self) -> Result<(), Error> {
        match self.store()?.world()? {
            Some(world) => self.follow(world),
            None => {
                let (state, store) = self.next_with_store();
                state.surveyed = None;
                state.changes = Arc::default();
                state.stand_on(store);
                Ok(())
            }
        }
    }
}

pub(super) fn in_memory() -> StoreError {
    StoreError::ReadOnly { reason: word!("the-map-is-held-in").into(), by_choice: true }
}

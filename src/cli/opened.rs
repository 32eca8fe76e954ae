//! The store and the rules that a command works on.

use std::path::{Path, PathBuf};

use crate::engine::{Engine, Error, Rules};

use super::args::Common;
use super::fault::Failure;
use super::notes::note_repairs;

pub(super) const DEFAULT_STORE: &str = "ortho-store";

/// The store in force: the one named, or `./ortho-store`.
pub(super) fn store_dir(common: &Common) -> PathBuf {
    common.store.clone().unwrap_or_else(|| PathBuf::from(DEFAULT_STORE))
}

pub(super) fn rules_dir(common: &Common) -> Option<PathBuf> {
    common.rules.clone().or_else(Rules::default_dir)
}

/// Opens a store that is there already, to be asked.
pub(super) fn open(common: &Common) -> Result<Engine, Failure> {
    opened(common, Engine::open_to_ask)
}

/// Opens a store that is there already, and keeps other programs from writing it meanwhile.
pub(super) fn open_held(common: &Common) -> Result<Engine, Failure> {
    opened(common, Engine::open_existing)
}

fn opened(
    common: &Common,
    open: impl FnOnce(&Path, Option<&Path>) -> Result<Engine, Error>,
) -> Result<Engine, Failure> {
    let (dir, rules) = (store_dir(common), rules_dir(common));
    let engine = match common.read_only {
        true => Engine::open_read_only(&dir, rules.as_deref())?,
        false => open(&dir, rules.as_deref())?,
    };
    seen(common, engine)
}

/// As it is to be seen: now, or as it stood.
fn seen(common: &Common, engine: Engine) -> Result<Engine, Failure> {
    note_repairs(&engine, common.lang);
    Ok(match common.as_of {
        Some(when) => engine.as_of(when)?,
        None => engine,
    })
}

/// Opens a store that is to be changed: as it is now.
pub(super) fn open_to_write(common: &Common) -> Result<Engine, Failure> {
    if common.as_of.is_some() {
        return Err(crate::engine::RequestError::PastIsPast.into());
    }
    open_held(common)
}

//! The store and the rules that a command works on.

use std::path::PathBuf;

use crate::engine::{Engine, Error, Rules};
use crate::store::StoreError;

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

/// Opens a store that is there already, to be asked. Where another program has it open, a server that lives for days, it
/// is read as it stands.
pub(super) fn open(common: &Common) -> Result<Engine, Failure> {
    let engine = match opened(common, common.read_only) {
        Err(Error::Store(StoreError::Locked { dir })) => {
            tracing::info!(dir, "another program has the store open: it is read only");
            opened(common, true)?
        }
        opened => opened?,
    };
    seen(common, engine)
}

/// Opens a store that is there already, and keeps other programs from writing it meanwhile.
pub(super) fn open_held(common: &Common) -> Result<Engine, Failure> {
    seen(common, opened(common, common.read_only)?)
}

fn opened(common: &Common, is_read_only: bool) -> Result<Engine, Error> {
    let (dir, rules) = (store_dir(common), rules_dir(common));
    match is_read_only {
        true => Engine::open_read_only(&dir, rules.as_deref()),
        false => Engine::open_existing(&dir, rules.as_deref()),
    }
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

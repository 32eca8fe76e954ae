//! The store as its callers see it: import, history, durability, refusals.

mod history;
mod in_turn;
mod losses;
mod past;
mod readers;
mod records;
mod recovery;
mod robot;

use std::path::Path;

use orthoframe_map::World;
use orthoframe_store::{Change, Store, Timestamp};

fn change(reason: &str) -> Change {
    Change::new("Мастер", Timestamp(1_790_000_000_000), reason)
}

fn scratch() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary directory")
}

fn open(dir: &Path) -> Store {
    Store::open(dir).expect("the store opens").0
}

fn load(store: &Store) -> World {
    store.world().expect("the map is whole").expect("there is a map")
}

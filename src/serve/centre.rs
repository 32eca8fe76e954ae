//! The map of a centre of many robots (`docs/fleet.md`), taken by the program that holds the robot's store.
//!
//! This program does not know the centre. What carries the map over (`ortho-fleet pull`) runs on the same machine, finds the
//! store held, and a file beside it that says where its holder listens, with a token; who may read the store may read that.
//!
//! **Invariant.** The map is taken where the store still is at the revision that it was compared with, and not from under a
//! robot that drives.

use std::io::Write as _;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use axum::Extension;
use axum::body::Bytes;
use axum::extract::State as Of;
use axum::http::StatusCode;
use serde::{Deserialize, Serialize};

use crate::engine::{change_now, json as views};
use crate::store::Sheet;
use crate::store::shipping::unpack_rows;
use crate::units::said;

use super::act::{self, Answer};
use super::fault::Fault;
use super::gate::{self, Gate, Role, Session};
use super::{House, beside};

/// Where it is brought.
pub(super) const CENTRE: &str = "/centre/map";
/// Bytes of such a map.
pub(super) const MAP: usize = 256 << 20;

/// Who holds a store, and how to speak to it.
#[derive(Serialize)]
struct Held {
    address: String,
    token: String,
}

/// The file beside the store, as long as this lives.
#[derive(Debug)]
pub(super) struct Note(PathBuf);

impl Note {
    /// Says where this server listens, to who may read the store. None where it cannot be said: then a map waits until the
    /// store is free.
    pub(super) fn leave(store: &Path, at: SocketAddr, gate: &Gate, user: &str) -> Option<Self> {
        let token = gate::random().ok()?;
        gate.trust(&token, Role::Edit, user);
        // Who listens everywhere listens here too.
        let here = match at.ip() {
            IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
            IpAddr::V6(ip) if ip.is_unspecified() => Ipv6Addr::LOCALHOST.into(),
            ip => ip,
        };
        let held = Held { address: format!("http://{}", SocketAddr::new(here, at.port())), token };
        let note = Self(beside(store, ".held"));
        let text = serde_json::to_vec(&held).expect("two texts");
        match secretly(&note.0, &text) {
            Ok(()) => Some(note),
            Err(error) => {
                tracing::warn!(%error, "a centre's map will wait until the store is free");
                None
            }
        }
    }
}

impl Drop for Note {
    fn drop(&mut self) {
        // Left behind, it names a server that answers no more.
        let _ = std::fs::remove_file(&self.0);
    }
}

/// Writes a file that was never anybody else's to read.
fn secretly(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    // One that a killed program left.
    let _ = std::fs::remove_file(path);
    let mut options = std::fs::OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path)?.write_all(bytes)
}

/// What stands before the records, as a line of JSON.
#[derive(Debug, Deserialize)]
struct Handed {
    /// The revision of the store that the map was compared with.
    on: u64,
    author: String,
    reason: String,
}

/// The records of a map; none when the bytes are anything else.
fn sheet_of(rows: &[u8]) -> Option<Sheet> {
    let mut sheet = Sheet::default();
    for (table, row) in unpack_rows(rows)? {
        sheet.add(table, row).ok()?;
    }
    // What refers to nothing is no map.
    let is_map = sheet.world().ok()?.is_some();
    is_map.then_some(sheet)
}

/// Takes the map.
pub(super) async fn take(
    Of(house): Of<Arc<House>>,
    Extension(session): Extension<Session>,
    body: Bytes,
) -> Answer {
    if session.role < Role::Edit {
        return Err(Fault::of_role());
    }
    let unread = || {
        Fault::new(StatusCode::UNPROCESSABLE_ENTITY, "serve::handed", said!("this-is-no-map-of"))
    };
    let end = body.iter().position(|byte| *byte == b'\n').ok_or_else(unread)?;
    let Handed { on, author, reason } =
        serde_json::from_slice(&body[..end]).map_err(|_not_told| unread())?;
    if house.tasks.book().is_busy() {
        return Err(Fault::new(
            StatusCode::CONFLICT,
            "serve::driving",
            said!("the-robot-drives-it-takes"),
        ));
    }
    let sheet = sheet_of(&body[end + 1..]).ok_or_else(unread)?;
    let taken = act::write(&house, on, move |engine| {
        let report = engine.take_sheet(&sheet, &change_now(&author, &reason))?;
        Ok(views::changed("taken", &report))
    });
    let taken = taken.await?;
    house.events.tell("known", &views::known_changed(None));
    Ok(taken)
}

//! The program that holds a robot's store, as `ortho serve` does, and a map brought to it.
//!
//! It leaves a file beside the store, readable by whoever may read the store: where it listens on this machine, and a token.

use std::path::Path;
use std::time::Duration;

use serde::Deserialize;

use crate::error::{FleetError, Result};
use crate::store::Change;

/// A program that can be spoken to.
#[derive(Debug, Deserialize)]
pub(crate) struct Holder {
    address: String,
    token: String,
}

#[derive(Deserialize)]
struct Taken {
    revision: u64,
}

#[derive(Deserialize)]
struct Refused {
    message: String,
}

/// The file beside a store that tells of its holder: `ortho-store` → `ortho-store.held`.
const ENDING: &str = ".held";

/// A map is derived anew before the answer comes.
const PATIENCE: Duration = Duration::from_secs(150);

impl Holder {
    /// Who holds a store; none where that is not told. What an earlier program left behind is a holder that does not answer.
    pub(crate) fn of(store: &Path) -> Option<Self> {
        let mut name = store.as_os_str().to_owned();
        name.push(ENDING);
        serde_json::from_slice(&std::fs::read(name).ok()?).ok()
    }

    /// Has it make packed rows its map, where its store still is at the revision `on`; the new revision.
    ///
    /// # Errors
    /// [`FleetError::Held`]: it does not answer, or does not take the map now, and why.
    pub(crate) fn take(&self, on: u64, rows: &[u8], change: &Change) -> Result<u64> {
        let told = serde_json::json!({ "on": on, "author": change.user, "reason": change.reason });
        let mut body = told.to_string().into_bytes();
        body.push(b'\n');
        body.extend(rows);
        let held = |why: String| FleetError::Held { why: why.into() };
        let config = ureq::Agent::config_builder()
            .http_status_as_error(false)
            .timeout_connect(Some(Duration::from_secs(5)))
            .timeout_global(Some(PATIENCE));
        let agent: ureq::Agent = config.build().into();
        let request = agent.post(format!("{}/centre/map", self.address));
        let request = request.header("Authorization", format!("Bearer {}", self.token));
        let mut answer = request.send(&body[..]).map_err(|error| held(error.to_string()))?;
        let body = answer.body_mut().read_to_vec().map_err(|error| held(error.to_string()))?;
        if answer.status().is_success()
            && let Ok(Taken { revision }) = serde_json::from_slice(&body)
        {
            return Ok(revision);
        }
        let told = serde_json::from_slice(&body).map(|Refused { message }| message);
        Err(held(told.unwrap_or_else(|_| answer.status().to_string())))
    }
}

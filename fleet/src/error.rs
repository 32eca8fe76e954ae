//! What can go wrong between a robot and the centre.

use crate::store::StoreError;
use crate::units::{Bilingual, Fault};

/// See the module.
pub type Result<T, E = FleetError> = std::result::Result<T, E>;

/// A centre that cannot be reached or refuses, or a robot that it cannot believe.
#[derive(Debug, Fault)]
#[fault(fleet)]
#[non_exhaustive]
pub enum FleetError {
    /// The database refused or is gone.
    Database { what: Bilingual },

    /// No such key, or it was revoked.
    Key,

    /// The key is good, but not for this.
    Forbidden,

    /// Frames that do not follow what is here.
    Gap { have: i64, checksum: Option<u32>, came: u64 },

    /// The same number, other bytes.
    Diverged { sequence: u64 },

    /// Bytes that are no frames, or say nothing sensible.
    Content { what: Bilingual },

    /// The centre could not be reached, or did not answer as a centre does.
    Line { url: String, what: Bilingual },

    /// A plain connection beyond this machine.
    Plain { address: String },

    /// A plain connection to a database beyond this machine.
    PlainDatabase { host: String },

    /// A revision that was made on an older one.
    Moved { revision: i64 },

    /// There is no such thing at the centre.
    Unknown { what: Bilingual },

    /// Another program has the store open and does not take a map just now.
    Held { why: Bilingual },

    /// A file or a socket.
    Io { path: String, source: std::io::Error },

    /// The robot's store.
    #[fault(transparent)]
    Store(#[from] StoreError),
}

impl From<tokio_postgres::Error> for FleetError {
    fn from(error: tokio_postgres::Error) -> Self {
        // The client's own text of a server's refusal is "db error" and no more; and of a line's fault, that there is one.
        let told = || match std::error::Error::source(&error) {
            Some(cause) if !error.to_string().contains(&cause.to_string()) => {
                format!("{error}: {cause}")
            }
            _ => error.to_string(),
        };
        let what = error.as_db_error().map_or_else(told, |told| {
            let place = told.table().map_or_else(String::new, |t| format!(" ({t})"));
            format!("{}{place}", told.message())
        });
        Self::Database { what: what.into() }
    }
}

impl From<deadpool_postgres::PoolError> for FleetError {
    fn from(error: deadpool_postgres::PoolError) -> Self {
        match error {
            deadpool_postgres::PoolError::Backend(error) => error.into(),
            other => Self::Database { what: other.to_string().into() },
        }
    }
}

impl FleetError {
    /// What came cannot be used, and why.
    pub fn content(what: impl Into<Bilingual>) -> Self {
        Self::Content { what: what.into() }
    }

    /// There is no such thing at the centre.
    pub(crate) fn unknown(what: Bilingual) -> Self {
        Self::Unknown { what }
    }
}

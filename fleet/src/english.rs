//! The faults in English.

use crate::error::FleetError;
use crate::units::InEnglish;

impl InEnglish for FleetError {
    fn english(&self) -> String {
        match self {
            Self::Database { what } => format!("database: {what}"),
            Self::Key => "no such key".to_owned(),
            Self::Forbidden => "this key may not do that".to_owned(),
            Self::Gap { have, came, .. } => format!("frame {came} came after frame {have}"),
            Self::Diverged { sequence } => {
                format!("frame {sequence} is another here: the robot's store went another way")
            }
            Self::Content { what } => what.clone(),
            Self::Line { url, what } => format!("centre “{url}”: {what}"),
            Self::Plain { address } => {
                format!("without TLS the server listens to this machine only, not to {address}")
            }
            Self::PlainDatabase { host } => {
                format!("there is no connection without TLS to the database at {host}")
            }
            Self::Moved { revision } => {
                format!("the centre's map has changed meanwhile: it is at revision {revision}")
            }
            Self::Unknown { what } => format!("the centre does not have: {what}"),
            Self::Held { why } => format!("the centre's map will wait: {why}"),
            Self::Io { path, source } => format!("{path}: {source}"),
            Self::Store(error) => error.english(),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Database { .. } => "see that the server runs and the address is right",
            Self::Key => "get a key: ortho-fleet key",
            Self::Forbidden => "another kind of key is needed: ortho-fleet key",
            Self::Gap { .. } => "send the frames from the next one on",
            Self::Diverged { .. } => "send the whole store",
            Self::Line { .. } => "check the line and the address",
            Self::Plain { .. } => "give --cert and --tls-key, or listen to 127.0.0.1",
            Self::PlainDatabase { .. } => {
                "take sslmode=disable out of the address; a certificate of one's own: --db-authority"
            }
            Self::Moved { .. } => "look at the new revision and try again",
            Self::Held { .. } => {
                "try again later (push --pull does by itself), or close the program that holds the store"
            }
            Self::Store(error) => return error.english_help(),
            Self::Content { .. } | Self::Unknown { .. } | Self::Io { .. } => return None,
        };
        Some(help.to_owned())
    }
}

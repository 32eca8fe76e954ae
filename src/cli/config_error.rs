//! Why settings cannot be used.

use miette::SourceSpan;

use crate::units::{Bilingual, Fault, Source};

/// A file of settings that cannot be used.
#[derive(Debug, Fault)]
#[fault(config)]
#[non_exhaustive]
pub(crate) enum ConfigError {
    Unreadable {
        path: String,
        reason: Bilingual,
    },
    Syntax {
        what: String,
        #[source_code]
        text: Source,
        at: SourceSpan,
    },
}

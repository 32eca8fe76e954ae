//! Why settings cannot be used.

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use crate::units::{InEnglish, Source};

/// A file of settings that cannot be used.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub(super) enum ConfigError {
    #[error("«{path}» не читается: {reason}")]
    #[diagnostic(code(config::unreadable), help("проверьте путь и права доступа"))]
    Unreadable { path: String, reason: String },
    #[error("настройки: {what}")]
    #[diagnostic(
        code(config::syntax),
        help("бывают: language, store, rules, vehicle, user, color, units (docs/cli.md)")
    )]
    Syntax {
        what: String,
        #[source_code]
        text: Source,
        #[label("здесь")]
        at: SourceSpan,
    },
}

impl InEnglish for ConfigError {
    fn english(&self) -> String {
        match self {
            Self::Unreadable { path, reason } => format!("“{path}” cannot be read: {reason}"),
            Self::Syntax { what, .. } => format!("settings: {what}"),
        }
    }

    fn english_help(&self) -> Option<String> {
        Some(match self {
            Self::Unreadable { .. } => "check the path and the permissions".to_owned(),
            Self::Syntax { .. } => {
                "there are: language, store, rules, vehicle, user, color, units (docs/cli.md)"
                    .to_owned()
            }
        })
    }
}

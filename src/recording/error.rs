//! Why a recording cannot be written or read.

use miette::Diagnostic;
use thiserror::Error;

use crate::units::{Bilingual, InEnglish, Language};

/// See the head of this file.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum RecordingError {
    /// The disk refused.
    #[error("запись «{path}» не пишется: {reason}")]
    #[diagnostic(code(recording::unwritable), help("проверьте путь, права и место на диске"))]
    Unwritable { path: String, reason: String },
    /// The disk refused.
    #[error("запись «{path}» не читается: {reason}")]
    #[diagnostic(code(recording::unreadable), help("проверьте путь и права доступа"))]
    Unreadable { path: String, reason: Bilingual },
    /// Bytes of another kind.
    #[error("«{path}» – не MCAP")]
    #[diagnostic(code(recording::not_mcap), help("назовите файл, записанный с --record"))]
    NotMcap { path: String },
    /// An MCAP of which nothing of a mission is left.
    #[error("запись «{path}» оборвана или испорчена раньше, чем в ней что-то сказано")]
    #[diagnostic(code(recording::cut), help("назовите другую запись; из этой взять нечего"))]
    Cut { path: String },
    /// An MCAP of another program.
    #[error("в записи «{path}» нет ничего от миссии ortho")]
    #[diagnostic(code(recording::foreign), help("назовите файл, записанный с --record"))]
    Foreign { path: String },
}

impl InEnglish for RecordingError {
    fn english(&self) -> String {
        match self {
            Self::Unwritable { path, reason } => {
                format!("the recording “{path}” cannot be written: {reason}")
            }
            Self::Unreadable { path, reason } => {
                let reason = reason.say(Language::English);
                format!("the recording “{path}” cannot be read: {reason}")
            }
            Self::NotMcap { path } => format!("“{path}” is no MCAP"),
            Self::Cut { path } => {
                format!(
                    "the recording “{path}” is cut off or damaged before anything is told in it"
                )
            }
            Self::Foreign { path } => {
                format!("the recording “{path}” has nothing of an ortho mission")
            }
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Unwritable { .. } => "check the path, the rights and the room on the disk",
            Self::Unreadable { .. } => "check the path and the rights",
            Self::Cut { .. } => "name another recording; there is nothing to take from this one",
            Self::NotMcap { .. } | Self::Foreign { .. } => {
                "name a file that was written with --record"
            }
        };
        Some(help.to_owned())
    }
}

impl RecordingError {
    /// The input is at fault, not the program or the disk.
    #[must_use]
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Unwritable { .. })
    }
}

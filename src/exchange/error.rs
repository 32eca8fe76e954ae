//! Why a foreign file gives no [`Survey`](super::Survey).

use miette::SourceSpan;

use crate::units::{Bilingual, Source};

/// A foreign file that cannot be read. What can be mended or left out is no error but a [`Remark`](super::Remark).
#[derive(Debug, crate::units::Fault)]
#[fault(exchange)]
#[non_exhaustive]
pub enum ReadError {
    /// The file system refused.
    Unreadable { path: String, reason: Bilingual },

    /// More bytes than any building takes.
    TooLarge { bytes: u64, limit: u64 },

    /// Bytes that are no text.
    NotText { name: String, at: usize, byte: String },

    /// Files packed into one.
    Archive { name: String },

    /// A picture of a floor plan, of which nobody said how large it is.
    Picture { name: String },

    /// The text breaks the rules of its own format.
    Syntax {
        format: &'static str,
        what: Bilingual,
        #[source_code]
        text: Source,
        at: SourceSpan,
    },

    /// Bytes that break the rules of their format: a picture.
    Bytes { format: &'static str, what: Bilingual, at: usize },

    /// More parts than any building has.
    TooMany { format: &'static str, what: Bilingual, limit: usize },

    /// Things whose sizes stand in a second file, which is not there or is of other things.
    NoSizes { format: &'static str, what: Bilingual, count: usize },

    /// It reads well, but there is no building in it.
    NoBuilding { format: &'static str, what: Bilingual },
}

impl ReadError {
    /// [`ReadError::Syntax`] at a byte of a text.
    #[must_use]
    pub fn syntax(
        format: &'static str,
        what: impl Into<Bilingual>,
        text: &Source,
        at: usize,
    ) -> Self {
        let mut at = at.min(text.text().len());
        while !text.text().is_char_boundary(at) {
            at -= 1;
        }
        let len = text.text()[at..].chars().next().map_or(0, char::len_utf8);
        Self::Syntax { format, what: what.into(), text: text.clone(), at: (at, len).into() }
    }

    /// [`ReadError::Unreadable`] of what the file system said.
    pub fn unreadable(path: &std::path::Path) -> impl FnOnce(std::io::Error) -> Self + use<> {
        let path = path.display().to_string();
        move |e| Self::Unreadable { path, reason: e.to_string().into() }
    }
}

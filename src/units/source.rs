//! A named text whose faults are shown with line and character column.

use std::path::Path;
use std::sync::Arc;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

use super::Language;
use super::file::{FileFault, read_text};

/// A text that was read, with the name that a person knows it by. Cheap to clone.
///
/// miette counts columns in bytes; Cyrillic takes two a letter, so this type counts characters instead.
#[derive(Debug, Clone)]
pub struct Source {
    name: Arc<str>,
    text: Arc<str>,
}

/// A text that is no file, but what a person said or the program has built in: it is called by a word of each language.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OwnText {
    Order,
    Edit,
    Assumption,
    Measurements,
    Relations,
}

impl OwnText {
    const ALL: [Self; 5] =
        [Self::Order, Self::Edit, Self::Assumption, Self::Measurements, Self::Relations];

    /// The text of this name, in Russian, by which its faults know it.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|own| own.name(Language::Russian) == name)
    }
}

impl Source {
    /// A text that is no file.
    #[must_use]
    pub fn own(what: OwnText, text: impl AsRef<str>) -> Self {
        Self::new(what.name(Language::Russian), text)
    }

    #[must_use]
    pub fn new(name: impl AsRef<str>, text: impl AsRef<str>) -> Self {
        Self { name: name.as_ref().into(), text: text.as_ref().into() }
    }

    /// The text of a file of at most 64 MiB.
    ///
    /// # Errors
    /// [`FileFault`].
    pub fn read(path: &Path) -> Result<Self, FileFault> {
        Self::read_within(path, 64 << 20)
    }

    /// The text of a file of at most `limit` bytes.
    ///
    /// # Errors
    /// [`FileFault`].
    pub fn read_within(path: &Path, limit: u64) -> Result<Self, FileFault> {
        Ok(Self::new(path.to_string_lossy(), read_text(path, limit)?))
    }

    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Line and column of a byte offset, both from 1, the column in characters.
    #[must_use]
    pub fn position(&self, offset: usize) -> (usize, usize) {
        let offset = boundary(&self.text, offset);
        let before = &self.text[..offset];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
    }
}

/// The nearest place at or before `at` where a character begins.
fn boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Bytes of the text that are shown beside one fault.
const LONGEST_EXCERPT: usize = 4000;
/// Bytes of a line that is shown whole; of a longer one, what stands beside the fault.
const LONGEST_LINE: usize = 600;
const EXCERPT_MARGIN: usize = 200;

/// The text, for excerpts beside the faults. A line may be a whole file long: then only what is near is shown.
impl SourceCode for Source {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let inner = self.text.as_ref().read_span(span, lines_before, lines_after)?;
        let name = self.name.to_string();
        let fits = |line: &[u8]| line.len() <= LONGEST_LINE;
        if inner.data().len() <= LONGEST_EXCERPT && inner.data().split(|&b| b == b'\n').all(fits) {
            let (_, column) = self.position(inner.span().offset());
            let (line, data, place) = (inner.line(), inner.data(), *inner.span());
            // miette's own count begins with the text; by it excerpts far apart would seem to meet.
            let lines = String::from_utf8_lossy(data).lines().count();
            let contents =
                MietteSpanContents::new_named(name, data, place, line, column - 1, lines);
            return Ok(Box::new(contents));
        }
        let text = &self.text;
        let line_start = text[..span.offset()].rfind('\n').map_or(0, |at| at + 1);
        let start = boundary(text, span.offset().saturating_sub(EXCERPT_MARGIN)).max(line_start);
        let end = boundary(text, span.offset() + span.len().min(LONGEST_EXCERPT) + EXCERPT_MARGIN);
        let (line, column) = self.position(start);
        let lines = text[start..end].lines().count();
        let (data, place) = (&text.as_bytes()[start..end], (start, end - start).into());
        Ok(Box::new(MietteSpanContents::new_named(name, data, place, line - 1, column - 1, lines)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_file_on_one_line_no_more_is_shown_than_stands_beside_the_fault() {
        let text = format!("{}ошибка{}", "а, ".repeat(500), " я,".repeat(500));
        let source = Source::new("map.json", text.as_str());
        let at = text.find("ошибка").expect("it is there");
        let contents = source.read_span(&(at, "ошибка".len()).into(), 1, 1).unwrap();
        assert!(contents.data().len() < LONGEST_LINE);
        let shown = std::str::from_utf8(contents.data()).expect("whole characters");
        assert!(shown.contains("ошибка"));
        let left = shown[..shown.find("ошибка").unwrap_or(0)].chars().count();
        assert_eq!(contents.column() + left, 1500);
    }

    #[test]
    fn columns_count_characters() {
        let source = Source::new("правила", "факт\nдверь открыта");
        assert_eq!(source.position("факт\nдверь ".len()), (2, 7));
        assert_eq!(source.position(10_000), (2, 14));
        let contents = source.read_span(&("факт\nдверь ".len(), 2).into(), 0, 0).unwrap();
        assert_eq!((contents.line(), contents.column()), (1, 6));
    }

    #[test]
    fn an_excerpt_counts_its_own_lines() {
        let source = Source::new("правила", "факт\n".repeat(100));
        let contents = source.read_span(&("факт\n".len() * 50, 2).into(), 1, 1).unwrap();
        assert_eq!((contents.line(), contents.line_count()), (49, 3));
    }
}

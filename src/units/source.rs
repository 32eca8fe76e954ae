//! A named text whose faults are shown with line and character column.

use std::path::Path;
use std::sync::Arc;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

/// A text that was read, with the name that a person knows it by. Cheap to clone.
///
/// miette counts columns in bytes; Cyrillic takes two a letter, so this type counts characters instead.
#[derive(Debug, Clone)]
pub struct Source {
    name: Arc<str>,
    text: Arc<str>,
}

impl Source {
    #[must_use]
    pub fn new(name: impl AsRef<str>, text: impl AsRef<str>) -> Self {
        Self { name: name.as_ref().into(), text: text.as_ref().into() }
    }

    /// # Errors
    /// Whatever the file system says; `InvalidData` when the file is not UTF-8.
    pub fn read(path: &Path) -> std::io::Result<Self> {
        Ok(Self::new(path.to_string_lossy(), std::fs::read_to_string(path)?))
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
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let before = &self.text[..offset];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
    }
}

impl SourceCode for Source {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let inner = self.text.as_ref().read_span(span, lines_before, lines_after)?;
        let (_, column) = self.position(inner.span().offset());
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.to_string(),
            inner.data(),
            *inner.span(),
            inner.line(),
            column - 1,
            inner.line_count(),
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let source = Source::new("правила", "факт\nдверь открыта");
        assert_eq!(source.position("факт\nдверь ".len()), (2, 7));
        assert_eq!(source.position(10_000), (2, 14));
        let contents = source.read_span(&("факт\nдверь ".len(), 2).into(), 0, 0).unwrap();
        assert_eq!((contents.line(), contents.column()), (1, 6));
    }
}

//! The words of a line, with their places in the text.

use miette::SourceSpan;

/// A word of a log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Word<'a> {
    pub(crate) text: &'a str,
    /// In bytes from the beginning of the log.
    pub(crate) at: usize,
}

impl Word<'_> {
    /// As a number; also NaN and infinities.
    pub(crate) fn number(&self) -> Option<f64> {
        self.text.parse().ok()
    }

    /// As a number whose fraction may stand after a comma.
    pub(crate) fn number_with_comma(&self) -> Option<f64> {
        self.number().or_else(|| self.text.replacen(',', ".", 1).parse().ok())
    }

    pub(crate) fn span(&self) -> SourceSpan {
        (self.at, self.text.len()).into()
    }

    /// For a message: not longer than can be read.
    pub(crate) fn shown(&self) -> String {
        let mut shown: String = self.text.chars().take(40).collect();
        if shown.len() < self.text.len() {
            shown.push('…');
        }
        shown
    }
}

/// The words between white space of a line that begins at `at`.
pub(crate) fn words(line: &str, at: usize) -> impl Iterator<Item = Word<'_>> + Clone {
    let place = move |word: &str| word.as_ptr() as usize - line.as_ptr() as usize;
    line.split_ascii_whitespace().map(move |text| Word { text, at: at + place(text) })
}

/// The cells of a row that begins at `at`, without the white space around them.
pub(crate) fn cells(
    line: &str,
    at: usize,
    separator: char,
) -> impl Iterator<Item = Word<'_>> + Clone {
    let place = move |word: &str| word.as_ptr() as usize - line.as_ptr() as usize;
    line.split(separator).map(move |cell| {
        let text = cell.trim().trim_matches('"');
        Word { text, at: at + place(text) }
    })
}

/// Lines with their places and numbers from 1, without what ends them.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = (usize, usize, &str)> {
    let mut at = 0;
    text.split_inclusive('\n').enumerate().map(move |(index, line)| {
        let start = at;
        at += line.len();
        (index + 1, start, line.trim_end_matches(['\n', '\r']))
    })
}

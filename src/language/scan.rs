//! A line-oriented text of the language files, read from left to right: statements, names, marks, and what is expected
//! where something else stands.

use std::ops::Range;

use crate::units::Bilingual;

/// What is expected at a place, and is not there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    pub expected: Bilingual,
    pub at: Range<usize>,
}

/// Where statements stand: a line and those after it that begin with a blank. Empty lines and remarks are none.
#[must_use]
pub fn statements(text: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let range = at..at + line.len();
        at = range.end;
        let bare = line.trim();
        if bare.is_empty() || bare.starts_with("//") {
            continue;
        }
        match found.last_mut() {
            Some(last) if line.starts_with([' ', '\t']) => last.end = range.end,
            _ => found.push(range),
        }
    }
    found
}

/// A statement while it is read.
#[derive(Debug)]
pub struct Scanner<'t> {
    pub text: &'t str,
    pub at: usize,
    pub end: usize,
}

impl<'t> Scanner<'t> {
    #[must_use]
    pub fn of(text: &'t str, statement: &Range<usize>) -> Self {
        Self { text, at: statement.start, end: statement.end }
    }

    /// What is still to be read, without blanks and remarks before it.
    pub fn rest(&mut self) -> &'t str {
        loop {
            let rest = &self.text[self.at..self.end];
            let trimmed = rest.trim_start();
            self.at += rest.len() - trimmed.len();
            if !trimmed.starts_with("//") {
                return trimmed;
            }
            self.at += trimmed.find('\n').unwrap_or(trimmed.len());
        }
    }

    pub fn takes(&mut self, mark: &str) -> bool {
        let is_there = self.rest().starts_with(mark);
        if is_there {
            self.at += mark.len();
        }
        is_there
    }

    /// # Errors
    /// Always: what stands here is not what is expected.
    pub fn wants<T>(&mut self, expected: impl Into<Bilingual>) -> Result<T, Unread> {
        let rest = self.rest();
        let length = rest.chars().next().map_or(0, char::len_utf8);
        // What lacks at the end lacks behind the last word.
        let at = if length == 0 { self.text[..self.end].trim_end().len() } else { self.at };
        Err(Unread { expected: expected.into(), at: at..at + length })
    }

    /// # Errors
    /// The mark is not there.
    pub fn needs(&mut self, mark: &str, expected: impl Into<Bilingual>) -> Result<(), Unread> {
        if self.takes(mark) { Ok(()) } else { self.wants(expected) }
    }

    /// What the longest run of such letters is, with its place; none where there is no such letter.
    pub fn run(&mut self, is_of_it: impl Fn(char) -> bool) -> Option<(&'t str, Range<usize>)> {
        let rest = self.rest();
        let length = rest.find(|c| !is_of_it(c)).unwrap_or(rest.len());
        let at = self.at..self.at + length;
        self.at = at.end;
        (length > 0).then(|| (&rest[..length], at))
    }

    /// # Errors
    /// Something stands behind what was read.
    pub fn ends(&mut self) -> Result<(), Unread> {
        if self.rest().is_empty() {
            Ok(())
        } else {
            self.wants(("конец строки", "the end of the line"))
        }
    }
}

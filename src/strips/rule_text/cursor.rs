//! Going through the words of a rule file: what stands ahead, and how what does not fit is told.

use miette::SourceSpan;

use super::heading::{HEADINGS, Heading};
use super::{Parsed, Parser};
use crate::error::RuleError;
use crate::fault::RuleFault;
use crate::hint::perhaps;
use crate::syntax::Name;
use crate::token::TokenKind;
use crate::units::{Bilingual, Piece, name_key, nearest_name, said};

/// What stands before a colon.
pub(super) enum Ahead {
    Known(Heading, usize),
    Unknown(String),
}

impl<'a> Parser<'a> {
    pub(super) fn kind(&self) -> Option<TokenKind<'a>> {
        self.kind_after(0)
    }

    pub(super) fn kind_after(&self, count: usize) -> Option<TokenKind<'a>> {
        self.tokens.get(self.next + count).map(|token| token.kind)
    }

    pub(super) fn here(&self) -> SourceSpan {
        match self.tokens.get(self.next) {
            Some(token) => token.span(),
            None => (self.source.text().len(), 0).into(),
        }
    }

    pub(super) fn advance(&mut self) -> SourceSpan {
        let here = self.here();
        self.next += 1;
        here
    }

    pub(super) fn heading_ahead(&self) -> Option<Ahead> {
        let Some(TokenKind::Word(first)) = self.kind() else { return None };
        let (heading, length) = match (self.kind_after(1), self.kind_after(2)) {
            (Some(TokenKind::Colon), _) => (first.to_owned(), 2),
            (Some(TokenKind::Word(second)), Some(TokenKind::Colon)) => {
                // `ИМЯ Факты:` is a name and a heading, `Исходная позиция:` one heading.
                let both = format!("{first} {second}");
                if Heading::of(&name_key(&both)).is_none()
                    && Heading::of(&name_key(second)).is_some()
                {
                    return None;
                }
                (both, 3)
            }
            _ => return None,
        };
        Some(match Heading::of(&name_key(&heading)) {
            Some(known) => Ahead::Known(known, length),
            None => Ahead::Unknown(heading),
        })
    }

    /// Whether `(Предусловие:` or its like stands ahead.
    pub(super) fn opens_part(&self) -> bool {
        self.kind() == Some(TokenKind::Open)
            && matches!(self.kind_after(1), Some(TokenKind::Word(_)))
            && self.kind_after(2) == Some(TokenKind::Colon)
    }

    pub(super) fn name(&mut self, expected: Piece) -> Parsed<Name> {
        match self.kind() {
            Some(TokenKind::Word(_)) if self.heading_ahead().is_none() => Ok(self.take_name()),
            _ => Err(self.expected(expected)),
        }
    }

    /// The name under the cursor. The paper writes an underscore between a name and its bracket at
    /// times (`РОБОТ-НАХОДИТСЯ-В_(…)`, `ДВЕРЬ_ИЗ_В_ОТКРЫТА(…)`); it is no part of the name.
    pub(super) fn take_name(&mut self) -> Name {
        let token = self.tokens[self.next];
        self.next += 1;
        let text = match token.kind {
            TokenKind::Word(word) | TokenKind::Variable(word) => word,
            _ => &self.source.text()[token.start..token.end],
        };
        let trimmed = text.trim_end_matches('_');
        Name::new(if trimmed.is_empty() { text } else { trimmed }, self.source, token.span())
    }

    pub(super) fn expected(&self, expected: Piece) -> RuleFault {
        self.expected_at(expected, self.here())
    }

    pub(super) fn expected_at(&self, expected: Piece, at: SourceSpan) -> RuleFault {
        let found = match self.kind() {
            Some(TokenKind::Strange(signs)) => {
                let sign = excerpt(signs);
                return RuleFault::new(
                    self.source,
                    RuleError::UnexpectedCharacter { sign, at: self.here() },
                );
            }
            Some(_) => {
                let token = self.tokens[self.next];
                Bilingual::quoted(&excerpt(&self.source.text()[token.start..token.end]))
            }
            None => said!("the-end-of-the-file"),
        };
        RuleFault::new(self.source, RuleError::Syntax { expected: expected.into(), found, at })
    }

    pub(super) fn missing(&self, at: SourceSpan) -> RuleFault {
        RuleFault::new(self.source, RuleError::MissingParenthesis { at })
    }

    pub(super) fn unknown_heading(&mut self, heading: &str) -> RuleFault {
        let at = self.advance();
        let near = nearest_name(heading, HEADINGS.iter().map(|&(name, _)| name));
        let help = Some(match near {
            Some(near) => perhaps(near),
            None => said!("sections-action-facts-assumptions-initial-goal-preferably"),
        });
        RuleFault::new(
            self.source,
            RuleError::UnknownHeading { heading: excerpt(heading), help, at },
        )
    }

    /// On to the next place where a section or a part of an action may begin.
    pub(super) fn skip_to_heading(&mut self) {
        while self.next < self.tokens.len() {
            if self.opens_part() || matches!(self.heading_ahead(), Some(Ahead::Known(..))) {
                return;
            }
            self.next += 1;
        }
    }
}

/// A word short enough for a message.
fn excerpt(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut shown: String =
        text.chars().take(LONGEST).map(|c| if c.is_control() { '·' } else { c }).collect();
    if text.chars().nth(LONGEST).is_some() {
        shown.push('…');
    }
    shown
}

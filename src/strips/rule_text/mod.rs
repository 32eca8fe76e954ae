//! The paper's rule-file text (paper 1, section 8), in Russian or English keywords.
//!
//! ```text
//! file        := { section }
//! section     := "Действие:" name { ["("] part [")"] }
//!              | ("Факты:" | "Исходная позиция:" | "Предположения:" | "Целевая позиция:") { condition }
//!              | "Типы:" { name ["—" type {"," type}] }        | "Объекты:" { name ["—" type] }
//!              | "Предикаты:" { name "(" [type {"," type}] ")" }
//!              | ("По-русски:" | "По-английски:") { ["НЕ"] name ["(" [variable {"," variable}] ")"] "=" [second-name "="] "«" phrase "»" }
//!              | "Желательно:" { name [number] condition }
//!              | "Включить:" path | "Карта:" path
//! part        := "Параметры:" { [type] variable } | "Предусловие:" { condition }
//!              | "Эффект+:" { effect } | "Эффект-:" { effect } | "Стоимость:" number
//!              | "Длительность:" number | ("Всё-время:" | "Под-конец:") { condition }
//!              | ("Начало+:" | "Начало-:") { effect }
//!              | "Выводится:" atom ["ЕСЛИ" condition]
//! condition   := ["НЕ"] (atom | "(" condition {"," condition} {"ИЛИ" condition {"," condition}} ")")
//!              | ("ДЛЯ-ВСЕХ" | "СУЩЕСТВУЕТ") "(" { [type] variable } ")" condition
//!              | "ЕСЛИ" condition "ТО" condition | term ("=" | "≠") term
//! effect      := atom | ["ДЛЯ-ВСЕХ" "(" { [type] variable } ")"] ["ЕСЛИ" condition "ТО"] (atom | "(" { atom } ")")
//! atom        := name "(" [term {"," term}] ")"
//! ```
//!
//! The text is read to its end whatever is wrong with it, so that all faults are told at once.

mod compound;
mod cursor;
mod heading;

use cursor::Ahead;
use heading::Heading;

use miette::SourceSpan;

use crate::durative::Lasting;
use crate::error::RuleError;
use crate::fault::RuleFault;
use crate::syntax::{
    ActionText, Amount, Atom, Condition, CostTerm, Declaration, Document, Name, Parameter,
    PhraseText, PreferenceText, Signature, Term,
};
use crate::token::{Token, TokenKind, tokens};
use crate::units::{Language, Piece, Source, name_key, word};

/// Beyond this many faults a text is not a rule file, and nobody reads on.
const MAX_FAULTS: usize = 50;

/// One file, its includes named but not yet read.
#[derive(Debug, Default)]
pub(super) struct RuleText {
    pub(super) document: Document,
    pub(super) includes: Vec<Name>,
    pub(super) faults: Vec<RuleFault>,
}

pub(super) fn parse(source: &Source) -> RuleText {
    let tokens = tokens(source.text());
    let mut parser = Parser::new(source, &tokens);
    parser.file();
    parser.text
}

struct Parser<'a> {
    source: &'a Source,
    tokens: &'a [Token<'a>],
    next: usize,
    /// Brackets open around the condition that is being read.
    depth: usize,
    /// Of the action opened last, where it lasts.
    lasting: Option<Lasting>,
    text: RuleText,
}

type Parsed<T> = Result<T, RuleFault>;

impl<'a> Parser<'a> {
    fn new(source: &'a Source, tokens: &'a [Token<'a>]) -> Self {
        Self { source, tokens, next: 0, depth: 0, lasting: None, text: RuleText::default() }
    }

    fn file(&mut self) {
        while self.next < self.tokens.len() && self.text.faults.len() < MAX_FAULTS {
            self.depth = 0;
            if let Err(fault) = self.section() {
                self.text.faults.push(fault);
                self.skip_to_heading();
            }
        }
        self.end_action();
    }

    fn section(&mut self) -> Parsed<()> {
        if self.kind() == Some(TokenKind::Close) {
            let at = self.advance();
            let warning = RuleFault::new(self.source, RuleError::SurplusParenthesis { at });
            self.text.document.warnings.push(warning);
            return Ok(());
        }
        match self.heading_ahead() {
            Some(Ahead::Known(heading, length)) => {
                self.next += length;
                self.body(heading)
            }
            Some(Ahead::Unknown(heading)) => Err(self.unknown_heading(&heading)),
            None if self.kind() == Some(TokenKind::Open) => {
                let open = self.advance();
                match self.heading_ahead() {
                    Some(Ahead::Known(heading, _)) if heading.is_part_of_action() => {
                        self.next -= 1;
                        self.part()
                    }
                    Some(Ahead::Unknown(heading)) => Err(self.unknown_heading(&heading)),
                    _ => Err(self.expected_at(SECTION, open)),
                }
            }
            None => Err(self.expected(SECTION)),
        }
    }

    fn body(&mut self, heading: Heading) -> Parsed<()> {
        match heading {
            Heading::Action => self.action(),
            Heading::Initial | Heading::Facts => {
                let facts = self.conditions()?;
                self.text.document.facts.extend(facts);
                Ok(())
            }
            Heading::Assumptions => {
                let facts = self.conditions()?;
                self.text.document.assumptions.extend(facts);
                Ok(())
            }
            Heading::Goal => {
                let goal = self.conditions()?;
                self.text.document.goal.extend(goal);
                Ok(())
            }
            Heading::Wishes => self.wishes(),
            Heading::Types => {
                let types = self.declarations()?;
                self.text.document.types.get_or_insert_default().extend(types);
                Ok(())
            }
            Heading::Objects => {
                let objects = self.declarations()?;
                self.text.document.objects.extend(objects);
                Ok(())
            }
            Heading::Predicates => self.signatures(),
            Heading::Derived => self.derived(),
            Heading::Phrases(language) => self.phrases(language),
            Heading::Include => {
                let path = self.path()?;
                self.text.includes.push(path);
                Ok(())
            }
            Heading::Map => {
                self.text.document.map = Some(self.path()?);
                Ok(())
            }
            _ => {
                self.next -= 2;
                self.part()
            }
        }
    }

    fn action(&mut self) -> Parsed<()> {
        self.end_action();
        let name = self.name(word!("the-name-of-an-action"))?;
        self.text.document.actions.push(ActionText::new(name));
        Ok(())
    }

    /// One part of the action opened last, in brackets or bare.
    fn part(&mut self) -> Parsed<()> {
        let opened = (self.kind() == Some(TokenKind::Open)).then(|| self.advance());
        let here = self.here();
        let Some(Ahead::Known(heading, length)) = self.heading_ahead() else {
            return Err(self.expected(word!("parameters-precondition-effect-or-effect")));
        };
        self.next += length;
        if self.text.document.actions.is_empty() {
            return Err(self.expected_at(word!("action-name-before-its-parts"), here));
        }
        match heading {
            Heading::Parameters => {
                let parameters = self.parameters()?;
                self.last_action().parameters.extend(parameters);
            }
            Heading::Precondition => {
                let conditions = self.conditions()?;
                self.last_action().precondition.extend(conditions);
            }
            Heading::AddEffect => {
                let (atoms, conditional) = self.effects(true)?;
                self.last_action().add.extend(atoms);
                self.last_action().conditional.extend(conditional);
            }
            Heading::DelEffect => {
                let (atoms, conditional) = self.effects(false)?;
                self.last_action().del.extend(atoms);
                self.last_action().conditional.extend(conditional);
            }
            Heading::Throughout | Heading::AtEnd => {
                let later = self.conditions()?;
                self.lasting(here).later.extend(later);
            }
            Heading::StartAdd => {
                let (atoms, conditional) = self.effects(true)?;
                let start = &mut self.lasting(here).start;
                start.add.extend(atoms);
                start.conditional.extend(conditional);
            }
            Heading::StartDel => {
                let (atoms, conditional) = self.effects(false)?;
                let start = &mut self.lasting(here).start;
                start.del.extend(atoms);
                start.conditional.extend(conditional);
            }
            _ => {
                let cost = self.cost()?;
                if heading == Heading::Duration {
                    self.lasting(here);
                }
                self.last_action().cost.push(CostTerm::Number(cost));
            }
        }
        let Some(open) = opened else { return Ok(()) };
        match self.kind() {
            Some(TokenKind::Close) => {
                self.advance();
                Ok(())
            }
            None => Err(self.missing(open)),
            _ if self.heading_ahead().is_some() || self.opens_part() => Err(self.missing(open)),
            _ => Err(self.expected(word!("or-the-next-fact"))),
        }
    }

    fn last_action(&mut self) -> &mut ActionText {
        self.text.document.actions.last_mut().expect("a part is read after its action's name")
    }

    /// What the action opened last, which therefore lasts, does at its start and asks later.
    fn lasting(&mut self, at: SourceSpan) -> &mut Lasting {
        let action = self.text.document.actions.last();
        let action = action.expect("a part is read after its action's name");
        self.lasting.get_or_insert_with(|| Lasting::new(action, at))
    }

    /// The action opened last has no more parts.
    fn end_action(&mut self) {
        let RuleText { document, faults, .. } = &mut self.text;
        if let (Some(lasting), Some(action)) = (self.lasting.take(), document.actions.last_mut()) {
            lasting.into_one_piece(self.source, action, &mut document.warnings, faults);
        }
    }

    /// `свет 2.5 ПОМЕЩЕНИЕ-ОСВЕЩЕНО_(Комната-А)`: what is wanted where it can be had, and what it costs if not.
    fn wishes(&mut self) -> Parsed<()> {
        while matches!(self.kind(), Some(TokenKind::Word(_))) && self.heading_ahead().is_none() {
            let name = self.name(word!("the-name-of-a-preference"))?;
            let is_number = |word: &str| word.starts_with(|sign: char| sign.is_ascii_digit());
            let weight = match self.kind() {
                Some(TokenKind::Word(word)) if is_number(word) => self.cost()?,
                _ => Amount::ONE,
            };
            let condition = Condition::Any(vec![self.one()?]);
            let document = &mut self.text.document;
            document.violations.get_or_insert_default().push((name.clone(), weight));
            document.preferences.push(PreferenceText { name, condition });
        }
        Ok(())
    }

    pub(super) fn parameters(&mut self) -> Parsed<Vec<Parameter>> {
        let mut parameters = Vec::new();
        loop {
            match self.kind() {
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                Some(TokenKind::Word(_)) if self.heading_ahead().is_none() => {
                    let kind = self.name(word!("a-type"))?;
                    let Some(TokenKind::Variable(_)) = self.kind() else {
                        return Err(self.expected(word!("a-variable-such-as-x-after-the")));
                    };
                    parameters.push(Parameter { kinds: vec![kind], variable: self.take_name() });
                }
                Some(TokenKind::Variable(_)) => {
                    parameters.push(Parameter { kinds: Vec::new(), variable: self.take_name() });
                }
                _ => return Ok(parameters),
            }
        }
    }

    /// Conditions up to a closing bracket, a heading or the end.
    pub(super) fn conditions(&mut self) -> Parsed<Vec<Condition>> {
        let mut conditions = Vec::new();
        loop {
            match self.kind() {
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                Some(TokenKind::Word(_)) if self.heading_ahead().is_some() => {
                    return Ok(conditions);
                }
                Some(TokenKind::Word(word)) if is_or(word) || is_then(word) => {
                    return Ok(conditions);
                }
                Some(TokenKind::Open) if self.opens_part() => return Ok(conditions),
                Some(TokenKind::Open) => conditions.extend(self.group()?),
                Some(TokenKind::Word(_) | TokenKind::Variable(_) | TokenKind::Not) => {
                    conditions.push(self.condition()?);
                }
                None | Some(TokenKind::Close) => return Ok(conditions),
                _ => return Err(self.expected(PLAIN_FACT)),
            }
        }
    }

    pub(super) fn condition(&mut self) -> Parsed<Condition> {
        let negated = match self.kind() {
            Some(TokenKind::Not) => true,
            Some(TokenKind::Word(word)) => is_not(word),
            _ => false,
        };
        if negated {
            self.advance();
        }
        if let Some(compound) = self.compound()? {
            return Ok(if negated { compound.negated() } else { compound });
        }
        if matches!(self.kind(), Some(TokenKind::Word(_)))
            && self.kind_after(1) == Some(TokenKind::Open)
        {
            return Ok(Condition::Holds { atom: self.atom()?, negated });
        }
        let left = self.term()?;
        let differs = match self.kind() {
            Some(TokenKind::Equal) => false,
            Some(TokenKind::NotEqual) => true,
            _ if left.is_variable => return Err(self.expected(word!("or"))),
            _ => {
                return Err(self.expected(word!("after-the-name-of-the-predicate")));
            }
        };
        self.advance();
        let right = self.term()?;
        Ok(Condition::Equal { pair: Box::new((left, right)), negated: negated != differs })
    }

    pub(super) fn atom(&mut self) -> Parsed<Atom> {
        let predicate = self.name(word!("the-name-of-a-predicate"))?;
        let open = self.advance();
        let mut args = Vec::new();
        loop {
            match self.kind() {
                Some(TokenKind::Close) => {
                    self.advance();
                    return Ok(Atom { predicate, args });
                }
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                Some(TokenKind::Word(_) | TokenKind::Variable(_))
                    if self.heading_ahead().is_none() =>
                {
                    args.push(self.term()?);
                }
                None => return Err(self.missing(open)),
                _ if self.opens_part() || self.heading_ahead().is_some() => {
                    return Err(self.missing(open));
                }
                _ => return Err(self.expected(word!("or-2"))),
            }
        }
    }

    fn term(&mut self) -> Parsed<Term> {
        if !matches!(self.kind(), Some(TokenKind::Word(_) | TokenKind::Variable(_))) {
            return Err(self.expected(word!("an-objects-name-or-a-variable")));
        }
        let starts_typed = matches!(self.kind(), Some(TokenKind::Word(_)))
            && matches!(self.kind_after(1), Some(TokenKind::Word(_) | TokenKind::Variable(_)));
        let kind = starts_typed.then(|| self.take_name());
        let is_variable = matches!(self.kind(), Some(TokenKind::Variable(_)));
        Ok(Term { kind, name: self.take_name(), is_variable })
    }

    /// `коридор — помещение`, `Точка-К — место`; a name without a dash has no parent.
    fn declarations(&mut self) -> Parsed<Vec<Declaration>> {
        let mut declarations: Vec<Declaration> = Vec::new();
        let mut open_group = 0;
        loop {
            match self.kind() {
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                Some(TokenKind::Word(_)) if self.heading_ahead().is_none() => {
                    let name = self.take_name();
                    declarations.push(Declaration { name, kinds: Vec::new() });
                }
                Some(TokenKind::Dash) if open_group < declarations.len() => {
                    self.advance();
                    let kind = self.name(word!("the-name-of-a-type"))?;
                    // A type stands for all names before it in its line.
                    let mut next_start = kind.at.span.offset();
                    for declaration in declarations[open_group..].iter_mut().rev() {
                        let span = declaration.name.at.span;
                        let between = &self.source.text()[span.offset() + span.len()..next_start];
                        if between.contains('\n') {
                            break;
                        }
                        next_start = span.offset();
                        declaration.kinds.push(kind.clone());
                    }
                    open_group = declarations.len();
                }
                Some(TokenKind::Strange(_) | TokenKind::Dash | TokenKind::Variable(_)) => {
                    return Err(self.expected(word!("a-name")));
                }
                _ => return Ok(declarations),
            }
        }
    }

    /// Whoever declares predicates declares them all: a slip of the pen is then found.
    fn signatures(&mut self) -> Parsed<()> {
        self.text.document.predicates_closed = true;
        while matches!(self.kind(), Some(TokenKind::Word(_))) && self.heading_ahead().is_none() {
            let name = self.name(word!("the-name-of-a-predicate"))?;
            let Some(TokenKind::Open) = self.kind() else {
                return Err(self.expected(word!("opening-bracket")));
            };
            let open = self.advance();
            let mut args = Vec::new();
            loop {
                match self.kind() {
                    Some(TokenKind::Close) => break,
                    Some(TokenKind::Comma) => {
                        self.advance();
                    }
                    Some(TokenKind::Word(_)) if self.heading_ahead().is_none() => {
                        args.push(vec![self.take_name()]);
                        // The variable after the type only helps the reader.
                        if matches!(self.kind(), Some(TokenKind::Variable(_))) {
                            self.advance();
                        }
                    }
                    None => return Err(self.missing(open)),
                    _ => {
                        return Err(self.expected(word!("the-type-of-an-argument-or")));
                    }
                }
            }
            self.advance();
            self.text.document.predicates.push(Signature { name, args });
        }
        Ok(())
    }

    /// How names are said in a language; a type stands without brackets.
    fn phrases(&mut self, language: Language) -> Parsed<()> {
        while matches!(self.kind(), Some(TokenKind::Word(_))) && self.heading_ahead().is_none() {
            let negated = matches!(self.kind(), Some(TokenKind::Word(word)) if is_not(word))
                && matches!(self.kind_after(1), Some(TokenKind::Word(_)));
            if negated {
                self.advance();
            }
            let name = self.name(word!("the-name-of-a-predicate-an-action"))?;
            let parameters = (self.kind() == Some(TokenKind::Open))
                .then(|| self.variables_in_brackets())
                .transpose()?;
            if self.kind() != Some(TokenKind::Equal) {
                return Err(self.expected(word!("and-words-in-quotation-marks")));
            }
            self.advance();
            let named = !negated && self.kind_after(1) == Some(TokenKind::Equal);
            let second = named.then(|| self.name(word!("a-second-name"))).transpose()?;
            if second.is_some() {
                self.advance();
            }
            let phrase = self.name(word!("words-in-quotation-marks"))?;
            let text = PhraseText { language, negated, name, parameters, second, phrase };
            self.text.document.phrases.push(text);
        }
        Ok(())
    }

    fn variables_in_brackets(&mut self) -> Parsed<Vec<Name>> {
        let open = self.advance();
        let mut variables = Vec::new();
        loop {
            match self.kind() {
                Some(TokenKind::Close) => {
                    self.advance();
                    return Ok(variables);
                }
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                Some(TokenKind::Variable(_)) => variables.push(self.take_name()),
                None => return Err(self.missing(open)),
                _ => {
                    return Err(self.expected(word!("a-variable-such-as-x-or")));
                }
            }
        }
    }

    fn cost(&mut self) -> Parsed<Amount> {
        if let (Some(TokenKind::Dash), Some(TokenKind::Word(word))) =
            (self.kind(), self.kind_after(1))
        {
            let at = self.advance();
            self.advance();
            let text = format!("-{word}");
            return Err(RuleFault::new(self.source, RuleError::Cost { text, at }));
        }
        let Some(TokenKind::Word(word)) = self.kind() else {
            return Err(self.expected(word!("a-number")));
        };
        let at = self.advance();
        Amount::parse(word).ok_or_else(|| {
            RuleFault::new(self.source, RuleError::Cost { text: word.to_owned(), at })
        })
    }

    /// The rest of the line, whatever signs it holds.
    fn path(&mut self) -> Parsed<Name> {
        let colon_end = self.tokens[self.next - 1].end;
        let text = self.source.text();
        let line_end = text[colon_end..].find('\n').map_or(text.len(), |at| colon_end + at);
        let raw = &text[colon_end..line_end];
        let path = raw.split(';').next().unwrap_or(raw).trim().trim_matches(['"', '«', '»']);
        while self.tokens.get(self.next).is_some_and(|token| token.start < line_end) {
            self.next += 1;
        }
        if path.is_empty() {
            return Err(self.expected_at(word!("the-name-of-a-file"), (colon_end - 1, 1).into()));
        }
        let start = colon_end + raw.find(path).unwrap_or(0);
        Ok(Name::new(path, self.source, (start, path.len()).into()))
    }
}

const SECTION: Piece = word!("a-section-action-facts-and-so-on");

pub(super) const PLAIN_FACT: Piece = word!("a-fact-such-as-name-object");

fn is_or(word: &str) -> bool {
    matches!(name_key(word).as_str(), "или" | "or")
}

fn is_then(word: &str) -> bool {
    matches!(name_key(word).as_str(), "то" | "then")
}

fn is_if(word: &str) -> bool {
    matches!(name_key(word).as_str(), "если" | "if" | "when")
}

fn is_not(word: &str) -> bool {
    matches!(name_key(word).as_str(), "не" | "not")
}

/// The conditions that a text of its own consists of, such as facts given in an argument.
pub(super) fn conditions(source: &Source) -> Result<Vec<Condition>, RuleFault> {
    let tokens = tokens(source.text());
    let mut parser = Parser::new(source, &tokens);
    let conditions = parser.conditions()?;
    match parser.kind() {
        None => Ok(conditions),
        Some(_) => Err(parser.expected(PLAIN_FACT)),
    }
}

//! The paper's rule-file text (paper 1, section 8), in Russian or English keywords.
//!
//! ```text
//! file        := { section }
//! section     := "Действие:" name { ["("] part [")"] }
//!              | ("Факты:" | "Исходная позиция:" | "Предположения:" | "Целевая позиция:") { condition }
//!              | "Типы:" { name ["—" type {"," type}] }        | "Объекты:" { name ["—" type] }
//!              | "Предикаты:" { name "(" [type {"," type}] ")" }
//!              | ("По-русски:" | "По-английски:") { ["НЕ"] name ["(" [variable {"," variable}] ")"] "=" "«" phrase "»" }
//!              | "Включить:" path | "Карта:" path
//! part        := "Параметры:" { [type] variable } | "Предусловие:" { condition }
//!              | "Эффект+:" { atom } | "Эффект-:" { atom } | "Стоимость:" number
//! condition   := ["НЕ"] atom | term ("=" | "≠") term
//! atom        := name "(" [term {"," term}] ")"
//! ```
//!
//! The text is read to its end whatever is wrong with it, so that all faults are told at once.

use miette::SourceSpan;

use super::error::{RuleError, RuleFault};
use super::syntax::{
    ActionText, Atom, Condition, CostTerm, Declaration, Document, Name, Parameter, PhraseText,
    Signature, Term,
};
use super::token::{Token, TokenKind, tokens};
use crate::units::{Language, Source, name_key, nearest_name};

/// Beyond this many faults a text is not a rule file, and nobody reads on.
const MAX_FAULTS: usize = 50;
/// A cost beyond it would overflow the sum over a plan.
pub(super) const MAX_COST: u32 = 1_000_000;

/// One file, its includes named but not yet read.
#[derive(Debug, Default)]
pub(super) struct RuleText {
    pub(super) document: Document,
    pub(super) includes: Vec<Name>,
    pub(super) faults: Vec<RuleFault>,
}

pub(super) fn parse(source: &Source) -> RuleText {
    let tokens = tokens(source.text());
    let mut parser = Parser { source, tokens: &tokens, next: 0, text: RuleText::default() };
    parser.file();
    parser.text
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Heading {
    Action,
    Parameters,
    Precondition,
    AddEffect,
    DelEffect,
    Cost,
    Initial,
    Goal,
    Facts,
    Assumptions,
    Types,
    Predicates,
    Objects,
    Include,
    Map,
    Phrases(Language),
}

/// Every heading in both languages, as shown to people.
const HEADINGS: &[(&str, Heading)] = &[
    ("Действие", Heading::Action),
    ("Action", Heading::Action),
    ("Параметры", Heading::Parameters),
    ("Parameters", Heading::Parameters),
    ("Предусловие", Heading::Precondition),
    ("Precondition", Heading::Precondition),
    ("Эффект+", Heading::AddEffect),
    ("Effect+", Heading::AddEffect),
    ("Эффект-", Heading::DelEffect),
    ("Effect-", Heading::DelEffect),
    ("Стоимость", Heading::Cost),
    ("Cost", Heading::Cost),
    ("Исходная позиция", Heading::Initial),
    ("Initial", Heading::Initial),
    ("Initial position", Heading::Initial),
    ("Целевая позиция", Heading::Goal),
    ("Цель", Heading::Goal),
    ("Goal", Heading::Goal),
    ("Goal position", Heading::Goal),
    ("Факты", Heading::Facts),
    ("Facts", Heading::Facts),
    ("Предположения", Heading::Assumptions),
    ("Assumptions", Heading::Assumptions),
    ("Типы", Heading::Types),
    ("Types", Heading::Types),
    ("Предикаты", Heading::Predicates),
    ("Predicates", Heading::Predicates),
    ("Объекты", Heading::Objects),
    ("Objects", Heading::Objects),
    ("Константы", Heading::Objects),
    ("Constants", Heading::Objects),
    ("Включить", Heading::Include),
    ("Include", Heading::Include),
    ("Карта", Heading::Map),
    ("Map", Heading::Map),
    ("По-русски", Heading::Phrases(Language::Russian)),
    ("In Russian", Heading::Phrases(Language::Russian)),
    ("По-английски", Heading::Phrases(Language::English)),
    ("In English", Heading::Phrases(Language::English)),
];

impl Heading {
    fn of(key: &str) -> Option<Self> {
        HEADINGS.iter().find(|(name, _)| name_key(name) == key).map(|&(_, heading)| heading)
    }

    fn is_part_of_action(self) -> bool {
        matches!(
            self,
            Self::Parameters | Self::Precondition | Self::AddEffect | Self::DelEffect | Self::Cost
        )
    }
}

/// What stands before a colon.
enum Ahead {
    Known(Heading, usize),
    Unknown(String),
}

struct Parser<'a> {
    source: &'a Source,
    tokens: &'a [Token<'a>],
    next: usize,
    text: RuleText,
}

type Parsed<T> = Result<T, RuleFault>;

impl<'a> Parser<'a> {
    fn file(&mut self) {
        while self.next < self.tokens.len() && self.text.faults.len() < MAX_FAULTS {
            if let Err(fault) = self.section() {
                self.text.faults.push(fault);
                self.skip_to_heading();
            }
        }
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
                    _ => Err(self.expected_at("раздел: «Действие:», «Факты:» и так далее", open)),
                }
            }
            None => Err(self.expected("раздел: «Действие:», «Факты:» и так далее")),
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
        let name = self.name("имя действия")?;
        self.text.document.actions.push(ActionText {
            name,
            parameters: Vec::new(),
            precondition: Vec::new(),
            add: Vec::new(),
            del: Vec::new(),
            cost: Vec::new(),
        });
        Ok(())
    }

    /// One part of the action opened last, in brackets or bare.
    fn part(&mut self) -> Parsed<()> {
        let opened = (self.kind() == Some(TokenKind::Open)).then(|| self.advance());
        let here = self.here();
        let Some(Ahead::Known(heading, length)) = self.heading_ahead() else {
            return Err(self.expected("«Параметры:», «Предусловие:», «Эффект+:» или «Эффект-:»"));
        };
        self.next += length;
        if self.text.document.actions.is_empty() {
            return Err(self.expected_at("«Действие: имя» перед его частями", here));
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
                let atoms = self.atoms()?;
                self.last_action().add.extend(atoms);
            }
            Heading::DelEffect => {
                let atoms = self.atoms()?;
                self.last_action().del.extend(atoms);
            }
            _ => {
                let cost = self.cost()?;
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
            _ => Err(self.expected("«)» или следующий факт")),
        }
    }

    fn last_action(&mut self) -> &mut ActionText {
        self.text.document.actions.last_mut().expect("a part is read after its action's name")
    }

    fn parameters(&mut self) -> Parsed<Vec<Parameter>> {
        let mut parameters = Vec::new();
        loop {
            match self.kind() {
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                Some(TokenKind::Word(_)) if self.heading_ahead().is_none() => {
                    let kind = self.name("тип")?;
                    let Some(TokenKind::Variable(_)) = self.kind() else {
                        return Err(self.expected("переменная вида «?x» после типа"));
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
    fn conditions(&mut self) -> Parsed<Vec<Condition>> {
        let mut conditions = Vec::new();
        loop {
            match self.kind() {
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                Some(TokenKind::Word(_)) if self.heading_ahead().is_some() => {
                    return Ok(conditions);
                }
                Some(TokenKind::Word(_) | TokenKind::Variable(_) | TokenKind::Not) => {
                    conditions.push(self.condition()?);
                }
                None | Some(TokenKind::Close) => return Ok(conditions),
                Some(TokenKind::Open) if self.opens_part() => return Ok(conditions),
                _ => return Err(self.expected("факт вида «ИМЯ_(объект, …)»")),
            }
        }
    }

    fn condition(&mut self) -> Parsed<Condition> {
        let negated = match self.kind() {
            Some(TokenKind::Not) => true,
            Some(TokenKind::Word(word)) => {
                is_not(word) && self.kind_after(1) != Some(TokenKind::Open)
            }
            _ => false,
        };
        if negated {
            self.advance();
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
            _ if left.is_variable => return Err(self.expected("«=» или «≠»")),
            _ => return Err(self.expected("«(» после имени предиката")),
        };
        self.advance();
        let right = self.term()?;
        Ok(Condition::Equal { pair: Box::new((left, right)), negated: negated != differs })
    }

    /// Effects: plain atoms only.
    fn atoms(&mut self) -> Parsed<Vec<Atom>> {
        let at = self.here();
        self.conditions()?
            .into_iter()
            .map(|condition| match condition {
                Condition::Holds { atom, negated: false } => Ok(atom),
                Condition::Holds { atom, .. } => {
                    Err(atom.predicate.fault(|at| RuleError::Syntax {
                        expected: "факт без «НЕ»; то, что перестаёт быть верным, пишут в «Эффект-»"
                            .into(),
                        found: "отрицание".into(),
                        at,
                    }))
                }
                Condition::Equal { .. } => Err(self.expected_at("факт, а не сравнение", at)),
            })
            .collect()
    }

    fn atom(&mut self) -> Parsed<Atom> {
        let predicate = self.name("имя предиката")?;
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
                _ => return Err(self.expected("«,» или «)»")),
            }
        }
    }

    fn term(&mut self) -> Parsed<Term> {
        if !matches!(self.kind(), Some(TokenKind::Word(_) | TokenKind::Variable(_))) {
            return Err(self.expected("имя объекта или переменная"));
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
                    let kind = self.name("имя типа")?;
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
                    return Err(self.expected("имя"));
                }
                _ => return Ok(declarations),
            }
        }
    }

    /// Whoever declares predicates declares them all: a slip of the pen is then found.
    fn signatures(&mut self) -> Parsed<()> {
        self.text.document.predicates_closed = true;
        while matches!(self.kind(), Some(TokenKind::Word(_))) && self.heading_ahead().is_none() {
            let name = self.name("имя предиката")?;
            let Some(TokenKind::Open) = self.kind() else { return Err(self.expected("«(»")) };
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
                    _ => return Err(self.expected("тип аргумента или «)»")),
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
            let name = self.name("имя предиката, действия или типа")?;
            let parameters = (self.kind() == Some(TokenKind::Open))
                .then(|| self.variables_in_brackets())
                .transpose()?;
            if self.kind() != Some(TokenKind::Equal) {
                return Err(self.expected("«=» и слова в кавычках"));
            }
            self.advance();
            let phrase = self.name("слова в кавычках")?;
            let text = PhraseText { language, negated, name, parameters, phrase };
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
                _ => return Err(self.expected("переменная вида «?x» или «)»")),
            }
        }
    }

    fn cost(&mut self) -> Parsed<u32> {
        if let (Some(TokenKind::Dash), Some(TokenKind::Word(word))) =
            (self.kind(), self.kind_after(1))
        {
            let at = self.advance();
            self.advance();
            let text = format!("-{word}");
            return Err(RuleFault::new(self.source, RuleError::Cost { text, at }));
        }
        let Some(TokenKind::Word(word)) = self.kind() else {
            return Err(self.expected("число"));
        };
        let at = self.advance();
        word.parse().ok().filter(|&cost| cost <= MAX_COST).ok_or_else(|| {
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
            return Err(self.expected_at("имя файла", (colon_end - 1, 1).into()));
        }
        let start = colon_end + raw.find(path).unwrap_or(0);
        Ok(Name::new(path, self.source, (start, path.len()).into()))
    }

    // The words under the cursor.

    fn kind(&self) -> Option<TokenKind<'a>> {
        self.kind_after(0)
    }

    fn kind_after(&self, count: usize) -> Option<TokenKind<'a>> {
        self.tokens.get(self.next + count).map(|token| token.kind)
    }

    fn here(&self) -> SourceSpan {
        match self.tokens.get(self.next) {
            Some(token) => token.span(),
            None => (self.source.text().len(), 0).into(),
        }
    }

    fn advance(&mut self) -> SourceSpan {
        let here = self.here();
        self.next += 1;
        here
    }

    fn heading_ahead(&self) -> Option<Ahead> {
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
    fn opens_part(&self) -> bool {
        self.kind() == Some(TokenKind::Open)
            && matches!(self.kind_after(1), Some(TokenKind::Word(_)))
            && self.kind_after(2) == Some(TokenKind::Colon)
    }

    fn name(&mut self, expected: &str) -> Parsed<Name> {
        match self.kind() {
            Some(TokenKind::Word(_)) if self.heading_ahead().is_none() => Ok(self.take_name()),
            _ => Err(self.expected(expected)),
        }
    }

    /// The name under the cursor. The paper writes an underscore between a name and its bracket at
    /// times (`РОБОТ-НАХОДИТСЯ-В_(…)`, `ДВЕРЬ_ИЗ_В_ОТКРЫТА(…)`); it is no part of the name.
    fn take_name(&mut self) -> Name {
        let token = self.tokens[self.next];
        self.next += 1;
        let text = match token.kind {
            TokenKind::Word(word) | TokenKind::Variable(word) => word,
            _ => &self.source.text()[token.start..token.end],
        };
        let trimmed = text.trim_end_matches('_');
        Name::new(if trimmed.is_empty() { text } else { trimmed }, self.source, token.span())
    }

    // Faults, and the way on after one.

    fn expected(&self, expected: &str) -> RuleFault {
        self.expected_at(expected, self.here())
    }

    fn expected_at(&self, expected: &str, at: SourceSpan) -> RuleFault {
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
                format!("«{}»", excerpt(&self.source.text()[token.start..token.end]))
            }
            None => "конец файла".to_owned(),
        };
        RuleFault::new(self.source, RuleError::Syntax { expected: expected.to_owned(), found, at })
    }

    fn missing(&self, at: SourceSpan) -> RuleFault {
        RuleFault::new(self.source, RuleError::MissingParenthesis { at })
    }

    fn unknown_heading(&mut self, heading: &str) -> RuleFault {
        let at = self.advance();
        let near = nearest_name(heading, HEADINGS.iter().map(|&(name, _)| name));
        let help = Some(match near {
            Some(near) => format!("может быть, «{near}»?"),
            None => "разделы: Действие, Факты, Предположения, Исходная позиция, Целевая позиция, \
                     Типы, Предикаты, Объекты, Включить, Карта, По-английски"
                .to_owned(),
        });
        RuleFault::new(
            self.source,
            RuleError::UnknownHeading { heading: excerpt(heading), help, at },
        )
    }

    /// On to the next place where a section or a part of an action may begin.
    fn skip_to_heading(&mut self) {
        while self.next < self.tokens.len() {
            if self.opens_part() || matches!(self.heading_ahead(), Some(Ahead::Known(..))) {
                return;
            }
            self.next += 1;
        }
    }
}

fn is_not(word: &str) -> bool {
    matches!(name_key(word).as_str(), "не" | "not")
}

/// The conditions that a text of its own consists of, such as facts given in an argument.
pub(super) fn conditions(source: &Source) -> Result<Vec<Condition>, RuleFault> {
    let tokens = tokens(source.text());
    let mut parser = Parser { source, tokens: &tokens, next: 0, text: RuleText::default() };
    let conditions = parser.conditions()?;
    match parser.kind() {
        None => Ok(conditions),
        Some(_) => Err(parser.expected("факт вида «ИМЯ_(объект, …)»")),
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

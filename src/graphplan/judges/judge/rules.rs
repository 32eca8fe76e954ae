//! Rule files as the judge reads them: sections under headings of either language.

use super::{Action, Atom, Condition, Effect, Given, Typed};

#[derive(Debug, Clone, PartialEq, Eq)]
enum Token {
    Word(String),
    Variable(String),
    Sign(char),
}

/// What a heading opens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Section {
    Action,
    Parameters,
    Precondition,
    Adds,
    Deletes,
    Throughout,
    AtEnd,
    StartAdds,
    StartDeletes,
    /// A number: what an action costs, or how long it lasts.
    Cost,
    Wishes,
    Facts,
    Goal,
    Types,
    Objects,
    Derived,
    /// Says nothing that a plan is judged by.
    Words,
    /// A path up to the end of its line.
    Map,
    Unread,
}

const HEADINGS: [(&str, Section); 53] = [
    ("действие", Section::Action),
    ("action", Section::Action),
    ("параметры", Section::Parameters),
    ("parameters", Section::Parameters),
    ("предусловие", Section::Precondition),
    ("precondition", Section::Precondition),
    ("эффект+", Section::Adds),
    ("effect+", Section::Adds),
    ("эффект-", Section::Deletes),
    ("effect-", Section::Deletes),
    ("стоимость", Section::Cost),
    ("cost", Section::Cost),
    ("исходная позиция", Section::Facts),
    ("initial", Section::Facts),
    ("initial position", Section::Facts),
    ("факты", Section::Facts),
    ("facts", Section::Facts),
    ("предположения", Section::Facts),
    ("assumptions", Section::Facts),
    ("целевая позиция", Section::Goal),
    ("цель", Section::Goal),
    ("goal", Section::Goal),
    ("goal position", Section::Goal),
    ("типы", Section::Types),
    ("types", Section::Types),
    ("предикаты", Section::Words),
    ("predicates", Section::Words),
    ("выводится", Section::Derived),
    ("derived", Section::Derived),
    ("объекты", Section::Objects),
    ("objects", Section::Objects),
    ("константы", Section::Objects),
    ("constants", Section::Objects),
    ("по-русски", Section::Words),
    ("in russian", Section::Words),
    ("по-английски", Section::Words),
    ("in english", Section::Words),
    ("карта", Section::Map),
    ("map", Section::Map),
    ("включить", Section::Unread),
    ("include", Section::Unread),
    ("желательно", Section::Wishes),
    ("preferably", Section::Wishes),
    ("длительность", Section::Cost),
    ("duration", Section::Cost),
    ("все-время", Section::Throughout),
    ("throughout", Section::Throughout),
    ("под-конец", Section::AtEnd),
    ("at-end", Section::AtEnd),
    ("начало+", Section::StartAdds),
    ("start+", Section::StartAdds),
    ("начало-", Section::StartDeletes),
    ("start-", Section::StartDeletes),
];

type Read<T> = Result<T, String>;

struct Reader {
    /// With the number of its line.
    tokens: Vec<(Token, usize)>,
    next: usize,
    given: Given,
}

/// Words hold letters, digits and these; other names stand in quotation marks.
const IN_WORDS: &str = "_-+.'№\u{301}\u{306}\u{308}";

/// Names are the same whatever their case, and with or without the underscore before a bracket.
fn key(word: &str) -> String {
    let trimmed = word.trim_end_matches('_');
    (if trimmed.is_empty() { word } else { trimmed }).to_lowercase().replace('ё', "е")
}

fn tokens(text: &str) -> Vec<(Token, usize)> {
    let mut tokens = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let mut signs = line.chars().peekable();
        while let Some(sign) = signs.next() {
            let mut word = String::new();
            let token = match sign {
                ';' | '#' => break,
                '/' if signs.peek() == Some(&'/') => break,
                '«' | '"' => {
                    let end = if sign == '«' { '»' } else { '"' };
                    word.extend(signs.by_ref().take_while(|sign| *sign != end));
                    Token::Word(key(&word))
                }
                sign if sign == '?' || sign.is_alphanumeric() || sign == '_' => {
                    word.push(sign);
                    while let Some(sign) =
                        signs.next_if(|s| s.is_alphanumeric() || IN_WORDS.contains(*s))
                    {
                        word.push(sign);
                    }
                    if sign == '?' { Token::Variable(key(&word)) } else { Token::Word(key(&word)) }
                }
                '!' | '<'
                    if matches!((sign, signs.peek()), ('!', Some('=')) | ('<', Some('>'))) =>
                {
                    signs.next();
                    Token::Sign('≠')
                }
                '!' => Token::Sign('¬'),
                sign if sign.is_whitespace() => continue,
                sign => Token::Sign(sign),
            };
            tokens.push((token, number));
        }
    }
    tokens
}

/// Puts first names in the places of second ones: `ПЕРВОЕ_(?x) = SECOND = «words»`.
fn by_first_names(tokens: &mut [(Token, usize)]) {
    let mut first: Vec<(String, String)> = Vec::new();
    let sign = |at: usize, sign| tokens.get(at).is_some_and(|(t, _)| *t == Token::Sign(sign));
    for at in 1..tokens.len() {
        let Some((Token::Word(second), _)) = tokens.get(at + 1) else { continue };
        if !sign(at, '=') || !sign(at + 2, '=') {
            continue;
        }
        let mut of = at - 1;
        if sign(of, ')') {
            of = (0..of)
                .rev()
                .find(|back| sign(*back, '('))
                .map_or(0, |open| open.saturating_sub(1));
        }
        if let (Token::Word(name), _) = &tokens[of] {
            first.push((second.clone(), name.clone()));
        }
    }
    for (token, _) in tokens {
        if let Token::Word(word) = token
            && let Some((_, name)) = first.iter().find(|(second, _)| second == word)
        {
            word.clone_from(name);
        }
    }
}

impl Reader {
    fn token(&self, ahead: usize) -> Option<&Token> {
        self.tokens.get(self.next + ahead).map(|(token, _)| token)
    }

    fn is_sign(&self, ahead: usize, sign: char) -> bool {
        self.token(ahead) == Some(&Token::Sign(sign))
    }

    fn word(&self, ahead: usize) -> Option<&str> {
        match self.token(ahead) {
            Some(Token::Word(word)) => Some(word),
            _ => None,
        }
    }

    fn is_word(&self, words: &[&str]) -> bool {
        self.word(0).is_some_and(|word| words.contains(&word))
    }

    fn skip(&mut self, sign: char) -> bool {
        let is_it = self.is_sign(0, sign);
        self.next += usize::from(is_it);
        is_it
    }

    fn wanted<T>(&self, what: &str) -> Read<T> {
        Err(format!("{what} is wanted in line {:?}", self.tokens.get(self.next)))
    }

    fn closed(&mut self) -> Read<()> {
        if self.skip(')') { Ok(()) } else { self.wanted("a closing bracket") }
    }

    fn name(&mut self) -> Read<String> {
        let Some(word) = self.word(0).map(str::to_owned) else { return self.wanted("a name") };
        self.next += 1;
        Ok(word)
    }

    /// The section that begins after so many tokens, and how many its heading takes.
    fn heading(&self, ahead: usize) -> Option<(Section, usize)> {
        let of = |name: &str| HEADINGS.iter().find(|(known, _)| *known == name).map(|(_, s)| *s);
        let first = self.word(ahead)?;
        if self.is_sign(ahead + 1, ':') {
            return of(first).map(|section| (section, 2));
        }
        let second = self.word(ahead + 1).filter(|_| self.is_sign(ahead + 2, ':'))?;
        of(&format!("{first} {second}")).map(|section| (section, 3))
    }

    fn opens_part(&self) -> bool {
        self.is_sign(0, '(') && self.word(1).is_some() && self.is_sign(2, ':')
    }

    fn file(&mut self) -> Read<()> {
        let mut action = None;
        while self.next < self.tokens.len() {
            let opened = self.opens_part() && self.skip('(');
            let Some((section, length)) = self.heading(0) else { return self.wanted("a heading") };
            self.next += length;
            self.section(section, &mut action)?;
            if opened {
                self.closed()?;
            }
        }
        Ok(())
    }

    fn section(&mut self, section: Section, action: &mut Option<String>) -> Read<()> {
        let all = || Condition::All(Vec::new());
        match section {
            Section::Action => {
                let name = self.name()?;
                self.given.actions.insert(name.clone(), Action::new(Vec::new()));
                *action = Some(name);
            }
            Section::Parameters => {
                let parameters = self.variables()?;
                self.part(action)?.parameters.extend(parameters);
            }
            Section::Precondition | Section::Throughout | Section::AtEnd => {
                let more = Condition::All(self.conditions()?);
                let action = self.part(action)?;
                let place = match section {
                    Section::Throughout => &mut action.throughout,
                    Section::AtEnd => &mut action.end.precondition,
                    _ => &mut action.start.precondition,
                };
                *place = Condition::All(vec![place.clone(), more]);
            }
            Section::Adds | Section::Deletes | Section::StartAdds | Section::StartDeletes => {
                let (variables, atom) = (Vec::new(), Vec::new());
                let adds = matches!(section, Section::Adds | Section::StartAdds);
                let plain = Effect { variables, condition: all(), adds, atom };
                let mut effects = Vec::new();
                self.effects(&plain, &mut effects)?;
                let action = self.part(action)?;
                // An action that does not last ends as it starts.
                match section {
                    Section::Adds | Section::Deletes => action.end.effects.extend(effects),
                    _ => action.start.effects.extend(effects),
                }
            }
            Section::Cost => self.next += 1,
            Section::Wishes => {
                while self.word(0).is_some() && self.heading(0).is_none() {
                    let name = self.name()?;
                    // What failing it costs.
                    let is_number =
                        |word: &str| word.starts_with(|sign: char| sign.is_ascii_digit());
                    self.next += usize::from(self.word(0).is_some_and(is_number));
                    let wish = self.condition()?;
                    self.given.wishes.push((name, wish));
                    self.skip(',');
                }
            }
            Section::Facts => {
                for fact in self.conditions()? {
                    let Condition::Holds(atom) = fact else { return self.wanted("a plain fact") };
                    self.given.init.insert(atom);
                }
            }
            Section::Goal => {
                let goal = self.conditions()?;
                self.given.goal.extend(goal);
            }
            Section::Types => {
                let types = self.declarations()?;
                self.given.kinds.extend(types);
            }
            Section::Objects => {
                for (name, kinds) in self.declarations()? {
                    self.given.objects.entry(name).or_default().extend(kinds);
                }
            }
            Section::Derived => {
                let (mut variables, mut atom) = (Vec::new(), Vec::new());
                for (kind, word) in self.call(&mut atom)? {
                    variables.push((word, kind.into_iter().collect()));
                }
                if !self.is_word(&["если", "if", "when"]) {
                    return self.wanted("IF");
                }
                self.next += 1;
                let condition = self.one()?;
                self.given.derived.push((variables, atom, condition));
            }
            Section::Words => {
                while self.next < self.tokens.len()
                    && self.heading(0).is_none()
                    && !self.opens_part()
                {
                    self.next += 1;
                }
            }
            Section::Map => {
                let line = self.tokens[self.next - 1].1;
                while self.tokens.get(self.next).is_some_and(|(_, number)| *number == line) {
                    self.next += 1;
                }
            }
            Section::Unread => return self.wanted("something that this judge reads"),
        }
        Ok(())
    }

    fn part(&mut self, action: &Option<String>) -> Read<&mut Action> {
        let named = action.as_ref().and_then(|name| self.given.actions.get_mut(name));
        named.ok_or_else(|| "a part of no action".to_owned())
    }

    /// `тип ?x, ?y`
    fn variables(&mut self) -> Read<Typed> {
        let mut variables = Vec::new();
        loop {
            self.skip(',');
            let kind = match (self.token(0), self.token(1)) {
                (Some(Token::Word(kind)), Some(Token::Variable(_))) => Some(kind.clone()),
                _ => None,
            };
            self.next += usize::from(kind.is_some());
            let Some(Token::Variable(name)) = self.token(0).cloned() else { return Ok(variables) };
            self.next += 1;
            variables.push((name, kind.into_iter().collect()));
        }
    }

    fn variables_in_brackets(&mut self) -> Read<Typed> {
        if !self.skip('(') {
            return self.wanted("an opening bracket");
        }
        let variables = self.variables()?;
        self.closed()?;
        Ok(variables)
    }

    /// `a, b — type`: a type stands for the names before it in its line.
    fn declarations(&mut self) -> Read<Typed> {
        let mut all: Typed = Vec::new();
        let mut open: Vec<(usize, usize)> = Vec::new();
        loop {
            self.skip(',');
            if self.heading(0).is_some() || self.opens_part() {
                return Ok(all);
            }
            let line = self.tokens.get(self.next).map_or(0, |(_, line)| *line);
            if self.skip('—') || self.skip('–') || self.skip('-') {
                let kind = self.name()?;
                for (at, of) in open.drain(..) {
                    if of == line {
                        all[at].1.push(kind.clone());
                    }
                }
            } else if self.word(0).is_some() {
                open.push((all.len(), line));
                all.push((self.name()?, Vec::new()));
            } else {
                return Ok(all);
            }
        }
    }

    fn term(&mut self) -> Read<(Option<String>, String)> {
        let is_name =
            |token: Option<&Token>| matches!(token, Some(Token::Word(_) | Token::Variable(_)));
        let kind = self.word(0).filter(|_| is_name(self.token(1))).map(str::to_owned);
        self.next += usize::from(kind.is_some());
        let Some(Token::Word(word) | Token::Variable(word)) = self.token(0).cloned() else {
            return self.wanted("a name or a variable");
        };
        self.next += 1;
        if let Some(kind) = kind.clone().filter(|_| !word.starts_with('?')) {
            self.given.objects.entry(word.clone()).or_default().insert(kind);
        }
        Ok((kind, word))
    }

    /// A predicate with its terms, which are also returned with their types.
    fn call(&mut self, atom: &mut Atom) -> Read<Vec<(Option<String>, String)>> {
        atom.push(self.name()?);
        if !self.skip('(') {
            return self.wanted("an opening bracket");
        }
        let mut terms = Vec::new();
        while !self.skip(')') {
            if !self.skip(',') {
                let term = self.term()?;
                atom.push(term.1.clone());
                terms.push(term);
            }
        }
        Ok(terms)
    }

    fn conditions(&mut self) -> Read<Vec<Condition>> {
        let mut conditions = Vec::new();
        loop {
            let is_end = self.heading(0).is_some()
                || self.opens_part()
                || self.is_sign(0, ')')
                || self.next >= self.tokens.len()
                || self.is_word(&["или", "or", "то", "then"]);
            if is_end {
                return Ok(conditions);
            }
            if !self.skip(',') {
                conditions.push(self.condition()?);
            }
        }
    }

    /// `(A, B ИЛИ C)`
    fn group(&mut self) -> Read<Condition> {
        if !self.skip('(') {
            return self.wanted("an opening bracket");
        }
        let mut cases = vec![Condition::All(self.conditions()?)];
        while self.is_word(&["или", "or"]) {
            self.next += 1;
            cases.push(Condition::All(self.conditions()?));
        }
        self.closed()?;
        Ok(Condition::Any(cases))
    }

    fn one(&mut self) -> Read<Condition> {
        if self.is_sign(0, '(') { self.group() } else { self.condition() }
    }

    fn condition(&mut self) -> Read<Condition> {
        if self.is_word(&["не", "not"]) || self.is_sign(0, '¬') {
            self.next += 1;
            return Ok(Condition::Not(Box::new(self.condition()?)));
        }
        if self.is_sign(0, '(') {
            return self.group();
        }
        if self.is_sign(1, '(') {
            let (every, some) = (["для-всех", "forall"], ["существует", "exists"]);
            if self.is_word(&every) || self.is_word(&some) {
                let is_every = self.is_word(&every);
                self.next += 1;
                let (variables, inner) = (self.variables_in_brackets()?, Box::new(self.one()?));
                return Ok(match is_every {
                    true => Condition::Every(variables, inner),
                    false => Condition::Some(variables, inner),
                });
            }
            if self.is_word(&["если", "if", "when"]) {
                let unless = Condition::Not(Box::new(self.premise()?));
                return Ok(Condition::Any(vec![unless, self.one()?]));
            }
            let mut atom = Vec::new();
            self.call(&mut atom)?;
            return Ok(Condition::Holds(atom));
        }
        let left = self.term()?.1;
        let differs = self.is_sign(0, '≠');
        if !differs && !self.is_sign(0, '=') {
            return self.wanted("“=” or “≠”");
        }
        self.next += 1;
        let equal = Condition::Equal(left, self.term()?.1);
        Ok(if differs { Condition::Not(Box::new(equal)) } else { equal })
    }

    /// `ЕСЛИ (…) ТО`
    fn premise(&mut self) -> Read<Condition> {
        self.next += 1;
        let premise = self.one()?;
        if !self.is_word(&["то", "then"]) {
            return self.wanted("THEN");
        }
        self.next += 1;
        Ok(premise)
    }

    fn effects(&mut self, around: &Effect, into: &mut Vec<Effect>) -> Read<()> {
        loop {
            let is_end = self.heading(0).is_some()
                || self.opens_part()
                || self.is_sign(0, ')')
                || self.next >= self.tokens.len();
            if is_end {
                return Ok(());
            }
            if !self.skip(',') {
                self.effect(around, into)?;
            }
        }
    }

    fn effect(&mut self, around: &Effect, into: &mut Vec<Effect>) -> Read<()> {
        if self.skip('(') {
            self.effects(around, into)?;
            return self.closed();
        }
        if self.is_word(&["для-всех", "forall"]) && self.is_sign(1, '(') {
            self.next += 1;
            let mut variables = around.variables.clone();
            variables.extend(self.variables_in_brackets()?);
            return self.effect(&Effect { variables, ..around.clone() }, into);
        }
        if self.is_word(&["если", "if", "when"]) && self.is_sign(1, '(') {
            let condition = Condition::All(vec![around.condition.clone(), self.premise()?]);
            return self.effect(&Effect { condition, ..around.clone() }, into);
        }
        let mut atom = Vec::new();
        self.call(&mut atom)?;
        into.push(Effect { atom, ..around.clone() });
        Ok(())
    }
}

pub(super) fn read(text: &str) -> Read<Given> {
    let mut tokens = tokens(text);
    by_first_names(&mut tokens);
    let mut reader = Reader { tokens, next: 0, given: Given::new(key) };
    reader.file()?;
    Ok(reader.given)
}

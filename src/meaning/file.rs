//! A `.lang` file as statements, before anything in it is known to mean something.
//!
//! ```text
//! void   пожалуйста | будь добр                         skipped for nothing          loose: skipped at a cost, told
//! order  free                                           frames are bags of slots     fixed: sequences
//! say    yes "Да."                                      how an answer is told
//! reserved Not All                                      categories whose words no frame may have as its own
//! role   on(x: Thing, y: Thing) = ON_TOP_OF(x, y) | BORNE_BY(x, y)                   what runs, in the rules' language
//! role   left_of(x: Thing, y: Thing) = LEFT_OF(x, y) if sector(_, y, _, _, _)         and only of what has a front
//! Prep   <- на[loc] | сверху на[loc] = on               words of a category, with what they mean
//! NP     <- a:Adj n:NP {agree a n} = n & a              a phrase
//! same   что содержит X = что внутри X               another way to say something: `language::paraphrase::Paraphrases`
//! list(x & p) <- какие x:NP[nom] pos? p:PP* {cost 1}    a frame: what a clause asks
//! ```
//!
//! A statement is a line; lines that begin with a blank go on with it. Categories begin with a Latin capital, all other
//! bare names in a pattern are words of the language. `~слово` stands for all forms of the word.

use std::ops::Range;

use super::fault::{LangError, LangFault};
use super::features::Features;
use crate::language::scan::{Scanner, statements};
use crate::units::{Source, name_key};

/// A name with its place.
#[derive(Debug, Clone)]
pub(crate) struct Name {
    pub(crate) text: String,
    pub(crate) at: Range<usize>,
}

#[derive(Debug, Clone)]
pub(crate) enum Statement {
    Skip {
        loose: bool,
        words: Vec<Vec<Name>>,
    },
    Order {
        free: bool,
    },
    /// Categories whose words carry a meaning that no frame may swallow.
    Reserved(Vec<Name>),
    /// How an answer is told.
    Say {
        name: Name,
        text: String,
    },
    Role {
        name: Name,
        parameters: Vec<(Name, Vec<Name>)>,
        bodies: Vec<String>,
        /// What must hold for the role to be told of at all: of a round table no left side is.
        needs: Option<String>,
    },
    /// Another way to say something, or words of several such: where it stands.
    Paraphrase(Range<usize>),
    Rule(Rule),
}

/// Words of a category, a phrase or a frame.
#[derive(Debug, Clone)]
pub(crate) struct Rule {
    pub(crate) left: Left,
    pub(crate) patterns: Vec<Vec<Element>>,
    pub(crate) agree: Vec<Name>,
    pub(crate) cost: u32,
    pub(crate) meaning: Option<Expr>,
}

#[derive(Debug, Clone)]
pub(crate) enum Left {
    Category(Name),
    /// The meaning stands on the left.
    Form(Name),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Repeat {
    Once,
    Optional,
    Any,
    Some,
}

#[derive(Debug, Clone)]
pub(crate) struct Element {
    pub(crate) kind: ElementKind,
    pub(crate) repeat: Repeat,
}

#[derive(Debug, Clone)]
pub(crate) enum ElementKind {
    /// One of these runs of words.
    Words(Vec<Vec<Word>>),
    Part {
        variable: Option<Name>,
        category: Name,
        features: Features,
    },
}

#[derive(Debug, Clone)]
pub(crate) struct Word {
    pub(crate) name: Name,
    /// Any form of it.
    pub(crate) declines: bool,
    pub(crate) features: Features,
}

/// What a rule means, in terms of its variables.
#[derive(Debug, Clone)]
pub(crate) enum Expr {
    Name(Name),
    Call(Name, Vec<Self>),
    And(Vec<Self>),
    Number(u64),
}

/// The statements of a file that read well; the faults of the others.
pub(crate) fn read(source: &Source, faults: &mut Vec<LangFault>) -> Vec<Statement> {
    let mut found = Vec::new();
    for range in statements(source.text()) {
        let mut parser = Parser { scan: Scanner::of(source.text(), &range), depth: 0 };
        match parser.statement(&range) {
            Ok(statement) => found.push(statement),
            Err(error) => faults.push(LangFault { error, file: source.clone() }),
        }
    }
    found
}

struct Parser<'t> {
    scan: Scanner<'t>,
    /// Of calls within calls.
    depth: usize,
}

/// Calls within each other.
const MAX_DEPTH: usize = 64;

type Parsed<T> = Result<T, LangError>;

impl<'t> Parser<'t> {
    fn rest(&mut self) -> &'t str {
        self.scan.rest()
    }

    fn takes(&mut self, mark: &str) -> bool {
        self.scan.takes(mark)
    }

    fn wants<T>(&mut self, expected: (&'static str, &'static str)) -> Parsed<T> {
        Ok(self.scan.wants(expected)?)
    }

    fn needs(&mut self, mark: &str, expected: (&'static str, &'static str)) -> Parsed<()> {
        Ok(self.scan.needs(mark, expected)?)
    }

    /// Letters, digits, «_» and apostrophes.
    fn name(&mut self) -> Option<Name> {
        let is_of_name = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
        let (text, at) = self.scan.run(is_of_name)?;
        Some(Name { text: text.to_owned(), at })
    }

    fn named(&mut self, expected: (&'static str, &'static str)) -> Parsed<Name> {
        match self.name() {
            Some(name) => Ok(name),
            None => self.wants(expected),
        }
    }

    fn statement(&mut self, range: &Range<usize>) -> Parsed<Statement> {
        let first = self.named((
            "void, loose, order, role, same, ordered, set, категория или форма",
            "void, loose, order, role, same, ordered, set, a category or a form",
        ))?;
        let follows_blank = self.scan.text[self.scan.at..].starts_with([' ', '\t']);
        let is_rule = self.rest().starts_with(['<', '(']);
        let statement = match first.text.as_str() {
            "void" | "loose" => {
                let mut words = vec![self.run_of_names()?];
                while self.takes("|") {
                    words.push(self.run_of_names()?);
                }
                Statement::Skip { loose: first.text == "loose", words }
            }
            "order" => match self.named(("free или fixed", "free or fixed"))?.text.as_str() {
                "free" => Statement::Order { free: true },
                "fixed" => Statement::Order { free: false },
                _ => return self.wants(("free или fixed", "free or fixed")),
            },
            "reserved" => Statement::Reserved(self.run_of_names()?),
            "say" if !is_rule => {
                let name = self.named(("имя ответа", "the name of an answer"))?;
                self.needs("\"", ("текст в кавычках", "a text in quotation marks"))?;
                let Some(length) = self.scan.text[self.scan.at..self.scan.end].find('"') else {
                    return self.wants(("закрывающая кавычка", "a closing quotation mark"));
                };
                let text = self.scan.text[self.scan.at..self.scan.at + length].to_owned();
                self.scan.at += length + 1;
                Statement::Say { name, text }
            }
            "role" if !is_rule => self.role()?,
            "same" | "ordered" | "set" if follows_blank => {
                self.scan.at = self.scan.end;
                Statement::Paraphrase(range.clone())
            }
            _ => Statement::Rule(self.rule(first)?),
        };
        self.scan.ends()?;
        Ok(statement)
    }

    fn run_of_names(&mut self) -> Parsed<Vec<Name>> {
        let mut names = vec![self.named(("слово", "a word"))?];
        loop {
            if self.takes(",") {
                names.push(Name { text: ",".to_owned(), at: self.scan.at - 1..self.scan.at });
            } else if let Some(name) = self.name() {
                names.push(name);
            } else {
                return Ok(names);
            }
        }
    }

    fn role(&mut self) -> Parsed<Statement> {
        let name = self.named(("имя отношения", "the name of a relation"))?;
        let mut parameters = Vec::new();
        self.needs("(", ("«(»", "“(”"))?;
        loop {
            let variable = self.named(("имя аргумента", "the name of an argument"))?;
            self.needs(":", ("«:»", "“:”"))?;
            let mut types = vec![self.named(("тип", "a type"))?];
            while self.takes("|") {
                types.push(self.named(("тип", "a type"))?);
            }
            parameters.push((variable, types));
            if !self.takes(",") {
                break;
            }
        }
        self.needs(")", ("«)» или «,»", "“)” or “,”"))?;
        self.needs("=", ("«=»", "“=”"))?;
        let body = self.rest();
        let body = body.split("//").next().unwrap_or_default().trim();
        self.scan.at = self.scan.end;
        let (body, needs) = match body.split_once(" if ") {
            Some((body, needs)) => (body, Some(needs.trim().to_owned())),
            None => (body, None),
        };
        let bodies = body.split('|').map(|one| one.trim().to_owned()).collect();
        Ok(Statement::Role { name, parameters, bodies, needs })
    }

    fn rule(&mut self, first: Name) -> Parsed<Rule> {
        let is_category = first.text.starts_with(|c: char| c.is_ascii_uppercase());
        let (left, mut meaning) = match is_category {
            true => (Left::Category(first), None),
            false => {
                let name = first.clone();
                (Left::Form(name), Some(self.call(first)?))
            }
        };
        self.needs("<-", ("«<-»", "“<-”"))?;
        let mut patterns = vec![self.pattern()?];
        while self.takes("|") {
            patterns.push(self.pattern()?);
        }
        let (mut agree, mut cost) = (Vec::new(), 0);
        if self.takes("{") {
            loop {
                match self.named(("agree или cost", "agree or cost"))?.text.as_str() {
                    "agree" => {
                        while let Some(name) = self.name() {
                            agree.push(name);
                        }
                    }
                    "cost" => match self.named(("число", "a number"))?.text.parse() {
                        Ok(number) => cost = number,
                        Err(_) => return self.wants(("число", "a number")),
                    },
                    _ => return self.wants(("agree или cost", "agree or cost")),
                }
                if !self.takes(",") {
                    break;
                }
            }
            self.needs("}", ("«}»", "“}”"))?;
        }
        if is_category && self.takes("=") {
            meaning = Some(self.expression()?);
        }
        Ok(Rule { left, patterns, agree, cost, meaning })
    }

    fn pattern(&mut self) -> Parsed<Vec<Element>> {
        let mut elements: Vec<Element> = Vec::new();
        // Words that follow each other are one element.
        let mut is_run = false;
        loop {
            let rest = self.rest();
            if rest.is_empty() || rest.starts_with(['|', '{', '=', ')']) {
                break;
            }
            if self.takes("(") {
                let mut choices = vec![self.words()?];
                while self.takes("|") {
                    choices.push(self.words()?);
                }
                self.needs(")", ("«)» или «|»", "“)” or “|”"))?;
                let repeat = self.repeat();
                elements.push(Element { kind: ElementKind::Words(choices), repeat });
                is_run = false;
                continue;
            }
            let is_word = rest.starts_with(['~', ',', ':']) || {
                let ahead = self.scan.at;
                let name = self.named(("слово или категория", "a word or a category"))?;
                let named = self.rest().starts_with(':') && !self.rest().starts_with(": ");
                self.scan.at = ahead;
                !named && !name.text.starts_with(|c: char| c.is_ascii_uppercase())
            };
            if !is_word {
                elements.push(self.part()?);
                is_run = false;
                continue;
            }
            let word = self.word()?;
            let repeat = self.repeat();
            match elements.last_mut() {
                Some(Element { kind: ElementKind::Words(choices), .. })
                    if is_run && repeat == Repeat::Once =>
                {
                    choices[0].push(word);
                }
                _ => elements.push(Element { kind: ElementKind::Words(vec![vec![word]]), repeat }),
            }
            is_run = repeat == Repeat::Once;
        }
        if elements.is_empty() {
            self.wants(("слово или категория", "a word or a category"))
        } else {
            Ok(elements)
        }
    }

    fn words(&mut self) -> Parsed<Vec<Word>> {
        let mut words = vec![self.word()?];
        while !self.rest().starts_with([')', '|']) {
            words.push(self.word()?);
        }
        Ok(words)
    }

    fn word(&mut self) -> Parsed<Word> {
        for mark in [",", ":"] {
            if self.takes(mark) {
                let name = Name { text: mark.to_owned(), at: self.scan.at - 1..self.scan.at };
                return Ok(Word { name, declines: false, features: Features::ALL });
            }
        }
        let declines = self.takes("~");
        let mut name = self.named(("слово", "a word"))?;
        name.text = name_key(&name.text);
        let features = self.features()?;
        Ok(Word { name, declines, features })
    }

    fn part(&mut self) -> Parsed<Element> {
        let first = self.named(("категория", "a category"))?;
        let (variable, category) = match self.takes(":") {
            true => (Some(first), self.named(("категория", "a category"))?),
            false => (None, first),
        };
        let features = self.features()?;
        let repeat = self.repeat();
        Ok(Element { kind: ElementKind::Part { variable, category, features }, repeat })
    }

    fn repeat(&mut self) -> Repeat {
        let marks = [("?", Repeat::Optional), ("*", Repeat::Any), ("+", Repeat::Some)];
        let found = marks.into_iter().find(|(mark, _)| self.takes(mark));
        found.map_or(Repeat::Once, |(_, repeat)| repeat)
    }

    fn features(&mut self) -> Parsed<Features> {
        if !self.takes("[") {
            return Ok(Features::ALL);
        }
        let start = self.scan.at;
        let mut names = Vec::new();
        while let Some(name) = self.name() {
            names.push(name.text);
        }
        let found = Features::named(&names.iter().map(String::as_str).collect::<Vec<_>>());
        let at = (start, self.scan.at - start).into();
        self.needs("]", ("«]»", "“]”"))?;
        found.map_err(|name| LangError::Unknown {
            what: ("признак", "feature").into(),
            name,
            nearest: None,
            at,
        })
    }

    fn call(&mut self, name: Name) -> Parsed<Expr> {
        self.needs("(", ("«(»", "“(”"))?;
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return self.wants((
                "не больше 64 скобок друг в друге",
                "no more than 64 brackets within one another",
            ));
        }
        let mut arguments = Vec::new();
        while !self.takes(")") {
            arguments.push(self.expression()?);
            if !self.takes(",") && !self.rest().starts_with(')') {
                return self.wants(("«)» или «,»", "“)” or “,”"));
            }
        }
        self.depth -= 1;
        Ok(Expr::Call(name, arguments))
    }

    fn expression(&mut self) -> Parsed<Expr> {
        let mut parts = vec![self.atom()?];
        while self.takes("&") {
            parts.push(self.atom()?);
        }
        Ok(if parts.len() == 1 { parts.swap_remove(0) } else { Expr::And(parts) })
    }

    fn atom(&mut self) -> Parsed<Expr> {
        let name = self.named(("имя или число", "a name or a number"))?;
        if let Ok(number) = name.text.parse() {
            return Ok(Expr::Number(number));
        }
        if self.rest().starts_with('(') { self.call(name) } else { Ok(Expr::Name(name)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_are_read_and_faults_have_their_places() {
        let text = "void пожалуйста | будь добр\n// remark\n\nNP <- a:Adj n:NP {agree a n} = n & a\nrole on(x: Thing, y) = A\n\
                    list(x & p) <- (что | кто) стоит ли? x:NP[nom pl]\n    p:PP*   // goes on\nPrep <- на[вот] = on\n";
        let source = Source::new("a.lang", text);
        let mut faults = Vec::new();
        let found = read(&source, &mut faults);
        assert_eq!(found.len(), 3);
        let Statement::Rule(frame) = &found[2] else { panic!("{found:?}") };
        let repeats: Vec<Repeat> = frame.patterns[0].iter().map(|e| e.repeat).collect();
        use Repeat::{Any, Once, Optional};
        assert_eq!(repeats, [Once, Once, Optional, Once, Any]);
        let places: Vec<_> = faults.iter().map(LangFault::place).map(|(_, l, c)| (l, c)).collect();
        assert_eq!(places, [(5, 20), (8, 12)]);
    }
}

//! How facts and actions are said in words: a rule file may give phrases for its predicates, actions and types.
//!
//! What has no phrase is told as the rule file writes it, `ДВЕРЬ_ИЗ_В_ОТКРЫТА_(Дверь-ВZ, Комната-В, Комната-Z)`.

use std::collections::HashMap;
use std::fmt;

use super::task::{Fact, Operator};
use crate::units::{Language, name_key, told};

/// Text with places for arguments.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Phrase(pub(super) Vec<Part>);

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Part {
    Text(String),
    /// The number of an argument.
    Argument(usize),
}

/// The phrases of one language, by the keys of what they say.
#[derive(Debug, Clone, Default)]
pub(super) struct Vocabulary {
    /// A fact, or its negation.
    pub(super) facts: HashMap<(String, bool), Phrase>,
    pub(super) actions: HashMap<String, Phrase>,
    pub(super) kinds: HashMap<String, String>,
}

/// The phrases that rules give, in either language.
#[derive(Debug, Clone, Default)]
pub struct Phrases {
    pub(super) russian: Vocabulary,
    pub(super) english: Vocabulary,
}

impl Phrases {
    pub(super) fn of(&self, language: Language) -> &Vocabulary {
        language.pick(&self.russian, &self.english)
    }

    pub(super) fn of_mut(&mut self, language: Language) -> &mut Vocabulary {
        match language {
            Language::Russian => &mut self.russian,
            Language::English => &mut self.english,
        }
    }
}

/// A fact or an action that is told; some of its objects may be open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Said {
    pub name: String,
    pub args: Vec<SaidArgument>,
    pub negated: bool,
}

/// What stands in one place of a fact or an action.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SaidArgument {
    Object(String),
    /// Any object of one of these types; of any type where there are none.
    Any(Vec<String>),
}

/// In which language, by which phrases and with which names of objects something is told.
#[derive(Clone, Copy)]
pub struct Wording<'a> {
    pub language: Language,
    pub phrases: &'a Phrases,
    /// An object's name as it is called in the language.
    pub name: &'a dyn Fn(&str) -> String,
}

impl Wording<'_> {
    /// A fact as a clause: «Door VZ is open».
    #[must_use]
    pub fn fact(&self, fact: &Said) -> String {
        let facts = &self.phrases.of(self.language).facts;
        let key = name_key(&fact.name);
        if let Some(phrase) = facts.get(&(key.clone(), fact.negated)) {
            return self.filled(phrase, &fact.args);
        }
        match facts.get(&(key, !fact.negated)) {
            Some(phrase) => {
                let fact = self.filled(phrase, &fact.args);
                told!(self.language, "it-is-not-so-that", fact)
            }
            None => fact.written(self.language),
        }
    }

    /// An action with its objects, as an order: «open Door VZ».
    #[must_use]
    pub fn action(&self, action: &Said) -> String {
        self.phrase_of(action).unwrap_or_else(|| action.written(self.language))
    }

    /// An action by its phrase, else by its bare name.
    pub(super) fn kind_of_action(&self, action: &Said) -> String {
        self.phrase_of(action).unwrap_or_else(|| action.name.clone())
    }

    fn phrase_of(&self, action: &Said) -> Option<String> {
        let phrase = self.phrases.of(self.language).actions.get(&name_key(&action.name))?;
        Some(self.filled(phrase, &action.args))
    }

    fn filled(&self, Phrase(parts): &Phrase, args: &[SaidArgument]) -> String {
        let part = |part: &Part| match part {
            Part::Text(text) => text.clone(),
            Part::Argument(number) => args.get(*number).map_or_else(String::new, |a| self.one(a)),
        };
        parts.iter().map(part).collect()
    }

    fn one(&self, argument: &SaidArgument) -> String {
        let kinds = match argument {
            SaidArgument::Object(name) => return (self.name)(name),
            SaidArgument::Any(kinds) => kinds,
        };
        let words = &self.phrases.of(self.language).kinds;
        let told: Vec<String> = kinds
            .iter()
            .map(|kind| words.get(&name_key(kind)).cloned().unwrap_or_else(|| kind.clone()))
            .map(|kind| self.language.pick(kind.clone(), format!("{} {kind}", article(&kind))))
            .collect();
        match told.is_empty() {
            true => told!(self.language, "something"),
            false => told.join(&told!(self.language, "one-or-another")),
        }
    }
}

fn article(noun: &str) -> &'static str {
    if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}

impl Said {
    /// As a rule file writes it: `НЕ ЗАПЕРТА_(дверь ?)`.
    #[must_use]
    pub fn written(&self, language: Language) -> String {
        let not = if self.negated { language.pick("НЕ ", "NOT ") } else { "" };
        let or = language.pick(" или ", " or ");
        let argument = |argument: &SaidArgument| match argument {
            SaidArgument::Object(name) => name.clone(),
            SaidArgument::Any(kinds) if kinds.is_empty() => "?".to_owned(),
            SaidArgument::Any(kinds) => format!("{} ?", kinds.join(or)),
        };
        let args: Vec<String> = self.args.iter().map(argument).collect();
        format!("{not}{}_({})", self.name, args.join(", "))
    }
}

/// In Russian.
impl fmt::Display for Said {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written(Language::Russian))
    }
}

impl From<&Fact> for Said {
    fn from(fact: &Fact) -> Self {
        let args = fact.args.iter().map(|arg| SaidArgument::Object(arg.to_string())).collect();
        Self { name: fact.predicate.to_string(), args, negated: fact.negated }
    }
}

impl From<&Operator> for Said {
    fn from(operator: &Operator) -> Self {
        let args = operator.args.iter().map(|arg| SaidArgument::Object(arg.to_string())).collect();
        Self { name: operator.name.to_string(), args, negated: false }
    }
}

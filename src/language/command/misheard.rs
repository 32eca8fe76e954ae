//! Why a sentence is no command, and how that is told to the person in either language.

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use crate::question::Unanswered;
use crate::units::{Source, capitalized};
use crate::words::{Language, alternatives};

/// Why a sentence is no command. The sentence is kept, so that the word can be shown in it.
#[derive(Debug, Clone, Error, Diagnostic)]
pub enum Misheard {
    /// Nothing but blanks, marks or pictures.
    #[error("задание пусто")]
    #[diagnostic(code(language::empty), help("скажите, что сделать, например «Принеси лекарство»"))]
    Empty,
    /// Longer than any command.
    #[error("задание слишком длинно: {length} знаков")]
    #[diagnostic(code(language::too_long), help("разделите его на несколько"))]
    TooLong { length: usize },
    /// A word that no command has in this place.
    #[error("слово «{word}» непонятно")]
    #[diagnostic(code(language::not_understood), help("{hint}"))]
    NotUnderstood {
        word: String,
        hint: String,
        #[source_code]
        text: Source,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// What is not to be done: a command says what is.
    #[error("запретов я не запоминаю")]
    #[diagnostic(
        code(language::forbidden),
        help("без задания я ничего не делаю; скажите, что сделать")
    )]
    Forbidden {
        #[source_code]
        text: Source,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A command that lacks a part.
    #[error("не сказано, {question}")]
    #[diagnostic(code(language::incomplete), help("дополните задание"))]
    Incomplete {
        /// In Russian, in English.
        question: &'static str,
        english: &'static str,
        #[source_code]
        text: Source,
        #[label("к этому слову")]
        at: SourceSpan,
    },
    /// What is asked of robots often, and this one cannot do.
    #[error("этого я не умею: «{word}»")]
    #[diagnostic(code(language::unable), help("{}", ABLE[0]))]
    Unable {
        word: String,
        #[source_code]
        text: Source,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// What is to be done at a time, or for some time.
    #[error("за часами я не слежу: «{word}»")]
    #[diagnostic(code(language::timed), help("скажите, когда придёт время"))]
    Timed {
        word: String,
        #[source_code]
        text: Source,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A description that several things fit, told apart as an answer tells them.
    #[error("{}", .0.text)]
    #[diagnostic(code(language::ambiguous), help("скажите, что из этого имелось в виду"))]
    WhichOf(Box<Unanswered>),
    /// A description that nothing on the map fits.
    #[error("{}", .0.text)]
    #[diagnostic(code(language::none_such), help("назовите то, что на карте есть"))]
    NoneSuch(Box<Unanswered>),
    /// A reference that several things of the map answer to.
    #[error("«{reference}» – это {}?", alternatives(&guillemets(candidates), Language::Russian))]
    #[diagnostic(code(language::ambiguous), help("назовите одно из них полностью"))]
    Ambiguous {
        reference: String,
        /// Names as the map writes them; equal names stand as often as there are such things.
        candidates: Vec<String>,
        #[source_code]
        text: Source,
        #[label("может значить разное")]
        at: SourceSpan,
    },
    /// A name that the map does not have.
    #[error("на карте нет «{reference}»")]
    #[diagnostic(code(language::unknown_name), help("{}", offer(near, Language::Russian)))]
    UnknownName {
        reference: String,
        /// Names of the map that are like it, the nearest first.
        near: Vec<String>,
        #[source_code]
        text: Source,
        #[label("такого названия нет")]
        at: SourceSpan,
    },
}

/// What the robot can do, in Russian and in English.
const ABLE: [&str; 2] = [
    "я езжу, нахожу, беру и кладу вещи, открываю и запираю двери, включаю и выключаю приборы, прибираю и зову оператора",
    "I drive, find, take and put things, open and lock doors, switch devices, tidy up and call the operator",
];

impl Misheard {
    /// The answer to the person, in the language of the sentence.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        if let Self::WhichOf(unanswered) | Self::NoneSuch(unanswered) = self {
            return unanswered.text.clone();
        }
        if language == Language::Russian {
            let help = self.help().map(|help| help.to_string()).unwrap_or_default();
            return sentences(&self.to_string(), &help);
        }
        match self {
            Self::Empty => {
                "The command is empty. Say what to do, for example \"Bring the medicine\".".into()
            }
            Self::TooLong { length } => {
                format!("The command is too long: {length} characters. Split it.")
            }
            Self::NotUnderstood { word, .. } => format!("I do not understand the word \"{word}\"."),
            Self::Forbidden { .. } => {
                "I keep no prohibitions in mind. Without a command I do nothing; say what to do."
                    .into()
            }
            Self::Unable { word, .. } => {
                sentences(&format!("I cannot do that: \"{word}\""), ABLE[1])
            }
            Self::Timed { word, .. } => {
                format!("I keep no time: \"{word}\". Tell me when it has come.")
            }
            Self::WhichOf(unanswered) | Self::NoneSuch(unanswered) => unanswered.text.clone(),
            Self::Incomplete { english, .. } => format!("You did not say {english}."),
            Self::Ambiguous { reference, candidates, .. } => {
                format!(
                    "By \"{reference}\", do you mean {}?",
                    alternatives(&quoted(candidates), language)
                )
            }
            Self::UnknownName { reference, near, .. } => {
                sentences(&format!("The map has no \"{reference}\""), &offer(near, language))
            }
        }
    }
}

fn sentences(first: &str, second: &str) -> String {
    let mut text = String::new();
    for part in [first, second].into_iter().filter(|part| !part.is_empty()) {
        let blank = if text.is_empty() { "" } else { " " };
        let stop = if part.ends_with(['?', '.', '!']) { "" } else { "." };
        text.push_str(&format!("{blank}{}{stop}", capitalized(part)));
    }
    text
}

fn guillemets(names: &[String]) -> Vec<String> {
    names.iter().map(|name| format!("«{name}»")).collect()
}

fn quoted(names: &[String]) -> Vec<String> {
    names.iter().map(|name| format!("\"{name}\"")).collect()
}

/// Names in the language of the sentence; to who speaks Russian also those of a map that has no others.
fn offer(near: &[String], language: Language) -> String {
    let own: Vec<String> =
        near.iter().filter(|name| Language::of(name) == language).cloned().collect();
    let near = match (own.is_empty(), language) {
        (true, Language::Russian) => near,
        _ => &own[..],
    };
    match (near, language) {
        ([], Language::Russian) => "проверьте название".into(),
        ([], Language::English) => String::new(),
        (_, Language::Russian) => format!("есть {}", alternatives(&guillemets(near), language)),
        (_, Language::English) => format!("there is {}", alternatives(&quoted(near), language)),
    }
}

//! Why a sentence is no command, and how that is told to the person in either language.

use std::ops::Range;

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use super::without_marks;
use crate::question::{Doubt, Unanswered};
use crate::units::{InEnglish, OwnText, Source, capitalized};
use crate::words::{Language, alternatives, word_keys, word_ranges};

/// Why a sentence is no command. The sentence is kept, so that the word can be shown in it.
#[derive(Debug, Clone, Error, Diagnostic)]
#[non_exhaustive]
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
    /// Another is told to do it.
    #[error("«{name}» – это не я")]
    #[diagnostic(
        code(language::not_me),
        help("я отвечаю за одного робота; если задание для меня, повторите его без этого имени")
    )]
    NotMe {
        name: String,
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

/// What is asked where a command does not say whither something goes.
pub(super) const WHITHER: (&str, &str) = ("куда положить", "where to put it");

impl Misheard {
    /// "Come to me", where the person has not said where that is.
    #[must_use]
    pub fn person_unknown(order: &str) -> Self {
        let text = Source::own(OwnText::Order, order);
        let (question, english) = ("где вы", "where you are");
        Self::Incomplete { question, english, text, at: (0, order.len()).into() }
    }

    /// Whether all that is lacking is whither something goes.
    #[must_use]
    pub fn asks_whither(&self) -> bool {
        match self {
            Self::Incomplete { question, .. } => *question == WHITHER.0,
            Self::WhichOf(asked) => matches!(asked.doubt, Doubt::InOrOn { .. }),
            _ => false,
        }
    }

    /// The same in the words of who spoke: an order is put plainly before it is heard, and what was put in is not theirs.
    #[must_use]
    pub fn quoted_from(mut self, said: &str) -> Self {
        let (Self::NotUnderstood { word: shown, text, at, .. }
        | Self::Unable { word: shown, text, at }
        | Self::UnknownName { reference: shown, text, at, .. }
        | Self::Ambiguous { reference: shown, text, at, .. }) = &mut self
        else {
            return self;
        };
        *shown = without_marks(shown).into_owned();
        let own = own_words(shown, said);
        let told = said[own.clone()].to_owned();
        let is_other = word_keys(&told) != word_keys(shown);
        (*shown, *text) = (told, Source::own(OwnText::Order, said));
        *at = (own.start, own.len()).into();
        if let (Self::UnknownName { near, .. }, true) = (&mut self, is_other) {
            near.clear();
        }
        self
    }
}

/// Bytes of the longest run of some words that stands in a text; the whole text where none of them does.
fn own_words(shown: &str, said: &str) -> Range<usize> {
    let (words, keys, wanted) = (word_ranges(said), word_keys(said), word_keys(shown));
    let run = |at: usize, from: usize| {
        let pairs = keys[at..].iter().zip(&wanted[from..]);
        pairs.take_while(|(own, wanted)| own == wanted).count()
    };
    let runs = (0..keys.len()).flat_map(|at| (0..wanted.len()).map(move |from| (at, from)));
    let longest = runs.map(|(at, from)| (run(at, from), std::cmp::Reverse(at))).max();
    match longest {
        Some((length @ 1.., std::cmp::Reverse(at))) => words[at].start..words[at + length - 1].end,
        _ => 0..said.len(),
    }
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
        let (told, help) = match language {
            Language::Russian => (self.to_string(), self.help().map(|help| help.to_string())),
            Language::English => (self.english(), self.english_help()),
        };
        sentences(&told, &help.unwrap_or_default())
    }
}

impl InEnglish for Misheard {
    fn english(&self) -> String {
        let english = Language::English;
        match self {
            Self::Empty => "the command is empty".to_owned(),
            Self::TooLong { length } => format!("the command is too long: {length} characters"),
            Self::NotUnderstood { word, .. } => format!("I do not understand the word \"{word}\""),
            Self::Forbidden { .. } => "I keep no prohibitions in mind".to_owned(),
            Self::Unable { word, .. } => format!("I cannot do that: \"{word}\""),
            Self::Timed { word, .. } => format!("I keep no time: \"{word}\""),
            Self::NotMe { name, .. } => format!("I am not \"{name}\""),
            Self::WhichOf(unanswered) | Self::NoneSuch(unanswered) => unanswered.text.clone(),
            Self::Incomplete { english, .. } => format!("you did not say {english}"),
            Self::Ambiguous { reference, candidates, .. } => {
                let candidates = alternatives(&quoted(candidates), english);
                format!("by \"{reference}\", do you mean {candidates}?")
            }
            Self::UnknownName { reference, .. } => format!("the map has no \"{reference}\""),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Empty => "say what to do, for example \"Bring the medicine\"",
            Self::TooLong { .. } => "split it",
            Self::Forbidden { .. } => "without a command I do nothing; say what to do",
            Self::Unable { .. } => ABLE[1],
            Self::Timed { .. } => "tell me when it has come",
            Self::NotMe { .. } => {
                "I speak for one robot; if the order is meant for me, say it without that name"
            }
            Self::WhichOf(_) => "say which of these was meant",
            Self::NoneSuch(_) => "name what the map has",
            Self::UnknownName { near, .. } => {
                return Some(offer(near, Language::English)).filter(|offer| !offer.is_empty());
            }
            // The question says it all.
            Self::NotUnderstood { .. } | Self::Incomplete { .. } | Self::Ambiguous { .. } => {
                return None;
            }
        };
        Some(help.to_owned())
    }

    fn english_labels(&self) -> [&'static str; 2] {
        match self {
            Self::Incomplete { .. } => ["to this word", ""],
            Self::Ambiguous { .. } => ["this may mean several", ""],
            Self::UnknownName { .. } => ["there is no such name", ""],
            _ => ["here", ""],
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

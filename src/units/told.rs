//! What faults and other messages say: [`Messages`] of a crate in both languages, and the [`Fault`]s that are told by them.
//!
//! The words stand in `rules/messages/{ru,en}/<crate>.ftl`, in the notation of Project Fluent. A fault is data: its code names
//! its message (`strips::not_text` – `strips-not-text`), its fields are the message's arguments, the attribute `.help` is its
//! remedy, and the attributes named as its places say what stands there.
//!
//! # Invariants
//!
//! A file is read when the first of its messages is told. A message that is missing or broken tells its name and is no reason
//! to stop: a test of each crate (`messages!`) finds it before.

use std::borrow::Cow;
use std::fmt;
use std::sync::{Arc, LazyLock, OnceLock};

use fluent_bundle::concurrent::FluentBundle;
use fluent_bundle::{FluentArgs, FluentResource, FluentValue};
use miette::{LabeledSpan, Severity, SourceSpan};

use super::{Bilingual, Carried, Cm, InEnglish, Language, Lengths, Pose, Source, carried};

pub(super) mod check;

/// What all crates say alike.
static COMMON: [Carried; 2] =
    [carried!("../../rules/messages/ru/units.ftl"), carried!("../../rules/messages/en/units.ftl")];

/// What a message can ask: whether an argument that may be left out was given, a length and an area in the unit of the run, that
/// unit, a number without its fraction.
const FUNCTIONS: [&str; 5] = ["GIVEN", "LENGTH", "AREA", "UNIT", "ROUND"];

/// The messages of a crate, in both languages.
pub struct Messages {
    texts: &'static [[Carried; 2]],
    bundles: [OnceLock<FluentBundle<Arc<FluentResource>>>; 2],
}

impl Messages {
    #[must_use]
    pub const fn new(texts: &'static [[Carried; 2]]) -> Self {
        Self { texts, bundles: [const { OnceLock::new() }; 2] }
    }

    fn bundle(&self, language: Language) -> &FluentBundle<Arc<FluentResource>> {
        static ALIKE: LazyLock<[Arc<FluentResource>; 2]> =
            LazyLock::new(|| [0, 1].map(|i| Arc::new(read(COMMON[i].as_ref()))));
        let i = language.pick(0, 1);
        self.bundles[i].get_or_init(|| {
            let name = language.pick("ru", "en").parse().expect("these are names of languages");
            let mut bundle = FluentBundle::new_concurrent(vec![name]);
            // Marks around arguments would stand in every terminal and log; both languages run the same way.
            bundle.set_use_isolating(false);
            bundle.add_resource_overriding(Arc::clone(&ALIKE[i]));
            for text in self.texts {
                bundle.add_resource_overriding(Arc::new(read(text[i].as_ref())));
            }
            let given = bundle.add_function("GIVEN", |arguments, _| {
                let absent = matches!(arguments, [FluentValue::None | FluentValue::Error] | []);
                FluentValue::from(if absent { "no" } else { "yes" })
            });
            let length = bundle.add_function("LENGTH", move |arguments, named| {
                let places = named.get("places").and_then(number).unwrap_or_default();
                let told = |cm| Lengths::said().told(cm, places as usize, language);
                arguments.first().and_then(number).map(told).unwrap_or_default().into()
            });
            let area = bundle.add_function("AREA", move |arguments, _| {
                let told = |square_cm| Lengths::said().told_area(square_cm, 0, language);
                arguments.first().and_then(number).map(told).unwrap_or_default().into()
            });
            let unit =
                bundle.add_function("UNIT", move |_, _| Lengths::said().word(language).into());
            let round = bundle.add_function("ROUND", |arguments, _| {
                let told = |value| format!("{value:.0}");
                arguments.first().and_then(number).map(told).unwrap_or_default().into()
            });
            for added in [given, length, area, unit, round] {
                added.expect("no other function has this name");
            }
            bundle
        })
    }

    /// A message, or an attribute of one; nothing if there is none.
    fn find(
        &self,
        language: Language,
        message: &str,
        attribute: Option<&str>,
        arguments: &FluentArgs<'_>,
    ) -> Option<String> {
        let bundle = self.bundle(language);
        let message = bundle.get_message(message)?;
        let pattern = match attribute {
            Some(attribute) => message.get_attribute(attribute)?.value(),
            None => message.value()?,
        };
        let told = bundle.format_pattern(pattern, Some(arguments), &mut Vec::new());
        Some(told.into_owned())
    }

    /// What a message says of these arguments, in a language.
    #[must_use]
    pub fn tell(
        &self,
        language: Language,
        message: &str,
        arguments: &[(&'static str, &dyn Value)],
    ) -> String {
        let arguments = arguments.iter().filter_map(|(name, v)| Some((*name, v.told(language)?)));
        self.find(language, message, None, &arguments.collect()).unwrap_or_else(|| message.into())
    }

    /// The same in both; `said!` writes it shorter.
    #[must_use]
    pub fn both(
        &'static self,
        message: &'static str,
        arguments: &[(&'static str, &dyn Value)],
    ) -> Bilingual {
        if arguments.is_empty() {
            let [russian, english] = [Language::Russian, Language::English]
                .map(|language| self.plain(language, message));
            return Bilingual::new(russian, english);
        }
        Bilingual::both(|language| self.tell(language, message, arguments))
    }

    /// A message without arguments, as it stands in its file: a parser names what it missed much more often than anybody reads it.
    fn plain(&'static self, language: Language, message: &'static str) -> Cow<'static, str> {
        let bundle = self.bundle(language);
        let pattern = bundle.get_message(message).and_then(|message| message.value());
        let told = pattern.map(|pattern| bundle.format_pattern(pattern, None, &mut Vec::new()));
        told.unwrap_or(Cow::Borrowed(message))
    }
}

impl fmt::Debug for Messages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Messages").finish_non_exhaustive()
    }
}

fn number(value: &Argument<'_>) -> Option<f64> {
    match value {
        Argument::Number(number) => Some(number.value),
        _ => None,
    }
}

/// A message file as far as it can be read.
fn read(text: &str) -> FluentResource {
    FluentResource::try_new(text.to_owned()).unwrap_or_else(|(read, _)| read)
}

/// An argument of a message, as it stands in one language.
pub type Argument<'a> = FluentValue<'a>;

/// What a message can have as an argument.
pub trait Value {
    /// As a message of a language takes it.
    fn told(&self, language: Language) -> Option<Argument<'_>>;
}

macro_rules! values {
    ($($kind:ty: |$it:pat_param, $language:pat_param| $told:expr;)*) => {
        $(impl Value for $kind {
            fn told(&self, $language: Language) -> Option<Argument<'_>> {
                let $it = self;
                Some(FluentValue::from($told))
            }
        })*
    };
}

values! {
    str: |it, _| it;
    String: |it, _| it.as_str();
    char: |it, _| it.to_string();
    bool: |it, _| if *it { "yes" } else { "no" };
    u8: |it, _| *it;
    u32: |it, _| *it;
    u64: |it, _| *it;
    usize: |it, _| *it;
    f64: |it, _| *it;
    i32: |it, _| *it;
    std::sync::Arc<str>: |it, _| &**it;
    // It may be longer than what Fluent counts with.
    i64: |it, _| it.to_string();
    Cm: |it, language| it.say(language);
    Bilingual: |it, language| it.say(language);
    Piece: |it, language| it.say(language);
    (&'static str, &'static str): |it, language| language.pick(it.0, it.1);
    Pose: |it, _| {
        let [x, y] = [it.at.x, it.at.y].map(|at| Lengths::said().number(at, 0));
        format!("({x}; {y})")
    };
    std::path::PathBuf: |it, _| it.display().to_string();
    std::io::Error: |it, _| it.to_string();
}

impl<V: Value + ?Sized> Value for &V {
    fn told(&self, language: Language) -> Option<Argument<'_>> {
        (**self).told(language)
    }
}

impl<V: Value + ?Sized> Value for Box<V> {
    fn told(&self, language: Language) -> Option<Argument<'_>> {
        (**self).told(language)
    }
}

/// Names, within the quotation marks of the message.
impl Value for Vec<Bilingual> {
    fn told(&self, language: Language) -> Option<Argument<'_>> {
        let between = super::MESSAGES.tell(language, "between-names", &[]);
        let names: Vec<_> = self.iter().map(|name| name.say(language)).collect();
        Some(names.join(&between).into())
    }
}

impl<V: Value> Value for Option<V> {
    fn told(&self, language: Language) -> Option<Argument<'_>> {
        self.as_ref().map_or(Some(FluentValue::None), |it| it.told(language))
    }
}

/// A message without arguments, by its name: a word of a table, told where it is needed. `word!` makes one.
#[derive(Clone, Copy)]
pub struct Piece {
    messages: fn() -> &'static Messages,
    name: &'static str,
}

impl Piece {
    #[doc(hidden)]
    #[must_use]
    pub const fn new(messages: fn() -> &'static Messages, name: &'static str) -> Self {
        Self { messages, name }
    }

    #[must_use]
    pub fn say(self, language: Language) -> Cow<'static, str> {
        (self.messages)().plain(language, self.name)
    }
}

impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Piece {}

impl fmt::Debug for Piece {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl From<Piece> for Bilingual {
    fn from(piece: Piece) -> Self {
        (piece.messages)().both(piece.name, &[])
    }
}

/// One of the faults of an enum.
#[derive(Debug)]
pub struct Kind {
    /// Stable.
    pub code: &'static str,
    /// The name of its message.
    pub message: &'static str,
    pub warning: bool,
    /// Its arguments.
    pub fields: &'static [&'static str],
    /// The stretches of a text that it points at.
    pub places: &'static [&'static str],
}

/// A fault whose words stand in message files; `#[derive(Fault)]` makes one of an enum, with all that miette asks of it.
pub trait Fault: Listed {
    /// All that it can be.
    const KINDS: &'static [Kind];
    fn messages(&self) -> &'static Messages;
    /// Which of [`Self::KINDS`] it is; of a fault that tells another's words, none.
    fn kind(&self) -> Option<usize>;
    /// In the order of the kind's fields.
    fn values(&self) -> Vec<&dyn Value>;
    /// In the order of the kind's places.
    fn spans(&self) -> Vec<Option<SourceSpan>>;
    /// The fault whose words this one tells.
    fn inner(&self) -> Option<&dyn InEnglish>;

    /// A warning does not keep the rest from being used.
    fn is_warning(&self) -> bool {
        self.told_severity() == Some(Severity::Warning)
    }

    /// The first place that it points at.
    fn first_span(&self) -> Option<SourceSpan> {
        self.spans().into_iter().flatten().next()
    }

    #[doc(hidden)]
    fn found(&self, language: Language, attribute: Option<&str>) -> Option<String> {
        let kind = &Self::KINDS[self.kind()?];
        let values = self.values();
        let told = kind.fields.iter().zip(&values);
        let told = told.filter_map(|(name, value)| Some((*name, value.told(language)?)));
        self.messages().find(language, kind.message, attribute, &told.collect())
    }

    /// What is wrong.
    fn tell(&self, language: Language) -> String {
        match self.inner() {
            Some(inner) => match language {
                Language::Russian => inner.to_string(),
                Language::English => inner.english(),
            },
            None => self.found(language, None).unwrap_or_else(|| {
                self.kind().map(|kind| Self::KINDS[kind].message.to_owned()).unwrap_or_default()
            }),
        }
    }

    /// What can be done: the field `help`, of others the attribute `.help`.
    fn remedy(&self, language: Language) -> Option<String> {
        if let Some(inner) = self.inner() {
            return match language {
                Language::Russian => inner.help().map(|help| help.to_string()),
                Language::English => inner.english_help(),
            };
        }
        let fields = Self::KINDS[self.kind()?].fields;
        match fields.iter().position(|field| *field == "help") {
            Some(help) => match self.values()[help].told(language)? {
                FluentValue::String(help) => Some(help.into_owned()),
                _ => None,
            },
            None => self.found(language, Some("help")),
        }
    }

    /// What is said at a place.
    fn label(&self, nth: usize, language: Language) -> String {
        let place = self.kind().and_then(|kind| Self::KINDS[kind].places.get(nth));
        let own = place.and_then(|place| self.found(language, Some(place)));
        own.unwrap_or_else(|| here(nth, language))
    }

    #[doc(hidden)]
    fn told_code(&self) -> Option<Box<dyn fmt::Display + '_>> {
        match self.inner() {
            Some(inner) => inner.code(),
            None => Some(Box::new(Self::KINDS[self.kind()?].code)),
        }
    }

    #[doc(hidden)]
    fn told_severity(&self) -> Option<Severity> {
        match self.inner() {
            Some(inner) => inner.severity(),
            None => Self::KINDS[self.kind()?].warning.then_some(Severity::Warning),
        }
    }

    #[doc(hidden)]
    fn told_help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        Some(Box::new(self.remedy(Language::Russian)?))
    }

    #[doc(hidden)]
    fn told_labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        if let Some(inner) = self.inner() {
            return inner.labels();
        }
        if Self::KINDS[self.kind()?].places.is_empty() {
            return None;
        }
        let label = |(nth, span): (usize, Option<SourceSpan>)| {
            Some(LabeledSpan::new_with_span(Some(self.label(nth, Language::Russian)), span?))
        };
        Some(Box::new(self.spans().into_iter().enumerate().filter_map(label)))
    }
}

/// A title, and below it a line per fault: `файл:строка:столбец: что не так`.
#[must_use]
pub fn by_lines<F: Fault>(
    title: String,
    source: &Source,
    faults: &[F],
    language: Language,
) -> String {
    let line = |fault: &F| {
        let at = fault.first_span().map_or(0, |span| span.offset());
        let (line, column) = source.position(at);
        format!("\n{}:{line}:{column}: {}", source.name(), fault.tell(language))
    };
    faults.iter().map(line).fold(title, |told, line| told + &line)
}

/// A fault that `messages!` names, so that a test sees all its messages.
pub trait Listed {}

/// What is said at a place of which there is nothing to say: «здесь», and of further ones «и здесь».
#[must_use]
pub fn here(nth: usize, language: Language) -> String {
    let message = if nth == 0 { "here" } else { "and-here" };
    super::MESSAGES.tell(language, message, &[])
}

impl<F: Fault + miette::Diagnostic> InEnglish for F {
    fn english(&self) -> String {
        self.tell(Language::English)
    }
    fn english_help(&self) -> Option<String> {
        self.remedy(Language::English)
    }
    fn english_label(&self, nth: usize) -> String {
        match self.inner() {
            Some(inner) => inner.english_label(nth),
            None => self.label(nth, Language::English),
        }
    }
}

/// The messages of a crate: the way from its root to `rules/messages`, its files there, and its faults.
///
/// With them comes the test that both languages have every message that a fault or `said!` asks for, and, where no fault of
/// another feature is left out, no other.
#[macro_export]
macro_rules! messages {
    ($rules:literal, $($file:literal)|+ $(, $(#[$gate:meta])? $fault:ty)* $(,)?) => {
        pub(crate) static MESSAGES: $crate::Messages = {
            static TEXTS: [[$crate::Carried; 2]; [$($file),+].len()] = [$([
                $crate::carried!($rules "/ru/" $file ".ftl"),
                $crate::carried!($rules "/en/" $file ".ftl"),
            ]),+];
            $crate::Messages::new(&TEXTS)
        };
        $($(#[$gate])? impl $crate::Listed for $fault {})*
        #[cfg(test)]
        #[test]
        fn both_languages_have_every_message() {
            let kinds: &[&[$crate::Kind]] = &[$($(#[$gate])? <$fault as $crate::Fault>::KINDS),*];
            let all: &[&str] = &[$(stringify!($fault)),*];
            let is_whole = kinds.len() == all.len();
            assert_eq!($crate::amiss_in(&MESSAGES, kinds, is_whole, env!("CARGO_MANIFEST_DIR")), "");
        }
    };
}

/// A message of this crate in both languages, with its arguments: `said!("meant", name, count = names.len())`.
#[macro_export]
#[allow(clippy::crate_in_macro_def, reason = "the messages are those of the crate that tells them")]
macro_rules! said {
    (@ $name:ident) => { &$name as &dyn $crate::Value };
    (@ $name:ident = $value:expr) => { &$value as &dyn $crate::Value };
    ($message:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        crate::MESSAGES.both($message, &[$((stringify!($name), $crate::said!(@ $name $(= $value)?))),*])
    };
}

/// The same in one language: `told!(language, "meant", name)`.
#[macro_export]
#[allow(clippy::crate_in_macro_def, reason = "the messages are those of the crate that tells them")]
macro_rules! told {
    ($language:expr, $message:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        crate::MESSAGES.tell(
            $language,
            $message,
            &[$((stringify!($name), $crate::said!(@ $name $(= $value)?))),*],
        )
    };
}

/// A message of this crate that has no arguments, as a constant of the type `Piece`.
#[macro_export]
#[allow(clippy::crate_in_macro_def, reason = "the messages are those of the crate that tells them")]
macro_rules! word {
    ($message:literal) => {
        $crate::Piece::new(|| &crate::MESSAGES, $message)
    };
}

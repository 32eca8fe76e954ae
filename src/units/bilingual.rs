//! The same words in the two languages that people here speak.

use std::borrow::Cow;
use std::fmt;

use super::{FileFault, InEnglish, Language};

/// Words of a message in both languages. Displayed in Russian, in which faults are told unless English is asked for.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Bilingual {
    russian: Cow<'static, str>,
    english: Cow<'static, str>,
}

impl Bilingual {
    pub fn new(
        russian: impl Into<Cow<'static, str>>,
        english: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self { russian: russian.into(), english: english.into() }
    }

    /// What is told in a language, in both.
    #[must_use]
    pub fn both(told: impl Fn(Language) -> String) -> Self {
        Self::new(told(Language::Russian), told(Language::English))
    }

    /// What a fault says, for another that tells of it.
    #[must_use]
    pub fn of(fault: &impl InEnglish) -> Self {
        Self::new(fault.to_string(), fault.english())
    }

    /// What stands in a text, in the quotation marks of each language.
    #[must_use]
    pub fn quoted(text: &str) -> Self {
        Self::new(format!("«{text}»"), format!("“{text}”"))
    }

    /// A thing with its kind: «комната «Кухня»», "room “Kitchen”".
    #[must_use]
    pub fn named(kind: impl Into<Self>, name: &str) -> Self {
        let kind = kind.into();
        Self::new(format!("{} «{name}»", kind.russian), format!("{} “{name}”", kind.english))
    }

    /// One after the other, with commas.
    #[must_use]
    pub fn list(parts: &[Self]) -> Self {
        let listed =
            |language| parts.iter().map(|p| p.say(language)).collect::<Vec<_>>().join(", ");
        Self::new(listed(Language::Russian), listed(Language::English))
    }

    #[must_use]
    pub fn say(&self, language: Language) -> &str {
        language.pick(&self.russian, &self.english)
    }
}

impl fmt::Display for Bilingual {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.russian)
    }
}

/// What is the same in both, such as a field's name.
impl From<&'static str> for Bilingual {
    fn from(text: &'static str) -> Self {
        Self::new(text, text)
    }
}

/// What is the same in both: what another program said.
impl From<String> for Bilingual {
    fn from(text: String) -> Self {
        Self::new(text.clone(), text)
    }
}

impl From<&FileFault> for Bilingual {
    fn from(fault: &FileFault) -> Self {
        Self::both(|language| fault.tell(language))
    }
}

impl From<(&'static str, &'static str)> for Bilingual {
    fn from((russian, english): (&'static str, &'static str)) -> Self {
        Self::new(russian, english)
    }
}

/// Words with values in them, in both languages: two patterns of `format!`, and what stands in both.
#[macro_export]
macro_rules! bilingual {
    ($russian:literal, $english:literal $(, $value:expr)* $(,)?) => {
        $crate::Bilingual::new(format!($russian $(, $value)*), format!($english $(, $value)*))
    };
}

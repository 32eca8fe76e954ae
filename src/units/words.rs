//! What units themselves say: why a file was not read, why a number is no length, what a text is called that is no file, units.
//!
//! It stands apart from what it tells of, for [`super::told`] tells with lengths and names.

use std::borrow::Cow;
use std::fmt;

use super::file::PATIENCE;
use super::{
    Bilingual, Cm, FileFault, Language, Lengths, OwnText, QuantityError, TimestampError, said,
    told, word,
};

impl FileFault {
    #[must_use]
    pub fn tell(&self, language: Language) -> String {
        match self {
            Self::Io(error) => error.to_string(),
            Self::TooLarge { bytes, limit } => told!(language, "file-too-large", bytes, limit),
            Self::Silent => told!(language, "file-silent", seconds = PATIENCE.as_secs()),
            Self::NotText { at } => told!(language, "file-not-text", at),
        }
    }
}

impl fmt::Display for FileFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.tell(Language::Russian))
    }
}

impl From<QuantityError> for Bilingual {
    fn from(error: QuantityError) -> Self {
        match error {
            QuantityError::NotFinite(value) => {
                said!("number-not-finite", value = value.to_string())
            }
            QuantityError::TooLarge(value) => {
                said!("length-too-large", length = Cm::of(value), limit = Cm::of(Cm::LIMIT))
            }
        }
    }
}

impl fmt::Display for QuantityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Bilingual::from(*self).fmt(f)
    }
}

impl std::error::Error for QuantityError {}

impl OwnText {
    #[must_use]
    pub fn name(self, language: Language) -> Cow<'static, str> {
        let name = match self {
            Self::Order => word!("own-order"),
            Self::Edit => word!("own-edit"),
            Self::Assumption => word!("own-assumption"),
            Self::Measurements => word!("own-measurements"),
            Self::Relations => word!("own-relations"),
        };
        name.say(language)
    }
}

impl fmt::Display for TimestampError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&word!("not-a-time").say(Language::Russian))
    }
}

impl std::error::Error for TimestampError {}

impl Lengths {
    /// A speed in cm/s, as a sentence tells it.
    #[must_use]
    pub fn told_speed(self, cm_a_second: f64, places: usize, language: Language) -> String {
        told!(language, "a-second", length = self.told(cm_a_second, places, language))
    }

    #[must_use]
    pub fn word(self, language: Language) -> Cow<'static, str> {
        let unit = match self {
            Self::Cm => word!("cm"),
            Self::M => word!("m"),
        };
        unit.say(language)
    }
}

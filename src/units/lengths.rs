//! [`Lengths`]: in which unit lengths are told in words.

use std::sync::OnceLock;

use super::Language;

/// The unit of the lengths that are told in words, and of those that are said without one. Within, all are centimetres.
///
/// It is said once for the whole run, as the language of a terminal is: a fault cannot be handed it when it is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Lengths {
    #[default]
    Cm,
    M,
}

static SAID: OnceLock<Lengths> = OnceLock::new();

impl Lengths {
    /// Says in which unit this run tells lengths, before any is told.
    pub fn say(self) {
        // Whoever says it a second time comes too late.
        let _ = SAID.set(self);
    }

    /// What was said; centimetres where nothing was.
    #[must_use]
    pub fn said() -> Self {
        SAID.get().copied().unwrap_or_default()
    }

    /// So many more places tell the same of a length.
    fn finer(self) -> usize {
        match self {
            Self::Cm => 0,
            Self::M => 2,
        }
    }

    /// How many centimetres it is.
    fn cm(self) -> f64 {
        match self {
            Self::Cm => 1.0,
            Self::M => 100.0,
        }
    }

    /// A length in cm, as it is told.
    #[must_use]
    pub fn of(self, cm: f64) -> f64 {
        cm / self.cm()
    }

    /// A length that was said without its unit, in cm.
    #[must_use]
    pub fn meant(self, said: f64) -> f64 {
        said * self.cm()
    }

    /// A length in cm, to so many places of a centimetre, without its unit.
    #[must_use]
    pub fn number(self, cm: f64, places: usize) -> String {
        format!("{:.1$}", self.of(cm), places + self.finer())
    }

    /// The same without zeros that end it.
    #[must_use]
    pub fn short(self, cm: f64, places: usize) -> String {
        without_zeros(self.number(cm, places))
    }

    /// The same with the decimal mark of a language.
    #[must_use]
    pub fn in_language(self, cm: f64, places: usize, language: Language) -> String {
        marked(self.short(cm, places), language)
    }

    /// The same with its unit, as a sentence tells it.
    #[must_use]
    pub fn told(self, cm: f64, places: usize, language: Language) -> String {
        format!("{} {}", self.in_language(cm, places, language), self.word(language))
    }

    /// The same in Russian and in English.
    #[must_use]
    pub fn both(self, cm: f64, places: usize) -> [String; 2] {
        [Language::Russian, Language::English].map(|language| self.told(cm, places, language))
    }

    /// An area in cm², as a sentence tells it.
    #[must_use]
    pub fn told_area(self, square_cm: f64, places: usize, language: Language) -> String {
        let area = format!("{:.1$}", square_cm / self.cm().powi(2), places + 2 * self.finer());
        format!("{} {}²", marked(without_zeros(area), language), self.word(language))
    }

    /// A point in cm, to so many places of a centimetre.
    #[must_use]
    pub fn point(self, x: f64, y: f64, places: usize) -> String {
        format!("({}, {})", self.number(x, places), self.number(y, places))
    }
}

fn without_zeros(number: String) -> String {
    match number.split_once('.') {
        Some(_) => number.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => number,
    }
}

/// With the decimal mark of a language.
fn marked(number: String, language: Language) -> String {
    language.pick(number.replace('.', ","), number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_is_told_in_either_unit_and_understood_in_it() {
        let told = |cm: f64, places| {
            [Lengths::Cm, Lengths::M].map(|unit| unit.told(cm, places, Language::English))
        };
        assert_eq!(told(58.0, 0), ["58 cm", "0.58 m"]);
        assert_eq!(told(59.94, 1), ["59.9 cm", "0.599 m"]);
        assert_eq!(told(300.0, 1), ["300 cm", "3 m"]);
        assert_eq!(Lengths::M.told(-7.5, 1, Language::Russian), "-0,075 м");
        assert_eq!(Lengths::M.point(225.0, 380.0, 0), "(2.25, 3.80)");
        assert_eq!(Lengths::M.both(35.0, 0), ["0,35 м", "0.35 m"]);
        let areas = [Lengths::Cm, Lengths::M].map(|u| u.told_area(400.0, 0, Language::English));
        assert_eq!(areas, ["400 cm²", "0.04 m²"]);
        let speeds = [Lengths::Cm, Lengths::M].map(|u| u.told_speed(25.5, 1, Language::Russian));
        assert_eq!(speeds, ["25,5 см/с", "0,255 м/с"]);
        for unit in [Lengths::Cm, Lengths::M] {
            assert!((unit.meant(unit.of(333.25)) - 333.25).abs() < 1e-9);
        }
    }
}

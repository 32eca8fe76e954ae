//! Case, number and gender of a word form, as one set of bits: agreement is their intersection.

use std::ops::BitAnd;

use crate::language::{Case, Gender, Number, Readings, russian};

/// Which cases, in which genders or in the plural, a form may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Features(u32);

const CASES: u32 = 7;
const COLUMN: u32 = (1 << CASES) - 1;

impl Features {
    /// What says nothing.
    pub const ALL: Self = Self((1 << (4 * CASES)) - 1);
    pub const NONE: Self = Self(0);
    const PLURAL: Self = Self(COLUMN << (3 * CASES));

    fn one(gender: Option<Gender>, case: Case) -> Self {
        let column = gender.map_or(3, |gender| gender as u32);
        Self(1 << (column * CASES + case as u32))
    }

    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether it cannot be a singular.
    #[must_use]
    pub fn is_plural(self) -> bool {
        self.0 & !Self::PLURAL.0 == 0
    }

    /// Those of a noun; of no gender that is known, any.
    #[must_use]
    pub fn of_noun(readings: Readings, gender: Option<Gender>) -> Self {
        let mut all = Self::NONE;
        for case in Case::ALL {
            if readings.has(Number::Plural, case) {
                all = all.or(Self::one(None, case));
            }
            if readings.has(Number::Singular, case) {
                let genders = [Gender::Masculine, Gender::Feminine, Gender::Neuter];
                for own in genders.into_iter().filter(|own| gender.is_none_or(|g| g == *own)) {
                    all = all.or(Self::one(Some(own), case));
                }
            }
        }
        all
    }

    /// By its names in the grammar files: `[gen]`, `[nom acc pl]`.
    pub(crate) fn named(names: &[&str]) -> Result<Self, String> {
        let (mut cases, mut columns) = (0_u32, 0_u32);
        for name in names {
            match *name {
                "nom" => cases |= 1,
                "gen" => cases |= 1 << 1,
                "dat" => cases |= 1 << 2,
                "acc" => cases |= 1 << 3,
                "ins" => cases |= 1 << 4,
                // «в шкафу» and «о шкафе» are one to whom the preposition tells apart.
                "loc" => cases |= 0b110_0000,
                "m" => columns |= 1,
                "f" => columns |= 1 << 1,
                "n" => columns |= 1 << 2,
                "sg" => columns |= 0b111,
                "pl" => columns |= 1 << 3,
                other => return Err(other.to_owned()),
            }
        }
        let cases = if cases == 0 { COLUMN } else { cases };
        let columns = if columns == 0 { 0b1111 } else { columns };
        let of =
            |column: u32| if columns & 1 << column == 0 { 0 } else { cases << (column * CASES) };
        Ok(Self((0..4).map(of).fold(0, |all, one| all | one)))
    }

    /// All forms of a Russian adjective in the masculine, with what each may be; none when it is no adjective.
    #[must_use]
    pub fn of_adjective(adjective: &str) -> Vec<(String, Self)> {
        let lower = adjective.to_lowercase();
        let form = |case, gender: Option<Gender>| {
            let number = if gender.is_some() { Number::Singular } else { Number::Plural };
            russian::agreeing(&lower, case, number, gender.unwrap_or(Gender::Masculine))
        };
        let genders = [Some(Gender::Masculine), Some(Gender::Feminine), Some(Gender::Neuter), None];
        if form(Case::Nominative, genders[0]) == form(Case::Nominative, genders[1]) {
            return Vec::new();
        }
        let mut forms: Vec<(String, Self)> = Vec::new();
        let mut add =
            |form: String, features: Self| match forms.iter_mut().find(|(other, _)| *other == form)
            {
                Some((_, known)) => *known = known.or(features),
                None => forms.push((form, features)),
            };
        for case in Case::ALL {
            for gender in genders {
                add(form(case, gender), Self::one(gender, case));
            }
        }
        // Of a living being the accusative is the genitive: «красного робота».
        for gender in [genders[0], None] {
            add(form(Case::Genitive, gender), Self::one(gender, Case::Accusative));
        }
        forms
    }
}

impl BitAnd for Features {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agreement_is_an_intersection() {
        let of = |word: &str| {
            let forms = Features::of_adjective("красный");
            forms.into_iter().find(|(form, _)| form == word).map_or(Features::NONE, |(_, f)| f)
        };
        let cups = Features::of_noun(
            Readings::one(Number::Singular, Case::Genitive),
            Some(Gender::Feminine),
        );
        assert!(!(of("красной") & cups).is_empty());
        assert!((of("красного") & cups).is_empty());
        assert!(of("красные").is_plural() && !of("красной").is_plural());
        let table = Features::named(&["nom", "pl"]).unwrap();
        assert!(!(of("красные") & table).is_empty());
        assert_eq!(Features::named(&["vocative"]), Err("vocative".to_owned()));
    }
}

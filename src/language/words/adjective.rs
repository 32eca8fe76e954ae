//! Forms of adjectives, and of the nouns that decline like them («гостиная», «дежурный»).
//!
//! An adjective is known by any of its nominatives: «письменный», «большая», «синее», «чёрные».
//! Invariant: [`Adjective::form`] of the gender and number that it was read from gives back the word.

use super::grammar::{Animacy, Case, Gender, Number};
use crate::sets::Set;

/// How the stem ends decides between the vowels of the endings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stem {
    /// белый, -ого
    Hard,
    /// большой, высокий: as hard, but и for ы
    Velar,
    /// хороший, -его
    Sibilant,
    /// синий, -его, -яя
    Soft,
    /// третий, третьего
    Possessive,
    /// дедушкин, маминого
    Personal,
}

/// An adjective read from one of its nominatives.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Adjective {
    stem: String,
    kind: Stem,
    stressed: bool,
    number: Number,
    gender: Gender,
}

/// Stems whose sibilant is followed by a stressed ending: большая – большой, not большей.
const STRESSED_SIBILANT: [&str; 3] = ["больш", "небольш", "чуж"];
/// Adjectives with -ой in the masculine that do not end in a sibilant: вторая – второй.
static STRESSED: Set = Set::named("StressedStem");
const POSSESSIVE: [&str; 1] = ["трет"];

impl Adjective {
    /// Reads a nominative in lower case; `None` when the ending is no adjective's.
    pub(crate) fn read(word: &str) -> Option<Self> {
        let (number, gender, cut) = nominative_ending(word)?;
        let stem: String = drop_last(word, cut).into();
        let last = stem.chars().last()?;
        // Without a vowel before the ending it is a noun: «стая», «слой».
        if !stem.contains(is_vowel) || !last.is_alphabetic() {
            return None;
        }
        let ending = &word[stem.len()..];
        if let Some(possessive) = POSSESSIVE.iter().find(|p| stem.trim_end_matches('ь') == **p) {
            let kind = Stem::Possessive;
            return Some(Self {
                stem: (*possessive).into(),
                kind,
                stressed: false,
                number,
                gender,
            });
        }
        let stressed = ending == "ой" || STRESSED.contains(&stem.as_str());
        let kind = match last {
            'к' | 'г' | 'х' => Stem::Velar,
            'ж' | 'ш' | 'ч' | 'щ'
                if STRESSED_SIBILANT.contains(&stem.as_str()) || ending == "ой" =>
            {
                Stem::Velar
            }
            'ж' | 'ш' | 'ч' | 'щ' => Stem::Sibilant,
            // «станций», «консультаций»: nouns
            'ц' if ending == "ий" => return None,
            'ц' => Stem::Hard,
            _ if matches!(ending, "ий" | "яя" | "ее" | "ие") => Stem::Soft,
            _ => Stem::Hard,
        };
        // «помещение», «гений» end as «нижние» does, but a soft stem ends in a consonant and н.
        if kind == Stem::Soft && !is_soft_stem(&stem) {
            return None;
        }
        let stressed =
            stressed || (kind == Stem::Velar && STRESSED_SIBILANT.contains(&stem.as_str()));
        Some(Self { stem, kind, stressed, number, gender })
    }

    /// Reads «дедушкин», «мамина»: only for words that a dictionary has as adjectives, since many nouns end so.
    pub(crate) fn read_possessive(word: &str) -> Option<Self> {
        let (cut, number, gender) = match word.chars().last()? {
            'н' | 'в' => (0, Number::Singular, Gender::Masculine),
            'а' => (1, Number::Singular, Gender::Feminine),
            'о' => (1, Number::Singular, Gender::Neuter),
            'ы' => (1, Number::Plural, Gender::Masculine),
            _ => return None,
        };
        let stem = if cut == 0 { word } else { drop_last(word, 1) };
        let fits = ["ин", "ын", "ов", "ев"].iter().any(|e| stem.ends_with(e));
        fits.then(|| Self {
            stem: stem.into(),
            kind: Stem::Personal,
            stressed: false,
            number,
            gender,
        })
    }

    /// The nominative of the masculine, which dictionaries list.
    pub(crate) fn masculine(&self) -> String {
        self.form(Case::Nominative, Number::Singular, Gender::Masculine, Animacy::Inanimate)
    }

    /// The number of the word that was read.
    pub(crate) fn number(&self) -> Number {
        self.number
    }

    /// The gender of the word that was read; masculine for a plural.
    pub(crate) fn gender(&self) -> Gender {
        self.gender
    }

    /// The form that agrees with a noun of this gender and animacy.
    pub(crate) fn form(
        &self,
        case: Case,
        number: Number,
        gender: Gender,
        animacy: Animacy,
    ) -> String {
        let case = match case {
            Case::Locative => Case::Prepositional,
            Case::Accusative if number == Number::Plural || gender == Gender::Masculine => {
                match animacy {
                    Animacy::Animate => Case::Genitive,
                    Animacy::Inanimate => Case::Nominative,
                }
            }
            Case::Accusative if gender == Gender::Neuter => Case::Nominative,
            other => other,
        };
        format!("{}{}", self.stem, self.ending(case, number, gender))
    }

    fn ending(&self, case: Case, number: Number, gender: Gender) -> &'static str {
        use Case::{Accusative, Dative, Genitive, Instrumental, Nominative};
        // The columns: hard, velar, sibilant, soft, possessive, personal.
        let row: [&str; 6] = match (number, gender, case) {
            (Number::Plural, _, Nominative) => ["ые", "ие", "ие", "ие", "ьи", "ы"],
            (Number::Plural, _, Dative) => ["ым", "им", "им", "им", "ьим", "ым"],
            (Number::Plural, _, Instrumental) => ["ыми", "ими", "ими", "ими", "ьими", "ыми"],
            (Number::Plural, _, _) => ["ых", "их", "их", "их", "ьих", "ых"],
            (_, Gender::Feminine, Nominative) => ["ая", "ая", "ая", "яя", "ья", "а"],
            (_, Gender::Feminine, Accusative) => ["ую", "ую", "ую", "юю", "ью", "у"],
            (_, Gender::Feminine, _) => ["ой", "ой", "ей", "ей", "ьей", "ой"],
            (_, Gender::Neuter, Nominative) => ["ое", "ое", "ее", "ее", "ье", "о"],
            (_, Gender::Masculine, Nominative) if self.stressed => {
                ["ой", "ой", "ой", "ий", "ий", ""]
            }
            (_, Gender::Masculine, Nominative) => ["ый", "ий", "ий", "ий", "ий", ""],
            (_, _, Genitive) => ["ого", "ого", "его", "его", "ьего", "ого"],
            (_, _, Dative) => ["ому", "ому", "ему", "ему", "ьему", "ому"],
            (_, _, Instrumental) => ["ым", "им", "им", "им", "ьим", "ым"],
            (_, _, _) => ["ом", "ом", "ем", "ем", "ьем", "ом"],
        };
        row[self.kind as usize]
    }
}

/// Number and gender that the ending of a nominative shows, and its length in letters.
fn nominative_ending(word: &str) -> Option<(Number, Gender, usize)> {
    let ends = |endings: &[&str]| endings.iter().any(|e| word.ends_with(e));
    match word {
        "третья" => return Some((Number::Singular, Gender::Feminine, 2)),
        "третье" => return Some((Number::Singular, Gender::Neuter, 2)),
        "третьи" => return Some((Number::Plural, Gender::Masculine, 2)),
        _ => {}
    }
    if ends(&["ый", "ий", "ой"]) {
        Some((Number::Singular, Gender::Masculine, 2))
    } else if ends(&["ая", "яя"]) {
        Some((Number::Singular, Gender::Feminine, 2))
    } else if ends(&["ое", "ее"]) {
        Some((Number::Singular, Gender::Neuter, 2))
    } else if ends(&["ые", "ие"]) {
        Some((Number::Plural, Gender::Masculine, 2))
    } else {
        None
    }
}

fn is_soft_stem(stem: &str) -> bool {
    stem == "син"
        || stem == "кар"
        || (stem.ends_with('н') && !drop_last(stem, 1).ends_with(is_vowel))
}

pub(crate) fn is_vowel(letter: char) -> bool {
    matches!(letter, 'а' | 'е' | 'ё' | 'и' | 'о' | 'у' | 'ы' | 'э' | 'ю' | 'я')
}

/// The word without its last `count` letters.
pub(crate) fn drop_last(word: &str, count: usize) -> &str {
    let at = word.char_indices().rev().nth(count - 1).map_or(0, |(at, _)| at);
    &word[..at]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(word: &str, expected: &str) {
        let adjective = Adjective::read(word).expect(word);
        let (number, gender) = (adjective.number(), adjective.gender());
        assert_eq!(adjective.form(Case::Nominative, number, gender, Animacy::Inanimate), word);
        let forms = Case::SIX.map(|case| adjective.form(case, number, gender, Animacy::Inanimate));
        assert_eq!(forms.join(" "), expected);
    }

    #[test]
    fn all_kinds_of_stem_decline() {
        check("письменный", "письменный письменного письменному письменный письменным письменном");
        check("большая", "большая большой большой большую большой большой");
        check("большой", "большой большого большому большой большим большом");
        check("синее", "синее синего синему синее синим синем");
        check("хороший", "хороший хорошего хорошему хороший хорошим хорошем");
        check("чёрные", "чёрные чёрных чёрным чёрные чёрными чёрных");
        check("третья", "третья третьей третьей третью третьей третьей");
        check("второй", "второй второго второму второй вторым втором");
    }

    #[test]
    fn a_living_thing_takes_the_genitive() {
        let new = Adjective::read("новый").unwrap();
        let form =
            |animacy| new.form(Case::Accusative, Number::Singular, Gender::Masculine, animacy);
        assert_eq!(
            (form(Animacy::Animate), form(Animacy::Inanimate)),
            ("нового".into(), "новый".into())
        );
    }

    #[test]
    fn nouns_are_not_taken_for_adjectives() {
        for word in ["помещение", "стол", "станций", "ой", "планетарий", "й", ""]
        {
            assert_eq!(Adjective::read(word), None, "{word}");
        }
    }
}

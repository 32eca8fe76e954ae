//! The dictionary crate `rumorph` behind the two questions that this folder asks of it.
//!
//! The dictionary is opened at the first question (some 4 ms; its 20 MB are mapped, not read) and never before. With the
//! feature `packed` it is unpacked then.
//! Without the feature `rumorph` every answer is "not known", and the rules by ending decide alone.

use super::grammar::Number;
use super::noun::{Known, Noun};

/// What part of speech a nominative may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct PartsOfSpeech {
    /// The dictionary has the word in some form.
    pub(crate) known: bool,
    /// It is the nominative of a noun, singular or plural.
    pub(crate) noun: bool,
    /// It is the nominative of an adjective.
    pub(crate) adjective: bool,
    /// It is the nominative of a person's first name.
    pub(crate) first_name: bool,
    /// It is some form of a person's surname.
    pub(crate) surname: bool,
}

/// The noun whose nominative is `word` (lower case), if the dictionary has it.
pub(crate) fn noun(word: &str, known: Known) -> Option<Noun> {
    source::noun(word, known)
}

/// The noun that a number governs in this form: «стула» after «два», «стульев» after «пять».
pub(crate) fn counted(word: &str, number: Number) -> Option<Noun> {
    source::counted(word, number)
}

pub(crate) fn readings(word: &str) -> PartsOfSpeech {
    source::readings(word)
}

/// The infinitive of a verb in a form in which people order or ask: imperative, infinitive, second person. None for a
/// word that may be anything else.
pub(crate) fn ordering_verb(word: &str) -> Option<String> {
    const ENDINGS: [char; 6] = ['й', 'и', 'ь', 'е', 'я', 'ч'];
    // Most words are neither Russian nor end as such a verb does.
    let may_be = word.chars().count() >= 4
        && word.ends_with(ENDINGS)
        && word.chars().all(|c| matches!(c, 'а'..='я' | 'ё'));
    if may_be { source::ordering_verb(word) } else { None }
}

/// Whether the dictionary has a Russian word (lower case) in any form.
pub(crate) fn is_russian_word(word: &str) -> bool {
    source::readings(word).known
}

/// Whether a word (lower case) is a verb of the first person in every reading: «сижу», «иду».
pub(crate) fn is_first_person(word: &str) -> bool {
    word.ends_with(['у', 'ю', 'м', 'ь']) && source::is_first_person(word)
}

/// Whether a word (lower case) is an interjection, a particle or a parenthesis in every reading: «ведь», «мол», «увы».
pub(crate) fn says_nothing(word: &str) -> bool {
    word.chars().all(|c| matches!(c, 'а'..='я' | 'ё')) && source::says_nothing(word)
}

/// Whether a word (lower case) may be what a Russian clause says of its subject: a verb in the indicative, a short adjective.
pub(crate) fn may_be_predicate(word: &str) -> bool {
    word.chars().all(|c| matches!(c, 'а'..='я' | 'ё')) && source::may_be_predicate(word)
}

#[cfg(not(feature = "rumorph"))]
mod source {
    use super::{Known, Noun, Number, PartsOfSpeech};

    pub(super) fn noun(_word: &str, _known: Known) -> Option<Noun> {
        None
    }

    pub(super) fn readings(_word: &str) -> PartsOfSpeech {
        PartsOfSpeech::default()
    }

    pub(super) fn ordering_verb(_word: &str) -> Option<String> {
        None
    }

    pub(super) fn counted(_word: &str, _number: Number) -> Option<Noun> {
        None
    }

    pub(super) fn says_nothing(_word: &str) -> bool {
        false
    }

    pub(super) fn is_first_person(_word: &str) -> bool {
        false
    }

    pub(super) fn may_be_predicate(_word: &str) -> bool {
        false
    }
}

#[cfg(feature = "rumorph")]
mod source {
    use std::sync::OnceLock;

    use rumorph::{Analysis, Dictionary, Source, UdTag};

    use super::super::grammar::{Animacy, Case, Evidence, Gender, Number};
    use super::super::lexicon;
    use super::super::noun::Paradigm;
    use super::{Known, Noun, PartsOfSpeech};

    fn dictionary() -> Option<&'static Dictionary> {
        static OPEN: OnceLock<Option<Dictionary>> = OnceLock::new();
        OPEN.get_or_init(|| open().ok()).as_ref()
    }

    #[cfg(not(feature = "packed"))]
    fn open() -> Result<Dictionary, rumorph::Error> {
        Dictionary::bundled()
    }

    #[cfg(feature = "packed")]
    fn open() -> Result<Dictionary, rumorph::Error> {
        Dictionary::from_bytes(&orthoframe_language_dictionary::unpacked()?)
    }

    pub(super) fn readings(word: &str) -> PartsOfSpeech {
        let mut readings = PartsOfSpeech::default();
        let Some(dictionary) = dictionary() else { return readings };
        for (_, tag) in known_analyses(dictionary, word) {
            readings.known = true;
            let is_name = |label: &str, kind: &str| {
                tag.has_label(label) || tag.feat("NameType") == Some(kind)
            };
            readings.surname |= is_name("Surn", "Sur");
            if tag.feat("Case") == Some("Nom") {
                readings.first_name |= is_name("Name", "Giv");
                readings.noun |= matches!(tag.pos(), "NOUN" | "PROPN");
                readings.adjective |= matches!(tag.pos(), "ADJ" | "DET");
            }
        }
        readings
    }

    pub(super) fn counted(word: &str, number: Number) -> Option<Noun> {
        let dictionary = dictionary()?;
        let counted = |tag: &UdTag<'_>| {
            matches!(tag.pos(), "NOUN")
                && tag.feat("Case") == Some("Gen")
                && number_of(*tag) == Some(number)
        };
        let analyses = known_analyses(dictionary, word).filter(|(_, tag)| counted(tag));
        let likely = analyses.max_by_key(|(analysis, _)| (analysis.prob * 1e6) as u64);
        let lemma = likely?.0.lemma;
        match lexicon::find(&lemma) {
            Some(_) => Some(Noun::by_rules(&lemma, Known::default())),
            None => noun(&lemma, Known::default()),
        }
    }

    pub(super) fn says_nothing(word: &str) -> bool {
        every_reading(word, |tag| {
            // A particle that also joins still says nothing; names are few that sound so.
            matches!(tag.pos(), "INTJ" | "PART" | "CCONJ" | "PROPN") || tag.has_label("Prnt")
        }) && some_reading(word, |tag| {
            matches!(tag.pos(), "INTJ" | "PART") || tag.has_label("Prnt")
        })
    }

    pub(super) fn is_first_person(word: &str) -> bool {
        every_reading(word, |tag| tag.pos() == "VERB" && tag.feat("Person") == Some("1"))
    }

    pub(super) fn may_be_predicate(word: &str) -> bool {
        some_reading(word, |tag| match tag.pos() {
            "VERB" => tag.feat("Mood") == Some("Ind"),
            "ADJ" => tag.feat("Variant") == Some("Short"),
            _ => false,
        })
    }

    fn every_reading(word: &str, is: impl Fn(&UdTag<'_>) -> bool) -> bool {
        let Some(dictionary) = dictionary() else { return false };
        let mut known = known_analyses(dictionary, word).peekable();
        known.peek().is_some() && known.all(|(_, tag)| is(&tag))
    }

    fn some_reading(word: &str, is: impl Fn(&UdTag<'_>) -> bool) -> bool {
        dictionary().is_some_and(|d| known_analyses(d, word).any(|(_, tag)| is(&tag)))
    }

    pub(super) fn ordering_verb(word: &str) -> Option<String> {
        let dictionary = dictionary()?;
        let mut infinitive = None;
        for (analysis, tag) in known_analyses(dictionary, word) {
            let orders = tag.feat("Mood") == Some("Imp")
                || tag.feat("VerbForm") == Some("Inf")
                || tag.feat("Person") == Some("2");
            if tag.pos() != "VERB" || !orders {
                return None;
            }
            infinitive.get_or_insert(analysis.lemma.replace('ё', "е"));
        }
        infinitive
    }

    pub(super) fn noun(word: &str, known: Known) -> Option<Noun> {
        let dictionary = dictionary()?;
        let analysis = known_analyses(dictionary, word)
            .filter(|(_, tag)| is_wanted(*tag, known))
            .max_by_key(|(analysis, tag)| rank(analysis, *tag, known, word))
            .map(|(analysis, _)| analysis)?;
        let tag = dictionary.ud_tag(analysis.ud)?;
        let number = number_of(tag)?;
        // The word list knows some words better than the dictionary: «стулья», not «стулы».
        if analysis.lemma != word && lexicon::find(&analysis.lemma).is_some() {
            let lemma = Noun::by_rules(&analysis.lemma, Known { number: None, ..known });
            if number == Number::Plural && lemma.paradigm.form(number, Case::Nominative) == word {
                return Some(Noun { number, ..lemma });
            }
        }
        // Who writes «актер» without ё wants «актера».
        let plain = analysis.word.contains('ё') && !word.contains('ё');
        let forms: Vec<(Analysis, Number, Case)> = dictionary
            .forms(&analysis)
            .into_iter()
            .filter_map(|mut form| {
                if plain {
                    form.word = form.word.replace('ё', "е");
                }
                let tag = dictionary.ud_tag(form.ud)?;
                let case = if tag.has_label("loc2") { Case::Locative } else { case_of(tag)? };
                Some((form, number_of(tag)?, case))
            })
            .collect();
        let animacy = known.animacy.unwrap_or(match tag.feat("Animacy") {
            Some("Anim") => Animacy::Animate,
            _ => Animacy::Inanimate,
        });
        Some(Noun {
            paradigm: paradigm(dictionary, word, number, animacy, &forms)?,
            gender: known.gender.or_else(|| gender_of(tag)).unwrap_or(Gender::Masculine),
            animacy,
            number,
            evidence: Evidence::Dictionary,
        })
    }

    /// Readings that stand in the dictionary; none that it merely guesses.
    fn known_analyses<'d>(
        dictionary: &'d Dictionary,
        word: &str,
    ) -> impl Iterator<Item = (Analysis, UdTag<'d>)> {
        dictionary
            .analyze(word)
            .into_iter()
            .filter(|analysis| analysis.source == Source::Dictionary)
            .filter_map(|analysis| dictionary.ud_tag(analysis.ud).map(|tag| (analysis, tag)))
    }

    fn is_wanted(tag: UdTag<'_>, known: Known) -> bool {
        let gender = gender_of(tag);
        matches!(tag.pos(), "NOUN" | "PROPN")
            && tag.feat("Case") == Some("Nom")
            && number_of(tag)
                .is_some_and(|number| known.number.is_none_or(|wanted| wanted == number))
            && (known.gender.is_none() || gender.is_none() || gender == known.gender)
    }

    /// A common noun in the singular, or that has no singular, comes first; then a thing before a being («мешок»); then
    /// the likelier reading.
    fn rank(
        analysis: &Analysis,
        tag: UdTag<'_>,
        known: Known,
        word: &str,
    ) -> (bool, bool, bool, bool, u64) {
        let common = tag.pos() == "NOUN" && tag.feat("Abbr").is_none();
        let own_number = analysis.lemma == word || tag.feat("Number") == Some("Sing");
        let animate = tag.feat("Animacy") == Some("Anim");
        let suits = known.animacy.is_none_or(|a| (a == Animacy::Animate) == animate);
        (common, own_number, suits, !animate, (analysis.prob * 1e6) as u64)
    }

    fn paradigm(
        dictionary: &Dictionary,
        word: &str,
        own: Number,
        animacy: Animacy,
        forms: &[(Analysis, Number, Case)],
    ) -> Option<Paradigm> {
        let is_rare = |form: &Analysis| {
            dictionary.ud_tag(form.ud).is_some_and(|tag| tag.labels().any(is_mark_of_rarity))
        };
        let best = |number: Number, case: Case| {
            let suiting = forms.iter().filter(|(_, n, c)| (*n, *c) == (number, case));
            suiting.min_by_key(|(form, ..)| is_rare(form)).map(|(form, ..)| form.word.clone())
        };
        let form = |number: Number, case: Case| -> Option<String> {
            match case {
                Case::Nominative if number == own => Some(word.to_owned()),
                // The dictionary keeps an accusative for each animacy; ours follows from it.
                Case::Accusative if number == Number::Plural => match animacy {
                    Animacy::Animate => best(number, Case::Genitive),
                    Animacy::Inanimate => best(number, Case::Nominative),
                },
                // Its second locative is often bookish («в щиту»); the usual ones stand in the word list.
                Case::Locative => best(number, Case::Prepositional),
                _ => best(number, case),
            }
        };
        let missing = |number: Number| Case::ALL.iter().all(|case| form(number, *case).is_none());
        let other = if own == Number::Singular { Number::Plural } else { Number::Singular };
        // A word without the other number says everything in its own.
        let number_for =
            |number: Number| if number == other && missing(other) { own } else { number };
        if Case::SIX.iter().any(|case| form(own, *case).is_none()) {
            return None;
        }
        let mut paradigm = Paradigm::new(|number, case| {
            form(number_for(number), case).or_else(|| form(own, case)).unwrap_or_default()
        });
        for (variant, number, case) in forms {
            if paradigm.form(*number, *case) != variant.word {
                paradigm.variants.push((*number, *case, variant.word.clone()));
            }
        }
        Some(paradigm)
    }

    fn is_mark_of_rarity(label: &str) -> bool {
        matches!(label, "Infr" | "Arch" | "Erro" | "Dist" | "Slng" | "loc1" | "gen2" | "acc2")
            || label.starts_with("V-")
    }

    fn case_of(tag: UdTag<'_>) -> Option<Case> {
        Some(match tag.feat("Case")? {
            "Nom" => Case::Nominative,
            "Gen" => Case::Genitive,
            "Dat" => Case::Dative,
            "Acc" => Case::Accusative,
            "Ins" => Case::Instrumental,
            "Loc" => Case::Prepositional,
            _ => return None,
        })
    }

    fn number_of(tag: UdTag<'_>) -> Option<Number> {
        match tag.feat("Number")? {
            "Sing" => Some(Number::Singular),
            "Plur" => Some(Number::Plural),
            _ => None,
        }
    }

    fn gender_of(tag: UdTag<'_>) -> Option<Gender> {
        match tag.feat("Gender")? {
            "Masc" => Some(Gender::Masculine),
            "Fem" => Some(Gender::Feminine),
            "Neut" => Some(Gender::Neuter),
            _ => None,
        }
    }
}

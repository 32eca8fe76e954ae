//! What endings tell: fleeting vowels, stress, gender, words that do not decline.
//!
//! Invariant: they see the letters alone; what letters cannot tell stands in the word list.

use super::Noun;
use crate::sets::Set;
use crate::words::adjective::{Adjective, drop_last, is_vowel};
use crate::words::grammar::{Case, Evidence, Number};

impl Noun {
    /// Whether it has one form only: «кафе».
    pub(crate) fn is_unchanging(&self) -> bool {
        let nominative = self.paradigm.form(Number::Singular, Case::Nominative);
        Number::BOTH
            .iter()
            .all(|n| Case::SIX.iter().all(|case| self.paradigm.form(*n, *case) == nominative))
    }
}

pub(super) fn sure_if(sure: bool) -> Evidence {
    if sure { Evidence::Rule } else { Evidence::Guess }
}

pub(super) fn is_husher_or_velar(letter: char) -> bool {
    matches!(letter, 'к' | 'г' | 'х' | 'ж' | 'ш' | 'ч' | 'щ')
}

pub(super) fn ends_in_two_consonants(stem: &str) -> bool {
    let mut letters = stem.chars().rev();
    let consonant = |letter: Option<char>| letter.is_some_and(|l| !is_vowel(l) && l != 'ь');
    consonant(letters.next()) && consonant(letters.next())
}

/// Genitive plural without an ending, with the vowel that breaks a cluster: полок, кресел, спален.
pub(super) fn zero_ending(stem: &str, soft: bool) -> String {
    let mut letters = stem.chars().rev();
    let (last, before) = (letters.next(), letters.next());
    let body = drop_last(stem, 1);
    let clustered = before.is_some_and(|l| !is_vowel(l));
    // The letter before a broken cluster loses its ь or й: письмо – писем, скамейка – скамеек.
    let broken = |vowel: char| {
        let body = body.strip_suffix(['ь', 'й']).unwrap_or(body);
        format!("{body}{vowel}{}", last.unwrap_or_default())
    };
    let hush = matches!(before, Some('ж' | 'ш' | 'ч' | 'щ' | 'ц' | 'ь' | 'й'));
    match last {
        Some(l) if is_vowel(l) => format!("{stem}й"),
        Some('к') if clustered => broken(if hush { 'е' } else { 'о' }),
        Some('н') if soft && clustered => broken('е'),
        Some('н')
            if clustered && before != Some('н') && before != Some('л') && before != Some('й') =>
        {
            broken('е')
        }
        Some('л') if soft && clustered => format!("{}ь", broken('е')),
        Some('л') if clustered && before != Some('л') => broken('е'),
        Some('ц') if clustered => broken('е'),
        Some('м') if before == Some('ь') => broken('е'),
        Some('р') if matches!(before, Some('д' | 'б')) => broken('е'),
        _ if soft => format!("{stem}ь"),
        _ => stem.into(),
    }
}

/// Stem of the oblique cases, whether it is soft, and whether a vowel fled from it.
pub(super) fn masculine_stem(word: &str) -> (String, bool, bool) {
    let letters = word.chars().count();
    let vowels = word.chars().filter(|c| is_vowel(*c)).count();
    let cut = |count: usize, rest: &str| (format!("{}{rest}", drop_last(word, count)), false, true);
    if word.ends_with('й') {
        return (drop_last(word, 1).into(), true, false);
    }
    if vowels < 2 {
        return (word.into(), false, false);
    }
    let before = word.chars().rev().nth(2);
    static KEEP_OK: Set = Set::named("KeepsVowel");
    match () {
        () if word.ends_with("ок") && !KEEP_OK.contains(&word) && !word.ends_with("блок") => {
            cut(2, "к")
        }
        () if word.ends_with("ёк") || word.ends_with("лек") => match before {
            Some(l) if is_vowel(l) => cut(2, "йк"),
            _ => cut(2, "ьк"),
        },
        () if ["чек", "шек", "жек"].iter().any(|e| word.ends_with(e)) && letters > 4 => {
            cut(2, "к")
        }
        () if word.ends_with("ец") && letters > 3 => match before {
            Some('л') => cut(2, "ьц"),
            Some(l) if is_vowel(l) => cut(2, "йц"),
            _ if ends_in_two_consonants(drop_last(word, 2)) && !word.ends_with("нец") => {
                (word.into(), false, false)
            }
            _ => cut(2, "ц"),
        },
        () => (word.into(), false, false),
    }
}

/// -ец under stress takes -цом; -анец, -овец, -лец and the like mostly do not have it.
pub(super) fn has_stressed_ets(word: &str) -> bool {
    let unstressed =
        ["анец", "янец", "енец", "инец", "овец", "евец", "мец", "лидец", "ерец", "ндец", "ц"];
    word.ends_with("ец") && !unstressed[..10].iter().any(|e| word.ends_with(e))
}

/// Whether -ом follows the sibilant: этажом, ключом, but душем, матчем.
pub(super) fn has_stressed_husher(word: &str) -> bool {
    let short = word.chars().filter(|c| is_vowel(*c)).count() == 1;
    match word.chars().last() {
        Some('ж') => short || word.ends_with("аж") || word.ends_with("ёж"),
        Some('ч') => {
            (short || word.ends_with("ач") || word.ends_with("ич") || word.ends_with("юч"))
                && !word.ends_with("вич")
        }
        Some('ш') => {
            word.ends_with("ыш") && !short && !word.ends_with("игрыш")
                || word.ends_with("даш")
                || word.ends_with("иш")
        }
        Some('щ') => short || word.ends_with("ющ"),
        _ => false,
    }
}

/// Nouns in -ь that are masculine by their ending; the others stand in the word list.
pub(super) fn is_masculine_soft(word: &str) -> bool {
    const MASCULINE: [&str; 16] = [
        "тель",
        "арь",
        "ырь",
        "ень",
        "оль",
        "иль",
        "уль",
        "абль",
        "обль",
        "убль",
        "ель",
        "ошь-",
        "оготь",
        "окоть",
        "орь",
        "юль",
    ];
    const FEMININE: [&str; 14] = [
        "бель",
        "ышень",
        "упень",
        "епень",
        "ирень",
        "дель",
        "нель",
        "тень",
        "пель",
        "рель",
        "соль",
        "роль",
        "боль",
        "моль",
    ];
    MASCULINE.iter().any(|e| word.ends_with(e)) && !FEMININE.iter().any(|e| word.ends_with(e))
}

/// Loans whose ending no Russian declension has.
pub(super) fn is_unchanging(word: &str) -> bool {
    let mut letters = word.chars().rev();
    let (Some(last), before) = (letters.next(), letters.next()) else { return true };
    match last {
        'у' | 'ю' | 'э' => true,
        'и' => before.is_some_and(|b| matches!(b, 'б' | 'п' | 'ф')) && word.chars().count() < 7,
        'о' => before.is_some_and(is_vowel),
        'е' | 'ё' => {
            !before.is_some_and(|b| matches!(b, 'и' | 'ь' | 'ц' | 'щ' | 'ж'))
                && !word.ends_with("ое")
                && !word.ends_with("ее")
                && !word.ends_with("ле")
                && !word.ends_with("ые")
                && !word.ends_with("ане")
                && !word.ends_with("яне")
        }
        'а' => before.is_some_and(|b| matches!(b, 'у' | 'о')),
        _ => !last.is_alphabetic() || last.is_ascii(),
    }
}

/// Nouns with an adjective's ending, as far as the ending alone tells.
pub(super) fn looks_adjectival(word: &str) -> bool {
    let Some(adjective) = Adjective::read(word) else { return false };
    match adjective.number() {
        _ if word.ends_with("ый") || word.ends_with("ые") => true,
        Number::Plural => {
            !word.ends_with("ие")
                || word.ends_with("кие")
                || word.ends_with("щие")
                || word.ends_with("шие")
        }
        Number::Singular if word.ends_with("ой") => false,
        Number::Singular if word.ends_with("ий") => {
            ["кий", "щий", "ший", "чий", "жний", "дний"].iter().any(|e| word.ends_with(e))
        }
        Number::Singular => !["стая", "свая", "майя"].iter().any(|e| word.ends_with(e)),
    }
}

/// Plural by its ending: -ы, -и after a consonant, -ане.
pub(super) fn looks_plural(word: &str) -> bool {
    word.ends_with('ы')
        || word.ends_with("ане")
        || word.ends_with("яне")
        || (word.ends_with('и') && !drop_last(word, 1).is_empty())
}

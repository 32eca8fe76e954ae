//! Principal parts: five forms that determine a noun, by its ending, and the forms that follow from them.
//!
//! Invariant: the nominative of the noun's own number is the word itself.

use super::Known;
use super::Noun;
use super::Paradigm;
use super::endings::ends_in_two_consonants;
use super::endings::has_stressed_ets;
use super::endings::has_stressed_husher;
use super::endings::is_husher_or_velar;
use super::endings::is_masculine_soft;
use super::endings::is_unchanging;
use super::endings::looks_adjectival;
use super::endings::looks_plural;
use super::endings::masculine_stem;
use super::endings::sure_if;
use super::endings::zero_ending;
use crate::words::adjective::{Adjective, drop_last, is_vowel};
use crate::words::grammar::{Animacy, Case, Evidence, Gender, Number};
use crate::words::lexicon;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// -а, -я
    First,
    /// A masculine consonant, -й, -ь; a neuter -о, -е.
    Second,
    /// A feminine -ь.
    Third,
    Adjectival,
    Unchanging,
}

/// The principal parts of a noun.
#[derive(Debug, Clone)]
pub(super) struct Parts {
    word: String,
    kind: Kind,
    gender: Gender,
    animacy: Animacy,
    number: Number,
    genitive: String,
    instrumental: String,
    nominative_plural: String,
    genitive_plural: String,
    instrumental_plural: Option<String>,
    locative: Option<String>,
    evidence: Evidence,
}

impl Parts {
    /// Principal parts as the ending suggests them.
    pub(super) fn by_ending(word: &str, known: Known, entry: Option<&lexicon::Entry>) -> Self {
        let gender = known.gender.or_else(|| entry.and_then(|entry| entry.gender));
        let plural =
            known.number == Some(Number::Plural) || entry.is_some_and(|entry| entry.plural_only);
        let mut parts = match () {
            () if entry.is_some_and(|entry| entry.indeclinable) => Self::unchanging(word),
            () if entry.is_some_and(|entry| entry.adjectival) => Self::adjectival(word),
            () if plural => Self::plural(word),
            () if entry.is_none() && is_unchanging(word) => Self::unchanging(word),
            () if entry.is_none() && looks_adjectival(word) => Self::adjectival(word),
            () if entry.is_none() && looks_plural(word) && known.number.is_none() => {
                Self::plural(word)
            }
            () => match (word.chars().last(), gender) {
                (Some('а' | 'я'), _)
                    if word.ends_with("мя") && gender != Some(Gender::Feminine) =>
                {
                    Self::in_mya(word)
                }
                (Some('а' | 'я'), _) => Self::first(word),
                (Some('о' | 'е' | 'ё'), _) => Self::neuter(word),
                (Some('ь'), Some(Gender::Masculine)) => Self::masculine_soft(word),
                (Some('ь'), None) if is_masculine_soft(word) => Self::masculine_soft(word),
                (Some('ь'), _) => Self::third(word),
                (Some(last), _) if last.is_alphabetic() && !is_vowel(last) => Self::masculine(word),
                _ => Self::unchanging(word),
            },
        };
        if let Some(gender) = gender {
            parts.gender = gender;
        }
        if plural {
            parts.number = Number::Plural;
        }
        if let Some(animacy) =
            known.animacy.or(entry.filter(|e| e.animate).map(|_| Animacy::Animate))
        {
            parts.animacy = animacy;
        }
        parts
    }

    fn new(word: &str, kind: Kind, gender: Gender) -> Self {
        Self {
            word: word.into(),
            kind,
            gender,
            animacy: Animacy::Inanimate,
            number: Number::Singular,
            genitive: word.into(),
            instrumental: word.into(),
            nominative_plural: word.into(),
            genitive_plural: word.into(),
            instrumental_plural: None,
            locative: None,
            evidence: Evidence::Guess,
        }
    }

    /// What the word list says beats what the ending suggests.
    pub(super) fn apply(&mut self, entry: &lexicon::Entry) {
        self.evidence = Evidence::Lexicon;
        let stem_changes = entry.genitive.is_some();
        if let Some(genitive) = entry.genitive {
            self.genitive = genitive.into();
            if self.kind == Kind::Second {
                let (stem, soft) = (drop_last(genitive, 1), genitive.ends_with('я'));
                let plural = self.plural_of_masculine(stem, soft);
                self.instrumental = format!("{stem}{}", if soft { "ем" } else { "ом" });
                self.nominative_plural = plural;
                self.genitive_plural = match self.word.chars().last() {
                    Some('ь') => format!("{stem}ей"),
                    _ if soft => format!("{stem}ев"),
                    _ => format!("{stem}ов"),
                };
            }
            if self.kind == Kind::Third {
                self.nominative_plural = genitive.into();
                self.genitive_plural = format!("{}ей", drop_last(genitive, 1));
            }
        }
        if let Some(form) = entry.nominative_plural {
            self.nominative_plural = form.into();
        }
        if let Some(form) = entry.genitive_plural {
            self.genitive_plural = form.into();
        }
        if let Some(form) = entry.instrumental {
            self.instrumental = form.into();
            // A stressed ending after ц and the sibilants shows in the plural too: отцом – отцов.
            if form.ends_with("цем") && entry.genitive_plural.is_none() && !stem_changes {
                self.genitive_plural = format!("{}ев", drop_last(form, 2));
            }
        }
        self.instrumental_plural = entry.instrumental_plural.map(Into::into);
        self.locative = entry.locative.map(Into::into);
    }

    fn plural_of_masculine(&self, stem: &str, soft: bool) -> String {
        let i = soft || stem.ends_with(is_husher_or_velar);
        format!("{stem}{}", if i { "и" } else { "ы" })
    }

    fn unchanging(word: &str) -> Self {
        let mut parts = Self::new(word, Kind::Unchanging, Gender::Neuter);
        parts.evidence = if word.chars().any(|c| c.is_ascii_alphanumeric()) {
            Evidence::Rule
        } else {
            Evidence::Guess
        };
        parts
    }

    fn adjectival(word: &str) -> Self {
        let Some(adjective) = Adjective::read(word) else { return Self::unchanging(word) };
        let mut parts = Self::new(word, Kind::Adjectival, adjective.gender());
        parts.number = adjective.number();
        parts
    }

    /// A word that stands in the plural and has no other number.
    pub(super) fn plural(word: &str) -> Self {
        if let Some(adjective) = Adjective::read(word).filter(|a| a.number() == Number::Plural) {
            let mut parts = Self::new(word, Kind::Adjectival, adjective.gender());
            parts.number = Number::Plural;
            return parts;
        }
        let stem = drop_last(word, 1);
        let mut parts = Self::new(word, Kind::Second, Gender::Masculine);
        parts.number = Number::Plural;
        parts.genitive_plural = match word.chars().last() {
            Some('ы') if stem.ends_with('ц') => format!("{stem}ев"),
            Some('ы') => format!("{stem}ов"),
            Some('и') if stem.ends_with(['к', 'г', 'х']) && ends_in_two_consonants(stem) => {
                zero_ending(stem, false)
            }
            Some('и') if stem.ends_with(['к', 'г', 'х']) => format!("{stem}ов"),
            Some('и') if stem.ends_with(is_vowel) => format!("{stem}й"),
            Some('и') => format!("{stem}ей"),
            Some('а' | 'я') if stem.ends_with("ь") => format!("{}ев", stem),
            Some('а' | 'я') if stem.ends_with("и") => format!("{stem}й"),
            Some('а' | 'я') => zero_ending(stem, false),
            Some('е') => stem.into(),
            _ => return Self::unchanging(word),
        };
        parts
    }

    /// -а, -я: комната, кухня, аллея, лоджия.
    fn first(word: &str) -> Self {
        let stem = drop_last(word, 1);
        let soft = word.ends_with('я');
        let mut parts = Self::new(word, Kind::First, Gender::Feminine);
        let i = soft || stem.ends_with(is_husher_or_velar);
        parts.genitive = format!("{stem}{}", if i { "и" } else { "ы" });
        parts.nominative_plural = parts.genitive.clone();
        let e = soft || stem.ends_with(['ж', 'ш', 'ч', 'щ', 'ц']);
        parts.instrumental = format!("{stem}{}", if e { "ей" } else { "ой" });
        parts.genitive_plural = match stem.chars().last() {
            Some('ь') => format!("{}ий", drop_last(stem, 1)),
            Some('ж' | 'ш' | 'ч' | 'щ')
                if ends_in_two_consonants(stem) && !stem.ends_with("рж") =>
            {
                format!("{stem}ей")
            }
            _ => zero_ending(stem, soft),
        };
        const SURE: [&str; 9] = ["ция", "ика", "ница", "чка", "шка", "ура", "отека", "ина", "ота"];
        parts.evidence = sure_if(SURE.iter().any(|s| word.ends_with(s)));
        parts
    }

    /// -мя: время, знамя.
    fn in_mya(word: &str) -> Self {
        let stem = format!("{}ен", drop_last(word, 1));
        let mut parts = Self::new(word, Kind::Third, Gender::Neuter);
        parts.genitive = format!("{stem}и");
        parts.instrumental = format!("{stem}ем");
        parts.nominative_plural = format!("{stem}а");
        parts.genitive_plural = stem;
        parts
    }

    /// -о, -е: кресло, помещение, полотенце.
    fn neuter(word: &str) -> Self {
        let stem = drop_last(word, 1);
        let mut parts = Self::new(word, Kind::Second, Gender::Neuter);
        let hard = word.ends_with('о') || stem.ends_with(['ц', 'щ', 'ж', 'ш', 'ч']);
        parts.genitive = format!("{stem}{}", if hard { "а" } else { "я" });
        parts.instrumental = format!("{word}м");
        parts.nominative_plural = match () {
            // окошко – окошки, личико – личики; «войско» and «облако» stand in the word list.
            () if ["шко", "чко", "жко", "ико"].iter().any(|e| word.ends_with(e)) => {
                format!("{stem}и")
            }
            () => parts.genitive.clone(),
        };
        parts.genitive_plural = match () {
            () if word.ends_with("ье") || word.ends_with("ьё") => {
                format!("{}ий", drop_last(stem, 1))
            }
            () if stem.ends_with('и') => format!("{stem}й"),
            () if hard => zero_ending(stem, false),
            () => format!("{stem}ей"),
        };
        parts.evidence = sure_if(["ние", "тие", "ство", "ище"].iter().any(|e| word.ends_with(e)));
        parts
    }

    /// A feminine -ь: дверь, ночь, ёмкость.
    fn third(word: &str) -> Self {
        let stem = drop_last(word, 1);
        let mut parts = Self::new(word, Kind::Third, Gender::Feminine);
        parts.genitive = format!("{stem}и");
        parts.instrumental = format!("{word}ю");
        parts.nominative_plural = format!("{stem}и");
        parts.genitive_plural = format!("{stem}ей");
        parts.evidence =
            sure_if(["ость", "есть", "ечь", "ночь", "вь"].iter().any(|e| word.ends_with(e)));
        parts
    }

    /// A masculine -ь: выключатель, фонарь.
    fn masculine_soft(word: &str) -> Self {
        let stem = drop_last(word, 1);
        let mut parts = Self::new(word, Kind::Second, Gender::Masculine);
        parts.genitive = format!("{stem}я");
        let stressed = (word.ends_with("арь") && word.chars().count() < 9) || word.ends_with("ырь");
        parts.instrumental = format!("{stem}{}", if stressed { "ём" } else { "ем" });
        parts.nominative_plural = format!("{stem}и");
        parts.genitive_plural = format!("{stem}ей");
        parts.evidence = sure_if(word.ends_with("тель") && word.chars().count() > 6);
        parts
    }

    /// A consonant or -й: коридор, потолок, музей.
    pub(super) fn masculine(word: &str) -> Self {
        let mut parts = Self::new(word, Kind::Second, Gender::Masculine);
        let (stem, soft, fled) = masculine_stem(word);
        parts.genitive = format!("{stem}{}", if soft { "я" } else { "а" });
        let husher = stem.ends_with(['ж', 'ш', 'ч', 'щ']);
        let unstressed_ts = stem.ends_with('ц') && !has_stressed_ets(word);
        let unstressed = (husher && !has_stressed_husher(word)) || unstressed_ts;
        parts.instrumental = format!("{stem}{}", if soft || unstressed { "ем" } else { "ом" });
        parts.nominative_plural = parts.plural_of_masculine(&stem, soft);
        parts.genitive_plural = match () {
            () if husher => format!("{stem}ей"),
            () if soft || unstressed_ts => format!("{stem}ев"),
            () => format!("{stem}ов"),
        };
        if word.ends_with("анин") || word.ends_with("янин") {
            parts.animacy = Animacy::Animate;
            parts.nominative_plural = format!("{}е", drop_last(word, 2));
            parts.genitive_plural = drop_last(word, 2).into();
        }
        let young = word
            .strip_suffix("ёнок")
            .or_else(|| word.strip_suffix("онок").filter(|stem| stem.ends_with(['ч', 'ж', 'ш'])));
        if let Some(stem) = young {
            let hushed = word.ends_with("онок");
            parts.animacy = Animacy::Animate;
            parts.nominative_plural = format!("{stem}{}", if hushed { "ата" } else { "ята" });
            parts.genitive_plural = format!("{stem}{}", if hushed { "ат" } else { "ят" });
        }
        const SURE: [&str; 12] =
            ["ник", "изм", "ист", "чик", "щик", "метр", "граф", "ент", "ант", "ация", "ум", "атор"];
        parts.evidence = sure_if(!fled && SURE.iter().any(|s| word.ends_with(s)));
        parts
    }

    pub(super) fn into_noun(self) -> Noun {
        let paradigm = self.paradigm();
        Noun {
            gender: self.gender,
            animacy: self.animacy,
            number: self.number,
            evidence: self.evidence,
            paradigm,
        }
    }

    pub(super) fn paradigm(&self) -> Paradigm {
        match (self.kind, Adjective::read(&self.word)) {
            (Kind::Unchanging, _) | (Kind::Adjectival, None) => Paradigm::unchanging(&self.word),
            (Kind::Adjectival, Some(adjective)) => Paradigm::new(|number, case| {
                let number = if self.number == Number::Plural { Number::Plural } else { number };
                adjective.form(case, number, self.gender, self.animacy)
            }),
            _ => {
                let mut paradigm = Paradigm::new(|number, case| match number {
                    Number::Singular if self.number == Number::Singular => self.singular(case),
                    _ => self.plural_form(case),
                });
                if self.kind == Kind::First && self.number == Number::Singular {
                    let rarer = format!("{}ю", drop_last(&self.instrumental, 1));
                    paradigm.variants.push((Number::Singular, Case::Instrumental, rarer));
                }
                paradigm
            }
        }
    }

    pub(super) fn singular(&self, case: Case) -> String {
        let stem = drop_last(&self.genitive, 1);
        let soft = self.genitive.ends_with('я');
        match (case, self.kind) {
            (Case::Nominative, _) => self.word.clone(),
            (Case::Genitive, _) => self.genitive.clone(),
            (Case::Instrumental, _) => self.instrumental.clone(),
            (Case::Locative, _) if self.locative.is_some() => {
                self.locative.clone().unwrap_or_default()
            }
            // путь, дверь, время: one form for genitive, dative and prepositional
            (Case::Dative | Case::Prepositional | Case::Locative, _) if self.is_third_like() => {
                self.genitive.clone()
            }
            (Case::Dative | Case::Prepositional | Case::Locative, Kind::First) => {
                let stem = drop_last(&self.word, 1);
                format!("{stem}{}", if stem.ends_with('и') { "и" } else { "е" })
            }
            (Case::Accusative, Kind::First) => {
                let soft = self.word.ends_with('я');
                format!("{}{}", drop_last(&self.word, 1), if soft { "ю" } else { "у" })
            }
            (Case::Accusative, Kind::Second)
                if self.animacy == Animacy::Animate && self.gender == Gender::Masculine =>
            {
                self.genitive.clone()
            }
            (Case::Accusative, _) => self.word.clone(),
            (Case::Dative, _) => format!("{stem}{}", if soft { "ю" } else { "у" }),
            (Case::Prepositional | Case::Locative, _) => {
                format!("{stem}{}", if stem.ends_with('и') { "и" } else { "е" })
            }
        }
    }

    fn is_third_like(&self) -> bool {
        self.kind == Kind::Third || (self.kind == Kind::Second && self.genitive.ends_with('и'))
    }

    fn plural_form(&self, case: Case) -> String {
        let nominative = &self.nominative_plural;
        let stem = drop_last(nominative, 1);
        let soft = match nominative.chars().last() {
            Some('и') => !stem.ends_with(is_husher_or_velar),
            Some('я') => true,
            _ => false,
        };
        let vowel = if soft { "я" } else { "а" };
        match case {
            Case::Nominative => nominative.clone(),
            Case::Genitive => self.genitive_plural.clone(),
            Case::Accusative if self.animacy == Animacy::Animate => self.genitive_plural.clone(),
            Case::Accusative => nominative.clone(),
            Case::Dative => format!("{stem}{vowel}м"),
            Case::Instrumental => {
                self.instrumental_plural.clone().unwrap_or_else(|| format!("{stem}{vowel}ми"))
            }
            Case::Prepositional | Case::Locative => format!("{stem}{vowel}х"),
        }
    }
}

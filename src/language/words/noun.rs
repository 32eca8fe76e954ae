//! Declension of Russian nouns by principal parts, and the principal parts by ending.
//!
//! A noun is settled by five forms: nominative and genitive singular, instrumental singular, nominative and
//! genitive plural. [`Parts::by_ending`] guesses them from the ending, the word list overrides what it knows, and
//! [`Parts::paradigm`] fills in the rest, where nothing is left to guess.
//! Invariant: the nominative of the noun's own number is the word itself.

use super::adjective::{Adjective, drop_last, is_vowel};
use super::grammar::{Animacy, Case, Evidence, Gender, Number};
use super::lexicon;

/// All forms of one word, in lower case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Paradigm {
    forms: [[String; 7]; 2],
    /// Rarer forms that people also say: «дверьми», «комнатою».
    pub(crate) variants: Vec<(Number, Case, String)>,
}

impl Paradigm {
    pub(crate) fn new(form: impl Fn(Number, Case) -> String) -> Self {
        let forms = Number::BOTH.map(|number| Case::ALL.map(|case| form(number, case)));
        Self { forms, variants: Vec::new() }
    }

    /// A word that has one form only.
    pub(crate) fn unchanging(word: &str) -> Self {
        Self::new(|_, _| word.into())
    }

    pub(crate) fn form(&self, number: Number, case: Case) -> &str {
        &self.forms[number.index()][case.index()]
    }
}

/// A noun in lower case with all its forms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Noun {
    pub(crate) paradigm: Paradigm,
    pub(crate) gender: Gender,
    pub(crate) animacy: Animacy,
    /// The number that the word given stands in.
    pub(crate) number: Number,
    pub(crate) evidence: Evidence,
}

/// What a caller knows of a noun before it is declined.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Known {
    pub(crate) gender: Option<Gender>,
    pub(crate) animacy: Option<Animacy>,
    pub(crate) number: Option<Number>,
}

impl Noun {
    /// Whether it has one form only: «кафе».
    pub(crate) fn is_unchanging(&self) -> bool {
        let nominative = self.paradigm.form(Number::Singular, Case::Nominative);
        Number::BOTH
            .iter()
            .all(|n| Case::SIX.iter().all(|case| self.paradigm.form(*n, *case) == nominative))
    }

    /// Whether it declines as an adjective: «гостиная».
    pub(crate) fn is_adjectival(&self) -> bool {
        let genitive = self.paradigm.form(Number::Plural, Case::Genitive);
        let nominative = self.paradigm.form(Number::Plural, Case::Nominative);
        (genitive.ends_with("ых") || genitive.ends_with("их"))
            && (nominative.ends_with("ые") || nominative.ends_with("ие"))
    }

    /// The noun by the word list, if it is there, and by its ending otherwise.
    pub(crate) fn by_rules(word: &str, known: Known) -> Self {
        let entry = lexicon::find(word);
        let mut parts = Parts::by_ending(word, known, entry);
        if let Some(entry) = entry {
            parts.apply(entry);
        }
        parts.into_noun()
    }
}

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
struct Parts {
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
    fn by_ending(word: &str, known: Known, entry: Option<&lexicon::Entry>) -> Self {
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
    fn apply(&mut self, entry: &lexicon::Entry) {
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
    fn plural(word: &str) -> Self {
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
    fn masculine(word: &str) -> Self {
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

    fn into_noun(self) -> Noun {
        let paradigm = self.paradigm();
        Noun {
            gender: self.gender,
            animacy: self.animacy,
            number: self.number,
            evidence: self.evidence,
            paradigm,
        }
    }

    fn paradigm(&self) -> Paradigm {
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

    fn singular(&self, case: Case) -> String {
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

fn sure_if(sure: bool) -> Evidence {
    if sure { Evidence::Rule } else { Evidence::Guess }
}

fn is_husher_or_velar(letter: char) -> bool {
    matches!(letter, 'к' | 'г' | 'х' | 'ж' | 'ш' | 'ч' | 'щ')
}

fn ends_in_two_consonants(stem: &str) -> bool {
    let mut letters = stem.chars().rev();
    let consonant = |letter: Option<char>| letter.is_some_and(|l| !is_vowel(l) && l != 'ь');
    consonant(letters.next()) && consonant(letters.next())
}

/// Genitive plural without an ending, with the vowel that breaks a cluster: полок, кресел, спален.
fn zero_ending(stem: &str, soft: bool) -> String {
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
fn masculine_stem(word: &str) -> (String, bool, bool) {
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
    const KEEP_OK: [&str; 16] = [
        "урок",
        "срок",
        "поток",
        "приток",
        "исток",
        "восток",
        "сток",
        "водосток",
        "пророк",
        "игрок",
        "порок",
        "зарок",
        "электрошок",
        "волок",
        "подток",
        "водоток",
    ];
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
fn has_stressed_ets(word: &str) -> bool {
    let unstressed =
        ["анец", "янец", "енец", "инец", "овец", "евец", "мец", "лидец", "ерец", "ндец", "ц"];
    word.ends_with("ец") && !unstressed[..10].iter().any(|e| word.ends_with(e))
}

/// Whether -ом follows the sibilant: этажом, ключом, but душем, матчем.
fn has_stressed_husher(word: &str) -> bool {
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
fn is_masculine_soft(word: &str) -> bool {
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
fn is_unchanging(word: &str) -> bool {
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
fn looks_adjectival(word: &str) -> bool {
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
fn looks_plural(word: &str) -> bool {
    word.ends_with('ы')
        || word.ends_with("ане")
        || word.ends_with("яне")
        || (word.ends_with('и') && !drop_last(word, 1).is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(word: &str, expected: &str) {
        let noun = Noun::by_rules(word, Known::default());
        let all =
            |number| Case::SIX.map(|case| noun.paradigm.form(number, case).to_owned()).join(" ");
        let singular = if noun.number == Number::Plural {
            String::new()
        } else {
            format!("{} / ", all(Number::Singular))
        };
        assert_eq!(format!("{singular}{}", all(Number::Plural)), expected);
    }

    #[test]
    fn endings_alone_decline_what_no_list_holds() {
        check(
            "ступица",
            "ступица ступицы ступице ступицу ступицей ступице / ступицы ступиц ступицам ступицы ступицами ступицах",
        );
        check(
            "станция",
            "станция станции станции станцию станцией станции / станции станций станциям станции станциями станциях",
        );
        check(
            "задвижка",
            "задвижка задвижки задвижке задвижку задвижкой задвижке / задвижки задвижек задвижкам задвижки задвижками задвижках",
        );
        check(
            "черепок",
            "черепок черепка черепку черепок черепком черепке / черепки черепков черепкам черепки черепками черепках",
        );
        check(
            "обогреватель",
            "обогреватель обогревателя обогревателю обогреватель обогревателем обогревателе / обогреватели обогревателей обогревателям обогреватели обогревателями обогревателях",
        );
        check(
            "хранилище",
            "хранилище хранилища хранилищу хранилище хранилищем хранилище / хранилища хранилищ хранилищам хранилища хранилищами хранилищах",
        );
        check(
            "санаторий",
            "санаторий санатория санаторию санаторий санаторием санатории / санатории санаториев санаториям санатории санаториями санаториях",
        );
        check(
            "пристань",
            "пристань пристани пристани пристань пристанью пристани / пристани пристаней пристаням пристани пристанями пристанях",
        );
        check(
            "патио",
            &["патио"; 12].join(" ").replacen(
                "патио патио патио патио патио патио ",
                "патио патио патио патио патио патио / ",
                1,
            ),
        );
        check(
            "мойка",
            "мойка мойки мойке мойку мойкой мойке / мойки моек мойкам мойки мойками мойках",
        );
    }

    /// Household nouns that the word list does not hold: what the endings do with words never seen.
    #[cfg(feature = "rumorph")]
    const UNSEEN: &str = "абажур альбом баллон барабан башня билет блюдо блюдце бочка брелок брошюра будильник бутыль \
        вазон вентилятор верёвка витрина водонагреватель выдвижение газета гардероб гвоздика гирлянда гитара глобус \
        горшок градусник графин гребёнка громкость губка датчик держатель диск документ домофон досуг жакет жалоба \
        желоб живопись зажигалка зонт игла изголовье икона инструмент кабина календарь калькулятор камера канистра \
        карниз кассета кафель клапан клетка клеёнка книжка ковёрчик кожух козырёк колонка колонна комбайн конверт \
        кондиционер консервы контейнер копилка копирка корыто косметичка кофеварка кофта крем крестовина крышка куртка \
        лейка лекция линейка линолеум лоток лупа мангал манекен маска матрас машина мебелька мельница микроскоп миксер \
        модем молоток морозилка мотор мыло мыльница набор накидка насос наволочка нитка ноутбук обогрев обувница огонёк \
        ограда окошко опора отвёртка отделение отопление павильон пакет палитра палка пальма панно пар паркет пылесос \
        пепельница перегородка перчатка печенье пила пинцет платок плафон плед плитка поднос подпорка подсвечник \
        подставка покрывало портрет посуда почта предохранитель прибор провод прожектор простыня пряжа пуговица пузырёк \
        радиатор рама расчёска ремешок решётка рисунок рукомойник рулон рюкзак самовар сахарница свёрток сервер \
        сигнализация сито скобка скульптура совок солонка статуэтка стенд стойло стремянка ступенька сумка сундук \
        сушилка счётчик тапка термометр термос терминал ткань тряпка труба туфля угольник удлинитель украшение урок \
        утюг фартук фен фильтр флакон фляга фонарик форма форточка холст хранение цветочница цифра чехол чайничек \
        чемодан черепица чернила шкатулка шланг шпатель щётка щипчики этажерка этикетка юбка юла якорь ящичек";

    #[cfg(feature = "rumorph")]
    #[test]
    fn endings_alone_are_right_on_unseen_nouns() {
        let (mut good, mut all) = (0, 0);
        let mut wrong = String::new();
        for word in UNSEEN.split_whitespace().filter(|word| lexicon::find(word).is_none()) {
            let Some(truth) = super::super::dictionary::noun(word, Known::default()) else {
                continue;
            };
            let (right, of) = agreement(&truth, &Noun::by_rules(word, Known::default()));
            if right < of {
                wrong.push_str(word);
                wrong.push(' ');
            }
            good += right;
            all += of;
        }
        assert!(all > 2000, "only {all} forms compared");
        assert!(good * 100 >= all * 97, "{good} of {all} forms; wrong: {wrong}");
    }

    #[cfg(feature = "rumorph")]
    #[test]
    fn the_word_list_agrees_with_the_dictionary() {
        let (mut good, mut all) = (0, 0);
        for (word, entry) in lexicon::all().filter(|(_, entry)| !entry.plural_only) {
            let Some(truth) = super::super::dictionary::noun(
                word,
                Known { gender: entry.gender, ..Known::default() },
            ) else {
                continue;
            };
            let (right, of) = agreement(
                &truth,
                &Noun::by_rules(word, Known { animacy: Some(truth.animacy), ..Known::default() }),
            );
            good += right;
            all += of;
        }
        assert!(good * 100 >= all * 98, "{good} of {all} forms agree");
    }

    /// Forms on which two readings of a noun agree, and forms compared. A missing plural is no disagreement.
    #[cfg(feature = "rumorph")]
    fn agreement(truth: &Noun, ours: &Noun) -> (usize, usize) {
        let yo = |form: &str| form.replace('ё', "е");
        let has_plural = truth.paradigm.form(Number::Plural, Case::Dative)
            != truth.paradigm.form(Number::Singular, Case::Dative);
        let numbers = if has_plural { &Number::BOTH[..] } else { &Number::BOTH[..1] };
        let pairs = numbers.iter().flat_map(|number| Case::SIX.map(|case| (*number, case)));
        let right = pairs.clone().filter(|(number, case)| {
            let form = yo(ours.paradigm.form(*number, *case));
            let rarer = truth
                .paradigm
                .variants
                .iter()
                .any(|(n, c, v)| (n, c) == (number, case) && yo(v) == form);
            rarer || yo(truth.paradigm.form(*number, *case)) == form
        });
        (right.count(), pairs.count())
    }
}

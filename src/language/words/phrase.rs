//! Noun phrases: any name that a map may give to a room, a door, a thing.
//!
//! A name has a head, the words that agree with it, and a tail that stays as it is: in «Большой письменный стол
//! директора» the head is «стол», two adjectives go with it, «директора» stays. «Комната-В» has the head «Комната»
//! and the tag «В»; in «кресло-качалка» both parts decline; «Гостиная 2» is an adjective that became the head.
//!
//! Invariant: the nominative in the name's own number is the name itself, letter for letter.
//!
//! ```
//! use orthoframe::language::{Case, NounPhrase, WordHints};
//! let room = NounPhrase::parse("Комната-В", &WordHints::default());
//! assert_eq!(room.case(Case::Genitive), "Комнаты-В");
//! let desk = NounPhrase::parse("Письменный стол", &WordHints::default());
//! assert_eq!(desk.case(Case::Instrumental), "Письменным столом");
//! ```

use std::collections::BTreeMap;

use unicode_normalization::UnicodeNormalization;

use super::adjective::Adjective;
use super::dictionary;
use super::grammar::{Animacy, Case, Evidence, Gender, Number, PlaceSense, WordHints};
use super::letters::{Run, is_acronym, recase, runs, to_cyrillic};
use super::lexicon;
use super::noun::{Known, Noun};
use super::russian::Counted;

/// A name with all its forms. See the [module](self).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NounPhrase {
    name: String,
    pieces: Vec<Piece>,
    gender: Gender,
    animacy: Animacy,
    number: Number,
    place: PlaceSense,
    evidence: Evidence,
    given: BTreeMap<(Number, Case), String>,
    /// The head in lower case, the key of the word list.
    head: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Piece {
    Fixed(String),
    Noun {
        written: String,
        noun: Box<Noun>,
    },
    Agreeing {
        written: String,
        adjective: Adjective,
    },
    /// «2-й»: the digits stay, the ending agrees.
    Ordinal {
        digits: String,
        ending: Adjective,
    },
}

impl NounPhrase {
    /// Reads a name. Never fails: what cannot be declined stays as it is, and [`Self::is_certain`] tells.
    #[must_use]
    pub fn parse(name: &str, hints: &WordHints) -> Self {
        let name: String = name.nfc().collect();
        Parser::new(&name, hints).parse()
    }

    /// The name as it was given, in NFC.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The form in this case and number. A name that stands in the plural has no singular: it gives the plural.
    #[must_use]
    pub fn form(&self, case: Case, number: Number) -> String {
        let number = if self.number == Number::Plural { Number::Plural } else { number };
        if let Some(form) = self.given_form(case, number) {
            return form.into();
        }
        if (case, number) == (Case::Nominative, self.number) {
            return self.name.clone();
        }
        self.pieces.iter().map(|piece| self.piece(piece, case, number)).collect()
    }

    /// The form in this case, in the name's own number.
    #[must_use]
    pub fn case(&self, case: Case) -> String {
        self.form(case, self.number)
    }

    /// The form after this number in the nominative: «2 двери», «5 дверей», «3 больших стола».
    #[must_use]
    pub fn counted(&self, number: u64) -> String {
        let counted = Counted::of(number);
        if self.head() == Some("человек") && counted == Counted::Many {
            return self.form(Case::Nominative, Number::Singular);
        }
        match counted {
            Counted::One => self.form(Case::Nominative, Number::Singular),
            Counted::Many => self.form(Case::Genitive, Number::Plural),
            Counted::Few if !self.given.is_empty() => self.form(Case::Genitive, Number::Singular),
            Counted::Few => {
                // An adjective after 2, 3, 4 stands in the plural: «2 гостиные», «2 больших стола».
                let case =
                    if self.gender == Gender::Feminine { Case::Nominative } else { Case::Genitive };
                let of = |piece: &Piece| match piece {
                    Piece::Noun { noun, .. } if !noun.is_adjectival() => {
                        self.piece(piece, Case::Genitive, Number::Singular)
                    }
                    _ => self.piece(piece, case, Number::Plural),
                };
                self.pieces.iter().map(of).collect()
            }
        }
    }

    /// Every form that people may use, rarer ones too, with what it is a form of. Each (case, number) occurs.
    #[must_use]
    pub fn all_forms(&self) -> Vec<(Number, Case, String)> {
        let both = [Number::Singular, Number::Plural];
        let numbers = if self.number == Number::Plural { &both[1..] } else { &both[..] };
        let mut forms = Vec::new();
        for &number in numbers {
            for case in Case::ALL {
                forms.push((number, case, self.form(case, number)));
            }
        }
        for (at, piece) in self.pieces.iter().enumerate() {
            let Piece::Noun { written, noun } = piece else { continue };
            for (number, case, variant) in &noun.paradigm.variants {
                let whole =
                    self.pieces.iter().enumerate().map(|(other, piece)| match other == at {
                        true => recase(written, variant),
                        false => self.piece(piece, *case, *number),
                    });
                forms.push((*number, *case, whole.collect()));
            }
        }
        forms
    }

    #[must_use]
    pub fn gender(&self) -> Gender {
        self.gender
    }

    #[must_use]
    pub fn animacy(&self) -> Animacy {
        self.animacy
    }

    /// The number that the name stands in.
    #[must_use]
    pub fn number(&self) -> Number {
        self.number
    }

    /// Whether one says «в» or «на» of this place.
    #[must_use]
    pub fn place(&self) -> PlaceSense {
        self.place
    }

    /// How the least certain of its words was declined.
    #[must_use]
    pub fn evidence(&self) -> Evidence {
        self.evidence
    }

    /// Whether no word was declined by a mere guess from its ending.
    #[must_use]
    pub fn is_certain(&self) -> bool {
        let six = |number| {
            Case::SIX
                .iter()
                .all(|case| self.given.contains_key(&(number, *case)) || *case == Case::Nominative)
        };
        self.evidence < Evidence::Guess || six(self.number)
    }

    /// The head in lower case, nominative: «стол» of «Письменный стол директора».
    #[must_use]
    pub fn head(&self) -> Option<&str> {
        self.head.as_deref()
    }

    fn given_form(&self, case: Case, number: Number) -> Option<&str> {
        let given = |case| self.given.get(&(number, case)).map(String::as_str);
        given(case).or_else(|| match case {
            Case::Locative => given(Case::Prepositional),
            Case::Accusative => match (self.animacy, number, self.gender) {
                (Animacy::Animate, Number::Plural, _)
                | (Animacy::Animate, _, Gender::Masculine) => given(Case::Genitive),
                _ => None,
            },
            _ => None,
        })
    }

    fn piece(&self, piece: &Piece, case: Case, number: Number) -> String {
        match piece {
            Piece::Fixed(text) => text.clone(),
            Piece::Noun { written, noun } => {
                let number = if noun.number == Number::Plural { Number::Plural } else { number };
                recase(written, noun.paradigm.form(number, case))
            }
            Piece::Agreeing { written, adjective } => {
                recase(written, &adjective.form(case, number, self.gender, self.animacy))
            }
            Piece::Ordinal { digits, ending } => {
                let form = ending.form(case, number, self.gender, self.animacy);
                format!("{digits}{}", ordinal_suffix(&form))
            }
        }
    }
}

/// «-я», «-го»: the last letter of the ordinal, or the last two after a vowel and consonant, as it is written.
fn ordinal_suffix(form: &str) -> String {
    let letters: Vec<char> = form.chars().collect();
    let keep = if form.ends_with("ого")
        || form.ends_with("его")
        || form.ends_with("ому")
        || form.ends_with("ему")
        || form.ends_with("ыми")
    {
        2
    } else {
        1
    };
    letters[letters.len() - keep..].iter().collect()
}

/// Words after which a tail begins.
const PREPOSITIONS: [&str; 24] = [
    "у",
    "в",
    "во",
    "на",
    "с",
    "со",
    "для",
    "из",
    "под",
    "над",
    "при",
    "к",
    "ко",
    "о",
    "об",
    "от",
    "до",
    "за",
    "по",
    "без",
    "около",
    "возле",
    "рядом",
    "между",
];

/// First parts of compounds that never decline.
const FIXED_FIRST: [&str; 30] = [
    "мини",
    "макси",
    "супер",
    "веб",
    "видео",
    "аудио",
    "фото",
    "арт",
    "бизнес",
    "конференц",
    "пресс",
    "интернет",
    "онлайн",
    "лаунж",
    "спа",
    "фитнес",
    "вип",
    "евро",
    "экс",
    "вице",
    "тест",
    "блок",
    "зип",
    "офис",
    "чил",
    "смарт",
    "робот",
    "нью",
    "медиа",
    "кофе",
];

struct Parser<'a> {
    name: &'a str,
    hints: &'a WordHints,
    runs: Vec<Run<'a>>,
    pieces: Vec<Piece>,
    head: Option<(String, Noun)>,
    evidence: Evidence,
    coordinated: bool,
}

/// Words joined by hyphens: `runs[from..to]`, words and the hyphens between them.
#[derive(Clone, Copy)]
struct Group {
    from: usize,
    to: usize,
}

impl<'a> Parser<'a> {
    fn new(name: &'a str, hints: &'a WordHints) -> Self {
        let (runs, pieces) = (runs(name), Vec::new());
        Self {
            name,
            hints,
            runs,
            pieces,
            head: None,
            evidence: Evidence::Given,
            coordinated: false,
        }
    }

    fn parse(mut self) -> NounPhrase {
        let groups = self.groups();
        let mut at_head = true;
        let mut tail = false;
        let mut next_run = 0;
        for (index, group) in groups.iter().enumerate() {
            let gap = self.gap(next_run, group.from);
            self.pieces.push(Piece::Fixed(gap.to_owned()));
            next_run = group.to;
            let word = self.text(*group);
            let joins = |text: &str| text.contains('/') || text.contains('+') || text.contains('&');
            if !at_head
                && !tail
                && (word == "и" || joins(gap))
                && self.may_restart(&groups[index..])
            {
                at_head = true;
                self.coordinated = true;
            }
            if tail
                || word == "и"
                || PREPOSITIONS.contains(&word)
                || gap.contains(['(', '"', '«', '“']) && !at_head
            {
                tail |= word != "и";
                self.fixed(*group);
            } else if at_head && self.is_modifier(*group, &groups[index + 1..]) {
                self.agreeing(*group);
            } else if at_head {
                at_head = !self.noun(*group);
            } else if !self.coordinated && self.agrees_with_head(*group) {
                self.agreeing(*group);
            } else {
                tail |= self.is_word(*group);
                self.fixed(*group);
            }
        }
        let rest = self.gap(next_run, self.runs.len());
        self.pieces.push(Piece::Fixed(rest.to_owned()));
        self.finish()
    }

    fn finish(self) -> NounPhrase {
        let noun = self.head.as_ref().map(|(_, noun)| noun);
        let entry = self.head.as_ref().and_then(|(head, _)| lexicon::find(head));
        let own = self.hints.number.unwrap_or(match noun {
            Some(_) if self.coordinated => Number::Singular,
            Some(noun) => noun.number,
            None => Number::Singular,
        });
        NounPhrase {
            name: self.name.to_owned(),
            gender: self.hints.gender.or(noun.map(|n| n.gender)).unwrap_or(Gender::Neuter),
            animacy: self.hints.animacy.or(noun.map(|n| n.animacy)).unwrap_or_default(),
            number: own,
            place: self.hints.place.or(entry.map(lexicon::Entry::place)).unwrap_or_default(),
            evidence: if noun.is_none() && self.name.chars().any(is_cyrillic_lower) {
                Evidence::Guess
            } else {
                self.evidence
            },
            given: self.hints.forms.clone(),
            head: self.head.map(|(head, _)| head),
            pieces: self.pieces,
        }
    }

    fn groups(&self) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for (at, run) in self.runs.iter().enumerate().filter(|(_, run)| run.is_word) {
            match groups.last_mut() {
                Some(group)
                    if group.to + 1 == at
                        && self.runs[group.to].is_hyphen()
                        && !run.text.is_empty() =>
                {
                    group.to = at + 1;
                }
                _ => groups.push(Group { from: at, to: at + 1 }),
            }
        }
        groups
    }

    fn gap(&self, from: usize, to: usize) -> &'a str {
        match self.runs.get(from..to) {
            Some([first, .., last]) => &self.name[first.at..last.at + last.text.len()],
            Some([only]) => only.text,
            _ => "",
        }
    }

    fn text(&self, group: Group) -> &'a str {
        self.gap(group.from, group.to)
    }

    fn words(&self, group: Group) -> impl Iterator<Item = &Run<'a>> {
        self.runs[group.from..group.to].iter().filter(|run| run.is_word)
    }

    /// Whether some part of the group is a word that may decline.
    fn is_word(&self, group: Group) -> bool {
        self.words(group).any(|run| is_declinable(run.text))
    }

    fn fixed(&mut self, group: Group) {
        self.pieces.push(Piece::Fixed(self.text(group).to_owned()));
    }

    /// The adjective of a group: «письменный», «северо-западная», «2-й».
    fn adjective(&self, group: Group) -> Option<(String, Adjective)> {
        let mut words = self.words(group).collect::<Vec<_>>();
        let last = words.pop()?;
        let lower = to_cyrillic(last.text).to_lowercase();
        if let [digits] = words[..]
            && digits.text.chars().all(|c| c.is_ascii_digit())
        {
            return ordinal(&lower).map(|ending| (String::new(), ending));
        }
        if !is_declinable(last.text)
            || !words.iter().all(|word| word.text.to_lowercase().ends_with(['о', 'е']))
        {
            return None;
        }
        let readings = dictionary::readings(&lower);
        if readings.adjective
            && let Some(possessive) = Adjective::read_possessive(&lower)
        {
            return Some((lower, possessive));
        }
        Adjective::read(&lower)
            .filter(|_| {
                !readings.known
                    || readings.adjective
                    || lexicon::find(&lower).is_some_and(|e| e.adjectival)
            })
            .map(|adjective| (lower, adjective))
    }

    /// Whether the group is an adjective before the head: «Большой» of «Большой зал», not «Приёмная» of «Приёмная директора».
    fn is_modifier(&self, group: Group, after: &[Group]) -> bool {
        let Some((_, adjective)) = self.adjective(group) else { return false };
        let Some(next) = after.first() else { return false };
        let Some(first) = self.words(*next).next() else { return false };
        let word = to_cyrillic(first.text).to_lowercase();
        if PREPOSITIONS.contains(&word.as_str()) || !is_declinable(first.text) {
            return false;
        }
        if let Some((_, another)) = self.adjective(*next) {
            return another.number() == adjective.number()
                && another.gender() == adjective.gender();
        }
        if !is_nominative(&word) {
            return false;
        }
        let noun = resolve(&word, Known::default());
        noun.number == adjective.number()
            && (noun.number == Number::Plural || noun.gender == adjective.gender())
    }

    fn agrees_with_head(&self, group: Group) -> bool {
        match (self.adjective(group), &self.head) {
            (Some((_, adjective)), Some((_, head))) => {
                adjective.number() == head.number
                    && (head.number == Number::Plural || adjective.gender() == head.gender)
            }
            _ => false,
        }
    }

    fn agreeing(&mut self, group: Group) {
        let Some((lower, adjective)) = self.adjective(group) else { return self.fixed(group) };
        let last = group.to - 1;
        if lower.is_empty() {
            let digits = self.gap(group.from, last).to_owned();
            self.pieces.push(Piece::Ordinal { digits, ending: adjective });
        } else {
            self.pieces.push(Piece::Fixed(self.gap(group.from, last).to_owned()));
            self.pieces
                .push(Piece::Agreeing { written: self.runs[last].text.to_owned(), adjective });
        }
    }

    /// After «и»: another head follows only if the next word can be a nominative.
    fn may_restart(&self, groups: &[Group]) -> bool {
        let conjunction = groups.first().is_some_and(|group| self.text(*group) == "и");
        let next = groups.get(usize::from(conjunction));
        next.and_then(|group| self.words(*group).next()).is_some_and(|run| {
            let lower = to_cyrillic(run.text).to_lowercase();
            is_declinable(run.text)
                && (is_nominative(&lower) || dictionary::readings(&lower).adjective)
        })
    }

    /// Declines the group as the head. False when nothing in it declines, so that the head is still to come.
    fn noun(&mut self, group: Group) -> bool {
        let known = Known {
            gender: self.hints.gender,
            animacy: self.hints.animacy,
            number: self.hints.number,
        };
        let whole = to_cyrillic(self.text(group)).to_lowercase();
        let parts = self.words(group).count();
        if parts > 1
            && self.words(group).all(|run| is_declinable(run.text))
            && let Some(noun) = dictionary::noun(&whole, known)
        {
            self.take(self.text(group), &whole, noun);
            return true;
        }
        let mut found = false;
        let mut stopped = false;
        for at in group.from..group.to {
            let run = &self.runs[at];
            let text = run.text;
            let lower = to_cyrillic(text).to_lowercase();
            stopped |= found && PREPOSITIONS.contains(&lower.as_str());
            let fixed = !run.is_word
                || stopped
                || !is_declinable(text)
                || (at + 1 < group.to && FIXED_FIRST.contains(&lower.as_str()));
            if fixed {
                self.pieces.push(Piece::Fixed(text.to_owned()));
            } else {
                let known = if found { Known::default() } else { known };
                self.take(text, &lower, resolve(&lower, known));
                found = true;
            }
        }
        found
    }

    fn take(&mut self, written: &str, lower: &str, noun: Noun) {
        self.evidence = self.evidence.max(noun.evidence);
        self.pieces.push(Piece::Noun { written: written.to_owned(), noun: Box::new(noun.clone()) });
        if self.head.is_none() {
            self.head = Some((lower.to_owned(), noun));
        }
    }
}

/// The noun by the word list, then the dictionary, then its ending.
pub(crate) fn resolve(word: &str, known: Known) -> Noun {
    if lexicon::find(word).is_some() {
        return Noun::by_rules(word, known);
    }
    dictionary::noun(word, known).unwrap_or_else(|| Noun::by_rules(word, known))
}

/// Whether the word can be the nominative of a noun, as far as anything here knows it.
fn is_nominative(word: &str) -> bool {
    let readings = dictionary::readings(word);
    lexicon::find(word).is_some() || readings.noun || !readings.known
}

/// Words that decline: Cyrillic, at least two letters, no digits, no abbreviation.
fn is_declinable(word: &str) -> bool {
    let cyrillic = to_cyrillic(word);
    let all = cyrillic.chars().all(|c| {
        ('а'..='я').contains(&c.to_lowercase().next().unwrap_or(c)) || matches!(c, 'ё' | 'Ё')
    });
    if !all || cyrillic.chars().count() < 2 {
        return false;
    }
    !is_acronym(&cyrillic) || {
        let lower = cyrillic.to_lowercase();
        let known = lexicon::find(&lower).is_some()
            || dictionary::noun(&lower, Known::default()).is_some()
            || dictionary::readings(&lower).adjective;
        known || (cyrillic.chars().count() > 5 && lower.chars().any(super::adjective::is_vowel))
    }
}

/// The adjective whose ending follows the digits of an ordinal.
fn ordinal(suffix: &str) -> Option<Adjective> {
    match suffix {
        "й" | "ый" | "ой" | "ий" => Adjective::read("первый"),
        "я" | "ая" => Adjective::read("первая"),
        "е" | "ое" => Adjective::read("первое"),
        _ => None,
    }
}

fn is_cyrillic_lower(c: char) -> bool {
    ('а'..='я').contains(&c) || c == 'ё'
}

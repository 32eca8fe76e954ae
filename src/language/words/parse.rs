//! Reading a name: which word is its head, which agree with it, which stay as they are.
//!
//! Words are read from left to right: adjectives that agree with what follows, the head, adjectives that agree with
//! the head, a tail that begins at a preposition, a bracket or any other word and never declines.
//!
//! Invariant: the pieces in the nominative, put together, are the name.

use unicode_normalization::UnicodeNormalization;

use super::adjective::Adjective;
use super::dictionary;
use super::grammar::{Animacy, Evidence, Gender, Number, WordHints};
use super::letters::{Run, is_acronym, runs, to_cyrillic};
use super::lexicon;
use super::noun::{self, Known, Noun};
use super::number::Cardinal;
use super::phrase::{NounPhrase, Piece};
use crate::sets::Set;

/// Words after which a tail begins.
static PREPOSITIONS: Set = Set::named("EndsName");

/// First parts of compounds that never decline.
static FIXED_FIRST: Set = Set::named("FirstPart");

struct Parser<'a> {
    name: &'a str,
    hints: &'a WordHints,
    runs: Vec<Run<'a>>,
    pieces: Vec<Piece>,
    head: Option<(String, Noun)>,
    evidence: Evidence,
    coordinated: bool,
    /// The head has several words: «кухня-гостиная», which is «в», though «кухня» is «на».
    compound: bool,
    /// A word of it ends in a full stop, or it is told by an abbreviation that does not decline.
    abbreviated: bool,
}

/// What stands before the word that may be the head.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Short {
    /// «каб.»
    Cut,
    /// «ПК», «LED»
    Acronym,
}

/// Words joined by hyphens: `runs[from..to]`, words and the hyphens between them.
#[derive(Clone, Copy)]
struct Group {
    from: usize,
    to: usize,
}

impl NounPhrase {
    /// Reads a name. Never fails: what cannot be declined stays as it is, and [`Self::is_certain`] tells.
    #[must_use]
    pub fn parse(name: &str, hints: &WordHints) -> Self {
        let name: String = name.nfc().collect();
        Parser::new(&name, hints).parse()
    }
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
            compound: false,
            abbreviated: false,
        }
    }

    pub(super) fn parse(mut self) -> NounPhrase {
        let groups = self.groups();
        let mut at_head = true;
        let mut tail = false;
        let mut next_run = 0;
        let mut short = None;
        let counted = if self.counted(&groups) { 2 } else { 0 };
        if counted > 0 {
            (at_head, next_run) = (false, groups[1].to);
        }
        for (index, group) in groups.iter().enumerate().skip(counted) {
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
            let joint = matches!(word, "и" | "или");
            let cut = self.is_cut(*group, &groups[index + 1..]);
            self.abbreviated |= cut;
            // «Каб. директора», «ПК бухгалтера»: what the abbreviation stands for is the head.
            if at_head && !cut && short.is_some_and(|before| !self.may_head(*group, before)) {
                (at_head, tail, self.abbreviated) = (false, true, true);
            }
            if cut
                || tail
                || joint
                || PREPOSITIONS.contains(&word)
                || gap.contains(['(', '"', '«', '“']) && (!at_head || short.is_some())
            {
                tail |= !joint && !cut;
                short = short.or(cut.then_some(Short::Cut));
                self.fixed(*group);
            } else if at_head && self.is_modifier(*group, &groups[index + 1..]) {
                self.agreeing(*group);
            } else if at_head {
                at_head = !self.noun(*group);
                let is_acronym = at_head && word.chars().any(char::is_alphabetic);
                short = short.or(is_acronym.then_some(Short::Acronym));
            } else if !self.coordinated
                && self.agrees_with_head(*group)
                && !self.begins_complement(*group, &groups[index + 1..])
            {
                self.agreeing(*group);
            } else if self.is_second_name(*group) {
                self.noun(*group);
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
            place: self
                .hints
                .place
                .or(entry.filter(|_| !self.compound).map(lexicon::Entry::place))
                .unwrap_or_default(),
            evidence: match noun {
                Some(_) => self.evidence,
                None if !self.abbreviated && self.name.chars().any(is_cyrillic_lower) => {
                    Evidence::Guess
                }
                None => Evidence::Rule,
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
                        && (self.runs[group.to].is_hyphen() || self.is_slashed(at))
                        && !run.text.is_empty() =>
                {
                    group.to = at + 1;
                }
                _ => groups.push(Group { from: at, to: at + 1 }),
            }
        }
        groups
    }

    /// Whether a slash joins this letter and the one before: «б/у», «х/б».
    fn is_slashed(&self, at: usize) -> bool {
        let is_letter = |run: &Run<'_>| run.text.chars().count() == 1;
        self.runs[at - 1].text == "/" && is_letter(&self.runs[at - 2]) && is_letter(&self.runs[at])
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
        if (readings.adjective || is_possessor(&lower))
            && let Some(possessive) = Adjective::read_possessive(&lower)
        {
            return Some((lower, possessive));
        }
        Adjective::read(&lower)
            .filter(|_| {
                !readings.known
                    || readings.adjective
                    // A participle: «переносимая вещь».
                    || !readings.noun
                    || lexicon::find(&lower).is_some_and(|e| e.adjectival)
            })
            .map(|adjective| (lower, adjective))
    }

    /// Whether the group is an adjective before the head: «Большой» of «Большой зал», not «Приёмная» of «Приёмная директора».
    fn is_modifier(&self, group: Group, after: &[Group]) -> bool {
        let Some((lower, adjective)) = self.adjective(group) else { return false };
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
        // «Приёмная директора»: a room of the list is no adjective before a word that nothing knows.
        let room = lexicon::find(&lower).is_some();
        if !is_nominative(&word)
            || (room && lexicon::find(&word).is_none() && !dictionary::readings(&word).noun)
        {
            return false;
        }
        let noun = resolve(&word, Known::default());
        noun.number == adjective.number()
            && (noun.number == Number::Plural || noun.gender == adjective.gender())
    }

    /// Whether a word is cut short: «Каб. 203», «Ком-та 5», «Б/у стол».
    fn is_cut(&self, group: Group, after: &[Group]) -> bool {
        let word = self.text(group);
        let stopped = word.chars().count() <= 5
            && self.gap(group.to, self.runs.len()).starts_with('.')
            && (!after.is_empty() || !dictionary::readings(&word.to_lowercase()).known);
        let ends_short = match self.words(group).collect::<Vec<_>>()[..] {
            [first, last] => {
                (1..=2).contains(&last.text.chars().count())
                    && last.text.chars().all(is_cyrillic_lower)
                    && !first.text.chars().any(char::is_numeric)
            }
            _ => false,
        };
        stopped || ends_short || word.contains('/')
    }

    /// Whether a word behind an abbreviation can be what the name is about: «Конф. зал», «LED лампы», not «Каб. врача».
    fn may_head(&self, group: Group, before: Short) -> bool {
        let Some(run) = self.words(group).next().filter(|run| is_declinable(run.text)) else {
            return true;
        };
        let lower = to_cyrillic(run.text).to_lowercase();
        let readings = dictionary::readings(&lower);
        let known = |number| Known { number: Some(number), ..Known::default() };
        let listed = lexicon::find(&lower).is_some() || self.adjective(group).is_some();
        let singular = || dictionary::noun(&lower, known(Number::Singular)).is_some();
        let things = || {
            let plural = dictionary::noun(&lower, known(Number::Plural));
            plural.is_some_and(|noun| noun.animacy == Animacy::Inanimate)
        };
        listed || !readings.known || singular() || (before == Short::Acronym && things())
    }

    /// Whether an adjective is of a complement in the genitive: «Тюбик зубной пасты», unlike «Шкаф угловой».
    fn begins_complement(&self, group: Group, after: &[Group]) -> bool {
        let feminine = |group: &&Group| self.text(**group).ends_with(['й']);
        let noun = after.iter().find(|group| !feminine(group)).map(|group| self.text(*group));
        self.text(group).ends_with("ой")
            && noun.is_some_and(|noun| {
                noun.chars().count() > 2
                    && noun.starts_with(char::is_lowercase)
                    && noun.ends_with(['ы', 'и'])
            })
    }

    fn agrees_with_head(&self, group: Group) -> bool {
        let capital = self.text(group).starts_with(char::is_uppercase);
        match (self.adjective(group), &self.head) {
            // «Стол Петровой»
            (Some((lower, _)), Some(_))
                if capital && {
                    let readings = dictionary::readings(&lower);
                    let surname = ["овой", "евой", "ёвой", "иной", "ыной"];
                    readings.surname
                        || (!readings.adjective && surname.iter().any(|end| lower.ends_with(end)))
                } =>
            {
                false
            }
            (Some((_, adjective)), Some((_, head))) => {
                adjective.number() == head.number
                    && (head.number == Number::Plural || adjective.gender() == head.gender)
            }
            _ => false,
        }
    }

    /// A person's or an animal's next name declines with the first: «Иван Петрович», «Кот Барсик»; so does a person's
    /// first name behind anything: «Кукла Маша».
    fn is_second_name(&self, group: Group) -> bool {
        let Some((_, head)) = &self.head else { return false };
        let capital = self.text(group).starts_with(char::is_uppercase);
        let words = self.words(group).map(|run| to_cyrillic(run.text).to_lowercase());
        let words: Vec<String> = words.collect();
        let named = || words.iter().all(|word| dictionary::readings(word).first_name);
        (head.animacy == Animacy::Animate || named())
            && head.number == Number::Singular
            && capital
            && self.is_word(group)
            && words.iter().all(|word| is_nominative(word))
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
        let listed = |run: &Run<'_>| lexicon::find(&run.text.to_lowercase()).is_some();
        if parts > 1
            && !self.words(group).all(listed)
            && self.words(group).all(|run| is_declinable(run.text))
            && let Some(noun) = dictionary::noun(&whole, known)
        {
            self.compound = true;
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
                || (FIXED_FIRST.contains(&lower.as_str()) && self.is_before_another(at, group))
                // «точка-сбора»: the second is of the first.
                || (found && is_oblique(&lower));
            if fixed {
                self.pieces.push(Piece::Fixed(text.to_owned()));
            } else {
                self.compound |= found;
                let known = match &self.head {
                    // What follows a living head is its name: «Кот Барсик».
                    Some((_, head)) => Known {
                        animacy: Some(head.animacy),
                        number: (head.animacy == Animacy::Animate && !self.coordinated)
                            .then_some(head.number),
                        ..Known::default()
                    },
                    None => known,
                };
                self.take(text, &lower, resolve(&lower, known));
                found = true;
            }
        }
        found
    }

    /// Whether a word of a group stands before another that may be its head: «мини-бар», «смарт-ТВ», not «офис-2».
    fn is_before_another(&self, at: usize, group: Group) -> bool {
        let letters = |run: &Run<'_>| run.text.chars().filter(|c| c.is_alphabetic()).count();
        self.runs[at + 1..group.to].iter().any(|run| run.is_word && letters(run) > 1)
    }

    /// «Два стула»: the number and the noun that it governs, which stand in the nominative as they are written.
    fn counted(&mut self, groups: &[Group]) -> bool {
        let [number, noun, ..] = groups else { return false };
        let Some(cardinal) = Cardinal::read(&self.text(*number).to_lowercase()) else {
            return false;
        };
        let lower = to_cyrillic(self.text(*noun)).to_lowercase();
        let Some(found) = dictionary::counted(&lower, cardinal.governs) else { return false };
        let written = |group: &Group| self.text(*group).to_owned();
        let (number, gap, noun) =
            (written(number), self.gap(number.to, noun.from).to_owned(), written(noun));
        self.pieces.push(Piece::Numeral { written: number, cardinal });
        self.pieces.push(Piece::Fixed(gap));
        let found = Noun { number: Number::Plural, ..found };
        self.pieces.push(Piece::Counted { written: noun, noun: Box::new(found.clone()) });
        self.evidence = self.evidence.max(found.evidence);
        self.head = Some((lower, found));
        true
    }

    fn take(&mut self, written: &str, lower: &str, noun: Noun) {
        self.evidence = self.evidence.max(noun.evidence);
        self.pieces.push(Piece::Noun { written: written.to_owned(), noun: Box::new(noun.clone()) });
        match &self.head {
            None => self.head = Some((lower.to_owned(), noun)),
            // «кафе-бар» is a bar: a first part that does not decline gives way.
            Some((_, first)) if first.is_unchanging() => self.head = Some((lower.to_owned(), noun)),
            Some(_) => {}
        }
    }
}

/// The noun by the word list, then the dictionary, then its ending.
fn resolve(word: &str, known: Known) -> Noun {
    if lexicon::find(word).is_some() {
        return Noun::by_rules(word, known);
    }
    let listed = || {
        noun::singular_of(word)
            .map(|lemma| Noun { number: Number::Plural, ..Noun::by_rules(lemma, known) })
    };
    dictionary::noun(word, known).or_else(listed).unwrap_or_else(|| Noun::by_rules(word, known))
}

/// Whether the last of some words may name a thing, as far as the dictionary knows it.
pub(crate) fn may_be_noun(said: &str) -> bool {
    let Some(word) = said.split(|c: char| !c.is_alphabetic()).rfind(|w| !w.is_empty()) else {
        return false;
    };
    let lower = to_cyrillic(word).to_lowercase();
    let readings = dictionary::readings(&lower);
    // A form that the dictionary knows is a noun's oblique case, unless it ends as verbs do.
    const VERBAL: [&str; 14] =
        ["ет", "ёт", "ит", "ют", "ут", "ат", "ят", "ть", "л", "ла", "ло", "ли", "ся", "шь"];
    readings.noun || !readings.known || !VERBAL.iter().any(|ending| lower.ends_with(ending))
}

/// Whether the dictionary knows the word, and only as a form that is no nominative.
fn is_oblique(word: &str) -> bool {
    let readings = dictionary::readings(word);
    readings.known && !readings.noun && !readings.adjective && lexicon::find(word).is_none()
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

/// Whether «дедушкин» is made from a living being of the word list, «Сашин» from a person's name.
fn is_possessor(word: &str) -> bool {
    let stem = word.trim_end_matches(['а', 'о', 'ы']);
    let of = |ending: &str| {
        stem.strip_suffix("ин").is_some_and(|root| {
            let being = format!("{root}{ending}");
            lexicon::find(&being).is_some_and(|entry| entry.animate)
                || dictionary::readings(&being).first_name
        })
    };
    of("а") || of("я")
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

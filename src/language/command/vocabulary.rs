//! The words of commands in both languages, and what each does in a sentence.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::Relation;
use crate::sets::{Set, named, of_kind};
use crate::units::{InOrder as _, name_key};
use crate::words::ordering_verb;

/// What a word or phrase does in a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    Verb(Verb),
    Link(Link),
    /// Politeness, articles, adverbs: heard and dropped.
    Filler,
    /// «на ключ»: closing becomes locking.
    WithKey,
    /// «на пол»: what is put goes onto no thing.
    OnFloor,
    /// «лицом к стене»: the nearest.
    FacingWall,
    /// «домой», «на зарядку»: a place of the robot's own.
    Haunt(Haunt),
    And,
    /// «все двери»
    All,
    Not,
    /// «мне», "me"
    Me,
    /// «её», "it"
    Pronoun,
    /// «их», "them"
    Them,
}

impl Meaning {
    /// Whether a word says whither, or may: a preposition, «домой».
    pub(super) fn says_whither(self) -> bool {
        match self {
            Self::Link(link) => matches!(link.role, Role::Whither | Role::WhereOrWhither),
            Self::Haunt(_) => true,
            _ => false,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Verb {
    GoTo,
    /// "move": what is named is carried, and without a name the robot goes itself.
    Move,
    /// "get": what is named is brought, and without a name the robot goes itself.
    Get,
    Bring,
    /// «нужно лекарство»: asks for it without saying how.
    Need,
    Take,
    Put,
    /// "put down": where a place is named it is put there, else on the floor.
    SetDown,
    /// «убери»: puts away, or tidies a place.
    Clear,
    Open,
    Close,
    Lock,
    Unlock,
    SwitchOn,
    SwitchOff,
    Find,
    Tidy,
    /// "clean": a room is tidied; of a thing, its surface is meant.
    Clean,
    CallOperator,
    CallLift,
    Report,
    Stop,
    /// «не надо»: by itself nothing is to be done; behind what is named, that is let be.
    Needless,
    /// «вернись»: to the place that is named, else to where the robot came from.
    Return,
    /// «верни на место»
    PutBack,
    /// «выброси»: into a bin, unless a place is named.
    ThrowAway,
    /// «зарядись»
    Charge,
    /// «выйди»: out of the room in which the robot is.
    Leave,
    Wait,
    /// «повернись к окну»
    Face,
    /// «обойди»: into each of the rooms that are named; what is no room is gone around, and that this one cannot do.
    Visit,
    /// What people ask of robots and this one cannot do.
    Unable,
}

/// Places of the robot's own, that it knows without their names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Haunt {
    Charger,
    Home,
}

/// A preposition: how the thing after it lies to the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Link {
    pub(super) relation: Relation,
    pub(super) role: Role,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// «в», «на», «под»: the case tells whither from where.
    WhereOrWhither,
    Whither,
    Where,
    Whence,
    Via,
}

/// What takes back what was ordered before it, and says what is meant instead.
pub(super) static CORRECTIONS: Set = Set::named("Correction");

/// What may do so, and may also be said by itself.
pub(super) static HESITATIONS: Set = Set::named("Hesitation");

/// Whether a word, in [`name_key`] form, is a past one, which orders behind «чтобы» and «бы» alone: «хочу, чтобы ты закрыл
/// дверь». «Ты закрыл дверь?» orders nothing.
pub(super) fn is_wished(word: &str) -> bool {
    of_kind("Wished.").any(|(_, form)| name_key(form) == word)
}

/// The meaning of the longest phrase at the beginning of these words (in [`name_key`] form),
/// with the number of words that it takes.
pub(super) fn longest<'k>(
    words: &(impl Iterator<Item = &'k str> + Clone),
) -> Option<(usize, Meaning)> {
    type Phrases = Vec<(Vec<String>, Meaning)>;
    static TABLE: OnceLock<HashMap<String, Phrases>> = OnceLock::new();
    let table = TABLE.get_or_init(|| {
        let mut table: HashMap<String, Phrases> = HashMap::new();
        for (meaning, phrase) in phrases() {
            let words: Vec<String> = phrase.split_whitespace().map(name_key).collect();
            table.entry(words[0].clone()).or_default().push((words, meaning));
        }
        for phrases in table.values_mut() {
            phrases.order_by_key(|(words, _)| std::cmp::Reverse(words.len()));
        }
        table
    });
    let first = words.clone().next()?;
    let Some(phrases) = table.get(first) else { return inflected(first).map(|verb| (1, verb)) };
    phrases.iter().find_map(|(phrase, meaning)| Some((taken(phrase, words.clone())?, *meaning)))
}

/// How many words a phrase takes at the beginning of some: its own, and politeness between them («позови, пожалуйста,
/// оператора»).
fn taken<'k>(phrase: &[String], words: impl Iterator<Item = &'k str>) -> Option<usize> {
    static BETWEEN: Set = Set::named("WithinPhrase");
    let mut left = phrase.iter();
    let mut wanted = left.next()?;
    for (n, word) in words.enumerate() {
        if word == wanted {
            match left.next() {
                Some(next) => wanted = next,
                None => return Some(n + 1),
            }
        } else if n == 0 || !BETWEEN.contains(&word) {
            return None;
        }
    }
    None
}

/// A Russian verb in a form that orders or asks, found by its infinitive: «сгонять» as «сгоняй», «принесёшь» as
/// «принеси»; of another aspect by its stem, «вырубай» as «выруби».
fn inflected(word: &str) -> Option<Meaning> {
    static INFINITIVES: OnceLock<HashMap<String, Meaning>> = OnceLock::new();
    static STEMS: OnceLock<HashMap<String, Option<Meaning>>> = OnceLock::new();
    let infinitive = ordering_verb(word)?;
    let table = INFINITIVES.get_or_init(|| {
        let mut table: HashMap<String, Meaning> = HashMap::new();
        for (meaning, phrase) in phrases().filter(|(_, phrase)| !phrase.contains(' ')) {
            let able = matches!(meaning, Meaning::Verb(verb) if verb != Verb::Unable);
            if let Some(infinitive) = able.then(|| ordering_verb(phrase)).flatten() {
                table.entry(infinitive).or_insert(meaning);
            }
        }
        table
    });
    // A stem that verbs of several meanings share tells nothing.
    let stems = STEMS.get_or_init(|| {
        let mut stems: HashMap<String, Option<Meaning>> = HashMap::new();
        for (infinitive, meaning) in table {
            let Some(stem) = stem_of(infinitive) else { continue };
            let one = stems.entry(stem.to_owned()).or_insert(Some(*meaning));
            *one = one.filter(|known| known == meaning);
        }
        stems
    });
    let known = table.get(&infinitive).copied();
    known.or_else(|| stems.get(stem_of(&infinitive)?).copied().flatten())
}

/// What verbs of both aspects share: «включ» of «включить» and «включать», «откр» of «открыть» and «открывать».
fn stem_of(infinitive: &str) -> Option<&str> {
    const ENDINGS: [&str; 8] = ["ывать", "ивать", "авать", "ать", "ять", "ить", "ыть", "еть"];
    let stem = ENDINGS.iter().find_map(|ending| infinitive.strip_suffix(ending))?;
    (stem.chars().count() >= 4).then_some(stem)
}

/// All verbs, to offer the one that was meant.
pub(super) fn verbs() -> impl Iterator<Item = &'static str> {
    phrases().filter(|(meaning, _)| matches!(meaning, Meaning::Verb(_))).map(|(_, phrase)| phrase)
}

/// The phrases of the files, each with what it does: «Verb.GoTo», «Link.In.Where», «Word.Filler».
fn phrases() -> impl Iterator<Item = (Meaning, &'static str)> {
    let kinds = ["Verb.", "Link.", "Haunt.", "Word.", "Wished."];
    let of = |kind| of_kind(kind).filter_map(move |(name, said)| Some((meant(kind, name)?, said)));
    kinds.into_iter().flat_map(of)
}

fn meant(kind: &str, name: &str) -> Option<Meaning> {
    match kind {
        "Link." => {
            let (relation, role) = name.split_once('.')?;
            let (relation, role) = (Relation::named(relation)?, Role::named(role)?);
            Some(Meaning::Link(Link { relation, role }))
        }
        "Haunt." => Haunt::named(name).map(Meaning::Haunt),
        "Word." => Meaning::named(name),
        _ => Verb::named(name).map(Meaning::Verb),
    }
}

named!(Meaning: Filler WithKey OnFloor FacingWall And All Not Me Pronoun Them);
named!(Haunt: Charger Home);
named!(Role: WhereOrWhither Whither Where Whence Via);
named!(Relation: At In On Under Behind InFrontOf NextTo LeftOf RightOf Between Middle Facing);
named!(Verb: GoTo Move Get Bring Need Take Put SetDown Clear Open Close Lock Unlock SwitchOn SwitchOff Find Tidy Clean
    CallOperator CallLift Report Stop Needless Return PutBack ThrowAway Charge Leave Wait Face Visit Unable);

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: Option<(usize, Meaning)>) {
        assert_eq!(longest(&text.split_whitespace()), expected, "{text}");
    }

    #[test]
    fn the_longest_phrase_wins() {
        check("не могли бы вы", Some((4, Meaning::Filler)));
        check("не открывай", Some((1, Meaning::Not)));
        check("pick up the cup", Some((2, Meaning::Verb(Verb::Take))));
        check("её", None); // keys have no ё
        check("ее", Some((1, Meaning::Pronoun)));
        check("стол", None);
    }

    #[test]
    fn no_phrase_has_two_meanings() {
        let mut seen = HashMap::new();
        for (meaning, phrase) in phrases() {
            assert!(!phrase.is_empty());
            if let Some(other) = seen.insert(name_key(phrase), meaning) {
                assert_eq!(other, meaning, "{phrase}");
            }
        }
    }
}

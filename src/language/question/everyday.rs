//! A sentence with everyday words replaced by those that the map knows: «столик» – «стол», "couch" – "sofa".
//!
//! Invariant: a word that the map or the grammar knows is never replaced.

use std::borrow::Cow;
use std::ops::Range;

use super::lexicon::{Extension, Lexicon, Meaning};
use super::vocabulary;
use crate::map::Entity;
use crate::sets::Set;
use crate::units::{InOrder as _, name_key};
use crate::words::{Case, Language, NounPhrase, Number, WordHints, everyday, word_ranges};

/// Words that ask and are often mistyped; a letter off is still that word.
static ASKING: Set = Set::named("OftenMistyped");

/// The text in words that the map knows, where it knows any of the same meaning.
pub(super) fn plain<'t>(text: &'t str, lexicon: &Lexicon) -> Cow<'t, str> {
    let words = word_ranges(text);
    let mut replaced: Vec<(Range<usize>, String)> = Vec::new();
    let mut at = 0;
    while at < words.len() {
        let taken = known(text, &words, at, lexicon);
        // "desk lamps": two words that mean another thing together.
        if let Some((n, word)) = several_words(text, &words, at, taken, lexicon) {
            replaced.push((words[at].start..words[at + n - 1].end, word));
            at += n;
            continue;
        }
        if let Some((pair, placed)) = of_room(text, &words, at, taken, lexicon) {
            replaced.push((pair, placed));
            at += 2;
            continue;
        }
        if let Some((pair, turned)) = turned(text, &words, at, taken, lexicon) {
            replaced.push((pair, turned));
            at += 2;
            continue;
        }
        if let Some((pair, named)) = named_by_end(text, &words, at, taken, lexicon) {
            replaced.push((pair, named));
            at += 2;
            continue;
        }
        if taken > 0 {
            at += taken;
            continue;
        }
        match other_words(text, &words, at, lexicon) {
            Some((n, word)) => {
                replaced.push((words[at].start..words[at + n - 1].end, word));
                at += n;
            }
            None => {
                replaced.extend(with_head(text, &words, at, lexicon));
                at += 1;
            }
        }
    }
    if replaced.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut plain = text.to_owned();
    for (range, word) in replaced.into_iter().rev() {
        plain.replace_range(range, &word);
    }
    Cow::Owned(plain)
}

/// How many words at a place something knows.
fn known(text: &str, words: &[Range<usize>], at: usize, lexicon: &Lexicon) -> usize {
    let end = (at + 6).min(words.len());
    let keys: Vec<String> = words[at..end].iter().map(|r| name_key(&text[r.clone()])).collect();
    let named = lexicon.nouns.length_at(text, words, at);
    let marked = vocabulary::longest(&keys).map_or(0, |(n, _)| n);
    let valued = lexicon.values.longest(&keys).map_or(0, |(n, _)| n);
    let property = lexicon.values.property(&keys).map_or(0, |(n, _)| n);
    named.max(marked).max(valued).max(property)
}

/// The same thing under a name of the map, of the same language where there is one.
fn same_thing(said: &str, lexicon: &Lexicon) -> Option<String> {
    let mut alike = everyday::same_things(&name_key(said));
    let language = Language::of(said);
    alike.order_by_key(|word| Language::of(word) != language);
    alike.into_iter().find(|word| is_name(word, lexicon))
}

/// Several words at a place, more than anything knows, that are another name of a thing.
fn several_words(
    text: &str,
    words: &[Range<usize>],
    at: usize,
    known: usize,
    lexicon: &Lexicon,
) -> Option<(usize, String)> {
    let longest = everyday::LONGEST.min(words.len() - at);
    (known.max(1) + 1..=longest).rev().find_map(|n| {
        let said = &text[words[at].start..words[at + n - 1].end];
        same_thing(said, lexicon).map(|word| (n, word))
    })
}

/// «стол письменный»: a name whose adjective stands behind it.
fn turned(
    text: &str,
    words: &[Range<usize>],
    at: usize,
    taken: usize,
    lexicon: &Lexicon,
) -> Option<(Range<usize>, String)> {
    let next = words.get(at + 1)?;
    let gap = &text[words[at].end..next.start];
    if taken != 1 || gap != " " || known(text, words, at + 1, lexicon) > 0 {
        return None;
    }
    let turned = format!("{} {}", &text[next.clone()], &text[words[at].clone()]);
    is_name(&turned, lexicon).then(|| (words[at].start..next.end, turned))
}

/// «дверь coe», "the door coe", where a door is the coe_door: its kind is the end of its name, whatever else is called so.
fn named_by_end(
    text: &str,
    words: &[Range<usize>],
    at: usize,
    taken: usize,
    lexicon: &Lexicon,
) -> Option<(Range<usize>, String)> {
    let (kind, next) = (&words[at], words.get(at + 1)?);
    let own = &text[next.clone()];
    if taken != 1 || &text[kind.end..next.start] != " " || !own.is_ascii() {
        return None;
    }
    let kinds =
        lexicon.nouns.find(&text[kind.clone()]).into_iter().filter_map(|hit| match hit.id {
            Meaning::Kind(kind) => Some(lexicon.kind(*kind)),
            Meaning::Entity(_) => None,
        });
    let names = |name: &str| -> Vec<Entity> {
        let hits = lexicon.nouns.find(name).into_iter();
        let hits = hits.filter(|hit| hit.spelling != crate::Spelling::Part);
        hits.filter_map(|hit| match hit.id {
            Meaning::Entity(entity) => Some(*entity),
            Meaning::Kind(_) => None,
        })
        .collect()
    };
    let alone = names(own);
    kinds.filter(|kind| kind.extension == Extension::Doors).find_map(|doors| {
        let whole = format!("{own} {}", doors.english);
        let is_door = |entity: &Entity| matches!(entity, Entity::Door(_));
        let named = names(&whole).iter().any(is_door) && !alone.iter().any(is_door);
        named.then_some((kind.start..next.end, whole))
    })
}

/// «сколько дверей, кроме входной»: an adjective for a name whose noun the sentence has already.
fn with_head(
    text: &str,
    words: &[Range<usize>],
    at: usize,
    lexicon: &Lexicon,
) -> Option<(Range<usize>, String)> {
    let said = &text[words[at].clone()];
    if Language::of(said) != Language::Russian
        || said.chars().count() < 4
        || !lexicon.nouns.begins_longer(said)
    {
        return None;
    }
    let others = words.iter().enumerate().filter(|(n, _)| *n != at);
    let kinds = others.flat_map(|(_, word)| lexicon.nouns.find(&text[word.clone()]));
    let kinds = kinds.filter_map(|hit| match hit.id {
        Meaning::Kind(kind) => Some(*kind),
        Meaning::Entity(_) => None,
    });
    let mut forms = kinds.flat_map(|kind| lexicon.kind(kind).phrase.all_forms());
    let whole = forms.find_map(|(_, _, form)| {
        let whole = format!("{said} {form}");
        is_name(&whole, lexicon).then_some(whole)
    })?;
    Some((words[at].clone(), whole))
}

/// Adjectives of rooms, without their endings.
static OF_ROOMS: Set = Set::named("OfRoom");

/// «кухонный стол»: a table in the kitchen, where nothing is called so.
fn of_room(
    text: &str,
    words: &[Range<usize>],
    at: usize,
    taken: usize,
    lexicon: &Lexicon,
) -> Option<(Range<usize>, String)> {
    let next = words.get(at + 1)?;
    let key = name_key(&text[words[at].clone()]);
    let ends =
        |stem: &str| key.strip_prefix(stem).is_some_and(|e| (2..=3).contains(&e.chars().count()));
    let (_, room) = OF_ROOMS.meant().iter().find(|(stem, _)| ends(stem))?;
    let thing = &text[next.clone()];
    if taken > 0 || !is_name(room, lexicon) || !is_name(thing, lexicon) {
        return None;
    }
    let room = NounPhrase::parse(room, &WordHints::default());
    let place = room.form(Case::Prepositional, Number::Singular);
    Some((words[at].start..next.end, format!("{thing} в {place}")))
}

/// Whether all of a text is the name of something or of a kind.
fn is_name(text: &str, lexicon: &Lexicon) -> bool {
    let words = word_ranges(text);
    lexicon.nouns.length_at(text, &words, 0) == words.len()
}

/// The same thing in words of the map, with the number of words that it stands for.
fn other_words(
    text: &str,
    words: &[Range<usize>],
    at: usize,
    lexicon: &Lexicon,
) -> Option<(usize, String)> {
    let key = name_key(&text[words[at].clone()]);
    if let Some(word) = same_thing(&key, lexicon) {
        return Some((1, word));
    }
    // «журнальный столик» is one name; «столик» by itself any table.
    let small = everyday::undiminished(&key);
    // «тумбочка» is a thing of its own: no «тумба под телевизор», which is only a part of a name.
    let own = !everyday::same_things(&key).is_empty();
    let whole = |word: &str| {
        let hits = lexicon.nouns.find(word);
        !own || hits.iter().any(|hit| hit.spelling != crate::Spelling::Part)
    };
    if let Some(word) = small.iter().find(|word| is_name(word, lexicon) && whole(word)) {
        return Some((1, word.clone()));
    }
    let mistyped =
        |word: &&&str| word.chars().count() > 2 && strsim::damerau_levenshtein(word, &key) == 1;
    if super::grammar::number_of(&key).is_some() {
        return None;
    }
    // "teh": letters in another order are a slip of the keys.
    let mut letters: Vec<char> = key.chars().collect();
    letters.order();
    let swapped = |word: &&&str| {
        let mut own: Vec<char> = word.chars().collect();
        own.order();
        own == letters && mistyped(word)
    };
    if let Some(word) = ASKING.iter().find(swapped) {
        return Some((1, (*word).to_owned()));
    }
    // Likeness to a name takes as long as the map has names: it is asked only of what may be a slip.
    let word = ASKING.iter().find(mistyped)?;
    lexicon.nouns.near(&key, 1).is_empty().then(|| (1, (*word).to_owned()))
}

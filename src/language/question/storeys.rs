//! "Upstairs" and «внизу»: the storey above or below the robot's own, put into the sentence by its name.
//!
//! Invariant: where the robot does not know its own storey, the sentence stays as it is; a storey that is not there
//! is said to be missing ([`lacking`]), unless another one is named beside it.

use std::borrow::Cow;

use crate::map::{Entity, World};
use crate::names::english_name;
use crate::units::MapId;
use crate::words::{Language, phrase_at, word_keys, word_ranges};

/// A word, whether it means the storey above, and whether it says whither.
const WORDS: [(&str, bool, bool); 26] = [
    ("up one floor", true, true),
    ("up a floor", true, true),
    ("one floor higher", true, true),
    ("down one floor", false, true),
    ("down a floor", false, true),
    ("one floor lower", false, true),
    ("наверху", true, false),
    ("наверх", true, true),
    ("вверх", true, true),
    ("внизу", false, false),
    ("вниз", false, true),
    ("upstairs", true, false),
    ("downstairs", false, false),
    ("этажом выше", true, false),
    ("этажом ниже", false, false),
    ("на этаж выше", true, true),
    ("на этаж ниже", false, true),
    ("to the floor above", true, true),
    ("to the floor below", false, true),
    ("to the upper floor", true, true),
    ("to the lower floor", false, true),
    ("one floor up", true, true),
    ("one floor down", false, true),
    ("the floor above", true, false),
    ("the floor below", false, false),
    ("на этаже ниже", false, false),
];

/// Before these, "upstairs" says whither.
const MOTION: [&str; 15] = [
    "get", "go", "come", "drive", "head", "move", "walk", "way", "bring", "take", "carry",
    "deliver", "put", "send", "fetch",
];

/// Such a word in a text: its place among the words, their number, whether it is above, whether it says whither.
type Told = (usize, usize, bool, bool);

fn told(keys: &[String]) -> Vec<Told> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < keys.len() {
        let here = WORDS.iter().filter_map(|(phrase, above, whither)| {
            let taken = phrase_at(keys, at, phrase)?;
            Some((at, taken, *above, *whither))
        });
        match here.max_by_key(|(_, taken, ..)| *taken) {
            Some(one) => {
                found.push(one);
                at += one.1;
            }
            None => at += 1,
        }
    }
    found
}

/// Whether a text speaks only of a storey that is not there: the one above (true) or below.
pub(super) fn lacking(text: &str, world: &World, here: Option<MapId>) -> Option<bool> {
    let here = here?;
    let told = told(&word_keys(text));
    let missing = |one: &Told| beside(world, here, one.2).is_none();
    told.iter().all(missing).then(|| told.first().map(|one| one.2)).flatten()
}

/// The text with the storey named in the place of such words.
pub(super) fn named<'t>(text: &'t str, world: &World, here: Option<MapId>) -> Cow<'t, str> {
    let Some(here) = here.filter(|_| world.domain.maps.len() > 1) else {
        return Cow::Borrowed(text);
    };
    let words = word_ranges(text);
    let keys = word_keys(text);
    let mut named = text.to_owned();
    for (at, taken, above, whither) in told(&keys).into_iter().rev() {
        let end = at + taken;
        let Some(name) = beside(world, here, above) else {
            // "upstairs or downstairs": only one of them is there.
            let is_or = |n: usize| keys.get(n).is_some_and(|k| k == "or" || k == "или");
            match (at.checked_sub(1).filter(|n| is_or(*n)), is_or(end)) {
                (Some(or), _) => named.replace_range(words[or].start..words[end - 1].end, ""),
                (None, true) => named.replace_range(words[at].start..words[end].end, ""),
                (None, false) => {}
            }
            continue;
        };
        let moves = keys[..at].iter().any(|key| MOTION.contains(&key.as_str()));
        let english = english_name(world, Entity::Map(name));
        let english = if english.is_empty() { world.name(Entity::Map(name)) } else { english };
        let russian = world.name(Entity::Map(name));
        let place = match (Language::of(text), whither || moves) {
            (Language::Russian, true) => format!("на этаж {russian}"),
            (Language::Russian, false) => format!("на этаже {russian}"),
            (Language::English, true) => format!("to {english}"),
            (Language::English, false) => format!("on {english}"),
        };
        named.replace_range(words[at].start..words[end - 1].end, &place);
    }
    if named == text { Cow::Borrowed(text) } else { Cow::Owned(named) }
}

/// The storey right above or below another.
fn beside(world: &World, here: MapId, above: bool) -> Option<MapId> {
    let height = |map: MapId| {
        let placed = world.domain.maps.iter().find(|m| m.map == map);
        placed.map(|m| m.frame.z.get())
    };
    let own = height(here)?;
    let other = |map: &MapId| height(*map).map(|z| if above { z - own } else { own - z });
    let all = world.maps.keys().filter_map(|map| Some((other(map)?, *map)));
    let next = all.filter(|(apart, _)| *apart > 1.0).min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(next.1)
}

//! "Upstairs" and «внизу»: the storey above or below the robot's own, put into the sentence by its name.
//!
//! Invariant: where there is no such storey, or the robot does not know its own, the sentence stays as it is.

use std::borrow::Cow;

use crate::language::words::{Language, word_ranges};
use crate::map::World;
use crate::units::{MapId, name_key};

/// A word, whether it means the storey above, and whether it says whither.
const WORDS: [(&str, bool, bool); 18] = [
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
];

/// Before these, "upstairs" says whither.
const MOTION: [&str; 9] = ["get", "go", "come", "drive", "head", "move", "walk", "way", "bring"];

/// The text with the storey named in the place of such words.
pub(super) fn named<'t>(text: &'t str, world: &World, here: Option<MapId>) -> Cow<'t, str> {
    if world.domain.maps.len() < 2 {
        return Cow::Borrowed(text);
    }
    let words = word_ranges(text);
    let keys: Vec<String> = words.iter().map(|r| name_key(&text[r.clone()])).collect();
    let found = (0..keys.len()).find_map(|at| {
        WORDS.iter().find_map(|(phrase, above, whither)| {
            let phrase: Vec<&str> = phrase.split(' ').collect();
            let said = keys.get(at..at + phrase.len())?;
            said.iter().map(String::as_str).eq(phrase.iter().copied()).then_some((
                at,
                phrase.len(),
                *above,
                *whither,
            ))
        })
    });
    let Some((at, taken, above, whither)) = found else { return Cow::Borrowed(text) };
    let Some(name) = here.and_then(|here| beside(world, here, above)) else {
        return Cow::Borrowed(text);
    };
    let moves = keys[..at].iter().any(|key| MOTION.contains(&key.as_str()));
    let place = match (Language::of(text), whither || moves) {
        (Language::Russian, true) => format!("на этаж {name}"),
        (Language::Russian, false) => format!("на этаже {name}"),
        (Language::English, true) => format!("to {name}"),
        (Language::English, false) => format!("on {name}"),
    };
    let mut named = text.to_owned();
    named.replace_range(words[at].start..words[at + taken - 1].end, &place);
    Cow::Owned(named)
}

/// The name of the storey right above or below another.
fn beside(world: &World, here: MapId, above: bool) -> Option<&str> {
    let height = |map: MapId| {
        let placed = world.domain.maps.iter().find(|m| m.map == map);
        placed.map(|m| m.frame.z.get())
    };
    let own = height(here)?;
    let other = |map: &MapId| height(*map).map(|z| if above { z - own } else { own - z });
    let all = world.maps.keys().filter_map(|map| Some((other(map)?, *map)));
    let next = all.filter(|(apart, _)| *apart > 1.0).min_by(|a, b| a.0.total_cmp(&b.0))?;
    world.maps.get(&next.1).map(|map| map.name.as_str())
}

//! "Upstairs" and «внизу»: the storey above or below the robot's own, put into the sentence by its name.
//!
//! Invariant: where the robot does not know its own storey, the sentence stays as it is; a storey that is not there
//! is said to be missing ([`lacking`]), unless another one is named beside it.

use std::borrow::Cow;

use crate::map::{Entity, World};
use crate::names::english_name;
use crate::semantics::Relations;
use crate::sets::{Set, named, of_kind};
use crate::units::MapId;
use crate::words::{Language, phrase_at, word_keys, word_ranges};

/// Which storey a word means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Storey {
    Above,
    Below,
    /// The robot's own.
    Own,
}

named!(Storey: Above Below Own);

/// Before these, "upstairs" says whither.
static MOTION: Set = Set::named("MotionVerb");

/// Such a word in a text: its place among the words, their number, which storey it means, whether it says whither.
type Told = (usize, usize, Storey, bool);

fn told(keys: &[String]) -> Vec<Told> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < keys.len() {
        let phrases = ["Storey.", "ToStorey."].into_iter().flat_map(|kind| {
            of_kind(kind).map(move |(name, phrase)| (name, phrase, kind == "ToStorey."))
        });
        let here = phrases.filter_map(|(name, phrase, whither)| {
            let taken = phrase_at(keys, at, phrase)?;
            Some((at, taken, Storey::named(name)?, whither))
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
pub(super) fn lacking(
    text: &str,
    world: &World,
    relations: &Relations,
    here: Option<MapId>,
) -> Option<bool> {
    let here = here?;
    let told = told(&word_keys(text));
    let missing = |one: &Told| beside(world, relations, here, one.2).is_none();
    told.iter().all(missing).then(|| told.first().map(|one| one.2 == Storey::Above)).flatten()
}

/// The text with the storey named in the place of such words.
pub(super) fn named<'t>(
    text: &'t str,
    world: &World,
    relations: &Relations,
    here: Option<MapId>,
) -> Cow<'t, str> {
    let keys = word_keys(text);
    let told = told(&keys);
    let own = told.iter().any(|one| one.2 == Storey::Own);
    let Some(here) = here.filter(|_| own || world.domain.maps.len() > 1) else {
        return Cow::Borrowed(text);
    };
    let words = word_ranges(text);
    let mut named = text.to_owned();
    for (at, taken, storey, whither) in told.into_iter().rev() {
        let end = at + taken;
        let Some(name) = beside(world, relations, here, storey) else {
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

/// The storey that is meant from another.
fn beside(world: &World, relations: &Relations, here: MapId, storey: Storey) -> Option<MapId> {
    let is_above = match storey {
        Storey::Own => return Some(here),
        Storey::Above => true,
        Storey::Below => false,
    };
    let all = world.maps.keys().filter_map(|map| Some((relations.rise(world, here, *map)?, *map)));
    let there = all.filter(|(rise, _)| (*rise > 0.0) == is_above);
    there.min_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).map(|(_, map)| map)
}

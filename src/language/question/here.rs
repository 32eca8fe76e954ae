//! "Here" put into the sentence as the room where the robot is: «Есть ли здесь стул?», "What is in here?"
//!
//! Invariant: where the sentence names another place, or asks of the whole building, it stays as it is.

use std::borrow::Cow;

use crate::sets::{Set, set};
use crate::words::{word_keys, word_ranges};

/// After these "here" is not where things are.
static PLACED: Set = Set::named("SaysWhere");
/// What a room has none of.
static WHOLE: Set = Set::named("OfWholeBuilding");
/// "Where is the bin here?" asks of the whole flat, «что здесь можно съесть» too.
static WIDE: Set = Set::named("AsksWidely");

/// The text with "here" told by its room, which `place` names: «в Гостиной».
pub(super) fn named(text: &str, place: impl FnOnce() -> Option<String>) -> Cow<'_, str> {
    let keys = word_keys(text);
    let small = |n: usize| keys[n] == "at" && keys.get(n + 1).is_some_and(|key| key == "all");
    let is = |n: usize, all: &[&str]| {
        !(n < keys.len() && small(n)) && keys.get(n).is_some_and(|key| all.contains(&key.as_str()))
    };
    let any = |all: &[&str]| (0..keys.len()).any(|n| is(n, all));
    let here = (0..keys.len()).find(|n| is(*n, set!("HereWord")));
    let begins = (0..4).any(|n| is(n, set!("AsksHere")));
    let Some(here) = here.filter(|_| begins && !any(&PLACED) && !any(&WHOLE) && !any(&WIDE)) else {
        return Cow::Borrowed(text);
    };
    let within = here > 0 && is(here - 1, &["in"]);
    if !within && any(&["in"]) {
        return Cow::Borrowed(text);
    }
    let Some(place) = place() else { return Cow::Borrowed(text) };
    let ranges = word_ranges(text);
    let mut text = text.to_owned();
    text.replace_range(ranges[here - usize::from(within)].start..ranges[here].end, &place);
    Cow::Owned(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_room_takes_the_place_of_here() {
        let check = |text: &str, place: &str, plain: &str| {
            assert_eq!(named(text, || Some(place.to_owned())), plain);
        };
        check("Есть ли здесь стул?", "в Холле", "Есть ли в Холле стул?");
        check("What is in here?", "in the hall", "What is in the hall?");
        check("Is there a chair here?", "in the hall", "Is there a chair in the hall?");
        check("How far is it from here?", "in the hall", "How far is it from here?");
        check("Где здесь кухня?", "в Холле", "Где здесь кухня?");
        check("Сколько здесь комнат?", "в Холле", "Сколько здесь комнат?");
        check(
            "Is there a lamp here in the kitchen?",
            "in the hall",
            "Is there a lamp here in the kitchen?",
        );
    }
}

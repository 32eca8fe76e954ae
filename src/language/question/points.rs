//! Points of the floor that people speak of as of rooms: "What is in the pantry?", where the pantry is a point.
//!
//! Invariant: nothing is said to be in a point, or not to be. A room in which there is one point alone is called after it.

use std::borrow::Cow;
use std::ops::Range;

use super::Doubt;
use super::knowledge::Knowledge;
use super::lexicon::{Extension, KindId, Lexicon, Meaning};
use super::query::{Claim, Head, Noun, Query, Rel, Restriction, Thing};
use crate::map::{Entity, World};
use crate::units::PlaceId;
use crate::words::{Language, word_ranges};

/// The one point that a noun names.
fn point_of(noun: &Noun) -> Option<PlaceId> {
    match noun.head.named[..] {
        [Entity::Place(place)] if noun.head.things.is_none() => Some(place),
        _ => None,
    }
}

/// The points that something is said to be in.
fn each_point(query: &mut Query, mut seen: impl FnMut(PlaceId, &mut Noun)) {
    let mut look = |place: &mut Restriction| {
        for anchor in place.anchors.iter_mut().filter(|_| place.rel == Rel::In) {
            if let Some(point) = point_of(anchor) {
                seen(point, anchor);
            }
        }
    };
    if let Query::Holds { claims, .. } | Query::Choice { claims, .. } = query {
        for claim in claims {
            if let Claim::Related(place) = claim {
                look(place);
            }
        }
    }
    query.each_noun(&mut |noun| noun.restrictions.iter_mut().for_each(&mut look));
}

/// «В комнате coe», "the coe room": a text without the noun before or behind the name of a point that is alone in its room.
pub(super) fn without_rooms<'t>(text: &'t str, world: &World, lexicon: &Lexicon) -> Cow<'t, str> {
    if world.places.is_empty() {
        return Cow::Borrowed(text);
    }
    let words = word_ranges(text);
    let meant = |words: &[Range<usize>]| match words {
        [first, .., last] => lexicon.nouns.find(&text[first.start..last.end]),
        [only] => lexicon.nouns.find(&text[only.clone()]),
        [] => Vec::new(),
    };
    let is_room = |at: &usize| {
        meant(&words[*at..=*at]).into_iter().any(|hit| match hit.id {
            Meaning::Kind(kind) => lexicon.kind(*kind).extension == Extension::Rooms,
            Meaning::Entity(_) => false,
        })
    };
    let Some(at) = (0..words.len()).find(is_room) else { return Cow::Borrowed(text) };
    let places = &world.places;
    let alone = |id: &PlaceId| {
        places.get(id).is_some_and(|place| {
            places.values().filter(|other| other.area == place.area).count() == 1
        })
    };
    let is_point = |words: &[Range<usize>]| {
        meant(words)
            .iter()
            .any(|hit| matches!(hit.id, Meaning::Entity(Entity::Place(place)) if alone(place)))
    };
    /// Words of a name.
    const MOST: usize = 4;
    let follows =
        || (at + 2..=words.len().min(at + 1 + MOST)).any(|to| is_point(&words[at + 1..to]));
    let leads = || (at.saturating_sub(MOST)..at).any(|from| is_point(&words[from..at]));
    // "The left air pressure room", where the room is called so, and not only the point in it.
    let is_called = |from: usize| {
        let called = meant(&words[from..=at]);
        called.iter().any(|hit| matches!(hit.id, Meaning::Entity(Entity::Area(_))))
    };
    let is_whole = || (at.saturating_sub(MOST + 1)..at).any(is_called);
    let gone = match Language::of(text) {
        Language::English if at > 0 && leads() && !is_whole() => words[at - 1].end..words[at].end,
        _ if at + 1 < words.len() && follows() => words[at].start..words[at + 1].start,
        _ => return Cow::Borrowed(text),
    };
    let mut left = text.to_owned();
    left.replace_range(gone, "");
    Cow::Owned(left)
}

impl Knowledge<'_> {
    /// Puts the room for the one point in it.
    pub(super) fn rooms_for_points(&self, query: &mut Query) {
        let is_room = |k: &KindId| self.lexicon().kind(*k).extension == Extension::Rooms;
        query.each_noun(&mut |noun| {
            for anchor in noun.restrictions.iter_mut().flat_map(|place| &mut place.anchors) {
                self.room_called_after_point(anchor, is_room);
            }
        });
        each_point(query, |point, noun| self.room_for_point(point, noun));
        // A point has no size, and no rooms: "How big is the pantry room?"
        let sized = matches!(query, Query::Size { .. } | Query::Larger { .. });
        query.each_noun(&mut |noun| {
            if let Some(point) = point_of(noun).filter(|_| sized) {
                return self.room_for_point(point, noun);
            }
            self.room_called_after_point(noun, is_room);
        });
    }

    /// "The pantry room": the room of the point, not one that is in it.
    fn room_called_after_point(&self, noun: &mut Noun, is_room: impl Fn(&KindId) -> bool) {
        let [place] = &noun.restrictions[..] else { return };
        let [anchor] = &place.anchors[..] else { return };
        if let (Rel::Of | Rel::In, Some(point)) = (place.rel, point_of(anchor))
            && noun.head.kinds.iter().any(is_room)
        {
            let restrictions = std::mem::take(&mut noun.restrictions);
            self.room_for_point(point, noun);
            if noun.head.named.is_empty() {
                noun.restrictions = restrictions;
            }
        }
    }

    fn room_for_point(&self, point: PlaceId, noun: &mut Noun) {
        let places = &self.world.places;
        let Some(area) = places.get(&point).map(|place| place.area) else { return };
        if places.values().filter(|other| other.area == area).count() == 1 {
            noun.head = Head { named: vec![Entity::Area(area)], ..Head::default() };
        }
    }

    /// Of a point that is one of several in its room, that it is no room.
    pub(super) fn is_point_not_room(&self, query: &Query) -> Option<Doubt> {
        let mut found = None;
        each_point(&mut query.clone(), |point, _| found = found.or(Some(point)));
        let point = found?;
        let area = self.world.places.get(&point)?.area;
        let room = Thing::Entity(Entity::Area(area));
        Some(Doubt::PointNoRoom { point: Thing::Entity(Entity::Place(point)), room })
    }
}

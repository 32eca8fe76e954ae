//! Points of the floor that people speak of as of rooms: "What is in the pantry?", where the pantry is a point.
//!
//! Invariant: nothing is said to be in a point, or not to be. A room in which there is one point alone is called after it.

use super::Doubt;
use super::knowledge::Knowledge;
use super::lexicon::{Extension, Meaning};
use super::query::{Claim, Head, Noun, Query, Rel, Restriction, Thing};
use crate::map::Entity;
use crate::units::PlaceId;
use crate::words::word_keys;

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

impl Knowledge<'_> {
    /// Puts the room for the one point in it.
    pub(super) fn rooms_for_points(&self, query: &mut Query) {
        each_point(query, |point, noun| self.room_for_point(point, noun));
        // "How big is the pantry room?"
        query.each_noun(&mut |noun| {
            let is_room = |key: &String| {
                let found = self.lexicon().nouns.find(key);
                found.iter().any(|hit| match hit.id {
                    Meaning::Kind(kind) => self.lexicon().kind(*kind).extension == Extension::Rooms,
                    Meaning::Entity(_) => false,
                })
            };
            if let Some(point) = point_of(noun)
                && word_keys(&noun.text).iter().any(is_room)
            {
                self.room_for_point(point, noun);
            }
        });
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

//! Points of the floor that people speak of as of rooms: "What is in the pantry?", where the pantry is a point.
//!
//! Invariant: nothing is said to be in a point, or not to be. A room in which there is one point alone is called after it.

use super::Doubt;
use super::knowledge::Knowledge;
use super::lexicon::{Extension, KindId};
use super::query::{Claim, Head, Noun, Query, Rel, Restriction, Thing};
use crate::map::Entity;
use crate::units::PlaceId;

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
        // A point has no size, and no rooms: "How big is the pantry room?"
        let sized = matches!(query, Query::Size { .. } | Query::Larger { .. });
        let is_room = |k: &KindId| self.lexicon().kind(*k).extension == Extension::Rooms;
        query.each_noun(&mut |noun| {
            if let Some(point) = point_of(noun).filter(|_| sized) {
                return self.room_for_point(point, noun);
            }
            let [place] = &noun.restrictions[..] else { return };
            let [anchor] = &place.anchors[..] else { return };
            if let (Rel::Of, Some(point)) = (place.rel, point_of(anchor))
                && noun.head.kinds.iter().any(is_room)
            {
                let restrictions = std::mem::take(&mut noun.restrictions);
                self.room_for_point(point, noun);
                if noun.head.named.is_empty() {
                    noun.restrictions = restrictions;
                }
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

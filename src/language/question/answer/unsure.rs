//! Of what the robot is not sure where it is: that is said before anything that rests on its place.
//!
//! Invariant: an answer all of whose things are in doubt affirms and denies nothing.

use super::Draft;
use crate::map::Entity;
use crate::question::Said;
use crate::question::knowledge::Knowledge;
use crate::question::query::{Dimension, Extreme, Query, Thing};
use crate::units::InOrder as _;
use crate::words::enumerate;

/// So many facts of an answer are looked at.
const FACTS: usize = 60;

/// Relations that tell a place.
const OF_PLACE: [&str; 21] = [
    "ON_TOP_OF",
    "BORNE_BY",
    "INSIDE",
    "UNDER",
    "ABOVE",
    "NEXT_TO",
    "LEANING_AGAINST",
    "CLOSE_TO",
    "LEFT_OF",
    "RIGHT_OF",
    "BEHIND",
    "IN_FRONT_OF",
    "LIES_ON_OR_IN",
    "CONTAINS",
    "STANDS_ON_FLOOR",
    "AT_WALL",
    "IN_CORNER",
    "ON_WALL",
    "AT_DOOR",
    "IN_MIDDLE_OF",
    "STANDS_AT",
];

impl Knowledge<'_> {
    /// The draft with what nobody measured, where it tells of sizes that are only usual ones.
    pub(super) fn as_measured(&self, query: &Query, mut draft: Draft) -> Draft {
        let by_size = |extreme: &Extreme| {
            matches!(
                extreme,
                Extreme::Biggest
                    | Extreme::Smallest
                    | Extreme::Tallest
                    | Extreme::Lowest
                    | Extreme::Widest
                    | Extreme::Narrowest
                    | Extreme::Longest
                    | Extreme::Shortest
                    | Extreme::Thickest
                    | Extreme::Thinnest
            )
        };
        let mut measures = match query {
            Query::Size { dimension, .. } => *dimension != Dimension::Elevation,
            Query::SameSize { .. } | Query::Describe(_) | Query::Distance { .. } => true,
            Query::Larger { extreme, .. } | Query::WhichMore { extreme, .. } => by_size(extreme),
            _ => false,
        };
        query.clone().each_noun(&mut |noun| {
            let best = noun.best.as_ref().map(|best| best.extreme);
            let beyond = noun.beyond.as_ref().map(|(extreme, _)| *extreme);
            measures |= [best, beyond].iter().flatten().any(by_size) || !noun.sizes.is_empty();
        });
        let is_usual =
            |thing: &Thing| thing.replica().is_some_and(|id| self.world.is_of_usual_size(id));
        if measures && draft.things.iter().chain(&draft.topic).any(is_usual) {
            let usual = self.pick(
                "размеры – обычные для таких вещей, на месте их не измеряли",
                "sizes are the usual ones of such things, not measured on site",
            );
            draft.text = format!("{} ({usual})", draft.text.trim_end_matches('.'));
        }
        draft
    }

    /// The draft with what is in doubt, where anything is.
    pub(super) fn hedged(&self, query: &Query, mut draft: Draft) -> Draft {
        let is_thing = |thing: &Thing| matches!(thing, Thing::Entity(Entity::Replica(_)));
        let asks_place = matches!(
            query,
            Query::Where(_)
                | Query::RoomOf(_)
                | Query::Anchor { .. }
                | Query::Way { .. }
                | Query::CanReach { .. }
                | Query::Distance { .. }
                | Query::Duration { .. }
                | Query::Closer { .. }
                | Query::Together { .. }
        );
        let facts = draft.facts.iter().take(FACTS);
        let of_place = facts.filter(|fact| OF_PLACE.contains(&fact.relation.as_str()));
        let mut subjects: Vec<Thing> =
            of_place.flat_map(|fact| &fact.args).filter_map(|name| self.thing(name)).collect();
        if asks_place {
            subjects.extend(draft.things.iter().chain(&draft.topic));
        }
        subjects.retain(is_thing);
        subjects.order();
        subjects.dedup();
        let share = |thing: &Thing| self.senses.doubted(thing.replica()?);
        let doubted: Vec<(Thing, f64)> =
            subjects.iter().filter_map(|thing| Some((*thing, share(thing)?))).collect();
        if doubted.is_empty() {
            return draft;
        }
        let is_doubted = |thing: &Thing| doubted.iter().any(|(other, _)| other == thing);
        let told: Vec<Thing> = draft.things.iter().copied().filter(is_thing).collect();
        let rests_on_doubt = match draft.said {
            Some(Said::Yes | Said::No) => true,
            _ if told.is_empty() => true,
            _ => told.iter().all(is_doubted),
        };
        if rests_on_doubt {
            draft.said = Some(Said::Unknown);
        }
        let percent = |share: f64| match (share * 100.0).round() {
            none if none < 1.0 => self.pick("меньше 1 %", "less than 1%").to_owned(),
            some => format!("{some:.0}{}", self.pick(" %", "%")),
        };
        let list: Vec<String> = doubted
            .iter()
            .map(|(thing, share)| format!("{} ({})", self.name(*thing), percent(*share)))
            .collect();
        let list = enumerate(&list, self.language);
        draft.text = match (self.is_russian(), doubted.len()) {
            (true, _) => format!("я не уверен, где {list}: {}", draft.text),
            (false, 1) => format!("I am not sure where {list} is: {}", draft.text),
            (false, _) => format!("I am not sure where {list} are: {}", draft.text),
        };
        draft
    }
}

//! What is said where nothing is found, and what there is instead.

use crate::question::knowledge::{Held, Knowledge};
use crate::question::lexicon::{Extension, KindId};
use crate::question::query::{Head, Noun, Rel, Thing};
use crate::words::length;

impl Knowledge<'_> {
    /// That a description finds nothing in a place, with what is near to it.
    pub(super) fn nothing_found(&self, noun: &Noun, place: &str) -> String {
        let frame = self.frame_of(noun);
        let general = noun.head.anything && noun.filters.is_empty();
        let but = noun.other || !noun.except.is_empty();
        if !noun.also.is_empty() || noun.like.is_some() {
            return format!("{place} {}", self.pick("таких нет", "there are none such"));
        }
        match (self.is_russian(), general) {
            (true, true) if but => format!("{place}{frame} больше ничего нет"),
            (false, true) if but => format!("there is nothing else {place}{frame}"),
            (true, true) => format!("{place}{frame} ничего нет{}", self.nearest_instead(noun)),
            (false, true) => {
                format!("there is nothing {place}{frame}{}", self.nearest_instead(noun))
            }
            (true, false) if noun.other => {
                format!("{place}{frame} больше нет {}", self.none_of(noun))
            }
            // "Which of them are open?"
            (true, false) if noun.head.things.is_some() => format!("{place}{frame} таких нет"),
            (false, false) if noun.head.things.is_some() => {
                format!("none of them {place}{frame}").trim_end().to_owned()
            }
            (true, false) if place.is_empty() => format!("на карте нет {}", self.none_of(noun)),
            (true, false) if self.is_having(noun) => format!("{} {place} нет", self.none_of(noun)),
            (true, false) => format!("{place}{frame} нет {}", self.none_of(noun)),
            (false, false) if place.is_empty() && !noun.other => {
                self.there_is_no(noun, "on the map")
            }
            (false, false) => self.there_is_no(noun, &format!("{place}{frame}")),
        }
    }

    /// Where there are no doors, how many passages there are, which people may have meant as well.
    pub(super) fn passages_instead(&self, noun: &Noun) -> String {
        let doors = |k: &KindId| self.lexicon().kind(*k).extension == Extension::Doors;
        let plain = noun.head.kinds.iter().any(doors) && noun.filters.is_empty();
        let kinds = self.lexicon().kind_of(&Extension::Passages).into_iter().collect();
        let passages = Noun { head: Head { kinds, ..Head::default() }, ..noun.clone() };
        let open = plain.then(|| self.find(&passages, false).ok()).flatten().unwrap_or_default();
        let counted = self.counted(&passages, open.len());
        match (open.len(), self.is_russian()) {
            (0, _) => String::new(),
            (_, true) => format!(", но есть {counted}"),
            (1, false) => format!(", but there is {counted}"),
            (_, false) => format!(", but there are {counted}"),
        }
    }

    /// Where nothing is right beside a thing, what stands nearest to it in its room.
    fn nearest_instead(&self, noun: &Noun) -> String {
        let Some((away, thing)) = self.nearest_beside(noun) else { return String::new() };
        let (name, away) = (self.name(thing), length(away, self.language));
        match self.is_russian() {
            true => format!(", ближе всего {name} ({away})"),
            false => format!("; the nearest is {name} ({away})"),
        }
    }

    pub(super) fn nearest_beside(&self, noun: &Noun) -> Option<(f64, Thing)> {
        let [place] = &noun.restrictions[..] else { return None };
        let [anchor] = self.anchor_things(noun)[..] else { return None };
        let general = noun.head.anything && noun.filters.is_empty() && !noun.other;
        if place.rel != Rel::NextTo || place.negated || !general {
            return None;
        }
        let near = self.related(Rel::Near, anchor).into_iter();
        let near = near.filter(|t| self.area_of(*t) == self.area_of(anchor));
        let near = near.filter_map(|t| Some((self.distance(t, anchor)?, t)));
        // What touches the thing lies on it or carries it.
        let apart = self.relations.thresholds().touch_gap;
        // A picture hangs over what stands under it, rather than beside it.
        let hangs = |t: Thing| self.held_by_room(t) == Some(Held::OnWall);
        let nearest = near.filter(|(away, t)| *away >= apart && (!hangs(*t) || hangs(anchor)));
        nearest.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
    }
}

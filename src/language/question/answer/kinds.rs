//! Kinds of things instead of the things, and what is said of people.
//!
//! Invariant: a kind is counted where at least one thing of it was found.

use std::collections::BTreeMap;

use super::Draft;
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::{Extension, lower_first};
use crate::question::query::{Head, Noun, Rel, Restriction, Thing};
use crate::question::{Doubt, Said};
use crate::words::{Case, NounPhrase, Number, WordHints, english, enumerate, russian};

/// So many people are told of, at most.
const MOST_TOLD: usize = 12;

impl Knowledge<'_> {
    /// "There are 3 kinds: a bed, 2 bedside tables and a wardrobe."
    pub(super) fn say_kinds(&self, of: &Noun, count: bool) -> Result<Draft, Doubt> {
        if let Some(draft) = self.kinds_in_each(of)? {
            return Ok(draft);
        }
        let found = self.find(of, false)?;
        let place = self.restrictions(of);
        if found.is_empty() {
            let text = self.nothing_found(of, &place);
            return Ok(Draft::new(Said::Nothing, text));
        }
        let kinds: BTreeMap<String, usize> =
            self.by_kind(&found).into_iter().map(|(kind, things)| (kind, things.len())).collect();
        let each = |(kind, number): (&String, &usize)| match number {
            1 => kind.clone(),
            n => format!("{kind} ({n})"),
        };
        let list = enumerate(&kinds.iter().map(each).collect::<Vec<_>>(), self.language);
        let number = kinds.len();
        let blank = if place.is_empty() { "" } else { " " };
        let text = match self.is_russian() {
            true => {
                let kind = NounPhrase::parse("вид", &WordHints::default());
                let counted = russian::count(number as u64, &kind);
                format!("{place}{blank}{counted} {}: {list}", self.of_kind(of))
            }
            false => {
                let verb = if number == 1 { "is" } else { "are" };
                let counted = english::count(number as u64, "kind");
                format!("there {verb} {counted} of {}{blank}{place}: {list}", self.of_kind(of))
            }
        };
        let draft = Draft::new(Said::Found, text).with(found);
        Ok(if count { draft.number(number as f64) } else { draft })
    }

    fn by_kind(&self, found: &[Thing]) -> BTreeMap<String, Vec<Thing>> {
        let mut kinds: BTreeMap<String, Vec<Thing>> = BTreeMap::new();
        for thing in found {
            let kind = self.kind_name(*thing).unwrap_or_else(|| self.name(*thing));
            kinds.entry(kind.to_lowercase()).or_default().push(*thing);
        }
        kinds
    }

    /// "What is both in the kitchen and in the hall?": the kinds of which something is in each of the rooms.
    fn kinds_in_each(&self, of: &Noun) -> Result<Option<Draft>, Doubt> {
        let is_room = |place: &&Restriction| {
            let room = |anchor: &Noun| {
                let found = self.find(anchor, true);
                found.is_ok_and(|found| {
                    !found.is_empty() && found.iter().all(|t| t.area().is_some())
                })
            };
            matches!(place.rel, Rel::In | Rel::On)
                && !place.negated
                && matches!(&place.anchors[..], [only] if room(only))
        };
        let rooms: Vec<Restriction> = of.restrictions.iter().filter(is_room).cloned().collect();
        if rooms.len() < 2 {
            return Ok(None);
        }
        let mut others = of.clone();
        others.restrictions.retain(|place| !rooms.contains(place));
        let mut common: Option<BTreeMap<String, Vec<Thing>>> = None;
        let mut places = Vec::new();
        for room in rooms {
            let mut here = others.clone();
            here.restrictions.push(room.clone());
            let mut kinds = self.by_kind(&self.find(&here, false)?);
            if let Some(before) = common {
                kinds.retain(|kind, things| {
                    let earlier = before.get(kind);
                    things.splice(0..0, earlier.into_iter().flatten().copied());
                    earlier.is_some()
                });
            }
            common = Some(kinds);
            places.push(self.restrictions(&Noun { restrictions: vec![room], ..Noun::default() }));
        }
        let common = common.unwrap_or_default();
        let kinds: Vec<String> = common.keys().cloned().collect();
        let things: Vec<Thing> = common.into_values().flatten().collect();
        let list = enumerate(&kinds, self.language);
        let number = kinds.len() as u64;
        let text = match (kinds.is_empty(), self.is_russian()) {
            (false, true) => {
                let counted =
                    russian::count(number, &NounPhrase::parse("вид", &WordHints::default()));
                format!("и {} есть {counted} {}: {list}", places.join(", и "), self.of_kind(of))
            }
            (false, false) => {
                let verb = if number == 1 { "is" } else { "are" };
                let counted = english::count(number, "kind");
                let of = self.of_kind(of);
                format!("{counted} of {of} {verb} both {}: {list}", places.join(" and "))
            }
            (true, true) => format!(
                "нет таких видов {}, которые были бы и {}",
                self.of_kind(of),
                places.join(", и ")
            ),
            (true, false) => {
                format!("no kind of {} is both {}", self.of_kind(of), places.join(" and "))
            }
        };
        let said = if kinds.is_empty() { Said::Nothing } else { Said::Found };
        Ok(Some(Draft::new(said, text).with(things).number(number as f64)))
    }

    /// «мебели», "books": of what there are kinds.
    fn of_kind(&self, of: &Noun) -> String {
        let Some(kind) = of.head.kinds.first().map(|id| self.lexicon().kind(*id)) else {
            return self.pick("вещей", "things").to_owned();
        };
        let mass = ["furniture", "lighting", "food", "cutlery", "crockery", "electronics", "fruit"];
        let russian = ["мебель", "еда", "пища", "посуда", "электроника", "техника", "свет"];
        let said = crate::units::name_key(kind.phrase.name());
        let is_mass = mass.contains(&kind.english.as_str()) || russian.contains(&said.as_str());
        match self.is_russian() {
            true => {
                let number = if is_mass && kind.phrase.name() != "фрукт" {
                    Number::Singular
                } else {
                    Number::Plural
                };
                lower_first(&kind.phrase.form(Case::Genitive, number))
            }
            false if is_mass => {
                let plain = kind.english.strip_prefix("piece of ").unwrap_or(&kind.english);
                plain.to_owned()
            }
            false => english::plural(&kind.english),
        }
    }

    /// Of people the map knows those whom it has among its things.
    pub(super) fn people(&self, within: &[Restriction]) -> Result<Draft, Doubt> {
        let all = self.members(&Extension::Trait("person"));
        if all.is_empty() {
            return Ok(self.no_people());
        }
        let head = Head { things: Some(all.clone()), ..Head::default() };
        let noun = Noun { head, plural: true, restrictions: within.to_vec(), ..Noun::default() };
        let found = self.find(&noun, false)?;
        let where_each = |people: &[Thing]| {
            let told = people.iter().take(MOST_TOLD).map(|t| self.where_one(*t, &mut Vec::new()));
            let more = people.len().saturating_sub(MOST_TOLD);
            let more = (more > 0).then(|| match self.is_russian() {
                true => format!("и ещё {more}"),
                false => format!("and {more} more"),
            });
            told.chain(more).collect::<Vec<_>>().join("; ")
        };
        if found.is_empty() {
            let (place, elsewhere) = (self.restrictions(&noun), where_each(&all));
            let text = match self.is_russian() {
                true => format!("{place} нет никого из людей, которых знает карта: {elsewhere}"),
                false => format!("none of the people whom the map knows is {place}: {elsewhere}"),
            };
            return Ok(Draft::new(Said::Nothing, text).about(&all));
        }
        let number = found.len() as f64;
        Ok(Draft::new(Said::Found, where_each(&found)).with(found).number(number))
    }

    fn no_people(&self) -> Draft {
        let text = self.pick(
            "людей карта не знает: на ней только помещения и вещи",
            "the map knows no people: only rooms and things are on it",
        );
        Draft::new(Said::Unknown, text.to_owned())
    }
}

//! What several things share: a room or a table, values and sizes; and in what two things differ.
//!
//! Invariant: only what the map gives of each is compared.

use super::Draft;
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::Extension;
use crate::question::query::{Noun, Rel, Thing};
use crate::question::values::Property;
use crate::question::{Doubt, Said};
use crate::units::name_key;

impl Knowledge<'_> {
    /// All things that several descriptions mean, each once.
    pub(super) fn all_meant(&self, of: &[Noun]) -> Result<Vec<Thing>, Doubt> {
        let mut found: Vec<Thing> = Vec::new();
        for noun in of {
            for thing in self.definite(noun)? {
                if !found.contains(&thing) {
                    found.push(thing);
                }
            }
        }
        Ok(found)
    }

    /// Of several that were called so there is one; of a pronoun it is not known what it means.
    pub(super) fn one_of_several(&self, noun: &Noun, found: &[Thing]) -> Doubt {
        match noun.head.kinds.is_empty() {
            true => Doubt::NoReferent { word: noun.text.clone() },
            false => Doubt::TooFew { found: found.to_vec() },
        }
    }

    /// «да, Тумбочка-1 и Тумбочка-2 находятся в Комнате-Y»
    pub(super) fn together(&self, of: &[Noun], rel: Rel, place: &Noun) -> Result<Draft, Doubt> {
        let found = self.all_meant(of)?;
        if let ([only], [_]) = (of, &found[..]) {
            return Err(self.one_of_several(only, &found));
        }
        let of_kind = Noun { plural: true, indefinite: true, ..place.clone() };
        let places = self.find(&of_kind, true)?;
        let mut by_place: Vec<(Option<Thing>, String, Vec<Thing>)> = Vec::new();
        for &thing in &found {
            let own = places.iter().copied().find(|place| self.holds(rel, thing, *place));
            let words = match own {
                Some(place) => self.place(rel, &[place]),
                None => self.short_place(thing, &mut Vec::new()),
            };
            match by_place.iter_mut().find(|(_, other, _)| *other == words) {
                Some((_, _, things)) => things.push(thing),
                None => by_place.push((own, words, vec![thing])),
            }
        }
        let parts = by_place
            .iter()
            .map(|(_, place, things)| format!("{} {} {place}", self.list(things), self.is(things)));
        let parts: Vec<String> = parts.collect();
        // Of a «место» in general the words alone tell which it is.
        let general = places.is_empty() || self.is_general_place(place);
        let yes = by_place.len() == 1 && (general || by_place[0].0.is_some());
        let facts = by_place.iter().flat_map(|(place, _, things)| {
            things.iter().filter_map(move |t| self.fact(rel, *t, (*place)?))
        });
        let facts = facts.collect();
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let text = match parts.split_last() {
            Some((last, before)) if !before.is_empty() => {
                format!("{head}{}{}{last}", before.join("; "), self.pick(", а ", ", and "))
            }
            _ => format!("{head}{}", parts.join("")),
        };
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft { facts, ..Draft::new(said, text).with(found) })
    }

    /// «в одном месте», "in the same place"
    fn is_general_place(&self, noun: &Noun) -> bool {
        let places = |k: &_| self.lexicon().kind(*k).extension == Extension::Places;
        noun.head.kinds.iter().any(places)
    }

    /// «цвет: Диван-1 – коричневый, Кресло-1 – чёрное; …»
    pub(super) fn differ(&self, of: &[Noun], alike: bool) -> Result<Draft, Doubt> {
        let found = self.all_meant(of)?;
        let [a, b] = found[..] else {
            let words = of.iter().map(|noun| noun.text.as_str()).collect::<Vec<_>>().join(", ");
            return Err(Doubt::NotUnderstood { words });
        };
        let (first, second) = (self.told_of(a), self.told_of(b));
        let mut same: Vec<String> = Vec::new();
        let mut other: Vec<String> = Vec::new();
        for (what, one) in &first {
            let Some((_, two)) = second.iter().find(|(w, _)| w == what) else { continue };
            match one == two {
                true => same.push(format!("{what} – {one}")),
                false => other.push(format!(
                    "{what}: {} – {one}, {} – {two}",
                    self.name(a),
                    self.name(b)
                )),
            }
        }
        let shown = if alike { same } else { other };
        let text = match (shown.is_empty(), alike, self.is_russian()) {
            (false, true, true) => format!("общее: {}", shown.join("; ")),
            (false, true, false) => format!("in common: {}", shown.join("; ")),
            (false, false, _) => shown.join("; "),
            (true, true, true) => "на карте у них ничего общего не указано".to_owned(),
            (true, true, false) => "the map gives nothing that they have in common".to_owned(),
            (true, false, true) => "по карте они ничем не отличаются".to_owned(),
            (true, false, false) => "by the map they do not differ".to_owned(),
        };
        let said = if shown.is_empty() { Said::Nothing } else { Said::Found };
        Ok(Draft::new(said, text).with(found))
    }

    /// What the map gives of a thing, each under its name: kind, values, sizes, place.
    fn told_of(&self, thing: Thing) -> Vec<(String, String)> {
        let mut told: Vec<(String, String)> = Vec::new();
        let kind = self.kind_name(thing).map(|kind| kind.to_lowercase());
        told.extend(kind.map(|kind| (self.pick("вид", "kind").to_owned(), kind)));
        for (property, value, text) in self.told_values(thing) {
            let said = match value {
                // A yes or no is no value of the lexicon's.
                _ if is_flag(&text) => self.value_told(&text),
                Some(value) if property == Property::Material => {
                    self.value_of(&property, value, thing)
                }
                // Of both things in one gender: «цвет: белый».
                Some(value) if self.is_russian() => {
                    self.lexicon().values.entry(value).russian.clone()
                }
                Some(value) => self.value(value, thing),
                None => self.value_told(&text).to_lowercase(),
            };
            told.push((property.noun(self.language), said));
        }
        let size = self.sizes(thing);
        told.extend(size.map(|size| (self.pick("размеры", "size").to_owned(), size)));
        if thing.area().is_none() {
            let place = self.in_room(thing);
            told.extend(place.map(|place| (self.pick("место", "place").to_owned(), place)));
        }
        told
    }
}

/// Whether a value only says that something is so or is not.
fn is_flag(text: &str) -> bool {
    matches!(&*name_key(text), "да" | "нет" | "yes" | "no" | "true" | "false")
}

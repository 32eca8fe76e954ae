//! Parts of things that are asked for by their kind: legs of a chair, shelves of a bookcase, doors of a wardrobe.
//!
//! Invariant: a thing whose parts the map does not tell is said to be so, and not to have none.

use super::Draft;
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::Extension;
use crate::question::query::{Noun, Rel, Restriction, Thing};
use crate::question::{Doubt, Said};

impl Knowledge<'_> {
    /// The owner of the parts that a description asks for, and how many there are; none when it asks for no parts.
    fn owned_parts(&self, noun: &Noun) -> Result<Option<(Thing, Option<usize>)>, Doubt> {
        let lexicon = self.lexicon();
        let extension = |k: &_| lexicon.kind(*k).extension;
        let kinds: Vec<Extension> = noun.head.kinds.iter().map(extension).collect();
        let door = |e: &Extension| matches!(e, Extension::Doors | Extension::DoorType(_));
        let part = |e: &Extension| matches!(e, Extension::Part(_));
        if !kinds.iter().any(part) && !kinds.iter().any(door) {
            return Ok(None);
        }
        // "the wardrobe in the bedroom": the room tells which wardrobe.
        let (places, owners): (Vec<_>, Vec<_>) = noun.restrictions.iter().partition(|r| {
            noun.restrictions.len() > 1
                && !r.negated
                && r.anchors
                    .iter()
                    .all(|a| self.find(a, true).is_ok_and(|f| f.iter().all(|t| t.area().is_some())))
        });
        let [Restriction { rel, anchors, negated: false }] = owners[..] else {
            return Ok(None);
        };
        let belongs = matches!(
            rel,
            Rel::In | Rel::On | Rel::Of | Rel::NextTo | Rel::Has | Rel::Bears | Rel::At
        );
        let [anchor] = &anchors[..] else { return Ok(None) };
        let mut anchor = anchor.clone();
        anchor.restrictions.extend(places.into_iter().cloned());
        let anchor = &anchor;
        if !belongs {
            return Ok(None);
        }
        let found = self.find(anchor, true)?;
        let objects = found.iter().filter_map(|t| {
            self.world.objects.get(&self.world.replicas.get(&t.replica()?)?.object)
        });
        let mut objects: Vec<_> = objects.collect();
        if objects.is_empty() || objects.len() != found.len() {
            return Ok(None);
        }
        // Of any of several equal chairs the answer is the same.
        objects.dedup_by_key(|o| o.id);
        let [object] = objects[..] else {
            // Things that stand there are found as things are.
            let things = kinds.iter().any(|e| matches!(e, Extension::ObjectType(_)));
            return if things { Ok(None) } else { Err(self.ambiguous(anchor, &found)) };
        };
        let is_of = |item: &&crate::map::Item| {
            let frame = self.world.orthoframes.get(&item.orthoframe);
            let kind = frame.and_then(|f| f.frame_type);
            kinds.iter().any(|e| matches!(e, Extension::Part(id) if Some(*id) == kind))
        };
        let parts = object.items.iter().filter(is_of).count();
        // A wardrobe's double door is two to those who open it.
        let leaves = |m: &crate::map::DoorMount| {
            self.world.doors.get(&m.door).map_or(1, |d| d.leaves.len().max(1))
        };
        let doors = match kinds.iter().any(door) {
            true => object.doors.iter().map(leaves).sum(),
            false => 0,
        };
        let things = self.find(noun, true)?;
        if parts + doors == 0 && (!things.is_empty() || kinds.iter().any(door)) {
            return Ok(None);
        }
        // One body is no description of parts.
        let told = object.items.len() > 1 || parts + doors > 0;
        Ok(Some((found[0], told.then_some(parts + doors))))
    }

    /// The thing that has the parts a description asks for; none when it asks for no parts, or the thing has none.
    pub(super) fn owner_of_parts(&self, noun: &Noun) -> Result<Option<Thing>, Doubt> {
        let owned = self.owned_parts(noun)?;
        Ok(owned.filter(|(_, number)| number.is_some_and(|n| n > 0)).map(|(owner, _)| owner))
    }

    pub(super) fn count_parts(&self, noun: &Noun) -> Result<Option<Draft>, Doubt> {
        let Some((owner, number)) = self.owned_parts(noun)? else { return Ok(None) };
        Ok(Some(self.say_parts(noun, owner, number, "")))
    }

    pub(super) fn has_parts(&self, noun: &Noun) -> Result<Option<Draft>, Doubt> {
        let Some((owner, number)) = self.owned_parts(noun)? else { return Ok(None) };
        let head = match number {
            Some(0) => self.pick("нет, ", "no, "),
            Some(_) => self.pick("да, ", "yes, "),
            None => "",
        };
        let said = match number {
            Some(0) => Said::No,
            Some(_) => Said::Yes,
            None => Said::Unknown,
        };
        Ok(Some(Draft { said: Some(said), ..self.say_parts(noun, owner, number, head) }))
    }

    fn say_parts(&self, noun: &Noun, owner: Thing, number: Option<usize>, head: &str) -> Draft {
        let noun = Noun { restrictions: Vec::new(), ..noun.clone() };
        let name = self.name(owner);
        let at = self.place(Rel::At, &[owner]);
        let text = match (number, self.is_russian()) {
            (None, true) => {
                let of = self.form(owner, crate::Case::Genitive);
                format!("части {of} на карте не описаны")
            }
            (None, false) => format!("the map does not tell the parts of {name}"),
            (Some(0), true) => format!("{head}{at} нет {}", self.none_of(&noun)),
            (Some(0), false) => format!("{head}{name} has no {}", self.none_of(&noun)),
            (Some(n), true) => format!("{head}{at} {}", self.counted(&noun, n)),
            (Some(n), false) => format!("{head}{name} has {}", self.counted(&noun, n)),
        };
        let said = if number.is_some() { Said::Found } else { Said::Unknown };
        let draft = Draft::new(said, text).with(vec![owner]);
        match number {
            Some(n) => draft.number(n as f64),
            None => draft,
        }
    }
}

//! What the names in a step mean: records of the tree, found as the map or this file spells them, or in another form.

use super::Steps;
use super::word::{Outcome, Step, misprint, text_of};
use crate::Entity;
use crate::fault::MapError;
use crate::file::decode::{likely, shortened};
use crate::file::edit::tree::{Handle, Kind};
use crate::file::node::{Node, Value};

impl Steps<'_> {
    /// What a name means among some kinds: as the map or this file spells it, else in another form.
    pub(super) fn find(&self, node: &Node, kinds: &[Kind]) -> Outcome<Handle> {
        let name = text_of(node)?;
        let mut found = self.tree.find(name, kinds);
        if found.is_empty() {
            let in_other_words = (self.names)(name);
            found = in_other_words.iter().filter_map(|e| self.known(*e, kinds)).collect();
        }
        match found[..] {
            [only] => Ok(only),
            [] => {
                let what = if let [kind] = kinds { kind.title() } else { ("Имя", "Name") };
                let what = what.into();
                let nearest = self.tree.nearest(name, kinds);
                let error = MapError::UnknownReference { what, name: shortened(name), nearest };
                Err(misprint(error, &node.span))
            }
            _ => {
                let candidates: Vec<String> =
                    found.iter().map(|h| format!("«{}»", self.tree.reference(*h))).collect();
                let (name, candidates) = (shortened(name), candidates.join(", "));
                Err(misprint(MapError::AmbiguousName { name, candidates }, &node.span))
            }
        }
    }

    fn known(&self, entity: Entity, kinds: &[Kind]) -> Option<Handle> {
        let w = self.world;
        let (kind, name) = match entity {
            Entity::Map(id) => (Kind::Map, &w.maps.get(&id)?.key),
            Entity::Area(id) => (Kind::Area, &w.areas.get(&id)?.key),
            Entity::Door(id) => (Kind::Door, &w.doors.get(&id)?.key),
            Entity::Replica(id) => (Kind::Replica, &w.replicas.get(&id)?.name),
            Entity::Place(id) => (Kind::Place, &w.places.get(&id)?.name),
            Entity::Zone(id) => (Kind::Zone, &w.zones.get(&id)?.key),
        };
        if !kinds.contains(&kind) {
            return None;
        }
        match self.tree.find(name, &[kind])[..] {
            [only] => Some(only),
            _ => None,
        }
    }

    /// A reference to what a field names, in the words of the map.
    pub(super) fn reference(&self, node: &Node, kinds: &[Kind]) -> Outcome<Node> {
        let text = self.tree.reference(self.find(node, kinds)?);
        Ok(Node { span: node.span.clone(), value: Value::Text(text) })
    }

    /// The kinds that a step may speak of: all of these, or the one that it names.
    pub(super) fn kinds(&self, step: &Step<'_>, all: &[Kind]) -> Outcome<Vec<Kind>> {
        let Some(node) = step.field("kind") else { return Ok(all.to_vec()) };
        let word = text_of(node)?;
        let words: Vec<&str> = all.iter().map(|k| k.word()).collect();
        match all.iter().find(|k| k.word() == word) {
            Some(kind) => Ok(vec![*kind]),
            None => Err(misprint(
                MapError::UnknownWord {
                    word: shortened(word),
                    nearest: likely(word, &words),
                    expected: words.join(", "),
                },
                &node.span,
            )),
        }
    }

    pub(super) fn change(&mut self, at: Handle) -> &mut Node {
        self.tree.get_mut(at).expect("a handle leads to its record")
    }
}

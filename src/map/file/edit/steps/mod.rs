//! The steps of an edit file, each a change of the tree.

mod bonds;
mod names;
mod news;
mod records;
mod standing;
mod things;
mod traits;
mod walls;
mod word;
mod zones;

use std::collections::BTreeSet;

use super::NextIds;
use super::tree::{Kind, Tree};
use crate::fault::MapError;
use crate::file::decode::{NUMBER, likely, shortened};
use crate::file::node::{Misprint, Node, Span, Value};
use crate::file::schema::FORMAT;
use crate::units::ReplicaId;
use crate::{Entity, World};

use word::{Done, Step, misprint, text_of, unknown_field, wrong_kind};

/// Every verb with the fields that may stand beside it.
const VERBS: &[(&str, &[&str])] = &[
    (
        "place",
        &[
            "object",
            "area",
            "at",
            "pose",
            "angle",
            "name_en",
            "move_prob",
            "properties",
            "doors",
            "forms",
        ],
    ),
    ("point", &["area", "at", "pose", "heading", "serves", "name_en", "forms"]),
    ("move", &["to", "by", "area", "carry"]),
    ("turn", &["to", "by", "carry"]),
    ("remove", &["kind"]),
    ("rename", &["to", "en", "forms", "kind"]),
    ("set", &["property", "value", "side", "move_prob", "kind"]),
    ("unset", &["property", "side", "kind"]),
    ("state", &["is", "opening", "on"]),
    ("bind", &["to", "side", "opens"]),
    ("unbind", &["from"]),
    ("item", &["of", "orthoframe", "at", "angle", "base"]),
    ("link", &["to", "of", "rel", "angle"]),
    ("unlink", &["to", "of"]),
    ("stand", &["map", "at", "angle", "base", "relink"]),
    ("include", &["at", "angle", "base"]),
    ("lift", &["stops"]),
    ("zone", ZONE),
    ("cut", &["side", "from", "to", "as", "type", "permeability"]),
    ("shape", &["points", "item"]),
];

/// Whether a step may be told by this word.
pub(super) fn is_verb(word: &str) -> bool {
    VERBS.iter().any(|(verb, _)| *verb == word)
}

/// What can be said of a zone, in the words of the map file.
const ZONE: &[&str] = &[
    "kind",
    "rooms",
    "map",
    "points",
    "speed",
    "heading",
    "reason",
    "reason_en",
    "from",
    "until",
    "name_en",
    "forms",
];

/// What may stand in an edit file beside `edit`.
const SECTIONS: [&str; 11] = [
    "format",
    "reason",
    "edit",
    "robot",
    "type",
    "orthoframe",
    "door",
    "object",
    "area",
    "map",
    "zone",
];
const GROUPS: &[Kind] = &[Kind::Area, Kind::Object];

pub(super) struct Steps<'a> {
    pub(super) tree: Tree,
    world: &'a World,
    ids: NextIds,
    names: &'a dyn Fn(&str) -> Vec<Entity>,
    pub(super) misprints: Vec<Misprint>,
    pub(super) reason: Option<String>,
    /// What is moved with all that stands on it.
    pub(super) carriers: BTreeSet<ReplicaId>,
    /// The place of the only step, if there is but one: what it spoils elsewhere is told there.
    pub(super) only: Option<Span>,
}

impl<'a> Steps<'a> {
    pub(super) fn new(
        tree: Tree,
        world: &'a World,
        ids: NextIds,
        names: &'a dyn Fn(&str) -> Vec<Entity>,
    ) -> Self {
        Self {
            tree,
            world,
            ids,
            names,
            misprints: Vec::new(),
            reason: None,
            carriers: BTreeSet::new(),
            only: None,
        }
    }

    /// Works a whole file in: what is new first, then the steps in their order.
    pub(super) fn take(&mut self, edits: &Node) {
        for entry in edits.entries() {
            let done = match entry.key.as_str() {
                "format" => check_format(&entry.node),
                "reason" => text_of(&entry.node).map(|r| self.reason = Some(r.to_owned())),
                "type" => {
                    self.types(&entry.node);
                    Ok(())
                }
                "edit" => Ok(()),
                "robot" => self.robot(&entry.node),
                other => {
                    match Kind::ALL.into_iter().find(|k| k.lines().is_none() && k.word() == other) {
                        Some(kind) => {
                            self.section(kind, entry);
                            Ok(())
                        }
                        None => Err(unknown_field(entry, &SECTIONS)),
                    }
                }
            };
            self.misprints.extend(done.err().map(|fault| *fault));
        }
        let Some(list) = edits.entry("edit") else { return };
        if !matches!(list.node.value, Value::List(_)) {
            self.misprints.push(*wrong_kind(
                &list.node,
                ("список шагов [[edit]]", "a list of steps [[edit]]"),
            ));
        }
        for node in list.node.elements() {
            if let Err(fault) = self.step(node) {
                self.misprints.push(*fault);
            }
        }
        if let ([only], true) = (
            list.node.elements(),
            edits.entries().iter().all(|e| ["edit", "reason", "format"].contains(&e.key.as_str())),
        ) {
            let verb = only.entries().iter().find(|e| is_verb(&e.key));
            self.only = verb.map(|v| v.key_span.start..v.node.span.end.max(v.key_span.end));
        }
    }

    fn step(&mut self, node: &Node) -> Done {
        let verbs: Vec<&str> = VERBS.iter().map(|(verb, _)| *verb).collect();
        let Some(verb) = node.entries().iter().find(|e| verbs.contains(&e.key.as_str())) else {
            let expected = verbs.join(", ");
            return Err(match node.entries().first() {
                None => wrong_kind(
                    node,
                    ("шаг правки: таблица с глаголом", "a step of an edit: a table with a verb"),
                ),
                Some(first) => misprint(
                    MapError::UnknownVerb {
                        found: shortened(&first.key),
                        nearest: likely(&first.key, &verbs),
                        expected,
                    },
                    &first.key_span,
                ),
            });
        };
        let (_, fields) = VERBS.iter().find(|(v, _)| *v == verb.key).expect("found by its name");
        let mut whole = true;
        for entry in node.entries().iter().filter(|e| e.key != verb.key) {
            if !fields.contains(&entry.key.as_str()) {
                self.misprints.push(*unknown_field(entry, fields));
                whole = false;
            }
        }
        let step = Step { node, verb };
        if !whole {
            return Ok(());
        }
        match verb.key.as_str() {
            "place" => self.place(&step),
            "point" => self.point(&step),
            "move" => self.shift(&step),
            "turn" => self.turn(&step),
            "remove" => self.remove(&step),
            "rename" => self.rename(&step),
            "set" => self.set(&step),
            "unset" => self.unset(&step),
            "state" => self.state(&step),
            "bind" => self.bind(&step),
            "unbind" => self.unbind(&step),
            "item" => self.item(&step),
            "link" => self.link(&step),
            "unlink" => self.unlink(&step),
            "stand" => self.stand(&step),
            "include" => self.include(&step),
            "zone" => self.zone(&step),
            "cut" => self.cut(&step),
            "shape" => self.shape(&step),
            _ => self.lift(&step),
        }
    }
}

fn check_format(node: &Node) -> Done {
    match node.value {
        Value::Integer(n) if n == i64::from(FORMAT) => Ok(()),
        Value::Integer(n) => Err(misprint(MapError::Format { found: n.to_string() }, &node.span)),
        _ => Err(wrong_kind(node, NUMBER)),
    }
}

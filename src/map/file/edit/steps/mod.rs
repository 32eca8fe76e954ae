//! The steps of an edit, each a change of the world.

mod bonds;
mod brings;
mod late;
mod names;
mod records;
mod standing;
mod things;
mod traits;
mod walls;
mod zones;

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use super::Naming;
use super::NextIds;
use super::edits::{Edits, Told};
use super::kind::Kind;
use super::said::Said;
use super::verbs::{Edit, MAKING};
use super::word::{Done, Outcome, misprint};
use crate::World;
use crate::fault::{Fault, MapError, Record};
use crate::file::decode::{MODEST_NUMBER, a_number, expected_words};
use crate::file::node::{Entry, Misprint, Node, Span};
use crate::file::read::{MOST_GUESSES, Reader};
use crate::file::schema::{Coordinates, Number};
use crate::units::{Cm, Deg, Frame, Piece, ReplicaId, ZoneId};

use late::Late;
use names::Keys;
use zones::Draft;

/// A world on its way through edits.
pub(super) struct Steps<'a> {
    /// What it has become so far. Zones that are spoken of are in `zones`.
    pub(super) world: World,
    /// As it was.
    start: &'a World,
    ids: NextIds,
    naming: Naming<'a>,
    left_out: &'a HashSet<Span>,
    pub(super) said: Said,
    pub(super) misprints: Vec<Misprint>,
    /// What is wrong with records that were brought.
    pub(super) faults: Vec<Fault>,
    pub(super) broken: BTreeSet<Record>,
    /// What is moved with all that stands on it.
    pub(super) carriers: BTreeSet<ReplicaId>,
    keys: Keys,
    /// Names that edits gave, as they are compared.
    given: HashMap<String, Vec<Record>>,
    /// Records that have an id and are not yet in the world, by their keys.
    coming: BTreeMap<Record, String>,
    coming_keys: HashMap<(Kind, String), Record>,
    /// Names for which a likely one is still looked for among all there are.
    guesses_left: Cell<usize>,
    zones: BTreeMap<ZoneId, Draft>,
    late: Late,
}

/// A step with its places.
pub(super) struct Step<'t> {
    node: &'t Node,
    verb: &'t Entry,
}

impl<'t> Step<'t> {
    /// The place of what the verb is done to.
    fn span(&self) -> &'t Span {
        &self.verb.node.span
    }

    /// The place of the verb, which is that of what the step makes.
    fn key_span(&self) -> &'t Span {
        &self.verb.key_span
    }

    /// The place of the whole of it, as far as one looks.
    fn whole(&self) -> Span {
        self.verb.key_span.start..self.verb.node.span.end.max(self.verb.key_span.end)
    }

    fn entry(&self, field: &str) -> Option<&'t Entry> {
        self.node.entry(field)
    }

    /// The place of a field's value.
    fn at(&self, field: &str) -> &'t Span {
        self.entry(field).map_or(self.span(), |entry| &entry.node.span)
    }

    /// What a step says in these fields, as a map file would.
    fn copies(&self, fields: &[&str]) -> Vec<Entry> {
        self.node.entries().iter().filter(|e| fields.contains(&e.key.as_str())).cloned().collect()
    }

    /// What the step is about, as the field of a record.
    fn verb_as(&self, field: &str) -> Entry {
        Entry { key: field.to_owned(), ..self.verb.clone() }
    }

    fn missing(&self, field: &'static str) -> Box<Misprint> {
        misprint(MapError::MissingField { field }, self.key_span())
    }

    fn bad(&self, field: &str, message: Piece) -> Box<Misprint> {
        misprint(MapError::BadValue { message: message.into() }, self.at(field))
    }
}

impl<'a> Steps<'a> {
    pub(super) fn new(
        world: &'a World,
        ids: NextIds,
        naming: Naming<'a>,
        left_out: &'a HashSet<Span>,
    ) -> Self {
        Self {
            world: world.clone(),
            start: world,
            ids,
            naming,
            left_out,
            said: Said::default(),
            misprints: Vec::new(),
            faults: Vec::new(),
            broken: BTreeSet::new(),
            carriers: BTreeSet::new(),
            keys: Keys::default(),
            given: HashMap::new(),
            coming: BTreeMap::new(),
            coming_keys: HashMap::new(),
            guesses_left: Cell::new(MOST_GUESSES),
            zones: BTreeMap::new(),
            late: Late::default(),
        }
    }

    /// Works edits in: what is new first, then the steps in their order.
    pub(super) fn take(&mut self, edits: &Edits) {
        self.bring(&edits.told);
        for told in &edits.told {
            if let Err(fault) = self.step(told) {
                self.misprints.push(*fault);
            }
        }
        self.finish();
    }

    fn step(&mut self, told: &Told) -> Done {
        let Some(verb) = told.edit.verb().and_then(|verb| told.node.entry(verb)) else {
            return Ok(());
        };
        // What is made is spoken of by others, whatever is wrong with it.
        if told.is_broken && !MAKING.contains(&verb.key.as_str()) {
            return Ok(());
        }
        let step = &Step { node: &told.node, verb };
        match &told.edit {
            Edit::New(_) | Edit::Robot(_) => Ok(()),
            Edit::Place { .. } => self.place(step, &told.edit, told.is_broken),
            Edit::Point { .. } => self.point(step, &told.edit, told.is_broken),
            Edit::Move { name, to, by, area, carry } => {
                let by_how_much = (to.as_ref(), by.as_ref());
                self.shift(step, name, by_how_much, area.as_deref(), *carry)
            }
            Edit::Turn { name, to, by, carry } => self.turn(step, name, (*to, *by), *carry),
            Edit::Remove { name, kind } => self.remove(step, name, kind.as_deref()),
            Edit::Rename { .. } => self.rename(step, &told.edit),
            Edit::Set { .. } => self.set(step, &told.edit),
            Edit::Unset { name, property, side, kind } => {
                self.unset(step, name, property, side.as_deref(), kind.as_deref())
            }
            Edit::State { name, is, opening, on } => {
                self.state(step, name, *is, *opening, on.as_deref())
            }
            Edit::Bind { name, to, side, opens } => {
                self.bind(step, name, to, side, opens.unwrap_or(crate::OpensTo::Inside))
            }
            Edit::Unbind { name, from } => self.unbind(step, name, from.as_deref()),
            Edit::Item { name, of, orthoframe, at, angle, base } => {
                let stands = (at.as_ref(), *angle, *base);
                self.item(step, name, (of, orthoframe), stands)
            }
            Edit::Link { name, to, of, rel, angle } => {
                self.link(step, (name, to), of.as_deref(), frame_of(rel.as_ref(), *angle))
            }
            Edit::Unlink { name, to, of } => self.unlink(step, (name, to), of.as_deref()),
            Edit::Stand { name, map, at, angle, base, relink } => {
                let stands = (at.as_ref(), *angle, *base);
                self.stand(step, name, map.as_deref(), stands, *relink)
            }
            Edit::Include { name, at, angle, base } => {
                self.include(step, name, (at.as_ref(), *angle, *base))
            }
            Edit::Lift { name, stops } => self.lift(step, name, stops),
            Edit::Zone { .. } => self.zone(step, &told.edit, told.is_broken),
            Edit::Cut { .. } => self.cut(step, &told.edit),
            Edit::Shape { name, points, item } => self.shape(step, name, points, item.as_deref()),
        }
    }

    /// Reads what stands in records by the words of a map file.
    fn reading<T>(&mut self, read: impl for<'n> FnOnce(&mut Reader<'n>) -> T) -> T {
        let broken = std::mem::take(&mut self.broken);
        let elsewhere = Box::new(|record| self.said.origin(record));
        let mut reader = Reader::among(self.names(), elsewhere, self.left_out.clone(), broken);
        let value = read(&mut reader);
        let (faults, broken) = reader.finish();
        self.faults.extend(faults);
        self.broken = broken;
        value
    }
}

/// A length that was worked out from others, or its fault.
fn cm(value: f64, at: &Span) -> Outcome<Cm> {
    match Cm::new(value) {
        Ok(length) => Ok(length),
        Err(_) => Err(too_large(value, at)),
    }
}

fn too_large(value: f64, at: &Span) -> Box<Misprint> {
    let (found, expected) = (a_number(value), expected_words(MODEST_NUMBER));
    misprint(MapError::WrongKind { found, expected }, at)
}

/// Where something stands, as a step tells it: what it does not tell is as it would be in a map file.
fn frame_of(at: Option<&Coordinates>, angle: Option<Number>) -> Frame {
    let angle = angle.map_or(Deg::ZERO, |n| Deg::of(n.get()));
    at.map_or(Frame { angle, ..Frame::IDENTITY }, |at| {
        Frame::new(at.x.get(), at.y.get(), at.z.map_or(0.0, Number::get), angle)
    })
}

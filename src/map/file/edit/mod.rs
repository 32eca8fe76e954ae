//! Edits of a map (M11): the steps of the paper's MapUpdater, one transaction a list.
//!
//! An [`Edit`] is a value: a program makes it, and a text tells it. An edit file has the sections of a map file for what is
//! new (`[orthoframe.KEY]`, `[door.KEY]`, `[object.KEY]`, `[area.KEY]`, `[map.KEY]`, `[[type.object]]` and so on), and a list
//! of steps, `[[edit]]`, for all else:
//!
//! ```toml
//! reason = "перестановка"
//! [[edit]]
//! move = "Стул-1"
//! to = [120, 80]
//! [[edit]]
//! state = "Дверь-ВZ"
//! is = "locked"
//! ```
//!
//! Each edit changes the records that it names (`steps`), in a world that shares all else with the one before; what is new
//! is read as a map file is. What changed is checked. So an edit costs what it changes, is refused for what a map file is
//! refused for, and every fault has its place in the text of the edits (`said`).

mod edits;
mod in_file;
mod kind;
mod said;
mod steps;
mod verbs;
mod word;

use std::collections::{BTreeMap, BTreeSet};

use super::node::Span;
use super::report;
use crate::fault::{Fault, MapError};
use crate::units::{ReplicaId, name_key};
use crate::{Entity, MapErrors, NameIndex, TypeKind, World, check};

pub use edits::Edits;
pub use kind::kinds;
pub use verbs::{Edit, NewRecord, RobotSaid};

use kind::Kind;
use steps::Steps;

/// The ids that new records get: ids are never given twice, so whoever keeps the history names them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NextIds {
    pub orthoframe: u32,
    pub object: u32,
    pub area: u32,
    pub map: u32,
    pub door: u32,
    pub replica: u32,
    pub place: u32,
    pub zone: u32,
    pub types: BTreeMap<TypeKind, u32>,
}

impl NextIds {
    /// The ids after the highest of a world, for one that has no history.
    #[must_use]
    pub fn after(world: &World) -> Self {
        let next = |last: Option<u32>| last.map_or(1, |n| n.saturating_add(1));
        let types = TypeKind::ALL.map(|kind| {
            let entries = &world.types.list(kind).entries;
            (kind, next(entries.keys().next_back().map(|id| id.0)))
        });
        Self {
            orthoframe: next(world.orthoframes.keys().next_back().map(|id| id.0)),
            object: next(world.objects.keys().next_back().map(|id| id.0)),
            area: next(world.areas.keys().next_back().map(|id| id.0)),
            map: next(world.maps.keys().next_back().map(|id| id.0)),
            door: next(world.doors.keys().next_back().map(|id| id.0)),
            replica: next(world.replicas.keys().next_back().map(|id| id.0)),
            place: next(world.places.keys().next_back().map(|id| id.0)),
            zone: next(world.zones.keys().next_back().map(|id| id.0)),
            types: types.into(),
        }
    }

    fn of(&mut self, kind: Kind) -> &mut u32 {
        match kind {
            Kind::Replica => &mut self.replica,
            Kind::Area => &mut self.area,
            Kind::Door => &mut self.door,
            Kind::Place => &mut self.place,
            Kind::Zone => &mut self.zone,
            Kind::Map => &mut self.map,
            Kind::Object => &mut self.object,
            Kind::Orthoframe => &mut self.orthoframe,
        }
    }
}

/// What an edit of a map came to.
#[derive(Debug, Clone)]
pub struct EditReading {
    /// Absent when there are errors.
    pub world: Option<World>,
    /// Errors and the warnings that the map did not have before.
    pub faults: MapErrors,
    /// Why the edit is made, if the text says so.
    pub reason: Option<String>,
    /// Replicas that are to take along what stands on them; where to is known to whoever derives relations.
    pub carriers: BTreeSet<ReplicaId>,
}

/// Works edits into a checked world.
///
/// ```
/// use orthoframe_map::{Edit, Edits, Format, NameIndex, Naming, NextIds, World, edit};
/// use orthoframe_units::Source;
///
/// # std::env::set_current_dir("../..").unwrap();
/// let world = World::load("maps/rb2.toml").unwrap();
/// let naming = Naming { exact: &NameIndex::of(&world), in_other_words: &|_| Vec::new() };
/// let text = Source::new("edits.toml", "[[edit]]\nmove = \"Стул-1\"\nto = [9000, 0]\n");
/// let edits = Edits::read(&text, Format::Toml);
/// let done = edit(&world, &edits, &NextIds::after(&world), naming);
/// assert!(done.world.is_none());
/// let fault = &done.faults.faults[0]; // «Стул-1» стоит вне своего помещения …
/// assert_eq!(done.faults.position(fault), Some((3, 6)));
///
/// let value = Edit::Remove { name: "Стул-1".to_owned(), kind: None };
/// let done = edit(&world, &vec![value].into(), &NextIds::after(&world), naming);
/// assert_eq!(done.world.unwrap().replicas.len() + 1, world.replicas.len());
/// ```
#[must_use]
pub fn edit(world: &World, edits: &Edits, ids: &NextIds, naming: Naming<'_>) -> EditReading {
    edit_judged(world, edits, ids, naming, &|_| Vec::new())
}

/// How names that an edit speaks of are understood.
#[derive(Clone, Copy)]
pub struct Naming<'a> {
    /// As the map spells them.
    pub exact: &'a NameIndex,
    /// What a name means that the map does not spell so: another case form, for one.
    pub in_other_words: &'a dyn Fn(&str) -> Vec<Entity>,
}

/// The same, where the edited world has also to please a judge: what that finds is told as the faults of the map are.
pub(super) fn edit_judged(
    world: &World,
    edits: &Edits,
    ids: &NextIds,
    naming: Naming<'_>,
    judge: &dyn Fn(&World) -> Vec<Fault>,
) -> EditReading {
    let source = &edits.source;
    let mut all: Vec<Fault> = edits.misprints.iter().cloned().map(Fault::from).collect();
    if !edits.is_read {
        let faults = report(source, all);
        return EditReading { world: None, faults, reason: None, carriers: BTreeSet::new() };
    }
    let mut steps = Steps::new(world, ids.clone(), naming, &edits.left_out);
    steps.take(edits);
    let Steps { world: edited, said, misprints, faults, broken, carriers, .. } = steps;
    all.extend(misprints.into_iter().map(Fault::from));
    all.extend(faults);
    all.retain(|fault| match &fault.error {
        MapError::UnknownReference { name, .. } => !edits.unread.contains(&name_key(name)),
        _ => true,
    });
    // What a step did not do is missed by others: its own fault is enough.
    let is_whole = all.is_empty();
    let news = if is_whole {
        crate::news(world, &edited, || naming.exact.clone())
    } else {
        let known = check(world);
        let found = super::super::check::check_except(&edited, &broken).into_iter();
        found.filter(|f| !known.iter().any(|k| k.error == f.error)).collect()
    };
    let judged = if is_whole { judge(&edited) } else { Vec::new() };
    for mut fault in news.into_iter().chain(judged) {
        said.locate(&mut fault, &edits.left_out);
        all.push(fault);
    }
    let text = source.text();
    let only = edits.only_step();
    for fault in &mut all {
        fault.spans.retain(|span| span.offset() + span.len() <= text.len());
        if let (true, Some(step)) = (fault.spans.is_empty(), &only) {
            fault.spans.push(Span::clone(step).into());
        }
    }
    if !is_whole && all.iter().any(|fault| !fault.is_warning() && !fault.spans.is_empty()) {
        all.retain(|fault| !fault.spans.is_empty());
    }
    // What is told at one place in the same words is told once.
    all.sort_by_key(|fault| fault.spans.first().map(|span| span.offset()));
    all.dedup_by(|a, b| a.error == b.error && a.spans == b.spans);
    let faults = report(source, all);
    let world = (!faults.has_errors()).then_some(edited);
    EditReading { world, faults, reason: edits.reason.clone(), carriers }
}

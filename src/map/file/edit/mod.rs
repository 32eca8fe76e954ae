//! Edits of a map written as a text (M11): the steps of the paper's MapUpdater, one transaction a file.
//!
//! An edit file has the sections of a map file for what is new (`[orthoframe.KEY]`, `[door.KEY]`, `[object.KEY]`,
//! `[area.KEY]`, `[map.KEY]`, `[[type.object]]` and so on), and a list of steps, `[[edit]]`, for all else:
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
//! The records that the text speaks of are written out as a tree (`part`), the text is worked into it, it is read as any map
//! file is, and the map takes over what became of them. What changed is checked. So an edit can do what a file can say, is
//! refused for what a file is refused for, and every fault has its place in the text of the edits. Where it is not sound, it
//! is worked into the tree of the whole map, so that its faults are told with all the names that there are.

mod part;
mod steps;
mod tree;

use std::collections::{BTreeMap, BTreeSet};

use super::node::{self, Node, Span, Value};
use super::read::{self, Draft};
use super::{Format, LIMIT, report, write};
use crate::fault::{Fault, MapError};
use crate::units::{ReplicaId, Source};
use crate::{Entity, MapErrors, NameIndex, TypeKind, World, check};

pub use tree::kinds;

use part::{Part, into_part, part_of, with_part};
use steps::Steps;
use tree::{Kind, Tree};

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
/// use orthoframe_map::{Format, NameIndex, Naming, NextIds, World, edit};
/// use orthoframe_units::Source;
///
/// # std::env::set_current_dir("../..").unwrap();
/// let world = World::load("maps/rb2.toml").unwrap();
/// let text = Source::new("edits.toml", "[[edit]]\nmove = \"Стул-1\"\nto = [9000, 0]\n");
/// let naming = Naming { exact: &NameIndex::of(&world), in_other_words: &|_| Vec::new() };
/// let done = edit(&world, &text, Format::Toml, &NextIds::after(&world), naming);
/// assert!(done.world.is_none());
/// let fault = &done.faults.faults[0]; // «Стул-1» стоит вне своего помещения …
/// assert_eq!(done.faults.position(fault), Some((3, 6)));
/// ```
#[must_use]
pub fn edit(
    world: &World,
    source: &Source,
    format: Format,
    ids: &NextIds,
    naming: Naming<'_>,
) -> EditReading {
    edit_judged(world, source, format, ids, naming, &|_| Vec::new())
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
    source: &Source,
    format: Format,
    ids: &NextIds,
    naming: Naming<'_>,
    judge: &dyn Fn(&World) -> Vec<Fault>,
) -> EditReading {
    let text = source.text();
    let fail = |faults: Vec<Fault>| EditReading {
        world: None,
        faults: report(source, faults),
        reason: None,
        carriers: BTreeSet::new(),
    };
    if text.len() as u64 > LIMIT {
        let error = MapError::TooLarge { bytes: text.len() as u64, limit: LIMIT };
        return fail(vec![Fault::new(error, Vec::new())]);
    }
    let edits = match node::parse(text, format) {
        Ok(edits) => edits,
        Err(misprints) => return fail(misprints.into_iter().map(Fault::from).collect()),
    };
    if !matches!(&edits.value, Value::Table(entries) if !entries.is_empty()) {
        return fail(vec![Fault::new(MapError::NoEdits, Vec::new())]);
    }
    let work = Work { world, source, edits: &edits, ids, naming, judge };
    // What does not go smoothly is told with all that the map has.
    part_of(world, &edits, &naming)
        .and_then(|part| work.on(Some(&part)))
        .or_else(|| work.on(None))
        .expect("the whole map is always gone through")
}

/// An edit on its way into a map.
struct Work<'a> {
    world: &'a World,
    source: &'a Source,
    edits: &'a Node,
    ids: &'a NextIds,
    naming: Naming<'a>,
    judge: &'a dyn Fn(&World) -> Vec<Fault>,
}

impl Work<'_> {
    /// Works the edits into the tree of the map, or of a part of it; none where they do not go into the part smoothly.
    fn on(&self, part: Option<&Part>) -> Option<EditReading> {
        let Self { world, source, edits, naming, judge, .. } = *self;
        let text = source.text();
        let base = node::parse(
            &write::to_numbered_toml(part.map_or(world, |part| &part.world)),
            Format::Toml,
        )
        .expect("what is written can be parsed");
        let tree = Tree::new(base, text.len());
        let mut steps = Steps::new(tree, world, self.ids.clone(), naming.in_other_words);
        steps.take(edits);
        let Steps { tree, misprints, reason, only, carriers, .. } = steps;
        let root = tree.finish();
        let Draft { world: read, faults, origins, broken, left_out } = read::build(&root);
        let mut all: Vec<Fault> = misprints.into_iter().map(Fault::from).collect();
        all.extend(faults);
        // What a step did not do is missed by others: its own fault is enough.
        let is_whole = all.is_empty();
        if part.is_some() && !is_whole {
            return None;
        }
        let (edited, part) = match part {
            Some(part) => (with_part(world, part, &read), Some(read)),
            None => (read, None),
        };
        let news = if is_whole {
            crate::news(world, &edited, || naming.exact.clone())
        } else {
            let known = check(world);
            let found = super::super::check::check_except(&edited, &broken).into_iter();
            found.filter(|f| !known.iter().any(|k| k.error == f.error)).collect()
        };
        let judged = if is_whole { judge(&edited) } else { Vec::new() };
        for mut fault in news.into_iter().chain(judged) {
            let mut told = fault.clone();
            if let Some(part) = &part {
                told.spots.retain_mut(|spot| into_part(spot, &edited, part));
            }
            told.locate(&origins, &left_out);
            fault.spans = told.spans;
            all.push(fault);
        }
        for fault in &mut all {
            fault.spans.retain(|span| span.offset() + span.len() <= text.len());
            if let (true, Some(step)) = (fault.spans.is_empty(), &only) {
                fault.spans.push(Span::clone(step).into());
            }
        }
        if !is_whole {
            all.retain(|fault| !fault.spans.is_empty());
        }
        // What is told at one place in the same words is told once.
        all.sort_by_key(|fault| fault.spans.first().map(|span| span.offset()));
        all.dedup_by(|a, b| a.error == b.error && a.spans == b.spans);
        let faults = report(source, all);
        let world = (!faults.has_errors()).then_some(edited);
        Some(EditReading { world, faults, reason, carriers })
    }
}

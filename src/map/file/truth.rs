//! What is really so, where a robot believes something else: read from a map file, or from edits of what it believes.
//!
//! A text with `[map.…]`, `[domain]` or `[robot]` and without steps of an edit is a map, which stands for itself; any
//! other is an edit file and works on the believed world. Either is told apart from the believed world by keys and names, see
//! `map/counterpart`.

use std::collections::BTreeSet;

use super::edit::{Edits, edit_judged};
use super::node::{self, Value};
use super::{Format, Naming, NextIds, locate, read, report};
use crate::counterpart::Counterparts;
use crate::fault::{Fault, MapError, MapErrors, Record, Spot};
use crate::units::{ReplicaId, Source};
use crate::{Entity, NameIndex, World};

/// What a text says is really so.
#[derive(Debug, Clone)]
pub struct Truth {
    /// In the ids of the believed world, for what both have. Absent when there are errors.
    pub world: Option<World>,
    /// Every fault of the text; warnings that the believed world has too are not told again.
    pub faults: MapErrors,
    /// Things that are to take along what stands on them, as [`super::EditReading::carriers`].
    pub carriers: BTreeSet<ReplicaId>,
}

/// Reads what is really so. `away` is what nobody finds where `believed` has it: in a hand, or handed over.
/// `in_other_words` is that of [`Naming`].
#[must_use]
pub fn read_truth(
    believed: &World,
    away: &BTreeSet<ReplicaId>,
    source: &Source,
    format: Format,
    in_other_words: &dyn Fn(&str) -> Vec<Entity>,
) -> Truth {
    let in_their_ids =
        |world: &World| Counterparts::of(believed, world).translated(believed, world);
    let faults = |world: &World| Counterparts::of(believed, world).contradictions(believed, world);
    if is_map(source, format) {
        let reading = read(source, format);
        let mut all = reading.faults.faults;
        all.retain(|fault| !fault.is_warning());
        if let Some(world) = &reading.world {
            let mut found = faults(world);
            locate(source, format, &mut found);
            all.extend(found);
        }
        let faults = report(source, all);
        let world = reading.world.filter(|_| !faults.has_errors());
        return Truth {
            world: world.map(|world| in_their_ids(&world)),
            faults,
            carriers: BTreeSet::new(),
        };
    }
    let judge = |edited: &World| {
        let mut found = faults(edited);
        found.extend(away.iter().filter_map(|id| {
            let thing = believed.replicas.get(id)?;
            (edited.replicas.get(id) != Some(thing)).then(|| {
                let error = MapError::Carried { name: thing.name.clone() };
                Fault::new(error, vec![Spot::of(Record::Replica(*id))])
            })
        }));
        found
    };
    let naming = Naming { exact: &NameIndex::of(believed), in_other_words };
    let edits = Edits::read(source, format);
    let done = edit_judged(believed, &edits, &NextIds::after(believed), naming, &judge);
    let world = done.world.map(|world| in_their_ids(&world));
    Truth { world, faults: done.faults, carriers: done.carriers }
}

/// Whether a text is a map; what cannot even be parsed is told as the map reader tells it.
fn is_map(source: &Source, format: Format) -> bool {
    let Ok(root) = node::parse(source.text(), format) else { return true };
    match &root.value {
        Value::Table(entries) if !entries.is_empty() => {
            let has = |key: &str| entries.iter().any(|entry| entry.key == key);
            !has("edit") && !has("reason") && ["domain", "robot", "map"].iter().any(|key| has(key))
        }
        _ => true,
    }
}

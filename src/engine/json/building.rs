//! A map that is checked, taken over, drawn or made of a log, as data.

use std::path::Path;

use serde_json::{Value, json};

use super::faults::warnings;
use super::known::changed;
use super::segments::log_faults;
use super::values::merge;
use crate::engine::{Imported, uncertain_names};
use crate::language::{Case, Language};
use crate::map::{MapErrors, World};
use crate::store::ImportReport;
use crate::vectors::read::LogError;

/// How many of each kind of record a map has.
fn size(world: &World) -> Value {
    json!({
        "maps": world.maps.len(),
        "areas": world.areas.len(),
        "doors": world.doors.len(),
        "objects": world.objects.len(),
        "orthoframes": world.orthoframes.len(),
        "replicas": world.replicas.len(),
        "places": world.places.len(),
    })
}

/// A map without faults, and what there is to doubt in it.
#[must_use]
pub(crate) fn sound_map(world: &World, doubts: &MapErrors, language: Language) -> Value {
    let names: Vec<Value> = uncertain_names(world)
        .iter()
        .map(|phrase| json!({"name": phrase.name(), "genitive": phrase.case(Case::Genitive)}))
        .collect();
    json!({
        "outcome": "sound",
        "warnings": doubts.faults.len(),
        "told": warnings(doubts, language),
        "world": size(world),
        "uncertain_names": names,
    })
}

/// The same map, drawn into a file.
#[must_use]
pub(crate) fn drawn_map(doubts: &MapErrors, drawing: &Path) -> Value {
    json!({"outcome": "sound", "warnings": doubts.faults.len(), "file": drawing})
}

/// A building taken over, with the report of what became of it.
#[must_use]
pub(crate) fn imported(world: &World, imported: &Imported, language: Language) -> Value {
    let mut view = changed("imported", &imported.report);
    merge(
        &mut view,
        json!({
            "warnings": imported.warnings.faults.len(),
            "profile": world.domain.profile.name(),
            "world": size(world),
            "report": imported.reading.to_json(language),
        }),
    );
    view
}

/// The tables of a store taken over as they are.
#[must_use]
pub(crate) fn imported_tables(world: &World, report: &ImportReport) -> Value {
    let mut view = changed("imported", report);
    merge(&mut view, json!({ "warnings": 0, "world": size(world) }));
    view
}

/// A map made of what a log saw: how many rooms, doorways and things.
#[must_use]
pub(crate) fn map_of_log(
    file: &Path,
    [rooms, doors, things]: [usize; 3],
    log: Option<&LogError>,
) -> Value {
    json!({
        "outcome": "map", "file": file.display().to_string(),
        "rooms": rooms, "doors": doors, "things": things, "faults": log_faults(log),
    })
}

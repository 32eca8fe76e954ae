//! What is believed of things, what was edited, and the history, as data.

use serde_json::{Value, json};

use super::faults::warnings;
use super::values::{merge, tuple};
use crate::engine::{Believed, Difference, Edited, Error, Revision, Source, State};
use crate::language::Language;
use crate::map::World;
use crate::semantics::Relations;
use crate::store::{Cell, Fate, ImportReport, Seen};

/// The facts of a relation, or about a thing, as [`State::facts`] finds them.
///
/// # Errors
/// As [`State::facts`].
pub fn facts(
    state: &State,
    name: Option<&str>,
    of: Option<&str>,
    language: Language,
) -> Result<Value, Error> {
    let (found, relations) = (state.facts(name, of)?, state.relations()?);
    let called = |name: &str| match language {
        // As they come.
        Language::Russian => name.to_owned(),
        Language::English => relations.display_name(name, language),
    };
    let rows: Vec<_> = found
        .iter()
        .map(|(name, values)| json!({"relation": called(name), "args": tuple(values)}))
        .collect();
    Ok(json!({ "facts": rows }))
}

fn place(state: &State, seen: &Seen) -> Result<Value, Error> {
    let f = &seen.frame;
    let world = state.world()?;
    let on_map = state.on_map(seen)?.map(|(map, frame)| {
        json!({
            "map": world.maps.get(&map).map(|m| m.name.as_str()),
            "at": [frame.x.get(), frame.y.get(), frame.z.get()],
            "angle_deg": frame.angle.get(),
        })
    });
    Ok(json!({
        "area": world.areas.get(&seen.area).map(|a| a.name.as_str()),
        "area_en": world.areas.get(&seen.area).map(|a| a.name_en.as_str()),
        "at": [f.x.get(), f.y.get(), f.z.get()],
        "angle_deg": f.angle.get(),
        "on_map": on_map,
    }))
}

/// Where a thing is believed to be, how surely, and since when.
///
/// # Errors
/// There is no map.
pub fn believed(state: &State, found: &Believed) -> Result<Value, Error> {
    let b = &found.belief;
    // What is in the robot's hand stands in the world as surveyed alone.
    let replica = |world: &World| world.replicas.get(&found.replica).map(|r| r.name_en.clone());
    let name_en = replica(state.uncarried()?).or_else(|| replica(state.world().ok()?));
    Ok(json!({
        "name": found.name,
        "name_en": name_en,
        "place": place(state, &b.place)?,
        "confidence": (b.confidence * 1000.0).round() / 1000.0,
        "since": b.since.to_string(),
        "last_seen": b.last_seen.map(|at| at.to_string()),
        "missed": b.missed.map(|at| at.to_string()),
        "is_surveyed": b.is_surveyed,
        "surveyed": found.surveyed.as_ref().map(|seen| place(state, seen)).transpose()?,
        "carried": found.carried,
    }))
}

/// All that is known of where a thing stood, the oldest first.
///
/// # Errors
/// As [`State::story_of`].
pub fn story(state: &State, name: &str) -> Result<Value, Error> {
    let mut stations = Vec::new();
    for station in state.story_of(name)? {
        let place = station.place.as_ref().map(|seen| place(state, seen)).transpose()?;
        let mut view = json!({ "at": station.at.to_string(), "place": place });
        merge(
            &mut view,
            match &station.source {
                Source::Map { revision, user } => {
                    json!({"source": "map", "revision": revision, "user": user})
                }
                Source::Seen { observer, sure } => {
                    json!({"source": "seen", "observer": observer, "sure": sure})
                }
            },
        );
        stations.push(view);
    }
    Ok(json!({ "story": stations }))
}

/// What differs between two states of the map, a record an object.
#[must_use]
pub fn differences(all: &[Difference], language: Language) -> Vec<Value> {
    let cell = |cell: &Cell| match cell {
        Cell::Null => json!(null),
        Cell::Int(n) => json!(n),
        Cell::Real(x) => json!(x),
        Cell::Text(text) => json!(text),
    };
    let one = |d: &Difference| {
        let fields: Vec<_> = d
            .fields
            .iter()
            .map(|f| json!({"column": f.column, "old": cell(&f.old), "new": cell(&f.new)}))
            .collect();
        json!({
            "table": d.table.name(),
            "fate": match d.fate {
                Fate::Created => "created",
                Fate::Changed => "changed",
                Fate::Deleted => "deleted",
            },
            "subject": d.subject.say(language),
            "ru": d.say(Language::Russian),
            "en": d.say(Language::English),
            "fields": fields,
        })
    };
    all.iter().map(one).collect()
}

/// What an edit did, or would do.
#[must_use]
pub fn edited(edited: &Edited, language: Language) -> Value {
    let counts = edited.report.as_ref().map(|r| r.counts).unwrap_or_default();
    json!({
        "outcome": if edited.report.is_some() { "edited" } else { "tried" },
        "revision": edited.report.as_ref().map(|r| r.revision),
        "created": counts.created,
        "changed": counts.changed,
        "deleted": counts.deleted,
        "differences": differences(&edited.differences, language),
        "left_behind": edited.left_behind,
        "warnings": edited.warnings.faults.len(),
        "told": warnings(&edited.warnings, language),
    })
}

/// A change of the whole map that is done: `outcome` says which.
#[must_use]
pub fn changed(outcome: &str, report: &ImportReport) -> Value {
    json!({
        "outcome": outcome,
        "revision": report.revision,
        "created": report.counts.created,
        "changed": report.counts.changed,
        "deleted": report.counts.deleted,
    })
}

/// One revision of the history.
#[must_use]
pub fn revision(r: &Revision) -> Value {
    json!({
        "revision": r.number, "at": r.at.to_string(), "user": r.user, "reason": r.reason,
        "kind": r.kind.word(), "undoes": r.undoes, "created": r.counts.created,
        "changed": r.counts.changed, "deleted": r.counts.deleted,
    })
}

/// How many tuples each relation has.
#[must_use]
pub fn counts(relations: &Relations) -> Value {
    let rows: Vec<Value> = relations
        .counts()
        .into_iter()
        .map(|c| json!({"name": c.name, "name_en": c.name_en, "count": c.count}))
        .collect();
    json!({ "relations": rows })
}

/// Things that are believed to stand elsewhere than the map has them.
///
/// # Errors
/// There is no map.
pub(crate) fn proposals(state: &State, all: &[Believed]) -> Result<Value, Error> {
    let all = all.iter().map(|one| believed(state, one)).collect::<Result<Vec<_>, _>>()?;
    Ok(json!({ "proposals": all }))
}

/// A thing is held to stand where the map has it, whatever was seen.
#[must_use]
pub(crate) fn rejected(revision: u64) -> Value {
    json!({ "outcome": "rejected", "revision": revision })
}

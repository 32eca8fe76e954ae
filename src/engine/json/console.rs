//! What the console begins with and is told, as data.

use std::path::Path;

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::known::differences;
use super::values::{merge, pose};
use super::ways::whereabout;
use crate::engine::{Difference, Revision, State};
use crate::language::Language;
use crate::map::{DomainMap, Replica};
use crate::robot::Moment;
use crate::units::InOrder as _;

/// Who looks on, as of which event and revision.
#[derive(Debug, Serialize)]
pub(crate) struct Seat<'s> {
    pub event: String,
    pub revision: u64,
    pub session: u64,
    pub user: &'s str,
    pub role: &'static str,
    pub demo: bool,
}

/// Everything that a page begins with: the tasks, the house while the robot stands ([`house`]), and where the robot is told
/// to be while it drives.
#[must_use]
pub(crate) fn console(seat: &Seat<'_>, tasks: Value, house: Value, driving: Value) -> Value {
    let mut view = json!(seat);
    merge(&mut view, tasks);
    merge(&mut view, house);
    if !driving.is_null() {
        view["robot"]["place"] = driving;
    }
    view
}

/// A house while its robot stands: its storeys, the lowest first, and the robot with what it carries; `missing` names what is
/// not known.
#[must_use]
pub(crate) fn house(state: &State) -> Value {
    let Ok(world) = state.world() else {
        return json!({ "maps": [], "robot": null, "missing": ["map"] });
    };
    let mut maps: Vec<_> = world.domain.maps.iter().collect();
    maps.order_by(|a, b| a.frame.z.get().total_cmp(&b.frame.z.get()));
    let storey = |placed: &&DomainMap| {
        let map = &world.maps[&placed.map];
        json!({ "name": map.name, "name_en": map.name_en, "z": placed.frame.z.get() })
    };
    let mut view = json!({
        "name": world.domain.name, "name_en": world.domain.name_en,
        "maps": maps.iter().map(storey).collect::<Vec<_>>(),
        "profile": {
            "radius": (world.robot.passing_width() / 2.0), "speed": world.robot.speed,
        },
        "missing": [],
    });
    match (state.robot(), state.held(), state.handed_over()) {
        (Ok((map, pose)), Ok(held), Ok(handed_over)) => {
            let thing = |replica: &Replica| json!([replica.name, replica.name_en]);
            view["robot"] = json!({
                "place": robot(state, &Moment { time: 0.0, map, pose }),
                "carries": held.map(thing),
                "handed_over": handed_over.iter().map(|(r, to)| json!([r.name, to])).collect::<Vec<_>>(),
            });
        }
        _ => view["missing"] = json!(["robot"]),
    }
    view
}

/// Where the robot is, in numbers and, within a room, in words.
#[must_use]
pub(crate) fn robot(state: &State, moment: &Moment) -> Value {
    let world = state.world().ok();
    match (world, state.locate(moment.map, moment.pose, true)) {
        (Some(world), Ok(found)) => whereabout(world, &found),
        _ => json!({
            "map": world.and_then(|world| world.maps.get(&moment.map)).map(|map| &map.name),
            "pose": pose(moment.pose),
        }),
    }
}

/// What may follow what is typed: of how many signs it takes the place, and whether it begins a question or is a name.
#[derive(Debug, Serialize)]
pub(crate) struct Completion {
    pub typed: usize,
    pub name: String,
    /// `frame` or `name`.
    pub kind: &'static str,
}

/// What may follow, the likeliest first.
#[must_use]
pub(crate) fn completions(all: &[Completion]) -> Value {
    json!(all)
}

/// That the map is at another revision, and who made it.
#[must_use]
pub(crate) fn revised(revision: u64, made: Option<&Revision>) -> Value {
    match made {
        Some(r) => json!({ "revision": r.number, "user": r.user, "reason": r.reason }),
        None => json!({ "revision": revision }),
    }
}

/// What others changed meanwhile, a revision an object.
#[must_use]
pub(crate) fn others(revisions: &[(Revision, Vec<Difference>)], language: Language) -> Value {
    let one = |(r, changed): &(Revision, Vec<Difference>)| {
        json!({
            "revision": r.number, "user": r.user, "at": r.at.to_string(), "reason": r.reason,
            "differences": differences(changed, language),
        })
    };
    revisions.iter().map(one).collect()
}

/// An edit that somebody proposed, with what it would change now or why it cannot be made.
#[derive(Debug)]
pub(crate) struct ProposedEdit {
    pub id: String,
    /// The revision that it was made on.
    pub on: u64,
    /// As an edit file has it, with its reason.
    pub edit: Map<String, Value>,
    pub differences: Value,
    pub fault: Value,
}

/// Edits that wait for a word.
#[must_use]
pub(crate) fn proposed_edits(all: &[ProposedEdit]) -> Value {
    let one = |one: &ProposedEdit| {
        json!({
            "id": one.id, "on": one.on, "reason": one.edit.get("reason"), "edit": one.edit,
            "differences": one.differences, "fault": one.fault,
        })
    };
    json!({ "edits": all.iter().map(one).collect::<Vec<_>>() })
}

/// The edit of which something is told.
#[must_use]
pub(crate) fn edit_named(id: &str) -> Value {
    json!({ "id": id })
}

/// An edit that was tried and waits for the operator: under which name, in which file, and how it is written.
#[must_use]
pub(crate) fn laid_beside(mut tried: Value, id: &str, file: Option<&Path>, text: &str) -> Value {
    let file = file.map(|file| file.display().to_string());
    merge(&mut tried, json!({ "outcome": "proposed", "id": id, "file": file, "text": text }));
    tried
}

/// A token for somebody else, good once.
#[must_use]
pub(crate) fn invitation(token: &str, role: &str) -> Value {
    json!({ "token": token, "role": role })
}

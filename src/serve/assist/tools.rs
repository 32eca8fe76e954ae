//! The tools as they are listed: names, what each is for, and what it takes.

use std::sync::Arc;

use rmcp::model::{Tool, ToolAnnotations};
use serde_json::{Value, json};

use super::super::gate::Role;

/// A tool as it is listed.
pub(super) struct Row {
    pub(super) name: &'static str,
    title: &'static str,
    about: &'static str,
    pub(super) needs: Role,
    effect: Effect,
    takes: fn() -> Value,
}

impl Row {
    fn reads(&self) -> bool {
        self.effect == Effect::Reads
    }

    /// Whether it may be left at any moment, and nothing of it stays.
    pub(super) fn may_be_left(&self) -> bool {
        matches!(self.effect, Effect::Reads | Effect::Plans)
    }

    /// The schema of its arguments.
    pub(super) fn takes(&self) -> Value {
        (self.takes)()
    }
}

/// What a tool does to the world.
#[derive(Clone, Copy, PartialEq)]
enum Effect {
    Reads,
    /// Proposes what is done at another word.
    Plans,
    /// Adds to what is known.
    Adds,
    Acts,
}

/// Longer than any name, question, order or query has reason to be.
const LONGEST: u32 = 20_000;
/// No building is so large, cm; no turn is so many degrees.
const FARTHEST: u32 = 10_000_000;
/// The largest number that JSON's readers agree on.
const LAST: u64 = (1 << 53) - 1;

fn text(about: &str) -> Value {
    json!({ "type": "string", "maxLength": LONGEST, "description": about })
}

fn number(about: &str) -> Value {
    let farthest = i64::from(FARTHEST);
    json!({ "type": "number", "minimum": -farthest, "maximum": farthest, "description": about })
}

/// A revision, or the id of a plan.
fn ordinal(least: u32, about: &str) -> Value {
    json!({ "type": "integer", "minimum": least, "maximum": LAST, "description": about })
}

fn of(properties: &Value, required: &[&str]) -> Value {
    json!({
        "type": "object", "properties": properties, "required": required,
        "additionalProperties": false,
    })
}

const THING: &str =
    "Name of a thing, room, door or place, as the map has it, in Russian or English";

const ROWS: &[Row] = &[
    Row {
        name: "ask",
        title: "Ask a question",
        about: "Answers a question in plain English or Russian about rooms, doors, things, how they lie to each other, ways, and the robot. Never acts. The dialogue is remembered: \"and what is under it?\" works.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || {
            of(
                &json!({ "text": text("The question"), "lang": { "enum": ["en", "ru"], "description": "Of the answer, where the question does not tell" } }),
                &["text"],
            )
        },
    },
    Row {
        name: "query",
        title: "Query in the rules' language",
        about: "Runs a Datalog query over relations and measurements, e.g. ?- ON_TOP_OF(X, \"Table 1\"), distance_between(X, \"Window 1\", D).order D.limit 3",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || {
            of(
                &json!({ "query": text("A query, with rules of its own before it if it likes") }),
                &["query"],
            )
        },
    },
    Row {
        name: "where_is",
        title: "Where is it",
        about: "Where a thing is believed to be and how surely, where it was seen and when, its properties and relations; without a name, where the robot is.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || of(&json!({ "name": text(THING) }), &[]),
    },
    Row {
        name: "relations",
        title: "Relations",
        about: "Relations derived from the map's geometry: all of one name, all about one thing, or both.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || {
            of(
                &json!({ "name": text("Of the relation, e.g. ON_TOP_OF, NEXT_TO, INSIDE"), "of": text(THING) }),
                &[],
            )
        },
    },
    Row {
        name: "why",
        title: "Why does it hold",
        about: "The proof of a relation down to what was measured, e.g. relation ON_TOP_OF of [\"Cup 1\", \"Table 1\"].",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: fact,
    },
    Row {
        name: "why_not",
        title: "Why does it not hold",
        about: "Of a relation that does not hold: the rule that came closest, and the number that was missing.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: fact,
    },
    Row {
        name: "route",
        title: "A way",
        about: "The shortest way for the robot between two places, with its length, doors and points; where there is none, what bars it and what would open it.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || {
            of(
                &json!({ "from": text("Where from: a name, or \"X,Y\" in cm"), "to": text("Where to") }),
                &["from", "to"],
            )
        },
    },
    Row {
        name: "map",
        title: "The map",
        about: "A picture of a storey or a room (PNG), and the same as data: outlines of rooms, things, doors and places in cm.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || {
            of(
                &json!({ "name": text("A storey or a room; the lowest storey without one"), "picture": { "type": "boolean", "description": "With the picture (default), or the data alone" } }),
                &[],
            )
        },
    },
    Row {
        name: "history",
        title: "History of the map",
        about: "Revisions of the map with author, time and reason, the newest last; with `from`, what changed since that revision; with `calls`, the calls of assistants as well, with the client's name.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || {
            of(
                &json!({ "from": ordinal(0, "A revision"), "to": ordinal(0, "A revision; the present one without it"), "calls": { "type": "boolean", "description": "The calls of assistants as well" } }),
                &[],
            )
        },
    },
    Row {
        name: "as_of",
        title: "Ask about the past",
        about: "Answers a question about the map as it stood at a revision.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || {
            of(
                &json!({ "revision": ordinal(1, "Of the map"), "text": text("The question") }),
                &["revision", "text"],
            )
        },
    },
    Row {
        name: "tasks",
        title: "Tasks",
        about: "What the robot does, what waits, and how the last tasks ended.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || of(&json!({}), &[]),
    },
    Row {
        name: "proposals",
        title: "What is elsewhere",
        about: "Things that are believed to stand elsewhere than the map says; a person confirms or rejects them.",
        needs: Role::Look,
        effect: Effect::Reads,
        takes: || of(&json!({}), &[]),
    },
    Row {
        name: "plan",
        title: "Plan a task",
        about: "Plans what the robot would do for an order in plain English or Russian, e.g. \"Bring the medicine\". Gives the plan's id, its steps, the proof that none is shorter, and what it assumes. Moves nothing.",
        needs: Role::Drive,
        effect: Effect::Plans,
        takes: || {
            of(&json!({ "text": text("The order"), "lang": { "enum": ["en", "ru"] } }), &["text"])
        },
    },
    Row {
        name: "run",
        title: "Carry out a plan",
        about: "Has the robot carry out a plan by its id, that plan and no other. A person is asked first. Refused when the map, or anything that the plan rests on, has changed since. Tells of its progress, as a task where the client speaks of tasks; cancelling stops the robot.",
        needs: Role::Drive,
        effect: Effect::Acts,
        takes: || of(&json!({ "id": ordinal(1, "As `plan` gave it") }), &["id"]),
    },
    Row {
        name: "stop",
        title: "Stop the robot",
        about: "Stops the robot at once and drops what waits. Needs nobody's word.",
        needs: Role::Look,
        effect: Effect::Adds,
        takes: || of(&json!({}), &[]),
    },
    Row {
        name: "observe",
        title: "Note an observation",
        about: "Notes that a thing was seen at a place of its storey, or that it was not where it was expected. Changes what is believed, never the surveyed map.",
        needs: Role::Drive,
        effect: Effect::Adds,
        takes: || {
            of(
                &json!({
                    "thing": text("Name of the thing"), "x": number("cm"), "y": number("cm"), "z": number("cm above the floor; 0 without it"),
                    "angle": number("degrees; 0 without it"), "map": text("Storey; the thing's own without it"),
                    "absent": { "type": "boolean", "description": "It was not where it was expected" },
                    "sure": { "type": "number", "minimum": 0, "maximum": 1, "description": "0.9 without it" },
                }),
                &["thing"],
            )
        },
    },
    Row {
        name: "propose_edit",
        title: "Propose an edit of the map",
        about: "Checks an edit of the map (the steps of `ortho edit --file`, as JSON) and tells what it would change. A person is asked before it is written; where nobody can be asked, it is laid beside the store for the operator.",
        needs: Role::Edit,
        effect: Effect::Acts,
        takes: || {
            of(
                &json!({
                    "edit": { "type": "object", "description": "{\"edit\": [{\"move\": \"Chair 1\", \"by\": [10, 0]}]}: docs/cli.md" },
                    "reason": text("Why"), "on": ordinal(0, "The revision that it was made on; the present one without it"),
                }),
                &["edit"],
            )
        },
    },
];

fn fact() -> Value {
    of(
        &json!({
            "relation": text("Name of the relation, in Russian or English"),
            "of": { "type": "array", "maxItems": 16, "items": text("A name"), "description": "The names, in order" },
        }),
        &["relation", "of"],
    )
}

pub(super) fn named(name: &str) -> Option<&'static Row> {
    ROWS.iter().find(|row| row.name == name)
}

pub(super) fn names() -> impl Iterator<Item = &'static str> {
    ROWS.iter().map(|row| row.name)
}

pub(super) fn all() -> Vec<Tool> {
    let one = |row: &Row| {
        let Value::Object(schema) = row.takes() else { unreachable!("a schema is an object") };
        let reads = row.reads();
        let hints = ToolAnnotations::with_title(row.title)
            .read_only(reads)
            .destructive(row.effect == Effect::Acts)
            .idempotent(reads || row.name == "stop")
            .open_world(false);
        Tool::new(row.name, row.about, Arc::new(schema)).with_title(row.title).annotate(hints)
    };
    ROWS.iter().map(one).collect()
}

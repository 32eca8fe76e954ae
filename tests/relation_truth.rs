//! Relations against worlds that others made: the figures of docs/relations.md hold.

#[path = "../examples/relation_truth/truth.rs"]
mod truth;

use std::collections::{BTreeMap, BTreeSet};

use crate::files::shared;
use crate::talk::engine;
use truth::{Comparison, procthor, virtualhome};

/// The row of a relation by a rule, in the profile for what is only roughly measured.
fn row<'c>(found: &'c [Comparison], relation: &str, by: &str) -> &'c Comparison {
    let mut rows = found.iter().filter(|c| c.profile == "detected" && c.by == by);
    rows.find(|c| c.relation == relation).expect("the row is there")
}

fn at_least(c: &Comparison, precision: f64, recall: f64) {
    let (p, r) = (c.precision(), c.recall());
    let name = format!("{}, {} by {}", c.data, c.relation, c.by);
    let disagreements = (&c.missed, &c.surplus);
    assert!(p >= precision && r >= recall, "{name}: P {p}, R {r}; {disagreements:?}");
}

#[test]
fn procthor_houses_come_out_as_their_makers_say() {
    let Some(folder) = shared("procthor") else { return };
    let data = folder.parent().expect("a folder within the data");
    let found = procthor(data).expect("the houses are read");
    let held = row(&found, "parent: on or in", "LIES_ON_OR_IN");
    assert_eq!(held.both + held.missed.len(), 454);
    at_least(held, 0.98, 0.97);
    at_least(row(&found, "room of a thing", "INSIDE"), 0.99, 0.99);
    at_least(row(&found, "room0 and room1 of a door", "JOINS"), 1.0, 1.0);
}

#[test]
fn virtualhome_flats_come_out_as_their_makers_say() {
    let Some(folder) = shared("virtualhome") else { return };
    let data = folder.parent().expect("a folder within the data");
    let found = virtualhome(data).expect("the flats are read");
    at_least(row(&found, "INSIDE a thing", "VH_INSIDE"), 1.0, 1.0);
    at_least(row(&found, "INSIDE a room", "INSIDE"), 0.99, 0.99);
    at_least(row(&found, "CLOSE", "VH_CLOSE"), 0.99, 0.99);
    assert!(row(&found, "ON", "VH_ON").f_score() >= 0.95);
    at_least(row(&found, "ON or INSIDE, through chains", "RESTS_ON, INSIDE"), 0.86, 0.97);
    at_least(row(&found, "BETWEEN a door and rooms", "JOINS"), 0.95, 0.95);
}

/// A glass that stood beside a plate was on the plate, since its middle is over a corner of the plate's box.
#[test]
fn a_thing_rests_on_what_its_makers_put_it_on() {
    let Some(path) = shared("virtualhome/TestScene3_graph.json") else { return };
    let graph: serde_json::Value =
        serde_json::from_slice(&std::fs::read(path).expect("it is there")).expect("it is JSON");
    let mut put: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for edge in graph["edges"].as_array().expect("a graph has edges") {
        if edge["relation_type"] == "ON" || edge["relation_type"] == "INSIDE" {
            let onto = put.entry(edge["from_id"].to_string()).or_default();
            onto.insert(edge["to_id"].to_string());
        }
    }
    let engine = engine("../shared/data/virtualhome/TestScene3_graph.json").expect("it is there");
    let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
    let (mut right, mut all) = (0, 0);
    for thing in world.replicas.values() {
        let source = &thing.properties["ИСТОЧНИК"];
        let (Some(support), Some(onto)) = (relations.support_of(thing.id), put.get(source)) else {
            continue;
        };
        let is_right = onto.contains(&world.replicas[&support].properties["ИСТОЧНИК"]);
        assert!(is_right || !thing.name_en.starts_with("Glass"), "{}", thing.name);
        (right, all) = (right + usize::from(is_right), all + 1);
    }
    assert!(right * 100 >= all * 87, "{right} of {all}");
    // What hangs on a wall stands on no floor.
    for socket in world.replicas.values().filter(|r| r.name_en.starts_with("Power socket")) {
        let area = relations.area_of(socket.id).expect("it is in a room");
        assert!(!relations.stands_on_floor(socket.id, area), "{}", socket.name);
    }
}

//! Relations against worlds that others made: the figures of docs/relations.md hold.

#[path = "../examples/relation_truth/truth.rs"]
mod truth;

use crate::files::shared;
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

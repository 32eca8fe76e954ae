//! Integration tests: one binary, one file a capability.

mod accounted;
mod agreement;
mod architecture;
mod assembly;
mod broken_scenarios;
mod chatter;
mod cli;
mod commands;
mod corridor;
mod corridor_floors;
mod corridor_lattice;
mod counted_before;
mod datalog_files;
mod dialogue;
mod doors;
mod doubts;
mod drawings;
mod exports;
mod facts;
#[expect(dead_code, reason = "some of it serves the tests of the rules' crate alone")]
mod facts_naive;
mod files;
mod floor_cases;
mod floor_properties;
mod floors;
mod footprint;
mod foreign;
mod formats;
mod frames;
mod furniture;
mod generated_worlds;
mod going_on;
mod guides;
mod hostile;
mod ifc;
mod imports;
mod judged;
mod lifts;
mod lost;
mod map_editing;
mod maps;
mod odd_floors;
mod odd_worlds;
mod openings;
mod orders;
mod partition;
mod passframes;
mod planning;
mod planning_floor;
mod planning_front;
mod planning_interference;
mod planning_judge;
mod planning_mutants;
mod planning_properties;
mod planning_time;
mod position_reports;
mod queue;
mod referents;
mod relation_truth;
mod relations;
mod remedies;
mod rmf_floors;
mod robot_facts;
mod routes;
mod scenes;
#[cfg(feature = "sqlite")]
mod sqlite;
mod states;
mod store;
mod store_faults;
mod store_world;
mod storeys;
mod story;
mod substitutes;
mod surface;
mod talk;
mod talk_ways;
mod thresholds;
mod tight_floors;
mod told_truly;
mod truth;
mod ugly_floors;
mod vehicle;
mod vehicle_schema;
mod views;
mod ways;
mod words;
mod worlds;
mod wrapped;
mod zones;

/// The program, in Russian unless its arguments say otherwise: what it prints here does not hang on the locale.
fn ortho() -> std::process::Command {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_ortho"));
    command.env("ORTHO_LANG", "ru");
    command
}

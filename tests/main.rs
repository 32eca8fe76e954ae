//! Integration tests: one binary, one file a capability.

mod architecture;
mod assembly;
mod cli;
mod commands;
mod corridor;
mod corridor_lattice;
mod datalog_files;
mod drawings;
mod exports;
mod facts;
mod facts_naive;
mod floor_cases;
mod floor_properties;
mod floors;
mod formats;
mod generated_worlds;
mod hostile;
mod imports;
mod lifts;
mod map_editing;
mod maps;
mod planning;
mod position_reports;
mod relation_truth;
mod relations;
mod routes;
mod scenes;
#[cfg(feature = "sqlite")]
mod sqlite;
mod store;
mod store_faults;
mod store_world;
mod story;
mod talk;
mod words;
mod worlds;

//! Datalog programs against evaluation from scratch, the suite of Soufflé, and what is refused, in one program.

mod ask;
mod computed;
mod edits;
mod evaluation;
#[path = "../../../tests/facts_naive.rs"]
#[allow(dead_code, reason = "its other users need the rest")]
mod facts_naive;
mod faults;
mod files;
mod language;
mod preprocessor;
mod refused;
mod saved;
mod souffle;
mod threads;
mod warnings;
mod why_not;

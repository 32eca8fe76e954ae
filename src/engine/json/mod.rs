//! Engine values as JSON, for all faces alike: the shape of whatever a program reads stands here and nowhere else. The field
//! names are documented in docs/cli.md and stay.

mod building;
#[cfg(feature = "serve")]
mod console;
mod corridor;
mod done;
mod events;
mod faults;
mod known;
mod names;
mod plans;
mod proofs;
mod reasons;
mod replies;
mod scans;
mod segments;
mod store;
mod storey;
#[cfg(feature = "serve")]
mod tasks;
mod thing;
mod values;
mod ways;

pub(crate) use building::{drawn_map, imported, imported_tables, map_of_log, sound_map};
#[cfg(feature = "serve")]
pub(crate) use console::{
    Completion, ProposedEdit, Seat, completions, console, edit_named, house, invitation,
    laid_beside, others, proposed_edits, revised, robot,
};
pub(crate) use corridor::directions;
pub(crate) use done::{
    exported, failed, formatted, program_run, told_again, told_to_its_end, written,
};
pub use events::TaskEvents;
pub use faults::faults;
pub use known::{believed, changed, counts, differences, edited, facts, revision, story};
pub(crate) use known::{proposals, rejected};
pub(crate) use names::declined;
pub use plans::plan;
pub(crate) use plans::{
    better_plan, given_facts, higher_bound, replanned, replayed, with_remedies, with_shortness,
};
pub use proofs::{query, why};
pub use reasons::reasons;
pub use replies::{answer, doubt, heard, queue, reply, task};
pub use scans::things;
pub(crate) use scans::{changes, differing, found_scans, view};
pub(crate) use segments::{ends, of_log};
pub(crate) use store::with_calls;
pub(crate) use store::{backup, diff, forgotten, map_text, restored, revisions, store_check};
pub(crate) use storey::{Part, floor, storey};
#[cfg(feature = "serve")]
pub(crate) use tasks::{
    TaskEnd, TaskView, Waiting, as_it_went, barred, cleared, done, ended, known_changed, lease,
    line, of_task, of_the_past, played_again, said, stop, stop_raised, stopped, tasks, waiting,
    with_note, with_text,
};
pub use thing::about;
pub(crate) use thing::kinds;
pub use values::tuple;
pub(crate) use ways::{faces, with_words};
pub use ways::{journey, region, route, whereabout};

//! Notes on standard error: what a command noticed beside what it was asked for.

use crate::engine::{Engine, Sighted};
use crate::map::MapErrors;
use crate::recording::Played;
use crate::units::told;

use super::args::{Common, Lang};
use super::fault::drawn;

#[expect(clippy::print_stderr, reason = "notes go to standard error")]
pub(super) fn note(text: &str) {
    super::waiting::over();
    eprintln!("{text}");
}

/// Notes where a recording was cut off, if it was.
pub(super) fn note_cut(common: &Common, played: &Played) {
    let Some(cut) = &played.cut else { return };
    let begun = played.told.first().map_or(0, |first| first.time);
    let (lasted, cut) = (seconds(played.end(), begun), cut.say(common.lang.language()));
    note(&told!(common.lang.language(), "recording-cut", lasted, cut));
}

/// Of a recording, to the millisecond.
pub(super) fn seconds(time: u64, begun: u64) -> f64 {
    (time.saturating_sub(begun) / 1_000_000) as f64 / 1000.0
}

pub(super) fn note_repairs(engine: &Engine, lang: Lang) {
    let opened = &engine.opened;
    let store = told!(lang.language(), "the-store");
    if opened.torn_bytes > 0 {
        let bytes = opened.torn_bytes;
        note(&told!(lang.language(), "torn-record", store, bytes));
    }
    let tables = told!(lang.language(), "tables-rebuilt");
    let journal = told!(lang.language(), "journal-rewritten");
    let read = told!(lang.language(), "read-from-tables");
    let off = told!(lang.language(), "tables-off");
    let past = told!(lang.language(), "past-rewritten");
    let shut = told!(lang.language(), "read-only");
    for (what, why) in [
        (tables, &opened.tables_rebuilt),
        (journal, &opened.journal_renewed),
        (read, &opened.read_from_tables),
        (off, &opened.tables_off),
        (past, &opened.past_mended),
        (shut, &opened.not_writable),
    ] {
        if let Some(why) = why {
            note(&format!("{store}: {what}: {}.", why.say(lang.language())));
        }
    }
    for name in &opened.marks_renewed {
        let renewed = told!(lang.language(), "mark-renewed");
        note(&format!("{store}: {name} {renewed}."));
    }
}

pub(super) fn warn(warnings: &MapErrors, lang: Lang) {
    if warnings.faults.is_empty() {
        return;
    }
    note(
        match lang {
            Lang::Ru => drawn(warnings, Lang::Ru),
            Lang::En => drawn(&warnings.in_english(), Lang::En),
        }
        .trim_end(),
    );
}

/// What of a log could not be read, beside what could.
pub(super) fn warn_of_lines(log: &Sighted, lang: Lang) {
    let Some(faults) = log.faults() else { return };
    let told = match lang {
        Lang::Ru => drawn(faults, Lang::Ru),
        Lang::En => drawn(&faults.in_english(), Lang::En),
    };
    note(told.trim_end());
}

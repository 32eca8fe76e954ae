//! Notes on standard error: what a command noticed beside what it was asked for.

use crate::engine::{Engine, Sighted};
use crate::map::MapErrors;
use crate::recording::Played;

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
    note(&match common.lang {
        Lang::Ru => format!("Запись обрывается на {lasted} с: {cut}."),
        Lang::En => format!("The recording breaks off after {lasted} s: {cut}."),
    });
}

/// Of a recording, to the millisecond.
pub(super) fn seconds(time: u64, begun: u64) -> f64 {
    (time.saturating_sub(begun) / 1_000_000) as f64 / 1000.0
}

pub(super) fn note_repairs(engine: &Engine, lang: Lang) {
    let opened = &engine.opened;
    let store = lang.pick("Хранилище", "The store");
    if opened.torn_bytes > 0 {
        let bytes = opened.torn_bytes;
        note(&match lang {
            Lang::Ru => format!(
                "{store}: последняя запись была прервана и не подтверждена; отброшено {bytes} байт."
            ),
            Lang::En => format!(
                "{store}: the last record was cut off and not confirmed; {bytes} bytes are dropped."
            ),
        });
    }
    let tables = lang
        .pick("таблицы построены заново по журналу", "the tables are built anew from the journal");
    let journal = lang
        .pick("журнал записан заново по таблицам", "the journal is written anew from the tables");
    let read = lang.pick(
        "прочитано по таблицам, потому что журнал неполон (открытие для записи восстановит его)",
        "read from the tables, since the journal is incomplete (opening to write mends it)",
    );
    let off = lang.pick(
        "таблицы не ведутся, всё остаётся в журнале и снимках",
        "the tables are not kept, everything stays in journal and snapshots",
    );
    let past = lang.pick(
        "файл прошлого был утрачен или испорчен и записан заново по второму",
        "a file of the past was lost or broken, and is written anew from its twin",
    );
    let shut = lang.pick("писать в него нельзя", "it cannot be written");
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
        let renewed = lang.pick("был утрачен или испорчен", "was lost or broken");
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

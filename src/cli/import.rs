//! `ortho import`: a building of any known format into the store, with the report of what became of it.

use crate::engine::{Engine, ImportOptions, change_now, json};
use crate::units::told;

use super::args::{Common, ImportArgs};
use super::fault::Failure;
use super::notes::{note, note_repairs, warn};
use super::opened::{rules_dir, store_dir};
use super::text::described;
use super::{Answer, say};

/// The user's own synonyms, in the rules directory.
const SYNONYMS: &str = "import-synonyms.toml";

pub(super) fn run(common: &Common, args: &ImportArgs) -> Result<Answer, Failure> {
    #[cfg(feature = "sqlite")]
    if args.sqlite || (args.format.is_none() && is_sqlite(&args.file)) {
        return tables(common, &args.file);
    }
    let rules = rules_dir(common);
    let beside_rules = rules.as_ref().map(|dir| dir.join(SYNONYMS)).filter(|p| p.is_file());
    let options = ImportOptions {
        format: args.format,
        strict: args.strict,
        assets: args.assets.clone(),
        synonyms: args.synonyms.clone().or(beside_rules),
        profile: args.profile,
        pixel: args.pixel,
    };
    // The file is read before the store is opened or made, so that a faulty one leaves no trace.
    let read = Engine::read_building(&args.file, &options)?;
    let mut engine = Engine::open(&store_dir(common), rules.as_deref())?;
    note_repairs(&engine, common.lang);
    let reason = args.file.display().to_string();
    let imported = engine.keep(read, &change_now(&common.user, &reason))?;
    warn(&imported.warnings, common.lang);
    let world = engine.world()?;
    let counts = imported.report.counts;
    if common.json {
        let view = json::imported(world, &imported, common.lang.language());
        return say(&view.to_string());
    }
    if !imported.reading.notes.is_empty() {
        note(&imported.reading.say(common.lang.language()));
    }
    let (lang, revision) = (common.lang, imported.report.revision);
    let [created, changed, deleted] = [counts.created, counts.changed, counts.deleted];
    let what = match counts.total() {
        0 => told!(lang.language(), "nothing-changed"),
        _ => told!(lang.language(), "records", created, changed, deleted),
    };
    let head = told!(lang.language(), "revision");
    say(&format!("{}\n{head} {revision}: {what}.", described(world, lang)))
}

/// Whether a file begins as SQLite's do.
#[cfg(feature = "sqlite")]
fn is_sqlite(file: &std::path::Path) -> bool {
    use std::io::Read;
    const MAGIC: &[u8; 16] = b"SQLite format 3\0";
    let mut head = [0; MAGIC.len()];
    // What is no plain file may give nothing for ever.
    file.is_file()
        && std::fs::File::open(file).and_then(|mut file| file.read_exact(&mut head)).is_ok()
        && &head == MAGIC
}

/// The tables of an SQLite file, taken as they are: no reader, no assembler, the checks of a map file.
#[cfg(feature = "sqlite")]
fn tables(common: &Common, file: &std::path::Path) -> Result<Answer, Failure> {
    let rules = rules_dir(common);
    let mut engine = Engine::open(&store_dir(common), rules.as_deref())?;
    note_repairs(&engine, common.lang);
    let reason = file.display().to_string();
    let report = engine.import_sqlite(file, &change_now(&common.user, &reason))?;
    let world = engine.world()?;
    if common.json {
        return say(&json::imported_tables(world, &report).to_string());
    }
    let head = told!(common.lang.language(), "revision");
    say(&format!("{}\n{head} {}.", described(world, common.lang), report.revision))
}

//! The store itself: its history, undo and redo, check, backup, forgetting (D3).

use std::path::Path;

use clap::Subcommand;

use crate::engine::calls::{self, Call};
use crate::engine::{Engine, Revision, RevisionKind, Severity, When, change_now};
use crate::store::{Forgotten, ImportReport, Timestamp};
use crate::units::{told, write_file};

use super::args::{Common, Lang, when};
use super::fault::Failure;
use super::notes::note;
use super::opened::{open, open_to_write, store_dir};
use super::{Answer, json, say};

#[derive(Debug, Subcommand)]
pub(super) enum StoreCommand {
    /// All changes of the map: when, by whom, why
    History {
        /// Only the last so many
        #[arg(long, value_name = "N")]
        last: Option<usize>,
        /// Among them the calls of assistants: which client, what for, what it came to
        #[arg(long)]
        calls: bool,
    },
    /// What changed between two revisions, in words
    Diff {
        /// Revision or moment: 3, 2026-11-21, 2026-11-21T09:30
        #[arg(value_parser = when)]
        from: When,
        /// The last revision when left out
        #[arg(value_parser = when)]
        to: Option<When>,
    },
    /// Take back the last change, or a certain one
    Undo {
        revision: Option<u64>,
        /// Why, for the history
        #[arg(long, value_name = "TEXT")]
        reason: Option<String>,
    },
    /// Bring back what the last undo took
    Redo {
        #[arg(long, value_name = "TEXT")]
        reason: Option<String>,
    },
    /// The map as it stood then, as a map file; or make it so again
    AsOf {
        /// Revision or moment: 3, 2026-11-21, 2026-11-21T09:30
        #[arg(value_parser = when)]
        when: When,
        /// Make the map what it was then; a change that can be undone
        #[arg(long)]
        restore: bool,
        /// Write the map file here; standard output when absent
        #[arg(short, long, value_name = "FILE")]
        out: Option<std::path::PathBuf>,
    },
    /// Check every byte of the store, mend nothing
    Fsck,
    /// Write the whole store, its history included, into one checksummed file
    Backup { file: std::path::PathBuf },
    /// Make a new store of a backup; --store names an empty or new directory
    Restore { file: std::path::PathBuf },
    /// Forget what only changes before this one can see
    Gc {
        /// Revision or moment: 3, 2026-11-21, 2026-11-21T09:30
        #[arg(long, value_name = "WHEN", value_parser = when)]
        before: When,
    },
}

pub(super) fn run(common: &Common, command: &StoreCommand) -> Result<Answer, Failure> {
    match command {
        StoreCommand::History { last, calls } => history(common, *last, *calls),
        StoreCommand::Diff { from, to } => diff(common, *from, *to),
        StoreCommand::Undo { revision, reason } => {
            let change = change_now(&common.user, reason.as_deref().unwrap_or_default());
            let mut engine = open_to_write(common)?;
            let report = engine.undo(*revision, &change)?;
            done(common, "undone", &report)
        }
        StoreCommand::Redo { reason } => {
            let change = change_now(&common.user, reason.as_deref().unwrap_or_default());
            let mut engine = open_to_write(common)?;
            let report = engine.redo(&change)?;
            done(common, "redone", &report)
        }
        StoreCommand::AsOf { when, restore, out } => as_of(common, *when, *restore, out.as_deref()),
        StoreCommand::Fsck => fsck(common),
        StoreCommand::Backup { file } => {
            open(common)?.backup(file)?;
            if common.json {
                return say(&json::backup(file).to_string());
            }
            let written = told!(common.lang.language(), "written-and-read-back");
            say(&format!("{written} {}", file.display()))
        }
        StoreCommand::Restore { file } => restore(common, file),
        StoreCommand::Gc { before } => {
            let change = change_now(&common.user, "gc");
            let forgotten = open_to_write(common)?.forget_before(*before, &change)?;
            if common.json {
                return say(&json::forgotten(&forgotten).to_string());
            }
            let Forgotten { versions, not_freed } = forgotten;
            if let Some(why) = not_freed {
                let text = told!(common.lang.language(), "room-not-freed");
                note(&format!("{text}: {why}."));
            }
            let forgotten = told!(common.lang.language(), "versions-forgotten");
            say(&format!("{forgotten} {versions}"))
        }
    }
}

/// `2026-11-21 09:30:00 UTC`
fn kind(kind: RevisionKind, lang: Lang) -> String {
    match kind {
        RevisionKind::Import => told!(lang.language(), "import"),
        RevisionKind::Edit => told!(lang.language(), "edit"),
        RevisionKind::Undo => told!(lang.language(), "undo"),
        RevisionKind::Redo => told!(lang.language(), "redo"),
    }
}

/// What the history tells of, in the order of time.
enum Entry {
    Revision(Revision),
    Call(Call),
}

impl Entry {
    fn at(&self) -> Timestamp {
        match self {
            Self::Revision(revision) => revision.at,
            Self::Call(call) => call.at,
        }
    }

    fn in_words(&self, lang: Lang) -> String {
        let (number, user, what) = match self {
            Self::Revision(r) => (r.number.to_string(), &r.user, revised(r, lang)),
            Self::Call(call) => (String::new(), &call.client, call.say(lang.language())),
        };
        format!("{number:>4}  {}  {user:<12} {what}", self.at().in_words())
    }
}

fn revised(r: &Revision, lang: Lang) -> String {
    let of = r.undoes.map_or_else(String::new, |n| format!(" {n}"));
    let reason = if r.reason.is_empty() { String::new() } else { format!(" – {}", r.reason) };
    let counts = r.counts;
    let (created, changed, deleted) = (counts.created, counts.changed, counts.deleted);
    format!("{}{of}{reason}  (+{created} ~{changed} -{deleted})", kind(r.kind, lang))
}

fn history(common: &Common, last: Option<usize>, with_calls: bool) -> Result<Answer, Failure> {
    let mut entries: Vec<Entry> =
        open(common)?.revisions()?.into_iter().map(Entry::Revision).collect();
    if with_calls {
        let (calls, unread) = calls::noted(&calls::file(&store_dir(common)))?;
        if unread > 0 {
            let text = told!(common.lang.language(), "calls-unread");
            note(&format!("{text}: {unread}."));
        }
        entries.extend(calls.into_iter().map(Entry::Call));
        // Of one moment a change follows the call that made it.
        entries.sort_by_key(|entry| (entry.at(), matches!(entry, Entry::Revision(_))));
    }
    if let Some(last) = last {
        entries.drain(..entries.len().saturating_sub(last));
    }
    if common.json {
        let revisions = entries.iter().filter_map(|entry| match entry {
            Entry::Revision(revision) => Some(revision),
            Entry::Call(_) => None,
        });
        let calls = entries.iter().filter_map(|entry| match entry {
            Entry::Call(call) => Some(call),
            Entry::Revision(_) => None,
        });
        let view = match with_calls {
            true => json::with_calls(json::revisions(revisions), calls),
            false => json::revisions(revisions),
        };
        return say(&view.to_string());
    }
    if entries.is_empty() {
        return say(&told!(common.lang.language(), "no-changes-yet"));
    }
    say(&entries.iter().map(|entry| entry.in_words(common.lang)).collect::<Vec<_>>().join("\n"))
}

fn diff(common: &Common, from: When, to: Option<When>) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let to = to.unwrap_or_else(|| When::Revision(engine.store().map_or(0, |s| s.revision())));
    let (first, last) = (engine.revision_of(from)?, engine.revision_of(to)?);
    let all = engine.diff(from, to)?;
    if common.json {
        return say(&json::diff(first, last, &all, common.lang.language()).to_string());
    }
    if all.is_empty() {
        return say(&told!(common.lang.language(), "no-differences"));
    }
    say(&all.iter().map(|d| d.say(common.lang.language())).collect::<Vec<_>>().join("\n"))
}

fn done(common: &Common, outcome: &str, report: &ImportReport) -> Result<Answer, Failure> {
    let counts = report.counts;
    if common.json {
        return say(&json::changed(outcome, report).to_string());
    }
    if counts.total() == 0 {
        return say(&told!(common.lang.language(), "no-records-changed"));
    }
    say(&told!(
        common.lang.language(),
        "revision-written",
        revision = report.revision,
        created = counts.created,
        changed = counts.changed,
        deleted = counts.deleted
    ))
}

fn as_of(
    common: &Common,
    when: When,
    restore: bool,
    out: Option<&Path>,
) -> Result<Answer, Failure> {
    if restore {
        let mut engine = open_to_write(common)?;
        let revision = engine.revision_of(when)?;
        let change = change_now(&common.user, &format!("as-of {revision}"));
        let report = engine.return_to(when, &change)?;
        return done(common, "restored", &report);
    }
    let engine = open(common)?.as_of(when)?;
    let text = engine.world()?.to_toml();
    match out {
        Some(path) => {
            write_file(path, text.as_bytes()).map_err(|e| Failure::file(path, &e))?;
            Ok(Answer::Yes)
        }
        None if common.json => say(&json::map_text(&text).to_string()),
        None => say(text.trim_end()),
    }
}

fn fsck(common: &Common) -> Result<Answer, Failure> {
    let report = Engine::check_store(&store_dir(common))?;
    let word = |severity| match severity {
        Severity::Note => told!(common.lang.language(), "note"),
        Severity::Mendable => told!(common.lang.language(), "mendable"),
        Severity::Broken => told!(common.lang.language(), "broken"),
    };
    let told = |f: &crate::store::Finding| f.text.say(common.lang.language()).to_owned();
    let answer = if report.is_sound() { Answer::Yes } else { Answer::No };
    if common.json {
        say(&json::store_check(&report, common.lang.language()).to_string())?;
        return Ok(answer);
    }
    for finding in &report.findings {
        note(&format!("{}: {}", word(finding.severity), told(finding)));
    }
    let verdict = if report.is_sound() {
        told!(common.lang.language(), "store-sound")
    } else if report.findings.iter().any(|f| f.severity == Severity::Broken) {
        told!(common.lang.language(), "store-broken")
    } else {
        told!(common.lang.language(), "store-mendable")
    };
    say(&told!(
        common.lang.language(),
        "store-checked",
        verdict,
        lsn = report.lsn,
        revision = report.revision,
        records = report.records,
        snapshots = report.snapshots
    ))?;
    Ok(answer)
}

fn restore(common: &Common, file: &Path) -> Result<Answer, Failure> {
    let dir = store_dir(common);
    let revision = Engine::restore_store(file, &dir)?;
    if common.json {
        return say(&json::restored(&dir, revision).to_string());
    }
    say(&told!(common.lang.language(), "store-restored", dir = dir.display().to_string(), revision))
}

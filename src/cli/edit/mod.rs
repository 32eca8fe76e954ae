//! `ortho edit`: one step of an edit told in arguments, or a whole file of them.
//!
//! Either becomes the same edits (see [`crate::map::Edit`]), so that both can do the same and are refused for the same.

mod step;
mod values;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::engine::{Edited, Error, Format, Mode, change_now};
use crate::map::{Edits, MapErrors};
use crate::units::{Source, told};

use super::args::{Common, Lang};
use super::fault::Failure;
use super::notes::warn;
use super::opened::open_to_write;
use super::{Answer, say};

pub(super) use step::Numbers;
use step::Step;

#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = false, subcommand_negates_reqs = true)]
pub(super) struct EditArgs {
    /// A file of edits (TOML, YAML or JSON): one transaction, all faults at once
    #[arg(long, value_name = "FILE", required = true)]
    pub file: Option<PathBuf>,
    /// Check, say what would change, write nothing
    #[arg(long, global = true)]
    pub dry_run: bool,
    /// Why the change is made, for the history
    #[arg(long, global = true, value_name = "TEXT")]
    pub reason: Option<String>,
    #[command(subcommand)]
    step: Option<Step>,
}

pub(super) fn run(common: &Common, args: &EditArgs) -> Result<Answer, Failure> {
    let edits = match (&args.step, &args.file) {
        (Some(step), _) => {
            let edit = step.edit().map_err(|error| Error::from(MapErrors::of(*error)))?;
            Edits::from(vec![edit]).named(&told!(common.lang.language(), "arguments"))
        }
        (None, Some(file)) => Edits::read(&read(file)?, Format::of(file)),
        (None, None) => Edits::from(Vec::new()),
    };
    let mut engine = open_to_write(common)?;
    let mode = if args.dry_run { Mode::DryRun } else { Mode::Commit };
    let change = change_now(&common.user, args.reason.as_deref().unwrap_or_default());
    let edited = engine.edit(&edits, &change, mode)?;
    warn(&edited.warnings, common.lang);
    if common.json {
        say(&super::json::edited(&edited, common.lang.language()).to_string())
    } else {
        say(&told(&edited, common.lang))
    }
}

fn read(file: &Path) -> Result<Source, Failure> {
    Source::read(file).map_err(|fault| Failure::file(file, &fault.into_io()))
}

fn told(edited: &Edited, lang: Lang) -> String {
    if edited.differences.is_empty() {
        return told!(lang.language(), "nothing-changes");
    }
    let mut text: String =
        edited.differences.iter().map(|d| d.say(lang.language()) + "\n").collect();
    if !edited.left_behind.is_empty() {
        let names = edited.left_behind.join(", ");
        let count = edited.left_behind.len();
        text += &told!(lang.language(), "left-behind", count, names);
        text.push('\n');
    }
    text.push_str(&match &edited.report {
        Some(report) => told!(lang.language(), "edit-written", revision = report.revision),
        None => told!(lang.language(), "edit-right"),
    });
    text
}

//! The rule files that are built in, written out for who would edit them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::exchange::SYNONYMS;
use crate::meaning::files;
use crate::semantics::STANDARD;
use crate::units::{Carried, Gather as _, carried, is_input, write_file};

use super::{Error, RequestError, Rules};

macro_rules! files {
    ($($name:literal),+ $(,)?) => {
        [$(($name, carried!("../../rules/" $name))),+]
    };
}

/// Those for planning, which no folder below reads by itself.
static OF_PLANNING: [(&str, Carried); 15] = files![
    "service-robot.strips",
    "scenarios/another-floor.strips",
    "scenarios/chair-in-the-way.strips",
    "scenarios/dark-room.strips",
    "scenarios/guests.strips",
    "scenarios/leaving-the-room.strips",
    "scenarios/medicine-closed-door.strips",
    "scenarios/medicine-locked-door.strips",
    "scenarios/medicine-walk.strips",
    "scenarios/milk-in-the-fridge.strips",
    "scenarios/operator-opens-the-door.strips",
    "scenarios/rubbish.strips",
    "scenarios/tidy-up.strips",
    "scenarios/two-goals-exclude.strips",
    "scenarios/walk-to-the-medicine.strips",
];

/// Every rule file by its path within a directory of rules, and its text.
fn rule_files() -> impl Iterator<Item = (String, &'static str)> {
    let of_maps = [("relations.dl", &STANDARD), ("import-synonyms.toml", &SYNONYMS)];
    let of_planning = OF_PLANNING.iter().map(|(name, text)| (*name, text));
    let all = of_maps.into_iter().chain(of_planning).map(|(name, text)| (name.to_owned(), text));
    let of_language = files().map(|(name, text)| (format!("language/{name}"), text));
    all.map(|(name, text)| (name, **text)).chain(of_language)
}

impl Rules {
    /// Writes the built-in rule files into a directory, which is made where there is none; the paths written.
    ///
    /// # Errors
    /// A file is there already and `overwrite` is not set: nothing is written then. The disk refused.
    pub fn export(dir: &Path, overwrite: bool) -> Result<Vec<PathBuf>, Error> {
        let there: Vec<String> = rule_files()
            .map(|(name, _)| dir.join(name))
            .filter(|path| path.symlink_metadata().is_ok())
            .map(|path| path.display().to_string())
            .collect();
        if !there.is_empty() && !overwrite {
            return Err(RequestError::RulesThere { files: there.join(", ") }.into());
        }
        let refused = |path: &Path, error: &std::io::Error| RequestError::File {
            path: path.display().to_string(),
            reason: error.to_string().into(),
            is_input: is_input(error.kind()),
        };
        let mut written = Vec::new();
        for (name, text) in rule_files() {
            let path = dir.join(name);
            if let Some(folder) = path.parent() {
                std::fs::create_dir_all(folder).map_err(|e| refused(folder, &e))?;
            }
            write_file(&path, text.as_bytes()).map_err(|e| refused(&path, &e))?;
            written.push(path);
        }
        Ok(written)
    }
}

/// How questions begin in the built-in frames, in either language: the words before the first part that varies.
pub(crate) fn question_beginnings() -> &'static [String] {
    static FOUND: OnceLock<Vec<String>> = OnceLock::new();
    FOUND.get_or_init(|| {
        let frames =
            files().filter(|(path, _)| ["ru/frames.lang", "en/frames.lang"].contains(path));
        let bodies =
            frames.flat_map(|(_, text)| text.lines()).filter_map(|line| line.split_once("<-"));
        // What stands in brackets has several beginnings, and is left out.
        let plain =
            bodies.flat_map(|(_, body)| body.split('|')).filter(|b| !b.contains(['(', ')']));
        let all: BTreeSet<String> = plain.filter_map(beginning).gather();
        all.into_iter().collect()
    })
}

/// The literal words with which a frame begins; none where it begins with a part that varies.
fn beginning(body: &str) -> Option<String> {
    let is_literal = |word: &&str| word.chars().all(|c| c.is_lowercase() || c == '\'');
    let words: Vec<&str> = body.split_whitespace().take_while(is_literal).collect();
    (!words.is_empty()).then(|| words.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_tell_how_questions_begin() {
        let all = question_beginnings();
        for expected in ["где", "в какой комнате", "сколько", "where"] {
            assert!(all.iter().any(|one| one == expected), "{expected}: {all:?}");
        }
        assert!(all.iter().all(|one| !one.contains([':', '?', '['])), "{all:?}");
    }
}

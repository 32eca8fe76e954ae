//! A map file looked at closely: what reads well and cannot be.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::map::{self, Format, MapErrors};
use crate::semantics::RelationRules;
use crate::units::{Gather as _, InOrder as _};

use super::{Engine, Rules, World, read_map};

impl Engine {
    /// Reads a map file, without touching any store. With the world come the warnings, among them those of impossible maps.
    /// Traits that the rule files of `rules` name are known, and their thresholds say what stands on what; those of the
    /// program where they are at fault.
    ///
    /// # Errors
    /// All faults of the file.
    pub fn check_map(file: &Path, rules: Option<&Path>) -> Result<(World, MapErrors), MapErrors> {
        let (world, mut told) = read_map(file)?;
        let known = Rules::read(rules).map_or_else(|_| RelationRules::standard(), |r| r.relations);
        let near = known.tolerances(world.domain.profile);
        let mut doubts = map::doubts(&world, &near, &rules.map(quoted_words).unwrap_or_default());
        if let Some(source) = &told.source {
            map::locate(source, Format::of_text(file, source.text()), &mut doubts);
        }
        told.faults.extend(doubts);
        told.faults
            .order_by_key(|fault| fault.spans.first().map(|span| (span.offset(), span.len())));
        Ok((world, told))
    }
}

/// A rule file larger than this is no rule file.
const LIMIT: u64 = 4 << 20;

/// Every word in quotation marks in the Datalog files of a directory. A file that cannot be read is told by who uses it.
fn quoted_words(dir: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(dir).into_iter().flatten().flatten();
    let files = entries.map(|entry| entry.path()).filter(|path: &PathBuf| {
        path.extension().is_some_and(|e| e == "dl")
            && path.metadata().is_ok_and(|data| data.is_file() && data.len() <= LIMIT)
    });
    let texts = files.filter_map(|path| std::fs::read_to_string(path).ok());
    let words = |text: String| {
        let parts = text.lines().flat_map(|line| line.split('"').skip(1).step_by(2));
        parts.map(str::to_owned).collect::<Vec<_>>()
    };
    texts.flat_map(words).gather()
}

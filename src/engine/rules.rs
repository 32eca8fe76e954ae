//! Where the texts that a user may edit come from: a directory of rule files, or those built in.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use crate::language::paraphrase::Paraphrases;
use crate::meaning::{Grammar, files as built_in, words_beside};
use crate::semantics::RelationRules;
use crate::strips::{Domain, RuleFault, RuleFaults, Scenario};
use crate::units::{InOrder as _, Source};

use super::{Error, RequestError};

const RELATIONS: &str = "relations.dl";
const ROBOT: &str = "service-robot.strips";

/// The rule texts in force.
#[derive(Debug)]
pub struct Rules {
    pub relations: RelationRules,
    pub robot: Domain,
    /// How sentences are read that the older reading refuses: see [`Rules::grammar`].
    grammar: OnceLock<Grammar>,
    /// Harmless faults of the robot's rules.
    pub warnings: Vec<RuleFault>,
}

impl Rules {
    /// Reads `relations.dl` and `service-robot.strips` of a directory; for a file that is not there, or
    /// without a directory, the text that was built in. Every other `.dl` file of the directory adds to the relations,
    /// in the order of their names; so do the `.lang` files of `language` and its folders to the grammar, and the words
    /// beside their declarations.
    ///
    /// # Errors
    /// There is no such directory; else all faults of the relations, or of the robot's rules.
    pub fn read(dir: Option<&Path>) -> Result<Self, Error> {
        if let Some(missing) = dir.filter(|d| !d.is_dir()) {
            return Err(RequestError::NoRules { dir: missing.display().to_string() }.into());
        }
        let file = |name: &str| dir.map(|d| d.join(name)).filter(|p| p.exists());
        let more = dir.map(more_relations).transpose()?.unwrap_or_default();
        let relations = RelationRules::load(file(RELATIONS).as_deref(), &more)?;
        let (robot, warnings) = match file(ROBOT) {
            Some(path) => Domain::read(&path)?,
            None => built_in_robot()?,
        };
        let base = dir.map(|dir| dir.join("language")).filter(|base| base.is_dir());
        let mut beside = Vec::new();
        for path in file(RELATIONS).iter().chain(&more) {
            beside.extend(words_beside(&read_source(path)?));
        }
        let is_own = base.is_some() || !beside.is_empty();
        let grammar = is_own.then(|| read_grammar(base, beside)).transpose()?;
        let grammar = grammar.map_or_else(OnceLock::new, OnceLock::from);
        Ok(Self { relations, robot, grammar, warnings })
    }

    /// The grammar of the directory, read with its other files, so that its faults are told before anything is done; that
    /// which is built in is sound, and read when first asked for.
    pub(super) fn grammar(&self) -> &Grammar {
        self.grammar.get_or_init(Grammar::built_in)
    }

    /// Other ways to ask, of the same files; those built in need no grammar.
    pub(super) fn paraphrases(&self) -> Arc<Paraphrases> {
        match self.grammar.get() {
            Some(grammar) => Arc::clone(&grammar.paraphrases),
            None => Paraphrases::built_in(),
        }
    }

    /// `rules` in the working directory, when there is such a directory.
    #[must_use]
    pub fn default_dir() -> Option<PathBuf> {
        Some(PathBuf::from("rules")).filter(|dir| dir.is_dir())
    }
}

fn read_source(path: &Path) -> Result<Source, RequestError> {
    Source::read(path).map_err(|fault| RequestError::File {
        path: path.display().to_string(),
        reason: (&fault).into(),
        is_input: true,
    })
}

/// The grammar files built in, each replaced by the folder's own of that path; others of it add to them, and so does what
/// stands beside the declarations of rule files.
fn read_grammar(base: Option<PathBuf>, beside: Vec<(String, Source)>) -> Result<Grammar, Error> {
    let mut files: BTreeMap<String, Source> = BTreeMap::new();
    for (name, text) in built_in() {
        files.insert(name.to_owned(), Source::new(format!("rules/language/{name}"), text));
    }
    files.extend(beside);
    let mut folders: Vec<(String, PathBuf)> =
        base.into_iter().map(|base| (String::new(), base)).collect();
    while let Some((prefix, folder)) = folders.pop() {
        let entries = std::fs::read_dir(&folder).map_err(|e| unreadable(&folder, &e))?;
        for entry in entries {
            let path = entry.map_err(|e| unreadable(&folder, &e))?.path();
            let Some(name) = path.file_name().and_then(|name| name.to_str()) else { continue };
            if path.is_dir() && prefix.is_empty() {
                folders.push((format!("{name}/"), path));
            } else if path.extension().is_some_and(|e| e == "lang") {
                files.insert(format!("{prefix}{name}"), read_source(&path)?);
            }
        }
    }
    let files: Vec<(&str, Source)> = files.iter().map(|(n, s)| (n.as_str(), s.clone())).collect();
    match Grammar::of(&files) {
        (grammar, None) => Ok(grammar),
        (_, Some(faults)) => Err(Error::Language(Box::new(faults))),
    }
}

fn unreadable(path: &Path, error: &std::io::Error) -> RequestError {
    RequestError::File {
        path: path.display().to_string(),
        reason: error.to_string().into(),
        is_input: crate::units::is_input(error.kind()),
    }
}

/// The rule files beside `relations.dl`.
fn more_relations(dir: &Path) -> Result<Vec<PathBuf>, RequestError> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(dir).map_err(|e| unreadable(dir, &e))? {
        let path = entry.map_err(|e| unreadable(dir, &e))?.path();
        let is_rules = path.extension().is_some_and(|e| e == "dl") && !path.is_dir();
        if is_rules && path.file_name().is_some_and(|name| name != RELATIONS) {
            files.push(path);
        }
    }
    files.order();
    Ok(files)
}

fn built_in_robot() -> Result<(Domain, Vec<RuleFault>), RuleFaults> {
    let text = include_str!("../../rules/service-robot.strips");
    let scenario = Scenario::parse(&Source::new(ROBOT, text))?;
    Ok((scenario.domain, scenario.warnings))
}

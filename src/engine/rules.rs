//! Where the texts that a user may edit come from: a directory of rule files, or those built in.

use std::path::{Path, PathBuf};

use crate::semantics::RelationRules;
use crate::strips::{Domain, RuleFault, RuleFaults, Scenario};
use crate::units::Source;

use super::{Error, RequestError};

const RELATIONS: &str = "relations.dl";
const ROBOT: &str = "service-robot.strips";

/// The rule texts in force.
#[derive(Debug)]
pub struct Rules {
    pub relations: RelationRules,
    pub robot: Domain,
    /// Harmless faults of the robot's rules.
    pub warnings: Vec<RuleFault>,
}

impl Rules {
    /// Reads `relations.dl` and `service-robot.strips` of a directory; for a file that is not there, or
    /// without a directory, the text that was built in. Every other `.dl` file of the directory adds to the relations,
    /// in the order of their names.
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
        Ok(Self { relations, robot, warnings })
    }

    /// `rules` in the working directory, when there is such a directory.
    #[must_use]
    pub fn default_dir() -> Option<PathBuf> {
        Some(PathBuf::from("rules")).filter(|dir| dir.is_dir())
    }
}

/// The rule files beside `relations.dl`.
fn more_relations(dir: &Path) -> Result<Vec<PathBuf>, RequestError> {
    let unreadable = |e: std::io::Error| RequestError::File {
        path: dir.display().to_string(),
        reason: e.to_string(),
        is_input: crate::units::is_input(e.kind()),
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(dir).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let is_rules = path.extension().is_some_and(|e| e == "dl") && !path.is_dir();
        if is_rules && path.file_name().is_some_and(|name| name != RELATIONS) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn built_in_robot() -> Result<(Domain, Vec<RuleFault>), RuleFaults> {
    let text = include_str!("../../rules/service-robot.strips");
    let scenario = Scenario::parse(&Source::new(ROBOT, text))?;
    Ok((scenario.domain, scenario.warnings))
}

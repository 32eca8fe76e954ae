//! Where the texts that a user may edit come from: a directory of rule files, or those built in.

use std::path::{Path, PathBuf};

use crate::semantics::RelationRules;
use crate::strips::{Domain, RuleFaults, Scenario};
use crate::units::Source;

use super::{Error, RequestError};

const RELATIONS: &str = "relations.dl";
const ROBOT: &str = "service-robot.strips";

/// The rule texts in force.
#[derive(Debug)]
pub struct Rules {
    pub relations: RelationRules,
    pub robot: Domain,
}

impl Rules {
    /// Reads `relations.dl` and `service-robot.strips` of a directory; for a file that is not there, or
    /// without a directory, the text that was built in.
    ///
    /// # Errors
    /// There is no such directory; else all faults of the first faulty file.
    pub fn read(dir: Option<&Path>) -> Result<Self, Error> {
        if let Some(missing) = dir.filter(|d| !d.is_dir()) {
            return Err(RequestError::NoRules { dir: missing.display().to_string() }.into());
        }
        let file = |name: &str| dir.map(|d| d.join(name)).filter(|p| p.exists());
        let relations = match file(RELATIONS) {
            Some(path) => RelationRules::load(&path)?,
            None => RelationRules::standard(),
        };
        let robot = match file(ROBOT) {
            Some(path) => Domain::read(&path)?,
            None => built_in_robot()?,
        };
        Ok(Self { relations, robot })
    }

    /// `rules` in the working directory, when there is such a directory.
    #[must_use]
    pub fn default_dir() -> Option<PathBuf> {
        Some(PathBuf::from("rules")).filter(|dir| dir.is_dir())
    }
}

fn built_in_robot() -> Result<Domain, RuleFaults> {
    let text = include_str!("../../rules/service-robot.strips");
    Scenario::parse(&Source::new(ROBOT, text)).map(|scenario| scenario.domain)
}

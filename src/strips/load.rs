//! Reading rule files and scenarios with all that they include.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::check;
use super::domain::Domain;
use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use super::ground::ground;
use super::pddl;
use super::problem::Problem;
use super::rule_text;
use super::second::settle_names;
use super::slip::slips;
use super::syntax::{Amount, CostTerm, Document, Name};
use super::task::Task;
use crate::units::{Bilingual, FileFault, Source, read_text, said};

/// No rule file that a person wrote is longer.
pub const MAX_FILE_BYTES: u64 = 16 << 20;

/// Beyond this many faults nobody reads on.
const MOST_FAULTS: usize = 200;

/// Rules and a problem read from one text and the files that it includes.
#[derive(Debug, Clone)]
pub struct Scenario {
    pub domain: Domain,
    pub problem: Problem,
    /// The map whose facts supplement the scenario (`Карта: файл`), relative to the working directory.
    pub map: Option<PathBuf>,
    /// Harmless faults, such as the paper's surplus bracket.
    pub warnings: Vec<RuleFault>,
}

impl Scenario {
    /// Reads a rule file or a scenario.
    ///
    /// # Errors
    /// All faults of the file and of those that it includes, at once. A scenario's objects and goals are
    /// checked when it is grounded, after a map had its chance to supplement them.
    pub fn read(path: &Path) -> Result<Self, RuleFaults> {
        let (scenario, faults) = Self::read_whole(path)?;
        if faults.is_empty() { Ok(scenario) } else { Err(RuleFaults(faults)) }
    }

    /// Reads a file, and what could be read of it beside its faults, so that its names can be checked as well.
    ///
    /// # Errors
    /// The file itself cannot be had.
    pub fn read_whole(path: &Path) -> Result<(Self, Vec<RuleFault>), RuleFaults> {
        let source = read_source(path)?;
        Ok(Self::load(&source, Some(path)))
    }

    /// The faults that came up in reading, with those of the names that neither facts nor a map know.
    #[must_use]
    pub fn with_faults_of_names(&self, mut faults: Vec<RuleFault>) -> RuleFaults {
        let is_whole = |fault: &RuleFault| {
            !matches!(
                &*fault.error,
                RuleError::Include { .. }
                    | RuleError::IncludeCycle { .. }
                    | RuleError::Empty { .. }
            )
        };
        if faults.iter().all(is_whole)
            && let Err(RuleFaults(found)) = self.problem.resolve(&self.domain)
        {
            let told = |fault: &RuleFault| {
                let (name, offset) = fault.place().unzip();
                (name.map(str::to_owned), offset, fault.to_string())
            };
            let mut known: HashSet<_> = faults.iter().map(told).collect();
            faults.extend(found.into_iter().filter(|fault| known.insert(told(fault))));
        }
        in_order_of_texts(&mut faults);
        faults.truncate(MOST_FAULTS);
        RuleFaults(faults)
    }

    /// Reads a text; what it includes is looked for from the working directory.
    ///
    /// # Errors
    /// As [`Scenario::read`].
    pub fn parse(source: &Source) -> Result<Self, RuleFaults> {
        let (scenario, faults) = Self::load(source, None);
        if faults.is_empty() { Ok(scenario) } else { Err(RuleFaults(faults)) }
    }

    /// As [`Scenario::read_whole`], of a text that stands, or will stand, at this path.
    #[must_use]
    pub fn parse_whole(source: &Source, path: &Path) -> (Self, Vec<RuleFault>) {
        Self::load(source, Some(path))
    }

    /// Reads a PDDL domain and problem.
    ///
    /// # Errors
    /// All faults of both files at once.
    pub fn read_pddl(domain: &Path, problem: &Path) -> Result<Self, RuleFaults> {
        match (read_source(domain), read_source(problem)) {
            (Ok(domain), Ok(problem)) => Self::parse_pddl(&domain, &problem),
            (domain, problem) => {
                Err(RuleFaults(domain.err().into_iter().chain(problem.err()).collect()))
            }
        }
    }

    /// Reads the texts of a PDDL domain and problem.
    ///
    /// # Errors
    /// As [`Scenario::read_pddl`].
    pub fn parse_pddl(domain: &Source, problem: &Source) -> Result<Self, RuleFaults> {
        let (mut document, mut faults) = (Document::default(), Vec::new());
        pddl::read(domain, &mut document, &mut faults);
        pddl::read(problem, &mut document, &mut faults);
        // Where some action has a price, one without is free.
        if document.actions.iter().any(|action| !action.cost.is_empty()) {
            for action in document.actions.iter_mut().filter(|action| action.cost.is_empty()) {
                action.cost.push(CostTerm::Number(Amount::NOTHING));
            }
        }
        let (scenario, faults) = Self::from_document(document, faults);
        if faults.is_empty() { Ok(scenario) } else { Err(RuleFaults(faults)) }
    }

    /// Grounds the scenario as it stands.
    ///
    /// # Errors
    /// As [`ground`].
    pub fn ground(&self) -> Result<Task, RuleFaults> {
        ground(&self.domain, &self.problem)
    }

    fn load(source: &Source, path: Option<&Path>) -> (Self, Vec<RuleFault>) {
        let mut loader = Loader { open: Vec::new(), done: Vec::new(), faults: Vec::new() };
        let document = loader.load(source, path);
        Self::from_document(document, loader.faults)
    }

    /// Checks what was read even when `faults` came up in reading, so that one run tells everything.
    fn from_document(mut document: Document, mut faults: Vec<RuleFault>) -> (Self, Vec<RuleFault>) {
        let mut warnings = std::mem::take(&mut document.warnings);
        let second = settle_names(&mut document, &mut faults);
        slips(&document, &mut faults, &mut warnings);
        if let (Some(own), Some(wanted)) = &document.domain_names
            && own.key() != wanted.key()
        {
            let (found, name) = (own.text.clone(), wanted.text.clone());
            let error = |at| RuleError::OtherDomain { wanted: name, found, at };
            warnings.push(wanted.fault(error));
        }
        let (domain, goal) = check::domain(&document, second, &mut faults);
        let problem = Problem::of(&document, goal, &mut faults);
        problem.check(&domain, &mut faults);
        in_order_of_texts(&mut faults);
        faults.truncate(MOST_FAULTS);
        let map = document.map.as_ref().map(|name| beside(name, Path::new(name.at.source.name())));
        (Self { domain, problem, map, warnings }, faults)
    }
}

/// Text by text as they were first spoken of, and from the head of each to its end; what is told twice of one place,
/// such as the type that several objects share, once.
fn in_order_of_texts(faults: &mut Vec<RuleFault>) {
    let mut texts: Vec<String> = Vec::new();
    for (name, _) in faults.iter().filter_map(RuleFault::place) {
        if !texts.iter().any(|known| known == name) {
            texts.push(name.to_owned());
        }
    }
    faults.sort_by_cached_key(|fault| {
        let (name, offset) = fault.place()?;
        Some((texts.iter().position(|known| known == name), offset))
    });
    faults.dedup_by(|later, earlier| {
        later.error == earlier.error && later.place() == earlier.place()
    });
}

impl Domain {
    /// Reads a file of rules, with its harmless faults; what else it states is left aside.
    ///
    /// # Errors
    /// All faults of the file and of those that it includes, at once.
    pub fn read(path: &Path) -> Result<(Self, Vec<RuleFault>), RuleFaults> {
        let scenario = Scenario::read(path)?;
        if scenario.domain.schemas().is_empty() {
            return Err(RuleFault::placeless(RuleError::NoActions).into());
        }
        Ok((scenario.domain, scenario.warnings))
    }
}

/// The text of a file, if it is text and of a size that makes sense.
pub(super) fn read_source(path: &Path) -> Result<Source, RuleFault> {
    let shown = path.display().to_string();
    let kind = |fault: &FileFault| match fault {
        FileFault::Io(error) => Some(error.kind()),
        _ => None,
    };
    let reason = match read_text(path, MAX_FILE_BYTES) {
        Ok(text) => return Ok(Source::new(shown, text)),
        Err(FileFault::TooLarge { bytes, limit }) => {
            return Err(RuleFault::placeless(RuleError::TooLarge { path: shown, bytes, limit }));
        }
        Err(FileFault::NotText { at: offset }) => {
            return Err(RuleFault::placeless(RuleError::NotText { path: shown, offset }));
        }
        Err(fault) => match kind(&fault) {
            Some(std::io::ErrorKind::NotFound) => {
                said!("strips-no-such-file")
            }
            Some(std::io::ErrorKind::PermissionDenied) => {
                said!("strips-no-permission")
            }
            _ => (&fault).into(),
        },
    };
    Err(RuleFault::placeless(RuleError::Unreadable { path: shown, reason }))
}

struct Loader {
    /// The chain of files being read, to see a circle.
    open: Vec<PathBuf>,
    /// Files read once are not read again.
    done: Vec<PathBuf>,
    faults: Vec<RuleFault>,
}

impl Loader {
    fn load(&mut self, source: &Source, path: Option<&Path>) -> Document {
        if source.text().chars().all(|c| c.is_whitespace() || c == '\u{feff}') {
            let error = RuleError::Empty { path: source.name().to_owned() };
            self.faults.push(RuleFault::placeless(error));
            return Document::default();
        }
        let identity = path.map(|path| path.canonicalize().unwrap_or_else(|_| path.to_owned()));
        self.open.extend(identity.clone());
        let parsed = rule_text::parse(source);
        self.faults.extend(parsed.faults);
        // What is included comes first, as if it stood at the head of the file.
        let mut document = Document::default();
        for include in parsed.includes {
            document.include(self.included(&include, path));
        }
        let own_map = parsed.document.map.clone();
        document.include(parsed.document);
        document.map = own_map.or(document.map);
        if identity.is_some() {
            self.done.extend(self.open.pop());
        }
        document
    }

    fn included(&mut self, include: &Name, from: Option<&Path>) -> Document {
        let path = beside(include, from.unwrap_or(Path::new("")));
        let identity = path.canonicalize().unwrap_or_else(|_| path.clone());
        if self.open.contains(&identity) {
            self.faults.push(include.fault(|at| RuleError::IncludeCycle { at }));
        } else if !self.done.contains(&identity) {
            match read_source(&path) {
                Ok(source) => return self.load(&source, Some(&path)),
                Err(fault) => self.faults.push(include.fault(|at| RuleError::Include {
                    path: include.text.clone(),
                    reason: match *fault.error {
                        RuleError::Unreadable { reason, .. } => reason,
                        other => Bilingual::of(&other),
                    },
                    at,
                })),
            }
        }
        Document::default()
    }
}

/// A path as seen from the folder of the file that names it.
fn beside(name: &Name, from: &Path) -> PathBuf {
    let relative = Path::new(&name.text);
    match from.parent() {
        Some(folder) if relative.is_relative() => folder.join(relative),
        _ => relative.to_owned(),
    }
}

//! The rule text of the relations: read, checked, and asked how far measuring must look for it.

use std::path::{Path, PathBuf};

use crate::facts::{EvaluateError, FactError, Faults, Program, RuleError};
use crate::map::{LeastSizes, Profile, Tolerances};
use crate::measure::Reach;
use crate::measured::{MEASURED, Measured, Order};
use crate::thresholds::{self, ThresholdFault, Thresholds};
use crate::units::{Bilingual, Carried, FileFault, OwnText, Source, carried};

/// The rule text that the crate brings along.
pub static STANDARD: Carried = carried!("../../../rules/relations.dl");
/// No rule file that a person wrote is longer.
pub(crate) const MAX_FILE_BYTES: u64 = 16 << 20;

/// Why there are no relations.
#[derive(Debug, crate::units::Fault)]
#[fault(semantics)]
#[non_exhaustive]
pub enum RelationError {
    /// The file of rules could not be read.
    Unreadable { path: String, message: Bilingual },

    /// Longer than what a person writes.
    TooLarge { path: String, bytes: u64, limit: u64 },

    /// Nothing but white space.
    Empty { path: String },

    /// The rule text is at fault.
    #[fault(transparent)]
    Rules(#[from] Faults),

    /// The rule text declares a measured relation otherwise than it is measured.
    Schema { fault: FactError },

    /// Thresholds of the rule text that cannot be meant.
    Thresholds {
        first: Bilingual,
        #[related]
        faults: Vec<ThresholdFault>,
    },

    /// Evaluation does not end within its limits.
    #[fault(transparent)]
    Evaluate(#[from] EvaluateError),

    /// A name that no relation bears.
    UnknownRelation { name: String, nearest: Option<String> },
}

/// A rule text, read and found sound.
#[derive(Debug, Clone)]
pub struct RelationRules {
    program: Program,
    reach: Reach,
    /// How far a step through a door looks, in tenths of a millimetre.
    step: i64,
}

impl RelationRules {
    /// The rules that the crate brings along.
    ///
    /// # Panics
    /// Never: a test reads them.
    #[must_use]
    pub fn standard() -> Self {
        Self::parse(&[Source::new("rules/relations.dl", *STANDARD)])
            .expect("the standard rules are sound")
    }

    /// The rules of a file, else those that the crate brings along, and after them those of more files.
    ///
    /// # Errors
    /// [`RelationError::Unreadable`], [`RelationError::TooLarge`], [`RelationError::Empty`],
    /// [`RelationError::Rules`] with all faults of all texts, [`RelationError::Schema`].
    pub fn load(base: Option<&Path>, more: &[PathBuf]) -> Result<Self, RelationError> {
        let mut texts = vec![match base {
            Some(path) => text_of(path)?,
            None => Source::new("rules/relations.dl", *STANDARD),
        }];
        for path in more {
            texts.push(text_of(path)?);
        }
        Self::parse(&texts)
    }

    /// The standard rules with more of one's own after them.
    ///
    /// # Errors
    /// [`RelationError::Rules`] with all faults of the text, [`RelationError::Schema`].
    pub fn with(text: &Source) -> Result<Self, RelationError> {
        Self::parse(&[Source::new("rules/relations.dl", *STANDARD), text.clone()])
    }

    /// Several texts as one.
    ///
    /// # Errors
    /// [`RelationError::Rules`] with all faults of all texts, [`RelationError::Schema`].
    pub fn parse(texts: &[Source]) -> Result<Self, RelationError> {
        let (texts, program) = declared(texts)?;
        let faults = thresholds::faults(&program);
        if !faults.is_empty() {
            let first = faults.first().map_or_else(|| "".into(), |fault| fault.message.clone());
            return Err(RelationError::Thresholds { first, faults });
        }
        let program = completed(&texts, program);
        let empty = program.evaluate(&program.database())?;
        let mut rules = Self { program, reach: Reach::default(), step: 6_000 };
        let facts = empty.tuples("reach").into_iter().flatten();
        for (name, limit) in
            facts.filter_map(|fact| Some((fact.symbol(0)?.to_owned(), fact.number(1)?)))
        {
            // Beyond a hundred metres nothing in a room is near.
            let limit = limit.clamp(0, 1_000_000);
            rules.reach_of(&name).into_iter().for_each(|reach| *reach = limit);
        }
        // What a threshold asks for is measured, whatever the text says of measuring.
        for name in REACHES {
            let farthest = thresholds::farthest(&rules.program, name);
            rules.reach_of(name).into_iter().for_each(|reach| *reach = farthest.max(*reach));
        }
        let own = |source: &Source| {
            source.text() != *STANDARD && texts.iter().any(|text| text.text() == source.text())
        };
        let either = MEASURED.iter().filter(|measured| measured.order == Order::Either);
        let mut either = either.filter_map(|measured| rules.program.relation(measured.name));
        let program = &rules.program;
        rules.reach.both_orders = either.any(|relation| program.readers(relation).any(own));
        Ok(rules)
    }

    /// The thresholds of a profile as the facts of the text have them, where no world is at hand; what rules derive of
    /// thresholds beside them only a world's relations know.
    #[must_use]
    pub fn thresholds(&self, profile: Profile) -> Thresholds {
        Thresholds::written(&self.program, profile)
    }

    /// Within what a map's things are taken to stand on one another where one looks for what cannot be.
    #[must_use]
    pub fn tolerances(&self, profile: Profile) -> Tolerances {
        let near = self.thresholds(profile);
        Tolerances {
            floor: near.floor_gap,
            hanging: near.hanging_gap,
            support: near.support_gap_up,
            beside: near.lean_gap,
            inside: near.inside_slack,
            overlap: near.overlap_depth,
            doorway: near.doorway_depth,
            ceiling: near.ceiling_gap,
            least: LeastSizes {
                room: near.least_room,
                ceiling: near.least_ceiling,
                door: near.least_door,
                furniture: near.least_furniture,
                radius: near.least_radius,
                height: near.least_height,
                speed: near.least_speed,
            },
        }
    }

    fn reach_of(&mut self, name: &str) -> Option<&mut i64> {
        Some(match name {
            "distance" => &mut self.reach.distance,
            "beside" => &mut self.reach.beside,
            "sector" => &mut self.reach.sector,
            "sink" => &mut self.reach.sink,
            "escape" => &mut self.reach.escape,
            "outside" => &mut self.reach.outside,
            "edge" => &mut self.reach.edge,
            "opening" => &mut self.reach.opening,
            "apart" => &mut self.reach.apart,
            "step" => &mut self.step,
            _ => return None,
        })
    }

    /// How far measuring must look for these rules.
    #[must_use]
    pub fn reach(&self) -> Reach {
        self.reach
    }

    /// How far a step through a door looks, cm.
    #[must_use]
    pub fn step_reach(&self) -> f64 {
        self.step as f64 / 100.0
    }

    /// How far from a thing what it bears or holds may be, by any profile's thresholds, cm.
    #[must_use]
    pub fn hold_cm(&self) -> f64 {
        let over = thresholds::greatest(&self.program, "support gap up");
        over.max(self.reach.sink).max(self.reach.escape) as f64 / 100.0
    }

    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }
}

/// The names of all reaches.
const REACHES: [&str; 10] = [
    "distance", "beside", "sector", "sink", "escape", "outside", "edge", "opening", "apart", "step",
];

/// The program of some texts, with declarations of the measured relations that they use without declaring them.
fn declared(texts: &[Source]) -> Result<(Vec<Source>, Program), Faults> {
    let faults = match Program::parse_all(texts) {
        Ok(program) => return Ok((texts.to_vec(), program)),
        Err(faults) => faults,
    };
    let unknown = |measured: &&Measured| {
        let is_it = |fault: &RuleError| matches!(fault, RuleError::UnknownRelation { name, .. } if name == measured.name);
        faults.iter().any(is_it)
    };
    let declarations: String = MEASURED.iter().filter(unknown).map(Measured::declaration).collect();
    if declarations.is_empty() {
        return Err(faults);
    }
    let more = Source::own(OwnText::Measurements, declarations);
    let texts: Vec<Source> = texts.iter().cloned().chain([more]).collect();
    let program = Program::parse_all(&texts)?;
    Ok((texts, program))
}

/// A text that is older than a threshold or a section of the standard text gets it from there. A text that goes without
/// what these need stays as it is.
fn completed(texts: &[Source], program: Program) -> Program {
    let lacking = thresholds::lacking(&program);
    let is_older = !lacking.is_empty();
    let lacks = |program: &Program, section: &str| {
        let names = section.lines().filter_map(|line| line.strip_prefix(".decl "));
        let mut names = names.filter_map(|line| line.split('(').next());
        names.all(|name| program.relation(name).is_none())
    };
    let sections = SECTIONS.iter().filter_map(|heading| section(heading));
    let places = sections.clone().take(1).filter(|_| is_older);
    let (mut own, mut program) = (lacking, program);
    let read = |own: &str| {
        let own = Source::own(OwnText::Relations, own);
        let texts: Vec<Source> = texts.iter().cloned().chain([own]).collect();
        Program::parse_all(&texts).ok()
    };
    if is_older {
        match read(&own) {
            Some(read) => program = read,
            None => return program,
        }
    }
    for section in places.chain(sections.skip(1)) {
        if lacks(&program, section)
            && let Some(read) = read(&format!("{own}{section}"))
        {
            (own, program) = (format!("{own}{section}"), read);
        }
    }
    program
}

/// The sections of the standard text that an older one may lack: about walls, doors and middles, which needs nothing but
/// what stands before it; what is derived when asked; and what the robot faces.
const SECTIONS: [&str; 3] =
    ["У стены, у двери, посередине", "Когда спрашивают", "К чему стоят лицом"];

/// A section of the standard text, from its heading to the next.
fn section(heading: &str) -> Option<&'static str> {
    let (_, from) = STANDARD.split_once(&format!("// ═══ {heading} "))?;
    let (_, from) = from.split_once('\n')?;
    Some(from.split_once("// ═══").map_or(from, |(section, _)| section))
}

fn text_of(path: &Path) -> Result<Source, RelationError> {
    let name = || path.to_string_lossy().into_owned();
    let source = Source::read_within(path, MAX_FILE_BYTES).map_err(|fault| match fault {
        FileFault::TooLarge { bytes, limit } => {
            RelationError::TooLarge { path: name(), bytes, limit }
        }
        other => RelationError::Unreadable { path: name(), message: (&other).into() },
    })?;
    if source.text().trim().is_empty() {
        return Err(RelationError::Empty { path: name() });
    }
    Ok(source)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_standard_rules_are_sound() {
        let rules = RelationRules::standard();
        let warnings: Vec<String> = rules
            .program()
            .warnings()
            .iter()
            .flat_map(|file| file.placed())
            .map(|(line, column, warning)| format!("{line}:{column} {warning}"))
            .collect();
        assert_eq!(warnings, Vec::<String>::new());
        assert_eq!(rules.reach, Reach::default());
    }
}

//! The rule text of the relations: read, checked, and asked how far measuring must look for it.

use std::path::{Path, PathBuf};

use miette::Diagnostic;
use thiserror::Error;

use crate::facts::{EvaluateError, FactError, Faults, Program};
use crate::semantics::measure::Reach;
use crate::units::{FileFault, Source};

/// The rule text that the crate brings along.
pub const STANDARD: &str = include_str!("../../../rules/relations.dl");
/// No rule file that a person wrote is longer.
const MAX_FILE_BYTES: u64 = 16 << 20;

/// Why there are no relations.
#[derive(Debug, Error, Diagnostic)]
pub enum RelationError {
    /// The file of rules could not be read.
    #[error("не удалось прочесть файл правил «{path}»: {message}")]
    #[diagnostic(
        code(semantics::unreadable),
        help("проверьте путь и права доступа; файл должен быть в UTF-8")
    )]
    Unreadable { path: String, message: String },
    /// Longer than what a person writes.
    #[error("файл правил «{path}» слишком велик: {bytes} байт, предел {MAX_FILE_BYTES}")]
    #[diagnostic(
        code(semantics::too_large),
        help("правила – это текст, написанный человеком; проверьте, тот ли это файл")
    )]
    TooLarge { path: String, bytes: u64 },
    /// Nothing but white space.
    #[error("файл правил «{path}» пуст")]
    #[diagnostic(
        code(semantics::empty),
        help("уберите его, и будут действовать правила, которые есть в самой программе")
    )]
    Empty { path: String },
    /// The rule text is at fault.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Rules(#[from] Faults),
    /// The rule text declares a measured relation otherwise than it is measured.
    #[error("{fault}")]
    #[diagnostic(
        code(semantics::schema),
        help(
            "измеряемые отношения объявлены в rules/relations.dl, раздел «Измерения»; их столбцы менять нельзя"
        )
    )]
    Schema { fault: FactError },
    /// Evaluation does not end within its limits.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Evaluate(#[from] EvaluateError),
    /// A name that no relation bears.
    #[error("нет отношения «{name}»")]
    #[diagnostic(code(semantics::unknown_relation), help("{}", nearest.as_ref().map_or_else(
        || "имена отношений стоят в rules/relations.dl".to_owned(), |n| format!("может быть, «{n}»?"))))]
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
        Self::parse(&[Source::new("rules/relations.dl", STANDARD)])
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
            None => Source::new("rules/relations.dl", STANDARD),
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
        Self::parse(&[Source::new("rules/relations.dl", STANDARD), text.clone()])
    }

    /// Several texts as one.
    ///
    /// # Errors
    /// [`RelationError::Rules`] with all faults of all texts, [`RelationError::Schema`].
    pub fn parse(texts: &[Source]) -> Result<Self, RelationError> {
        let program = Program::parse_all(texts)?;
        let empty = program.evaluate(&program.database())?;
        let mut rules = Self { program, reach: Reach::default(), step: 6_000 };
        let Ok(facts) = empty.tuples("reach") else { return Ok(rules) };
        for fact in facts {
            let (Some(name), Some(limit)) = (fact.symbol(0), fact.number(1)) else { continue };
            // Beyond a hundred metres nothing in a room is near.
            let limit = limit.clamp(0, 1_000_000);
            match name {
                "distance" => rules.reach.distance = limit,
                "beside" => rules.reach.beside = limit,
                "sector" => rules.reach.sector = limit,
                "sink" => rules.reach.sink = limit,
                "escape" => rules.reach.escape = limit,
                "outside" => rules.reach.outside = limit,
                "apart" => rules.reach.apart = limit,
                "step" => rules.step = limit,
                _ => {}
            }
        }
        Ok(rules)
    }

    /// How far measuring must look for these rules.
    #[must_use]
    pub fn reach(&self) -> Reach {
        self.reach
    }

    /// How far a step through a door looks, cm.
    pub(super) fn step_cm(&self) -> f64 {
        self.step as f64 / 100.0
    }

    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }
}

fn text_of(path: &Path) -> Result<Source, RelationError> {
    let name = || path.to_string_lossy().into_owned();
    let source = Source::read_within(path, MAX_FILE_BYTES).map_err(|fault| match fault {
        FileFault::TooLarge { bytes, .. } => RelationError::TooLarge { path: name(), bytes },
        other => RelationError::Unreadable { path: name(), message: other.to_string() },
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

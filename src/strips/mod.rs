//! Rule files: the paper's STRIPS text and PDDL, checked and grounded (paper 1, section 8).
//!
//! A text becomes a checked [`Domain`] and a [`Problem`]; facts from elsewhere may be added to the problem;
//! [`ground`] turns the two into a [`Task`] of numbered facts and operators, all that a planner sees.
//!
//! ```
//! use orthoframe_strips::Scenario;
//! use orthoframe_units::Source;
//!
//! let text = "
//! Действие: Движение-из_в
//! (Параметры: помещение ?x, помещение ?z)
//! (Предусловие: РОБОТ-НАХОДИТСЯ-В_(помещение ?x) ПРОХОД_ИЗ_В(?x, ?z))
//! (Эффект+: РОБОТ-НАХОДИТСЯ-В_(помещение ?z))
//! (Эффект-: РОБОТ-НАХОДИТСЯ-В_(помещение ?x))
//!
//! Исходная позиция: РОБОТ-НАХОДИТСЯ-В_(Комната-В)
//! Целевая позиция:  РОБОТ-НАХОДИТСЯ-В_(Комната-Z)
//! Факты:            ПРОХОД_ИЗ_В_(Комната-В, Комната-Z)";
//! let task = Scenario::parse(&Source::new("пример", text))?.ground()?;
//! assert_eq!(task.operators[0].to_string(), "Движение-из_в_(Комната-В, Комната-Z)");
//! # Ok::<(), orthoframe_strips::RuleFaults>(())
//! ```

use orthoframe_units as units;

units::messages!("../../rules/messages", "strips", RuleError);

mod attain;
mod bystander;
mod cases;
mod check;
mod compound;
mod declare;
mod domain;
mod draft;
mod durative;
mod error;
mod exchange;
mod explain;
mod expression;
mod fault;
mod ground;
mod hint;
mod indices;
mod lack;
mod load;
mod other_names;
mod outline;
mod pddl;
mod phrase;
mod phrases;
mod plain;
mod plan_text;
mod price;
mod problem;
mod reachability;
mod replay;
mod resolve;
mod rule_text;
mod second;
mod simplify;
mod slip;
mod syntax;
mod task;
mod token;
mod wanted;
mod wish;

pub use domain::{
    ANY_KIND, ConditionalEffect, Domain, Formula, Kind, KindId, KindSet, Predicate, PredicateId,
    Schema, SchemaAtom, SchemaCost, SchemaTerm,
};
pub use draft::GOAL_STEP;
pub use error::{Place, RuleError};
pub use explain::{Clash, Missing, Obstacle, Turn, explain_unreachable};
pub use fault::{RuleFault, RuleFaults};
pub use ground::{ground, ground_while};
pub use load::{MAX_FILE_BYTES, Scenario};
pub use outline::{Mark, Meaning, outline};
pub use phrase::{Phrases, Said, SaidArgument, Wording};
pub use plan_text::{Directive, PlanText};
pub use price::without_price;
pub use problem::{Preference, Problem, Standing, Stated};
pub use replay::{Broken, Replayed};
pub use task::{Fact, FactId, Operator, OperatorId, Task};
pub use token::in_quotes;

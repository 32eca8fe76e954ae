//! Relations that somebody computes when they are asked for, and why a question has no answers.

use miette::Diagnostic;
use thiserror::Error;

use super::evaluate::EvaluateError;
use super::fault::Faults;
use super::word::Value;
use crate::units::{Bilingual, Source};

/// A relation that is computed when asked.
///
/// What it tells must not change while a question is answered.
pub trait Computed {
    /// Its `.decl`, over types of the program.
    fn declaration(&self) -> &Source;

    /// The ways in which it can be asked: the columns that must be known, as bits from the first column on, with how
    /// many rows there will be, roughly.
    fn ways(&self) -> &[(u32, f64)];

    /// Tells the rows that have these values in the columns that are known, at least those of one of the ways.
    fn rows(&self, known: &[Option<Value>], tell: &mut dyn FnMut(&[Value]));
}

/// Why a question has no answers.
#[derive(Debug, Clone, Error, Diagnostic)]
#[non_exhaustive]
pub enum AskError {
    /// It reads well and means nothing, or does not read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Faults(#[from] Faults),
    /// A limit was reached.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Evaluate(#[from] EvaluateError),
    /// A computed relation was to be asked for what it cannot tell.
    #[error("{place}отношение «{relation}» вычисляется, когда известны {needs}")]
    #[diagnostic(
        code(facts::not_known),
        help("свяжите эти столбцы другими посылками или назовите их значения")
    )]
    Blocked { relation: String, needs: Bilingual, place: String },
    /// Rules that need rules that need rules …
    #[error("«{relation}» зависит от слишком длинной цепочки отношений")]
    #[diagnostic(code(facts::too_deep), help("выведите часть цепочки заранее"))]
    TooDeep { relation: String },
}

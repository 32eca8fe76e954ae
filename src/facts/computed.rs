//! Relations that somebody computes when they are asked for, and why a question has no answers.

use miette::Diagnostic;

use super::evaluate::EvaluateError;
use super::fault::Faults;
use super::word::Value;
use crate::units::{Bilingual, English, Source};

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
#[derive(Debug, Clone, crate::units::Fault)]
#[fault(facts)]
#[non_exhaustive]
pub enum AskError {
    /// It reads well and means nothing, or does not read.
    #[fault(transparent)]
    Faults(#[from] Faults),

    /// A limit was reached.
    #[fault(transparent)]
    Evaluate(#[from] EvaluateError),

    /// A computed relation was to be asked for what it cannot tell.
    #[fault(code = "facts::not_known")]
    Blocked { relation: String, needs: Bilingual, place: String },

    /// Rules that need rules that need rules …
    TooDeep { relation: String },
}

impl AskError {
    /// The faults as English tells them, each with its place.
    #[must_use]
    pub fn in_english(&self) -> Box<dyn Diagnostic + '_> {
        match self {
            Self::Faults(faults) => Box::new(faults.in_english()),
            other => Box::new(English(other)),
        }
    }
}

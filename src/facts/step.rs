//! The steps of a planned rule body.

use super::filter::ColumnFilter;
use super::program::{Bounds, Compare, Expr, Kind};
use super::syntax::Aggregation;

/// What is done with the registers, one after the other.
#[derive(Debug, Clone)]
pub(super) enum Step {
    Scan(Scan),
    Filter(Compare),
    /// The register takes the expression's value.
    Let {
        register: u32,
        value: Expr,
    },
    /// The register takes each of the numbers in turn, or has one of them already.
    Each {
        register: u32,
        bounds: Bounds,
        is_known: bool,
    },
    /// No row of the source has the key.
    Absent {
        source: usize,
        key: Vec<Expr>,
    },
    /// The steps behind, up to `end`, find what is counted and end with `Reached`; the run goes on at `end`.
    Aggregate {
        function: Aggregation,
        /// Of the value.
        kind: Kind,
        value: Option<Expr>,
        register: u32,
        /// The register has a value already, which the aggregate's must equal.
        is_known: bool,
        end: usize,
    },
    Reached,
}

/// Goes through the rows of a source that have a key.
#[derive(Debug, Clone, Default)]
pub(super) struct Scan {
    pub(super) source: usize,
    pub(super) key: Vec<Expr>,
    /// Columns of the source that must equal a register that an earlier load of this scan has set.
    pub(super) same: Vec<(usize, u32)>,
    pub(super) loads: Vec<(usize, u32)>,
    pub(super) filters: Vec<ColumnFilter>,
    /// Nothing that is found from here on can be told apart later: one success is enough.
    pub(super) once: bool,
    /// Within an aggregate, where each row counts, also one that looks like the row before.
    pub(super) counts: bool,
}

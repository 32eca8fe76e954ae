//! YAML of foreign files as one value, within limits.
//!
//! **Invariant.** Memory follows the length of the text: nesting, nodes, and what aliases replay are bounded.

use serde_json::Value;

use crate::units::{Piece, Source, said};

use super::ReadError;

/// Reads a whole text. `what` names it in a fault: «здания».
///
/// # Errors
/// [`ReadError::Syntax`], also where the text goes beyond the limits.
pub(super) fn parse(
    source: &Source,
    format: &'static str,
    what: Piece,
) -> Result<Value, ReadError> {
    let options = serde_saphyr::options! {
        strict_booleans: true,
        budget: serde_saphyr::budget! {
            max_depth: 64,
            flow_nesting_limit: 32,
            max_nodes: 20_000_000,
            max_events: 40_000_000,
            max_aliases: 1_000,
        },
        alias_limits: serde_saphyr::alias_limits! { max_total_replayed_events: 10_000 },
    };
    serde_saphyr::from_str_with_options(source.text(), options).map_err(|e| {
        let e = e.without_snippet();
        let at = e.location().map_or(0, |at| {
            let lines = source.text().split_inclusive('\n');
            let before: usize =
                lines.take((at.line() as usize).saturating_sub(1)).map(str::len).sum();
            before + (at.column() as usize).saturating_sub(1)
        });
        ReadError::syntax(format, said!("no-yaml", what, reason = e.to_string()), source, at)
    })
}

//! Filters of a scan: where in a range of rows, or over a column of an index, a comparison holds.

use std::ops::Range;

use super::index::IndexColumn;
use super::program::Expr;
use super::rows::RowSet;
use super::syntax::Comparison;
use super::value;
use super::word::{LARGE, NO_WORD, Word, Words, is_in_place};

/// `column op value`, where the value is known before the scan.
#[derive(Debug, Clone)]
pub(super) struct ColumnFilter {
    pub(super) column: usize,
    pub(super) op: Comparison,
    pub(super) value: Expr,
    pub(super) is_number: bool,
}

/// Where in a range of sorted rows a filter on the first column behind the key can hold: among the numbers in
/// place, which stand in their order, and among the large ones behind them.
pub(super) fn narrow(
    rows: &dyn RowSet,
    range: Range<usize>,
    free: usize,
    filter: &ColumnFilter,
    word: Word,
) -> (Range<usize>, Range<usize>) {
    use Comparison::{Equal, Greater, GreaterOrEqual, Less, LessOrEqual};
    let is_order = matches!(filter.op, Equal | Less | LessOrEqual | Greater | GreaterOrEqual);
    if filter.column != free || !is_order || !filter.is_number || !is_in_place(word) {
        return (range, 0..0);
    }
    let bound = |word: Word| rows.bound(range.clone(), free, word);
    let large = bound(LARGE);
    let from = match filter.op {
        Greater => bound(word + 1),
        GreaterOrEqual | Equal => bound(word),
        _ => range.start,
    };
    let to = match filter.op {
        Less => bound(word),
        LessOrEqual | Equal => bound(word + 1),
        _ => large,
    };
    (from..to, large..range.end)
}

/// The positions of a range whose column compares so with the word.
pub(super) fn choose(
    chosen: &mut Vec<u32>,
    range: Range<usize>,
    column: &IndexColumn,
    filter: &ColumnFilter,
    word: Word,
    words: &Words,
) {
    let compares_words = filter.op == Comparison::Equal
        || column.is_in_place
            && (filter.op == Comparison::NotEqual
                || filter.is_number && is_in_place(word) && is_order(filter.op));
    if !compares_words {
        chosen.clear();
        chosen.extend(range.start as u32..range.end as u32);
        retain(chosen, column, filter, word, words);
        return;
    }
    let start = range.start as u32;
    let of = &column.words[range];
    match filter.op {
        Comparison::Equal => pick(chosen, start, of, |known| known == word),
        Comparison::NotEqual => pick(chosen, start, of, |known| known != word),
        Comparison::Less => pick(chosen, start, of, |known| known < word),
        Comparison::LessOrEqual => pick(chosen, start, of, |known| known <= word),
        Comparison::Greater => pick(chosen, start, of, |known| known > word),
        _ => pick(chosen, start, of, |known| known >= word),
    }
}

fn is_order(op: Comparison) -> bool {
    use Comparison::{Contains, Matches, NotContains, NotMatches};
    !matches!(op, Contains | NotContains | Matches | NotMatches)
}

/// Without branches, so that a filter that half of the rows pass is as fast as any.
fn pick(chosen: &mut Vec<u32>, start: u32, of: &[Word], holds: impl Fn(Word) -> bool) {
    chosen.resize(of.len(), 0);
    let mut kept = 0;
    for (n, word) in of.iter().enumerate() {
        chosen[kept] = start + n as u32;
        kept += usize::from(holds(*word));
    }
    chosen.truncate(kept);
}

/// Keeps the positions whose column compares so with the word.
pub(super) fn retain(
    chosen: &mut Vec<u32>,
    column: &IndexColumn,
    filter: &ColumnFilter,
    word: Word,
    words: &Words,
) {
    let of = &column.words[..];
    let op = filter.op;
    match op {
        Comparison::Equal => keep(chosen, |at| of[at] == word),
        Comparison::NotEqual if column.is_in_place => keep(chosen, |at| of[at] != word),
        _ if is_order(op) && filter.is_number && column.is_in_place && is_in_place(word) => {
            match op {
                Comparison::Less => keep(chosen, |at| of[at] < word),
                Comparison::LessOrEqual => keep(chosen, |at| of[at] <= word),
                Comparison::Greater => keep(chosen, |at| of[at] > word),
                _ => keep(chosen, |at| of[at] >= word),
            }
        }
        _ => {
            let has_value = |at: usize| of[at] != NO_WORD;
            keep(chosen, |at| {
                has_value(at) && value::holds(op, filter.is_number, of[at], word, words)
            });
        }
    }
}

/// `Vec::retain` without branches.
fn keep(chosen: &mut Vec<u32>, holds: impl Fn(usize) -> bool) {
    let mut kept = 0;
    for n in 0..chosen.len() {
        let at = chosen[n];
        chosen[kept] = at;
        kept += usize::from(holds(at as usize));
    }
    chosen.truncate(kept);
}

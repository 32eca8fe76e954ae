//! A finished relation, sorted by a key and laid out by columns, so that a join finds its partners
//! with one look and filters run over whole columns.
//!
//! Key and columns may be computed from a row's words: `AZ = BZ + BH` joins on the sum, and
//! `AX <= BX + 50` compares with a column that holds `BX + 50`, computed once for each row.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Mutex;

use foldhash::fast::RandomState;

use super::program::Expr;
use super::rows::RowSet;
use super::shares::worked_off;
use super::value;
use super::word::{NO_WORD, Word, Words, is_in_place};
use crate::units::InOrder as _;

/// One column of an index, in the index's order.
#[derive(Debug, Clone)]
pub(super) struct IndexColumn {
    pub(super) words: Vec<Word>,
    /// Every word is a number in place, so that words compare as the numbers do.
    pub(super) is_in_place: bool,
}

/// Rows of a relation, ordered by a key.
#[derive(Debug, Clone)]
pub(super) struct Index {
    /// Positions of rows in the relation; none when they stand in the relation's own order.
    order: Option<Vec<u32>>,
    len: usize,
    keys: Vec<Vec<Word>>,
    directory: Directory,
    columns: Vec<(Expr, IndexColumn)>,
}

/// Where the rows of each first key word stand.
#[derive(Debug, Clone)]
enum Directory {
    /// No key: all rows.
    None,
    /// `starts[word - least]..starts[word - least + 1]`
    Dense {
        least: Word,
        starts: Vec<u32>,
    },
    Sparse(HashMap<Word, (u32, u32), RandomState>),
}

impl Index {
    /// `key` is over columns.
    pub(super) fn new(rows: &dyn RowSet, key: &[Expr], words: &mut Words, threads: usize) -> Self {
        let natural = key.iter().enumerate().all(|(n, part)| *part == Expr::Variable(n as u32));
        let parts: Vec<&Expr> = key.iter().collect();
        let mut keys = columns(rows, None, &parts, words, threads);
        let mut order = None;
        if !natural {
            let sorted = sorted_order(&keys, rows.len());
            for part in &mut keys {
                *part = sorted.iter().map(|at| part[*at as usize]).collect();
            }
            order = Some(sorted);
        }
        let len = order.as_ref().map_or(rows.len(), Vec::len);
        let directory = keys.first().map_or(Directory::None, |first| directory(first));
        Self { order, len, keys, directory, columns: Vec::new() }
    }

    /// Memory held, near enough.
    pub(super) fn bytes(&self) -> usize {
        let words = self.keys.len() + self.columns.len() + usize::from(self.order.is_some());
        (words + 1) * self.len * size_of::<Word>()
    }

    pub(super) fn columns(&self) -> usize {
        self.columns.len()
    }

    /// Keeps so many columns.
    pub(super) fn leave(&mut self, columns: usize) {
        self.columns.truncate(columns);
    }

    /// The numbers of the columns that hold the expressions; none where one is not made yet.
    pub(super) fn places(&self, exprs: &[Expr]) -> Option<Vec<usize>> {
        let place = |expr| self.columns.iter().position(|(known, _)| known == expr);
        exprs.iter().map(place).collect()
    }

    /// Makes the columns of the expressions that there are not yet.
    pub(super) fn add(
        &mut self,
        rows: &dyn RowSet,
        exprs: &[Expr],
        words: &mut Words,
        threads: usize,
    ) {
        let mut missing: Vec<&Expr> = Vec::new();
        for expr in exprs {
            if !missing.contains(&expr) && self.columns.iter().all(|(known, _)| known != expr) {
                missing.push(expr);
            }
        }
        let made = columns(rows, self.order.as_deref(), &missing, words, threads);
        for (expr, words) in missing.into_iter().zip(made) {
            let is_in_place = words.iter().all(|word| is_in_place(*word));
            self.columns.push((expr.clone(), IndexColumn { words, is_in_place }));
        }
    }

    /// The place in the relation of the row at a place in the index.
    pub(super) fn row(&self, at: usize) -> usize {
        self.order.as_ref().map_or(at, |order| order[at] as usize)
    }

    pub(super) fn at(&self, column: usize) -> &IndexColumn {
        &self.columns[column].1
    }

    /// The rows whose key starts so.
    #[inline]
    pub(super) fn range(&self, key: &[Word]) -> Range<usize> {
        let Some((first, more)) = key.split_first() else { return 0..self.len };
        let mut range = match &self.directory {
            Directory::None => 0..self.len,
            Directory::Dense { least, starts } => {
                let at = first.wrapping_sub(*least) as usize;
                if at + 1 >= starts.len() {
                    return 0..0;
                }
                starts[at] as usize..starts[at + 1] as usize
            }
            Directory::Sparse(places) => match places.get(first) {
                Some((start, end)) => *start as usize..*end as usize,
                None => return 0..0,
            },
        };
        for (part, word) in self.keys[1..].iter().zip(more) {
            let here = &part[range.clone()];
            let start = here.partition_point(|known| known < word);
            let end = start + here[start..].partition_point(|known| known == word);
            range = range.start + start..range.start + end;
        }
        range
    }
}

/// Rows from which on it pays to make columns in several threads.
const MANY: usize = 1 << 14;

/// The expressions over each row, one in each thread at a time.
fn columns(
    rows: &dyn RowSet,
    order: Option<&[u32]>,
    exprs: &[&Expr],
    words: &mut Words,
    threads: usize,
) -> Vec<Vec<Word>> {
    let mut made: Vec<Option<Vec<Word>>> = exprs.iter().map(|_| None).collect();
    if threads > 1 && exprs.len() > 1 && rows.len() >= MANY {
        words.consolidate();
        let known = words.share();
        // What is computed takes longest.
        let mut tasks: Vec<(&Expr, &mut Option<Vec<Word>>)> =
            exprs.iter().copied().zip(&mut made).collect();
        tasks.order_by_key(|(expr, _)| matches!(expr, Expr::Call(..)));
        let tasks = Mutex::new(tasks);
        let next = || tasks.lock().ok().and_then(|mut tasks| tasks.pop());
        let work = || {
            while let Some((expr, out)) = next() {
                let mut own = known.share();
                let column = column(rows, order, expr, &mut own);
                // What must be named, or told, is left to the one who names in order.
                let is_quiet = !own.has_own() && own.take_note().is_none();
                *out = Some(column).filter(|_| is_quiet);
            }
        };
        worked_off(threads.min(exprs.len()), &work);
    }
    let left = exprs.iter().zip(made);
    left.map(|(expr, made)| made.unwrap_or_else(|| column(rows, order, expr, words))).collect()
}

/// The expression over each row, [`NO_WORD`] where it has no value.
fn column(rows: &dyn RowSet, order: Option<&[u32]>, expr: &Expr, words: &mut Words) -> Vec<Word> {
    let len = order.map_or(rows.len(), <[u32]>::len);
    let row = |at: usize| rows.row(order.map_or(at, |order| order[at] as usize));
    match expr {
        Expr::Variable(c) => {
            let all = rows.column(*c as usize);
            match order {
                Some(order) => order.iter().map(|at| all[*at as usize]).collect(),
                None => all,
            }
        }
        _ => (0..len)
            .map(|at| value::compute(expr, &|c| row(at)[c as usize], words).unwrap_or(NO_WORD))
            .collect(),
    }
}

/// Row positions by key, those without a key left out.
fn sorted_order(keys: &[Vec<Word>], len: usize) -> Vec<u32> {
    let is_lacking = keys.iter().any(|part| part.contains(&NO_WORD));
    let has_key = |at: &u32| keys.iter().all(|part| part[*at as usize] != NO_WORD);
    let mut order: Vec<u32> = (0..len as u32).filter(|at| !is_lacking || has_key(at)).collect();
    let spans: Vec<Option<Span>> = keys.iter().map(|part| Span::of(part, &order)).collect();
    // By the last word of the key first: those behind it keep their order.
    if let Some(spans) = spans.iter().cloned().collect::<Option<Vec<Span>>>() {
        for (part, span) in keys.iter().zip(spans).rev() {
            order = span.counted(part, &order);
        }
        return order;
    }
    order = match &spans[0] {
        Some(span) => span.counted(&keys[0], &order),
        None => {
            let first = |at: &u32| (u64::from(keys[0][*at as usize]) << 32) | u64::from(*at);
            let mut packed: Vec<u64> = order.iter().map(first).collect();
            packed.sort_unstable();
            packed.into_iter().map(|packed| packed as u32).collect()
        }
    };
    let rest = |at: u32| keys[1..].iter().map(move |part| part[at as usize]);
    for same in order.chunk_by_mut(|a, b| keys[0][*a as usize] == keys[0][*b as usize]) {
        same.sort_by(|a, b| rest(*a).cmp(rest(*b)));
    }
    order
}

/// Between which words a column's lie, near enough to each other that rows are put in order by counting.
#[derive(Debug, Clone)]
struct Span {
    least: Word,
    width: usize,
}

impl Span {
    fn of(words: &[Word], order: &[u32]) -> Option<Self> {
        let known = || order.iter().map(|at| words[*at as usize]);
        let (least, most) = (known().min()?, known().max()?);
        let width = (most - least) as usize;
        (width <= 2 * words.len() + 1024).then_some(Self { least, width })
    }

    /// The rows by their words, those with one word as they stood.
    fn counted(&self, words: &[Word], order: &[u32]) -> Vec<u32> {
        let bin = |at: u32| (words[at as usize] - self.least) as usize;
        let mut starts = vec![0_u32; self.width + 2];
        order.iter().for_each(|at| starts[bin(*at) + 1] += 1);
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        let mut sorted = vec![0; order.len()];
        for at in order {
            let place = &mut starts[bin(*at)];
            sorted[*place as usize] = *at;
            *place += 1;
        }
        sorted
    }
}

fn directory(keys: &[Word]) -> Directory {
    let (Some(least), Some(most)) = (keys.first(), keys.last()) else {
        return Directory::Dense { least: 0, starts: Vec::new() };
    };
    let span = (most - least) as usize;
    if span <= 4 * keys.len() + 1024 {
        let mut starts = vec![0; span + 2];
        for word in keys {
            starts[(word - least) as usize + 1] += 1;
        }
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        return Directory::Dense { least: *least, starts };
    }
    let mut places = HashMap::default();
    let mut start = 0;
    for same in keys.chunk_by(|a, b| a == b) {
        let end = start + same.len() as u32;
        places.insert(same[0], (start, end));
        start = end;
    }
    Directory::Sparse(places)
}

//! Rows into ascending order, each once, by whichever way their kind allows; and without those that others hold.

use datafrog::Relation;

use super::row::Row;
use super::shares::{Task, apart};
use super::word::Word;

/// Rows from which on it pays to sort them in several threads.
const MANY: usize = 1 << 16;

/// Sorts many rows that stand in the order of their first word, as joins find them, in several threads; leaves others.
pub(super) fn sort_runs<const N: usize>(rows: &mut [Row<N>], threads: usize) {
    let is_many = threads > 1 && rows.len() >= MANY;
    if !is_many || !rows.is_sorted_by_key(|row| row.0[0]) {
        return;
    }
    let size = rows.len().div_ceil(threads);
    let mut rest = rows;
    let mut tasks: Vec<Task<'_>> = Vec::with_capacity(threads);
    while !rest.is_empty() {
        let near = size.min(rest.len());
        let last = rest[near - 1].0[0];
        let end = near + rest[near..].partition_point(|row| row.0[0] == last);
        let (mine, others) = std::mem::take(&mut rest).split_at_mut(end);
        rest = others;
        tasks.push(Box::new(move || {
            mine.chunk_by_mut(|a, b| a.0[0] == b.0[0]).for_each(<[_]>::sort_unstable);
        }));
    }
    apart(tasks);
}

/// Ascending rows, each once.
pub(super) fn sorted<const N: usize>(mut rows: Vec<Row<N>>) -> Relation<Row<N>> {
    if rows.is_sorted() {
        rows.dedup();
    } else if let Some(distinct) = counted(&rows) {
        rows = distinct;
    } else {
        if N > 1 && rows.is_sorted_by_key(|row| row.0[0]) {
            // Joins find their rows by the first word; then no row moves far and nothing is copied.
            rows.chunk_by_mut(|a, b| a.0[0] == b.0[0]).for_each(<[_]>::sort_unstable);
        } else if N <= 2 && rows.len() > 512 {
            radix_sort(&mut rows);
        } else {
            rows.sort_unstable();
        }
        rows.dedup();
    }
    Relation { elements: rows }
}

/// Rows of one word, sorted and distinct, read off one bit for each possible word; none where that does not pay.
fn counted<const N: usize>(rows: &[Row<N>]) -> Option<Vec<Row<N>>> {
    const BITS_PER_ROW: usize = 16;
    if N != 1 || rows.len() < 64 {
        return None;
    }
    let (least, most) = rows
        .iter()
        .fold((Word::MAX, 0), |(least, most), row| (least.min(row.0[0]), most.max(row.0[0])));
    let span = (most - least) as usize + 1;
    if span > rows.len() * BITS_PER_ROW {
        return None;
    }
    let mut bits = vec![0_u64; span.div_ceil(64)];
    for row in rows {
        let at = (row.0[0] - least) as usize;
        bits[at / 64] |= 1 << (at % 64);
    }
    let count: u32 = bits.iter().map(|word| word.count_ones()).sum();
    let mut distinct = Vec::with_capacity(count as usize);
    for (n, word) in bits.iter().enumerate() {
        let mut rest = *word;
        while rest != 0 {
            distinct.push(Row([least + (n * 64) as Word + rest.trailing_zeros(); N]));
            rest &= rest - 1;
        }
    }
    Some(distinct)
}

/// Sorts rows of one or two words byte by byte, those bytes left out that are the same in all rows.
fn radix_sort<const N: usize>(rows: &mut Vec<Row<N>>) {
    let key = |row: &Row<N>| if N == 1 { u64::from(row.0[0]) } else { row.pair() };
    let first = key(&rows[0]);
    let varying = rows.iter().fold(0, |varying, row| varying | (key(row) ^ first));
    let mut spare = rows.clone();
    for shift in (0..64).step_by(8).filter(|shift| (varying >> shift) & 0xff != 0) {
        let digit = |row: &Row<N>| (key(row) >> shift) as usize & 0xff;
        let mut starts = [0usize; 257];
        rows.iter().for_each(|row| starts[digit(row) + 1] += 1);
        for n in 1..starts.len() {
            starts[n] += starts[n - 1];
        }
        for row in rows.iter() {
            let at = &mut starts[digit(row)];
            spare[*at] = *row;
            *at += 1;
        }
        std::mem::swap(rows, &mut spare);
    }
}

/// Takes out of ascending rows those that others hold.
pub(super) fn subtract<const N: usize>(rows: &mut Vec<Row<N>>, others: &[Row<N>]) {
    let mut rest = others;
    let is_large = others.len() > 4 * rows.len();
    rows.retain(|row| {
        if is_large {
            // The next partner is near: look in steps that double.
            let mut step = 1;
            while step < rest.len() && rest[step] < *row {
                step *= 2;
            }
            let near = &rest[..rest.len().min(step + 1)];
            rest = &rest[near.partition_point(|other| other < row)..];
        } else {
            while rest.first().is_some_and(|other| other < row) {
                rest = &rest[1..];
            }
        }
        rest.first() != Some(row)
    });
}

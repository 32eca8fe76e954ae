//! Rows that threads have derived apart, put together in order: of any two parts, no row of one is in the other.

use std::ops::Range;
use std::sync::Mutex;

use datafrog::Relation;

use super::row::Row;
use super::seen::Seen;
use super::shares::worked_off;
use super::word::Word;

/// What a thread has derived.
pub(super) enum Part<const N: usize> {
    Bits(Seen),
    /// Ascending.
    Run(Vec<Row<N>>),
}

/// Fewer rows are copied sooner than a thread begins.
const MANY: usize = 1 << 16;
/// Pieces of the result for each thread.
const PIECES: usize = 8;

/// All rows of all parts, ascending.
pub(super) fn joined<const N: usize>(parts: Vec<Part<N>>, threads: usize) -> Relation<Row<N>> {
    let mut bits = Vec::new();
    let mut runs = Vec::new();
    for part in parts {
        match part {
            Part::Bits(seen) => bits.push(seen),
            Part::Run(run) => runs.push(run),
        }
    }
    if runs.iter().all(Vec::is_empty) && !bits.is_empty() {
        return Relation { elements: read_off(&bits, threads) };
    }
    runs.extend(bits.iter().map(Seen::rows));
    runs.retain(|run| !run.is_empty());
    let elements = match runs.len() {
        0 | 1 => runs.pop().unwrap_or_default(),
        _ => merged(&runs, threads),
    };
    Relation { elements }
}

/// Slices one behind the other, copied in several threads where they are long.
pub(super) fn gathered<const N: usize>(slices: &[&[Row<N>]], threads: usize) -> Vec<Row<N>> {
    let total = slices.iter().map(|slice| slice.len()).sum();
    if threads < 2 || total < MANY {
        return slices.concat();
    }
    let pieces =
        slices.iter().flat_map(|slice| slice.chunks(MANY)).map(|slice| (slice.len(), slice));
    filled(total, pieces.collect(), threads, |slice, out: &mut [[Word; N]]| {
        out.iter_mut().zip(slice).for_each(|(out, row)| *out = row.0);
    })
}

/// So many rows, piece by piece: each with its length and what it is made from.
fn filled<const N: usize, T: Send>(
    total: usize,
    pieces: Vec<(usize, T)>,
    threads: usize,
    fill: impl Fn(T, &mut [[Word; N]]) + Sync,
) -> Vec<Row<N>> {
    // Zeroes cost nothing until they are written to, each thread's by itself.
    let mut rows = vec![[0; N]; total];
    let mut rest = rows.as_mut_slice();
    let mut open = Vec::with_capacity(pieces.len());
    for (len, of) in pieces {
        let (mine, others) = std::mem::take(&mut rest).split_at_mut(len);
        rest = others;
        open.push((of, mine));
    }
    let open = Mutex::new(open.into_iter());
    let next = || open.lock().ok().and_then(|mut open| open.next());
    let work = || {
        while let Some((of, out)) = next() {
            fill(of, out);
        }
    };
    worked_off(threads, &work);
    rows.into_iter().map(Row).collect()
}

/// The pairs of several sets of bits: no two hold the same pair.
fn read_off<const N: usize>(bits: &[Seen], threads: usize) -> Vec<Row<N>> {
    let firsts = bits.iter().map(Seen::firsts);
    let (from, to) =
        firsts.fold((u64::MAX, 0), |(from, to), range| (from.min(range.start), to.max(range.end)));
    let span = to.saturating_sub(from);
    let size = span.div_ceil((threads * PIECES) as u64).max(1);
    let starts = (0..span.div_ceil(size)).map(|n| from + n * size);
    let pieces: Vec<(usize, Range<u64>)> = starts
        .map(|start| {
            let range = start..to.min(start + size);
            (bits.iter().map(|seen| seen.count(range.clone())).sum(), range)
        })
        .collect();
    let total = pieces.iter().map(|(len, _)| len).sum();
    filled(total, pieces, threads, |range, out: &mut [[Word; N]]| {
        let mut at = 0;
        for first in range {
            let begun = at;
            let mut parts = 0;
            for seen in bits {
                let before = at;
                seen.each_second(first, &mut |second| {
                    if let Some(row) = out.get_mut(at) {
                        row[0] = first as Word;
                        row[N - 1] = second;
                    }
                    at += 1;
                });
                parts += usize::from(at > before);
            }
            if parts > 1 {
                out[begun..at].sort_unstable();
            }
        }
    })
}

/// Ascending runs without a common row, merged.
fn merged<const N: usize>(runs: &[Vec<Row<N>>], threads: usize) -> Vec<Row<N>> {
    let total: usize = runs.iter().map(Vec::len).sum();
    let longest = runs.iter().max_by_key(|run| run.len()).map_or(&[][..], Vec::as_slice);
    let count = if total < MANY { 1 } else { threads * PIECES };
    let bounds = (1..count).map(|n| longest[longest.len() * n / count]);
    let mut left: Vec<&[Row<N>]> = runs.iter().map(Vec::as_slice).collect();
    let mut pieces = Vec::with_capacity(count);
    for bound in bounds {
        let piece: Vec<&[Row<N>]> = left
            .iter_mut()
            .map(|run| {
                let (near, far) = run.split_at(run.partition_point(|row| *row < bound));
                *run = far;
                near
            })
            .collect();
        pieces.push((piece.iter().map(|run| run.len()).sum(), piece));
    }
    pieces.push((left.iter().map(|run| run.len()).sum(), left));
    filled(total, pieces, threads, |mut runs, out: &mut [[Word; N]]| {
        for out in out {
            let first = runs.iter_mut().filter(|run| !run.is_empty()).min_by_key(|run| run[0]);
            let Some(run) = first else { return };
            *out = run[0].0;
            *run = &run[1..];
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_come_out_as_one_sorted_set() {
        let rows = |of: &dyn Fn(Word, Word) -> bool, most: Word| -> Vec<Row<2>> {
            let all = (0..most).flat_map(|x| (0..most).map(move |y| (x, y)));
            all.filter(|(x, y)| of(*x, *y)).map(|(x, y)| Row([7 + x, 9 + y])).collect()
        };
        let bits = |rows: &[Row<2>]| {
            let mut seen = Seen::over(rows.iter()).expect("dense pairs are kept as bits");
            rows.iter().for_each(|row| {
                seen.insert(row);
            });
            Part::Bits(seen)
        };
        for most in [1, 9, 300] {
            for by in
                [|x: Word, _: Word| x.is_multiple_of(3), |_: Word, y: Word| y.is_multiple_of(3)]
            {
                let one = rows(&|x, y| by(x, y) && (x + y) % 5 > 0 || x == y && by(x, y), most);
                let other = rows(&|x, y| !by(x, y) && x * y % 7 != 1, most);
                let mut wanted = [one.clone(), other.clone()].concat();
                wanted.sort_unstable();
                for threads in [1, 2, 3] {
                    let of = |a, b| joined::<2>(vec![a, b], threads).elements;
                    let run = |rows: &[Row<2>]| Part::Run(rows.to_vec());
                    assert_eq!(of(run(&one), run(&other)), wanted);
                    if !one.is_empty() && !other.is_empty() {
                        assert_eq!(of(bits(&one), bits(&other)), wanted);
                        assert_eq!(of(bits(&one), run(&other)), wanted);
                    }
                    assert_eq!(
                        gathered(&[&one, &other], threads),
                        [one.clone(), other.clone()].concat()
                    );
                }
            }
        }
    }
}

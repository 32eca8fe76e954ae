//! Seeing: scans to segments, identification, change.
//!
//! `cargo bench -p orthoframe-vectors --bench vectors [-- NAME …]` runs the parts named, all of them without a name.
//! Times are medians on the clock; comparisons are counted, not timed. `-- million` adds an index of 10⁶ things
//! (1.2 GB).
#![allow(clippy::print_stdout, reason = "a benchmark's product is its table")]

#[path = "vectors/change.rs"]
mod change;
#[path = "vectors/identify.rs"]
mod identify;
#[path = "vectors/scans.rs"]
mod scans;
#[path = "vectors/shapes.rs"]
mod shapes;

use std::time::{Duration, Instant};

fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let wanted = |name: &str| named.is_empty() || named.iter().any(|n| n == name);
    if wanted("scans") {
        scans::run();
    }
    if wanted("identify") {
        identify::run();
    }
    if named.iter().any(|n| n == "million") {
        identify::million();
    }
    if wanted("change") {
        change::run();
    }
}

/// Median time of `runs` runs.
fn median(runs: usize, work: impl FnMut()) -> Duration {
    times(runs, work)[runs / 2]
}

/// Least time of `runs` runs: of what takes milliseconds, a loaded machine interrupts most runs.
fn least(runs: usize, work: impl FnMut()) -> Duration {
    times(runs, work)[0]
}

/// Times of `runs` runs, the least first.
fn times(runs: usize, mut work: impl FnMut()) -> Vec<Duration> {
    let mut times: Vec<Duration> = (0..runs)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed()
        })
        .collect();
    times.sort();
    times
}

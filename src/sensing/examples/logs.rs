//! How well scans are placed: the odd scans of a log with known poses against walls made of its even ones.
//!
//! `cargo run -p orthoframe-sensing --example logs -- LOG… [--every N]` prints one row a log.
#![allow(clippy::print_stdout, reason = "an evaluation's product is its table")]

use std::path::Path;
use std::time::Instant;

use nalgebra::Isometry2;
use orthoframe_sensing::{Answer, Locator, Walls};
use orthoframe_vectors::read::{read_log, read_source};

fn main() {
    let mut logs = Vec::new();
    let mut every = 1;
    let mut verbose = false;
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--every" => every = words.next().and_then(|n| n.parse().ok()).unwrap_or(1),
            "--each" => verbose = true,
            _ => logs.push(word),
        }
    }
    println!(
        "| log | scans | faces | best right | Unique | right of Unique | truth listed | Unknown | median cm | median ° | ms median | ms 95 % |"
    );
    for log in logs {
        row(Path::new(&log), every, verbose);
    }
}

fn row(path: &Path, every: usize, verbose: bool) {
    let Ok(source) = read_source(path) else {
        println!("| {} | cannot be read |", path.display());
        return;
    };
    let log = read_log(&source).log;
    let mut walls = Walls::new();
    for scan in log.scans.iter().step_by(2) {
        if let Some(pose) = scan.pose {
            walls.add(log.sensor(scan), &scan.ranges, &pose);
        }
    }
    let locator = Locator::new(walls.faces());
    let (mut scans, mut unique, mut right_unique, mut best, mut listed, mut unknown) =
        (0, 0, 0, 0, 0, 0);
    let (mut errors, mut turns, mut times) = (Vec::new(), Vec::new(), Vec::new());
    for (number, scan) in log.scans.iter().enumerate().skip(1).step_by(2 * every) {
        let Some(truth) = scan.pose else { continue };
        let start = Instant::now();
        let answer = locator.locate(log.sensor(scan), &scan.ranges);
        times.push(start.elapsed().as_secs_f64() * 1e3);
        scans += 1;
        let right = |pose: &Isometry2<f64>| {
            let off = off(&truth, pose);
            off.0 <= 50.0 && off.1 <= 10.0
        };
        let fixes = answer.fixes();
        listed += usize::from(fixes.iter().any(|f| right(&f.pose)));
        match fixes.first() {
            None => unknown += 1,
            Some(first) => {
                if right(&first.pose) {
                    best += 1;
                    let off = off(&truth, &first.pose);
                    errors.push(off.0);
                    turns.push(off.1);
                }
            }
        }
        if let Answer::Unique(fix) = &answer {
            unique += 1;
            right_unique += usize::from(right(&fix.pose));
        }
        if verbose {
            let at_truth = locator.refine(log.sensor(scan), &scan.ranges, &truth);
            let first = fixes.first();
            println!(
                "{number} {} listed {} best {:?} off {:?} | at truth {:?} off {:?}",
                match &answer {
                    Answer::Unique(_) => "unique".to_owned(),
                    Answer::Ambiguous(list) => format!("ambiguous {}", list.len()),
                    Answer::Unknown => "unknown".to_owned(),
                },
                fixes.iter().any(|f| right(&f.pose)),
                first.map(|f| (f.fit.score(), f.deviations())),
                first.map(|f| off(&truth, &f.pose)),
                (at_truth.fit, at_truth.fit.score()),
                off(&truth, &at_truth.pose),
            );
        }
    }
    let share = |n: usize, of: usize| n as f64 / of.max(1) as f64;
    println!(
        "| {} | {scans} | {} | {:.3} | {:.3} | {:.4} | {:.3} | {:.3} | {:.1} | {:.2} | {:.1} | {:.1} |",
        path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned()),
        locator.faces().len(),
        share(best, scans),
        share(unique, scans),
        share(right_unique, unique),
        share(listed, scans),
        share(unknown, scans),
        quantile(&mut errors, 0.5),
        quantile(&mut turns, 0.5),
        quantile(&mut times, 0.5),
        quantile(&mut times, 0.95),
    );
}

/// How far apart two poses are, in cm and degrees.
fn off(a: &Isometry2<f64>, b: &Isometry2<f64>) -> (f64, f64) {
    let apart = (a.translation.vector - b.translation.vector).norm();
    (apart, a.rotation.angle_to(&b.rotation).abs().to_degrees())
}

fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    values.get((last as f64 * share).round() as usize).copied().unwrap_or(f64::NAN)
}

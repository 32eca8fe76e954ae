//! Odd scans of a log against a chart of its even ones, without a guess:
//! `cargo run --release -p orthoframe-sensing --example halves -- LOG.gz [EVERY]`.

#![allow(clippy::print_stdout, reason = "a program that prints a table")]

use std::path::Path;
use std::time::Instant;

use orthoframe_sensing::{Answer, Belief, Chart, Localiser, Options, Tracker};
use orthoframe_vectors::read::{read_log, read_source};

fn main() {
    let mut args = std::env::args().skip(1);
    let path = args.next().expect("a log");
    let every: usize = args.next().map_or(10, |n| n.parse().expect("a number"));
    let source = read_source(Path::new(&path)).expect("the log can be read");
    let log = read_log(&source).log;
    let even = log.scans.iter().step_by(2).map(|scan| (log.sensor(scan), scan));
    let started = Instant::now();
    let chart = Chart::of_scans(even);
    let localiser = Localiser::new(&chart, Options::default());
    println!(
        "{} scans, {} lines, chart in {:.1} s",
        log.scans.len(),
        chart.lines().len(),
        started.elapsed().as_secs_f64()
    );
    let (mut unique, mut right, mut ambiguous, mut holds, mut unknown) = (0, 0, 0, 0, 0);
    let (mut errors, mut turns, mut times) = (Vec::new(), Vec::new(), Vec::new());
    for scan in log.scans.iter().skip(1).step_by(2).step_by(every) {
        let Some(pose) = scan.pose else { continue };
        let started = Instant::now();
        let answer = localiser.locate(log.sensor(scan), &scan.ranges);
        times.push(started.elapsed().as_secs_f64() * 1e3);
        let error = |found: &nalgebra::Isometry2<f64>| {
            (
                (found.translation.vector - pose.translation.vector).norm(),
                found.rotation.angle_to(&pose.rotation).abs().to_degrees(),
            )
        };
        let is_right = |(far, turn): (f64, f64)| far <= 50.0 && turn <= 10.0;
        match answer {
            Answer::Unique(fit) => {
                unique += 1;
                let (far, turn) = error(&fit.pose);
                if is_right((far, turn)) {
                    right += 1;
                    errors.push(far);
                    turns.push(turn);
                } else {
                    println!(
                        "wrong at line {}: {far:.0} cm {turn:.0}° explained {:.2} through {:.2}",
                        scan.line, fit.explained, fit.through
                    );
                }
            }
            Answer::Ambiguous(fits) => {
                ambiguous += 1;
                holds += usize::from(fits.iter().any(|fit| is_right(error(&fit.pose))));
            }
            Answer::Unknown => unknown += 1,
        }
    }
    let median = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
    };
    println!(
        "unique {unique}, of these right {right}; several {ambiguous}, of these with the right one {holds}; unknown {unknown}"
    );
    println!(
        "median error {:.1} cm {:.2}°, median time {:.1} ms",
        median(&mut errors),
        median(&mut turns),
        median(&mut times)
    );
    // By odometry over some metres, from many starts.
    let (mut starts, mut found, mut wrong) = (0, 0, 0);
    for start in (1..log.scans.len()).step_by(2 * every) {
        let mut tracker = Tracker::new(&localiser);
        let mut way = 0.0;
        let mut before: Option<nalgebra::Isometry2<f64>> = None;
        let mut last = None;
        for scan in log.scans[start..].iter().step_by(2) {
            let (Some(odometry), Some(pose)) = (scan.odometry, scan.pose) else { break };
            way +=
                before.map_or(0.0, |b| (b.translation.vector - odometry.translation.vector).norm());
            before = Some(odometry);
            tracker.scan(log.sensor(scan), &scan.ranges, odometry);
            last = Some((tracker.belief().clone(), pose));
            if way >= 500.0 {
                break;
            }
        }
        if way < 500.0 {
            continue;
        }
        starts += 1;
        if let Some((Belief::At(fit), pose)) = last {
            let far = (fit.pose.translation.vector - pose.translation.vector).norm();
            if far <= 50.0 { found += 1 } else { wrong += 1 }
        }
    }
    println!(
        "after 5 m of odometry: {starts} starts, {found} unique and right, {wrong} unique and wrong"
    );
}

//! Where the scans of real logs were taken, without a guess:
//! `cargo run --release -p orthoframe-sensing --example localisation -- halves|plan|likeliest LOG.gz [EVERY [PEERS [FIRST]]]`, or `-- made [SCANS]`.
//!
//! `halves`: odd scans against the walls of the even ones. `plan`: all scans against the plan of their building that others
//! drew (`plan`). `likeliest`: what one scan can tell at most there (`likeliest`). `made`: a building of 40 000 lines (`made`). Every EVERYth scan from the FIRST on is asked for; so many PEERS scans and starts are given to the peers too (`peers`).
//! Times are by the clock: several threads look for a scan.

#![allow(clippy::print_stdout, reason = "a program that prints a table")]

mod likeliest;
mod made;
mod peers;
mod plan;
mod ways;

use std::path::Path;
use std::time::Instant;

use nalgebra::Isometry2;
use orthoframe_sensing::{Answer, Belief, Chart, Fit, Localiser, Options, Tracker, Unknown};
use orthoframe_vectors::read::{Log, Scan, read_log, read_source};

use plan::Plan;
use ways::starts;

/// A pose is right that is no farther off, in cm and degrees.
const RIGHT: (f64, f64) = (50.0, 10.0);
/// Each scan is located so often, for the time that it takes.
const TIMES: usize = 8;
/// The room that a fit stands in.
type RoomOf = fn(&Fit) -> Option<u32>;

fn main() {
    let mut args = std::env::args().skip(1);
    let what = args.next().expect("halves, plan, likeliest or made");
    if what == "made" {
        return in_a_made_building(args.next().map_or(40, |n| n.parse().expect("a number")));
    }
    let path = args.next().expect("a log");
    let mut number = |default| args.next().map_or(default, |n| n.parse().expect("a number"));
    let (every, peers, first): (usize, usize, usize) = (number(10), number(0), number(0));
    let log = read_log(&read_source(Path::new(&path)).expect("the log can be read")).log;
    let started = clock();
    let (chart, rooms, asked) = match what.as_str() {
        "halves" => {
            let even = log.scans.iter().step_by(2).map(|scan| (log.sensor(scan), scan));
            let rooms = Plan::beside(Path::new(&path)).map(|plan| plan.rooms);
            (Chart::of_scans(even), rooms, log.scans.iter().skip(1).step_by(2).collect())
        }
        "plan" | "likeliest" => {
            let Plan { chart, rooms } = Plan::beside(Path::new(&path)).expect("a plan was drawn");
            (chart, Some(rooms), log.scans.iter().collect::<Vec<_>>())
        }
        _ => panic!("halves, plan or likeliest"),
    };
    let localiser = Localiser::new(&chart, Options::default());
    println!("{} lines, made ready in {:.0} ms", chart.lines().len(), clock() - started);
    let posed: Vec<&Scan> =
        asked.into_iter().filter(|scan| scan.pose.is_some()).skip(first).collect();
    if what == "likeliest" {
        let some: Vec<&Scan> = posed.iter().step_by(every).copied().collect();
        return likeliest::tell(&log, &localiser, rooms.as_ref().expect("a plan has"), &some);
    }

    let mut tally = Tally::default();
    for scan in posed.iter().step_by(every) {
        let truth = scan.pose.expect("it has one");
        let (answer, time) = timed(|| localiser.locate(log.sensor(scan), &scan.ranges));
        let room = rooms.as_ref().map(|rooms| rooms.at(&truth));
        let found = |fit: &Fit| rooms.as_ref().and_then(|rooms| rooms.at(&fit.pose));
        let what = || format!("line {}", scan.line);
        tally.take_in(what, &truth, &answer, room.map(|room| (room, found)), time);
    }
    tally.tell();
    let starts = starts(&posed, every);
    let mut ways = Ways::default();
    let (before, mut scans) = (clock(), 0);
    for way in &starts {
        scans += way.len();
        let mut tracker = Tracker::new(&localiser);
        for scan in way {
            let odometry = scan.odometry.expect("it has one");
            tracker.scan(log.sensor(scan), &scan.ranges, odometry);
        }
        let found = match tracker.belief() {
            Belief::At(fit) => Some(fit.pose),
            _ => None,
        };
        ways.take_in(way, found);
    }
    ways.tell("after 5 m of odometry");
    println!("  {:.1} ms a scan", (clock() - before) / scans.max(1) as f64);
    if peers > 0 {
        beside_peers(&log, &chart, &posed, &starts, peers);
    }
}

fn in_a_made_building(scans: usize) {
    let started = clock();
    let (chart, poses) = made::building(scans);
    let localiser = Localiser::new(&chart, Options::default());
    println!("{} lines, made ready in {:.0} ms", chart.lines().len(), clock() - started);
    let (sensor, mut tally) = (made::sensor(), Tally::default());
    for pose in &poses {
        let ranges = made::scan(&chart, &sensor, pose);
        let (answer, time) = timed(|| localiser.locate(&sensor, &ranges));
        let rooms: Option<(_, RoomOf)> = None;
        tally.take_in(|| format!("{pose}"), pose, &answer, rooms, time);
    }
    tally.tell();
}

fn beside_peers(log: &Log, chart: &Chart, posed: &[&Scan], starts: &[Vec<&Scan>], count: usize) {
    let field = peers::Field::of(chart);
    let mut ways = Ways::default();
    let every = (posed.len() / count).max(1);
    let started = clock();
    for scan in posed.iter().step_by(every).take(count) {
        let found = peers::icp(chart, &field, log.sensor(scan), &scan.ranges);
        ways.take_in(&[*scan], found);
    }
    ways.tell("point-to-line ICP from a lattice, of one scan");
    println!("  {:.0} ms a scan", (clock() - started) / ways.all.max(1) as f64);
    let (mut ways, mut scans) = (Ways::default(), 0);
    let started = clock();
    for way in starts.iter().step_by((starts.len() / count).max(1)).take(count) {
        scans += way.len();
        ways.take_in(way, peers::monte_carlo(&field, log, way));
    }
    ways.tell("Monte-Carlo localisation of 10 000 particles, after 5 m");
    println!("  {:.1} ms a scan", (clock() - started) / scans.max(1) as f64);
}

/// How far off a pose is, in cm and degrees.
fn error(found: &Isometry2<f64>, truth: &Isometry2<f64>) -> (f64, f64) {
    (
        (found.translation.vector - truth.translation.vector).norm(),
        found.rotation.angle_to(&truth.rotation).abs().to_degrees(),
    )
}

fn is_right((far, turn): (f64, f64)) -> bool {
    far <= RIGHT.0 && turn <= RIGHT.1
}

/// Answers of single scans.
#[derive(Default)]
struct Tally {
    unique: usize,
    right: usize,
    several: usize,
    holds: usize,
    /// The best fit is right, unique or not.
    first: usize,
    /// No place is told: nothing fits, more does than is looked through, or it is not sure.
    unknown: usize,
    nowhere: usize,
    too_many: usize,
    /// Taken in no room of the plan, and those of them that were told a place.
    outside: usize,
    astray: usize,
    /// Taken in a room, and the best fit in the same.
    inside: usize,
    same: usize,
    /// Uniquely in a room, and in the right one.
    sure: usize,
    sure_same: usize,
    errors: Vec<f64>,
    turns: Vec<f64>,
    times: Vec<f64>,
}

impl Tally {
    /// `rooms`: where it was taken, and where a fit is.
    fn take_in(
        &mut self,
        what: impl Fn() -> String,
        truth: &Isometry2<f64>,
        answer: &Answer,
        rooms: Option<(Option<u32>, impl Fn(&Fit) -> Option<u32>)>,
        time: f64,
    ) {
        self.times.push(time);
        let fits = match answer {
            Answer::Unique(fit) => std::slice::from_ref(fit),
            Answer::Ambiguous(fits) => fits,
            Answer::Unknown(why) => {
                self.nowhere += usize::from(matches!(why, Unknown::Nowhere));
                self.too_many += usize::from(matches!(why, Unknown::TooMany(_)));
                &[]
            }
        };
        let is_outside = matches!(rooms, Some((None, _)));
        if let Some((Some(room), of)) = rooms {
            let is_same = fits.first().is_some_and(|fit| of(fit) == Some(room));
            self.inside += 1;
            self.same += usize::from(is_same);
            self.sure += usize::from(fits.len() == 1);
            self.sure_same += usize::from(fits.len() == 1 && is_same);
        }
        self.outside += usize::from(is_outside);
        self.first +=
            usize::from(fits.first().is_some_and(|fit| is_right(error(&fit.pose, truth))));
        let holds = fits.iter().any(|fit| is_right(error(&fit.pose, truth)));
        match fits {
            [] => self.unknown += 1,
            [fit] => {
                self.unique += 1;
                let (far, turn) = error(&fit.pose, truth);
                self.errors.push(far);
                self.turns.push(turn);
                self.right += usize::from(holds);
                self.astray += usize::from(is_outside && !holds);
                if !holds {
                    println!(
                        "wrong at {}: {far:.0} cm {turn:.0}°, explained {:.2}, through {:.2}{}",
                        what(),
                        fit.explained,
                        fit.through,
                        if is_outside { ", taken in no room" } else { "" }
                    );
                }
            }
            _ => {
                self.several += 1;
                self.holds += usize::from(holds);
            }
        }
    }

    fn tell(&mut self) {
        println!(
            "{} scans: unique {}, of these right {}; several {}, of these with the right one {}; unknown {} (too many {}, nowhere {}); the best fit right of {}",
            self.times.len(),
            self.unique,
            self.right,
            self.several,
            self.holds,
            self.unknown,
            self.too_many,
            self.nowhere,
            self.first
        );
        if self.inside > 0 {
            println!(
                "of {} taken in a room, the best fit in the right room {}; of {} unique ones {}; of {} taken in none, told a wrong place {}",
                self.inside, self.same, self.sure, self.sure_same, self.outside, self.astray
            );
        }
        println!(
            "unique ones: median error {:.1} cm {:.2}°; times of all: median {:.1} ms, nine of ten below {:.1}, most {:.1}",
            share(&mut self.errors, 0.5),
            share(&mut self.turns, 0.5),
            share(&mut self.times, 0.5),
            share(&mut self.times, 0.9),
            share(&mut self.times, 1.0),
        );
    }
}

/// Answers at the end of ways.
#[derive(Default)]
struct Ways {
    all: usize,
    right: usize,
    wrong: usize,
    errors: Vec<f64>,
}

impl Ways {
    fn take_in(&mut self, way: &[&Scan], found: Option<Isometry2<f64>>) {
        self.all += 1;
        let truth = way.last().and_then(|scan| scan.pose).expect("it has one");
        if let Some(found) = found {
            let (far, turn) = error(&found, &truth);
            self.errors.push(far);
            if is_right((far, turn)) {
                self.right += 1;
            } else {
                self.wrong += 1;
                println!("wrong after the way from line {}: {far:.0} cm {turn:.0}°", way[0].line);
            }
        }
    }

    fn tell(&mut self, what: &str) {
        let median = share(&mut self.errors, 0.5);
        let Self { all, right, wrong, .. } = self;
        println!("{what}: of {all}, right {right}, wrong {wrong}; median error {median:.1} cm");
    }
}

/// The value below which a share of them lies.
fn share(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let at = (values.len().saturating_sub(1) as f64 * share).round() as usize;
    values.get(at).copied().unwrap_or(f64::NAN)
}

/// What comes of it, and the time that it takes by the clock, in ms: the middle one of some.
fn timed<T>(of: impl Fn() -> T) -> (T, f64) {
    let once = || {
        let started = clock();
        (of(), clock() - started)
    };
    let mut all: Vec<(T, f64)> = (0..TIMES).map(|_| once()).collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all.swap_remove(TIMES / 2)
}

/// In ms.
fn clock() -> f64 {
    static START: std::sync::LazyLock<Instant> = std::sync::LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64() * 1e3
}

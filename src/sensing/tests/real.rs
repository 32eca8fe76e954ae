//! Real scans: the odd ones of a log against walls made of its even ones. The long form is the example `logs`.

use std::path::PathBuf;

use orthoframe_sensing::{Answer, Locator, Walls};
use orthoframe_vectors::read::{read_log, read_source};

/// A log of others; none, with a word, where it is not there; where `CI` is set that is a failure.
#[expect(clippy::print_stdout, reason = "a test that was not made should say so")]
fn shared(name: &str) -> Option<PathBuf> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/lidar");
    let path = root.join(name);
    if path.exists() {
        return Some(path);
    }
    assert!(std::env::var_os("CI").is_none(), "{} is missing", path.display());
    println!("skipped: {} is not there", path.display());
    None
}

#[test]
fn scans_of_freiburg_101_are_placed() {
    let Some(path) = shared("freiburg-101-corrected.log.gz") else { return };
    let log = read_log(&read_source(&path).expect("the log can be read")).log;
    let mut walls = Walls::new();
    for scan in log.scans.iter().step_by(2) {
        walls.add(log.sensor(scan), &scan.ranges, &scan.pose.expect("poses are known"));
    }
    let locator = Locator::new(walls.faces());
    let (mut scans, mut right, mut unique, mut wrong) = (0, 0, 0, 0);
    for scan in log.scans.iter().skip(1).step_by(6) {
        let truth = scan.pose.expect("poses are known");
        let answer = locator.locate(log.sensor(scan), &scan.ranges);
        let is_right = answer.fixes().first().is_some_and(|fix| {
            let off = truth.inverse() * fix.pose;
            off.translation.vector.norm() <= 50.0
                && off.rotation.angle().abs() <= 10_f64.to_radians()
        });
        scans += 1;
        right += usize::from(is_right);
        let is_unique = matches!(answer, Answer::Unique(_));
        unique += usize::from(is_unique);
        wrong += usize::from(is_unique && !is_right);
    }
    assert!(right * 100 >= scans * 93, "{right} of {scans}");
    assert!(unique * 100 >= scans * 60, "{unique} of {scans}");
    assert_eq!(wrong, 0, "of {unique} that were called unique");
}

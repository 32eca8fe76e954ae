//! A robot that knows nothing of where it is, in a plan that others drew: without furniture, its walls off by a hand.

use orthoframe_sensing::{Belief, Localiser, Options, Tracker};
use orthoframe_vectors::read::{Scan, read_log, read_source};

use crate::files::{long, shared};

#[expect(dead_code, reason = "which room lies where is for the example alone")]
#[path = "../src/sensing/examples/localisation/plan.rs"]
mod plan;
#[path = "../src/sensing/examples/localisation/ways.rs"]
mod ways;

/// After five metres it knows the place or says that it does not: of every so many scans a way begins at one.
#[test]
fn no_way_ends_at_a_wrong_place_with_confidence() {
    let Some(path) = shared("lidar/freiburg-079-corrected.log.gz") else { return };
    let chart = plan::Plan::beside(&path).expect("its plan was drawn").chart;
    let log = read_log(&read_source(&path).expect("the log can be read")).log;
    let posed: Vec<&Scan> = log.scans.iter().filter(|scan| scan.pose.is_some()).collect();
    let localiser = Localiser::new(&chart, Options::default());
    let starts = ways::starts(&posed, if long() { 300 } else { 900 });
    let mut right = 0;
    for way in &starts {
        let mut tracker = Tracker::new(&localiser);
        for scan in way {
            let odometry = scan.odometry.expect("it has one");
            tracker.scan(log.sensor(scan), &scan.ranges, odometry);
        }
        let Belief::At(found) = tracker.belief() else { continue };
        let truth = way.last().and_then(|scan| scan.pose).expect("it has one");
        let off = truth.inv_mul(&found.pose);
        let (far, turn) = (off.translation.vector.norm(), off.rotation.angle().abs());
        assert!(far <= 50.0 && turn.to_degrees() <= 10.0, "line {}: {far} cm", way[0].line);
        right += 1;
    }
    assert!(5 * right >= starts.len(), "{right} of {}", starts.len());
}

//! What is written for other programs, read by those programs, and drives in simulators of others; `.ci/run` says how they
//! are installed.

use crate::files::long;
use crate::judged::judged;

fn looked_at_by(script: &str) {
    judged("python3", &[script.to_owned(), env!("CARGO_BIN_EXE_ortho").to_owned()]);
}

/// The judge's own number of drives with `ORTHOFRAME_LONG`, else so many.
fn drives_looked_at_by(script: &str, some: u32) {
    let mut arguments = vec![script.to_owned(), env!("CARGO_BIN_EXE_ortho").to_owned()];
    arguments.extend((!long()).then(|| some.to_string()));
    judged("python3", &arguments);
}

#[test]
fn recordings_are_read_by_foxglove() {
    looked_at_by("src/recording/judges/mission.py");
}

#[test]
fn exports_are_read_by_others() {
    looked_at_by("src/exchange/judges/exports.py");
}

#[test]
fn a_robot_behind_rosbridge_is_driven() {
    looked_at_by("examples/judges/rosbridge.py");
}

#[test]
fn drives_touch_nothing_in_mujoco() {
    drives_looked_at_by("src/robot/judges/touch.py", 6);
}

#[test]
fn wheels_that_slip_arrive_in_irsim() {
    drives_looked_at_by("src/robot/judges/noise.py", 2);
}

#[test]
fn missions_are_done_or_told_impossible_where_the_world_is_otherwise() {
    drives_looked_at_by("src/robot/judges/surprises.py", 3);
}

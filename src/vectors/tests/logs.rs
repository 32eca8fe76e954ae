//! Logs as they come: whole, cut, torn, odd.

use orthoframe_units::Source;
use orthoframe_vectors::read::{LogFault, Reading, read_log};
use orthoframe_vectors::scan::Extractor;
use proptest::prelude::*;

const CARMEN: &str = "# message formats defined: PARAM SYNC ODOM FLASER
PARAM robot_front_laser_max 20.0 nohost 0
ODOM 0 0 0 0 0 0 0.1 host 0.1
FLASER 5 1.00 1.10 nan 81.91 2.50 1.0 2.0 0.5 1.1 2.1 0.6 12.5 host 12.5
FLASER 0 1.0 2.0 0.5 1.1 2.1 0.6 13.0 host 13.0
ROBOTLASER1 0 -1.5 3.0 0.5 30.0 0.01 0 4 1 2 3 1e300 0 5.0 6.0 0.1 5.0 6.0 0.1 0 0 0 0 0 14 host 14
";

const ROWS: &str = "%time,field.angle_min,field.angle_increment,field.range_min,field.range_max,field.ranges0,field.ranges1,field.ranges2,x,y,theta
1.5,-0.5,0.5,0.1,10.0,1.0,2.0,inf,0.0,1.0,1.57
2.5,0.5,-0.5,0.1,10.0,1.0,2.0,3.0,0.0,1.0,1.57
";

fn read(text: &str) -> Reading {
    read_log(&Source::new("журнал", text))
}

fn breezy() -> String {
    let row = |time: u32| {
        let ranges: Vec<String> = (0..683).map(|k| (1000 + k).to_string()).collect();
        format!("{time} 1 2 3 {} {}", vec!["0"; 20].join(" "), ranges.join(" "))
    };
    format!("{}\n{}\n", row(100), row(200_000))
}

/// Places of the faults as line and column.
fn places(reading: &Reading) -> Vec<(usize, usize)> {
    let error = reading.error.iter();
    error
        .flat_map(|error| error.faults.iter().map(|f| error.source_text.position(f.offset())))
        .collect()
}

#[test]
fn carmen_lines_become_scans_in_centimetres() {
    let reading = read(CARMEN);
    assert!(reading.error.is_none(), "{:?}", reading.error);
    let scans = &reading.log.scans;
    assert_eq!(scans.iter().map(|s| s.line).collect::<Vec<_>>(), [4, 5, 6]);
    let sensor = reading.log.sensor(&scans[0]);
    assert_eq!(sensor.count(), 5);
    assert!((sensor.bearing(0) + std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert!((sensor.bearing(4) - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    let returned: Vec<bool> = scans[0].ranges.iter().map(|r| sensor.returned(*r)).collect();
    assert_eq!(returned, [true, true, false, false, true]);
    let pose = scans[0].pose.expect("the line tells it");
    assert!(
        (pose.translation.x - 100.0).abs() < 1e-9 && (pose.rotation.angle() - 0.5).abs() < 1e-9
    );
    assert_eq!(scans[0].time, Some(12.5));
    assert!(scans[1].ranges.is_empty());
    let reach = reading.log.sensor(&scans[2]).reach().1;
    assert!((reach - 3000.0).abs() < 1e-9, "{reach}");
}

#[test]
fn rows_under_a_heading_become_scans() {
    let reading = read(ROWS);
    assert!(reading.error.is_none(), "{:?}", reading.error);
    assert_eq!(reading.log.sensors.len(), 1, "both turn through the same field");
    assert_eq!(
        reading.log.scans[1].ranges,
        [300.0, 200.0, 100.0],
        "clockwise, told the other way round"
    );
    assert!((reading.log.sensors[0].bearing(0) + 0.5).abs() < 1e-12);
}

#[test]
fn rows_of_numbers_are_breezy() {
    let reading = read(&breezy());
    assert!(reading.error.is_none(), "{:?}", reading.error);
    let scan = &reading.log.scans[1];
    assert_eq!((scan.ranges.len(), scan.time), (683, Some(0.2)));
    assert!((scan.ranges[0] - 100.0).abs() < 1e-9);
}

#[test]
fn every_fault_has_its_place_and_the_rest_is_read() {
    let text = CARMEN.replace("2.50", "2,50").replace("FLASER 0", "FLASER x")
        + "FLASER 3 1 2\n"
        + "FLASER";
    let reading = read(&text);
    assert_eq!(places(&reading), [(4, 30), (5, 8), (7, 13), (8, 7)]);
    assert_eq!(reading.log.scans.len(), 1);
    let faults = &reading.error.expect("there are faults").faults;
    assert!(matches!(faults[0], LogFault::NotNumber { .. }));
    assert!(matches!(faults[1], LogFault::Beams { .. }));
    assert!(matches!(faults[2], LogFault::CutOff { found: 4, needed: 14, .. }));
}

#[test]
fn what_is_no_log_is_told() {
    for text in ["", "\n\n", "hello", "1 2 3", "# only a comment", "PARAM a b c 0", "a,b\n1,2"] {
        let reading = read(text);
        assert!(reading.error.is_some() && reading.log.scans.is_empty(), "{text:?}");
    }
    let heading = read("angle_min,ranges0\n0,1\n").error.expect("columns are missing");
    assert_eq!(heading.faults.len(), 3);
}

/// Reads, extracts, and asks for every place: nothing may panic.
fn survives(text: &str) {
    let reading = read(text);
    for (line, column) in places(&reading) {
        assert!(line >= 1 && column >= 1);
    }
    let mut extractor = Extractor::new();
    for scan in reading.log.scans.iter().take(50) {
        for segment in extractor.segments(reading.log.sensor(scan), &scan.ranges) {
            assert!(segment.length().is_finite());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_log_cut_anywhere_makes_no_panic(which in 0..3_usize, share in 0.0..1.0_f64) {
        let text = [CARMEN.to_owned(), ROWS.to_owned(), breezy()][which].clone();
        let mut at = (share * text.len() as f64) as usize;
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        survives(&text[..at]);
    }

    #[test]
    fn a_log_with_odd_words_makes_no_panic(
        which in 0..3_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0..12_usize), 1..6),
    ) {
        const ODD: [&str; 12] = [
            "nan", "inf", "-inf", "1e300", "-1e300", "-1", "", "18446744073709551615", "4294967296", "ж", "0", "\n",
        ];
        let text = [CARMEN.to_owned(), ROWS.to_owned(), breezy()][which].clone();
        let between = if which == 1 { ',' } else { ' ' };
        let mut words: Vec<&str> = text.split(between).collect();
        for (place, odd) in changes {
            let at = place.index(words.len());
            words[at] = ODD[odd];
        }
        survives(&words.join(&between.to_string()));
    }

    #[test]
    fn any_text_makes_no_panic(text in "\\PC{0,200}|(FLASER|ROBOTLASER1|PARAM|[0-9]|[ .,\n-]|nan|ж){0,60}") {
        survives(&text);
    }
}

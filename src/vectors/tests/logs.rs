//! Logs as they come: whole, cut, torn, odd.

use orthoframe_units::Source;
use orthoframe_vectors::Segment;
use orthoframe_vectors::read::{LogFault, Reading, read_log};
use orthoframe_vectors::scan::{Extractor, Noise, Sensor, Struck, cast};
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

/// The same two scans as [`ROWS`], as other tools and other countries write them.
#[test]
fn rows_of_other_makes_are_the_same_scans() {
    let scans = read(ROWS).log.scans;
    let semicolons = ROWS.replace('.', ";").replace("field;", "field.").replace(',', "|");
    let semicolons = semicolons.replace(';', ",").replace("field,", "field.").replace('|', ";");
    assert!(semicolons.contains("1,5;-0,5;0,5;0,1;10,0;1,0;2,0;inf"), "{semicolons}");
    let millimetres = "angle_min [deg];angle_increment (deg);range_min [mm];range_max [m];ranges[0] [mm];ranges[1] [mm];ranges[2] [mm];X;Y [cm];theta [rad];time [ms]
-28,64788975654116;28,64788975654116;100;10;1000;2000;inf;0;100;1,57;1500
28,64788975654116;-28,64788975654116;100;10;1000;2000;3000;0;100;1,57;2500
";
    let makes = [
        semicolons.clone(),
        semicolons.replace(';', "\t"),
        ROWS.replace(',', "\t"),
        ROWS.replace('\n', "\r\n"),
        ROWS.replace("theta\n", "theta,\n").replace("1.57\n", "1.57,\n"),
        ROWS.replace("%time", "#time"),
        format!("# made on a Monday, by hand\n\n{ROWS}# the end\n"),
        ROWS.replace("field.ranges", "ranges_"),
        ROWS.replace("ranges2", "ranges3")
            .replace("ranges1", "ranges2")
            .replace("ranges0", "ranges1"),
        millimetres.to_owned(),
    ];
    for text in makes {
        let reading = read(&text);
        assert!(reading.error.is_none(), "{text}\n{:?}", reading.error);
        let sensor = &reading.log.sensors[0];
        assert!((sensor.bearing(0) + 0.5).abs() < 1e-12 && (sensor.step() - 0.5).abs() < 1e-12);
        assert!((sensor.reach().0 - 10.0).abs() < 1e-9 && (sensor.reach().1 - 1000.0).abs() < 1e-9);
        for (scan, plain) in reading.log.scans.iter().zip(&scans) {
            assert!(
                scan.ranges
                    .iter()
                    .zip(&plain.ranges)
                    .all(|(a, b)| a.total_cmp(b).is_eq() || (a - b).abs() < 1e-9)
            );
            let (pose, known) = (scan.pose.expect("told"), plain.pose.expect("told"));
            assert!(
                (pose.inv_mul(&known)).to_homogeneous().relative_eq(
                    &nalgebra::Matrix3::identity(),
                    1e-9,
                    1e-9
                ),
                "{text}"
            );
            assert!(scan.time.is_some());
        }
        assert_eq!(reading.log.scans.len(), 2, "{text}");
    }
    // Messages' own time is in ns.
    let nanoseconds = ROWS.replace("1.5,-0.5", "1500000000,-0.5");
    assert_eq!(read(&nanoseconds).log.scans[0].time, Some(1.5));
}

/// A table that means something else than it says is refused where it does.
#[test]
fn a_table_that_is_torn_or_doubtful_is_told() {
    let faults = |text: &str| {
        let reading = read(text);
        let places = places(&reading);
        (places, reading.error.expect("something is wrong").faults, reading.log.scans.len())
    };
    // A decimal comma between commas: every row has more cells than names.
    let (at, found, read) = faults(&ROWS.replace("1.5,", "1,5,"));
    assert_eq!((at, read), (vec![(2, 43)], 1));
    assert!(matches!(found[..], [LogFault::TooLong { found: 12, needed: 11, .. }]));
    // Two rows in one.
    let (at, ..) = faults(&ROWS.replace("1.57\n2.5", "1.57,2.5"));
    assert_eq!(at, [(2, 48)]);
    let heading = |from: &str, to: &str| faults(&ROWS.replace(from, to)).1;
    assert!(matches!(&heading("ranges1", "ranges0")[..],
        [LogFault::Twice { .. }, LogFault::NoColumn { column, .. }] if column == "ranges1"));
    assert!(matches!(&heading("field.ranges1", "field.intensities1")[..],
        [LogFault::NoColumn { column, .. }] if column == "ranges1"));
    assert!(matches!(&heading("angle_min", "angle_min [m]")[..],
        [LogFault::Unit { found, .. }, LogFault::NoColumn { .. }] if found == "field.angle_min [m]"));
    assert!(matches!(&heading("range_max", "range_max [feet]")[..], [LogFault::Unit { .. }, ..]));
}

/// More ranges than were counted would make a place of a range.
#[test]
fn miscounted_ranges_are_no_pose() {
    for (head, line) in [
        (2, "FLASER 2 1 2 3 0.1 0.2 0.3 0.1 0.2 0.3 5 host 5"),
        (3, "RAWLASER1 0 -1.5 3 0.5 30 0.01 0 2 1 2 3.5 0 14 host 14"),
    ] {
        let reading = read(&format!("{}{line}\n", "SYNC 1\n".repeat(head - 1)));
        assert_eq!(reading.log.scans.len(), 0, "{:?}", reading.log.scans);
        assert_eq!(places(&reading)[0].0, head);
    }
}

#[test]
fn a_robots_laser_tells_its_time_and_field() {
    let ranges = vec!["2.5"; 1081].join(" ");
    let laser = format!(
        "0 -2.35619 4.71239 0.00436332 30.0 0.01 1 1081 {ranges} 1081 {}",
        vec!["900"; 1081].join(" ")
    );
    let whole = format!(
        "ROBOTLASER1 {laser} 5 6 0.1 5.2 6 0.1 0.3 0 0 0 0 14.5 host 14\nRAWLASER1 {laser} 15.5 host 15\n"
    );
    let reading = read(&whole);
    assert!(reading.error.is_none(), "{:?}", reading.error);
    let times: Vec<Option<f64>> = reading.log.scans.iter().map(|s| s.time).collect();
    assert_eq!(times, [Some(14.5), Some(15.5)]);
    assert_eq!((reading.log.sensors.len(), reading.log.sensors[0].count()), (1, 1081));
    assert!((reading.log.sensors[0].bearing(1080) - 2.35619).abs() < 1e-3);
}

/// Sensors that turn a little faster or slower each time are as many sensors; a long log of them is read at once.
#[test]
fn a_sensor_of_its_own_for_every_row_takes_no_time() {
    let rows: String = (0..100_000).map(|k| format!("0.{k:07},0.01,0.1,9,1,1\n")).collect();
    let reading =
        read(&format!("angle_min,angle_increment,range_min,range_max,ranges0,ranges1\n{rows}"));
    assert_eq!((reading.log.sensors.len(), reading.log.scans.len()), (100_000, 100_000));
}

/// A sensor worse than is assumed shows itself by its log: a room stays its four walls.
#[test]
fn the_noise_of_a_sensor_is_seen_from_its_log() {
    let corners = [(-3.0, -2.0), (3.5, -2.0), (3.5, 2.5), (-3.0, 2.5)];
    let corner = |k: usize| nalgebra::Vector2::new(corners[k % 4].0, corners[k % 4].1);
    let walls: Vec<Segment<2>> =
        (0..4).map(|k| Segment::given(corner(k), corner(k + 1), 0.0)).collect();
    let step = 0.5_f64.to_radians();
    let sensor =
        Sensor::new(-359.0 * step, step, 719, (0.01, 50.0), Noise::default()).expect("a sensor");
    let struck = cast(&sensor, &nalgebra::Isometry2::identity(), &walls, 0.0);
    let mut rng = fastrand::Rng::with_seed(3);
    for sigma in [0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08] {
        let scan = |rng: &mut fastrand::Rng| {
            let range = |s: &Option<Struck>| {
                let normal: f64 = (0..12).map(|_| rng.f64()).sum::<f64>() - 6.0;
                format!("{:.2}", s.expect("a wall").range + sigma * normal)
            };
            let ranges: Vec<String> = struck.iter().map(range).collect();
            format!("FLASER 719 {} 0 0 0 0 0 0 1 host 1\n", ranges.join(" "))
        };
        let scans: String = (0..10).map(|_| scan(&mut rng)).collect();
        let reading = read(&format!("PARAM laser_front_laser_resolution 0.5 host 0\n{scans}"));
        let told = reading.log.sensors[0].noise().range;
        let most = (100.0 * sigma).max(1.0);
        assert!((0.85 * most..1.55 * most).contains(&told), "{sigma} m told as {told} cm");
        let mut extractor = Extractor::new();
        let found: usize = reading
            .log
            .scans
            .iter()
            .map(|s| extractor.segments(reading.log.sensor(s), &s.ranges).len())
            .sum();
        assert!((40..=52).contains(&found), "{found} segments of ten scans at {sigma} m");
    }
    // No noise is so great: what has no faces keeps what was assumed.
    let ranges: Vec<String> = (0..361).map(|_| format!("{:.2}", 1.0 + 20.0 * rng.f64())).collect();
    let reading = read(&format!("FLASER 361 {} 0 0 0 0 0 0 1 host 1\n", ranges.join(" ")));
    assert_eq!(reading.log.sensors[0].noise(), Noise::default());
}

#[test]
fn a_stray_byte_is_told_at_its_place() {
    let mut bytes = CARMEN.as_bytes().to_vec();
    let at = CARMEN.find("2.50").expect("it is there");
    bytes[at] = 0xe9;
    let reading = read_log(&orthoframe_vectors::read::unpacked("журнал", bytes).expect("text"));
    assert_eq!(places(&reading), [(4, 30)]);
    assert_eq!(reading.log.scans.len(), 2);
    let marked = [b"\xef\xbb\xbf", ROWS.as_bytes()].concat();
    let reading = read_log(&orthoframe_vectors::read::unpacked("журнал", marked).expect("text"));
    assert_eq!((reading.error.is_none(), reading.log.scans.len()), (true, 2));
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

    /// A scan of which something is missing is told, with the line in which it is.
    #[test]
    fn a_line_cut_anywhere_is_told(which in 0..4_usize, share in 0.0..1.0_f64, is_front in any::<bool>()) {
        let line = |at: usize| CARMEN.lines().nth(at).expect("a line").to_owned();
        let row = breezy().lines().next().expect("a line").to_owned();
        let line = [line(3), line(5), row.clone(), row][which].clone();
        // A piece of the last word, of a host's name and of a row's first number look like a whole.
        let most = line.rfind(" host").unwrap_or(line.rfind(' ').expect("words"));
        let least = if line.starts_with('1') { line.find(' ').expect("words") } else { 1 };
        let at = least + (share * (most - least) as f64) as usize;
        let cut = if is_front { &line[at..] } else { &line[..at] };
        let text = if is_front { format!("{cut}\n{line}\n{line}\n") } else { format!("{line}\n{line}\n{cut}") };
        let reading = read(&text);
        prop_assert_eq!(reading.log.scans.len(), 2, "{}", cut);
        prop_assert_eq!(places(&reading).iter().map(|p| p.0).collect::<Vec<_>>(), [if is_front { 1 } else { 3 }]);
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

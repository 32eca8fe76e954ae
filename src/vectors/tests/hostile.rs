//! Bad input, kind by kind: what comes of it is a fault with its place, or nothing seen; never a panic.

use nalgebra::Vector2;
use orthoframe_units::Source;
use orthoframe_vectors::picture::Picture;
use orthoframe_vectors::read::{LogFault, Reading, read_log, unpacked};
use orthoframe_vectors::scan::{Extractor, Noise, Sensor};
use orthoframe_vectors::{
    Course, Equality, Index, Model, Odometry, Options, PoseNoise, Scene, Segment, difference,
    polyline, survey,
};
use proptest::prelude::*;

fn read(text: &str) -> Reading {
    read_log(&Source::new("журнал", text))
}

fn line(ranges: &[&str], pose: &str) -> String {
    format!("FLASER {} {} {pose} {pose} 1 host 1\n", ranges.len(), ranges.join(" "))
}

fn segments(reading: &Reading) -> Vec<Segment<2>> {
    let mut extractor = Extractor::new();
    let scans = reading.log.scans.iter();
    scans.flat_map(|s| extractor.segments(reading.log.sensor(s), &s.ranges).to_vec()).collect()
}

#[test]
fn what_is_no_range_is_no_return() {
    for odd in ["nan", "NaN", "inf", "-inf", "1e300", "-1e300", "1e-300", "0", "-1", "81.91"] {
        let reading = read(&line(&[odd; 180], "0 0 0"));
        assert!(reading.error.is_none(), "{odd}: {:?}", reading.error);
        assert!(segments(&reading).is_empty(), "{odd}");
    }
}

/// A line that tells no angles has half a turn where its beams then are whole quarters of a degree apart; else nothing is guessed.
#[test]
fn a_field_that_is_not_told_is_not_guessed() {
    for count in [1, 3, 5, 60, 90, 91, 180, 181, 360, 361, 720, 721] {
        let reading = read(&line(&vec!["2.0"; count], "0 0 0"));
        assert!(reading.error.is_none(), "{count}: {:?}", reading.error);
    }
    for count in [100, 401, 512, 541, 682, 769, 1081] {
        let one = line(&vec!["2.0"; count], "0 0 0");
        let faults = read(&one).error.expect("its field is not told").faults;
        assert!(matches!(faults[..], [LogFault::Field { count: told, .. }] if told == count));
        let told = read(&format!("PARAM laser_front_laser_resolution 0.25 h 0\n{one}"));
        assert!(told.error.is_none() && told.log.scans.len() == 1, "{:?}", told.error);
    }
}

#[test]
fn all_beams_at_the_maximum_see_nothing() {
    let text =
        format!("PARAM robot_front_laser_max 20.0 host 0\n{}", line(&["20.0"; 181], "0 0 0"));
    let reading = read(&text);
    assert!(reading.error.is_none() && segments(&reading).is_empty());
    let sensor = Sensor::new(-1.5, 0.01, 300, (1.0, 2000.0), Noise::default()).expect("a sensor");
    assert!(Extractor::new().segments(&sensor, &[2000.0; 300]).is_empty());
}

#[test]
fn a_scan_without_beams_has_no_segments() {
    let reading = read(&line(&[], "0 0 0"));
    assert_eq!((reading.log.scans.len(), segments(&reading).len()), (1, 0));
    let sensor = Sensor::new(0.0, 0.1, 0, (1.0, 2000.0), Noise::default()).expect("a sensor");
    assert!(Extractor::new().segments(&sensor, &[100.0; 9]).is_empty());
    let found = survey(&reading.log, PoseNoise::default(), &Equality::at(0.99));
    assert!(found.scene.things().is_empty());
}

/// All beams at one range make points that may lie in one place: a sensor against its own housing.
#[test]
fn points_told_twice_tear_nothing() {
    let p = |x: f64, y: f64| Vector2::new(x, y);
    let twice = [p(0.0, 0.0), p(0.0, 0.0), p(100.0, 0.0), p(100.0, 0.0), p(100.0, 50.0)];
    let once = [p(0.0, 0.0), p(100.0, 0.0), p(100.0, 50.0)];
    let open = Course::Open([orthoframe_vectors::End::True(orthoframe_vectors::Truth::Free); 2]);
    assert_eq!(polyline(&twice, open, 1.0), polyline(&once, open, 1.0));
    for course in [open, Course::Closed] {
        for count in 0..5 {
            let made = polyline(&vec![p(7.0, 7.0); count], course, 1.0);
            assert!(made.iter().all(|s| s.length() < 1e-9) && made.len() <= 1);
        }
    }
    // A step of nothing between beams would be one beam told many times: no sensor.
    assert!(Sensor::new(0.0, 0.0, 9, (1.0, 100.0), Noise::default()).is_err());
}

#[test]
fn a_line_cut_in_the_middle_is_told_with_line_and_column() {
    let whole = line(&["1.0"; 180], "0 0 0");
    let cut = &whole[..whole.len() / 2];
    let reading = read(&format!("{whole}{cut}\n{whole}"));
    let error = reading.error.expect("a line is cut");
    assert_eq!(reading.log.scans.len(), 2);
    let (at, column) = error.source_text.position(error.faults[0].offset());
    assert_eq!((at, column), (2, cut.trim_end().len() + 1));
    assert!(error.to_string().contains("журнал:2:"), "{error}");
}

#[test]
fn a_pose_that_is_no_place_is_told() {
    for (word, pose) in [("1e300", "1e300 0 0"), ("nan", "0 nan 0"), ("inf", "0 0 inf")] {
        let error = read(&line(&["1.0"; 8], pose)).error.expect("no place");
        assert!(error.to_string().contains(word), "{error}");
    }
}

#[test]
fn packed_logs_that_break_off_are_refused() {
    assert!(unpacked("ж", vec![0x1f, 0x8b, 8, 0, 0, 0]).is_err());
    assert!(unpacked("ж", vec![0xff, 0xfe, 0x00]).is_err());
    let broken = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', 0, 0, 0, 13];
    assert!(Picture::is_png(&broken) && Picture::from_png(&broken).is_err());
    assert!(Picture::from_png(b"").is_err());
}

/// A room of four walls, seen from three places, is one thing of four segments, each seen three times.
#[test]
fn a_room_seen_from_three_places_is_one_thing() {
    let corners = [(-300.0, -200.0), (300.0, -200.0), (300.0, 250.0), (-300.0, 250.0)];
    let corner = |k: usize| Vector2::new(corners[k % 4].0, corners[k % 4].1);
    let walls: Vec<Segment<2>> =
        (0..4).map(|k| Segment::given(corner(k), corner(k + 1), 0.0)).collect();
    let sensor = Sensor::new(
        -std::f64::consts::PI,
        std::f64::consts::TAU / 360.0,
        360,
        (1.0, 5000.0),
        Noise::default(),
    );
    let sensor = sensor.expect("a sensor");
    let mut text = String::from("PARAM laser_front_laser_resolution 1.0 host 0\n");
    for pose in [(0.0, 0.0, 0.0), (1.0, 0.3, 1.1), (-1.2, 0.5, -2.0)] {
        let at = nalgebra::Isometry2::new(Vector2::new(pose.0 * 100.0, pose.1 * 100.0), pose.2);
        // 360 beams, 1° apart, of a log's front laser begin at -179.5°.
        let beams = Sensor::new(
            -179.5_f64.to_radians(),
            1.0_f64.to_radians(),
            360,
            (1.0, 5000.0),
            Noise::default(),
        );
        let struck = orthoframe_vectors::scan::cast(&beams.expect("a sensor"), &at, &walls, 0.0);
        let ranges: Vec<String> =
            struck.iter().map(|s| format!("{:.4}", s.map_or(99.0, |s| s.range / 100.0))).collect();
        let words: Vec<&str> = ranges.iter().map(String::as_str).collect();
        text += &line(&words, &format!("{} {} {}", pose.0, pose.1, pose.2));
    }
    let reading = read(&text);
    assert!(reading.error.is_none(), "{:?}", reading.error);
    assert_eq!(reading.log.sensor(&reading.log.scans[0]).count(), sensor.count());
    let found = survey(&reading.log, PoseNoise::default(), &Equality::at(0.999));
    assert_eq!((found.views, found.without_pose), (3, 0));
    assert_eq!(found.scene.things().len(), 1, "{}", found.scene.tree());
    let room = found.scene.seen(0);
    assert_eq!(room.len(), 4, "{}", found.scene.tree());
    for (k, s) in room.segments().iter().enumerate() {
        assert!(s.is_whole());
        let near = |w: &Segment<2>| (w.start - s.start).norm() + (w.end - s.end).norm();
        assert!(walls.iter().map(near).fold(f64::MAX, f64::min) < 3.0, "{s:?}");
        let counts = room.membership(k);
        assert_eq!((counts.seen, counts.expected), (3, 3));
    }
}

/// Ends known to half a metre and worse reach through cells without number: it takes no longer to look at all there is.
#[test]
fn what_is_hardly_known_is_compared_as_fast() {
    let ring = |sigma: f64, size: f64| {
        let corner = |k: usize| {
            let angle = k as f64 / 20.0 * std::f64::consts::TAU;
            Vector2::new(angle.cos(), angle.sin()) * (size * (1.0 + 0.3 * (k % 3) as f64))
        };
        // Every other side, so that links go over gaps.
        let sides = (0..20).step_by(2).map(|k| Segment::given(corner(k), corner(k + 1), sigma));
        Model::of_contour(sides.collect())
    };
    let before = std::time::Instant::now();
    for (sigma, size) in [(50.0, 3e3), (1e3, 1e6), (1e5, 1e9)] {
        let (a, b) = (ring(sigma, size), ring(sigma, 1.1 * size));
        let found = difference(&a, &b, None, &Equality::at(0.999));
        assert_eq!(found.pairs.len() + found.vanished.len(), a.len());
        let index = Index::of(std::slice::from_ref(&a), Options::default());
        let looked = index.identify(std::slice::from_ref(&a), &b).counters.lookups;
        assert!(looked <= 100 * index.links() as u64, "{looked} of {}", index.links());
    }
    assert!(before.elapsed().as_secs() < 20, "{:?}", before.elapsed());
}

/// A picture of grey, colour or clear pixels, packed as a PNG.
fn packed(colour: png::ColorType, pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let rows = pixels.len() / (16 * colour.samples());
    let mut encoder = png::Encoder::new(&mut bytes, 16, rows as u32);
    encoder.set_color(colour);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(pixels).expect("all rows");
    writer.finish().expect("an end");
    bytes
}

fn odd_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        5 => -500.0..500.0_f64,
        1 => prop::sample::select(vec![
            f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, 1e300, -1e300, 1e-300, 1e9, -1e9, 1e7,
        ]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any points make finite segments, and any such segments can be joined, compared and mapped.
    #[test]
    fn any_points_make_models_that_can_be_compared(
        first in prop::collection::vec((odd_number(), odd_number()), 0..16),
        second in prop::collection::vec((odd_number(), odd_number()), 0..16),
        sigma in prop::sample::select(vec![0.0, 1e-9, 1.0, 50.0, f64::NAN, f64::INFINITY]),
    ) {
        let made = |points: &[(f64, f64)]| -> Model<2> {
            let points: Vec<Vector2<f64>> = points.iter().map(|p| Vector2::new(p.0, p.1)).collect();
            Model::of_contour(polyline(&points, Course::Closed, sigma))
        };
        let (a, b) = (made(&first), made(&second));
        for s in a.segments().iter().chain(b.segments()) {
            prop_assert!(s.length().is_finite(), "{s:?}");
        }
        let equality = Equality::at(0.99);
        let found = difference(&a, &b, None, &equality);
        prop_assert_eq!(found.pairs.len() + found.vanished.len(), a.len());
        prop_assert_eq!(found.pairs.len() + found.appeared.len(), b.len());
        let mut scene = Scene::new(equality);
        scene.add(&a);
        scene.observe(&b, Odometry::Unknown);
        let joined = a.united(&b, &equality);
        prop_assert!(joined.len() <= a.len() + b.len());
    }

    /// A PNG with bytes changed or cut off is a picture or a fault; what is drawn in it has finite contours.
    #[test]
    fn any_picture_is_read_or_refused(
        colour in prop::sample::select(vec![
            png::ColorType::Grayscale, png::ColorType::GrayscaleAlpha, png::ColorType::Rgb, png::ColorType::Rgba,
        ]),
        pixels in prop::collection::vec(prop_oneof![Just(0_u8), Just(255), any::<u8>()], 16 * 16 * 4),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4),
        left in 0.0..1.5_f64,
    ) {
        let whole = packed(colour, &pixels[..256 * colour.samples()]);
        prop_assert_eq!(Picture::from_png(&whole).expect("a picture").size(), (16, 16));
        let mut bytes = whole;
        for (place, value) in changes {
            let at = place.index(bytes.len());
            bytes[at] = value;
        }
        bytes.truncate((left.min(1.0) * bytes.len() as f64) as usize);
        if let Ok(picture) = Picture::from_png(&bytes) {
            let segments = picture.contours(picture.level()).concat();
            prop_assert!(segments.iter().all(|s| s.length().is_finite()));
        }
    }

    /// Any poses and ranges of a log make a survey that ends.
    #[test]
    fn any_log_is_surveyed(
        scans in prop::collection::vec(
            (prop::collection::vec(0.0..30.0_f64, 0..30), (-1e6..1e6_f64, -20.0..20.0_f64, -1e6..1e6_f64)),
            0..6,
        ),
    ) {
        let text: String = scans
            .iter()
            .map(|(ranges, pose)| {
                let words: Vec<String> = ranges.iter().map(ToString::to_string).collect();
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                line(&words, &format!("{} {} {}", pose.0, pose.1, pose.2))
            })
            .collect();
        let found = survey(&read(&text).log, PoseNoise::default(), &Equality::at(0.99));
        prop_assert!(found.views <= scans.len());
    }
}

//! Segments of scans: how long they take and how well they explain what was measured; contours of a pair of pictures.
//!
//! The logs are those of `../shared/data/lidar`; without them the scans are those of generated rooms. `VECTORS_OUT=DIR`
//! writes the scans and pictures for the judges of `vectors/judges`.

use std::{fmt::Write as _, hint::black_box, path::Path};

use fastrand::Rng;
use nalgebra::{Isometry2, Vector2};
use orthoframe_vectors::{
    Model, Segment,
    picture::Picture,
    read::{read_log, read_source},
    scan::{Extractor, Noise, Sensor, cast},
};

use super::{
    least, median,
    shapes::{Kind, normal, thing},
};

const LOGS: [&str; 3] =
    ["intel-corrected.log.gz", "freiburg-101-corrected.log.gz", "freiburg-079-corrected.log.gz"];
/// Scans of each log: the protocol of Schaefer et al. 2019 takes 20.
const SCANS: usize = 20;

/// Scans of one sensor.
struct Scans {
    name: String,
    sensor: Sensor,
    ranges: Vec<Vec<f64>>,
}

pub(crate) fn run() {
    println!("\n| scans | beams | µs | segments | vertices | RMSE, m | share of rays |");
    println!("|---|---|---|---|---|---|---|");
    for scans in logs().into_iter().chain([rooms(180), rooms(360)]) {
        row(&scans);
    }
    pictures();
}

fn row(scans: &Scans) {
    let mut extractor = Extractor::new();
    let (mut micros, mut sum) = (Vec::new(), Quality::default());
    for ranges in &scans.ranges {
        let time = median(201, || {
            black_box(extractor.segments(&scans.sensor, black_box(ranges)));
        });
        micros.push(time.as_secs_f64() * 1e6);
        sum.add(&scans.sensor, ranges, extractor.segments(&scans.sensor, ranges));
    }
    micros.sort_by(f64::total_cmp);
    let count = scans.ranges.len().max(1) as f64;
    println!(
        "| {} | {} | {:.2} | {:.1} | {:.1} | {:.4} | {:.3} |",
        scans.name,
        scans.sensor.count(),
        micros[micros.len() / 2],
        sum.segments / count,
        sum.vertices / count,
        (sum.squares / sum.explained.max(1.0)).sqrt() / 100.0,
        sum.explained / sum.returned.max(1.0),
    );
}

/// What segments explain of the rays of scans.
#[derive(Default)]
struct Quality {
    segments: f64,
    vertices: f64,
    returned: f64,
    explained: f64,
    squares: f64,
}

impl Quality {
    /// A ray is explained where it strikes a segment; its residual is the difference in range.
    fn add(&mut self, sensor: &Sensor, ranges: &[f64], segments: &[Segment<2>]) {
        self.segments += segments.len() as f64;
        let shared = segments.windows(2).filter(|w| (w[0].end - w[1].start).norm() < 1e-6).count();
        self.vertices += (2 * segments.len() - shared) as f64;
        let struck = cast(sensor, &Isometry2::identity(), segments, 0.0);
        for (range, struck) in ranges.iter().zip(struck) {
            if !sensor.returned(*range) {
                continue;
            }
            self.returned += 1.0;
            if let Some(struck) = struck {
                self.explained += 1.0;
                self.squares += (struck.range - range).powi(2);
            }
        }
    }
}

fn logs() -> Vec<Scans> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/lidar");
    let mut found = Vec::new();
    for name in LOGS {
        let Ok(source) = read_source(&folder.join(name)) else {
            println!("{name} is not there");
            continue;
        };
        let log = read_log(&source).log;
        let step = (log.scans.len() / SCANS).max(1);
        let chosen: Vec<_> = log.scans.iter().step_by(step).take(SCANS).collect();
        let Some(first) = chosen.first() else { continue };
        let sensor = log.sensor(first).clone();
        let ranges: Vec<Vec<f64>> = chosen.iter().map(|s| s.ranges.clone()).collect();
        write_scans(name, &sensor, &ranges);
        found.push(Scans { name: name.replace("-corrected.log.gz", ""), sensor, ranges });
    }
    found
}

/// Scans for judges: first bearing, step, ranges in m.
fn write_scans(name: &str, sensor: &Sensor, ranges: &[Vec<f64>]) {
    let Some(folder) = std::env::var_os("VECTORS_OUT") else { return };
    let mut text = String::new();
    for scan in ranges {
        let _ = write!(text, "{} {}", sensor.bearing(0), sensor.step());
        for range in scan {
            let metres = if sensor.returned(*range) { range / 100.0 } else { 99.0 };
            let _ = write!(text, " {metres:.4}");
        }
        text.push('\n');
    }
    let path = Path::new(&folder).join(format!("{name}.txt"));
    std::fs::write(path, text).expect("VECTORS_OUT is a folder");
}

/// Generated rooms with things before the walls, σ = 1 cm.
fn rooms(beams: usize) -> Scans {
    let step = std::f64::consts::PI / beams as f64;
    let sensor =
        Sensor::new(-0.5 * std::f64::consts::PI, step, beams, (1.0, 5000.0), Noise::default())
            .expect("a sensor");
    let mut rng = Rng::with_seed(beams as u64);
    let ranges = (0..SCANS)
        .map(|k| {
            let mut walls = thing(Kind::Rectangular, k as u64, 24);
            for s in &mut walls {
                (s.start, s.end) = (s.start * 1.5, s.end * 1.5);
            }
            let inside = Isometry2::translation(450.0 + 20.0 * k as f64, 0.0);
            let struck = cast(&sensor, &inside, &walls, 0.0);
            struck
                .into_iter()
                .map(|s| s.map_or(f64::INFINITY, |s| s.range + normal(&mut rng)))
                .collect()
        })
        .collect();
    Scans { name: "generated rooms".to_owned(), sensor, ranges }
}

/// Two frames of 640 × 480 with things of straight edges, as a stereo pair has them.
fn pictures() {
    let frames = [frame(0.0), frame(14.0)];
    if let Some(folder) = std::env::var_os("VECTORS_OUT") {
        for (k, frame) in frames.iter().enumerate() {
            let bytes: Vec<u8> = "P5 640 480 255\n".bytes().chain(frame.iter().copied()).collect();
            let path = Path::new(&folder).join(format!("frame{k}.pgm"));
            std::fs::write(path, bytes).expect("VECTORS_OUT is a folder");
        }
    }
    let mut models = Vec::new();
    let time = least(101, || {
        models.clear();
        for frame in &frames {
            let picture = Picture::new(640, 480, frame.clone()).expect("a picture");
            let contours = picture.contours(picture.level());
            models.extend(contours.into_iter().map(Model::of_contour));
        }
        black_box(&models);
    });
    let segments: usize = models.iter().map(Model::len).sum();
    println!(
        "\nA pair of pictures, 2 × 640 × 480, to {} models of {segments} segments: {:.2} ms at least.",
        models.len(),
        time.as_secs_f64() * 1e3
    );
}

/// Polygons of several brightnesses, blurred by a pixel, with noise.
fn frame(shift: f64) -> Vec<u8> {
    let mut rng = Rng::with_seed(7);
    let things: Vec<(Vec<Segment<2>>, f64)> = (0..14)
        .map(|k| {
            let kind = if k % 2 == 0 { Kind::Rectangular } else { Kind::Generic };
            let (x, y) = (60.0 + 130.0 * f64::from(k % 5), 70.0 + 150.0 * f64::from(k / 5));
            let mut shape = thing(kind, k as u64, 8);
            let middle = shape.iter().map(|s| s.start).sum::<Vector2<f64>>() / shape.len() as f64;
            let extent = shape.iter().map(|s| (s.start - middle).norm()).fold(1.0, f64::max);
            let place =
                |p: Vector2<f64>| (p - middle) * (55.0 / extent) + Vector2::new(x + shift, y);
            for s in &mut shape {
                (s.start, s.end) = (place(s.start), place(s.end));
            }
            (shape, 120.0 + 10.0 * f64::from(k % 8))
        })
        .collect();
    let inside = |shape: &[Segment<2>], x: f64, y: f64| {
        shape
            .iter()
            .filter(|s| (s.start.y > y) != (s.end.y > y))
            .filter(|s| {
                x < s.start.x + (y - s.start.y) / (s.end.y - s.start.y) * (s.end.x - s.start.x)
            })
            .count()
            % 2
            == 1
    };
    let value = |x: f64, y: f64| {
        things.iter().find(|(shape, _)| inside(shape, x, y)).map_or(40.0, |(_, light)| *light)
    };
    let mut pixels = Vec::with_capacity(640 * 480);
    for row in 0..480 {
        for column in 0..640 {
            let (x, y) = (f64::from(column), f64::from(row));
            // Four samples a pixel: edges lie between pixels.
            let samples = [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)];
            let mean = samples.iter().map(|(dx, dy)| value(x + dx, y + dy)).sum::<f64>() / 4.0;
            pixels.push((mean + 3.0 * normal(&mut rng)).clamp(0.0, 255.0) as u8);
        }
    }
    pixels
}

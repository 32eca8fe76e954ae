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

/// Vertices that a refined fit may have: those of the published protocol.
const VERTICES: usize = 50;

pub(crate) fn run() {
    println!("\n| scans | beams | µs | segments | vertices | RMSE, m | share of rays |");
    println!("|---|---|---|---|---|---|---|");
    let all: Vec<Scans> = logs().into_iter().chain([rooms(180), rooms(360)]).collect();
    for scans in &all {
        row(
            (scans, "", 201),
            |extractor, sensor, ranges| {
                black_box(extractor.segments(sensor, ranges));
            },
            |extractor, sensor, ranges| {
                let lines = extractor.segments(sensor, ranges).to_vec();
                lines.into_iter().chain(extractor.thin(sensor, ranges)).collect()
            },
        );
    }
    for scans in &all {
        row(
            (scans, ", refined", 51),
            |extractor, sensor, ranges| {
                black_box(extractor.refined(sensor, ranges, VERTICES));
            },
            |extractor, sensor, ranges| {
                let lines = extractor.refined(sensor, ranges, VERTICES);
                lines.into_iter().chain(extractor.thin(sensor, ranges)).collect()
            },
        );
    }
    pictures();
}

/// A row of the table: `work` is what is timed, `told` what it finds.
fn row(
    (scans, how, runs): (&Scans, &str, usize),
    work: impl Fn(&mut Extractor, &Sensor, &[f64]),
    told: impl Fn(&mut Extractor, &Sensor, &[f64]) -> Vec<Segment<2>>,
) {
    let mut extractor = Extractor::new();
    let (mut micros, mut mean) = (Vec::new(), Quality::default());
    for ranges in &scans.ranges {
        let time = median(runs, || {
            work(&mut extractor, &scans.sensor, black_box(ranges));
        });
        micros.push(time.as_secs_f64() * 1e6);
        let segments = told(&mut extractor, &scans.sensor, ranges);
        mean.add(&Quality::of(&scans.sensor, ranges, &segments), scans.ranges.len());
    }
    micros.sort_by(f64::total_cmp);
    println!(
        "| {}{how} | {} | {:.1} (most {:.1}) | {:.1} | {:.1} | {:.4} | {:.3} |",
        scans.name,
        scans.sensor.count(),
        micros[micros.len() / 2],
        micros[micros.len() - 1],
        mean.segments,
        mean.vertices,
        mean.rmse,
        mean.share,
    );
}

/// What segments explain of the rays of a scan, as Schaefer et al. 2018 measure it (`evalexp.m` and `xpm.m` of their
/// repository): the root of the mean squared difference in range over the rays that strike a segment, within
/// 1 mrad beside its ends too, and the share of these among all that returned; both then averaged over scans.
#[derive(Default)]
struct Quality {
    segments: f64,
    vertices: f64,
    rmse: f64,
    share: f64,
}

impl Quality {
    const BESIDE: f64 = 1e-3;

    fn of(sensor: &Sensor, ranges: &[f64], segments: &[Segment<2>]) -> Self {
        let shared = segments.windows(2).filter(|w| (w[0].end - w[1].start).norm() < 1e-6).count();
        let points = segments.iter().filter(|s| s.length() < 1e-9).count();
        let struck = cast(sensor, &Isometry2::identity(), segments, Self::BESIDE);
        let (mut returned, mut explained, mut squares) = (0.0, 0.0, 0.0);
        for (range, struck) in ranges.iter().zip(struck).filter(|(r, _)| sensor.returned(**r)) {
            returned += 1.0;
            if let Some(struck) = struck {
                explained += 1.0;
                squares += (0.01 * (struck.range - range)).powi(2);
            }
        }
        Self {
            segments: segments.len() as f64,
            vertices: (2 * segments.len() - shared - points) as f64,
            rmse: (squares / f64::max(explained, 1.0)).sqrt(),
            share: explained / f64::max(returned, 1.0),
        }
    }

    /// Takes its part in a mean over so many scans.
    fn add(&mut self, other: &Self, scans: usize) {
        let part = 1.0 / scans as f64;
        self.segments += part * other.segments;
        self.vertices += part * other.vertices;
        self.rmse += part * other.rmse;
        self.share += part * other.share;
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
    let ranges = (0_usize..)
        .map(|k| {
            let mut walls = thing(Kind::Rectangular, k as u64, 24);
            for s in &mut walls {
                (s.start, s.end) = (s.start * 1.5, s.end * 1.5);
            }
            let inside = Isometry2::translation(450.0 + 20.0 * (k % 20) as f64, 0.0);
            let struck = cast(&sensor, &inside, &walls, 0.0);
            struck
                .into_iter()
                .map(|s| s.map_or(f64::INFINITY, |s| s.range + normal(&mut rng)))
                .collect()
        })
        // From within a thing nothing is seen.
        .filter(|ranges: &Vec<f64>| ranges.iter().any(|range| range.is_finite()))
        .take(SCANS)
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

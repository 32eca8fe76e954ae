//! Plans of real buildings that others drew, and the same with furniture: what a laser sees of the furnished one and the plan
//! lacks comes out as proposals. The judge is the pictures' pixels.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use orthoframe_map::World;
use orthoframe_units::Point;

use super::Place;
use crate::files::shared;

/// Of a pixel, in cm.
const PIXEL: f64 = 5.0;
/// Lighter than this is free.
const FREE: u8 = 230;
/// What so many beams end at is seen.
const RETURNS: u32 = 12;
/// A proposal lies no farther than this from what is drawn, in cm: the plan's walls are made straight.
const NEAR: f64 = 20.0;

struct Picture {
    width: usize,
    height: usize,
    grey: Vec<u8>,
}

impl Picture {
    fn of(path: &Path) -> Self {
        let mut decoder = png::Decoder::new(BufReader::new(File::open(path).unwrap()));
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
        let mut reader = decoder.read_info().unwrap();
        let mut raw = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut raw).unwrap();
        let grey = raw.chunks_exact(info.color_type.samples()).map(|pixel| pixel[0]);
        let (width, height) = (info.width as usize, info.height as usize);
        Self { width, height, grey: grey.take(width * height).collect() }
    }

    /// The pixel at a place in cm, x to the right and y up from the lower left corner.
    fn at(&self, (x, y): (f64, f64)) -> Option<usize> {
        let (column, row) = ((x / PIXEL).floor(), (y / PIXEL).floor());
        let is_in = column >= 0.0 && row >= 0.0 && column < self.width as f64;
        let row = (self.height as f64 - 1.0 - row).max(-1.0);
        (is_in && row >= 0.0).then_some(row as usize * self.width + column as usize)
    }

    fn place(&self, pixel: usize) -> (f64, f64) {
        let (column, row) = (pixel % self.width, self.height - 1 - pixel / self.width);
        ((column as f64 + 0.5) * PIXEL, (row as f64 + 0.5) * PIXEL)
    }

    fn is_free(&self, pixel: usize) -> bool {
        self.grey[pixel] >= FREE
    }

    /// How far a beam goes, in cm, and the pixel that ends it.
    fn beam(&self, from: (f64, f64), turn: f64) -> (f64, Option<usize>) {
        for step in 1..8000 {
            let far = f64::from(step);
            let Some(pixel) = self.at((from.0 + far * turn.cos(), from.1 + far * turn.sin()))
            else {
                break;
            };
            if !self.is_free(pixel) {
                return (far, Some(pixel));
            }
        }
        (8190.0, None)
    }
}

/// Things drawn into the furnished picture: pixels that hang together and are free on the plan.
fn things(plan: &Picture, furnished: &Picture) -> Vec<Vec<usize>> {
    let count = plan.grey.len();
    let mut is_left: Vec<bool> =
        (0..count).map(|pixel| plan.is_free(pixel) && !furnished.is_free(pixel)).collect();
    let mut found = Vec::new();
    for first in 0..count {
        if !std::mem::take(&mut is_left[first]) {
            continue;
        }
        let (mut thing, mut next) = (vec![first], 0);
        while let Some(&pixel) = thing.get(next) {
            next += 1;
            for by in [1, plan.width - 1, plan.width, plan.width + 1] {
                for other in [pixel.checked_sub(by), Some(pixel + by)].into_iter().flatten() {
                    if other < count && std::mem::take(&mut is_left[other]) {
                        thing.push(other);
                    }
                }
            }
        }
        found.push(thing);
    }
    found
}

/// How far a place lies from a convex piece, in cm.
fn off(piece: &[(f64, f64)], p: (f64, f64)) -> f64 {
    let edges = piece.iter().zip(piece.iter().cycle().skip(1));
    let one = |(a, b): (&(f64, f64), &(f64, f64))| {
        let (v, w) = ((b.0 - a.0, b.1 - a.1), (p.0 - a.0, p.1 - a.1));
        let share = ((v.0 * w.0 + v.1 * w.1) / v.0.hypot(v.1).powi(2).max(1e-9)).clamp(0.0, 1.0);
        let is_left = v.0 * w.1 - v.1 * w.0 >= 0.0;
        (is_left, (w.0 - share * v.0).hypot(w.1 - share * v.1))
    };
    let sides: Vec<(bool, f64)> = edges.map(one).collect();
    if sides.iter().all(|side| side.0) {
        return 0.0;
    }
    sides.iter().map(|side| side.1).fold(f64::INFINITY, f64::min)
}

#[test]
fn what_a_plan_lacks_is_proposed() {
    for name in ["Freiburg101", "Freiburg79"] {
        let Some(path) = shared(&format!("lidar/plans/{name}_scan.png")) else { return };
        let Some(with) = shared(&format!("lidar/plans/{name}_scan_furnitures.png")) else { return };
        let (plan, furnished) = (Picture::of(&path), Picture::of(&with));
        let place = Place::empty();
        place.run(&["import", path.to_str().unwrap(), "--pixel", "5"]);
        place.json(&["export", "plan.toml"], 0);
        let world = World::load(place.path("plan.toml")).unwrap();
        let things = things(&plan, &furnished);
        let mut seen = vec![0_u32; plan.grey.len()];
        let mut random = fastrand::Rng::with_seed(1);
        let (mut text, mut scans) = (String::new(), 0);
        while scans < 300 {
            let pixel = random.usize(..furnished.grey.len());
            let (x, y) = furnished.place(pixel);
            let turns = (0..16).map(|k| f64::from(k) * TAU / 16.0);
            if !furnished.is_free(pixel)
                || turns.into_iter().any(|turn| furnished.beam((x, y), turn).0 < 35.0)
                || furnished.beam((x, y), 1.0).1.is_none()
            {
                continue;
            }
            scans += 1;
            let turn = random.f64() * TAU;
            text.push_str("FLASER 361");
            for beam in 0..361 {
                let bearing = (f64::from(beam) - 180.0).to_radians() / 2.0;
                let (range, met) = furnished.beam((x, y), turn + bearing);
                if let Some(pixel) = met.filter(|_| range < 800.0) {
                    seen[pixel] += 1;
                }
                let _ = write!(text, " {:.3}", (range + 2.0 * random.f64() - 1.0) / 100.0);
            }
            let (x, y) = (x / 100.0, y / 100.0);
            let _ = writeln!(text, " {x} {y} {turn} {x} {y} {turn} 1 host 1");
        }
        place.write("drive.log", text);
        let told = place.json(&["differences", "drive.log", "--posed", "--keep"], 0);
        let kept = place.json(&["proposals"], 0)["proposals"].clone();
        let at = |value: &serde_json::Value| [0, 1].map(|k| value[k].as_f64().unwrap().round());
        let kept: Vec<[f64; 2]> =
            kept.as_array().unwrap().iter().map(|kept| at(&kept["place"]["at"])).collect();
        let proposed: Vec<Vec<Vec<(f64, f64)>>> = told["obstacles"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|obstacle| kept.contains(&at(&obstacle["pieces"][0][0])))
            .map(|obstacle| {
                let area = world.areas.values().find(|area| obstacle["area"] == *area.name);
                let (_, frame) = world.placement(area.unwrap().id).unwrap();
                let corner = |p: &serde_json::Value| {
                    let p = frame.apply(Point::new(p[0].as_f64().unwrap(), p[1].as_f64().unwrap()));
                    (p.x, p.y)
                };
                let piece = |piece: &serde_json::Value| {
                    piece.as_array().unwrap().iter().map(corner).collect()
                };
                obstacle["pieces"].as_array().unwrap().iter().map(piece).collect()
            })
            .collect();
        let drawn: Vec<(f64, f64)> =
            things.iter().flatten().map(|pixel| plan.place(*pixel)).collect();
        let far = |obstacle: &[Vec<(f64, f64)>], p: (f64, f64)| {
            obstacle.iter().map(|piece| off(piece, p)).fold(f64::INFINITY, f64::min)
        };
        // The other ones are walls that the import made straighter than they are drawn.
        let of_things = proposed.iter().filter(|o| drawn.iter().any(|p| far(o, *p) <= NEAR));
        let of_things = of_things.count();
        let told = format!("{name}: {of_things} of {} proposals", proposed.len());
        assert!(10 * of_things >= 6 * proposed.len(), "{told}");
        let is_told = |pixel: &usize| proposed.iter().any(|o| far(o, plan.place(*pixel)) <= NEAR);
        let returns = |thing: &[usize]| thing.iter().map(|pixel| seen[*pixel]).sum::<u32>();
        let met: Vec<_> = things.iter().filter(|thing| returns(thing) >= RETURNS).collect();
        let count = met.iter().filter(|thing| thing.iter().any(is_told)).count();
        let told = format!("{name}: {count} of {} things are seen and proposed", met.len());
        assert!(met.len() >= 60 && 100 * count >= 85 * met.len(), "{told}");
    }
}

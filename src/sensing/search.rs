//! All poses from which a scan's returns lie on a chart's lines: branch and bound over a pyramid of rasters (W. Hess, D.
//! Kohler, H. Rapp, D. Andor, 2016).
//!
//! A cell of the finest raster says how near the nearest line is; one of level `k` the most that any of the `2^k × 2^k`
//! cells from it on says. So the sum over the returns, shifted by a coarse cell, is no less than that of any pose in
//! it, and whole stretches of the building are left out at once.
//!
//! Poses are looked at by strips, [`STRIP`] cells of a row at one turn, and as many above them: what one return says of them
//! stands side by side, so that they are summed together in registers. Since the cells of level `k` are `2^k` apart and the rasters finer than
//! that, each raster is kept as several, by the phase in which a return meets it.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::{Isometry2, Point2, UnitComplex, Vector2};

use super::chart::{Chart, ENDS, Line};
use super::frontier::{Next, Open, Place, Strip};
use super::levels::{
    BORDER, FINE, FULL, LEVELS, Level, Offsets, STRIP, course, drawn, is_long, kind, kinds, off,
    widened,
};
use super::threads::{apart, side_by_side};

/// Side of a cell, in cm, where the building is not so large that there would be more than [`MOST_CELLS`].
const CELL: f64 = 10.0;
const MOST_CELLS: f64 = 2e6;
/// Cells of the rasters of all kinds together.
const MOST_IN_ALL: f64 = 4e7;
/// Turns, one a degree.
const TURNS: usize = 360;
/// What is asked for at first, as shares of all returns: what cannot come to much is told by few of them.
const GUESSES: [f64; 2] = [0.78, 0.6];
/// Turns that are looked at together on the coarsest level; their middle one tells the rasters for all of them.
const SWEEP: usize = 3;
/// By so many cells returns may be off in them, the nearer ones and the farther.
const REACHES: [usize; 2] = [2, 4];
/// Those of half a strip, as bits.
const HALF: u32 = (1 << (STRIP / 2)) - 1;
/// Strips that are looked at before the search gives up.
const MOST_STRIPS: usize = 1_000_000;
/// Strips that are opened together, and that a thread takes at once.
const BATCH: usize = 2048;
const SHARE: usize = 64;
/// Strips by which it is told whether looking at several turns together pays.
const TRIED: usize = 64;
/// See [`Pyramid::worth`].
const WORTH: usize = 512;
/// More threads gain little.
const MOST_THREADS: usize = 4;
/// A long line that is seen turns from its course by what its ends err and so many degrees.
const STEADY: f64 = 1.0;

/// A return in the sensor's frame, with the course of the line that it is seen to lie on, if on any.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mark {
    pub(crate) at: Vector2<f64>,
    pub(crate) course: Option<Course>,
}

/// In degrees, its front on the left, and by how much it may be off.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Course {
    degrees: f64,
    astray: f64,
    /// How much is seen along it, in cm.
    length: f64,
}

impl Course {
    /// Of a line that is seen from its left.
    pub(crate) fn of(v: Vector2<f64>) -> Self {
        let (degrees, errs) = course(v, ENDS);
        Self { degrees, astray: errs + STEADY, length: v.norm() }
    }
}

impl Mark {
    /// The same as seen from where that place lies so.
    pub(crate) fn moved(&self, by: &Isometry2<f64>) -> Self {
        let at = (by * Point2::from(self.at)).coords;
        let turned = |course: Course| Course {
            degrees: course.degrees + by.rotation.angle().to_degrees(),
            ..course
        };
        Self { at, course: self.course.map(turned) }
    }
}

/// What poses must sum up to.
struct Asked<M> {
    least: u16,
    margin: M,
    whole: f64,
}

impl<M: Fn(f64) -> f64> Asked<M> {
    /// Where the best does so.
    fn needed(&self, best: u16) -> u16 {
        let margin = ((self.margin)(f64::from(best) / self.whole) * self.whole) as u16;
        self.least.max(best.saturating_sub(margin))
    }
}

/// The pyramid over a chart.
pub(crate) struct Pyramid {
    cell: f64,
    low: Point2<f64>,
    width: usize,
    height: usize,
    turns: Vec<UnitComplex<f64>>,
    levels: Vec<Level>,
    /// Which of the rasters this is of each course; none where it would be empty.
    kinds: Vec<Option<usize>>,
    /// By how many degrees the nearest line's course differs from each.
    off: Vec<f64>,
    /// The coarsest level once more, of each course for each of [`REACHES`].
    swept: Level,
    threads: usize,
    /// So many strips are worth a thread's beginning.
    worth: usize,
}

/// Turns that are looked at together: those of them that can come to what is needed, where the marks lie at their middle, and what
/// these are to come to.
struct Sweep {
    turns: Vec<usize>,
    marks: Offsets,
    rough: u16,
}

/// What a search went through.
pub(crate) struct Found {
    /// The best first.
    pub(crate) places: Vec<Isometry2<f64>>,
    /// There are no others: else it was ended where there were more than can be gone through.
    pub(crate) is_all: bool,
}

/// The marks as each level meets them at each turn, once they were asked for.
struct Turned<'p> {
    pyramid: &'p Pyramid,
    /// In an order that jumps about.
    marks: Vec<Mark>,
    /// In cells, and which raster is theirs.
    cells: Vec<OnceLock<Vec<(i32, i32, usize)>>>,
    known: Vec<OnceLock<Offsets>>,
}

impl<'p> Turned<'p> {
    fn of(pyramid: &'p Pyramid, marks: &[Mark]) -> Self {
        let count = marks.len();
        let stride = (count * 5 / 8..).find(|stride| gcd(*stride, count) == 1).unwrap_or(1);
        let mut marks: Vec<Mark> = (0..count).map(|k| marks[k * stride % count]).collect();
        // Those of a long line first, then those of a course: fewer lines are of these.
        marks.sort_by_key(|mark| mark.course.map_or(2, |seen| u8::from(!is_long(seen.length))));
        let cells = std::iter::repeat_with(OnceLock::new).take(TURNS).collect();
        let known = std::iter::repeat_with(OnceLock::new).take(LEVELS * TURNS).collect();
        Self { pyramid, marks, cells, known }
    }

    fn at(&self, level: usize, turn: usize) -> &Offsets {
        let Self { pyramid, marks, cells, known } = self;
        known[level * TURNS + turn].get_or_init(|| {
            let cells = cells[turn].get_or_init(|| pyramid.turned(marks, turn, 1));
            pyramid.levels[level].offsets(cells.iter().copied())
        })
    }
}

impl Pyramid {
    pub(crate) fn of(chart: &Chart) -> Self {
        let span = chart.high - chart.low;
        let margin = 50.0;
        let area = (span.x + 2.0 * margin) * (span.y + 2.0 * margin);
        let (kinds, lines_of) = kinds(chart);
        let most = (MOST_IN_ALL / lines_of.len().max(1) as f64).min(MOST_CELLS);
        let cell = CELL.max((area / most).sqrt());
        let low = chart.low - Vector2::new(margin, margin);
        let size = ((span.add_scalar(2.0 * margin)) / cell).map(|x| x as usize + 1);
        let (width, height) = (size.x, size.y);
        let whole = (width + 2 * BORDER, height + 2 * BORDER);
        let mut levels: Vec<Level> = (0..LEVELS).map(|level| Level::new(level, whole)).collect();
        let mut swept = Level::new(LEVELS - 1, whole);
        let corner = low - Vector2::repeat(BORDER as f64 * cell);
        let threads = std::thread::available_parallelism().map_or(1, usize::from).min(MOST_THREADS);
        let (on_levels, on_swept) = (&levels, &swept);
        let rasters = |lines: &[&Line]| {
            let mut most = drawn(lines.iter().copied(), corner, cell, whole);
            let level = |(number, level): (usize, &Level)| {
                if number > 0 {
                    most = widened(&most, whole.0, whole.1, 1 << (number - 1));
                }
                level.raster(&most, whole)
            };
            let mut rasters: Vec<Vec<u8>> = on_levels.iter().enumerate().map(level).collect();
            let wide = REACHES.map(|reach| widened(&most, whole.0, whole.1, 2 * reach));
            rasters.push(wide.map(|most| on_swept.raster(&most, whole)).concat());
            rasters
        };
        let made = apart(threads, &lines_of, |lines| rasters(lines));
        for rasters in made {
            for (level, raster) in levels.iter_mut().chain([&mut swept]).zip(rasters) {
                level.add(&raster);
            }
        }
        let off = off(chart);
        let turn = |turn| UnitComplex::new(degrees(turn).to_radians());
        let turns = (0..TURNS).map(turn).collect();
        Self { cell, low, width, height, turns, levels, kinds, off, swept, threads, worth: WORTH }
    }

    /// Where marks lie at some turns about one, for the coarsest level, and how many lie too far out for that.
    fn swept(&self, cells: &[(i32, i32, usize)]) -> (Offsets, usize) {
        let width = degrees(SWEEP / 2).to_radians();
        let one = |&(x, y, kind): &(i32, i32, usize)| {
            let off = f64::from(x).hypot(f64::from(y)) * width + 1.0;
            let class = REACHES.iter().position(|reach| off <= *reach as f64)?;
            let reach = REACHES[class] as i32;
            Some((x - reach, y - reach, kind * REACHES.len() + class))
        };
        let offsets = self.swept.offsets(cells.iter().filter_map(one));
        let beyond = cells.len() - offsets.len();
        (offsets, beyond)
    }

    /// Where marks lie at a turn, in cells, and which raster is theirs, without those of a course that no line has there or at one
    /// of so many turns about it.
    fn turned(&self, marks: &[Mark], turn: usize, among: usize) -> Vec<(i32, i32, usize)> {
        let (sin, cos) = degrees(turn).to_radians().sin_cos();
        let middle = degrees(turn - turn % SWEEP + SWEEP / 2);
        let one = |mark: &Mark| {
            let p = mark.at;
            let cell = |v: f64| {
                let v = v / self.cell;
                (v + 0.5_f64.copysign(v)) as i32
            };
            let is_met = |course: &Course| {
                let here = (course.degrees + degrees(turn)).rem_euclid(360.0);
                let off = self.off[(here * FINE) as usize % self.off.len()];
                off <= course.astray + degrees(among) / 2.0
            };
            if !mark.course.as_ref().is_none_or(is_met) {
                return None;
            }
            let seen =
                |course: Course| ((course.degrees + middle).rem_euclid(360.0), course.length);
            let kind = self.kinds[kind(mark.course.map(seen))]?;
            Some((cell(cos * p.x - sin * p.y), cell(sin * p.x + cos * p.y), kind))
        };
        marks.iter().filter_map(one).collect()
    }

    /// Poses that explain no less than `least` of the returns, nor less than the best by more than the `margin` for what that
    /// explains: of each place the best, no two of them nearer than `apart` cm and 20°, the best first.
    pub(crate) fn search(
        &self,
        marks: &[Mark],
        least: f64,
        margin: impl Fn(f64) -> f64,
        apart: f64,
        most: usize,
    ) -> Found {
        if marks.is_empty() {
            return Found { places: Vec::new(), is_all: true };
        }
        let whole = f64::from(FULL) * marks.len() as f64;
        let least = (least * whole).ceil() as u16;
        let asked = Asked { least, margin, whole };
        let turned = Turned::of(self, marks);
        let mut left = MOST_STRIPS;
        let mut guesses = GUESSES.iter().map(|share| (share * whole) as u16);
        let mut guess = guesses.next().unwrap_or(least).max(least);
        loop {
            let (best, found) = self.from(&turned, &asked, guess, (apart, most), &mut left);
            let needed = asked.needed(best);
            if !found.is_all || guess <= needed {
                return found;
            }
            guess = if best > 0 { needed } else { guesses.next().unwrap_or(least).max(least) };
        }
    }

    /// The same of no less than `least`, with what the best sums up to; that alone where it is so little that less is to be asked
    /// for.
    fn from(
        &self,
        turned: &Turned<'_>,
        asked: &Asked<impl Fn(f64) -> f64>,
        least: u16,
        (apart, most): (f64, usize),
        left: &mut usize,
    ) -> (u16, Found) {
        let mut open = self.coarsest(turned, least);
        let mut found = Found { places: Vec::new(), is_all: true };
        let (mut best, mut needed) = (0, least);
        loop {
            // What lies in strips that promise as much as poses come to comes to no more: once they are opened these are all.
            let (bound, mut poses) = match open.next(needed, BATCH) {
                Next::Nothing => return (best, found),
                Next::Poses(bound, poses) => (bound, poses),
                Next::Strips(strips) => {
                    if !self.opened(&mut open, turned, &strips, needed, left) {
                        found.is_all = false;
                        return (best, found);
                    }
                    continue;
                }
            };
            poses.sort_unstable();
            for place in poses {
                let pose = self.pose(place);
                if found.places.iter().any(|known| is_near(known, &pose, apart)) {
                    continue;
                }
                best = best.max(bound);
                if asked.needed(best) < least {
                    return (best, found);
                }
                needed = asked.needed(best);
                found.places.push(pose);
                if found.places.len() >= most {
                    found.is_all = false;
                    return (best, found);
                }
            }
        }
    }

    /// The coarsest strips of which at least one cell comes to `needed`.
    fn coarsest(&self, turned: &Turned<'_>, needed: u16) -> Open {
        let top = LEVELS - 1;
        let comes_to = |marks: usize| u16::from(FULL) * marks as u16;
        let sweep = |first: usize| {
            let middle = self.turned(&turned.marks, first + SWEEP / 2, SWEEP);
            if comes_to(middle.len()) < needed {
                return None;
            }
            let (marks, beyond) = self.swept(&middle);
            let turns = first..first + SWEEP;
            let turns = turns.filter(|turn| comes_to(turned.at(top, *turn).len()) >= needed);
            let rough = needed.saturating_sub(comes_to(beyond));
            Some(Sweep { turns: turns.collect(), marks, rough })
        };
        let sweeps: Vec<Sweep> = (0..TURNS).step_by(SWEEP).filter_map(sweep).collect();
        let rows = self.height.div_ceil(1 << top).div_ceil(2);
        let columns = self.width.div_ceil(1 << top);
        let next = AtomicUsize::new(0);
        let work = || {
            let mut open = Open::default();
            // Of so many strips that were looked at for several turns together so many had to be looked at for each.
            let (mut looked, mut passed) = (0, 0);
            loop {
                let job = next.fetch_add(1, Ordering::Relaxed);
                let Some(Sweep { turns, marks, rough }) = sweeps.get(job / rows) else {
                    return open;
                };
                let row = 2 * (job % rows);
                for column in (0..columns).step_by(STRIP) {
                    // While that spares more than it costs.
                    if turns.len() > 1
                        && (looked < TRIED || (looked - passed) * turns.len() > looked)
                    {
                        looked += 1;
                        if self.swept.sums(marks, column as i32, row as i32, *rough).is_none() {
                            continue;
                        }
                        passed += 1;
                    }
                    for &turn in turns {
                        let place = (turn, column, row);
                        self.open(&mut open, top, turned.at(top, turn), place, needed);
                    }
                }
            }
        };
        let mut open = Open::default();
        let strips = sweeps.len() * rows * columns.div_ceil(STRIP);
        for found in side_by_side(self.threads_for(strips), &work) {
            open.take_in(found);
        }
        open
    }

    /// Adds what lies in strips, on the levels below them; false where there is too much of it.
    fn opened(
        &self,
        open: &mut Open,
        turned: &Turned<'_>,
        strips: &[Strip],
        needed: u16,
        left: &mut usize,
    ) -> bool {
        let halves = |strip: &Strip| {
            let Strip { level, place, passed } = *strip;
            let level = usize::from(level) - 1;
            // Half of its cells make two strips of the level below, one above the other.
            (0..2).filter(move |side| (passed >> (side * STRIP / 2)) & HALF != 0).filter_map(
                move |side| {
                    let column = 2 * place.column as usize + side * STRIP;
                    let place = (usize::from(place.turn), column, 2 * place.row as usize);
                    (column < self.width.div_ceil(1 << level)).then_some((level, place))
                },
            )
        };
        let count: usize = strips.iter().map(|strip| 2 * halves(strip).count()).sum();
        let Some(rest) = left.checked_sub(count) else { return false };
        *left = rest;
        let next = AtomicUsize::new(0);
        let work = || {
            let mut open = Open::default();
            loop {
                let first = next.fetch_add(SHARE, Ordering::Relaxed);
                let share = strips.get(first..).unwrap_or_default();
                for strip in share.iter().take(SHARE) {
                    for (level, place) in halves(strip) {
                        self.open(&mut open, level, turned.at(level, place.0), place, needed);
                    }
                }
                if share.len() <= SHARE {
                    return open;
                }
            }
        };
        for found in side_by_side(self.threads_for(count), &work) {
            open.take_in(found);
        }
        true
    }

    /// Into how many threads it pays to share so many strips out.
    fn threads_for(&self, strips: usize) -> usize {
        if strips < self.worth { 1 } else { self.threads }
    }

    /// Adds a strip and the one above it, where at least one cell comes to `needed`; of the finest level those cells.
    fn open(
        &self,
        open: &mut Open,
        level: usize,
        marks: &Offsets,
        (turn, column, row): (usize, usize, usize),
        needed: u16,
    ) {
        let sums = self.levels[level].sums(marks, column as i32, row as i32, needed);
        let Some(sums) = sums else { return };
        let place = |column: usize, row: usize| Place {
            turn: turn as u16,
            column: column as u32,
            row: row as u32,
        };
        let columns = self.width.div_ceil(1 << level) - column;
        let inside = if columns < STRIP { (1 << columns) - 1 } else { u32::MAX };
        for row in row..self.height.div_ceil(1 << level).min(row + 2) {
            let upper = row % 2;
            let passed = sums.reaching(upper, needed) & inside;
            let mut bound = 0;
            let mut left = passed;
            while left != 0 {
                let cell = left.trailing_zeros() as usize;
                left &= left - 1;
                let sum = sums.at(upper, cell);
                bound = bound.max(sum);
                if level == 0 {
                    open.at(sum).poses.push(place(column + cell, row));
                }
            }
            if passed != 0 && level > 0 {
                let level = level as u8;
                open.at(bound).strips.push(Strip { level, place: place(column, row), passed });
            }
        }
    }

    fn pose(&self, Place { turn, column, row }: Place) -> Isometry2<f64> {
        let [column, row] = [column, row].map(|n| f64::from(n) + 0.5);
        let at = self.low + Vector2::new(column, row) * self.cell;
        Isometry2::from_parts(at.into(), self.turns[usize::from(turn)])
    }
}

const fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// So many turns in degrees.
fn degrees(turns: usize) -> f64 {
    turns as f64 * 360.0 / TURNS as f64
}

/// Whether two poses are of one place: so near, and turned by no more than 20°.
pub(crate) fn is_near(a: &Isometry2<f64>, b: &Isometry2<f64>, apart: f64) -> bool {
    (a.translation.vector - b.translation.vector).norm() <= apart
        && a.rotation.angle_to(&b.rotation).abs() <= 20_f64.to_radians()
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use crate::geometry::Front;

    use super::super::chart::Line;
    use super::*;

    /// Every pose of the raster, one after another, each return by itself.
    fn all(pyramid: &Pyramid, marks: &[Mark]) -> Vec<(f64, Isometry2<f64>, Place)> {
        let finest = &pyramid.levels[0];
        let mut scored = Vec::new();
        for turn in 0..TURNS {
            let turned = pyramid.turned(marks, turn, 1);
            for row in 0..pyramid.height {
                for column in 0..pyramid.width {
                    let one = |(x, y, kind): &(i32, i32, usize)| {
                        f64::from(finest.value(x + column as i32, y + row as i32, *kind))
                    };
                    let sum: f64 = turned.iter().map(one).sum();
                    let [column, row] = [column, row].map(|n| n as u32);
                    let place = Place { turn: turn as u16, column, row };
                    let share = sum / (f64::from(FULL) * marks.len() as f64);
                    scored.push((share, pyramid.pose(place), place));
                }
            }
        }
        scored
    }

    /// What is found is the best of each place, of the same the first turn and cell, in whatever order strips are opened.
    #[test]
    fn nothing_is_passed_over() {
        let (least, margin, apart) = (0.4, 0.2, 30.0);
        // Small ones, of which some returns lie outside from wherever, and one that goes over several strips.
        // The last ones have lines of two ways, so that courses share rasters.
        for (seed, wide, count, range, is_square) in [
            (0, 250.0, 12, 400.0, false),
            (1, 250.0, 12, 400.0, false),
            (2, 250.0, 12, 400.0, false),
            (3, 900.0, 30, 90.0, false),
            (4, 250.0, 12, 400.0, true),
            (5, 250.0, 12, 400.0, true),
        ] {
            let mut random = fastrand::Rng::with_seed(seed);
            let mut point = || Point2::new(random.f64() * wide, random.f64() * 200.0);
            let at = Vector2::new(wide / 2.0 - 5.0, 90.0);
            let line = |number: usize| {
                let (mut start, mut end) = (point(), point());
                if is_square {
                    end[number % 2] = start[number % 2];
                }
                // Its front is where it is looked at from.
                if (end - start).perp(&(at - start.coords)) < 0.0 {
                    std::mem::swap(&mut start, &mut end);
                }
                let front = if number.is_multiple_of(4) { Front::Both } else { Front::Left };
                Line { front, ..Line::between(start, end) }
            };
            let lines: Vec<Line> = (0..count).map(line).collect();
            let chart = Chart::new(lines);
            let mut pyramid = Pyramid::of(&chart);
            let rasters: HashSet<usize> = pyramid.kinds.iter().copied().flatten().collect();
            assert!(!is_square || rasters.len() < pyramid.kinds.iter().flatten().count());
            let pose = Isometry2::new(at, 1.0 + f64::from(seed as u32));
            let marks: Vec<Mark> = (0..28)
                .filter_map(|beam| {
                    let bearing = f64::from(beam) * 0.22;
                    let (range, line) = chart.cast(&pose, bearing, range);
                    let line = &chart.lines()[line? as usize];
                    let along = pose.rotation.inverse() * line.direction();
                    let course = (beam % 3 > 0).then(|| Course::of(along * 50.0));
                    Some(Mark { at: Vector2::new(bearing.cos(), bearing.sin()) * range, course })
                })
                .collect();
            let margin = |best: f64| f64::max(margin, 1.0 - best);
            let found = pyramid.search(&marks, least, margin, apart, 10_000);
            assert!(found.is_all, "seed {seed}");
            let mut all = all(&pyramid, &marks);
            all.sort_by(|(a, _, this), (b, _, other)| b.total_cmp(a).then(this.cmp(other)));
            let best = all[0].0;
            assert!(best > 0.5, "seed {seed}: {best}");
            let mut places: Vec<Isometry2<f64>> = Vec::new();
            for (score, pose, _) in all {
                let is_known = places.iter().any(|known| is_near(known, &pose, apart));
                if score >= least.max(best - margin(best)) && !is_known {
                    places.push(pose);
                }
            }
            assert_eq!(found.places, places, "seed {seed}");
            (pyramid.threads, pyramid.worth) = (3, 1);
            let again = pyramid.search(&marks, least, margin, apart, 10_000);
            assert_eq!(again.places, places, "seed {seed}, by threads");
        }
    }
}

//! The rasters of a chart at all levels, by the courses of its lines, and what marks sum up to on them, a strip of cells at a time.

use nalgebra::{Point2, Vector2};

use crate::geometry::Front;

use super::chart::{Chart, ENDS, Line};

/// How far a return may lie from a line to count half, in cm.
const SPREAD: f64 = 12.0;
/// What a return on a line counts.
pub(crate) const FULL: u8 = 4;
/// Levels; coarser cells gain nothing.
pub(crate) const LEVELS: usize = 4;
/// Cells that are looked at together, and as many above them, in two registers.
pub(crate) const STRIP: usize = 32;
/// Returns that are summed before it is asked whether the rest can make up for what they lack; their sum fits a byte.
const GROUP: usize = 15;
/// Returns whose sum fits half a byte.
const PACKED: usize = 3;
const _: () = assert!(FULL as usize * PACKED < 16 && FULL as usize * GROUP < 256);
/// Courses by which lines are told apart, their fronts on the left.
const COURSES: usize = 32;
/// The kinds of lines: of each course all, of each course the long ones, and all.
const KINDS: usize = 2 * COURSES + 1;
/// What is seen of a line by so much longer than this, in cm, is of one that is long.
const LONG: f64 = 100.0;
const LONGER: f64 = 20.0;
/// What is seen to run along a line turns from it by no more than this, in degrees, and by what its ends err.
const ASTRAY: f64 = 6.0;
/// A line goes on from another so far off, in cm.
const GAP: f64 = 15.0;
/// Parts of a degree by which courses are told apart that no line has.
pub(crate) const FINE: f64 = 2.0;
/// Empty cells about the building, so that a window may begin before it: twice the coarsest.
pub(crate) const BORDER: usize = 2 << (LEVELS - 1);

/// Where a mark meets the rasters of a level, from a cell on: how many values on, and how many cells.
#[derive(Debug, Clone, Copy)]
struct Offset {
    values: i32,
    column: i32,
    row: i32,
}

/// Where marks meet the rasters of a level.
#[derive(Debug, Clone, Default)]
pub(crate) struct Offsets {
    all: Vec<Offset>,
    /// The least and the greatest of their columns and of their rows.
    columns: (i32, i32),
    rows: (i32, i32),
}

impl Offsets {
    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }
}

/// The rasters of a level: of each course and each phase one.
///
/// A value tells of two cells, one above the other: the lower one in its lower half, so that strips are summed by twos, three marks
/// before the halves are taken apart. The phases of a row lie together, since what is seen lies along few walls.
pub(crate) struct Level {
    values: Vec<u8>,
    /// Cells that can be met.
    columns: usize,
    rows: usize,
    /// What lies between the beginnings of two rows of one phase; between them there is nothing for [`STRIP`] cells.
    stride: usize,
    /// Cells of a level are `2^step` finest ones apart; a window may begin every `2^finest`.
    step: usize,
    finest: usize,
}

impl Level {
    pub(crate) fn new(level: usize, (width, height): (usize, usize)) -> Self {
        let (step, finest) = (level, level.saturating_sub(1));
        let (columns, rows) = (width.div_ceil(1 << step), height.div_ceil(1 << step));
        Self { values: vec![0; STRIP], columns, rows, stride: columns + STRIP, step, finest }
    }

    /// Phases in either direction, as a power of two.
    fn phases(&self) -> usize {
        self.step - self.finest
    }

    /// From one row of a course to the next.
    fn up(&self) -> usize {
        self.stride << (2 * self.phases())
    }

    /// Takes in the raster of the next kind.
    pub(crate) fn add(&mut self, raster: &[u8]) {
        self.values.extend_from_slice(raster);
    }

    /// The raster of a kind: at each cell the most in the window of `2^step` cells from it on, in both directions.
    pub(crate) fn raster(&self, most: &[u8], (width, height): (usize, usize)) -> Vec<u8> {
        // What begins anywhere between two phases is within the window of the first, so much the wider.
        let wide = (self.finest > 0).then(|| widened(most, width, height, (1 << self.finest) - 1));
        let most = wide.as_deref().unwrap_or(most);
        let phases = 1 << self.phases();
        let at = |x: usize, y: Option<usize>| match y {
            Some(y) if x < width && y < height => most[y * width + x],
            _ => 0,
        };
        let mut values = Vec::with_capacity((self.rows + 1) * self.up());
        // From below the first row on: of that the upper half counts.
        for above in 0..=self.rows {
            for phase in 0..phases * phases {
                let [left, low] = [phase % phases, phase / phases].map(|n| n << self.finest);
                let upper = (above << self.step) + low;
                let lower = upper.checked_sub(1 << self.step);
                let upper = (above < self.rows).then_some(upper);
                values.extend((0..self.columns).map(|column| {
                    let x = (column << self.step) + left;
                    at(x, lower) | (at(x, upper) << 4)
                }));
                values.extend([0; STRIP]);
            }
        }
        values
    }

    /// Where marks that lie so many finest cells on meet it, each of the raster that it names.
    pub(crate) fn offsets(&self, marks: impl Iterator<Item = (i32, i32, usize)>) -> Offsets {
        let split = |v: i32| {
            let v = v + BORDER as i32;
            (v >> self.step, (v & ((1 << self.step) - 1)) >> self.finest)
        };
        let (up, stride) = (self.up() as i32, self.stride as i32);
        let one = |(x, y, kind): (i32, i32, usize)| {
            let ((column, left), (row, low)) = (split(x), split(y));
            let plane = (kind * (self.rows + 1)) as i32 * up;
            let phase = (low << self.phases()) + left;
            Offset { values: plane + row * up + phase * stride + column, column, row }
        };
        let all: Vec<Offset> = marks.map(one).collect();
        let span = |of: fn(&Offset) -> i32| {
            let least = all.iter().map(of).min().unwrap_or(0);
            (least, all.iter().map(of).max().unwrap_or(0))
        };
        let (columns, rows) = (span(|offset| offset.column), span(|offset| offset.row));
        Offsets { all, columns, rows }
    }

    /// What a mark of the finest level that lies so many cells on counts, read by itself.
    #[cfg(test)]
    pub(crate) fn value(&self, x: i32, y: i32, kind: usize) -> u8 {
        let at = |v: i32| usize::try_from(v + BORDER as i32).ok();
        let (Some(x), Some(y)) = (at(x), at(y)) else { return 0 };
        let row = (kind * (self.rows + 1) + y + 1) * self.stride;
        if x < self.columns && y < self.rows { self.values[STRIP + row + x] & 15 } else { 0 }
    }

    /// What the marks sum up to in each cell of a strip and of the one above it; none where it is told that no cell comes to
    /// `needed`.
    pub(crate) fn sums(&self, marks: &Offsets, column: i32, row: i32, needed: u16) -> Option<Sums> {
        let columns = -(STRIP as i32)..=self.columns as i32;
        let rows = -1..self.rows as i32;
        let from = STRIP as i32 + (row + 1) * self.up() as i32 + column;
        let values = |mark: &Offset| {
            let at = (from + mark.values) as u32 as usize;
            let values = self.values.get(at..at + STRIP).expect("a row ends with nothing");
            let mut words = [0; STRIP / 8];
            for (word, bytes) in words.iter_mut().zip(values.as_chunks().0) {
                *word = u64::from_le_bytes(*bytes);
            }
            words
        };
        let is_within = columns.contains(&(column + marks.columns.0))
            && columns.contains(&(column + marks.columns.1))
            && rows.contains(&(row + marks.rows.0))
            && rows.contains(&(row + marks.rows.1));
        if is_within {
            return summed(&marks.all, needed, values);
        }
        summed(&marks.all, needed, |mark| {
            let is_met =
                columns.contains(&(column + mark.column)) && rows.contains(&(row + mark.row));
            if is_met { values(mark) } else { [0; STRIP / 8] }
        })
    }
}

/// Values of a strip, eight in a word.
type Words = [u64; STRIP / 8];
/// The lower half of each byte, the lower byte of each of four sums, one in each of four sums, and their highest bits.
const LOWER: u64 = 0x0f0f_0f0f_0f0f_0f0f;
const BYTE: u64 = 0x00ff_00ff_00ff_00ff;
const ONES: u64 = 0x0001_0001_0001_0001;
const HIGHEST: u64 = 0x8000_8000_8000_8000;
/// Brings the lowest bits of four sums to every other bit from the 48th on.
const GATHER: u64 = 1 << 48 | 1 << 34 | 1 << 20 | 1 << 6;

/// What marks sum up to in the cells of a strip and in those above: of each eight the even ones, and the odd ones.
pub(crate) struct Sums([[Words; 2]; 2]);

impl Sums {
    /// Which cells of one of its two rows come to `needed`, as bits.
    pub(crate) fn reaching(&self, row: usize, needed: u16) -> u32 {
        let more = ONES * u64::from((1 << 15) - needed);
        let bits = |sums: u64| (((sums + more) & HIGHEST) >> 15).wrapping_mul(GATHER) >> 48;
        let [even, odd] = &self.0[row];
        (0..STRIP / 8)
            .fold(0, |all, k| all | ((bits(even[k]) | bits(odd[k]) << 1) << (8 * k)) as u32)
    }

    pub(crate) fn at(&self, row: usize, cell: usize) -> u16 {
        (self.0[row][cell % 2][cell / 8] >> (16 * (cell % 8 / 2))) as u16
    }
}

/// Sums of both halves of what each mark meets; none where it is told that no cell comes to `needed`.
#[inline(always)]
fn summed(marks: &[Offset], needed: u16, values: impl Fn(&Offset) -> Words) -> Option<Sums> {
    let mut sums = [[[0_u64; STRIP / 8]; 2]; 2];
    let mut left = u16::from(FULL) * marks.len() as u16;
    for group in marks.chunks(GROUP) {
        let mut parts = [[0; STRIP / 8]; 2];
        let mut add = |values: Words| {
            for k in 0..STRIP / 8 {
                parts[0][k] += values[k] & LOWER;
                parts[1][k] += (values[k] >> 4) & LOWER;
            }
        };
        let few = group.chunks_exact(PACKED);
        let last = few.remainder();
        for few in few {
            let [mut sum, b, c] = [values(&few[0]), values(&few[1]), values(&few[2])];
            for k in 0..STRIP / 8 {
                sum[k] += b[k] + c[k];
            }
            add(sum);
        }
        for mark in last {
            add(values(mark));
        }
        left -= u16::from(FULL) * group.len() as u16;
        // What comes to it has its highest bit set by so much more.
        let more = ONES * u64::from((1 << 15) - needed.saturating_sub(left));
        let mut reached = 0;
        for (sums, part) in sums.iter_mut().zip(parts) {
            for k in 0..STRIP / 8 {
                sums[0][k] += part[k] & BYTE;
                sums[1][k] += (part[k] >> 8) & BYTE;
                reached |= (sums[0][k] + more) | (sums[1][k] + more);
            }
        }
        if reached & HIGHEST == 0 {
            return None;
        }
    }
    Some(Sums(sums))
}

/// The course of a line in degrees, and by how much it is off where its ends err by so many cm.
pub(crate) fn course(along: Vector2<f64>, ends: f64) -> (f64, f64) {
    let errs = (ends / along.norm()).min(1.0).asin().to_degrees();
    (along.y.atan2(along.x).to_degrees(), errs)
}

/// The courses of a line, as it is seen from each of its fronts.
fn courses(line: &Line, ends: f64) -> impl Iterator<Item = (f64, f64)> + use<> {
    let along = line.end - line.start;
    let of = |other: Front, along| (line.front != other).then_some(along);
    [of(Front::Right, along), of(Front::Left, -along)]
        .into_iter()
        .flatten()
        .map(move |along| course(along, ends))
}

/// Of which kind the lines are that what is seen can be of, by the course of that in degrees; of all where it has none.
pub(crate) fn kind(seen: Option<(f64, f64)>) -> usize {
    let Some((course, length)) = seen else { return KINDS - 1 };
    let number = (course * COURSES as f64 / 360.0 + 0.5) as usize % COURSES;
    if is_long(length) { COURSES + number } else { number }
}

/// Whether so much is seen only of what is long.
pub(crate) fn is_long(seen: f64) -> bool {
    seen > LONG + LONGER
}

/// Which of the rasters each kind has, none where it has no lines, and the lines of each raster. Where lines run one of two ways
/// several kinds have the same ones: one raster is enough for them.
pub(crate) fn kinds(chart: &Chart) -> (Vec<Option<usize>>, Vec<Vec<&Line>>) {
    let wholes = wholes(chart);
    let mut rasters: Vec<Vec<u32>> = Vec::new();
    let raster_of = |kind: usize| {
        let lines = chart.lines().iter().zip(&wholes).enumerate();
        let of = lines.filter(|(_, (line, whole))| is_of(line, **whole, kind));
        let of: Vec<u32> = of.map(|(number, _)| number as u32).collect();
        if of.is_empty() {
            return None;
        }
        let known = rasters.iter().position(|known| *known == of);
        Some(known.unwrap_or_else(|| {
            rasters.push(of);
            rasters.len() - 1
        }))
    };
    let kinds = (0..KINDS).map(raster_of).collect();
    let lines =
        |raster: &Vec<u32>| raster.iter().map(|number| &chart.lines()[*number as usize]).collect();
    (kinds, rasters.iter().map(lines).collect())
}

/// Whether a line is of a kind, where it is `whole` cm long with what goes on from it.
fn is_of(line: &Line, whole: f64, kind: usize) -> bool {
    if kind == KINDS - 1 {
        return true;
    }
    let step = 360.0 / COURSES as f64;
    // What is seen of it is no longer than it is.
    let is_along = |(course, errs): (f64, f64)| {
        let off = (course - (kind % COURSES) as f64 * step + 180.0).rem_euclid(360.0) - 180.0;
        off.abs() <= step / 2.0 + ASTRAY + errs
    };
    (kind < COURSES || whole >= LONG) && courses(line, ENDS).any(is_along)
}

/// How long each line is with those that go on from it, where it is not long by itself; endless where the chart's lines err:
/// then they may be pieces of any.
fn wholes(chart: &Chart) -> Vec<f64> {
    let lines = chart.lines();
    if chart.ends() > 0.0 {
        return vec![f64::INFINITY; lines.len()];
    }
    let mut wholes: Vec<f64> = lines.iter().map(|line| (line.end - line.start).norm()).collect();
    let mut is_known: Vec<bool> = wholes.iter().map(|length| *length >= LONG).collect();
    let goes_on = |a: &Line, b: &Line, at: Point2<f64>| {
        let turn = a.direction().perp(&b.direction()).abs().asin().to_degrees();
        turn <= ASTRAY && (b.nearest(at) - at).norm() <= GAP
    };
    for first in 0..lines.len() {
        if std::mem::replace(&mut is_known[first], true) {
            continue;
        }
        let (mut run, mut next) = (vec![first], 0);
        while let Some(line) = run.get(next).map(|number| &lines[*number]) {
            next += 1;
            for end in [line.start, line.end] {
                let on = chart.about(end).filter(|other| goes_on(line, &lines[*other], end));
                let on: Vec<usize> = on.filter(|other| !run.contains(other)).collect();
                run.extend(on);
            }
        }
        let along = lines[first].direction();
        let places = run.iter().flat_map(|number| [lines[*number].start, lines[*number].end]);
        let places = places.map(|p| p.coords.dot(&along));
        let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| {
            (low.min(place), high.max(place))
        });
        for number in run {
            is_known[number] = true;
            wholes[number] = wholes[number].max(high - low);
        }
    }
    wholes
}

/// By how many degrees each course differs from the nearest of a line.
pub(crate) fn off(chart: &Chart) -> Vec<f64> {
    let count = (360.0 * FINE) as usize;
    let mut off = vec![f64::INFINITY; count];
    for (course, errs) in chart.lines().iter().flat_map(|line| courses(line, chart.ends())) {
        let at = ((course - errs).rem_euclid(360.0) * FINE) as usize;
        for n in 0..=(2.0 * errs * FINE).ceil() as usize {
            off[(at + n) % count] = 0.0;
        }
    }
    // Once about to the right and once to the left, twice for what lies across the seam.
    for _ in 0..2 {
        for n in 0..count {
            off[(n + 1) % count] = off[(n + 1) % count].min(off[n] + 1.0 / FINE);
        }
        for n in (0..count).rev() {
            off[n] = off[n].min(off[(n + 1) % count] + 1.0 / FINE);
        }
    }
    off
}

/// How near the nearest of some lines is, cell by cell.
pub(crate) fn drawn<'l>(
    lines: impl Iterator<Item = &'l Line>,
    low: Point2<f64>,
    cell: f64,
    (width, height): (usize, usize),
) -> Vec<u8> {
    let mut fine = vec![0_u8; width * height];
    // So near, squared, a line is for it to count so much: half as much at [`SPREAD`], rounded.
    let within: [f64; FULL as usize] = std::array::from_fn(|less| {
        SPREAD * SPREAD * (f64::from(FULL) / (less as f64 + 0.5)).log2()
    });
    let reach = within[0].sqrt();
    for line in lines {
        let (a, b) = (line.start.inf(&line.end), line.start.sup(&line.end));
        let first = ((a - low).add_scalar(-reach) / cell).map(|x| x.max(0.0) as usize);
        let last = ((b - low).add_scalar(reach) / cell).map(|x| x.max(0.0) as usize);
        for row in first.y..=last.y.min(height - 1) {
            for column in first.x..=last.x.min(width - 1) {
                let p = low + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * cell;
                let far = (line.nearest(p) - p).norm_squared();
                let value = within.iter().filter(|within| far <= **within).count() as u8;
                let here = &mut fine[row * width + column];
                *here = (*here).max(value);
            }
        }
    }
    fine
}

/// At each cell the most of it and of what stands so many steps further, in both directions.
pub(crate) fn widened(values: &[u8], width: usize, height: usize, step: usize) -> Vec<u8> {
    let mut wide = values.to_vec();
    for line in wide.chunks_mut(width) {
        for column in 0..width.saturating_sub(step) {
            line[column] = line[column].max(line[column + step]);
        }
    }
    for row in 0..height.saturating_sub(step) {
        let (upper, lower) = wide.split_at_mut((row + step) * width);
        let own = &mut upper[row * width..(row + 1) * width];
        own.iter_mut().zip(&lower[..width]).for_each(|(a, b)| *a = (*a).max(*b));
    }
    wide
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of cupboards is seen as one front; what stands about a corner or a metre on is no part of it.
    #[test]
    fn what_goes_on_in_line_is_long_together() {
        let line = |a: (f64, f64), b: (f64, f64)| {
            Line::between(Point2::new(a.0, a.1), Point2::new(b.0, b.1))
        };
        let row = (0..5).map(|n| f64::from(n) * 61.0).map(|x| line((x, 3.0), (x + 60.0, 3.0)));
        let mut lines: Vec<Line> = row.collect();
        lines.push(line((304.0, 3.0), (304.0, 63.0)));
        lines.push(line((404.0, 3.0), (464.0, 3.0)));
        let chart = Chart::new(lines);
        assert_eq!(wholes(&chart), [304.0, 304.0, 304.0, 304.0, 304.0, 60.0, 60.0]);
        assert!(wholes(&chart.erring(ENDS)).iter().all(|whole| whole.is_infinite()));
    }

    /// Each cell by its nearest line, and by the bell itself.
    #[test]
    fn what_is_drawn_falls_off_as_a_bell_does() {
        for seed in 0..20 {
            let mut random = fastrand::Rng::with_seed(seed);
            let mut point = || Point2::new(random.f64() * 300.0, random.f64() * 200.0);
            let lines: Vec<Line> = (0..6).map(|_| Line::between(point(), point())).collect();
            let (low, cell, (width, height)) = (Point2::new(-40.0, -50.0), 7.3, (52, 40));
            let values = drawn(lines.iter(), low, cell, (width, height));
            for (at, value) in values.into_iter().enumerate() {
                let (column, row) = ((at % width) as f64 + 0.5, (at / width) as f64 + 0.5);
                let p = low + Vector2::new(column, row) * cell;
                let far = |line: &Line| (line.nearest(p) - p).norm();
                let far = lines.iter().map(far).fold(f64::INFINITY, f64::min) / SPREAD;
                let bell = f64::from(FULL) * (-far * far).exp2();
                assert_eq!(value, bell.round() as u8, "seed {seed}: {column}, {row}");
            }
        }
    }
}

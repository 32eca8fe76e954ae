//! A grid of where a log of known poses saw something and where it saw through, as the field's occupancy grids (SPEC L6;
//! H. Moravec, A. Elfes, 1985).

use nalgebra::{Point2, Vector2};

use crate::vectors::read::Log;

/// What is known of one cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellState {
    Free,
    Occupied,
    Unknown,
}

/// Cells row by row, the lowest first.
#[derive(Debug, Clone)]
pub struct Raster {
    /// Lower left corner of the first cell, in cm.
    pub low: Point2<f64>,
    /// Side of a cell, in cm.
    pub cell: f64,
    pub width: usize,
    pub height: usize,
    pub cells: Vec<CellState>,
}

/// Returns farther than this are left aside, in cm: over a longer way a turn of half a degree is a cell and more.
const FARTHEST: f64 = 2000.0;
/// A cell is occupied where at least this share of the beams that came to it ended there; beams that graze a wall go
/// through its cells too.
const OCCUPIED: f64 = 0.2;
/// And so many beams.
const FEWEST: u32 = 2;
/// Larger grids have larger cells.
const MOST_CELLS: f64 = 30e6;

impl Raster {
    /// Of the scans that have poses; none where no such scan has a return.
    #[must_use]
    pub fn of(log: &Log, cell: f64) -> Option<Self> {
        let placed = || log.scans.iter().filter_map(|scan| Some((scan, scan.pose?)));
        let (mut low, mut high) = (
            Point2::from(Vector2::repeat(f64::INFINITY)),
            Point2::from(Vector2::repeat(f64::NEG_INFINITY)),
        );
        for (scan, pose) in placed() {
            let sensor = log.sensor(scan);
            for (u, &range) in sensor.directions().iter().zip(&scan.ranges) {
                if sensor.returned(range) && range <= FARTHEST {
                    let end = pose * Point2::from(u * range);
                    (low, high) = (low.inf(&end), high.sup(&end));
                }
            }
            let at = Point2::from(pose.translation.vector);
            (low, high) = (low.inf(&at), high.sup(&at));
        }
        let span = high - low;
        if !(span.x.is_finite() && span.y.is_finite() && span.x > 0.0 && span.y > 0.0) {
            return None;
        }
        let margin = 10.0 * cell;
        let area = (span.x + 2.0 * margin) * (span.y + 2.0 * margin);
        let cell = cell.max((area / MOST_CELLS).sqrt());
        let low = low - Vector2::repeat(margin);
        let size = (span.add_scalar(2.0 * margin) / cell).map(|x| x as usize + 1);
        let (width, height) = (size.x, size.y);
        let mut counts = vec![(0_u32, 0_u32); width * height];
        let place = |p: Point2<f64>| {
            let at = (p - low) / cell;
            (at.y as usize).min(height - 1) * width + (at.x as usize).min(width - 1)
        };
        for (scan, pose) in placed() {
            let sensor = log.sensor(scan);
            let from = Point2::from(pose.translation.vector);
            for (u, &range) in sensor.directions().iter().zip(&scan.ranges) {
                if !sensor.returned(range) || range > FARTHEST {
                    continue;
                }
                let along = pose.rotation * u;
                let end = place(from + along * range);
                counts[end].0 += 1;
                let (steps, mut last) = ((range / (0.5 * cell)) as usize, usize::MAX);
                for step in 0..steps {
                    let at = place(from + along * (step as f64 * 0.5 * cell));
                    if at != last && at != end {
                        counts[at].1 += 1;
                    }
                    last = at;
                }
            }
        }
        let state = |(ended, through): (u32, u32)| {
            let all = ended + through;
            if ended >= FEWEST && f64::from(ended) >= OCCUPIED * f64::from(all) {
                CellState::Occupied
            } else if through >= FEWEST {
                CellState::Free
            } else {
                CellState::Unknown
            }
        };
        let cells = counts.into_iter().map(state).collect();
        Some(Self { low, cell, width, height, cells })
    }

    /// As a picture of ROS map_server, binary PGM: black is occupied, white is free, grey is not known.
    #[must_use]
    pub fn to_pgm(&self) -> Vec<u8> {
        let mut bytes = format!("P5\n{} {}\n255\n", self.width, self.height).into_bytes();
        for row in self.cells.chunks(self.width).rev() {
            bytes.extend(row.iter().map(|state| match state {
                CellState::Free => 254,
                CellState::Occupied => 0,
                CellState::Unknown => 205,
            }));
        }
        bytes
    }
}

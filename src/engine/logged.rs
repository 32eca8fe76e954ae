//! A map of the walls that a log with known poses saw (SPEC L6): an occupancy grid of its scans, read as any grid is.

use crate::exchange::{Imported, Options, read_grid};
use crate::sensing::Raster;

use super::{Error, RequestError, Sighted};

impl Sighted {
    /// A building made of a log whose scans tell their poses, in the log's own frame; `cell` is the size in cm to which walls
    /// are told apart.
    ///
    /// # Errors
    /// It is no log, none of its scans tells a pose, or no floor as large as a room was seen.
    pub fn to_map(&self, cell: f64) -> Result<Imported, Error> {
        let log = self.log().ok_or(RequestError::NoLog)?;
        let raster = Raster::of(log, cell);
        let raster = raster.ok_or(RequestError::NoPoses { count: log.scans.len() })?;
        let picture = raster.to_pgm();
        Ok(read_grid(self.name(), &picture, raster.cell, raster.low, &Options::default())?)
    }
}

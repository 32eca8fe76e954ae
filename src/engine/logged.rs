//! A map of the walls that a log with known poses saw (SPEC L6): an occupancy grid of its scans, read as any grid is.

use crate::exchange::{Imported, Options, read_grid, to_map_file};
use crate::map::{Format, World};
use crate::sensing::Raster;

use super::{Error, RequestError, Sighted};

/// A building made of a log whose scans tell their poses, in the log's own frame; `cell` is the size in cm to which walls
/// are told apart.
///
/// # Errors
/// It is no log, none of its scans tells a pose, or no floor as large as a room was seen.
pub fn map_from(log: &Sighted, cell: f64) -> Result<Imported, Error> {
    let name = log.name().to_owned();
    let log = log.log().ok_or(RequestError::NoLog)?;
    let raster = Raster::of(log, cell);
    let raster = raster.ok_or(RequestError::NoPoses { count: log.scans.len() })?;
    let read = read_grid(&name, &raster.to_pgm(), raster.cell, raster.low, &Options::default());
    Ok(read?)
}

/// A building as a map file.
#[must_use]
pub fn map_file(world: &World, format: Format) -> String {
    to_map_file(world, format)
}

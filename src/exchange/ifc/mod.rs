//! IFC models (IFC2x3, IFC4, IFC4.3) as STEP text → [`Survey`]: storeys, spaces, doors, windows, openings without
//! doors, boundaries without walls, stairs and lifts, furniture and equipment. Walls are not read: they are what is
//! between the spaces.
//!
//! Only the types of `classes` are taken apart; the rest of the file is passed over, and elements of which nothing
//! is made are counted. A door is set where its placement and its body say; the spaces that it joins are looked for on
//! both sides of it, and where the model has space boundaries they narrow the search. Every element is accounted for:
//! it is in the survey's lists, or in what the survey tells of the file.

mod body;
mod building;
mod classes;
mod curve;
mod doors;
mod passages;
mod place;
mod shape;
mod solid;
mod spaces;
mod stairs;
mod step;
mod things;

use super::{ReadError, Survey};
use crate::units::Source;

/// Reads an IFC model.
///
/// # Errors
/// [`ReadError::Syntax`] when it is no STEP text or breaks off, [`ReadError::NoBuilding`] when it has no space with
/// an outline, [`ReadError::TooMany`] when it has more than any building.
pub fn read(source: &Source) -> Result<Survey, ReadError> {
    let mut remarks = Vec::new();
    let counted: Vec<&str> = classes::counted().collect();
    let all = step::instances(source, &classes::wanted(), &counted, &mut remarks)?;
    building::survey(source.name(), &all, remarks)
}

/// Whether a text says that it is STEP.
#[must_use]
pub fn recognises(text: &str) -> bool {
    step::is_step(text)
}

//! The assembler: a [`Survey`] of any format becomes a checked [`World`].
//!
//! Rooms are cleaned and parted, openings set into their walls, kinds made Objects and things replicas; storeys are
//! placed by their elevation, lifts link them. What does not fit is mended or left out, with a note in the
//! [`Report`]; whatever the survey holds, the import goes through as long as one room is left.
//!
//! - A door stands in the face of the room into which it opens; the floor of a doorway through a thick wall belongs
//!   to the other room, so that the sides of both coincide (M5).
//! - Rooms that no door joins with the others are placed by links of solid walls, which only position.
//! - Ids follow the order of the file: two imports of one file give the same world.
//!
//! **Invariant.** A world that [`assemble`] returns passes [`crate::map::check`] without an error.

mod build;
mod doors;
mod fitted;
mod index;
mod kinds;
mod lanes;
mod names;
mod openings;
pub(super) mod ring;
mod rooms;
mod things;
mod types;
mod wall;

use crate::map::{Fault, MapErrors, World, check};
use crate::units::word;

use super::synonyms::Synonyms;
use super::{ImportError, Report, Survey};

/// Rooms, openings and things that one building may have, each.
const MOST_RECORDS: usize = 1_000_000;

/// Makes a world of a survey, and tells in the report what it had to do.
///
/// # Errors
/// No room is left, or there is more of something than any building needs.
pub fn assemble(
    survey: &Survey,
    synonyms: &Synonyms,
    report: &mut Report,
) -> Result<World, ImportError> {
    for (what, count) in [
        (word!("rooms"), survey.levels.iter().map(|l| l.rooms.len()).sum::<usize>()),
        (word!("openings"), survey.levels.iter().map(|l| l.openings.len()).sum()),
        (word!("things"), survey.levels.iter().map(|l| l.things.len()).sum()),
        (word!("kinds-of-things"), survey.kinds.len()),
    ] {
        if count > MOST_RECORDS {
            return Err(ImportError::Limit { what: what.into(), count, limit: MOST_RECORDS });
        }
    }
    let world = build::build(survey, synonyms, report)?;
    let faults: Vec<Fault> = check(&world).into_iter().filter(|f| !f.is_warning()).collect();
    if let Some(fault) = faults.into_iter().next() {
        // Not reached by anything tried; a world with faults must not get through all the same.
        return Err(ImportError::Map(MapErrors::of(fault.error)));
    }
    Ok(world)
}

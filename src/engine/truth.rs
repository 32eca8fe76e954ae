//! The world as it really is, apart from what the robot believes: told in a file, driven in by the simulator.
//!
//! **Invariant.** The store never hears of a truth; it keeps what the robot found out in it.

use std::collections::BTreeSet;
use std::path::Path;

use crate::map::{self, Entity, Format, MapError, MapErrors, World};
use crate::robot::Simulator;
use crate::semantics::load;
use crate::units::{Bilingual, FileFault, Gather as _, ReplicaId, Source};

use super::error::in_both;
use super::lexicon::form_index;
use super::{Error, RequestError, State};

/// What is really so.
#[derive(Debug, Clone)]
pub struct Truth {
    /// Without what the robot holds or has handed over. In the ids of the map, for what that has too.
    pub world: World,
    /// What stood on a thing that the file moves without its load, and so hangs where it was.
    pub left_behind: Vec<String>,
}

/// No map or file of edits is larger, bytes.
const LIMIT: u64 = 64 << 20;

impl State {
    /// Reads a truth from a file: a map, or edits of what is believed now (see [`map::read_truth`]).
    ///
    /// # Errors
    /// All faults of the file, and where it tells of another building or robot than the map does.
    pub fn read_truth(&self, file: &Path) -> Result<Truth, Error> {
        let source = Source::read_within(file, LIMIT).map_err(|fault| unreadable(file, &fault))?;
        self.truth(&source, Format::of_text(file, source.text()))
    }

    /// The same from a text.
    ///
    /// # Errors
    /// As [`State::read_truth`].
    pub fn truth(&self, source: &Source, format: Format) -> Result<Truth, Error> {
        let now = self.at(std::time::SystemTime::now().into())?;
        let (known, (map, pose)) = (now.around()?, now.robot()?);
        // What is carried or was handed over is where it was last.
        let believed = known.world();
        let away: BTreeSet<ReplicaId> = known.holders.keys().copied().gather();
        let index = std::cell::OnceCell::new();
        let names = |name: &str| -> Vec<Entity> {
            let index = index.get_or_init(|| form_index(believed));
            index.find(name).into_iter().map(|hit| *hit.id).collect()
        };
        let read = map::read_truth(believed, &away, source, format, &names);
        let Some(mut world) = read.world else { return Err(read.faults.into()) };
        for carried in &away {
            world.replicas.remove(carried);
        }
        let left_behind = if world.replicas == known.uncarried().replicas {
            Vec::new()
        } else {
            let relations = known.to_follow()?;
            load::carry(known.uncarried(), relations.relations(), &read.carriers, &mut world)
        };
        let name = |id: &ReplicaId| world.replicas.get(id).map(|thing| thing.name.clone());
        let left_behind = left_behind.iter().filter_map(name).collect();
        let standing = Simulator::new(world, map, pose);
        let inside = standing.stands_in();
        let world = standing.into_truth();
        if let Some(what) = inside {
            let thing = what.entity().map_or("".into(), |it| in_both(&world, world.name(it)));
            return Err(RequestError::TruthOnRobot { thing }.into());
        }
        Ok(Truth { world, left_behind })
    }
}

fn unreadable(file: &Path, fault: &FileFault) -> MapErrors {
    let path = file.to_string_lossy().into_owned();
    let message = Bilingual::from(fault);
    MapErrors::of(match fault {
        FileFault::TooLarge { bytes, limit } => MapError::TooLarge { bytes: *bytes, limit: *limit },
        _ => MapError::Unreadable { path, message },
    })
}

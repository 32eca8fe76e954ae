//! What a Fragment's floor is made from, as one number: equal numbers, equal floors.
//!
//! Everything that [`super::floor`] reads is fed in: the robot, the Area and the names of its sides, its doorways
//! with their doors and states, the Areas behind them, and the replicas that may stand in the way. More is taken
//! than needed rather than less: a floor built once too often does no harm.

use std::collections::HashMap;
use std::collections::hash_map::DefaultHasher;
use std::fmt::{Debug, Write};
use std::hash::{Hash, Hasher};

use crate::map::{DoorMount, Item};
use crate::units::{AreaId, ObjectId, OpeningId, ReplicaId};

use super::Bounds;
use super::opening::Opening;
use super::site::Site;
use super::zone::obstacles_of;

/// Feeds what is written into a hash.
struct Feed(DefaultHasher);

impl Write for Feed {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

/// A number for all that a value's derived `Debug` shows, which is every field, numbers to the last bit.
fn number_of(value: &impl Debug) -> u64 {
    let mut feed = Feed(DefaultHasher::new());
    write!(feed, "{value:?}").expect("a hash takes any text");
    feed.0.finish()
}

/// The digests of some Areas' floors.
pub(super) fn digests(site: &Site<'_>, areas: &[AreaId]) -> Vec<u64> {
    let robot = number_of(site.robot);
    let mut doorways: HashMap<OpeningId, u64> = HashMap::new();
    let mut doorway_number =
        |d: &Opening| *doorways.entry(d.id).or_insert_with(|| doorway_number(site, d));
    let rooms: HashMap<AreaId, u64> = site
        .scene
        .areas
        .iter()
        .map(|(&id, placed)| {
            let model = &site.world.areas[&id];
            (id, number_of(&(placed, parts(site, &model.items, &model.doors))))
        })
        .collect();
    let mut objects: HashMap<ObjectId, u64> = HashMap::new();
    let mut replicas: HashMap<ReplicaId, u64> = HashMap::new();
    let mut replica = |id: ReplicaId| {
        *replicas.entry(id).or_insert_with(|| {
            let (placed, model) = (&site.scene.replicas[&id], &site.world.replicas[&id]);
            let object = *objects.entry(model.object).or_insert_with(|| {
                let object = &site.world.objects[&model.object];
                number_of(&parts(site, &object.items, &object.doors))
            });
            number_of(&(placed, &model.door_states, object, rooms.get(&placed.area)))
        })
    };
    let digest = |&area: &AreaId| {
        let mut hash = DefaultHasher::new();
        (robot, rooms[&area]).hash(&mut hash);
        let mut zones: Vec<Bounds> =
            site.scene.areas[&area].prisms.iter().map(|p| p.bounds.grown(1.0)).collect();
        for (index, doorway, side) in site.doorways_of(area) {
            zones.push(doorway.mouth(site.reach()).grown(1.0));
            let other = doorway.areas[1 - side];
            (index, doorway_number(doorway), rooms.get(&other)).hash(&mut hash);
            for (next, beside, at) in site.doorways_of(other) {
                if doorway.may_tell(beside, site.reach()) {
                    let beyond = rooms.get(&beside.areas[1 - at]);
                    (next, doorway_number(beside), beyond).hash(&mut hash);
                }
            }
        }
        let all = zones.iter().copied().reduce(|a, b| a.union(&b)).unwrap_or(Bounds::EMPTY);
        for id in (site.nearby)(&all) {
            let reach = site.scene.replicas[&id].reach();
            if zones.iter().any(|zone| zone.meets(&reach)) {
                (id, replica(id)).hash(&mut hash);
            }
        }
        for zone in obstacles_of(site.zones, &zones, 0.0) {
            number_of(&zone).hash(&mut hash);
        }
        hash.finish()
    };
    areas.iter().map(digest).collect()
}

fn doorway_number(site: &Site<'_>, doorway: &Opening) -> u64 {
    let door = doorway.door.map(|id| (site.world.doors.get(&id), site.state(id)));
    number_of(&(doorway.shape(), door))
}

/// The Orthoframes of items, and the doors mounted on them.
fn parts(site: &Site<'_>, items: &[Item], doors: &[DoorMount]) -> u64 {
    let frames: Vec<_> = items.iter().map(|item| &site.world.orthoframe_of(item).base).collect();
    let models: Vec<_> = doors.iter().map(|mount| site.world.doors.get(&mount.door)).collect();
    number_of(&(items, frames, doors, models))
}

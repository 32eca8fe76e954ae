//! What was seen and is not on the map, in the world as it is now: it fades, or becomes a thing of the map by who says so
//! (SPEC L4).

use crate::map::{Entity, Item, World};
use crate::robot::{outline_of, stand_obstacle};
use crate::store::{Belief, Change, ImportReport, Seen, SeenObstacle, Timestamp};
use crate::units::{ObjectId, OrFrId, ReplicaId};

use super::observe::Believed;
use super::{Engine, Error, Mode, State};

pub(super) use crate::robot::is_obstacle;

/// Stands what was seen in the world.
pub(super) fn put_up<'o>(world: &mut World, seen: impl Iterator<Item = &'o SeenObstacle>) {
    for obstacle in seen {
        stand_obstacle(world, obstacle.area, &obstacle.pieces, obstacle.top);
    }
}

impl State {
    /// What was seen that the map lacks, by the names that it bears meanwhile.
    pub(super) fn lacked(&self, now: Timestamp) -> Result<Vec<Believed>, Error> {
        let around = self.known_at(now)?;
        let all = around.world().replicas.values().filter(|thing| is_obstacle(thing.id));
        let proposal = |id: ReplicaId| {
            let seen = self.remembered(around.world(), id).ok()??;
            let thing = around.world().replicas.get(&id)?;
            let belief = Belief {
                place: Seen { area: thing.area, frame: thing.frame },
                confidence: seen.confidence(now),
                since: seen.at,
                last_seen: Some(seen.at),
                missed: None,
                is_surveyed: false,
            };
            let name = thing.name.clone();
            Some(Believed { replica: id, name, belief, surveyed: None, carried: None })
        };
        // Those of lower numbers have higher ids.
        Ok(all.rev().filter_map(|thing| proposal(thing.id)).collect())
    }

    /// What bears this name and is on no map.
    pub(super) fn obstacle(&self, name: &str) -> Result<Option<SeenObstacle>, Error> {
        let world = self.around()?.world();
        let id = world.find(name).into_iter().find_map(|entity| match entity {
            Entity::Replica(id) if is_obstacle(id) => Some(id),
            _ => None,
        });
        id.map_or(Ok(None), |id| self.remembered(world, id))
    }

    /// How an obstacle of the world as it is now was seen.
    fn remembered(&self, world: &World, id: ReplicaId) -> Result<Option<SeenObstacle>, Error> {
        let Some((area, pieces, top)) = outline_of(world, id) else { return Ok(None) };
        let one = SeenObstacle { area, pieces, top, at: Timestamp(0), sure: 1.0 };
        Ok(self.memory()?.obstacles.iter().find(|seen| seen.is_as(&one)).cloned())
    }
}

impl Engine {
    /// It becomes a thing of the map, with ids of its own.
    pub(super) fn survey_obstacle(
        &mut self,
        seen: &SeenObstacle,
        change: &Change,
    ) -> Result<ImportReport, Error> {
        let ids = self.next_ids(self.world()?)?;
        let edited = self.edit_world(change, Mode::Commit, |world| {
            let stood = stand_obstacle(world, seen.area, &seen.pieces, seen.top);
            let Some(mut thing) = stood.and_then(|id| world.replicas.remove(&id)) else { return };
            let Some(mut object) = world.objects.remove(&thing.object) else { return };
            (thing.id, thing.object) = (ReplicaId(ids.replica), ObjectId(ids.object));
            object.id = thing.object;
            for (index, item) in (0..).zip(&mut object.items) {
                let Some(mut frame) = world.orthoframes.remove(&item.orthoframe) else { continue };
                frame.id = OrFrId(ids.orthoframe + index);
                frame.key = format!("{}-{}", object.key, Item::clone(item).id);
                item.orthoframe = frame.id;
                world.orthoframes.insert(frame.id, frame);
            }
            world.objects.insert(object.id, object);
            world.replicas.insert(thing.id, thing);
        })?;
        self.forget_obstacle(seen, change)?;
        Ok(edited.report.unwrap_or_default())
    }

    /// It is held to be gone.
    pub(super) fn forget_obstacle(
        &mut self,
        seen: &SeenObstacle,
        change: &Change,
    ) -> Result<(), Error> {
        let mut memory = self.memory()?.clone();
        memory.obstacles.retain(|one| one != seen);
        self.next().forget_present();
        Ok(self.writable()?.remember(&memory, &[], &change.user, change.at)?)
    }
}

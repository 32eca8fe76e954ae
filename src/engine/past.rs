//! Where a thing was before: by the revisions of the map, and by what the robot saw and did since.

use crate::language::question::Past;
use crate::semantics::{Relations, derive};
use crate::store::Stay;
use crate::units::ReplicaId;

use super::{Error, State};

impl State {
    /// Where a thing was, the earliest first; where it is now is not among them.
    ///
    /// # Errors
    /// There is no map, a record is broken, or a rule of the user's own outgrows the memory.
    pub(super) fn past(&self, thing: ReplicaId) -> Result<Vec<Past>, Error> {
        let Some(reader) = &self.reader else { return Ok(Vec::new()) };
        let Some(surveyed) = self.world()?.replicas.get(&thing) else { return Ok(Vec::new()) };
        let mut past = Vec::new();
        for pair in reader.replica_history(thing)?.windows(2) {
            let [before, after] = pair else { continue };
            let Some(world) = reader.at(before.stamp.revision)?.world()? else { continue };
            let Some(old) = world.replicas.get(&thing) else { continue };
            if (old.area, old.frame) == (surveyed.area, surveyed.frame) {
                continue;
            }
            let relations = derive(&world, &self.rules.relations, world.domain.profile)?;
            past.push(former(&relations, thing, Some(after.stamp.at.in_words())));
        }
        let around = self.around()?;
        let mut stays = reader.stays(surveyed, around.moment())?;
        let is_carried = around.holders.contains_key(&thing);
        // There it still is.
        stays.pop_if(|last| !is_carried && last.until.is_none());
        let (survey, later) = match stays.split_first() {
            Some((survey, later)) => (Some(survey), later),
            None => (None, &stays[..]),
        };
        let until = |stay: &Stay| stay.until.map(|at| at.in_words());
        if let Some(survey) = survey {
            past.push(former(self.surveyed()?.relations()?, thing, until(survey)));
        }
        for stay in later {
            let mut world = around.world().clone();
            if let Some(replica) = world.replicas.get_mut(&thing) {
                (replica.area, replica.frame) = (stay.place.area, stay.place.frame);
            }
            past.push(former(self.followed(&world)?.relations(), thing, until(stay)));
        }
        Ok(past)
    }
}

/// Where a thing is by the relations of another time, as where it was.
fn former(relations: &Relations, thing: ReplicaId, until: Option<String>) -> Past {
    let support = relations.support_of(thing);
    let inside = support.is_some_and(|support| relations.is_inside(thing, support));
    Past { until, area: relations.area_of(thing), support, inside }
}

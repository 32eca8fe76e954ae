//! A thing that is not in its place, and of which nothing is to be seen: it is noted, and looked for.

use crate::map::Entity;
use crate::reins::Reins;
use crate::semantics::predicate;
use crate::vehicle::Refusal;

use super::{Ending, GoalFact, Mission, MissionError, Surprise};

impl Mission<'_> {
    /// Looks for what proved now to be nowhere in view: in its room, where things of its kind lie, then everywhere. None
    /// where nothing was missed that was not missed before, and by rules that know no search.
    pub(super) fn look_for_missed(
        &mut self,
        surprise: &Surprise,
        reins: &mut Reins<'_>,
    ) -> Result<Option<Ending>, MissionError> {
        let Surprise::Refused { refusal: Refusal::NotThere(thing), seen: None } = surprise else {
            return Ok(None);
        };
        if !self.belief.miss(*thing) || self.domain.predicate(predicate::FOUND).is_none() {
            return Ok(None);
        }
        self.name_this_point();
        let name = self.belief.world.name(Entity::Replica(*thing)).to_owned();
        self.belief.sought.entry(name.clone()).or_default();
        let found = GoalFact { predicate: predicate::FOUND.to_owned(), args: vec![name] };
        self.attempt(&[found], reins).map(Some)
    }
}

//! Points of the floor from which a room is looked over that the map names no place of.

use std::collections::BTreeSet;

use crate::map::Entity;
use crate::semantics::planning::InitialFact;
use crate::semantics::predicate;
use crate::units::{AreaId, Deg, Gather as _, Pose};

use super::{Belief, IN_MIDDLE, Spot, is};

impl Belief {
    /// Names a point in each Area where something is to be looked for and of which these facts name none, in the middle of
    /// its largest Passframe; what is to be told of them.
    pub(crate) fn name_views(&mut self, facts: &[InitialFact]) -> Vec<InitialFact> {
        let of_place = |fact: &&InitialFact| is(fact, predicate::PLACE_IN);
        let named: BTreeSet<&str> =
            facts.iter().filter(of_place).map(|fact| fact.arguments[1].name.as_str()).gather();
        let may_be = self.sought.iter().flat_map(|(thing, past)| self.where_may_be(thing, past));
        let areas: BTreeSet<AreaId> =
            may_be.filter(|area| !named.contains(self.world.name(Entity::Area(*area)))).gather();
        let view = |area: AreaId| {
            let (map, _) = self.world.placement(area)?;
            let cells = self.floors.get(&map)?.passframes(area).iter();
            let largest = cells.max_by(|a, b| {
                a.polygon.signed_area().total_cmp(&b.polygon.signed_area()).then(b.id.cmp(&a.id))
            });
            let (at, heading) = (largest?.polygon.centroid(), Deg::ZERO);
            let name = format!("{IN_MIDDLE}{}", self.world.name(Entity::Area(area)));
            let is_new = !self.spots.iter().any(|spot| spot.name == name);
            is_new.then_some(Spot { name, area, pose: Pose { at, heading }, looks: false })
        };
        let views: Vec<Spot> = areas.into_iter().filter_map(view).collect();
        let told = views.iter().map(|spot| self.fact_of(spot)).collect();
        self.spots.extend(views);
        told
    }
}

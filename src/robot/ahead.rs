//! What the floor refuses for good of a plan for an order, asked before the proof begins.
//!
//! It is asked of what is left of a floor when all has gone that the robot can carry or push, or that somebody may take away,
//! and every door stands open: an action that even then has no way is none of the task, and the proof is of the rest. Where
//! that has no plan the whole task is planned as if nothing were known: trying that plan tells what bars its way. Whatever
//! else bars a way a rehearsal finds (`robot/mission/rehearsal`).
//!
//! **Invariant**: a task that has a plan without this has one with it.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::rc::Rc;

use crate::geometry::{Foothold, LastingFloor, PlacedReplica, Target};
use crate::graphplan::{Limits, Outcome, Plan};
use crate::map::{DoorStatus, Records, Replica, World};
use crate::semantics::Relations;
use crate::semantics::planning::PlanPlace;
use crate::strips::{Domain, Problem, Task};
use crate::units::{AreaId, Gather as _, MapId, OpeningId, ReplicaId, name_key};

use super::atlas::{At, Atlas};
use super::belief::Belief;
use super::directive::{Directive, Primitive};
use super::obstacle::is_obstacle;
use super::passable::{Found, Passable};
use super::timing::leave_out;

/// What stays of the floors that a mission is driven on; found once, and kept from plan to plan.
#[derive(Debug, Clone)]
pub(super) struct Lasting {
    /// As they were then.
    things: Records<ReplicaId, Replica>,
    staying: BTreeSet<ReplicaId>,
    floors: BTreeMap<MapId, LastingFloor>,
}

impl Lasting {
    /// `near` is how near to what bears it a thing lies, in cm.
    pub(super) fn of(belief: &Belief, near: f64) -> Self {
        let (world, floors) = (&belief.world, belief.floors());
        let scenes = floors.values().flat_map(|floor| floor.scene().replicas.values());
        let staying = staying(world, &scenes.collect::<Vec<_>>(), near);
        let lasting =
            |(&map, floor)| (map, LastingFloor::of(floor, world, |thing| staying.contains(&thing)));
        let floors = floors.iter().map(lasting).gather();
        Self { things: world.replicas.clone(), staying, floors }
    }

    /// Whether all that was to stay is still believed to be where it was.
    pub(super) fn holds(&self, belief: &Belief) -> bool {
        let changes = self.things.changes(&belief.world.replicas);
        !changes.iter().any(|(thing, ..)| self.staying.contains(thing))
    }
}

/// The things that nobody takes away: not by themselves, and not with what they lie on or in.
fn staying(world: &World, things: &[&PlacedReplica], near: f64) -> BTreeSet<ReplicaId> {
    let goes = |thing: &PlacedReplica| {
        let is_moved = world.replicas.get(&thing.id).is_none_or(|known| known.move_prob > 0);
        let is_meant_to = |wanted| world.has_trait(thing.id, wanted);
        is_moved || is_obstacle(thing.id) || ["portable", "movable"].into_iter().any(is_meant_to)
    };
    let (mut open, mut left): (Vec<&PlacedReplica>, Vec<_>) =
        things.iter().copied().partition(|thing| goes(thing));
    while let Some(lower) = open.pop() {
        let about = lower.bounds.grown(near);
        let goes_along = |thing: &PlacedReplica| {
            let is_over = thing.bottom > lower.bottom && thing.bottom <= lower.top + near;
            let is_in = about.contains(thing.bounds.min) && about.contains(thing.bounds.max);
            thing.bounds.meets(&about) && (is_over || is_in && thing.bottom <= lower.top + near)
        };
        open.extend(left.extract_if(.., |thing| goes_along(thing)));
    }
    left.into_iter().map(|thing| thing.id).gather()
}

/// The floor before a proof.
pub(super) struct Ahead<'m> {
    pub(super) belief: &'m Belief,
    pub(super) relations: &'m Relations,
    pub(super) places: &'m [PlanPlace],
    pub(super) lasting: &'m mut Lasting,
}

impl Ahead<'_> {
    /// Leaves out of a task what the floor refuses for good; the whole task where that is something.
    fn bar(&mut self, domain: &Domain, task: &mut Task) -> Option<Task> {
        let belief = self.belief;
        let mut atlas = Atlas::of(&belief.world, self.relations, self.places.to_vec());
        atlas.learn(&belief.spots);
        let (floor, at) = (belief.floor(), belief.pose.at);
        let mut zones = floor.zones().iter();
        let is_shut_in = zones.any(|zone| zone.kind.is_shut() && zone.contains(at, floor.reach()));
        let mut survey = Survey {
            belief,
            atlas,
            lasting: self.lasting,
            footholds: HashMap::new(),
            shut_in: is_shut_in.then_some(belief.area),
        };
        let doubted = survey.doubted();
        if doubted.is_empty() {
            return None;
        }
        let whole = task.clone();
        leave_out(task, |task, id| {
            let operator = task.operator(id);
            operator.args.iter().any(|name| doubted.contains(&**name))
                && survey.refuses(&Directive::of(domain, task, operator))
        });
        (task.operators.len() < whole.operators.len()).then_some(whole)
    }
}

impl Passable for Ahead<'_> {
    fn search(
        &mut self,
        (domain, _): (&Domain, &Problem),
        task: &mut Task,
        _: &Limits,
        search: &mut dyn FnMut(&Task) -> Outcome,
    ) -> Found {
        let whole = self.bar(domain, task);
        let outcome = search(task);
        match (whole, &outcome) {
            (Some(whole), Outcome::NoPlan { .. }) => {
                *task = whole;
                (search(task), Vec::new())
            }
            _ => (outcome, Vec::new()),
        }
    }

    /// The rest is for the rehearsal to say.
    fn lets_pass(&mut self, _: (&Domain, &Problem), _: &Task, _: &Plan, _: &Limits) -> bool {
        true
    }
}

/// Names held against the floor.
struct Survey<'s> {
    belief: &'s Belief,
    atlas: Atlas,
    lasting: &'s mut Lasting,
    footholds: HashMap<At, Option<Rc<Foothold>>>,
    /// The room where the robot stands in a zone that is to be kept out of.
    shut_in: Option<AreaId>,
}

impl Survey<'_> {
    /// The names of places and doors that something may bar for good, in a room or on the way to the next: an action that
    /// speaks of none of them has its way.
    fn doubted(&mut self) -> HashSet<String> {
        let (belief, mut doubted) = (self.belief, HashSet::new());
        for (&map, now) in belief.floors() {
            let Some(lasting) = self.lasting.floors.get(&map) else { continue };
            let barred: Vec<OpeningId> = lasting.barred(now).map(|way| way.id).collect();
            let named = self.atlas.joins.iter();
            let named = named.filter(|join| join.id.is_some_and(|id| barred.contains(&id)));
            doubted.extend(named.map(|join| join.opening.clone()));
            for area in lasting.parted(now).collect::<Vec<_>>() {
                let spots = self.atlas.spots_in(area);
                let spots: Vec<(String, At)> = spots.map(|(n, at)| (n.to_owned(), at)).collect();
                // The largest piece of its floor.
                let most = now.rests_in(area).first().map(|at| Target::Point(*at));
                let most = self.foothold(area, map, most);
                for (name, spot) in spots {
                    let leads = self.find(&spot, area, map).and_then(|spot| {
                        let lasting = self.lasting.floors.get_mut(&map)?;
                        Some(lasting.may_lead(now, most.as_ref()?, &spot))
                    });
                    if leads == Some(false) {
                        doubted.insert(name);
                    }
                }
            }
        }
        doubted
    }

    fn refuses(&mut self, directive: &Directive) -> bool {
        directive.primitives().iter().any(|primitive| match primitive {
            Primitive::GoToPlace(_) | Primitive::GoToDoor(_) | Primitive::Cross { .. } => {
                self.has_no_way(directive, primitive).unwrap_or_default()
            }
            Primitive::SetDoor { door, status: DoorStatus::Open } => self.jams(door),
            _ => false,
        })
    }

    /// None where a name is not known, or the floor says nothing.
    fn has_no_way(&mut self, directive: &Directive, primitive: &Primitive) -> Option<bool> {
        let (from, to) = self.atlas.drive_of(directive, primitive).ok()?;
        let areas = [self.atlas.area_of(&from).ok()?, self.atlas.area_of(&to).ok()?];
        let [here, there] = areas.map(|area| self.belief.world.placement(area).map(|at| at.0));
        // A room that is shut as a whole the robot leaves all the same.
        let map = here.filter(|_| here == there && self.shut_in != Some(areas[0]))?;
        let (from, to) = (self.find(&from, areas[0], map)?, self.find(&to, areas[1], map)?);
        let (lasting, now) = (self.lasting.floors.get_mut(&map)?, self.belief.floor_of(map)?);
        Some(!lasting.may_lead(now, &from, &to))
    }

    fn find(&mut self, spot: &At, area: AreaId, map: MapId) -> Option<Rc<Foothold>> {
        if let Some(known) = self.footholds.get(spot) {
            return known.clone();
        }
        let (world, now) = (&self.belief.world, self.belief.floor_of(map)?);
        let target = self.atlas.target_of(world, now, spot).ok().flatten();
        let found = self.foothold(area, map, target).map(Rc::new);
        self.footholds.insert(spot.clone(), found.clone());
        found
    }

    fn foothold(&self, area: AreaId, map: MapId, target: Option<Target>) -> Option<Foothold> {
        let (now, lasting) = (self.belief.floor_of(map)?, self.lasting.floors.get(&map)?);
        Some(lasting.foothold(now, &self.belief.world, area, target))
    }

    /// Whether something that stays stops the leaves of a door.
    fn jams(&mut self, door: &str) -> bool {
        let (world, key) = (&self.belief.world, name_key(door));
        let Some(join) = self.atlas.joins_named(&key).next() else { return false };
        let map = world.placement(join.from).map(|(map, _)| map);
        let lasting = map.and_then(|map| self.lasting.floors.get_mut(&map));
        let (Some(door), Some(lasting)) = (join.door, lasting) else { return false };
        !lasting.swings(world, door)
    }
}

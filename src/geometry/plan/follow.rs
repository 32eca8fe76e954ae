//! A floor follows its world: things that were moved, doors in other states, zones that begin and end. What an edit of the
//! building changes is followed in `edited.rs`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::Bounds;
use crate::map::{DoorState, Object, Replica, World, Zone};
use crate::opening::Opening;
use crate::scene::PlacedReplica;
use crate::site::DoorStates;
use crate::units::{AreaId, DoorId, Frame, Gather as _, ReplicaId};
use crate::zone::{placed, shut_otherwise};

use super::FloorPlan;
use super::built::build_all;

impl FloorPlan {
    /// Takes over what the world now says of some replicas (moved, turned, put there or taken away), and builds
    /// anew the Fragments that they touch or touched.
    pub fn rebuild(&mut self, world: &World, replicas: &[ReplicaId]) {
        let mut touched = Vec::new();
        let frame_of = |area: &AreaId| self.scene.areas.get(area).map(|area| area.frame);
        let placed = Self::place(world, replicas, frame_of);
        let scene = Arc::make_mut(&mut self.scene);
        let index = Arc::make_mut(&mut self.index);
        for (id, placed) in placed {
            if let Some(gone) = scene.replicas.remove(&id) {
                index.remove(&gone);
                touched.push(gone.reach().grown(0.2));
            }
            if let Some(placed) = placed {
                index.insert(&placed);
                touched.push(placed.reach().grown(0.2));
                scene.replicas.insert(id, placed);
            }
        }
        let stale = self.near(&touched);
        self.renew(world, &stale);
    }

    /// Replicas as they stand on the Map, whose Areas have these frames there.
    pub(crate) fn place<'r>(
        world: &World,
        replicas: impl IntoIterator<Item = &'r ReplicaId>,
        frame_of: impl Fn(&AreaId) -> Option<Frame>,
    ) -> BTreeMap<ReplicaId, Option<PlacedReplica>> {
        let placed = |id: ReplicaId| {
            let replica = world.replicas.get(&id)?;
            let frame = frame_of(&replica.area)?;
            Some(PlacedReplica::new(world, id, frame.compose(&replica.frame)))
        };
        replicas.into_iter().map(|&id| (id, placed(id))).gather()
    }

    /// The same floor with those zones of the world in force that are wanted, and no others.
    #[must_use]
    pub fn with_zones(&self, world: &World, is_wanted: impl Fn(&Zone) -> bool) -> Self {
        let mut plan = self.clone();
        let before = std::mem::take(&mut plan.zones);
        let after = placed(world, &plan.scene, plan.map, is_wanted);
        let touched = shut_otherwise(&before, &after);
        plan.zones = Arc::new(after);
        let stale = plan.near(&touched);
        if !stale.is_empty() {
            plan.renew(world, &stale);
        }
        plan
    }

    /// The Areas on whose floors it tells what lies in some boxes.
    pub(crate) fn near(&self, touched: &[Bounds]) -> Vec<AreaId> {
        let reach = self.reach();
        let mut stale: Vec<AreaId> = Vec::new();
        for zone in touched {
            // A Fragment sees through its doorways as far as their mouths are deep.
            for fragment in self.fragments_near(&zone.grown(reach + 5.0)) {
                let mut mouths = self.doorways.by_area.of(fragment.area).iter();
                let prisms = &self.scene.areas[&fragment.area].prisms;
                if prisms.iter().any(|p| p.bounds.meets(zone))
                    || mouths.any(|&(d, _)| self.doorways.ways[d].mouth(reach).meets(zone))
                {
                    stale.push(fragment.area);
                }
            }
        }
        stale.sort_unstable();
        stale.dedup();
        stale
    }

    /// The same floor with doors in other states: those in `states` as given, the others as before.
    #[must_use]
    pub fn with_doors(&self, world: &World, states: &DoorStates) -> Self {
        let mut plan = self.clone();
        plan.set_doors(world, world, states);
        plan
    }

    pub(crate) fn set_doors(&mut self, before: &World, after: &World, states: &DoorStates) {
        let differs =
            |(door, state): &(&DoorId, &DoorState)| self.door_state(before, **door) != **state;
        let mut stale = Vec::new();
        for (&door, _) in states.iter().filter(differs) {
            for doorway in self.doorways.ways.iter().filter(|d| d.door == Some(door)) {
                stale.extend(doorway.areas);
                // The leaf may stand before a neighbour's door.
                stale.extend(self.next_to(doorway));
            }
        }
        self.states.extend(states);
        if stale.is_empty() {
            return;
        }
        stale.sort_unstable();
        stale.dedup();
        self.renew(after, &stale);
    }

    /// Follows a world from one state to another that differs in its replicas and the states of its doors alone.
    pub fn follow(&mut self, before: &World, after: &World) {
        let has = |replica: Option<&Replica>| {
            replica.is_some_and(|replica| self.scene.areas.contains_key(&replica.area))
        };
        // A thing may leave one Map for another: each takes over what is said of its own.
        let changes = before.replicas.changes(&after.replicas).into_iter();
        let mut changed: BTreeSet<ReplicaId> =
            changes.filter(|(_, was, is)| has(*was) || has(*is)).map(|(id, ..)| id).gather();
        let doors = before.doors.changes(&after.doors).into_iter();
        let doors: DoorStates = doors.filter_map(|(id, _, is)| Some((id, is?.state))).gather();
        if !doors.is_empty() {
            // Doors of furniture stand as they do on every replica that does not say otherwise.
            let moves =
                |object: &&Object| object.doors.iter().any(|mount| doors.contains_key(&mount.door));
            let hung: BTreeSet<_> = after.objects.values().filter(moves).map(|o| o.id).gather();
            if !hung.is_empty() {
                let bearing = after.replicas.values().filter(|r| hung.contains(&r.object));
                changed.extend(bearing.filter(|r| has(Some(r))).map(|r| r.id));
            }
        }
        if !changed.is_empty() {
            self.rebuild(after, &changed.into_iter().collect::<Vec<_>>());
        }
        if !doors.is_empty() {
            self.set_doors(before, after, &doors);
        }
    }

    /// The Areas behind other doorways close to this one.
    pub(crate) fn next_to(&self, doorway: &Opening) -> Vec<AreaId> {
        let zone = Bounds::of([doorway.middle()]).grown(
            2.0 * doorway.width() + 3.0 * (self.robot.radius.get() + self.robot.clearance.get()),
        );
        self.doorways
            .ways
            .iter()
            .filter(|d| zone.grown(d.width()).contains(d.middle()))
            .flat_map(|d| d.areas)
            .collect()
    }

    pub(crate) fn renew(&mut self, world: &World, stale: &[AreaId]) {
        let fresh: Vec<_> = self.with_site(world, |site| build_all(site, stale));
        for floor in fresh {
            if let Some(number) = self.number(floor.area) {
                self.fragments[number] = floor;
            }
        }
        let numbers: Vec<usize> = stale.iter().filter_map(|&a| self.number(a)).collect();
        self.connect(world, numbers);
    }
}

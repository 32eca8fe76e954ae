//! The smallest change that would open a way (W5): a door to open, an open leaf to shut, a thing to push aside and by
//! how much, things to take away.
//!
//! Changes are tried on a copy of the plan, so that what is answered is known to work. What takes the least effort
//! comes first. A push leads over the floor: not through a wall, nor through another thing.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use crate::map::{DoorKind, DoorState, World};
use crate::units::{AreaId, DoorId, Frame, Gather as _, Point, ReplicaId, Vector};

use super::Polygon;
use super::blocked::{Barrier, NoRoute};
use super::blocker::Blocker;
use super::leaf::{Strike, opening_of};
use super::plan::FloorPlan;
use super::route::Target;
use super::scene::{PlacedReplica, Prism};
use super::site::DoorStates;

/// What would have to change.
#[derive(Debug, Clone, PartialEq)]
pub enum Remedy {
    Open(Vec<DoorId>),
    /// Push a thing by a displacement in the Map's frame, in cm, once these doors are open.
    Move {
        replica: ReplicaId,
        by: Vector,
        open: Vec<DoorId>,
    },
    /// Shut a door whose open leaf stands in the way: one between Areas, or one of a thing such as a wardrobe.
    Shut {
        door: DoorId,
        of: Option<ReplicaId>,
        open: Vec<DoorId>,
    },
    /// Take things away that no single push brings out of the way; none of them may stay.
    Remove {
        replicas: Vec<ReplicaId>,
        open: Vec<DoorId>,
    },
}

/// Pushes are told apart by this, in cm: what is said is rounded to it.
const STEP: f64 = 1.0;

impl FloorPlan {
    /// The smallest change that opens a way where [`FloorPlan::route`] found none: doors that only need opening
    /// before things that need pushing, and the shortest push of the things that may move, by no more than `farthest`, in cm.
    #[must_use]
    pub fn remedy(
        &self,
        world: &World,
        from: Point,
        target: Target,
        no: &NoRoute,
        farthest: f64,
    ) -> Option<Remedy> {
        // Of a zone nobody makes the robot a way by moving something.
        if no.barriers().iter().any(|barrier| matches!(barrier, Barrier::Zone { .. })) {
            return None;
        }
        let doors = self.openable(world, no);
        let (opened, struck) = self.with_open(world, &doors);
        if !doors.is_empty() && opened.leads(world, from, target) {
            return Some(Remedy::Open(doors));
        }
        // Doors that strike a thing are tried anew with every change.
        let jammed: &[DoorId] = if struck.is_empty() { &[] } else { &doors };
        if let Some((door, of)) = opened.shut(world, (from, target), no) {
            return Some(Remedy::Shut { door, of, open: doors });
        }
        let mut named = movable(world, no);
        named.extend(may_move(world, struck.into_iter()));
        let places = (from, target);
        let things = opened.worth_pushing(world, places, jammed, &named);
        let push = opened.shortest_push(world, places, (jammed, &things), farthest);
        if let Some((replica, by)) = push {
            return Some(Remedy::Move { replica, by, open: doors });
        }
        let replicas = opened.removal(world, places, jammed, &named)?;
        Some(Remedy::Remove { replicas, open: doors })
    }

    /// The floor after a change that [`FloorPlan::remedy`] names, which is made in the world as well.
    #[must_use]
    pub fn remedied(&self, world: &mut World, remedy: &Remedy) -> Self {
        let (Remedy::Open(open)
        | Remedy::Move { open, .. }
        | Remedy::Shut { open, .. }
        | Remedy::Remove { open, .. }) = remedy;
        let mut states = DoorStates::new();
        let mut changed: Vec<ReplicaId> = Vec::new();
        match remedy {
            Remedy::Open(_) => {}
            Remedy::Move { replica, by, .. } => {
                let home =
                    world.replicas.get(replica).and_then(|r| self.scene().areas.get(&r.area));
                let turn = home.map(|h| h.frame);
                if let (Some(turn), Some(thing)) = (turn, world.replicas.get_mut(replica)) {
                    thing.frame = pushed(&thing.frame, &turn, *by);
                }
                changed.push(*replica);
            }
            Remedy::Shut { door, of: None, .. } => {
                states.insert(*door, DoorState::CLOSED);
            }
            Remedy::Shut { door, of: Some(replica), .. } => {
                if let Some(thing) = world.replicas.get_mut(replica) {
                    thing.door_states.insert(*door, DoorState::CLOSED);
                }
                changed.push(*replica);
            }
            Remedy::Remove { replicas, .. } => {
                replicas.iter().for_each(|id| drop(world.replicas.remove(id)));
                changed.clone_from(replicas);
            }
        }
        let mut plan =
            if states.is_empty() { self.clone() } else { self.with_doors(world, &states) };
        plan.rebuild(world, &changed);
        plan.with_open(world, open).0
    }

    /// The floor with doors open as far as their leaves go, and what they strike.
    fn with_open(&self, world: &World, doors: &[DoorId]) -> (Self, Vec<Blocker>) {
        if doors.is_empty() {
            return (self.clone(), Vec::new());
        }
        let mut struck = Vec::new();
        let state = |&door: &DoorId| {
            let first = self.strike(world, door);
            struck.extend(first.map(|s| s.against));
            let opening = first.map_or(100.0, |s| s.opening);
            (door, DoorState { opening, ..DoorState::OPEN })
        };
        let states: DoorStates = doors.iter().map(state).gather();
        (self.with_doors(world, &states), struck)
    }

    /// Whether a robot whose centre stands here can open a door all the way: its leaves strike nothing, and not the robot.
    #[must_use]
    pub fn opens_from(&self, world: &World, door: DoorId, at: Point) -> bool {
        /// Contacts shallower than this are rounding, cm.
        const SKIN: f64 = 0.01;
        let Some(model) = world.doors.get(&door) else { return false };
        let openings = (opening_of(self.door_state(world, door)), 100.0);
        let radius = self.robot().radius.get() - SKIN;
        let strikes_robot = self.doorways_of(door).any(|doorway| {
            let leaves = doorway.leaves(model);
            let mut ways =
                leaves.swept(openings).into_iter().chain(leaves.obstacles(DoorState::OPEN));
            ways.any(|way| way.contains(at, radius))
        });
        !strikes_robot && self.strike(world, door).is_none()
    }

    /// What a door's leaves strike first on their way to standing wide open.
    #[must_use]
    pub fn struck_by(&self, world: &World, door: DoorId) -> Option<Blocker> {
        self.strike(world, door).map(|strike| strike.against)
    }

    /// What a door's leaves strike first when it is opened: things, and leaves of other doors.
    fn strike(&self, world: &World, door: DoorId) -> Option<Strike<Blocker>> {
        let model = world.doors.get(&door)?;
        let from = opening_of(self.door_state(world, door));
        let strikes = self.doorways_of(door).filter_map(|doorway| {
            let own = doorway.leaves(model);
            let space = own.space(self.fragment(doorway.areas[0]).map_or(0.0, |f| f.level));
            let areas = doorway.areas.into_iter();
            let things = areas.flat_map(|area| self.scene().replicas_in(area)).flat_map(|r| {
                let of = move |p: &Prism| Blocker::Replica { replica: r.id, item: p.item };
                let met = r.prisms.iter().filter(move |p| space.meets(p));
                met.map(move |p| (of(p), p.polygon.clone()))
            });
            let leaves = self.fragments_near(&space.near).flat_map(|f| f.obstacles());
            let leaves = leaves.filter_map(|o| match o.blocker {
                Blocker::DoorLeaf { door: other, .. } if other != door => {
                    Some((o.blocker, o.polygon.clone()))
                }
                _ => None,
            });
            let solids: Vec<(Blocker, Polygon)> = things.chain(leaves).collect();
            let bodies = solids.iter().map(|(of, body)| (*of, body));
            own.strikes((from, 100.0), bodies)
        });
        strikes.min_by(|a, b| a.opening.total_cmp(&b.opening))
    }

    /// The doors in the way that are shut, or not as wide open as they go.
    fn openable(&self, world: &World, no: &NoRoute) -> Vec<DoorId> {
        let is_ajar = |door: &DoorId| {
            let opens = world.doors.get(door).is_some_and(|d| d.kind != DoorKind::Passage);
            opens && opening_of(self.door_state(world, *door)) < 100.0
        };
        let mut doors: Vec<DoorId> = Vec::new();
        for barrier in no.barriers() {
            match *barrier {
                Barrier::Door { door, .. } => doors.push(door),
                Barrier::Narrow { door: Some(door), .. } if is_ajar(&door) => doors.push(door),
                // A leaf that is ajar parts what lies behind it from its own room.
                _ => doors.extend(blockers_of(barrier).filter_map(|b| match b {
                    Blocker::DoorLeaf { door, .. } => Some(door).filter(is_ajar),
                    _ => None,
                })),
            }
        }
        let mut seen = BTreeSet::new();
        doors.retain(|&door| seen.insert(door));
        doors
    }

    /// What may be pushed: of what stands at any gap between here and there, at the widest first, and of what is named in
    /// the way, the things without which there is a way. Wherever any other is pushed, there is none.
    fn worth_pushing(
        &self,
        world: &World,
        (from, target): (Point, Target),
        jammed: &[DoorId],
        named: &BTreeSet<ReplicaId>,
    ) -> Vec<ReplicaId> {
        let gaps = self.between(world, from, target);
        let beside = gaps.iter().flat_map(|gap| may_move(world, blockers_of(gap)));
        let mut seen = BTreeSet::new();
        let once = beside.chain(named.iter().copied()).filter(|&id| seen.insert(id));
        let helps = |&id: &ReplicaId| {
            // Without the goal there is no way to it.
            target == Target::Replica(id)
                || self.leads_without(world, (from, target), jammed, &[id])
        };
        once.filter(helps).collect()
    }

    /// Whether there is a way once some things are gone.
    fn leads_without(
        &self,
        world: &World,
        (from, target): (Point, Target),
        jammed: &[DoorId],
        gone: &[ReplicaId],
    ) -> bool {
        let mut trial = world.clone();
        gone.iter().for_each(|id| drop(trial.replicas.remove(id)));
        let mut plan = self.clone();
        plan.rebuild(&trial, gone);
        plan.with_open(&trial, jammed).0.leads(&trial, from, target)
    }

    /// The first door among those in the way that opens it when it is shut, and the thing that it belongs to.
    fn shut(
        &self,
        world: &World,
        (from, target): (Point, Target),
        no: &NoRoute,
    ) -> Option<(DoorId, Option<ReplicaId>)> {
        let leaves: BTreeSet<_> = blockers(no)
            .filter_map(|b| match b {
                Blocker::DoorLeaf { door, .. } => Some((door, None)),
                Blocker::ReplicaLeaf { door, replica, .. } => Some((door, Some(replica))),
                _ => None,
            })
            .gather();
        leaves.into_iter().find(|&(door, of)| match of {
            None => {
                let shut = self.with_doors(world, &DoorStates::from([(door, DoorState::CLOSED)]));
                shut.leads(world, from, target)
            }
            Some(replica) => {
                let mut trial = world.clone();
                let Some(thing) = trial.replicas.get_mut(&replica) else { return false };
                thing.door_states.insert(door, DoorState::CLOSED);
                let mut plan = self.clone();
                plan.rebuild(&trial, &[replica]);
                plan.leads(&trial, from, target)
            }
        })
    }

    /// The things to take away so that a way opens: one if one will do, else none too many. The goal itself stays.
    fn removal(
        &self,
        world: &World,
        (from, target): (Point, Target),
        jammed: &[DoorId],
        things: &BTreeSet<ReplicaId>,
    ) -> Option<Vec<ReplicaId>> {
        let opens = |gone: &[ReplicaId]| self.leads_without(world, (from, target), jammed, gone);
        let mut gone: Vec<ReplicaId> =
            things.iter().copied().filter(|&id| target != Target::Replica(id)).collect();
        if let Some(&one) = gone.iter().find(|&&id| opens(&[id])) {
            return Some(vec![one]);
        }
        if gone.is_empty() || !opens(&gone) {
            return None;
        }
        for id in gone.clone() {
            let fewer: Vec<ReplicaId> = gone.iter().copied().filter(|&g| g != id).collect();
            if opens(&fewer) {
                gone = fewer;
            }
        }
        Some(gone)
    }

    /// The shortest push of one of the things that opens the way, in sixteen directions from its Area's own axes: along
    /// the walls, and between.
    fn shortest_push(
        &self,
        world: &World,
        (from, target): (Point, Target),
        (jammed, things): (&[DoorId], &[ReplicaId]),
        farthest: f64,
    ) -> Option<(ReplicaId, Vector)> {
        let (mut trial, mut plan) = (world.clone(), self.clone());
        // The thing that the plan has elsewhere than the world.
        let mut pushed_last: Option<ReplicaId> = None;
        // Where a thing was stopped nothing pushes it further.
        let mut stopped: BTreeSet<(ReplicaId, u8)> = BTreeSet::new();
        let steps = (farthest / STEP) as usize;
        for (step, &id) in (1..=steps).flat_map(|step| things.iter().map(move |id| (step, id))) {
            let Some(own) = world.replicas.get(&id) else { continue };
            let Some(home) = self.scene().areas.get(&own.area).map(|area| area.frame) else {
                continue;
            };
            // What it stands in from the first does not stop it on its way out.
            let within = self.met_by(world, id, own.area);
            for turn in (0..16).filter(|turn| !stopped.contains(&(id, *turn))).collect::<Vec<_>>() {
                let angle = home.angle.radians() + f64::from(turn) * PI / 8.0;
                let by = Vector::new(angle.cos(), angle.sin()) * (STEP * step as f64);
                trial.replicas.get_mut(&id)?.frame = pushed(&own.frame, &home, by);
                match self.met_by(&trial, id, own.area) {
                    Some(met) if met.is_empty() => {}
                    Some(met) if within.as_ref().is_some_and(|own| met.is_subset(own)) => continue,
                    _ => {
                        stopped.insert((id, turn));
                        continue;
                    }
                }
                let changed: Vec<ReplicaId> =
                    pushed_last.replace(id).into_iter().chain([id]).collect();
                plan.rebuild(&trial, &changed);
                let opens = if jammed.is_empty() {
                    plan.leads(&trial, from, target)
                } else {
                    plan.with_open(&trial, jammed).0.leads(&trial, from, target)
                };
                if opens {
                    return Some((id, by));
                }
            }
            trial.replicas.get_mut(&id)?.frame = own.frame;
        }
        None
    }

    /// The things that one stands in, as it stands in `trial`; none where it is not on its Area's floor.
    fn met_by(
        &self,
        trial: &World,
        replica: ReplicaId,
        area: AreaId,
    ) -> Option<BTreeSet<ReplicaId>> {
        let home = self.scene().areas.get(&area)?;
        let frame = home.frame.compose(&trial.replicas[&replica].frame);
        let placed = super::PlacedReplica::new(trial, replica, frame);
        let mut corners = placed.prisms.iter().flat_map(|p| p.polygon.corners.iter());
        let on_floor =
            corners.all(|&c| home.prisms.iter().any(|base| base.polygon.contains(c, 1e-6)));
        let is_met = |other: &&PlacedReplica| {
            other.bounds.meets(&placed.bounds)
                && other.prisms.iter().any(|q| {
                    placed.prisms.iter().any(|p| {
                        let aside = p.bottom >= q.top || q.bottom >= p.top;
                        !aside && super::apart::distance(&p.polygon, &q.polygon) <= 0.0
                    })
                })
        };
        let others = self.scene().replicas_in(area).filter(|other| other.id != replica);
        on_floor.then(|| others.filter(is_met).map(|other| other.id).collect())
    }
}

/// A replica's frame in its Area's own, which lies as `home` on the Map, after a push in the Map's frame.
fn pushed(own: &Frame, home: &Frame, by: Vector) -> Frame {
    let (sin, cos) = home.angle.sin_cos();
    let local = Vector::new(by.x * cos + by.y * sin, by.y * cos - by.x * sin);
    Frame::new(own.x.get() + local.x, own.y.get() + local.y, own.z.get(), own.angle)
}

/// What stands in the way, as far as it is known by name.
fn blockers(no: &NoRoute) -> impl Iterator<Item = Blocker> + '_ {
    no.barriers().iter().flat_map(blockers_of)
}

fn blockers_of(barrier: &Barrier) -> impl Iterator<Item = Blocker> + '_ {
    let named = match barrier {
        Barrier::Gap { between, .. } => &between[..],
        Barrier::Enclosed { by, .. } => &by[..],
        _ => &[],
    };
    named.iter().copied()
}

/// The things among what stands in the way that may be moved at all.
fn may_move<'a>(
    world: &'a World,
    blockers: impl Iterator<Item = Blocker> + 'a,
) -> impl Iterator<Item = ReplicaId> + 'a {
    let things = blockers.filter_map(|b| match b {
        Blocker::Replica { replica, .. } | Blocker::ReplicaLeaf { replica, .. } => Some(replica),
        _ => None,
    });
    things.filter(|id| world.replicas.get(id).is_some_and(|r| r.move_prob > 0))
}

fn movable(world: &World, no: &NoRoute) -> BTreeSet<ReplicaId> {
    may_move(world, blockers(no)).gather()
}

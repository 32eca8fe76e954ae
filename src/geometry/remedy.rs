//! The smallest change that would open a way (W5): a door to open, or a thing to push aside and by how much.
//!
//! Changes are tried on a copy of the plan, so that what is answered is known to work.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use crate::map::{DoorState, World};
use crate::units::{AreaId, DoorId, Frame, Point, ReplicaId, Vector};

use super::blocked::{Barrier, NoRoute};
use super::obstacle::Blocker;
use super::plan::{DoorStates, FloorPlan};
use super::route::{Method, Target};

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
}

/// Nobody pushes furniture further than this for a robot, in cm.
const FURTHEST: f64 = 120.0;
/// Pushes are told apart by this, in cm.
const STEP: f64 = 2.0;

impl FloorPlan {
    /// The smallest change that opens a way where [`FloorPlan::route`] found none: doors that only need opening
    /// before things that need pushing, and the shortest push of the things that may move.
    #[must_use]
    pub fn remedy(
        &self,
        world: &World,
        from: Point,
        target: Target,
        no: &NoRoute,
    ) -> Option<Remedy> {
        let doors: Vec<DoorId> = no
            .barriers()
            .iter()
            .filter_map(|b| match b {
                Barrier::Door { door, .. } => Some(*door),
                _ => None,
            })
            .collect();
        let open: DoorStates = doors.iter().map(|&d| (d, DoorState::OPEN)).collect();
        let opened = if doors.is_empty() { self.clone() } else { self.with_doors(world, &open) };
        if !doors.is_empty() && opened.route(world, from, target, Method::Shortest).is_ok() {
            return Some(Remedy::Open(doors));
        }
        let mut best: Option<(f64, Remedy)> = None;
        for replica in movable(world, no) {
            let limit = best.as_ref().map_or(FURTHEST, |b| b.0 - STEP);
            if let Some((way, by)) = opened.shortest_push(world, from, target, replica, limit) {
                best = Some((way, Remedy::Move { replica, by, open: doors.clone() }));
            }
        }
        best.map(|b| b.1)
    }

    /// The shortest push of one thing that opens the way, in sixteen directions.
    fn shortest_push(
        &self,
        world: &World,
        from: Point,
        target: Target,
        replica: ReplicaId,
        limit: f64,
    ) -> Option<(f64, Vector)> {
        let area = world.replicas.get(&replica)?.area;
        let home = self.scene().areas.get(&area)?.frame;
        let mut trial = world.clone();
        let mut plan = self.clone();
        for k in 1..=((limit / STEP).floor().max(0.0) as usize) {
            for turn in 0..16 {
                let angle = f64::from(turn) * PI / 8.0;
                let by = Vector::new(angle.cos(), angle.sin()) * (STEP * k as f64);
                let moved = trial.replicas.get_mut(&replica)?;
                let own = &world.replicas[&replica].frame;
                let (sin, cos) = home.angle.sin_cos();
                let local = Vector::new(by.x * cos + by.y * sin, by.y * cos - by.x * sin);
                moved.frame = Frame::new(
                    own.x.get() + local.x,
                    own.y.get() + local.y,
                    own.z.get(),
                    own.angle,
                );
                if !self.has_room(&trial, replica, area) {
                    continue;
                }
                plan.rebuild(&trial, &[replica]);
                if plan.route(&trial, from, target, Method::Shortest).is_ok() {
                    return Some((STEP * k as f64, by));
                }
            }
        }
        None
    }

    /// Whether a thing, as it stands in `trial`, is on its Area's floor and in nothing else.
    fn has_room(&self, trial: &World, replica: ReplicaId, area: AreaId) -> bool {
        let Some(home) = self.scene().areas.get(&area) else { return false };
        let frame = home.frame.compose(&trial.replicas[&replica].frame);
        let placed = super::PlacedReplica::new(trial, replica, frame);
        let corners = placed.prisms.iter().flat_map(|p| p.polygon.corners.iter());
        let on_floor =
            corners.clone().all(|&c| home.prisms.iter().any(|base| base.polygon.contains(c, 1e-6)));
        on_floor
            && self.scene().replicas_in(area).filter(|r| r.id != replica).all(|other| {
                !other.bounds.meets(&placed.bounds)
                    || other.prisms.iter().all(|q| {
                        placed.prisms.iter().all(|p| {
                            let aside = p.bottom >= q.top || q.bottom >= p.top;
                            aside || super::doors::distance(&p.polygon, &q.polygon) > 0.0
                        })
                    })
            })
    }
}

/// The things in the way that may be moved at all.
fn movable(world: &World, no: &NoRoute) -> BTreeSet<ReplicaId> {
    let blockers = no.barriers().iter().flat_map(|b| match b {
        Barrier::Gap { between, .. } => between.clone(),
        Barrier::Enclosed { by, .. } => by.clone(),
        _ => Vec::new(),
    });
    blockers
        .filter_map(|b| match b {
            Blocker::Replica { replica, .. } | Blocker::ReplicaLeaf { replica, .. } => {
                Some(replica)
            }
            _ => None,
        })
        .filter(|id| world.replicas.get(id).is_some_and(|r| r.move_prob > 0))
        .collect()
}

//! Things that may be gone from where they are believed to be: they bar no way until they are seen or met.
//!
//! **Invariant**: what is lost is in neither the world nor the hand, and comes back as it was, or as it is seen.

use crate::map::Replica;
use crate::obstacle::is_obstacle;
use crate::units::{AreaId, Frame, Point, ReplicaId};

use super::{Belief, Lost};

impl Belief {
    /// A thing stands no more where it was believed to, as far as anybody knows.
    pub(crate) fn lose(&mut self, id: ReplicaId) {
        let stood = self.scene().replicas.get(&id).map(|placed| placed.bounds);
        let Some(thing) = self.world.replicas.remove(&id) else { return };
        if !is_obstacle(id) {
            self.lost.insert(id, Lost { thing, stood });
        }
        self.rebuild(&[id]);
    }

    /// A lost thing was seen; whether it was lost.
    pub(super) fn regain(&mut self, id: ReplicaId, area: AreaId, frame: Frame) -> bool {
        let Some(lost) = self.lost.remove(&id) else { return false };
        self.world.replicas.insert(id, Replica { area, frame, ..lost.thing });
        self.rebuild(&[id]);
        true
    }

    /// Lost things are where they were after all: all of them, or those that stood so near, in cm, to a point where
    /// something was met. Whether there are any.
    pub(crate) fn find_again(&mut self, met: Option<(Point, f64)>) -> bool {
        let reach = self.floor().reach();
        let is_there = |lost: &Lost| match (met, &lost.stood) {
            (Some((met, near)), Some(stood)) => stood.grown(near + reach).contains(met),
            (Some(_), None) => false,
            (None, _) => true,
        };
        let found: Vec<Replica> = self
            .lost
            .extract_if(.., |_, lost| is_there(lost))
            .map(|(_, lost)| lost.thing)
            .collect();
        let ids: Vec<ReplicaId> = found.iter().map(|thing| thing.id).collect();
        self.world.replicas.extend(found.into_iter().map(|thing| (thing.id, thing)));
        self.rebuild(&ids);
        !ids.is_empty()
    }

    /// Things that may be gone, as they were last.
    pub fn lost(&self) -> impl Iterator<Item = &Replica> {
        self.lost.values().map(|lost| &lost.thing)
    }
}

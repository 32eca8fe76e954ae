//! What the robot sees, and what it therefore believes, beside the surveyed map (D5, M8).
//!
//! The map says where a replica was surveyed; observations never change that. From both, [`Reader::belief`]
//! computes where the replica is likely to be at a moment, and how sure that is:
//!
//! - A surveyed place is certain when it is written down. Certainty halves with every half-life, which is a
//!   month for what hardly ever moves and an hour for what may be anywhere (`MoveProb` 100); 0 never fades.
//! - Seen where it was believed to be: `c := 1 - (1 - c)(1 - s)`. Not seen there: `c := c (1 - s)`.
//! - Seen elsewhere: the new place has `s`, the old one `c (1 - s)`; the surer one is believed.
//!
//! A belief that contradicts the map is a [`Proposal`]; a person confirms it, which is an edit of the map, or
//! rejects it, and then the observations up to that moment count no more.

use crate::map::Replica;
use crate::units::{AreaId, Cm, Deg, Frame, MapId, Point, Pose, ReplicaId};

use super::cell::Key;
use super::edits::{Change, Draft, Edits, ImportReport};
use super::error::{Result, StoreError};
use super::keep::Store;
use super::reader::Reader;
use super::schema::Record;
use super::tables::{self as t, Table};
use super::time::Timestamp;
use super::version::{Stamp, Version};
use super::write::replica_record;

/// Where something was seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    pub area: AreaId,
    /// The Object's frame within the Area's.
    pub frame: Frame,
}

/// One look at a replica, or at the place where it should have been.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    pub replica: ReplicaId,
    pub at: Timestamp,
    /// None: it was not where it was expected.
    pub seen: Option<Seen>,
    /// 0..=1
    pub sure: f64,
    pub observer: String,
}

/// Where a replica is believed to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Belief {
    pub place: Seen,
    /// 0..=1 at the moment asked for.
    pub confidence: f64,
    /// Since when it has been there, as far as is known.
    pub since: Timestamp,
    /// When it was last seen, at this place or another; none when it was only surveyed.
    pub last_seen: Option<Timestamp>,
    /// When it was missed, if it was not seen anywhere since.
    pub missed: Option<Timestamp>,
    /// Whether the place is the surveyed one.
    pub is_surveyed: bool,
}

/// A correction of the map that observations speak for.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    pub replica: ReplicaId,
    pub surveyed: Seen,
    pub believed: Belief,
}

/// Two places nearer than this are one, in cm.
const SAME_PLACE: f64 = 30.0;
/// Below this nothing is proposed.
const PROPOSED_FROM: f64 = 0.5;
const LONGEST_HALF_LIFE_HOURS: f64 = 720.0;
const SHORTEST_HALF_LIFE_HOURS: f64 = 1.0;
const REJECTED: &str = "rejected";

/// What is left of a certainty after some hours.
pub(super) fn faded(confidence: f64, move_prob: u8, hours: f64) -> f64 {
    if move_prob == 0 {
        return confidence;
    }
    let stays = 1.0 - f64::from(move_prob.min(100)) / 100.0;
    let half_life = SHORTEST_HALF_LIFE_HOURS
        + (LONGEST_HALF_LIFE_HOURS - SHORTEST_HALF_LIFE_HOURS) * stays * stays;
    confidence * 0.5f64.powf(hours.max(0.0) / half_life)
}

fn is_same(a: &Seen, b: &Seen) -> bool {
    let high = (a.frame.z.get() - b.frame.z.get()).abs();
    a.area == b.area && (a.frame.origin() - b.frame.origin()).norm().hypot(high) <= SAME_PLACE
}

/// A belief on its way from one observation to the next.
struct Opinion {
    place: Seen,
    confidence: f64,
    at: Timestamp,
    since: Timestamp,
    last_seen: Option<Timestamp>,
    missed: Option<Timestamp>,
}

impl Opinion {
    fn fade(&mut self, move_prob: u8, now: Timestamp) {
        self.confidence = faded(self.confidence, move_prob, now.hours_since(self.at));
        self.at = now;
    }

    fn learn(&mut self, seen: Option<Seen>, sure: f64) {
        let Some(seen) = seen else {
            self.confidence *= 1.0 - sure;
            self.missed = Some(self.at);
            return;
        };
        (self.last_seen, self.missed) = (Some(self.at), None);
        if is_same(&seen, &self.place) {
            self.confidence = 1.0 - (1.0 - self.confidence) * (1.0 - sure);
            // Where exactly, the last look knows best.
            self.place = seen;
        } else if sure >= self.confidence * (1.0 - sure) {
            (self.place, self.confidence, self.since) = (seen, sure, self.at);
        } else {
            self.confidence *= 1.0 - sure;
        }
    }
}

impl Reader {
    /// What was seen of a replica, the oldest first.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn observations(&self, replica: ReplicaId) -> Result<Vec<Observation>> {
        let records = self.records::<t::Observations>(&Key::new().id(replica.0))?;
        Ok(records.into_iter().map(observation).collect())
    }

    /// The replicas of which anything was ever seen, each once.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn observed(&self) -> Result<Vec<ReplicaId>> {
        let records = self.records::<t::Observations>(&Key::new())?;
        let mut ids: Vec<ReplicaId> = records.iter().map(|r| ReplicaId(r.repl_id)).collect();
        ids.dedup();
        Ok(ids)
    }

    /// Where a version of a replica's record puts it; none for a mark of deletion.
    #[must_use]
    pub fn place_of(&self, version: &Version) -> Option<Seen> {
        let r = <t::AreaObjects as Record>::from_row(&version.row)?;
        let frame = Frame::new(r.x, r.y, r.z, Deg::of(r.ang));
        (!version.stamp.deleted).then_some(Seen { area: AreaId(r.area_id), frame })
    }

    /// Where a replica of the map is, or was, believed to be at a moment: only what was known by then counts.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn belief(&self, replica: &Replica, now: Timestamp) -> Result<Belief> {
        let surveyed = Seen { area: replica.area, frame: replica.frame };
        let key = Key::new().id(replica.area.0).id(replica.object.0).id(replica.id.0);
        let version = self.version(Table::AreaObjects, &key)?;
        let written = version.map_or(Timestamp::default(), |v| v.stamp.at);
        let rejected = self
            .records::<t::Verdicts>(&Key::new().id(replica.id.0))?
            .into_iter()
            .map(|v| Timestamp(v.at))
            .filter(|at| *at <= now)
            .max();
        let from = rejected.map_or(written, |at| at.max(written));
        let mut opinion = Opinion {
            place: surveyed,
            confidence: 1.0,
            at: from,
            since: from,
            last_seen: None,
            missed: None,
        };
        let observations = self.observations(replica.id)?;
        for seen in observations.into_iter().filter(|o| o.at <= now && o.at >= from) {
            opinion.fade(replica.move_prob, seen.at);
            opinion.learn(seen.seen, seen.sure);
        }
        opinion.fade(replica.move_prob, now);
        let Opinion { place, confidence, since, last_seen, missed, .. } = opinion;
        let is_surveyed = is_same(&place, &surveyed);
        Ok(Belief { place, confidence, since, last_seen, missed, is_surveyed })
    }

    /// Where the robot stood last, when, and who said so.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn robot_pose(&self) -> Result<Option<(MapId, Pose, Stamp)>> {
        let key = Key::new().id(ROBOT);
        let Some(version) = self.version(Table::RobotPose, &key)? else { return Ok(None) };
        let record = self.record::<t::RobotPose>(&key)?;
        Ok(record.map(|r| {
            let pose = Pose { at: Point::new(r.x, r.y), heading: Deg::of(r.ang) };
            (MapId(r.map_id), pose, version.stamp)
        }))
    }
}

pub(super) fn pose_record(map: MapId, pose: &Pose) -> t::RobotPose {
    t::RobotPose {
        robot_id: ROBOT,
        map_id: map.0,
        x: pose.at.x,
        y: pose.at.y,
        ang: pose.heading.get(),
    }
}

/// The robot of the Domain; the tables have room for more.
const ROBOT: u32 = 1;

fn observation(r: t::Observations) -> Observation {
    let frame = Frame::new(r.x, r.y, r.z, Deg::of(r.ang));
    Observation {
        replica: ReplicaId(r.repl_id),
        at: Timestamp(r.at),
        seen: r.seen.then_some(Seen { area: AreaId(r.area_id), frame }),
        sure: r.sure,
        observer: r.observer,
    }
}

impl Store {
    /// Notes what was seen, in one transaction. The map and its revision stay as they are.
    ///
    /// # Errors
    /// [`StoreError::ReadOnly`], [`StoreError::Io`].
    pub fn observe(&mut self, observations: &[Observation]) -> Result<()> {
        let mut draft = Draft::default();
        self.put_observations(observations, &mut draft)?;
        self.commit_log(draft)
    }

    pub(super) fn put_observations(
        &self,
        observations: &[Observation],
        draft: &mut Draft,
    ) -> Result<()> {
        let mut taken = std::collections::BTreeMap::<(ReplicaId, Timestamp), u32>::new();
        for o in observations {
            let prefix = Key::new().id(o.replica.0).int(o.at.0);
            let before = self.reader().records::<t::Observations>(&prefix)?.len() as u32;
            let no = taken.entry((o.replica, o.at)).or_insert(before);
            let seen = o.seen.unwrap_or(Seen { area: AreaId(0), frame: Frame::IDENTITY });
            let number = |length: Cm| length.get();
            let record = t::Observations {
                repl_id: o.replica.0,
                at: o.at.0,
                no: *no,
                seen: o.seen.is_some(),
                area_id: seen.area.0,
                x: number(seen.frame.x),
                y: number(seen.frame.y),
                z: number(seen.frame.z),
                ang: seen.frame.angle.get(),
                sure: if o.sure.is_nan() { 0.0 } else { o.sure.clamp(0.0, 1.0) },
                observer: o.observer.clone(),
            };
            *no += 1;
            self.put_log(draft, &record, &self.stamp(&o.observer, o.at))?;
        }
        Ok(())
    }

    /// Notes where the robot stands.
    ///
    /// # Errors
    /// [`StoreError::ReadOnly`], [`StoreError::Io`].
    pub fn put_robot_pose(
        &mut self,
        map: MapId,
        pose: &Pose,
        user: &str,
        now: Timestamp,
    ) -> Result<()> {
        let mut draft = Draft::default();
        self.put_log(&mut draft, &pose_record(map, pose), &self.stamp(user, now))?;
        self.vault.commit(draft.writes)
    }

    /// The replicas that are believed to stand elsewhere than the map says.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn proposals(&self, now: Timestamp) -> Result<Vec<Proposal>> {
        let reader = self.reader();
        let Some(world) = reader.world()? else { return Ok(Vec::new()) };
        let mut found = Vec::new();
        for replica in world.replicas.values() {
            let believed = reader.belief(replica, now)?;
            if !believed.is_surveyed && believed.confidence >= PROPOSED_FROM {
                let surveyed = Seen { area: replica.area, frame: replica.frame };
                found.push(Proposal { replica: replica.id, surveyed, believed });
            }
        }
        Ok(found)
    }

    /// A person says that a replica does stand where it is believed to: an edit of the map.
    ///
    /// # Errors
    /// [`StoreError::UnknownReplica`]; else as [`Store::apply`].
    pub fn confirm(&mut self, replica: ReplicaId, change: &Change) -> Result<ImportReport> {
        let reader = self.reader();
        let unknown = || StoreError::UnknownReplica { id: replica.0 };
        let old = reader.replica(replica)?.ok_or_else(unknown)?;
        let place = reader.belief(&old, change.at)?.place;
        let new = Replica { area: place.area, frame: place.frame, ..old.clone() };
        let edits = if old.area == new.area {
            Edits::new()
        } else {
            Edits::new().remove(&replica_record(&old))
        };
        self.apply(&edits.put(&replica_record(&new)), change)
    }

    /// A person says that a replica stands where the map says: what was seen until now counts no more.
    ///
    /// # Errors
    /// [`StoreError::ReadOnly`], [`StoreError::Io`].
    pub fn reject(&mut self, replica: ReplicaId, change: &Change) -> Result<()> {
        let record = t::Verdicts {
            repl_id: replica.0,
            at: change.at.0,
            verdict: REJECTED.into(),
            reason: change.reason.clone(),
        };
        let mut draft = Draft::default();
        self.put_log(&mut draft, &record, &self.stamp(&change.user, change.at))?;
        self.vault.commit(draft.writes)
    }

    pub(super) fn stamp(&self, user: &str, at: Timestamp) -> Stamp {
        Stamp { revision: self.revision(), at, user: user.to_owned(), deleted: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn certainty_fades_faster_for_what_moves() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(near(faded(1.0, 0, 1e9), 1.0) && near(faded(1.0, 100, 1.0), 0.5));
        assert!(faded(1.0, 10, 24.0) > 0.95);
        let after_a_day: Vec<f64> = [10, 50, 90, 100].map(|p| faded(1.0, p, 24.0)).to_vec();
        assert!(after_a_day.is_sorted_by(|a, b| a > b), "{after_a_day:?}");
    }
}

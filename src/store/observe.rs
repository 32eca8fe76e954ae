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
//! What all that was seen of a replica came to is kept beside it (`Beliefs`), so that the past need not be read to know
//! what is believed now. It goes with one survey of the replica and with the last moment of which anything is known;
//! whoever asks of another moment, or another survey, has all of it gone through.
//!
//! A belief that contradicts the map is a [`Proposal`]; a person confirms it, which is an edit of the map, or
//! rejects it, and then the observations up to that moment count no more.

use std::collections::BTreeMap;

use crate::map::Replica;
use crate::units::{AreaId, Deg, Frame, MapId, Point, Pose, ReplicaId, Timestamp};

use super::cell::Key;
use super::edits::{Change, Draft, Edits, ImportReport};
use super::error::{Result, StoreError};
use super::keep::Store;
use super::reader::Reader;
use super::tables::{self as t, Record, Table};
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

/// A place where a replica was, or is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stay {
    pub place: Seen,
    /// When it was first known to be there no more.
    pub until: Option<Timestamp>,
}

/// Two places nearer than this are one, in cm: what is thought of a thing is kept in step with what was seen of it, and
/// would have to be gone through anew if this could change.
const SAME_PLACE: f64 = 30.0;
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

/// 0..=1, whatever was said.
fn share(sure: f64) -> f64 {
    if sure.is_nan() { 0.0 } else { sure.clamp(0.0, 1.0) }
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

/// A replica as the map has it.
struct Surveyed {
    id: ReplicaId,
    place: Seen,
    move_prob: u8,
    /// In which revision it was written down so, and when.
    survey: (u64, Timestamp),
}

/// Stands for the survey where a belief is not kept in step.
const NO_SURVEY: u32 = u32::MAX;

/// Whether what is kept began from this survey.
fn is_of(known: &t::Beliefs, replica: &Surveyed) -> bool {
    u64::from(known.survey) == replica.survey.0
}

impl Default for Opinion {
    fn default() -> Self {
        let (at, place) = (Timestamp::default(), Seen { area: AreaId(0), frame: Frame::IDENTITY });
        Self { place, confidence: 0.0, at, since: at, last_seen: None, missed: None }
    }
}

impl Opinion {
    fn belief(mut self, replica: &Surveyed, now: Timestamp) -> Belief {
        self.fade(replica.move_prob, now);
        let Self { place, confidence, since, last_seen, missed, .. } = self;
        let is_surveyed = is_same(&place, &replica.place);
        Belief { place, confidence, since, last_seen, missed, is_surveyed }
    }

    /// One more look at a replica.
    fn take(&mut self, replica: &Surveyed, seen: &Observation) {
        self.fade(replica.move_prob, seen.at);
        self.learn(seen.seen, share(seen.sure));
    }

    fn of(r: &t::Beliefs) -> Self {
        let frame = Frame::new(r.x, r.y, r.z, Deg::of(r.ang));
        Self {
            place: Seen { area: AreaId(r.area_id), frame },
            confidence: r.confidence,
            at: Timestamp(r.at),
            since: Timestamp(r.since),
            last_seen: r.last_seen.map(Timestamp),
            missed: r.missed.map(Timestamp),
        }
    }

    fn record(&self, replica: ReplicaId, newest: Timestamp, survey: u32) -> t::Beliefs {
        let frame = &self.place.frame;
        t::Beliefs {
            repl_id: replica.0,
            newest: newest.0,
            survey,
            area_id: self.place.area.0,
            x: frame.x.get(),
            y: frame.y.get(),
            z: frame.z.get(),
            ang: frame.angle.get(),
            confidence: self.confidence,
            at: self.at.0,
            since: self.since.0,
            last_seen: self.last_seen.map(|at| at.0),
            missed: self.missed.map(|at| at.0),
        }
    }

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
        let records = self.records::<t::Beliefs>(&Key::new())?;
        Ok(records.into_iter().map(|r| ReplicaId(r.repl_id)).collect())
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
        let surveyed = self.survey(replica)?;
        let known = self.record::<t::Beliefs>(&Key::new().id(replica.id.0))?;
        let opinion = match known {
            None => self.opinion_without(&surveyed, now)?,
            Some(r) if is_of(&r, &surveyed) && now.0 >= r.newest => Opinion::of(&r),
            Some(_) => self.opinion(&surveyed, now)?,
        };
        Ok(opinion.belief(&surveyed, now))
    }

    /// The same, with all that was ever seen of the replica gone through once more.
    ///
    /// # Errors
    /// As [`Reader::belief`].
    pub fn belief_from_all(&self, replica: &Replica, now: Timestamp) -> Result<Belief> {
        let surveyed = self.survey(replica)?;
        Ok(self.opinion(&surveyed, now)?.belief(&surveyed, now))
    }

    fn survey(&self, replica: &Replica) -> Result<Surveyed> {
        let key = Key::new().id(replica.area.0).id(replica.object.0).id(replica.id.0);
        let version = self.version(Table::AreaObjects, &key)?;
        let survey = version.map_or((0, Timestamp::default()), |v| (v.stamp.revision, v.stamp.at));
        let (id, move_prob) = (replica.id, replica.move_prob);
        let place = Seen { area: replica.area, frame: replica.frame };
        Ok(Surveyed { id, place, move_prob, survey })
    }

    /// A replica of the map as it stands.
    fn surveyed(&self, id: ReplicaId) -> Result<Option<Surveyed>> {
        for key in self.replica_keys(id)? {
            let version = self.version(Table::AreaObjects, &key)?;
            let Some(version) = version.filter(|v| !v.stamp.deleted) else { continue };
            let r: t::AreaObjects = super::reader::record(&version.row)?;
            let frame = Frame::new(r.x, r.y, r.z, Deg::of(r.ang));
            let place = Seen { area: AreaId(r.area_id), frame };
            let survey = (version.stamp.revision, version.stamp.at);
            return Ok(Some(Surveyed { id, place, move_prob: r.move_prob as u8, survey }));
        }
        Ok(None)
    }

    /// The last moment, up to `now`, at which a person said that what was seen counts no more, and how much of that
    /// moment's.
    fn rejected(&self, replica: ReplicaId, now: Timestamp) -> Result<Option<(Timestamp, u32)>> {
        let verdicts = self.records::<t::Verdicts>(&Key::new().id(replica.0))?.into_iter();
        let all = verdicts.map(|v| (Timestamp(v.at), v.same));
        Ok(all.filter(|(at, _)| *at <= now).max())
    }

    /// What is thought of a replica of which nothing counts that was seen.
    fn opinion_without(&self, replica: &Surveyed, now: Timestamp) -> Result<Opinion> {
        let (place, written) = (replica.place, replica.survey.1);
        let rejected = self.rejected(replica.id, now)?;
        let from = rejected.map_or(written, |(at, _)| at.max(written));
        let (confidence, last_seen, missed) = (1.0, None, None);
        Ok(Opinion { place, confidence, at: from, since: from, last_seen, missed })
    }

    /// Where a replica of the map was since it was written down so, the earliest first: where the map has it, and each place
    /// to which it was then believed to have moved.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn stays(&self, replica: &Replica, now: Timestamp) -> Result<Vec<Stay>> {
        let surveyed = self.survey(replica)?;
        let mut opinion = self.opinion_without(&surveyed, now)?;
        let mut stays = Vec::new();
        let mut stay = Stay { place: opinion.place, until: None };
        for observation in self.counted(&surveyed, now)? {
            opinion.take(&surveyed, &observation);
            if !is_same(&opinion.place, &stay.place) {
                stay.until.get_or_insert(observation.at);
                stays.push(stay);
                stay = Stay { place: opinion.place, until: None };
            } else if observation.seen.is_none() {
                stay.until.get_or_insert(observation.at);
            } else {
                stay.until = None;
            }
        }
        stays.push(stay);
        Ok(stays)
    }

    /// What was seen of a replica up to a moment, and counts.
    fn counted(&self, replica: &Surveyed, now: Timestamp) -> Result<Vec<Observation>> {
        let rejected = self.rejected(replica.id, now)?;
        let (revision, written) = replica.survey;
        // What happened in one millisecond is told apart by what was written first.
        let counts = |o: &t::Observations, noted: u64| {
            let at = Timestamp(o.at);
            let is_new = at > written || (at == written && noted >= revision);
            at <= now && is_new && rejected.is_none_or(|last| (at, o.no) >= last)
        };
        let mut counted = Vec::new();
        for (_, version) in self.versions(Table::Observations, &Key::new().id(replica.id.0))? {
            let noted = version.stamp.revision;
            let record: t::Observations = super::reader::record(&version.row)?;
            if counts(&record, noted) {
                counted.push(observation(record));
            }
        }
        Ok(counted)
    }

    /// What is thought of a replica after all that was seen of it up to a moment: gone through from the beginning.
    fn opinion(&self, replica: &Surveyed, now: Timestamp) -> Result<Opinion> {
        let mut opinion = self.opinion_without(replica, now)?;
        for observation in self.counted(replica, now)? {
            opinion.take(replica, &observation);
        }
        Ok(opinion)
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
pub(super) const ROBOT: u32 = 1;

fn record_of(o: &Observation, no: u32) -> t::Observations {
    let seen = o.seen.unwrap_or(Seen { area: AreaId(0), frame: Frame::IDENTITY });
    t::Observations {
        repl_id: o.replica.0,
        at: o.at.0,
        no,
        seen: o.seen.is_some(),
        area_id: seen.area.0,
        x: seen.frame.x.get(),
        y: seen.frame.y.get(),
        z: seen.frame.z.get(),
        ang: seen.frame.angle.get(),
        sure: share(o.sure),
        observer: o.observer.clone(),
    }
}

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
        let reader = self.reader();
        let mut by_replica = BTreeMap::<ReplicaId, Vec<&Observation>>::new();
        for o in observations {
            by_replica.entry(o.replica).or_default().push(o);
        }
        for (replica, seen) in by_replica {
            let known = reader.record::<t::Beliefs>(&Key::new().id(replica.0))?;
            let newest = known.as_ref().map(|r| r.newest);
            let mut taken = BTreeMap::<Timestamp, u32>::new();
            for o in &seen {
                // Of what is later than all that was seen nothing need be looked up.
                let is_latest = newest.is_none_or(|newest| o.at.0 > newest);
                let before = if is_latest { 0 } else { self.seen_at(replica, o.at)? };
                let no = taken.entry(o.at).or_insert(before);
                self.put_new(draft, &record_of(o, *no), &self.stamp(&o.observer, o.at))?;
                *no += 1;
            }
            let belief = self.belief_after(replica, &seen, known.as_ref())?;
            let last = seen[seen.len() - 1];
            self.put_log(draft, &belief, &self.stamp(&last.observer, last.at))?;
        }
        Ok(())
    }

    /// How often a replica was seen, or missed, at a moment.
    fn seen_at(&self, replica: ReplicaId, at: Timestamp) -> Result<u32> {
        let prefix = Key::new().id(replica.0).int(at.0);
        Ok(self.reader().records::<t::Observations>(&prefix)?.len() as u32)
    }

    /// What is thought of a replica after what is about to be noted.
    fn belief_after(
        &self,
        id: ReplicaId,
        seen: &[&Observation],
        known: Option<&t::Beliefs>,
    ) -> Result<t::Beliefs> {
        let reader = self.reader();
        let before = known.map(|r| Timestamp(r.newest));
        let latest = seen.iter().map(|o| o.at).max().unwrap_or_default();
        let newest = before.map_or(latest, |before| before.max(latest));
        let Some(replica) = reader.surveyed(id)? else {
            // What the map has not is noted, and nothing is thought of it.
            return Ok(Opinion::default().record(id, newest, NO_SURVEY));
        };
        let rejected = reader.rejected(id, newest)?;
        let from = rejected.map_or(replica.survey.1, |(at, _)| at.max(replica.survey.1));
        let is_later = before.is_none_or(|before| seen[0].at >= before);
        let is_plain = is_later && seen[0].at >= from && seen.is_sorted_by_key(|o| o.at);
        if !is_plain {
            // Whoever asks goes through all of it.
            return Ok(Opinion::default().record(id, newest, NO_SURVEY));
        }
        let mut opinion = match (known, before) {
            (Some(r), _) if is_of(r, &replica) => Opinion::of(r),
            (Some(_), Some(before)) => reader.opinion(&replica, before)?,
            _ => reader.opinion_without(&replica, newest)?,
        };
        for o in seen {
            opinion.take(&replica, o);
        }
        Ok(opinion.record(id, newest, replica.survey.0 as u32))
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

    /// The replicas that are believed to stand elsewhere than the map says, at least as surely as `least`, 0..=1.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn proposals(&self, now: Timestamp, least: f64) -> Result<Vec<Proposal>> {
        let reader = self.reader();
        let Some(world) = reader.world()? else { return Ok(Vec::new()) };
        let mut found = Vec::new();
        for replica in world.replicas.values() {
            let believed = reader.belief(replica, now)?;
            if !believed.is_surveyed && believed.confidence >= least {
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
        let same = self.seen_at(replica, change.at)?;
        let record = t::Verdicts {
            repl_id: replica.0,
            at: change.at.0,
            verdict: REJECTED.into(),
            reason: change.reason.clone(),
            same,
        };
        let mut draft = Draft::default();
        let stamp = self.stamp(&change.user, change.at);
        self.put_log(&mut draft, &record, &stamp)?;
        if let Some(known) = self.reader().record::<t::Beliefs>(&Key::new().id(replica.0))? {
            // Whoever asks goes through all of it, until more is seen.
            let newest = Timestamp(known.newest).max(change.at);
            self.put_log(
                &mut draft,
                &Opinion::of(&known).record(replica, newest, NO_SURVEY),
                &stamp,
            )?;
        }
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

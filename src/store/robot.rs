//! What the robot keeps in mind from one task to the next: where it stands, how doors stand, what it carries.
//!
//! None of it is of the map: a survey is a survey, and what the robot did since is noted beside it (D5).

use std::collections::BTreeMap;

use crate::map::{DoorState, DoorStatus};
use crate::units::{AreaId, Deg, DoorId, MapId, Point, Pose, ReplicaId, Timestamp};

use super::cell::Key;
use super::edits::Draft;
use super::error::Result;
use super::keep::Store;
use super::observe::{Observation, faded};
use super::reader::Reader;
use super::tables::{self as t, Record, Table};
use super::version::{Stamp, Version};
use super::words::STATUSES;

/// Where the robot is, and what it left otherwise than the map has it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RobotMemory {
    /// None before its first task: it stands where the map says that it starts.
    pub pose: Option<(MapId, Pose)>,
    /// Doors that it saw standing otherwise than the map says, or left so.
    pub doors: BTreeMap<DoorId, DoorState>,
    /// What is not on the map any more, with the person to whom it was given; an empty name is the robot's hand.
    pub carried: BTreeMap<ReplicaId, String>,
    /// Devices that it left switched otherwise than the map says: whether they are on.
    pub devices: BTreeMap<ReplicaId, bool>,
    /// Things with doors, lids or drawers that it left otherwise than the map says: whether they stand open.
    pub opened: BTreeMap<ReplicaId, bool>,
    /// What it saw where the map has nothing.
    pub obstacles: Vec<SeenObstacle>,
    /// Where its laser told it last that it may be, the best first.
    pub found: Vec<FoundAt>,
}

/// Something that was seen and that the map does not have, in the frame of the Area in which it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct SeenObstacle {
    pub area: AreaId,
    /// Convex and counter-clockwise, in cm.
    pub pieces: Vec<Vec<Point>>,
    /// Height up to which it was seen, above the Area's floor, in cm.
    pub top: f64,
    pub at: Timestamp,
    /// 0..=1 when it was seen.
    pub sure: f64,
}

impl SeenObstacle {
    /// How sure it is at a moment that it is still there: as of what may be anywhere, half of it is left after an hour.
    #[must_use]
    pub fn confidence(&self, now: Timestamp) -> f64 {
        faded(self.sure, MAY_BE_ANYWHERE, now.hours_since(self.at))
    }

    /// Whether it has the outline of another, whenever that was seen.
    #[must_use]
    pub fn is_as(&self, other: &Self) -> bool {
        /// Numbers are not the same to the last digit after they were reckoned with, cm.
        const SAME: f64 = 0.01;
        let corners = |seen: &Self| seen.pieces.concat();
        self.area == other.area
            && (self.top - other.top).abs() <= SAME
            && self.pieces.iter().map(Vec::len).eq(other.pieces.iter().map(Vec::len))
            && corners(self).iter().zip(corners(other)).all(|(a, b)| (a - b).norm() <= SAME)
    }

    /// Whether it is to be reckoned with at a moment: it is still as sure as `least`, 0..=1.
    #[must_use]
    pub fn stands(&self, now: Timestamp, least: f64) -> bool {
        self.confidence(now) >= least
    }
}

/// A pose that fitted the last scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundAt {
    pub map: MapId,
    pub pose: Pose,
    /// Standard deviation of the position, cm, in its worst direction; of the heading, degrees.
    pub deviation: (f64, f64),
    /// Share of the beams that end where the map says.
    pub explained: f64,
    pub at: Timestamp,
}

const MAY_BE_ANYWHERE: u8 = 100;

fn pieces_in_text(pieces: &[Vec<Point>]) -> String {
    let piece = |piece: &Vec<Point>| {
        piece.iter().map(|p| format!("{},{}", p.x, p.y)).collect::<Vec<_>>().join(" ")
    };
    pieces.iter().map(piece).collect::<Vec<_>>().join(";")
}

/// What cannot be read is no piece.
fn pieces_of_text(text: &str) -> Vec<Vec<Point>> {
    let point = |text: &str| {
        let (x, y) = text.split_once(',')?;
        let (x, y): (f64, f64) = (x.parse().ok()?, y.parse().ok()?);
        (x.is_finite() && y.is_finite()).then(|| Point::new(x, y))
    };
    let piece = |text: &str| text.split_whitespace().map(point).collect::<Option<Vec<_>>>();
    text.split(';').filter_map(piece).filter(|piece| piece.len() >= 3).collect()
}

impl Reader {
    /// What the robot keeps in mind.
    ///
    /// # Errors
    /// [`BadRecord`](super::StoreError::BadRecord) when a record is broken.
    pub fn robot_memory(&self) -> Result<RobotMemory> {
        let state = |r: t::DoorStates| {
            let word = STATUSES.iter().find(|(_, word)| *word == r.status);
            let status = word.map_or(DoorStatus::Closed, |(status, _)| *status);
            (DoorId(r.door_id), DoorState { status, opening: r.opening })
        };
        let doors = self.records::<t::DoorStates>(&Key::new())?;
        let carried = self.records::<t::Carried>(&Key::new())?;
        let devices = self.records::<t::DeviceStates>(&Key::new())?;
        let opened = self.records::<t::OpenStates>(&Key::new())?;
        let obstacle = |r: t::Obstacles| SeenObstacle {
            area: AreaId(r.area_id),
            pieces: pieces_of_text(&r.pieces),
            top: r.top,
            at: Timestamp(r.at),
            sure: r.sure,
        };
        let found = |r: t::FoundPoses| FoundAt {
            map: MapId(r.map_id),
            pose: Pose { at: Point::new(r.x, r.y), heading: Deg::of(r.ang) },
            deviation: (r.off, r.off_ang),
            explained: r.explained,
            at: Timestamp(r.at),
        };
        let obstacles = self.records::<t::Obstacles>(&Key::new())?;
        let poses = self.records::<t::FoundPoses>(&Key::new())?;
        Ok(RobotMemory {
            obstacles: obstacles.into_iter().map(obstacle).collect(),
            found: poses.into_iter().map(found).collect(),
            pose: self.robot_pose()?.map(|(map, pose, _)| (map, pose)),
            doors: doors.into_iter().map(state).collect(),
            carried: carried.into_iter().map(|r| (ReplicaId(r.repl_id), r.holder)).collect(),
            devices: devices.into_iter().map(|r| (ReplicaId(r.repl_id), r.is_on)).collect(),
            opened: opened.into_iter().map(|r| (ReplicaId(r.repl_id), r.is_open)).collect(),
        })
    }
}

impl Store {
    /// Puts what the robot keeps in mind in the place of what it kept before, together with what it saw, in one
    /// transaction. The map and its revision stay as they are.
    ///
    /// # Errors
    /// [`ReadOnly`](super::StoreError::ReadOnly), [`Io`](super::StoreError::Io).
    pub fn remember(
        &mut self,
        memory: &RobotMemory,
        seen: &[Observation],
        user: &str,
        now: Timestamp,
    ) -> Result<()> {
        let stamp = self.stamp(user, now);
        let mut draft = Draft::default();
        match &memory.pose {
            Some((map, pose)) => {
                self.put_log(&mut draft, &super::observe::pose_record(*map, pose), &stamp)?;
            }
            None => self.drop_all(Table::RobotPose, |_| true, &mut draft, &stamp)?,
        }
        for (door, state) in &memory.doors {
            let word = STATUSES.iter().find(|(status, _)| *status == state.status);
            let record = t::DoorStates {
                door_id: door.0,
                status: word.map_or_else(String::new, |(_, word)| (*word).to_owned()),
                opening: state.opening,
            };
            self.put_log(&mut draft, &record, &stamp)?;
        }
        let stale = |row: &[super::Cell]| {
            t::DoorStates::from_row(row)
                .is_none_or(|r| !memory.doors.contains_key(&DoorId(r.door_id)))
        };
        self.drop_all(Table::DoorStates, stale, &mut draft, &stamp)?;
        for (thing, holder) in &memory.carried {
            let record = t::Carried { repl_id: thing.0, holder: holder.clone() };
            self.put_log(&mut draft, &record, &stamp)?;
        }
        let stale = |row: &[super::Cell]| {
            t::Carried::from_row(row)
                .is_none_or(|r| !memory.carried.contains_key(&ReplicaId(r.repl_id)))
        };
        self.drop_all(Table::Carried, stale, &mut draft, &stamp)?;
        for (device, is_on) in &memory.devices {
            let record = t::DeviceStates { repl_id: device.0, is_on: *is_on };
            self.put_log(&mut draft, &record, &stamp)?;
        }
        let stale = |row: &[super::Cell]| {
            t::DeviceStates::from_row(row)
                .is_none_or(|r| !memory.devices.contains_key(&ReplicaId(r.repl_id)))
        };
        self.drop_all(Table::DeviceStates, stale, &mut draft, &stamp)?;
        for (thing, is_open) in &memory.opened {
            let record = t::OpenStates { repl_id: thing.0, is_open: *is_open };
            self.put_log(&mut draft, &record, &stamp)?;
        }
        let stale = |row: &[super::Cell]| {
            t::OpenStates::from_row(row)
                .is_none_or(|r| !memory.opened.contains_key(&ReplicaId(r.repl_id)))
        };
        self.drop_all(Table::OpenStates, stale, &mut draft, &stamp)?;
        for (no, obstacle) in (0..).zip(&memory.obstacles) {
            let record = t::Obstacles {
                no,
                area_id: obstacle.area.0,
                pieces: pieces_in_text(&obstacle.pieces),
                top: obstacle.top,
                at: obstacle.at.0,
                sure: obstacle.sure,
            };
            self.put_log(&mut draft, &record, &stamp)?;
        }
        let stale = |row: &[super::Cell]| {
            t::Obstacles::from_row(row).is_none_or(|r| r.no as usize >= memory.obstacles.len())
        };
        self.drop_all(Table::Obstacles, stale, &mut draft, &stamp)?;
        for (no, found) in (0..).zip(&memory.found) {
            let record = t::FoundPoses {
                no,
                map_id: found.map.0,
                x: found.pose.at.x,
                y: found.pose.at.y,
                ang: found.pose.heading.get(),
                off: found.deviation.0,
                off_ang: found.deviation.1,
                explained: found.explained,
                at: found.at.0,
            };
            self.put_log(&mut draft, &record, &stamp)?;
        }
        let stale = |row: &[super::Cell]| {
            t::FoundPoses::from_row(row).is_none_or(|r| r.no as usize >= memory.found.len())
        };
        self.drop_all(Table::FoundPoses, stale, &mut draft, &stamp)?;
        self.put_observations(seen, &mut draft)?;
        self.commit_log(draft)
    }

    /// Marks the live records of a table of notes as deleted, where `stale` holds of their rows.
    pub(super) fn drop_all(
        &self,
        table: Table,
        stale: impl Fn(&[super::Cell]) -> bool,
        draft: &mut Draft,
        stamp: &Stamp,
    ) -> Result<()> {
        for (key, version) in self.reader().versions(table, &Key::new())? {
            if stale(&version.row) {
                let key = key.as_bytes().to_vec();
                let old = self.vault.get(table.code(), &key)?;
                let gone = Version { stamp: Stamp { deleted: true, ..stamp.clone() }, ..version };
                let bytes = gone.encode(table, &key);
                draft.put(table.code(), key, bytes, old);
            }
        }
        Ok(())
    }

    pub(super) fn commit_log(&mut self, draft: Draft) -> Result<()> {
        if draft.writes.is_empty() { Ok(()) } else { self.vault.commit(draft.writes) }
    }
}

impl RobotMemory {
    /// Nothing is remembered: the robot stands at the map's start, in a map as it was surveyed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

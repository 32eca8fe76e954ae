//! What differs between the Map and what scans from known poses see (SPEC L2, L4): as values; nothing is changed here.
//!
//! Each beam is held against the Map as far as it went: what it ended at, and what of the Map it went through. Returns
//! that lie on nothing mapped are gathered in cells, and beams that later go through a cell empty it again: a person who
//! walked on leaves no obstacle behind. How a door stands is not taken from where the Map has its leaves, but from which
//! opening explains the beams best (`doors`). What is missed and fits what is seen elsewhere was moved (`moved`).
//!
//! **Invariant**: nothing is called missed that beams did not go through, and nothing moved whose place is one of
//! several.

mod doors;
mod moved;
mod unmapped;

use std::collections::BTreeMap;

use nalgebra::{Isometry2, Point2};

use crate::chart::{Chart, Line};
use crate::geometry::{Blocker, FloorPlan, Polygon};
use crate::map::World;
use crate::units::{DoorId, Frame, ReplicaId};
use crate::vectors::scan::Sensor;

pub use doors::DoorSeen;
pub use unmapped::Unmapped;

use doors::Doors;
use unmapped::Cells;

/// How far off a return may lie from what it is of, in cm: so much, and so much of its range. The pose is known no better.
const SLACK: (f64, f64) = (6.0, 0.015);
/// Beams that must speak of a thing before anything is said of it.
const FEWEST: f64 = 4.0;
/// Share of the beams to a thing that went through it where it is gone.
const GONE: f64 = 0.8;
/// What is left of older looks at a thing after each new one.
const KEPT: f64 = 0.9;
/// Scans that are kept to try places of moved things by.
const SCANS: usize = 24;

/// What was seen of a thing on the Map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ThingSeen {
    /// Where it is mapped.
    There,
    /// Beams went through where it is mapped.
    Missed,
    /// It is not where it is mapped, and fits what is seen here: the frame of its Object in the Map.
    Moved(Frame),
}

/// A thing on the Map that was to be seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThingLook {
    pub thing: ReplicaId,
    pub seen: ThingSeen,
    /// 0..=1
    pub sure: f64,
}

/// All that differs, and what was seen to be as it is mapped.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Differences {
    pub things: Vec<ThingLook>,
    /// Doors whose leaves were to be seen and of which something can be said.
    pub doors: BTreeMap<DoorId, DoorSeen>,
    /// Seen, and not mapped.
    pub unmapped: Vec<Unmapped>,
}

/// Beams to a thing.
#[derive(Debug, Clone, Copy, Default)]
struct Looks {
    struck: f64,
    through: f64,
    /// Ended before it, at something unmapped that is so near that it may be the thing itself.
    before: f64,
}

impl Looks {
    fn is_missed(&self) -> bool {
        self.through >= FEWEST && self.through >= GONE * (self.struck + self.through)
    }

    /// Hardly any beam ended at it, whatever the others did.
    fn is_doubtful(&self) -> bool {
        let all = self.struck + self.through + self.before;
        all >= FEWEST && self.struck <= 0.2 * all
    }
}

/// A scan and where it was taken.
struct Taken {
    sensor: Sensor,
    ranges: Vec<f64>,
    pose: Isometry2<f64>,
}

/// Holds scans against the Map, one after another.
pub struct Inspector<'w> {
    world: &'w World,
    plan: &'w FloorPlan,
    /// All that stands, without the leaves of doors.
    chart: Chart,
    doors: Doors<'w>,
    looks: BTreeMap<ReplicaId, Looks>,
    cells: Cells,
    taken: Vec<Taken>,
    count: usize,
}

pub(crate) fn slack(range: f64) -> f64 {
    SLACK.1.mul_add(range, SLACK.0)
}

/// Returns that have another beside them: one by itself is noise.
fn in_company(extra: &[(usize, Point2<f64>)], step: f64) -> Vec<(usize, Point2<f64>)> {
    let near = |a: &(usize, Point2<f64>), b: &(usize, Point2<f64>)| {
        let beams = b.0 - a.0;
        // As far apart as beams are on a face seen at a sharp angle, from a few metres.
        beams <= 2 && (a.1 - b.1).norm() <= 8.0 + 1500.0 * step * beams as f64
    };
    let count = extra.len();
    let has_company = |at: usize| {
        let after = (at + 1..count.min(at + 3)).any(|other| near(&extra[at], &extra[other]));
        after || (at.saturating_sub(2)..at).any(|other| near(&extra[other], &extra[at]))
    };
    (0..count).filter(|at| has_company(*at)).map(|at| extra[at]).collect()
}

impl<'w> Inspector<'w> {
    /// For a laser at `height` cm above the Map's zero.
    #[must_use]
    pub fn new(world: &'w World, plan: &'w FloorPlan, height: f64) -> Self {
        Self {
            world,
            plan,
            chart: Chart::of_map(world, plan, height).without_leaves(),
            doors: Doors::of(world, plan, height),
            looks: BTreeMap::new(),
            cells: Cells::default(),
            taken: Vec::new(),
            count: 0,
        }
    }

    /// Takes in a scan from a known pose of the sensor: of a wrong one all differs. `ranges` are cm, one a beam.
    pub fn take_in(&mut self, sensor: &Sensor, ranges: &[f64], pose: &Isometry2<f64>) {
        self.doors.look(&self.chart, sensor, ranges, pose);
        let leaves = self.doors.leaves_near(pose, sensor.reach().1);
        let mut looks: BTreeMap<ReplicaId, Looks> = BTreeMap::new();
        let mut extra = Vec::new();
        for (beam, (&range, u)) in ranges.iter().zip(sensor.directions()).enumerate() {
            if !sensor.returned(range) {
                continue;
            }
            let end = pose * Point2::from(u * range);
            let slack = slack(range);
            let on = self.chart.nearest(end).filter(|(_, foot)| (foot - end).norm() <= slack);
            let thing = |line: u32| match self.chart.lines()[line as usize].face?.blocker {
                Blocker::Replica { replica, .. } | Blocker::ReplicaLeaf { replica, .. } => {
                    Some(replica)
                }
                _ => None,
            };
            let struck = on.and_then(|(line, _)| thing(line));
            if let Some(thing) = struck {
                looks.entry(thing).or_default().struck += 1.0;
            }
            // What of the Map lies on its way.
            let bearing = sensor.bearing(beam);
            let mut passed: Vec<ReplicaId> = Vec::new();
            let mut from = 0.0;
            while let Some((distance, line)) =
                self.chart.next_on(pose, bearing, from, range - slack)
            {
                from = distance + 0.5;
                if let Some(thing) = thing(line)
                    && struck != Some(thing)
                    && !passed.contains(&thing)
                {
                    passed.push(thing);
                }
            }
            for thing in passed {
                looks.entry(thing).or_default().through += 1.0;
            }
            let is_leaf = || {
                leaves.iter().any(|line| (line.nearest(end) - end).norm() <= slack)
                    || self.doors.may_hold(end, slack)
            };
            if on.is_none() && !is_leaf() {
                extra.push((beam, end));
                let behind = self.chart.next_on(pose, bearing, range, range + 60.0);
                if let Some(thing) = behind.and_then(|(_, line)| thing(line)) {
                    looks.entry(thing).or_default().before += 1.0;
                }
            }
        }
        let extra = in_company(&extra, sensor.step());
        for (thing, new) in looks {
            let old = self.looks.entry(thing).or_default();
            old.struck = KEPT.mul_add(old.struck, new.struck);
            old.through = KEPT.mul_add(old.through, new.through);
            old.before = KEPT.mul_add(old.before, new.before);
        }
        self.cells.take_in(sensor, ranges, pose, &extra);
        let taken = Taken { sensor: sensor.clone(), ranges: ranges.to_vec(), pose: *pose };
        if self.taken.len() < SCANS {
            self.taken.push(taken);
        } else {
            self.taken[self.count % SCANS] = taken;
        }
        self.count += 1;
    }

    /// A door was moved: what was seen of it before counts no more, nor what its leaves were taken for meanwhile.
    pub fn forget_door(&mut self, door: DoorId) {
        self.doors.forget(door);
        let doors = &self.doors;
        self.cells.forget(|p| doors.may_hold(p, SLACK.0));
    }

    /// What differs by all scans so far; of what changed meanwhile the last look counts.
    #[must_use]
    pub fn differences(&self) -> Differences {
        let mut things: Vec<ThingLook> = Vec::new();
        let mut cells = self.cells.clone();
        // A leaf that was moved was something else until it was known to be there.
        cells.forget(|p| self.doors.holds(p, SLACK.0));
        for (&thing, looks) in &self.looks {
            let all = looks.struck + looks.through;
            if looks.is_doubtful()
                && let Some((frame, sure)) = self.moved(thing, &mut cells)
            {
                things.push(ThingLook { thing, seen: ThingSeen::Moved(frame), sure });
            } else if looks.is_missed() {
                let sure = (looks.through / all) * (1.0 - 0.5_f64.powf(looks.through / 3.0));
                things.push(ThingLook { thing, seen: ThingSeen::Missed, sure });
            } else if looks.struck >= FEWEST && looks.struck >= 0.5 * all {
                let sure = (looks.struck / all) * (1.0 - 0.5_f64.powf(looks.struck / 3.0));
                things.push(ThingLook { thing, seen: ThingSeen::There, sure });
            }
        }
        let is_inside = |seen: &Unmapped| self.plan.scene().area_at(seen.middle()).is_some();
        let unmapped = cells.clusters().into_iter().filter(is_inside).collect();
        Differences { things, doors: self.doors.seen(), unmapped }
    }

    /// Whether beams went through where something else was seen before, given by its convex pieces.
    #[must_use]
    pub fn is_gone(&self, pieces: &[Polygon]) -> bool {
        let edges = pieces.iter().flat_map(|piece| piece.edges().collect::<Vec<_>>());
        let outline: Vec<Line> = edges.map(|(start, end)| Line::between(start, end)).collect();
        let (struck, through) = moved::beams(&outline, &Frame::IDENTITY, &self.taken, &self.chart);
        through as f64 >= FEWEST && through as f64 >= GONE * (struck + through) as f64
    }

    /// Where a thing stands now that is not where it is mapped; what it explains is taken from what is unmapped.
    fn moved(&self, thing: ReplicaId, cells: &mut Cells) -> Option<(Frame, f64)> {
        let replica = self.world.replicas.get(&thing)?;
        let (_, area) = self.world.placement(replica.area)?;
        let mapped = area.compose(&replica.frame);
        let of_thing = |line: &&Line| matches!(line.face.map(|f| f.blocker), Some(Blocker::Replica { replica, .. }) if replica == thing);
        let outline: Vec<Line> = self
            .chart
            .lines()
            .iter()
            .filter(of_thing)
            .map(|line| Line {
                start: mapped.invert(line.start),
                end: mapped.invert(line.end),
                ..*line
            })
            .collect();
        let found = moved::place(&outline, &mapped, cells, &self.taken, &self.chart)?;
        let placed = found.frame;
        cells.forget(|p| {
            let own = placed.invert(p);
            outline.iter().any(|line| (line.nearest(own) - own).norm() <= 12.0)
        });
        Some((placed, found.sure))
    }
}

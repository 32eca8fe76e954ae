//! What differs between a scan and the Map, from a pose that is known (SPEC L2, L4): as values. Nothing is changed here.

use std::collections::BTreeMap;

use nalgebra::{Isometry2, Point2, Vector2};
use orthoframe_geometry::{Blocker, SeenFace};
use orthoframe_units::DoorId;
use orthoframe_vectors::scan::{Extractor, Sensor};

use crate::fit::{Met, met};
use crate::locate::Locator;
use crate::view::Return;

/// Beams in a row that tell a difference; fewer may be noise.
const FEWEST: usize = 3;
/// Share of the beams that should have struck a thing, and went through, for it to be missed.
const GONE: f64 = 0.8;

/// Something that was seen and is not on the Map: where it was seen, in cm in the Map's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unmapped {
    pub start: Vector2<f64>,
    pub end: Vector2<f64>,
    /// Beams that ended at it.
    pub beams: usize,
}

/// What the beams tell of something on the Map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Of what; all its faces together.
    pub blocker: Blocker,
    /// Beams that should have struck it, had nothing unmapped stood before it.
    pub expected: usize,
    /// Of these, those that did.
    pub struck: usize,
    /// Of these, those that went through where it should be.
    pub through: usize,
}

impl Seen {
    /// It should have been seen, and what is behind it was seen instead.
    #[must_use]
    pub fn is_missed(&self) -> bool {
        self.expected >= FEWEST && self.through as f64 >= GONE * self.expected as f64
    }
}

/// How a door's leaf stands against what the Map says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DoorSeen {
    /// As on the Map.
    AsMapped,
    /// Not where the Map has it: beams went through there.
    Elsewhere,
    /// Too little of it was in view.
    Unclear,
}

/// All that differs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Differences {
    /// Seen and not mapped, counter-clockwise.
    pub unmapped: Vec<Unmapped>,
    /// What is on the Map and was to be seen, whether it was or not.
    pub mapped: Vec<Seen>,
    /// Doors whose leaves were to be seen.
    pub doors: BTreeMap<DoorId, DoorSeen>,
}

impl Differences {
    /// On the Map, to be seen, and not seen.
    pub fn missed(&self) -> impl Iterator<Item = &Seen> {
        self.mapped.iter().filter(|seen| seen.is_missed())
    }
}

impl Locator {
    /// What differs between the faces and a scan taken at `pose`, which must be known: of a wrong pose all differs.
    #[must_use]
    pub fn differences(
        &self,
        sensor: &Sensor,
        ranges: &[f64],
        pose: &Isometry2<f64>,
    ) -> Differences {
        let mut counts: BTreeMap<Blocker, Seen> = BTreeMap::new();
        let mut unknown = vec![f64::NAN; ranges.len().min(sensor.count())];
        for (beam, (u, &range)) in sensor.directions().iter().zip(ranges).enumerate() {
            if !sensor.returned(range) {
                continue;
            }
            let noise = sensor.noise().along(range).sqrt();
            let found = met(&self.field, &self.faces, pose, &Return { u: *u, range, noise });
            if matches!(found, Met::Before(_) | Met::Open) {
                unknown[beam] = range;
            }
            let (face, struck, through) = match found {
                Met::Face(face) => (face, 1, 0),
                Met::Through(face) => {
                    // What it ended at is another matter, unless nothing of the Map stands there.
                    let end = (pose * Point2::from(u * range)).coords;
                    let known = self.field.nearest(&end).map(|f| self.faces[f].distance(&end));
                    if known.is_none_or(|d| d > 15.0) {
                        unknown[beam] = range;
                    }
                    (face, 0, 1)
                }
                Met::Before(_) | Met::Open => continue,
            };
            if let Some(SeenFace { blocker, .. }) = self.faces[face].of {
                let none = Seen { blocker, expected: 0, struck: 0, through: 0 };
                let seen = counts.entry(blocker).or_insert(none);
                seen.expected += 1;
                seen.struck += struck;
                seen.through += through;
            }
        }
        let mut doors = BTreeMap::new();
        for seen in counts.values() {
            if let Blocker::DoorLeaf { door, .. } = seen.blocker {
                let now = state(seen);
                let known = doors.entry(door).or_insert(now);
                // Of several leaves, the one that stands elsewhere tells.
                if now == DoorSeen::Elsewhere || *known == DoorSeen::Unclear {
                    *known = now;
                }
            }
        }
        let unmapped = unmapped(sensor, &unknown, pose);
        Differences { unmapped, mapped: counts.into_values().collect(), doors }
    }
}

fn state(seen: &Seen) -> DoorSeen {
    if seen.is_missed() {
        DoorSeen::Elsewhere
    } else if seen.struck >= FEWEST {
        DoorSeen::AsMapped
    } else {
        DoorSeen::Unclear
    }
}

/// The lines of what only the scan knows.
fn unmapped(sensor: &Sensor, ranges: &[f64], pose: &Isometry2<f64>) -> Vec<Unmapped> {
    let place = |p: Vector2<f64>| (pose * Point2::from(p)).coords;
    let mut extractor = Extractor::new();
    let segments = extractor.segments(sensor, ranges).iter();
    let lines = segments.map(|s| {
        let on = |(u, r): (&Vector2<f64>, &f64)| {
            sensor.returned(*r) && {
                let v = s.vector();
                let share = ((u * *r - s.start).dot(&v) / v.norm_squared()).clamp(0.0, 1.0);
                (s.start + v * share - u * *r).norm() < 5.0
            }
        };
        let beams = sensor.directions().iter().zip(ranges).filter(|b| on(*b)).count();
        Unmapped { start: place(s.start), end: place(s.end), beams }
    });
    lines.filter(|line| line.beams >= FEWEST).collect()
}

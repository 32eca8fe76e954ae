//! The operative model (SPEC L1; paper 1, section 9): what the robot sees now, in the Map's own language. The floor that
//! one scan shows is an Area of its own, its vectors are what bounds the view, and geometry cuts it into Passframes as
//! it does any floor.
//!
//! ```text
//!   ▔▔▔▔▔▔▔▔▔▔▔▔▔│    seen faces: impermeable, of the thing on the Map that stands there
//!        seen     ┆    where sight ends, at what hides the rest or at the sensor's reach: permeable, and no floor
//!   ·robot   ▁▁▁▁▁│    is known behind it
//! ```
//!
//! **Invariant**: it is made of one scan and the robot's size alone: its size follows the sensor, not the building.

use nalgebra::{Isometry2, Point2};

use crate::chart::Chart;
use crate::differences::slack;
use crate::geometry::{
    Beyond, Blocker, DoorStates, FloorPlan, Passframe, PassframeKind, Polygon, SeenFace,
    nearest_on_segment,
};
use crate::map::{
    Area, BaseVector, Item, Map, MapItem, Orthoframe, Permeability, RobotProfile, World,
};
use crate::units::{AreaId, Cm, Frame, MapId, OrFrId, Point};
use crate::vectors::scan::Sensor;

/// Sight without a return ends here, in cm: what lies beyond is of no use to a drive.
const HORIZON: f64 = 1000.0;
/// Neighbouring returns that are farther apart than beams are there, and so much more, are of two faces, in cm.
const TORN: f64 = 3.0;
/// The sharpest angle at which a face is taken for one, as the sine.
const SHARP: f64 = 0.15;
/// How far returns may lie off the vector that stands for them, in cm and as a share of their range.
const OFF: (f64, f64) = (1.5, 0.004);
/// Corners of the floor that the robot itself stands on.
const CORNERS: usize = 8;
const AREA: AreaId = AreaId(1);
const MAP: MapId = MapId(1);

/// What bounds the seen floor along one vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// A face; of what on the Map, where it stands there too.
    Face(Option<SeenFace>),
    /// The end of sight.
    Sight,
}

/// What the robot sees now: see the head of this file.
pub struct Operative {
    world: World,
    plan: FloorPlan,
    bounds: Vec<Bound>,
}

/// A corner of the view and what the vector from it on is.
#[derive(Clone, Copy)]
struct Corner {
    at: Point,
    range: f64,
    bound: Bound,
}

impl Operative {
    /// Of a scan taken at `pose` (the sensor's, in the Map's frame), `ranges` in cm, for a robot whose middle is the
    /// sensor's. `chart` tells what of the Map a face is of, `named` what people call that. None where the scan shows no
    /// floor.
    #[must_use]
    pub fn of(
        sensor: &Sensor,
        ranges: &[f64],
        pose: &Isometry2<f64>,
        robot: &RobotProfile,
        chart: &Chart,
        named: &dyn Fn(Blocker) -> String,
    ) -> Option<Self> {
        let corners = outline(sensor, ranges, pose, robot, chart)?;
        let base: Vec<BaseVector> = corners
            .iter()
            .enumerate()
            .map(|(number, corner)| {
                let (permeability, names) = match corner.bound {
                    Bound::Sight => (Permeability::Permeable, Vec::new()),
                    Bound::Face(None) => (Permeability::Impermeable, Vec::new()),
                    Bound::Face(Some(face)) => {
                        (Permeability::Impermeable, vec![named(face.blocker)])
                    }
                };
                BaseVector {
                    id: format!("V{number}"),
                    start: corner.at,
                    end: corners[(number + 1) % corners.len()].at,
                    side_type: None,
                    permeability,
                    names,
                    properties: Default::default(),
                }
            })
            .collect();
        let world = world(base, robot);
        let plan = FloorPlan::build(&world, MAP, robot, &DoorStates::new());
        Some(Self { world, plan, bounds: corners.iter().map(|corner| corner.bound).collect() })
    }

    /// The seen floor as a Map of one Area, in the frame of the building's Map.
    #[must_use]
    pub fn world(&self) -> &World {
        &self.world
    }

    #[must_use]
    pub fn plan(&self) -> &FloorPlan {
        &self.plan
    }

    #[must_use]
    pub fn passframes(&self) -> &[Passframe] {
        self.plan.passframes(AREA)
    }

    /// The paper's marker-type of a Passframe: one that sight's end borders is «Граница видимости».
    #[must_use]
    pub fn kind(&self, frame: &Passframe) -> PassframeKind {
        let ends =
            frame.borders.iter().any(|border| self.bound(&border.beyond) == Some(Bound::Sight));
        if ends { PassframeKind::Boundary } else { frame.kind }
    }

    /// The outline of what is seen, counter-clockwise, each vector with what bounds it.
    pub fn outline(&self) -> impl ExactSizeIterator<Item = (Point, Point, Bound)> + '_ {
        let base = &self.world.orthoframes.values().next().expect("it is made with one").base;
        base.iter().zip(&self.bounds).map(|(vector, bound)| (vector.start, vector.end, *bound))
    }

    /// What bounds a Passframe along a border: none towards other floor that is seen.
    #[must_use]
    pub fn bound(&self, beyond: &Beyond) -> Option<Bound> {
        match beyond {
            Beyond::Face { blocker: Blocker::Wall { side, .. }, side: Some(_) } => {
                self.bounds.get(*side).copied()
            }
            Beyond::Face { .. } => Some(Bound::Face(None)),
            Beyond::Passframe(_) | Beyond::DeadZone(_) | Beyond::Doorway { .. } => None,
        }
    }
}

fn world(base: Vec<BaseVector>, robot: &RobotProfile) -> World {
    let mut world = World::empty();
    let id = OrFrId(1);
    world.orthoframes.insert(
        id,
        Orthoframe {
            id,
            key: "sight".to_owned(),
            name: String::new(),
            name_en: String::new(),
            description: String::new(),
            frame_type: None,
            shape: None,
            base,
            height: Cm::of(robot.height.get() + 100.0),
            base_permeability: Permeability::Impermeable,
            roof_permeability: Permeability::Impermeable,
            roof_scale: 1.0,
            properties: Default::default(),
        },
    );
    let item = Item { id: "A".to_owned(), orthoframe: id, frame: Frame::IDENTITY, is_base: true };
    world.areas.insert(
        AREA,
        Area {
            id: AREA,
            key: "sight".to_owned(),
            name: "Видимое".to_owned(),
            name_en: "In view".to_owned(),
            description: String::new(),
            area_type: None,
            items: vec![item],
            links: Vec::new(),
            doors: Vec::new(),
            properties: Default::default(),
            forms: Default::default(),
        },
    );
    world.maps.insert(
        MAP,
        Map {
            id: MAP,
            key: "sight".to_owned(),
            name: "Оперативная модель".to_owned(),
            name_en: "Operative model".to_owned(),
            description: String::new(),
            map_type: None,
            frame: String::new(),
            items: vec![MapItem { area: AREA, frame: Frame::IDENTITY, is_base: true }],
            links: Vec::new(),
        },
    );
    world.robot = robot.clone();
    world
}

/// The outline of what a scan shows, counter-clockwise about the sensor, in the Map's frame.
fn outline(
    sensor: &Sensor,
    ranges: &[f64],
    pose: &Isometry2<f64>,
    robot: &RobotProfile,
    chart: &Chart,
) -> Option<Vec<Corner>> {
    let least = robot.radius.get() + robot.clearance.get() + 1.0;
    let mut points: Vec<Corner> = Vec::new();
    for (u, &range) in sensor.directions().iter().zip(ranges) {
        let is_return = sensor.returned(range) && range <= HORIZON;
        let is_open = range >= sensor.reach().1 || range > HORIZON;
        if !(is_return || is_open) {
            // Lost, or too near to be told: nothing is known this way.
            continue;
        }
        let far = if is_return { range } else { HORIZON };
        // What stands within the robot's own outline is a part of it.
        let far = far.max(least);
        let at = pose * Point2::from(u * far);
        let bound = if is_return { Bound::Face(None) } else { Bound::Sight };
        points.push(Corner { at, range: far, bound });
    }
    if points.len() < 8 {
        return None;
    }
    let is_closed = sensor.is_closed() && points.len() + 4 > sensor.count();
    // From each point the vector to the next: a face where both are of one.
    let count = points.len();
    let raw: Vec<Bound> = points.iter().map(|point| point.bound).collect();
    for number in 0..count {
        let next = (number + 1) % count;
        let (a, b) = (points[number], points[next]);
        let apart = b.at - a.at;
        let (gap, spacing) = (apart.norm(), sensor.step() * a.range.max(b.range));
        // A wall along which one looks goes on as it came; what stands before a wall does not.
        let goes_on = |from: usize, to: usize| {
            let other = points[to % count].at - points[from % count].at;
            let long = other.norm();
            long >= 0.3 * gap
                && other.dot(&apart) > 0.0
                && other.perp(&apart).abs() <= 0.12 * long * gap
        };
        let is_one = gap <= 2.5 * spacing + TORN
            || gap <= spacing / SHARP
                && (goes_on(number + count - 1, number) || goes_on(number + 1, number + 2));
        let is_face = raw[number] == Bound::Face(None)
            && raw[next] == Bound::Face(None)
            && is_one
            && (is_closed || next > 0);
        points[number].bound = if is_face { Bound::Face(None) } else { Bound::Sight };
    }
    let mut corners = simplified(&points, is_closed);
    for number in 0..corners.len() {
        let (a, b) = (corners[number], corners[(number + 1) % corners.len()]);
        if a.bound == Bound::Face(None) {
            corners[number].bound = Bound::Face(face_of(chart, &a, &b));
        }
    }
    if !is_closed {
        // Behind the field of view the robot knows the floor that it stands on, and no more.
        let bearing = |beam: usize| sensor.bearing(beam) + pose.rotation.angle();
        let (first, last) = (bearing(0), bearing(sensor.count().saturating_sub(1)));
        let gap = std::f64::consts::TAU - (last - first);
        let middle = Point2::from(pose.translation.vector);
        if let Some(corner) = corners.last_mut() {
            corner.bound = Bound::Sight;
        }
        for step in 0..=CORNERS {
            let angle = last + gap * (step as f64 + 0.5) / (CORNERS as f64 + 1.0);
            // The polygon about a circle, not in it.
            let far = least / (gap / (2.0 * (CORNERS as f64 + 1.0))).cos().max(0.5);
            let at = middle + nalgebra::Vector2::new(angle.cos(), angle.sin()) * far;
            corners.push(Corner { at, range: far, bound: Bound::Sight });
        }
    }
    (corners.len() >= 3).then_some(corners)
}

/// Runs of faces with as few corners as the returns allow (D. Douglas, T. Peucker, 1973), and sight's ends as they are.
fn simplified(points: &[Corner], is_closed: bool) -> Vec<Corner> {
    let count = points.len();
    // Begin where a run does.
    let start = if is_closed {
        (0..count).find(|&n| points[n].bound != points[(n + count - 1) % count].bound).unwrap_or(0)
    } else {
        0
    };
    let turned: Vec<Corner> = (0..count).map(|n| points[(start + n) % count]).collect();
    let mut kept = Vec::new();
    let mut from = 0;
    while from < count {
        let mut to = from;
        while to + 1 < count && turned[to].bound == Bound::Face(None) {
            to += 1;
        }
        if to > from {
            kept.push(from);
            thin(&turned, from, to, &mut kept);
            from = to;
        } else {
            kept.push(from);
            from += 1;
        }
    }
    kept.dedup();
    kept.into_iter().map(|number| turned[number]).collect()
}

/// Adds what is needed between two points, and not these.
fn thin(points: &[Corner], from: usize, to: usize, kept: &mut Vec<usize>) {
    let (a, b) = (points[from].at, points[to].at);
    let mut worst = (0.0, from);
    for (number, p) in points.iter().enumerate().take(to).skip(from + 1) {
        let off = (nearest_on_segment(p.at, a, b) - p.at).norm();
        let share = off / OFF.1.mul_add(p.range, OFF.0);
        if share > worst.0 {
            worst = (share, number);
        }
    }
    if worst.0 > 1.0 {
        thin(points, from, worst.1, kept);
        kept.push(worst.1);
        thin(points, worst.1, to, kept);
    }
}

/// What of the Map stands along a vector.
fn face_of(chart: &Chart, a: &Corner, b: &Corner) -> Option<SeenFace> {
    let middle = nalgebra::center(&a.at, &b.at);
    let (line, foot) = chart.nearest(middle)?;
    let is_near = (foot - middle).norm() <= slack(a.range.max(b.range));
    chart.lines()[line as usize].face.filter(|_| is_near)
}

/// The outline as a polygon.
impl From<&Operative> for Polygon {
    fn from(seen: &Operative) -> Self {
        Self::new(seen.outline().map(|(start, ..)| start).collect())
    }
}

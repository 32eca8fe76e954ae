//! What a scan shows of the floor, beside the map (SPEC L1): the operative model, its Passframes and what bounds them.

use crate::draw::{SightDrawing, SightLine, SightSign, beside, sight_svg};
use crate::geometry::Blocker;
use crate::language::Language;
use crate::language::names::english_name;
use crate::map::{Entity, World};
use crate::sensing::{Belief, Bound, Chart, Localiser, Operative, Options};
use crate::units::{InOrder as _, MapId, Point, Pose, told};

use super::drawing::kind_of_floor;
use super::{Drawing, Error, RequestError, Sighted, State};

/// The operative model of one scan.
pub struct Sighting {
    /// From 1.
    pub scan: usize,
    /// Of the laser.
    pub pose: Pose,
    /// Several poses fit; this is the best of them.
    pub is_one_of: usize,
    pub operative: Operative,
}

impl State {
    /// What a scan of a log, from 1, shows of the floor, from where it was taken on a map. None where that is not known, or no
    /// floor is seen.
    ///
    /// # Errors
    /// There is no map, no log, no such scan, or a pose is to be taken from a log that has none.
    pub fn sighting(
        &self,
        map: MapId,
        log: &Sighted,
        scan: usize,
        height: f64,
        posed: bool,
    ) -> Result<Option<Sighting>, Error> {
        let (world, floor) = (self.world()?, self.floor(map)?);
        let log = log.log().ok_or(RequestError::NoLog)?;
        let none = RequestError::NoScan { scan, count: log.scans.len() };
        let told = scan.checked_sub(1).and_then(|at| log.scans.get(at)).ok_or(none)?;
        let chart = Chart::of_map(world, floor, height);
        let sensor = log.sensor(told);
        let localiser = Localiser::new(&chart, Options::default());
        let poses: Vec<_> = match posed {
            false => {
                let belief = Belief::from(localiser.locate(sensor, &told.ranges));
                let told = belief.fits().iter().filter(|_| !matches!(belief, Belief::Lost(_)));
                told.map(|fit| fit.pose).collect()
            }
            true => vec![told.pose.ok_or(RequestError::NoPose { line: told.line })?],
        };
        let Some(&pose) = poses.first() else { return Ok(None) };
        let named = |blocker: Blocker| name_of(world, blocker, Language::Russian);
        let operative = Operative::of(sensor, &told.ranges, &pose, &world.robot, &chart, &named);
        let at = Pose::from(pose);
        let is_one_of = poses.len();
        Ok(operative.map(|operative| Sighting { scan, pose: at, is_one_of, operative }))
    }

    /// The same as a drawing: the map with the robot, and beside it what the robot sees.
    ///
    /// # Errors
    /// There is no map.
    pub fn draw_sighting(
        &self,
        map: MapId,
        seen: &Sighting,
        language: Language,
    ) -> Result<String, Error> {
        let world = self.world()?;
        let plan =
            self.draw(map, &Drawing { robot: Some(seen.pose), language, ..Drawing::default() })?;
        let mut names: Vec<(f64, Point, String)> = Vec::new();
        let line = |(start, end, bound): (Point, Point, Bound)| {
            let line = match bound {
                Bound::Sight => SightLine::End,
                Bound::Face(Some(_)) => SightLine::Known,
                Bound::Face(None) => SightLine::Unknown,
            };
            if let Bound::Face(Some(face)) = bound
                && !matches!(face.blocker, Blocker::Wall { .. })
            {
                let name = name_of(world, face.blocker, language);
                names.push(((end - start).norm(), nalgebra::center(&start, &end), name));
            }
            (start, end, line)
        };
        let outline: Vec<_> = seen.operative.outline().map(line).collect();
        // Of each thing its longest face bears the name.
        names.order_by(|a, b| b.0.total_cmp(&a.0));
        let mut told: Vec<(Point, String)> = Vec::new();
        for (_, at, name) in names {
            if told.iter().all(|(_, known)| *known != name) {
                told.push((at, name));
            }
        }
        let fragment = seen.operative.plan().fragments().next();
        let drawing = SightDrawing {
            title: told!(language, "operative-model"),
            passframes: seen
                .operative
                .passframes()
                .iter()
                .map(|frame| {
                    (
                        frame.polygon.clone(),
                        format!(
                            "{} {}",
                            frame.id,
                            kind_of_floor(seen.operative.kind(frame)).say(language)
                        ),
                    )
                })
                .collect(),
            dead_zones: fragment.map_or_else(Vec::new, |floor| floor.dead_zones().to_vec()),
            outline,
            names: told,
            robot: seen.pose,
            radius: world.robot.radius.get(),
            legend: vec![
                (SightSign::Passframe, told!(language, "sign-passframe")),
                (SightSign::DeadZone, told!(language, "sign-dead-zone")),
                (SightSign::Line(SightLine::Known), told!(language, "sign-known-face")),
                (SightSign::Line(SightLine::Unknown), told!(language, "sign-unknown-face")),
                (SightSign::Line(SightLine::End), told!(language, "sign-end-of-sight")),
            ],
            language,
        };
        Ok(beside(&plan, &sight_svg(&drawing)))
    }
}

/// What an entity is called in a language.
pub(super) fn named(world: &World, entity: Entity, language: Language) -> String {
    let english = english_name(world, entity);
    match language {
        Language::English if !english.is_empty() => english.to_owned(),
        _ => world.name(entity).to_owned(),
    }
}

/// What people call what a face is of.
fn name_of(world: &World, blocker: Blocker, language: Language) -> String {
    let entity = match blocker {
        Blocker::Replica { replica, .. } | Blocker::ReplicaLeaf { replica, .. } => {
            Entity::Replica(replica)
        }
        Blocker::DoorLeaf { door, .. } => Entity::Door(door),
        Blocker::Wall { area, .. } | Blocker::Floor { area, .. } => Entity::Area(area),
        Blocker::Zone { zone } => Entity::Zone(zone),
    };
    let name = named(world, entity, language);
    match blocker {
        Blocker::Wall { .. } => told!(language, "wall-named", name),
        _ => name,
    }
}

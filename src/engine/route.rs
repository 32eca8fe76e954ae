//! Ways over the floor, and where things are to be stood at.

use crate::geometry::{Method, NoRoute, Passed, PassframeId, Route};
use crate::map::Entity;
use crate::units::{AreaId, Bilingual, Deg, MapId, Point, Pose, said};

use super::located::{End, Located};
use super::{Error, RequestError, State};

/// A way from one place to another, or why there is none.
#[derive(Debug, Clone)]
pub struct RouteAnswer {
    pub map: MapId,
    pub from: String,
    pub to: String,
    /// What `to` names.
    pub end: End,
    pub route: Result<Route, NoRoute>,
    /// Names of the Areas passed, in order, and of the doors between them.
    pub stages: Vec<Stage>,
    /// The Passframes passed, in order.
    pub chain: Vec<(AreaId, PassframeId)>,
}

/// A part of a way within one Area.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stage {
    pub area: AreaId,
    /// Index in [`crate::geometry::FloorPlan::doorways`] of the doorway by which the Area is left.
    pub leaves_by: Option<usize>,
}

impl State {
    /// A way between two places given by name or as `X,Y`, over the floor as it is believed to be now, doors as they
    /// stand: see [`State::journey`] for one that opens doors and rides lifts.
    ///
    /// # Errors
    /// A name that means nothing, or places on different maps. No way at all is an answer, not an error.
    pub fn route(&self, from: &str, to: &str, method: Method) -> Result<RouteAnswer, Error> {
        let around = self.around()?;
        let world = around.world();
        let (start, goal) = (self.locate_name(from)?, self.locate_name(to)?);
        if start.map != goal.map {
            return Err(RequestError::OtherMap { from: from.to_owned(), to: to.to_owned() }.into());
        }
        let floor = around.floor(start.map)?;
        let route = floor.route(world, start.at, goal.target, method);
        let route = route.map(|route| (floor.passed(&route), route));
        Ok(RouteAnswer::new(start.map, from, (to, goal.end), route))
    }

    /// Where a named place is, or a point written as `X,Y`.
    ///
    /// # Errors
    /// A name that means nothing, or something where one cannot stand.
    pub fn locate_name(&self, name: &str) -> Result<Located, Error> {
        if is_pair(name) {
            let pose = Self::parse_pose(name)?;
            return self.locate_point(self.map_named(None)?, pose.at);
        }
        self.locate_entity(self.find(name)?)
    }

    /// A point of a Map, as an end of a way.
    ///
    /// # Errors
    /// It lies in no Area.
    pub fn locate_point(&self, map: MapId, at: Point) -> Result<Located, Error> {
        self.around()?.locate_point(map, at)
    }

    /// Where an entity is, as an end of a way.
    ///
    /// # Errors
    /// It is something where one cannot stand.
    pub fn locate_entity(&self, entity: Entity) -> Result<Located, Error> {
        self.around()?.locate_entity(entity)
    }

    /// Reads `X,Y` or `X,Y,HEADING` in cm and degrees.
    ///
    /// # Errors
    /// [`RequestError::BadPose`].
    pub fn parse_pose(text: &str) -> Result<Pose, RequestError> {
        let bad = |reason: Bilingual| RequestError::BadPose { text: text.to_owned(), reason };
        let numbers: Vec<f64> = text
            .split(',')
            .map(|part| part.trim().parse::<f64>())
            .collect::<Result<_, _>>()
            .map_err(|e| bad(said!("numbers-wanted", reason = e.to_string())))?;
        let (x, y, heading) = match numbers[..] {
            [x, y] => (x, y, 0.0),
            [x, y, heading] => (x, y, heading),
            _ => {
                return Err(bad(said!("two-or-three-numbers")));
            }
        };
        let length =
            |v| crate::units::Cm::new(v).map(crate::units::Cm::get).map_err(|e| bad(e.into()));
        Ok(Pose {
            at: Point::new(length(x)?, length(y)?),
            heading: Deg::new(heading).map_err(|e| bad(e.into()))?,
        })
    }
}

impl RouteAnswer {
    pub(super) fn new(
        map: MapId,
        from: &str,
        (to, end): (&str, End),
        found: Result<(Passed, Route), NoRoute>,
    ) -> Self {
        let (route, passed) = match found {
            Ok((passed, route)) => (Ok(route), passed),
            Err(no) => (Err(no), Passed::default()),
        };
        let (stages, chain) = (stages(&passed), passed.chain);
        Self { map, from: from.to_owned(), to: to.to_owned(), end, route, stages, chain }
    }
}

/// The Areas of a way and the doorways between them.
pub(super) fn stages(passed: &Passed) -> Vec<Stage> {
    let mut areas: Vec<AreaId> = passed.chain.iter().map(|(area, _)| *area).collect();
    areas.dedup();
    let leaves_by = passed.doorways.iter().copied().map(Some).chain(std::iter::repeat(None));
    areas.into_iter().zip(leaves_by).map(|(area, leaves_by)| Stage { area, leaves_by }).collect()
}

/// Numbers divided by commas, sound or not: coordinates are meant, not a name.
pub(super) fn is_pair(text: &str) -> bool {
    text.contains(',') && text.split(',').all(|part| part.trim().parse::<f64>().is_ok())
}

//! Where the scans of a log can have been taken, on the Map (SPEC L2, L3).

use crate::language::Language;
use crate::sensing::{
    Belief, Chart, Event, Fit, Localiser, Move, Options, Tracker, Unknown, telling_move,
};
use crate::units::{MapId, Pose, told, word};

use super::news::move_in_words;
use super::{Error, RequestError, Sighted, State, Whereabout};

/// A pose that a scan fits.
#[derive(Debug, Clone)]
pub struct FoundPose {
    pub pose: Pose,
    /// Standard deviation of the position, cm, in its worst direction; of the heading, degrees.
    pub deviation: (f64, f64),
    /// Share of the beams that end where the Map says, and of those that go through what it has.
    pub explained: f64,
    pub through: f64,
    /// None outside of every Area.
    pub place: Option<Whereabout>,
}

/// Why it is not told where a scan was taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Unplaced {
    /// Too little returned.
    TooLittle,
    /// Nothing on the map fits well enough.
    Nowhere,
    /// One place fits, and it is not sure.
    Unsure,
    /// More places fit than are looked through: so many at least.
    TooMany(usize),
}

/// What one scan says of where it was taken.
#[derive(Debug, Clone)]
pub struct FoundScan {
    /// From 1.
    pub scan: usize,
    /// Of the log, from 1.
    pub line: usize,
    /// None where no place is told; several where the scan cannot tell them apart, the best first.
    pub poses: Vec<FoundPose>,
    /// Why no place is told.
    unplaced: Option<Unplaced>,
    /// Where several poses fit, the move that tells most of them apart.
    pub telling: Option<Move>,
    /// From which angle on it is told as a turn right round, degrees.
    about: f64,
    event: Option<Event>,
}

impl State {
    /// Where scans of a log can have been taken, by the faces of a map at `height` cm above its zero: each by itself, without
    /// a guess, or followed from one to the next by odometry. The scan `only`, from 1, or all that there are.
    ///
    /// # Errors
    /// There is no map, no such scan, no log, or a scan to be followed that has no odometry.
    pub fn find_scans(
        &self,
        map: MapId,
        log: &Sighted,
        only: Option<usize>,
        height: f64,
        follow: bool,
    ) -> Result<Vec<FoundScan>, Error> {
        let chart = Chart::of_map(self.world()?, self.floor(map)?, height);
        let localiser = Localiser::new(&chart, Options::default());
        let mut tracker = Tracker::new(&localiser);
        let log = log.log().ok_or(RequestError::NoLog)?;
        if let Some(scan) = only.filter(|&scan| scan == 0 || scan > log.scans.len()) {
            return Err(RequestError::NoScan { scan, count: log.scans.len() }.into());
        }
        let radius = self.world()?.robot.radius.get();
        let about = self.relations()?.thresholds().turn_about;
        let mut found = Vec::new();
        for (scan, told) in (1..).zip(&log.scans) {
            let is_asked = only.is_none_or(|only| only == scan);
            if !is_asked && !follow || only.is_some_and(|only| scan > only) {
                continue;
            }
            let sensor = log.sensor(told);
            let (answer, event) = if follow {
                let odometry = told.odometry.ok_or(RequestError::NoOdometry { line: told.line })?;
                let event = tracker.scan(sensor, &told.ranges, odometry);
                (tracker.belief().clone(), Some(event))
            } else {
                (localiser.locate(sensor, &told.ranges).into(), None)
            };
            if is_asked {
                let unplaced = Unplaced::of(&answer);
                let told_fits = answer.fits().iter().filter(|_| unplaced.is_none());
                let poses = told_fits.map(|fit| self.found_pose(map, fit)).collect();
                let telling = telling_move(&chart, answer.fits(), radius);
                let line = told.line;
                found.push(FoundScan { scan, line, poses, unplaced, telling, about, event });
            }
        }
        Ok(found)
    }

    fn found_pose(&self, map: MapId, fit: &Fit) -> FoundPose {
        let pose = Pose::from(fit.pose);
        let (place, heading) = fit.deviations();
        FoundPose {
            pose,
            deviation: (place, heading.to_degrees()),
            explained: fit.explained,
            through: fit.through,
            place: self.locate(map, pose, false).ok(),
        }
    }
}

impl Unplaced {
    /// None where a place is told, or several are.
    fn of(belief: &Belief) -> Option<Self> {
        let Belief::Lost(why) = belief else { return None };
        Some(match why {
            Unknown::TooLittle => Self::TooLittle,
            Unknown::Nowhere => Self::Nowhere,
            Unknown::Unsure => Self::Unsure,
            Unknown::TooMany(fits) => Self::TooMany(fits.len()),
        })
    }

    /// One word for programs.
    fn code(self) -> &'static str {
        match self {
            Self::TooLittle => "too_little",
            Self::Nowhere => "nowhere",
            Self::Unsure => "unsure",
            Self::TooMany(_) => "too_many",
        }
    }

    /// «то, что видно, на карте ни к чему не подходит».
    fn in_words(self, language: Language) -> String {
        let why = match self {
            Self::TooLittle => {
                word!("too-little-seen")
            }
            Self::Nowhere => word!("fits-nowhere"),
            Self::Unsure => word!("fits-one"),
            Self::TooMany(least) => {
                // One that slides along a corridor is as many as one likes.
                let at_least = match least > 1 {
                    true => told!(language, "at-least", least),
                    false => String::new(),
                };
                return told!(language, "fits-too-many", at_least);
            }
        };
        why.say(language).into_owned()
    }
}

impl FoundScan {
    /// Whether one place is told.
    #[must_use]
    pub fn is_unique(&self) -> bool {
        self.poses.len() == 1
    }

    /// One word for what is told: `unique`, `ambiguous`, or why no place is.
    #[must_use]
    pub fn outcome(&self) -> &'static str {
        match self.unplaced {
            Some(why) => why.code(),
            None if self.is_unique() => "unique",
            None => "ambiguous",
        }
    }

    /// Where more places fit than are looked through: so many at least.
    #[must_use]
    pub fn at_least(&self) -> Option<usize> {
        match self.unplaced? {
            Unplaced::TooMany(least) => Some(least),
            _ => None,
        }
    }

    /// Why no place is told, where none is.
    #[must_use]
    pub fn unknown_in_words(&self, language: Language) -> Option<String> {
        Some(self.unplaced?.in_words(language))
    }

    /// What was remarkable about the step from the scan before, where that was followed.
    #[must_use]
    pub fn event(&self) -> Option<&'static str> {
        Some(match self.event? {
            Event::Steady => "steady",
            Event::Narrowed => "narrowed",
            Event::GivenUp => "given_up",
            Event::Lost => "lost",
        })
    }

    /// The move that would tell the poses apart, where several fit and one does: «повернуться на 90° налево».
    #[must_use]
    pub fn telling_in_words(&self, language: Language) -> Option<String> {
        self.telling.map(|by| move_in_words(by, self.about, language))
    }

    /// What was remarkable about the step to it, where anything was.
    #[must_use]
    pub fn event_in_words(&self, language: Language) -> Option<String> {
        let event = match self.event? {
            // Why a place is not told stands in its stead.
            Event::Steady | Event::Lost => return None,
            Event::Narrowed => word!("fewer-places-left"),
            Event::GivenUp => word!("belief-given-up"),
        };
        Some(event.say(language).into_owned())
    }
}

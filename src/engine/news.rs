//! What the robot can say of how its world differs from the map, of what it has not seen, and of how sure it is where it is
//! (SPEC L5).

use std::collections::BTreeSet;

use crate::language::Language;
use crate::language::question::News;
use crate::language::report::Detail;
use crate::language::words::enumerate;
use crate::map::is_on;
use crate::robot::starting_pose;
use crate::sensing::{Chart, Fit, Move, telling_move};
use crate::store::{FoundAt, Observation, Timestamp};
use crate::units::{Lengths, MapId, ReplicaId, told, word};

use super::memory::ROBOT;
use super::obstacles::is_obstacle;
use super::position::describe;
use super::{Error, Sighted, State, decimal};

/// Of more places one does not tell.
const TOLD: usize = 4;

impl State {
    /// What is not as the map has it at a moment, as far as was seen or done.
    ///
    /// # Errors
    /// There is no map, or a record is broken.
    pub fn news(&self, at: Timestamp) -> Result<Vec<News>, Error> {
        let (world, memory) = (self.world()?, self.memory()?);
        let mut news = Vec::new();
        if let Some(reader) = &self.reader {
            for id in reader.observed()? {
                let Some(replica) = world.replicas.get(&id) else { continue };
                if memory.carried.contains_key(&id) {
                    continue;
                }
                let belief = reader.belief(replica, at)?;
                if !belief.is_surveyed {
                    news.push(News::Moved(id, belief.place.area));
                } else if belief.missed.is_some() {
                    news.push(News::Missed(id));
                }
            }
        }
        let mut doors: Vec<_> = memory.doors.iter().collect();
        doors.retain(|(id, state)| world.doors.get(*id).is_some_and(|d| d.state != **state));
        news.extend(doors.into_iter().map(|(id, state)| News::Door(*id, *state)));
        let now = self.around()?.world();
        news.extend(now.replicas.keys().filter(|id| is_obstacle(**id)).map(|id| News::New(*id)));
        for (&id, &on) in &memory.devices {
            let was = world.replicas.get(&id).and_then(|replica| is_on(&replica.properties));
            if was.is_some_and(|was| was != on) {
                news.push(News::Switched(id, on));
            }
        }
        let taken = memory.carried.keys().filter(|id| world.replicas.contains_key(*id));
        news.extend(taken.map(|id| News::Taken(*id)));
        Ok(news)
    }

    /// Things of the map that the robot itself has never seen where they are or elsewhere, and how many it has.
    ///
    /// # Errors
    /// There is no map, or a record is broken.
    pub fn unseen(&self) -> Result<(Vec<ReplicaId>, usize), Error> {
        let world = self.world()?;
        let mut own = BTreeSet::new();
        if let Some(reader) = &self.reader {
            let is_own = |o: &Observation| o.observer == ROBOT && o.seen.is_some();
            for id in reader.observed()? {
                if reader.observations(id)?.iter().any(is_own) {
                    own.insert(id);
                }
            }
        }
        let all = world.replicas.keys().copied();
        let unseen: Vec<ReplicaId> = all.filter(|id| !own.contains(id)).collect();
        let seen = world.replicas.len() - unseen.len();
        Ok((unseen, seen))
    }

    /// How well the robot knows where it is, in words; none where it is nowhere.
    ///
    /// # Errors
    /// There is no map, or a record is broken.
    pub fn sureness(&self, language: Language) -> Result<Option<String>, Error> {
        let memory = self.memory()?;
        let told_at = match &self.reader {
            Some(reader) => reader.robot_pose()?.map(|(.., stamp)| stamp.at),
            None => None,
        };
        // What the laser told counts until the robot went on or was put elsewhere.
        let is_latest = memory.found.first().is_some_and(|f| told_at.is_none_or(|at| at <= f.at));
        match &memory.found[..] {
            [only] if is_latest => Ok(self.told_of(only, language)?),
            [_, ..] if is_latest => Ok(Some(self.one_of(&memory.found, language)?)),
            _ => {
                let Some((map, pose)) = memory.pose.or_else(|| starting_pose(self.world().ok()?))
                else {
                    return Ok(None);
                };
                let place = self.place_in_words(map, pose, language)?;
                let how = match memory.pose.is_some() {
                    true => told!(language, "known-by-word"),
                    false => told!(language, "known-by-map"),
                };
                Ok(place.map(|place| format!("{} {how}", with_stop(&place))))
            }
        }
    }

    fn told_of(&self, found: &FoundAt, language: Language) -> Result<Option<String>, Error> {
        let Some(place) = self.place_in_words(found.map, found.pose, language)? else {
            return Ok(None);
        };
        let (off, turn) = found.deviation;
        let off = Lengths::said().told(off.max(1.0), 0, language);
        let share = (found.explained * 100.0).round();
        let turn = decimal(turn.max(0.1), "°", language);
        let place = with_stop(&place);
        Ok(Some(told!(language, "known-within", place, off, turn, share)))
    }

    /// «либо в Комнате-В, либо в Комнате-Y; различить поможет …»
    fn one_of(&self, found: &[FoundAt], language: Language) -> Result<String, Error> {
        let mut places: Vec<String> = Vec::new();
        for at in found {
            if let Some(place) = self.place_in_words(at.map, at.pose, language)? {
                let place = place.trim_end_matches('.');
                let place = place.trim_start_matches(&*word!("i-am").say(language));
                if !places.iter().any(|known| known == place) {
                    places.push(place.to_owned());
                }
            }
        }
        let more = places.len().saturating_sub(TOLD);
        places.truncate(TOLD);
        let count = found.len();
        let mut text = match places.len() {
            0 | 1 => {
                let place = places.first().cloned().unwrap_or_default();
                told!(language, "unsure-of-the-pose", place, count)
            }
            _ => {
                let places = places.join(&word!("or-else").say(language));
                told!(language, "unsure-of-the-place", places)
            }
        };
        if more > 0 {
            text += &told!(language, "and-more-more", more);
        }
        let about = self.relations()?.thresholds().turn_about;
        let told = self.telling_move(found)?.map_or_else(
            || told!(language, "no-move-would-tell"),
            |by| told!(language, "to-tell", move_in_words = move_in_words(by, about, language)),
        );
        Ok(format!("{text}; {told}"))
    }

    /// A move that would tell apart the poses that fit.
    ///
    /// # Errors
    /// There is no map.
    fn telling_move(&self, found: &[FoundAt]) -> Result<Option<Move>, Error> {
        let Some(first) = found.first() else { return Ok(None) };
        let world = self.world()?;
        let chart = Chart::of_map(world, self.floor(first.map)?, Sighted::LASER_HEIGHT);
        let fits: Vec<Fit> = found
            .iter()
            .map(|at| {
                let turn = at.pose.heading.radians();
                Fit {
                    pose: nalgebra::Isometry2::new(at.pose.at.coords, turn),
                    covariance: nalgebra::Matrix3::zeros(),
                    explained: at.explained,
                    through: 0.0,
                    likeness: 0.0,
                }
            })
            .collect();
        Ok(telling_move(&chart, &fits, world.robot.radius.get()))
    }

    fn place_in_words(
        &self,
        map: MapId,
        pose: crate::units::Pose,
        language: Language,
    ) -> Result<Option<String>, Error> {
        let found = describe(self.world()?, self.relations()?, map, pose, false);
        Ok(found.map(|found| found.position.say_in(language, Detail::Spot)))
    }
}

fn with_stop(text: &str) -> String {
    format!("{};", text.trim_end_matches('.'))
}

/// «повернуться на 90° налево и проехать 2 м вперёд»; `about` is the angle from which on a turn is one right round, degrees.
pub(super) fn move_in_words(by: Move, about: f64, language: Language) -> String {
    let degrees = by.turn.to_degrees().abs().round();
    let mut steps = Vec::new();
    if degrees >= 1.0 {
        let left = by.turn > 0.0;
        steps.push(match (degrees >= about, left) {
            (true, _) => told!(language, "turn-round"),
            (_, true) => told!(language, "turn-left", degrees),
            (_, false) => told!(language, "turn-right", degrees),
        });
    }
    if by.ahead > 0.0 {
        let far = decimal(by.ahead / 100.0, "", language);
        steps.push(told!(language, "drive-ahead", far = far.trim_end()));
    }
    enumerate(&steps, language)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_right_round_is_told_from_the_threshold_on() {
        let by = Move { turn: 160_f64.to_radians(), ahead: 0.0, tells: 1.0 };
        assert_eq!(move_in_words(by, 175.0, Language::English), "turn 160° to the left");
        assert_eq!(move_in_words(by, 160.0, Language::English), "turn round");
    }
}

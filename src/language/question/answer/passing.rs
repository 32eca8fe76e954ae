//! Ways told by the rooms and doors that they lead through.
//!
//! Invariant: a way that is told is the one that the robot would drive; doors that are shut on it are named.

use super::Draft;
use crate::map::Entity;
use crate::question::knowledge::Knowledge;
use crate::question::query::{Noun, Passing, Rel, Restriction, Thing};
use crate::question::senses::{Crossing, RoomPath};
use crate::question::{Doubt, Said};
use crate::report::Detail;
use crate::units::AreaId;
use crate::words::{english, length};

impl Knowledge<'_> {
    pub(super) fn passing(
        &self,
        from: Option<&Noun>,
        to: &Noun,
        (through, avoiding): (&[Noun], &[Noun]),
        asks: Passing,
    ) -> Result<Draft, Doubt> {
        let start = from.map_or(Ok(Thing::Robot), |noun| self.one(noun))?;
        let goal = self.one(to)?;
        let each = |nouns: &[Noun]| -> Result<Vec<Thing>, Doubt> {
            let found = nouns.iter().map(|noun| self.definite(noun)).collect::<Result<Vec<_>, _>>();
            Ok(found?.concat())
        };
        let (through, mut avoided) = (each(through)?, each(avoiding)?);
        // Who takes no lift takes it from no storey.
        for (_, stops) in &self.world.domain.lifts {
            let stops = stops.iter().map(|s| Thing::Entity(Entity::Area(s.area)));
            let stops: Vec<Thing> = stops.collect();
            if avoided.iter().any(|t| stops.contains(t)) {
                avoided.extend(stops);
            }
        }
        let (ends, goals) = (self.rooms_of(start), self.rooms_of(goal));
        if ends.is_empty() || goals.is_empty() {
            let text =
                self.pick("где это, на карте не указано", "the map does not tell where it is");
            return Ok(Draft::new(Said::Unknown, text.to_owned()).about(&[goal]));
        }
        if matches!(asks, Passing::Far | Passing::Long)
            && let Some(told) = self.way_round(start, goal, &avoided, asks)
        {
            return Ok(told.about(&[goal]));
        }
        let next = self.passage(&ends, &goals);
        if next.is_none() {
            let (from, to) = (self.place(Rel::From, &[start]), self.place(Rel::To, &[goal]));
            let text = match self.is_russian() {
                true => format!("нет, по карте {from} {to} не ведут ни двери, ни проходы"),
                false => format!("no, by the map no doors or passages lead {from} {to}"),
            };
            return Ok(Draft::new(Said::No, text).about(&[goal]));
        }
        let yes = self.pick("да", "yes");
        let no = self.pick("нет", "no");
        // A door that is shut joins two rooms all the same, whichever way is driven.
        let led = |way: &RoomPath| match (way.crossings.is_empty(), self.is_russian()) {
            (true, _) => self.told(way),
            (false, true) => format!("путь ведёт {}", self.told(way)),
            (false, false) => format!("the way leads {}", self.told(way)),
        };
        if let (Passing::Directly, Some(next)) = (asks, next.filter(|n| n.crossings.len() <= 1)) {
            let text = format!("{yes}, {}", led(&next));
            return Ok(Draft::new(Said::Yes, text).about(&[goal]));
        }
        let any = match self.by_rooms(start, goal, &[], &[]) {
            Ok(any) => any,
            Err(why) => {
                // What is asked of all ways is answered of all.
                let at_all = matches!(
                    asks,
                    Passing::Whether
                        | Passing::Must
                        | Passing::Directly
                        | Passing::Unopened
                        | Passing::Opens
                );
                let text = match (at_all, self.is_russian()) {
                    (true, true) => format!("проехать туда нельзя вовсе: {why}"),
                    (true, false) => format!("there is no way at all: {why}"),
                    (false, true) => format!("проехать туда нельзя: {why}"),
                    (false, false) => format!("there is no way: {why}"),
                };
                return Ok(Draft::new(Said::No, text).about(&[goal]));
            }
        };
        // What all ways lead through cannot be avoided.
        let must = asks == Passing::Must;
        if must {
            avoided.extend(&through);
        }
        let opens = matches!(asks, Passing::Unopened | Passing::Opens);
        if opens {
            let shut = self.openings().iter().map(|gate| gate.thing);
            avoided.extend(shut.filter(|gate| self.is_shut(*gate)));
        }
        let through = if must { &[][..] } else { &through[..] };
        let way = self.by_rooms(start, goal, through, &avoided).ok();
        // Who comes through a room twice on the way does not need to pass where he turns round.
        let way = way.filter(|way| asks == Passing::How || way.is_straight());
        let (said, text) = match (asks, way) {
            (Passing::Doors | Passing::Rooms, Some(way)) => {
                return Ok(self.passed(&way, asks).about(&[goal]));
            }
            (Passing::How | Passing::Far | Passing::Long, Some(way)) => {
                (Said::Found, self.told(&way))
            }
            (Passing::Directly, _) => (Said::No, format!("{no}, {}", led(&any))),
            (Passing::Must, Some(way)) => (Said::No, format!("{no}, {}", led(&way))),
            (Passing::Must, None) => {
                let text = self.pick("да, другого пути нет", "yes, there is no other way");
                (Said::Yes, format!("{text}: {}", self.told(&any)))
            }
            (Passing::Opens, Some(way)) => {
                let none = self.pick("нет, на пути всё открыто", "no, all is open on the way");
                (Said::No, format!("{none}: {}", self.told(&way)))
            }
            (Passing::Opens, None) => (Said::Yes, format!("{yes}: {}", self.told(&any))),
            (Passing::Whether | Passing::Unopened, Some(way)) => {
                (Said::Yes, format!("{yes}, {}", led(&way)))
            }
            (_, None) => {
                let text = self.pick("нет, путь только такой", "no, this is the only way");
                (Said::No, format!("{text}: {}", self.told(&any)))
            }
        };
        Ok(Draft::new(said, text).about(&[goal]))
    }

    /// "What is between the bedroom and the kitchen?": of rooms that neither door nor passage joins, the way that leads from
    /// the one to the other.
    pub(super) fn rooms_between(&self, noun: &Noun, found: &[Thing]) -> Option<Draft> {
        let between = |r: &&Restriction| r.rel == Rel::Between && !r.negated;
        let place = noun.restrictions.iter().find(between).filter(|_| found.is_empty())?;
        let ends = place.anchors.iter().map(|anchor| self.one(anchor));
        let ends: Vec<Thing> = ends.collect::<Result<_, _>>().ok()?;
        let [start, goal] = ends[..] else { return None };
        start.area().zip(goal.area())?;
        let way = self.by_rooms(start, goal, &[], &[]).ok()?;
        if way.crossings.len() < 2 {
            return None;
        }
        let (place, told) = (self.place(Rel::Between, &ends), self.told(&way));
        let text = match self.is_russian() {
            true => format!("{place} нет ни двери, ни прохода; путь – {told}"),
            false => format!("there is no door or passage {place}; the way is {told}"),
        };
        Some(Draft::new(Said::Nothing, text).about(&ends))
    }

    /// How long the way is, or takes, that goes round what is avoided; none where all ways lead through it.
    fn way_round(
        &self,
        start: Thing,
        goal: Thing,
        avoided: &[Thing],
        asks: Passing,
    ) -> Option<Draft> {
        let from = Some(start).filter(|start| *start != Thing::Robot);
        let way = self.senses.way_without(from, goal, avoided, self.language).ok()?;
        if asks == Passing::Long {
            let (seconds, text) = self.takes(&way);
            return Some(Draft::new(Said::Found, text).number(seconds));
        }
        let far = length(way.length, self.language);
        let text = format!("{far}: {}", self.told(&way.rooms));
        Some(Draft::new(Said::Found, text).number(way.length))
    }

    /// The way that is driven, by its rooms: through these rooms and doors in their order, and without those.
    ///
    /// # Errors
    /// Why there is none.
    fn by_rooms(
        &self,
        from: Thing,
        to: Thing,
        through: &[Thing],
        avoided: &[Thing],
    ) -> Result<RoomPath, String> {
        let drive = |from: Thing, to: Thing| {
            let start = Some(from).filter(|start| *start != Thing::Robot);
            match avoided.is_empty() {
                true => self.senses.way(start, to, self.language, Detail::Region),
                false => self.senses.way_without(start, to, avoided, self.language),
            }
            .map(|way| way.rooms)
        };
        let Some((next, rest)) = through.split_first() else { return drive(from, to) };
        let Some(gate) = self.opening(*next) else {
            let first = drive(from, *next)?;
            // Who turns round to go on does so where nothing else leads on.
            let behind = std::iter::once(first.start).chain(first.between());
            let behind = behind.map(|area| Thing::Entity(Entity::Area(area)));
            let behind = behind.filter(|room| room != next);
            let ahead: Vec<Thing> = avoided.iter().copied().chain(behind).collect();
            let on = self.by_rooms(*next, to, rest, &ahead);
            let on = on.or_else(|_| self.by_rooms(*next, to, rest, avoided))?;
            return Ok(first.then(None, on));
        };
        // Through a door either way, whichever is the shorter.
        let mut best: Result<RoomPath, String> = Err(String::new());
        for (near, far) in gate.areas.iter().flat_map(|a| gate.areas.iter().map(move |b| (*a, *b)))
        {
            if !gate.joins(near, far) || near == far {
                continue;
            }
            let room = |area| Thing::Entity(Entity::Area(area));
            let crossing = Crossing { by: *next, into: far };
            let first = match self.rooms_of(from).contains(&near) && from.area().is_some() {
                true => Ok(RoomPath { start: near, crossings: Vec::new() }),
                false => drive(from, room(near)),
            };
            let whole = first.and_then(|first| {
                let last = self.by_rooms(room(far), to, rest, avoided)?;
                Ok(first.then(Some(crossing), last))
            });
            best = match (best, whole) {
                (Ok(a), Ok(b)) if b.crossings.len() < a.crossings.len() => Ok(b),
                (Err(_), found) => found,
                (known, _) => known,
            };
        }
        best
    }

    /// «из Комнаты-В через Проход-ВК в Коридор, затем через Дверь-КY в Комнату-Y; Дверь-КY закрыта»
    fn told(&self, way: &RoomPath) -> String {
        let area = |id: AreaId| Thing::Entity(Entity::Area(id));
        let start = match self.is_russian() {
            true => self.place(Rel::From, &[area(way.start)]),
            false => format!("from {}", self.name(area(way.start))),
        };
        if way.crossings.is_empty() {
            let here = self.place(Rel::In, &[area(way.start)]);
            return match self.is_russian() {
                true => format!("это то же помещение: {here}"),
                false => format!("it is the same room: {here}"),
            };
        }
        let steps = way.crossings.iter().map(|c| {
            let by = match c.by.area() {
                Some(_) => self.pick("на лифте", "by lift").to_owned(),
                None => self.place(Rel::Through, &[c.by]),
            };
            format!("{by} {}", self.place(Rel::To, &[area(c.into)]))
        });
        let then = self.pick(", затем ", ", then ");
        let told = format!("{start} {}", steps.collect::<Vec<_>>().join(then));
        let shut: Vec<String> = self.shut_on(way);
        if shut.is_empty() { told } else { format!("{told}; {}", shut.join(", ")) }
    }

    /// «Дверь-КY закрыта», of every shut door on a way.
    fn shut_on(&self, way: &RoomPath) -> Vec<String> {
        let shut = way.crossings.iter().filter(|c| self.is_shut(c.by));
        let told = shut.filter_map(|c| {
            let (status, _) = *self.statuses(c.by).first()?;
            let value = self.lexicon().values.of_door(status)?;
            let is = if self.is_russian() { "" } else { "is " };
            Some(format!("{} {is}{}", self.name(c.by), self.value(value, c.by)))
        });
        told.collect()
    }

    /// How many doors, or rooms, a way leads through.
    fn passed(&self, way: &RoomPath, asks: Passing) -> Draft {
        let told = self.told(way);
        if asks == Passing::Rooms {
            let rooms: Vec<Thing> =
                way.between().into_iter().map(|a| Thing::Entity(Entity::Area(a))).collect();
            let text = match (rooms.is_empty(), self.is_russian()) {
                (true, true) => format!("ни одной: {told}"),
                (true, false) => format!("none: {told}"),
                (false, true) => {
                    format!("комнат на пути {} ({}): {told}", rooms.len(), self.list(&rooms))
                }
                (false, false) => format!(
                    "{} on the way ({}): {told}",
                    english::count(rooms.len() as u64, "room"),
                    self.list(&rooms)
                ),
            };
            let number = rooms.len() as f64;
            return Draft::new(Said::Found, text).with(rooms).number(number);
        }
        let gates = way.crossings.iter().filter_map(|c| self.opening(c.by));
        let (passages, doors): (Vec<_>, Vec<_>) = gates.partition(|g| g.is_passage);
        let things: Vec<Thing> = doors.iter().map(|g| g.thing).collect();
        let counted = match (passages.len(), self.is_russian()) {
            (0, true) => format!("дверей на пути {}", doors.len()),
            (0, false) => format!("{} on the way", english::count(doors.len() as u64, "door")),
            (n, true) => format!("дверей на пути {}, проходов без двери {n}", doors.len()),
            (n, false) => format!(
                "{} and {} on the way",
                english::count(doors.len() as u64, "door"),
                english::count(n as u64, "passage without a door")
            ),
        };
        let number = things.len() as f64;
        Draft::new(Said::Found, format!("{counted}: {told}")).with(things).number(number)
    }
}

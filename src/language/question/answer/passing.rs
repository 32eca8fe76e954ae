//! Ways told by the rooms and doors that they lead through.
//!
//! Invariant: doors that are shut on a way are named.

use super::Draft;
use crate::map::Entity;
use crate::question::knowledge::{Knowledge, Limits, Passage};
use crate::question::query::{Noun, Passing, Rel, Thing};
use crate::question::{Doubt, Said};
use crate::report::Detail;
use crate::units::AreaId;
use crate::words::english;

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
        let free = Limits::default();
        // What all ways lead through cannot be avoided.
        let must = asks == Passing::Must;
        if must {
            avoided.extend(&through);
        }
        let limits = Limits {
            avoiding: avoided.clone(),
            open_only: matches!(asks, Passing::Unopened | Passing::Opens),
        };
        let through = if must { &[][..] } else { &through[..] };
        // What stands in a room that is to be avoided is not come to.
        let reached = |area: &AreaId| {
            goal.area().is_some() || !avoided.contains(&Thing::Entity(Entity::Area(*area)))
        };
        let goals_left: Vec<AreaId> = goals.iter().copied().filter(reached).collect();
        let way = self.passage_through(&ends, &goals_left, through, &limits);
        // Who comes through a room twice on the way does not need to pass where he turns round.
        let way = way.filter(|way| asks == Passing::How || way.is_straight());
        let any = self.passage(&ends, &goals, &free);
        let Some(any) = any else {
            let (from, to) = (self.place(Rel::From, &[start]), self.place(Rel::To, &[goal]));
            let text = match self.is_russian() {
                true => format!("нет, по карте {from} {to} не ведут ни двери, ни проходы"),
                false => format!("no, by the map no doors or passages lead {from} {to}"),
            };
            return Ok(Draft::new(Said::No, text).about(&[goal]));
        };
        let yes = self.pick("да", "yes");
        let no = self.pick("нет", "no");
        let leads = self.pick("путь ведёт", "the way leads");
        let (said, text) = match (asks, way) {
            (Passing::Doors | Passing::Rooms, Some(way)) => {
                return Ok(self.passed(&way, asks).about(&[goal]));
            }
            (Passing::How, Some(way)) => (Said::Found, self.told(&way)),
            (Passing::Directly, _) if any.crossings.len() <= 1 => {
                (Said::Yes, format!("{yes}, {leads} {}", self.told(&any)))
            }
            (Passing::Directly, _) => (Said::No, format!("{no}, {leads} {}", self.told(&any))),
            (Passing::Must, Some(way)) => (Said::No, format!("{no}, {leads} {}", self.told(&way))),
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
                match self.blocked(start, goal, &way) {
                    Some(why) => (Said::No, format!("{no}: {why}")),
                    None => (Said::Yes, format!("{yes}, {leads} {}", self.told(&way))),
                }
            }
            (_, None) => {
                let text = self.pick("нет, путь только такой", "no, this is the only way");
                (Said::No, format!("{text}: {}", self.told(&any)))
            }
        };
        Ok(Draft::new(said, text).about(&[goal]))
    }

    /// Why a way without shut doors cannot be driven, where things bar it.
    fn blocked(&self, start: Thing, goal: Thing, way: &Passage) -> Option<String> {
        if way.crossings.iter().any(|c| self.is_shut(c.by)) {
            return None;
        }
        self.senses.way(Some(start), goal, self.language, Detail::Region).err()
    }

    /// «из Комнаты-В через Проход-ВК в Коридор, затем через Дверь-КY в Комнату-Y; Дверь-КY закрыта»
    fn told(&self, way: &Passage) -> String {
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
    fn shut_on(&self, way: &Passage) -> Vec<String> {
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
    fn passed(&self, way: &Passage, asks: Passing) -> Draft {
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
        let gates = way.crossings.iter().filter_map(|c| self.gate(c.by));
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

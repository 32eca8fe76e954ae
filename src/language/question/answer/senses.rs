//! What the robot itself knows: where it stands, what it sees, what it saw when, and where things were before.
//!
//! Invariant: what was not seen is told as being by the map.

use super::Draft;
use crate::map::{DoorStatus, Entity};
use crate::question::News;
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::Extension;
use crate::question::lexicon::lower_first;
use crate::question::query::{Noun, Rel, Thing};
use crate::question::{Courtesy, speech};
use crate::question::{Doubt, Said};
use crate::report::Detail;
use crate::units::AreaId;
use crate::words::{Case, Number, enumerate};

impl Knowledge<'_> {
    pub(super) fn last_seen(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let sightings = thing.replica().map(|id| self.senses.sightings(id)).unwrap_or_default();
        let name = self.name(thing);
        let Some(last) = sightings.iter().rev().find(|s| s.place.is_some()) else {
            let place = self.short_place(thing, &mut Vec::new());
            let (is, it) = (self.is(&[thing]), self.pronoun(thing, Case::Accusative));
            let text = match self.is_russian() {
                true => format!("по карте {name} {is} {place}; сам я {it} не видел"),
                false => format!("by the map {name} {is} {place}; I have not seen {it} myself"),
            };
            return Ok(Draft::new(Said::Unknown, text).with(vec![thing]));
        };
        let place = last.place.map(|a| self.place(Rel::In, &[Thing::Entity(Entity::Area(a))]));
        let place = place.unwrap_or_default();
        let text = match self.is_russian() {
            true => {
                let seen = self.form(thing, Case::Accusative);
                format!("последний раз я видел {seen} {} {place}", last.at)
            }
            false => format!("I last saw {name} {} {place}", last.at),
        };
        Ok(Draft::new(Said::Found, text).with(vec![thing]))
    }

    /// What the robot sees from where it stands.
    fn in_view(&self) -> Vec<Thing> {
        let seen = self.senses.visible().into_iter();
        seen.map(|id| Thing::Entity(Entity::Replica(id))).collect()
    }

    /// «да, я вижу Кресло-1»
    pub(super) fn sees(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let meant = self.find(noun, true)?;
        if meant.is_empty() {
            return Err(self.none_such(noun));
        }
        let seen = self.in_view();
        let found: Vec<Thing> = meant.iter().copied().filter(|t| seen.contains(t)).collect();
        let text = match (found.is_empty(), self.is_russian()) {
            (false, true) => format!("да, я вижу {}", self.names(&found, Case::Accusative)),
            (false, false) => format!("yes, I see {}", self.list(&found)),
            (true, true) => format!("нет, отсюда я не вижу {}", self.none_of(noun)),
            (true, false) => format!("no, I do not see {} from here", self.list(&meant)),
        };
        let said = if found.is_empty() { Said::No } else { Said::Yes };
        let topic = if found.is_empty() { meant } else { found };
        Ok(Draft::new(said, text).with(topic))
    }

    pub(super) fn before(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let past = thing.replica().map(|id| self.senses.past(id)).unwrap_or_default();
        let name = self.name(thing);
        let Some(last) = past.last() else {
            let text = match self.is_russian() {
                true => format!(
                    "других мест {} в истории нет: {}",
                    self.form(thing, Case::Genitive),
                    self.where_one(thing, &mut Vec::new())
                ),
                false => format!(
                    "the history knows no other place: {}",
                    self.where_one(thing, &mut Vec::new())
                ),
            };
            return Ok(Draft::new(Said::Nothing, text).with(vec![thing]));
        };
        let mut parts = Vec::new();
        if let Some(support) = last.support {
            let support = Thing::Entity(Entity::Replica(support));
            let rel = if last.inside { Rel::In } else { Rel::On };
            parts.push(self.place(rel, &[support]));
        }
        if let Some(area) = last.area {
            parts.push(self.place(Rel::In, &[Thing::Entity(Entity::Area(area))]));
        }
        let place = parts.join(" ");
        let until = match &last.until {
            Some(until) => self.language.pick(format!("до {until}"), format!("until {until}")),
            None => self.pick("до этого", "before that").to_owned(),
        };
        let (gender, number) = self.gender(thing);
        let text = match self.is_russian() {
            true => {
                let verb = match (number, gender) {
                    (Number::Plural, _) => "находились",
                    (_, crate::Gender::Feminine) => "находилась",
                    (_, crate::Gender::Neuter) => "находилось",
                    _ => "находился",
                };
                format!("{until} {name} {verb} {place}")
            }
            false => format!("{until} {name} was {place}"),
        };
        Ok(Draft::new(Said::Found, text).with(vec![thing]))
    }

    pub(super) fn where_are_you(&self, detail: Detail) -> Draft {
        let unknown =
            || self.pick("я не знаю, где нахожусь", "I do not know where I am").to_owned();
        let text = self.senses.position(self.language, detail);
        let said = if text.is_some() { Said::Found } else { Said::Unknown };
        let room = self.area_of(Thing::Robot).map(|a| Thing::Entity(Entity::Area(a)));
        Draft::new(said, text.unwrap_or_else(unknown)).with(room.into_iter().collect())
    }

    /// Of the place of the person who asks the robot knows nothing.
    pub(super) fn where_am_i(&self) -> Draft {
        let own = self.where_are_you(Detail::default());
        let text = match self.is_russian() {
            true => format!("где вы, я не знаю; сам я вот где: {}", lower_first(&own.text)),
            false => format!("where you are I do not know; as for me: {}", own.text),
        };
        Draft { text, said: Some(Said::Unknown), ..own }
    }

    /// What the robot is, and what it can be asked and told, by examples of the map.
    pub(super) fn help(&self) -> Draft {
        let room = self.world.areas.keys().next().map(|id| Thing::Entity(Entity::Area(*id)));
        let thing = self.world.replicas.keys().next().map(|id| Thing::Entity(Entity::Replica(*id)));
        let mut asked = Vec::new();
        if let Some(thing) = thing {
            asked.push(match self.is_russian() {
                true => format!("«Где {}?»", self.name(thing)),
                false => format!("\"Where is {}?\"", self.name(thing)),
            });
        }
        if let Some(room) = room {
            asked.push(match self.is_russian() {
                true => format!("«Что находится {}?»", self.place(Rel::In, &[room])),
                false => format!("\"What is {}?\"", self.place(Rel::In, &[room])),
            });
            asked.push(match self.is_russian() {
                true => format!("«Как пройти {}?»", self.place(Rel::To, &[room])),
                false => format!("\"How do I get {}?\"", self.place(Rel::To, &[room])),
            });
        }
        let asked = enumerate(&asked, self.language);
        let text = match self.is_russian() {
            true => format!("я робот и знаю эту карту. Спросите, например: {asked}"),
            false => format!("I am a robot and know this map. Ask, for example: {asked}"),
        };
        let orders = enumerate(&self.orders_for_example(room), self.language);
        let text = match (orders.is_empty(), self.is_russian()) {
            (true, _) => text,
            (_, true) => format!("{text}. Или прикажите: {orders}"),
            (_, false) => format!("{text}. Or command: {orders}"),
        };
        Draft::new(Said::Found, text)
    }

    /// An order of each of the commonest kinds that this map allows.
    fn orders_for_example(&self, room: Option<Thing>) -> Vec<String> {
        let mut orders = Vec::new();
        let pick = |russian: String, english: String| self.language.pick(russian, english);
        if let Some(room) = room {
            let place = self.place(Rel::To, &[room]);
            orders.push(pick(format!("«Поезжай {place}»"), format!("\"Go {place}\"")));
        }
        let mut things = self.world.replicas.keys();
        let carried = things.find(|id| self.world.has_trait(**id, "portable"));
        if let Some(id) = carried {
            let name = self.form(Thing::Entity(Entity::Replica(*id)), Case::Accusative);
            orders.push(pick(format!("«Принеси {name}»"), format!("\"Bring {name}\"")));
        }
        let doors = self.members(&Extension::Doors);
        let mut joined = self.relations.joins().into_iter().filter_map(|join| join.door);
        let moved = joined.find_map(|id| {
            let thing = Thing::Entity(Entity::Door(id));
            let status = self.world.doors.get(&id)?.state.status;
            (doors.contains(&thing) && status != DoorStatus::Locked).then_some((thing, status))
        });
        if let Some((door, status)) = moved {
            let name = self.form(door, Case::Accusative);
            let (russian, english) = match status {
                DoorStatus::Open => ("Закрой", "Close"),
                DoorStatus::Closed | DoorStatus::Locked => ("Открой", "Open"),
            };
            orders.push(pick(format!("«{russian} {name}»"), format!("\"{english} {name}\"")));
        }
        orders
    }

    /// What is answered to politeness.
    pub(super) fn courteous(&self, courtesy: Courtesy) -> Draft {
        let text = match courtesy {
            Courtesy::Greeting => {
                let help = self.help();
                let greeting = self.pick("здравствуйте!", "hello!");
                let text = format!("{greeting} {}", speech::sentence(&help.text));
                return Draft::new(Said::Found, text);
            }
            Courtesy::Thanks => self.pick("пожалуйста", "you are welcome"),
            Courtesy::Farewell => self.pick("до свидания", "goodbye"),
            Courtesy::HowAreYou => {
                self.pick("спасибо, я готов отвечать", "thank you, I am ready to answer")
            }
            Courtesy::Assent => self.pick("рад помочь", "glad to help"),
        };
        Draft::new(Said::Found, text.to_owned())
    }

    pub(super) fn done(&self) -> Draft {
        let none = self
            .pick("в этом разговоре я ещё ничего не делал", "I have done nothing yet in this talk");
        match &self.memory.done {
            Some(told) => Draft::new(Said::Found, told.say(self.language).to_owned()),
            None => Draft::new(Said::Nothing, none.to_owned()),
        }
    }

    /// «Стул-1 теперь в Комнате-Z; Чашки-2 на месте нет; Дверь-ВZ закрыта»
    pub(super) fn changed(&self) -> Draft {
        let news = self.senses.changed();
        if news.is_empty() {
            let none = self.pick(
                "насколько я видел, всё так, как на карте",
                "as far as I have seen, all is as on the map",
            );
            return Draft::new(Said::Nothing, none.to_owned());
        }
        let mut things = Vec::new();
        let told: Vec<String> = news.iter().map(|news| self.news(*news, &mut things)).collect();
        Draft::new(Said::Found, told.join("; ")).with(things)
    }

    fn news(&self, news: News, things: &mut Vec<Thing>) -> String {
        let mut thing = |entity: Entity| {
            things.push(Thing::Entity(entity));
            Thing::Entity(entity)
        };
        let room = |area: AreaId| self.place(Rel::In, &[Thing::Entity(Entity::Area(area))]);
        match news {
            News::Moved(id, area) => {
                let thing = thing(Entity::Replica(id));
                let (name, is) = (self.name(thing), self.is(&[thing]));
                match self.is_russian() {
                    true => format!("{name} теперь {}, на другом месте", room(area)),
                    false => format!("{name} {is} now elsewhere {}", room(area)),
                }
            }
            News::Missed(id) => {
                let thing = thing(Entity::Replica(id));
                match self.is_russian() {
                    true => format!("{} на месте нет", self.form(thing, Case::Genitive)),
                    false => format!("{} {} not in its place", self.name(thing), self.is(&[thing])),
                }
            }
            News::Door(id, state) => {
                let thing = thing(Entity::Door(id));
                let name = self.name(thing);
                let value = self.lexicon().values.of_door(state.status);
                let value = value.map(|value| self.value(value, thing)).unwrap_or_default();
                let is_ajar = state.status == DoorStatus::Open && state.opening < 99.5;
                let how = match (is_ajar, self.is_russian()) {
                    (true, true) => format!(" на {:.0} %", state.opening),
                    (true, false) => format!(" by {:.0} %", state.opening),
                    (false, _) => String::new(),
                };
                match self.is_russian() {
                    true => format!("{name} {value}{how}"),
                    false => format!("{name} {} {value}{how}", self.is(&[thing])),
                }
            }
            News::New(id) => {
                let area = self.world.replicas.get(&id).map(|replica| replica.area);
                let thing = thing(Entity::Replica(id));
                let place = area.map(room).unwrap_or_default();
                match self.is_russian() {
                    true => format!("{place} стоит {}, которого на карте нет", self.name(thing)),
                    false => format!("{} {place} is not on the map", self.name(thing)),
                }
            }
            News::Switched(id, on) => {
                let thing = thing(Entity::Replica(id));
                let name = self.name(thing);
                match (self.is_russian(), on) {
                    (true, true) => format!("{name}: включено"),
                    (true, false) => format!("{name}: выключено"),
                    (false, true) => format!("{name} {} on", self.is(&[thing])),
                    (false, false) => format!("{name} {} off", self.is(&[thing])),
                }
            }
            News::Taken(id) => {
                let thing = thing(Entity::Replica(id));
                match self.is_russian() {
                    true => format!("{} взято с места", self.name(thing)),
                    false => format!("{} was taken from its place", self.name(thing)),
                }
            }
        }
    }

    /// «я ещё не видел Шкаф-1 и Стул-2»
    pub(super) fn unseen(&self) -> Draft {
        let (unseen, seen) = self.senses.unseen();
        let things: Vec<Thing> =
            unseen.into_iter().map(|id| Thing::Entity(Entity::Replica(id))).collect();
        let text = match (things.is_empty(), seen, self.is_russian()) {
            (true, _, true) => "всё, что есть на карте, я видел".to_owned(),
            (true, _, false) => "I have seen all that is on the map".to_owned(),
            (false, 0, true) => {
                format!(
                    "из того, что есть на карте, я сам ещё ничего не видел, предметов {}",
                    things.len()
                )
            }
            (false, 0, false) => {
                format!("of the {} things on the map I have seen none myself yet", things.len())
            }
            (false, _, true) => format!("я ещё не видел {}", self.names(&things, Case::Accusative)),
            (false, _, false) => format!("I have not seen {} yet", self.list(&things)),
        };
        let said = if things.is_empty() { Said::Nothing } else { Said::Found };
        Draft::new(said, text).with(things)
    }

    pub(super) fn sureness(&self) -> Draft {
        let unknown =
            || self.pick("я не знаю, где нахожусь", "I do not know where I am").to_owned();
        let text = self.senses.sureness(self.language);
        let said = if text.is_some() { Said::Found } else { Said::Unknown };
        let room = self.area_of(Thing::Robot).map(|a| Thing::Entity(Entity::Area(a)));
        Draft::new(said, text.unwrap_or_else(unknown)).with(room.into_iter().collect())
    }

    pub(super) fn what_do_you_hold(&self) -> Draft {
        let held: Vec<Thing> =
            self.senses.held().into_iter().map(|id| Thing::Entity(Entity::Replica(id))).collect();
        let text = match (held.is_empty(), self.is_russian()) {
            (true, true) => "в руках у меня ничего нет".to_owned(),
            (true, false) => "I am holding nothing".to_owned(),
            (false, true) => format!("в руках у меня {}", self.list(&held)),
            (false, false) => format!("I am holding {}", self.list(&held)),
        };
        let said = if held.is_empty() { Said::Nothing } else { Said::Found };
        Draft::new(said, text).with(held)
    }

    pub(super) fn what_do_you_see(&self) -> Draft {
        let seen = self.in_view();
        let text = match (seen.is_empty(), self.is_russian()) {
            (true, true) => "передо мной ничего нет".to_owned(),
            (true, false) => "I see nothing before me".to_owned(),
            (false, true) => format!("я вижу {}", self.names(&seen, Case::Accusative)),
            (false, false) => format!("I see {}", self.list(&seen)),
        };
        let said = if seen.is_empty() { Said::Nothing } else { Said::Found };
        Draft::new(said, text).with(seen)
    }
}

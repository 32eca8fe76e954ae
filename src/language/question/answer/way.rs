//! Where doors lead, the way from one place to another, and how far it is.
//!
//! Invariant: a way is the one that the robot would drive; how far without a way is said to be a straight line.

use super::Draft;
use crate::map::{DoorStatus, Entity};
use crate::question::knowledge::Knowledge;
use crate::question::query::{Extreme, Noun, Rel, Thing};
use crate::question::{Doubt, Fact, Said, Way};
use crate::report::Detail;
use crate::units::InOrder as _;
use crate::words::{Case, russian};
use crate::words::{duration, length};

impl Knowledge<'_> {
    pub(super) fn leads(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let mut drafts = self.definite(noun)?.into_iter().map(|door| self.leads_one(door));
        let Some(mut whole) = drafts.next() else { return Err(self.none_such(noun)) };
        for draft in drafts {
            whole.text = format!("{}; {}", whole.text, draft.text);
            whole.things.extend(draft.things);
            whole.facts.extend(draft.facts);
            whole.topic.extend(draft.topic);
        }
        Ok(whole)
    }

    fn leads_one(&self, thing: Thing) -> Draft {
        let name = self.name(thing);
        let areas: Vec<Thing> = self
            .opening(thing)
            .map(|g| g.areas.iter().map(|a| Thing::Entity(Entity::Area(*a))).collect())
            .unwrap_or_default();
        let text = match (&areas[..], self.is_russian()) {
            ([a, b, ..], true) => format!(
                "{name} соединяет {} и {}",
                self.form(*a, Case::Accusative),
                self.form(*b, Case::Accusative)
            ),
            ([a, b, ..], false) => format!("{name} joins {} and {}", self.name(*a), self.name(*b)),
            ([a], true) => {
                format!("{name} ведёт {} наружу", self.place(Rel::From, &[*a]))
            }
            ([a], false) => format!("{name} leads from {} outside", self.name(*a)),
            ([], true) => format!("{name}: куда ведёт, на карте не указано"),
            ([], false) => format!("the map does not tell where {name} leads"),
        };
        let facts = match &areas[..] {
            [a, b, ..] => vec![Fact::holding(
                "JOINS",
                vec![self.symbol(thing), self.symbol(*a), self.symbol(*b)],
            )],
            _ => Vec::new(),
        };
        let said = if areas.is_empty() { Said::Unknown } else { Said::Found };
        Draft { facts, ..Draft::new(said, text).with(areas) }.about(&[thing])
    }

    /// A way with as much as is asked for; without that, only whether there is one.
    pub(super) fn way(
        &self,
        from: Option<&Noun>,
        to: &Noun,
        detail: Option<Detail>,
    ) -> Result<Draft, Doubt> {
        let yes_or_no = detail.is_none();
        let from = from.map(|noun| self.one(noun)).transpose()?;
        let to = self.one(to)?;
        let way = self.senses.way(from, to, self.language, detail.unwrap_or_default());
        let topic = [to];
        Ok(match way {
            Ok(way) => {
                let far = length(way.length, self.language);
                let steps = way.sentences.join(" ");
                let text = match (yes_or_no, self.is_russian()) {
                    (false, _) if way.length < self.relations.thresholds().way_none => steps,
                    (true, true) => format!("да, путь есть, его длина {far}. {steps}"),
                    (true, false) => format!("yes, there is a way of {far}. {steps}"),
                    (false, true) => format!("{steps} Длина пути {far}"),
                    (false, false) => format!("{steps} The way is {far} long"),
                };
                let text = match self.locked(to) {
                    Some(shut) => format!("{}; {shut}", text.trim_end_matches('.')),
                    None => text,
                };
                let said = if yes_or_no { Said::Yes } else { Said::Found };
                Draft::new(said, text).about(&topic).number(way.length)
            }
            Err(why) => {
                let text = match self.is_russian() {
                    true => format!(
                        "{}проехать туда нельзя: {why}",
                        if yes_or_no { "нет, " } else { "" }
                    ),
                    false => {
                        format!("{}there is no way: {why}", if yes_or_no { "no, " } else { "" })
                    }
                };
                Draft::new(Said::No, text).about(&topic)
            }
        })
    }

    /// «Дверь-3 заперта», of the door that a way leads to: beyond it there is none.
    fn locked(&self, to: Thing) -> Option<String> {
        let Thing::Entity(Entity::Door(id)) = to else { return None };
        let is_locked = self.world.doors.get(&id)?.state.status == DoorStatus::Locked;
        let is = self.pick("заперта", "is locked");
        is_locked.then(|| format!("{} {is}", self.name(to)))
    }

    /// How long the robot is on its way: at its speed and without stops, but for the lifts that it rides.
    pub(super) fn duration(&self, from: Option<&Noun>, to: &Noun) -> Result<Draft, Doubt> {
        let from = from.map(|noun| self.one(noun)).transpose()?;
        let to = self.one(to)?;
        let way = match self.senses.way(from, to, self.language, Detail::Region) {
            Ok(way) => way,
            Err(why) => {
                let no = self.pick("проехать туда нельзя", "there is no way");
                return Ok(Draft::new(Said::No, format!("{no}: {why}")).about(&[to]));
            }
        };
        let (seconds, text) = self.takes(&way);
        Ok(Draft::new(Said::Found, text).about(&[to]).number(seconds))
    }

    /// How many seconds a way takes, and the words for it.
    pub(super) fn takes(&self, way: &Way) -> (f64, String) {
        let speed = self.world.robot.speed;
        let seconds = way.length / speed + way.riding;
        let (far, lang) = (length(way.length, self.language), self.language);
        let takes = duration(seconds, lang);
        let at = length(speed, lang);
        let rides = duration(way.riding, lang);
        let text = match (way.riding > 0.0, self.is_russian()) {
            (false, true) => {
                format!("ехать около {takes}: путь {far} по {at} в секунду, без остановок")
            }
            (false, false) => {
                format!("about {takes}: {far} of way at {at} a second, without stops")
            }
            (true, true) => format!(
                "ехать около {takes}: путь {far} по {at} в секунду и лифт, около {rides} с ожиданием"
            ),
            (true, false) => format!(
                "about {takes}: {far} of way at {at} a second, and about {rides} of waiting for lifts and riding"
            ),
        };
        (seconds.round(), text)
    }

    /// Which of two ways is the shorter, or the longer.
    pub(super) fn which_way(
        &self,
        of: &[(Option<Noun>, Noun)],
        extreme: Extreme,
    ) -> Result<Draft, Doubt> {
        let mut ways = Vec::new();
        for (from, to) in of {
            let from = from.as_ref().map(|noun| self.one(noun)).transpose()?;
            let to = self.one(to)?;
            let (start, goal) = (from.unwrap_or(Thing::Robot), to);
            let name = match self.is_russian() {
                true => {
                    format!("{} {}", self.place(Rel::From, &[start]), self.place(Rel::To, &[goal]))
                }
                false => format!("from {} to {}", self.name(start), self.name(goal)),
            };
            match self.senses.way(from, to, self.language, Detail::Region) {
                Ok(way) => ways.push((way.length, name, to)),
                Err(why) => {
                    let no = self.pick("проехать нельзя", "there is no way");
                    return Ok(
                        Draft::new(Said::Unknown, format!("{name} {no}: {why}")).about(&[to])
                    );
                }
            }
        }
        ways.order_by(|a, b| a.0.total_cmp(&b.0));
        if extreme == Extreme::Farthest {
            ways.reverse();
        }
        let [(first, name, goal), (second, other, _)] = &ways[..] else {
            return Ok(Draft::default());
        };
        let (a, b) = (length(*first, self.language), length(*second, self.language));
        let equal = (first - second).abs() < self.relations.thresholds().way_equal;
        let text = match (equal, extreme == Extreme::Nearest, self.is_russian()) {
            (true, _, true) => format!("пути одинаковы: по {a}"),
            (true, _, false) => format!("both ways are {a} long"),
            (false, true, true) => format!("короче {name} ({a}; {other} – {b})"),
            (false, false, true) => format!("длиннее {name} ({a}; {other} – {b})"),
            (false, true, false) => format!("the way {name} is shorter ({a}; {other}: {b})"),
            (false, false, false) => format!("the way {name} is longer ({a}; {other}: {b})"),
        };
        let said = if equal { Said::Nothing } else { Said::Found };
        Ok(Draft::new(said, text).about(&[*goal]).number(*first))
    }

    pub(super) fn say_distance(&self, from: Option<&Noun>, to: &Noun) -> Result<Draft, Doubt> {
        let (from, to) = match from {
            // "How far apart are the two wardrobes?"
            Some(from) if from == to && to.plural => match self.find(to, false)?[..] {
                [a, b] => (Some(a), b),
                [] => return Err(self.none_such(to)),
                ref several => return Err(self.ambiguous(to, several)),
            },
            from => (from.map(|noun| self.one(noun)).transpose()?, self.one(to)?),
        };
        let start = from.unwrap_or(Thing::Robot);
        // Between rooms, which may touch, only the way tells how far it is.
        let rooms = start.area().is_some() || to.area().is_some();
        let straight = self.distance(start, to);
        let areas = |t: Thing| match self.opening(t) {
            Some(gate) => gate.areas.clone(),
            None => self.area_of(t).into_iter().collect(),
        };
        let own = areas(start);
        let same_room = areas(to).iter().any(|a| own.contains(a));
        let goes = |t: Thing| t == Thing::Robot || t.is_gone_to();
        let things = !goes(start) && !goes(to);
        let way = match same_room && things {
            true => None,
            false => Some(self.senses.way(from, to, self.language, Detail::Region)),
        };
        // Who asks of a way that is barred is told so beside the straight line.
        let barred = way.as_ref().and_then(|way| way.as_ref().err()).filter(|why| !why.is_empty());
        let barred = barred.map(|why| match self.is_russian() {
            true => format!(" по прямой, а проехать нельзя: {why}"),
            false => format!(" in a straight line, and there is no way: {why}"),
        });
        let barred = barred.unwrap_or_default();
        let way = way.and_then(|way| way.ok()).map(|way| way.length);
        // No way is shorter than the straight line: this one leads from beside a point on which no robot can stand.
        let from_there = |way: &f64| straight.is_none_or(|straight| *way + 1.0 >= straight);
        let way = way.filter(|way| rooms || !goes(start) || !goes(to) || from_there(way));
        let straight = straight.filter(|_| !rooms || way.is_none());
        let edges = self.between_what(start, to);
        let (a, b) = (self.form(start, Case::Genitive), self.form(to, Case::Genitive));
        let until = russian::preposition(russian::Preposition::Do, &b);
        let of = russian::preposition(russian::Preposition::Ot, &a);
        let lang = self.language;
        let name = |t: Thing| self.name(t);
        let text = match (way, straight, self.is_russian()) {
            (Some(way), Some(d), true) => format!(
                "{of} {a} {until} {b} {} пути, по прямой {}{edges}",
                length(way, lang),
                length(d, lang)
            ),
            (Some(way), None, true) => format!("{of} {a} {until} {b} {} пути", length(way, lang)),
            (None, Some(d), true) => {
                format!("{of} {a} {until} {b} {}{edges}{barred}", length(d, lang))
            }
            (Some(way), Some(d), false) => format!(
                "from {} to {} it is {} by way, {} in a straight line{edges}",
                name(start),
                name(to),
                length(way, lang),
                length(d, lang)
            ),
            (Some(way), None, false) => format!(
                "from {} to {} the way is {} long",
                name(start),
                name(to),
                length(way, lang)
            ),
            (None, Some(d), false) => format!(
                "from {} to {} it is {}{edges}{barred}",
                name(start),
                name(to),
                length(d, lang)
            ),
            (None, None, true) => {
                format!("расстояние {of} {a} {until} {b} неизвестно: они на разных картах")
            }
            (None, None, false) => format!(
                "the distance from {} to {} is unknown: they are on different maps",
                name(start),
                name(to)
            ),
        };
        let number = way.or(straight);
        let said = if number.is_some() { Said::Found } else { Said::Unknown };
        let mut draft = Draft::new(said, text).about(&[to]);
        draft.number = number;
        Ok(draft)
    }
}

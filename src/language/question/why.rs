//! «Почему?»: the proof of a fact in words, down to what was measured; «Почему нет?»: what it lacks.

use crate::facts::{Because, Premise, Proof, Value, WhyNot};
use crate::words::{Case, Gender, Language, Number, enumerate};

use super::answer::Draft;
use super::compared::Extreme;
use super::knowledge::Knowledge;
use super::lexicon::lower_first;
use super::query::{Claim, Denial, Noun, Passing, Query, Rel, Thing};
use super::{Answer, Doubt, Fact, Said};
use crate::map::Entity;
use crate::units::{AreaId, Lengths};
use crate::words::length;

/// Measurements said in one sentence, at most.
const SAID: usize = 4;

impl Knowledge<'_> {
    pub(super) fn why(&self, negated: bool, about: Option<&Query>) -> Result<Draft, Doubt> {
        if let Some(Query::Takes(noun)) = about {
            return self.may_take(noun);
        }
        let asked = about.or(self.memory.query.as_ref()).filter(|_| !negated);
        if let Some(draft) = asked.and_then(|query| self.why_serving(query)) {
            return Ok(draft);
        }
        let facts = match (about, &self.memory.said, &self.memory.query) {
            (Some(Query::Passing { from, to, asks: Passing::Directly, .. }), ..)
                if self.are_apart(from.as_ref(), to)? =>
            {
                return self.not_joined(from.as_ref(), to);
            }
            (Some(query), ..) => {
                let answer = self.answer(query)?;
                // "Why can't you leave the kitchen?"
                let leaves = matches!(query, Query::Find(_)) && answer.said == Said::Found;
                if negated && leaves {
                    return Ok(self.why_not_though_so(&answer.text, &answer.topic, false));
                }
                let is_told = answer.said != Said::Unknown;
                if is_told && self.is_denied_rightly(query, negated) {
                    return Ok(self.why_plain(&answer.text, &answer.topic));
                }
                if negated && (is_otherwise(query, &answer) || self.is_though_denied(query))
                    || !negated && is_supposed(query, &answer)
                {
                    return Ok(self.why_not_though_so(&answer.text, &answer.topic, false));
                }
                if matches!(query, Query::Holds { .. }) && answer.said == Said::Unknown {
                    let text = self.within_a_sentence(&answer.text, &answer.topic);
                    return Ok(Draft::plain(Said::Unknown, text));
                }
                if answer.facts.is_empty() {
                    let way = matches!(query, Query::CanReach { .. });
                    if negated && way && answer.said == Said::Yes {
                        return Ok(self.why_not_though_so(&answer.text, &answer.topic, true));
                    }
                    let plain = || self.why_plain(&answer.text, &answer.topic);
                    return Ok(self.absent(query).unwrap_or_else(plain));
                }
                answer.facts
            }
            (None, _, Some(Query::Passing { from, to, asks: Passing::Directly, .. })) => {
                return self.not_joined(from.as_ref(), to);
            }
            (None, _, Some(Query::Find(noun))) if let Some(order) = self.order(noun) => {
                return Ok(order);
            }
            (None, Some(said), Some(query)) if self.memory.facts.is_empty() => {
                let plain = || self.why_plain(said, &self.memory.spoken);
                return Ok(self.absent(query).unwrap_or_else(plain));
            }
            _ => self.memory.facts.clone(),
        };
        let Some(fact) = facts.iter().find(|f| f.holds != negated).or_else(|| facts.first()) else {
            if self.memory.is_outdated {
                let text = self.pick(
                    "с тех пор на карте что-то изменилось: спросите ещё раз",
                    "the map has changed since: ask again",
                );
                return Ok(Draft::plain(Said::Unknown, text.to_owned()));
            }
            let text = self
                .pick(
                    "объяснять нечего: за последним ответом не стоит ни одного отношения карты",
                    "there is nothing to explain: the last answer rests on no relation of the map",
                )
                .to_owned();
            return Ok(Draft::plain(Said::Nothing, text));
        };
        let mut draft = Draft::plain(Said::Found, self.because(fact));
        draft.rest_on(fact.clone());
        Ok(draft)
    }

    /// A fact, or that it is none, with its reasons: «Книга-4 находится на Столе-1, потому что …».
    pub(super) fn because(&self, fact: &Fact) -> String {
        let lines = self.reasons(fact);
        let what = self.fact_words(&fact.relation, &fact.args);
        let because = match lines.is_empty() {
            true => self.pick("так указано на карте", "the map says so").to_owned(),
            false => enumerate(&lines, self.language),
        };
        match (fact.holds, self.is_russian()) {
            (true, true) => format!("{what}, потому что {because}"),
            (true, false) => format!("{what}, because {because}"),
            (false, russian) => match (self.fact_denied(fact), russian) {
                (Some(denied), true) => format!("{denied}, потому что {because}"),
                (Some(denied), false) => format!("{denied}, because {because}"),
                (None, true) => format!("неверно, что {what}: {because}"),
                (None, false) => format!("it is not so that {what}: {because}"),
            },
        }
    }

    /// The rooms of two ends.
    fn rooms_at(&self, from: Option<&Noun>, to: &Noun) -> Result<Option<[AreaId; 2]>, Doubt> {
        let start = from.map_or(Ok(Thing::Robot), |noun| self.one(noun))?;
        let (from, to) = (self.rooms_of(start), self.rooms_of(self.one(to)?));
        Ok(from.first().zip(to.first()).map(|(from, to)| [*from, *to]))
    }

    /// Whether neither a door nor a passage joins the rooms of two ends.
    fn are_apart(&self, from: Option<&Noun>, to: &Noun) -> Result<bool, Doubt> {
        let rooms = self.rooms_at(from, to)?;
        Ok(rooms.is_some_and(|[a, b]| a != b && self.openings_between(a, b).next().is_none()))
    }

    /// "Why can't I go there directly?": no door joins the two.
    fn not_joined(&self, from: Option<&Noun>, to: &Noun) -> Result<Draft, Doubt> {
        let Some([a, b]) = self.rooms_at(from, to)? else {
            return Ok(self.why_plain(self.memory.said.as_deref().unwrap_or_default(), &[]));
        };
        let place = self.place(Rel::Between, &[a, b].map(|id| Thing::Entity(Entity::Area(id))));
        let text = match (self.openings_between(a, b).next(), self.is_russian()) {
            (Some(gate), true) => format!("{place} – {}", self.name(gate.thing)),
            (Some(gate), false) => format!("{} is {place}", self.name(gate.thing)),
            (None, true) => format!("{place} нет ни двери, ни прохода"),
            (None, false) => format!("there is no door or passage {place}"),
        };
        Ok(Draft::plain(Said::Found, text))
    }

    /// «Что ближе всего к холодильнику? Почему?»: how near it is, and the next one.
    fn order(&self, noun: &Noun) -> Option<Draft> {
        let best = noun.best.as_ref()?;
        let anchor = match (&best.anchor, best.extreme) {
            (Some(anchor), Extreme::Nearest | Extreme::Farthest) => self.one(anchor).ok()?,
            _ => return None,
        };
        let first = *self.memory.last.first()?;
        let mut others = Noun { rank: None, indefinite: true, ..noun.clone() };
        others.except.push(Noun::of(vec![first]));
        let next = *self.find(&others, true).ok()?.first()?;
        let away = |t: Thing| self.distance(t, anchor).map(|away| length(away, self.language));
        let (near, far) = (away(first)?, away(next)?);
        let of = |thing| self.form(thing, Case::Genitive);
        let (name, other) = (self.name(first), self.name(next));
        let text = match self.is_russian() {
            true => format!("до {} {near}, а дальше – до {}, {far}", of(first), of(next)),
            false => format!("{name} is {near} away, and the next one, {other}, {far}"),
        };
        Some(Draft::plain(Said::Found, text).with(vec![first]))
    }

    /// «В гостиной нет стульев. Почему?»: where they are instead.
    fn absent(&self, query: &Query) -> Option<Draft> {
        let noun = query.sought()?;
        self.find(noun, true).ok().filter(Vec::is_empty)?;
        let anywhere = Noun { restrictions: Vec::new(), plural: true, ..noun.clone() };
        let known = !noun.restrictions.is_empty() && !noun.head.anything;
        let found = self.find(&anywhere, true).ok().filter(|found| known && !found.is_empty())?;
        let instead = self.say_where(&anywhere).ok()?;
        let text = match self.is_russian() {
            true => format!("по карте {}", instead.text()),
            false => format!("by the map {}", instead.text()),
        };
        Some(Draft::plain(Said::Found, text).with(found))
    }

    /// What an answer said, behind other words: a name keeps its letters.
    fn within_a_sentence(&self, said: &str, named: &[Thing]) -> String {
        let text = without_verdict(said);
        let is_name = named.iter().any(|t| text.starts_with(&self.name(*t)));
        if is_name { text.to_owned() } else { lower_first(text) }
    }

    /// Of what rests on no relation – a way, the floor, a value that is not given – the answer itself is the reason.
    fn why_plain(&self, said: &str, named: &[Thing]) -> Draft {
        let text = self.within_a_sentence(said, named);
        let text = match self.is_russian() {
            true => format!("по карте так: {text}"),
            false => format!("by the map it is so: {text}"),
        };
        Draft::plain(Said::Found, text)
    }

    /// "Why can't you reach the mug?", where a way leads to it: the arm is too short, or it is not so.
    fn why_not_though_so(&self, said: &str, topic: &[Thing], is_way: bool) -> Draft {
        let beyond = |thing: &Thing| Some((*thing, self.senses.beyond_arm(thing.replica()?)?));
        let beyond = topic.iter().filter(|_| is_way).find_map(beyond);
        let text = match (beyond, self.is_russian()) {
            (Some((thing, beyond)), true) => format!(
                "до {} не дотянуться: там, где робот встаёт ближе всего, руке не хватает {}",
                self.form(thing, Case::Genitive),
                length(beyond, self.language)
            ),
            (Some((thing, beyond)), false) => format!(
                "{} is out of reach: where I can stand nearest to it, my arm is {} too short",
                self.name(thing),
                length(beyond, self.language)
            ),
            (None, russian) => {
                let told = self.within_a_sentence(said, topic);
                match russian {
                    true => format!("по карте это не так: {told}"),
                    false => format!("by the map it is not so: {told}"),
                }
            }
        };
        Draft::plain(Said::Found, text)
    }

    /// Whether values that are denied of things are indeed not theirs: "Why isn't the dishwasher running?", which is off.
    fn is_denied_rightly(&self, query: &Query, negated: bool) -> bool {
        let Query::Holds { subject, claims, denial, .. } = query else { return false };
        let things = self.find(subject, false).unwrap_or_default();
        let lacks = |claim: &Claim| match claim {
            Claim::Value(filter) => {
                let denies = negated || filter.negated || *denial != Denial::None;
                denies && things.iter().all(|thing| !self.has_value(*thing, filter.value))
            }
            _ => false,
        };
        !things.is_empty() && claims.iter().all(lacks)
    }

    /// Whether values that are denied of things are theirs: "Why isn't the door open?", where it is.
    fn is_though_denied(&self, query: &Query) -> bool {
        let Query::Holds { subject, claims, .. } = query else { return false };
        let things = self.find(subject, false).unwrap_or_default();
        let has = |claim: &Claim| match claim {
            Claim::Value(filter) => {
                filter.negated && things.iter().all(|thing| self.has_value(*thing, filter.value))
            }
            _ => false,
        };
        !things.is_empty() && claims.iter().all(has)
    }

    /// The measurements that a fact comes from, or what it lacks.
    fn reasons(&self, fact: &Fact) -> Vec<String> {
        let args: Vec<&str> = fact.args.iter().map(String::as_str).collect();
        if fact.holds {
            let Ok(Some(proof)) = self.relations.why(&self.around(), &fact.relation, &args) else {
                return Vec::new();
            };
            let mut lines = self.measured(&proof, fact.relation == "INSIDE");
            lines.truncate(SAID);
            return lines;
        }
        if let Some(instead) = self.elsewhere(fact) {
            return vec![instead];
        }
        match self.relations.why_not(&self.around(), &fact.relation, &args) {
            Ok(WhyNot::Nearest(failed)) => {
                let mut lines: Vec<String> =
                    failed.failed().map(|premise| self.premise(premise)).collect();
                lines.dedup();
                lines.truncate(SAID);
                lines
            }
            _ => Vec::new(),
        }
    }

    /// What a thing stands on instead, or how far the two are apart.
    fn elsewhere(&self, fact: &Fact) -> Option<String> {
        let (a, b) = (self.thing(fact.args.first()?)?, self.thing(fact.args.get(1)?)?);
        if matches!(fact.relation.as_str(), "ON_TOP_OF" | "BORNE_BY" | "INSIDE") {
            let place = self.short_place(a, &mut Vec::new());
            return Some(format!(
                "{} {} {place}",
                self.pronoun(a, Case::Nominative),
                self.is(&[a])
            ));
        }
        // How far a thing is from the room that it stands in tells nothing.
        if [a, b].iter().any(|thing| matches!(thing, Thing::Entity(Entity::Area(_)))) {
            return None;
        }
        let apart = length(self.distance(a, b)?, self.language);
        Some(match self.is_russian() {
            true => format!("между ними {apart}"),
            false => format!("they are {apart} apart"),
        })
    }

    /// All steps of a proof, or all premises of the rule that came closest.
    pub(super) fn proof_lines(&self, fact: &Fact) -> Vec<String> {
        let args: Vec<&str> = fact.args.iter().map(String::as_str).collect();
        if fact.holds {
            let Ok(Some(proof)) = self.relations.why(&self.around(), &fact.relation, &args) else {
                return Vec::new();
            };
            let steps = proof.steps.iter();
            return steps.map(|s| tuple(&self.shown(&s.fact.name), &s.fact.values)).collect();
        }
        match self.relations.why_not(&self.around(), &fact.relation, &args) {
            Ok(WhyNot::Nearest(failed)) => {
                let sign = |holds: Option<bool>| match holds {
                    Some(true) => "+",
                    Some(false) => "-",
                    None => "?",
                };
                failed
                    .premises
                    .iter()
                    .map(|(p, h)| format!("{} {}", sign(*h), self.premise(p)))
                    .collect()
            }
            _ => Vec::new(),
        }
    }

    /// A relation's name in the language of the answer.
    fn shown(&self, relation: &str) -> String {
        self.relations.display_name(relation, self.language)
    }

    /// What was measured; where a thing stands in its room says something of that alone.
    fn measured(&self, proof: &Proof, of_rooms: bool) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for step in &proof.steps {
            if step.because != Because::Told || (step.fact.name == "standing_in" && !of_rooms) {
                continue;
            }
            if let Some(line) = self.measurement(&step.fact.name, &step.fact.values)
                && !lines.contains(&line)
            {
                lines.push(line);
            }
        }
        lines
    }

    /// A measured fact in words; none for what says nothing to a person.
    pub(super) fn measurement(&self, name: &str, values: &[Value]) -> Option<String> {
        let word = |n: usize| match values.get(n) {
            Some(Value::Symbol(text)) => self.symbol_words(text),
            Some(number) => number.to_string(),
            None => String::new(),
        };
        let genitive = |n: usize| match values.get(n) {
            Some(Value::Symbol(text)) => match self.thing(text) {
                Some(thing) => self.form(thing, Case::Genitive),
                None => format!("«{text}»"),
            },
            _ => String::new(),
        };
        let number = |n: usize| match values.get(n) {
            Some(Value::Number(number)) => *number as f64 / 100.0,
            _ => 0.0,
        };
        let cm = |n: usize| match number(n).abs() < 100.0 {
            true => Lengths::said().told(number(n), 1, self.language),
            false => length(number(n), self.language),
        };
        let percent = |n: usize| number(n) * 10.0;
        let (a, b) = match self.is_russian() {
            true => (genitive(0), genitive(1)),
            false => (word(0), word(1)),
        };
        let russian = self.is_russian();
        Some(match (name, russian) {
            ("amid", _) => {
                let Some(Value::Symbol(how)) = values.get(3) else { return None };
                let share = percent(4);
                match (&**how, russian) {
                    ("way", true) => format!("занимает {} кратчайшего пути между ними", cm(4)),
                    ("way", false) => {
                        format!("it takes {} of the shortest way between them", cm(4))
                    }
                    ("aside", true) => format!("в {} от кратчайшего пути между ними", cm(4)),
                    ("aside", false) => {
                        format!("it is {} from the shortest way between them", cm(4))
                    }
                    (_, true) => format!("на {share:.0} % лежит там, откуда видно обоих"),
                    (_, false) => format!("{share:.0} % of it lies where both are in sight"),
                }
            }
            ("over", true) => {
                let gap = match number(4).abs() < 0.05 {
                    true => format!("касается верха {b}"),
                    false => format!("в {} от верха {b}", cm(4)),
                };
                match percent(5) >= 99.5 {
                    true => format!("низ {a} {gap} и целиком над ним"),
                    false => format!("низ {a} {gap} и на {:.0} % над ним", percent(5)),
                }
            }
            ("over", false) => {
                let gap = match number(4).abs() < 0.05 {
                    true => format!("touches the top of {b}"),
                    false => format!("is {} from the top of {b}", cm(4)),
                };
                match percent(5) >= 99.5 {
                    true => format!("the bottom of {a} {gap} and all of it lies over that"),
                    false => {
                        format!(
                            "the bottom of {a} {gap} and {:.0} % of it lies over that",
                            percent(5)
                        )
                    }
                }
            }
            ("below", true) => {
                format!("верх {a} ниже {b} на {} и перекрыт сверху на {:.0} %", cm(4), percent(5))
            }
            ("below", false) => {
                format!("{a} is {} below {b} and {:.0} % of it is covered", cm(4), percent(5))
            }
            ("within", true) => match percent(8) >= 99.5 {
                true => format!("{} целиком внутри {b}", word(0)),
                false => format!("{} на {:.0} % внутри {b}", word(0), percent(8)),
            },
            ("within", false) => match percent(8) >= 99.5 {
                true => format!("{a} is wholly inside {b}"),
                false => format!("{:.0} % of {a} is inside {b}", percent(8)),
            },
            ("distance" | "beside", true) => format!("от {a} до {b} {}", cm(2)),
            ("distance" | "beside", false) => format!("{a} and {b} are {} apart", cm(2)),
            ("sector", true) => format!(
                "направление от лицевой стороны {b} – {:.0}°, расстояние {}",
                number(2),
                cm(3)
            ),
            ("sector", false) => {
                format!("{a} is at {:.0}° from the front of {b}, {} away", number(2), cm(3))
            }
            ("standing_in", russian) => {
                let above = number(2).abs() >= 0.05;
                match (russian, above) {
                    (true, true) => {
                        format!("место {a} – в границах {b}, на высоте {} от пола", cm(2))
                    }
                    (true, false) => format!("место {a} – в границах {b}"),
                    (false, true) => {
                        format!("{a} stands within the bounds of {b}, {} above its floor", cm(2))
                    }
                    (false, false) => format!("{a} stands within the bounds of {b}"),
                }
            }
            ("off_area", true) => format!("от {a} до стены {b} {}", cm(2)),
            ("off_area", false) => format!("{a} is in the wall, {} from {b}", cm(2)),
            ("edge_distance", true) => format!("от {a} до стены {}", cm(3)),
            ("edge_distance", false) => format!("{a} is {} from a wall", cm(3)),
            ("corner", true) => format!("стены сходятся под углом {:.0}°", 180.0 - number(3)),
            ("corner", false) => format!("the walls meet at {:.0}°", 180.0 - number(3)),
            ("opening_distance", true) => format!("от {a} до {b} {}", cm(2)),
            ("opening_distance", false) => format!("{a} is {} from {b}", cm(2)),
            ("middle_distance", true) => format!("от {a} до середины {b} {}", cm(2)),
            ("middle_distance", false) => format!("{a} is {} from the middle of {b}", cm(2)),
            ("links", true) => format!("карта связывает «{}» и «{}»", word(1), word(2)),
            ("links", false) => format!("the map links {} and {} through {a}", word(1), word(2)),
            ("step", true) => format!("шаг с порога {a} ведёт в «{}»", word(2)),
            ("step", false) => format!("a step through {a} leads to {}", word(2)),
            _ => return None,
        })
    }

    fn symbol_words(&self, symbol: &str) -> String {
        match self.thing(symbol) {
            Some(thing) => self.name(thing),
            None => symbol.to_owned(),
        }
    }

    fn premise(&self, premise: &Premise) -> String {
        let value = |value: &Value| match value {
            Value::Symbol(symbol) => format!("\"{}\"", self.symbol_words(symbol)),
            number => number.to_string(),
        };
        let show = |values: &[Option<Value>]| {
            let text = |v: &Option<Value>| v.as_ref().map_or("_".to_owned(), &value);
            values.iter().map(text).collect::<Vec<_>>().join(", ")
        };
        match premise {
            Premise::Fact(n) => format!("#{n}"),
            Premise::Pattern { name, values } => {
                let what = match values.iter().cloned().collect::<Option<Vec<Value>>>() {
                    Some(values) => self.measurement(name, &values).unwrap_or_else(|| {
                        let values: Vec<String> = values.iter().map(&value).collect();
                        format!("{}({})", self.shown(name), values.join(", "))
                    }),
                    None => format!("{}({})", self.shown(name), show(values)),
                };
                match self.is_russian() {
                    true => format!("не выполнено условие {what}"),
                    false => format!("the condition {what} does not hold"),
                }
            }
            Premise::Absent { name, values } => match self.is_russian() {
                true => format!("мешает {}({})", self.shown(name), show(values)),
                false => format!("{}({}) stands in the way", self.shown(name), show(values)),
            },
            Premise::Compared { text, left, right, .. } => match self.is_russian() {
                true => {
                    format!("условие «{text}» не выполнено: {} и {}", value(left), value(right))
                }
                false => {
                    format!("the condition \"{text}\" fails: {} and {}", value(left), value(right))
                }
            },
            Premise::Counted { text, value: found } => {
                let found = found.as_ref().map(&value).unwrap_or_default();
                format!("{text} = {found}")
            }
            Premise::Unknown { text } => text.clone(),
        }
    }

    /// «Книга-4 не находится на Столе-1»
    pub(super) fn fact_denied(&self, fact: &Fact) -> Option<String> {
        let thing = |n: usize| fact.args.get(n).and_then(|symbol| self.thing(symbol));
        let (rel, a, b) = (relation_word(&fact.relation)?, thing(0)?, thing(1)?);
        let (name, is, place) = (self.name(a), self.is(&[a]), self.place(rel, &[b]));
        Some(match self.is_russian() {
            true => format!("{name} не {is} {place}"),
            false => format!("{name} {is} not {place}"),
        })
    }

    /// «она», «её»; "it", "them": in the nominative, or else as an object.
    pub(super) fn pronoun(&self, thing: Thing, case: Case) -> &'static str {
        let (gender, number) = self.gender(thing);
        let subject = case == Case::Nominative;
        match (self.is_russian(), number, gender) {
            (false, ..) if self.is(&[thing]) == "are" => {
                if subject {
                    "they"
                } else {
                    "them"
                }
            }
            (false, ..) => "it",
            (true, Number::Plural, _) => {
                if subject {
                    "они"
                } else {
                    "их"
                }
            }
            (true, _, Gender::Feminine) => {
                if subject {
                    "она"
                } else {
                    "её"
                }
            }
            (true, ..) if !subject => "его",
            (true, _, Gender::Masculine) => "он",
            (true, _, Gender::Neuter) => "оно",
        }
    }

    /// A fact as a clause: «Чашка-1 находится на Столе-1».
    pub(super) fn fact_words(&self, relation: &str, args: &[String]) -> String {
        let thing = |n: usize| args.get(n).and_then(|symbol| self.thing(symbol));
        let rel = relation_word(relation);
        if let (Some(rel), Some(a), Some(b)) = (rel, thing(0), thing(1)) {
            return format!("{} {} {}", self.name(a), self.is(&[a]), self.place(rel, &[b]));
        }
        // «Холодильник-1 закрыт»
        if let ("HAS", Some(x), Some(name)) = (relation, thing(0), args.get(1))
            && let Some((property, Some(value), _)) = self
                .values(x)
                .into_iter()
                .find(|(p, _, text)| self.property_name(x, p, text) == *name)
            && let Some(words) = self.value_words(x, &property, value)
        {
            return words;
        }
        if let ("BETWEEN", Some(x), Some(a), Some(b)) = (relation, thing(0), thing(1), thing(2)) {
            let place = self.place(Rel::Between, &[a, b]);
            return format!("{} {} {place}", self.name(x), self.is(&[x]));
        }
        let words: Vec<String> = args.iter().map(|a| self.symbol_words(a)).collect();
        match (relation, self.is_russian(), &words[..]) {
            ("JOINS", true, [o, a, b]) => format!("{o} соединяет «{a}» и «{b}»"),
            ("JOINS", false, [o, a, b]) => format!("{o} joins {a} and {b}"),
            ("DOOR_IS", true, [o, state]) => format!("{o} {}", door_word(state, Language::Russian)),
            ("DOOR_IS", false, [o, state]) => format!("{o} is {state}"),
            ("HAS", _, [x, name, text]) => format!("{x}: {name} – {text}"),
            ("HAS_TRAIT", true, [x, kind]) => format!("{x} – {kind}"),
            ("HAS_TRAIT", false, [x, kind]) => format!("{x} is a {kind}"),
            ("AT_WALL", true, [x, room]) => format!("{x} стоит у стены («{room}»)"),
            ("AT_WALL", false, [x, room]) => format!("{x} stands at a wall of {room}"),
            ("IN_CORNER", true, [x, room]) => format!("{x} стоит в углу («{room}»)"),
            ("IN_CORNER", false, [x, room]) => format!("{x} stands in a corner of {room}"),
            ("ON_WALL", true, [x, room]) => format!("{x} висит на стене («{room}»)"),
            ("ON_WALL", false, [x, room]) => format!("{x} hangs on a wall of {room}"),
            ("STANDS_ON_FLOOR", true, [x, room]) => format!("{x} стоит на полу («{room}»)"),
            ("STANDS_ON_FLOOR", false, [x, room]) => format!("{x} stands on the floor of {room}"),
            ("PART_OF", true, [part, whole]) => format!("{part} – часть «{whole}»"),
            ("PART_OF", false, [part, whole]) => format!("{part} is part of {whole}"),
            _ => format!("{relation}({})", words.join(", ")),
        }
    }
}

/// An answer without its "yes" or "no" and its full stop.
pub(super) fn without_verdict(said: &str) -> &str {
    let text = said.trim_end_matches('.');
    let rest = ["Да, ", "Нет, ", "Yes, ", "No, "].iter().find_map(|head| text.strip_prefix(head));
    rest.unwrap_or(text)
}

/// Whether what somebody takes not to be so is so: "Why isn't the door open?", where it is.
fn is_otherwise(query: &Query, answer: &Answer) -> bool {
    let Query::Holds { claims, .. } = query else { return false };
    // A claim that is denied is so where the thing is otherwise.
    let denies = |claim: &Claim| match claim {
        Claim::Value(filter) => filter.negated,
        Claim::Related(place) => place.negated,
        Claim::Kind(_) | Claim::Size(_) => false,
    };
    answer.said == Said::Yes
        && !claims.iter().any(denies)
        && !answer.facts.is_empty()
        && answer.facts.iter().all(|fact| fact.holds)
}

/// Whether a value that somebody takes for a thing's is not: "Why is the door closed?", where it is open.
fn is_supposed(query: &Query, answer: &Answer) -> bool {
    let Query::Holds { claims, .. } = query else { return false };
    let of_values = claims.iter().all(|claim| matches!(claim, Claim::Value(_)));
    of_values && answer.said == Said::No && answer.facts.iter().all(|fact| fact.holds)
}

/// The preposition that tells a relation.
fn relation_word(relation: &str) -> Option<Rel> {
    match relation {
        "ON_TOP_OF" | "BORNE_BY" => Some(Rel::On),
        "INSIDE" => Some(Rel::In),
        "UNDER" => Some(Rel::Under),
        "ABOVE" => Some(Rel::Above),
        "NEXT_TO" => Some(Rel::NextTo),
        "CLOSE_TO" => Some(Rel::Near),
        "LEFT_OF" => Some(Rel::LeftOf),
        "RIGHT_OF" => Some(Rel::RightOf),
        "BEHIND" => Some(Rel::Behind),
        "IN_FRONT_OF" => Some(Rel::InFrontOf),
        "LEANING_AGAINST" => Some(Rel::Leaning),
        "AT_DOOR" | "STANDS_AT" => Some(Rel::NextTo),
        "IN_MIDDLE_OF" => Some(Rel::Middle),
        _ => None,
    }
}

fn door_word(state: &str, language: Language) -> String {
    match (state, language) {
        ("open", Language::Russian) => "открыта",
        ("closed", Language::Russian) => "закрыта",
        ("locked", Language::Russian) => "заперта",
        (other, _) => other,
    }
    .to_owned()
}

fn value(value: &Value) -> String {
    match value {
        Value::Symbol(text) => format!("\"{text}\""),
        number => number.to_string(),
    }
}

fn tuple(name: &str, values: &[Value]) -> String {
    format!("{name}({})", values.iter().map(value).collect::<Vec<_>>().join(", "))
}

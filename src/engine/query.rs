//! Questions in the rules' own language, about what is believed to be so now.
//!
//! Beside the relations of the rule text stand four that are computed when they are asked for: how far two things are
//! from each other, how big one is, what is seen from a place, and how long the way between two places is. None of them
//! is stored for all pairs: the building has too many. What the robot knows, and where the Map puts a thing, is listed
//! for a question that names it.

use std::collections::BTreeSet;

use crate::facts::{AskError, Column, Computed, Limits, Proof, Value};
use crate::geometry::{Eye, Method};
use crate::language::names::english_name;
use crate::map::{Entity, Object};
use crate::semantics::{Around, OnDemand, Subject, length, on_demand, robot_eye, things_in_view};
use crate::units::{Deg, Gather as _, Language, Pose, Source, name_key};

use super::known::Known;
use super::{Error, State};

/// What a question found.
#[derive(Debug, Clone, PartialEq)]
pub struct QueryAnswer {
    /// The question's variables, or what its head says.
    pub columns: Vec<String>,
    /// Distinct rows, in the order that the question asks for.
    pub rows: Vec<Vec<Value>>,
    /// Why each row is there, where that was asked for; of the rows from the first on.
    pub proofs: Vec<Proof>,
    /// Texts in the question that no fact holds: what stands for them is likely misspelled.
    pub unknown: Vec<String>,
}

/// Proofs of so many rows at most.
const MOST_PROOFS: usize = 20;

impl State {
    /// A value of a fact as it is told in a language: by the name that the map gives there to what it names, if it is its
    /// alone; a question may name it so.
    #[must_use]
    pub fn value_in_words(&self, value: &Value, language: Language) -> String {
        let other = match (value, self.around()) {
            (Value::Symbol(symbol), Ok(around)) => around.other_name(symbol, language),
            _ => None,
        };
        other.map_or_else(|| value.to_string(), str::to_owned)
    }

    /// Answers `?- НАХОДИТСЯ_СВЕРХУ_НА(X, "Стол-1"), distance_between(X, "Окно-1", D), D < 20000.order D.limit 3`,
    /// with rules of its own before it if it likes (docs/rules.md).
    ///
    /// # Errors
    /// There is no map, the question has faults, or a limit was reached.
    pub fn query(&self, question: &str, with_proofs: bool) -> Result<QueryAnswer, Error> {
        let stop = Some(self.stop.clone());
        self.query_within(question, with_proofs, Limits { stop, ..Limits::default() })
    }

    /// As [`State::query`], within limits.
    ///
    /// # Errors
    /// As [`State::query`].
    pub fn query_within(
        &self,
        question: &str,
        with_proofs: bool,
        limits: Limits,
    ) -> Result<QueryAnswer, Error> {
        let around = self.around()?;
        let relations = around.relations()?;
        let computed = [
            Asked::new(SEEN, vec![(0b01, 30.0)], (around, relations), seen),
            Asked::new(WAY, vec![(0b11, 1.0)], (around, relations), way),
        ];
        let place = Around::new(around.world()).with_robot(self.robot_pose());
        let measured = on_demand(&place, relations);
        let measured = measured.iter().map(|one| one as &dyn Computed);
        let is_read = |name: &str| reads(question, name);
        let tell = || self.told(around, around.moment(), is_read("sees"));
        let listed = relations.listed(around.world(), is_read, tell)?;
        let listed = listed.iter().map(|one| one as &dyn Computed);
        let computed = computed.iter().map(|one| one as &dyn Computed);
        let computed: Vec<&dyn Computed> = measured.chain(computed).chain(listed).collect();
        let source = Source::new("?", question);
        let ask = |error: AskError| Error::Query(Box::new(error));
        let called = |text: &str| around.first_name(text);
        let derived = relations.derived();
        let answers = derived.ask_calling(&source, &computed, &called, limits).map_err(ask)?;
        let most = if with_proofs { answers.rows().len().min(MOST_PROOFS) } else { 0 };
        let mut proofs = Vec::new();
        for n in 0..most {
            proofs.extend(answers.why(n).map_err(ask)?);
        }
        Ok(QueryAnswer {
            columns: answers.columns().iter().map(|Column { name, .. }| name.clone()).collect(),
            rows: answers.rows().to_vec(),
            proofs,
            unknown: answers
                .unknown()
                .filter(|text| relations.symbols().subject(text).is_none())
                .map(str::to_owned)
                .collect(),
        })
    }
}

impl Known {
    /// What the facts call the one thing, room, door, place or type that bears a name in either language.
    fn first_name(&self, name: &str) -> Option<String> {
        let (world, key) = (self.world(), name_key(name));
        let entities = self.names().find(world, name).into_iter().map(|entity| world.name(entity));
        let is_called = |object: &&Object| name_key(&object.name_en) == key;
        let objects = world.objects.values().filter(is_called).map(|object| object.name.as_str());
        let found: BTreeSet<&str> = entities.chain(objects).gather();
        found.first().filter(|_| found.len() == 1).map(|name| (*name).to_owned())
    }

    /// What a text of the facts is called in a language.
    fn other_name(&self, symbol: &str, language: Language) -> Option<&str> {
        let (world, subject) = (self.world(), self.relations().ok()?.symbols().subject(symbol)?);
        let english = match (language, subject) {
            (Language::English, Subject::Entity(entity)) => english_name(world, entity),
            (Language::English, Subject::Object(object)) => &world.objects[&object].name_en,
            _ => "",
        };
        // One that says nothing alone is no name of it.
        Some(english).filter(|name| self.first_name(name).as_deref() == Some(symbol))
    }
}

/// Whether a question reads a relation that no rule of its own declares or derives.
fn reads(question: &str, relation: &str) -> bool {
    let is_of_a_name = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    let mut is_read = false;
    for (at, _) in question.match_indices(relation) {
        let (before, after) = (&question[..at], question[at + relation.len()..].trim_start());
        if before.ends_with(is_of_a_name) || !after.starts_with('(') {
            continue;
        }
        let behind = after.split_once(')').map_or("", |(_, behind)| behind.trim_start());
        if before.trim_end().ends_with(".decl") || behind.starts_with(":-") {
            return false;
        }
        is_read = true;
    }
    is_read
}

/// What the robot would see that stands at a thing, a door, in a room or place, whichever way it turns.
const SEEN: &str = "ВИДНО_ОТ(место: symbol, x: Thing) = seen_from";
/// In tenths of a millimetre, from where one stands at the one to the other, by doors that stand open.
const WAY: &str = "ДЛИНА_ПУТИ(a: symbol, b: symbol, d: number) = way_length";

type Asked<'e> = OnDemand<'e, Known>;

fn entity(asked: &Asked<'_>, value: Option<&Value>) -> Option<Entity> {
    match asked.subject(value)? {
        Subject::Entity(entity) => Some(entity),
        Subject::Object(_) | Subject::Part(_) => None,
    }
}

fn seen(asked: &Asked<'_>, known: &[Option<Value>], tell: &mut dyn FnMut(&[Value])) -> Option<()> {
    let place = entity(asked, known[0].as_ref())?;
    let (world, located) = (asked.around.world(), asked.around.locate_entity(place).ok()?);
    let floor = asked.around.floor(located.map).ok()?;
    let pose = Pose { at: located.at, heading: Deg::ZERO };
    let near = asked.relations.thresholds();
    let eye = Eye { field: 360.0, ..robot_eye(world, floor, pose, near) };
    for thing in things_in_view(world, floor, &eye, near) {
        if let Some(symbol) = asked.symbol(thing) {
            tell(&[known[0].clone()?, symbol]);
        }
    }
    Some(())
}

fn way(asked: &Asked<'_>, known: &[Option<Value>], tell: &mut dyn FnMut(&[Value])) -> Option<()> {
    let ends = [entity(asked, known[0].as_ref())?, entity(asked, known[1].as_ref())?];
    let around = &asked.around;
    let (from, to) = (around.locate_entity(ends[0]).ok()?, around.locate_entity(ends[1]).ok()?);
    if from.map != to.map {
        return None;
    }
    let floor = around.floor(from.map).ok()?;
    let route = floor.route(around.world(), from.at, to.target, Method::Shortest).ok()?;
    tell(&[known[0].clone()?, known[1].clone()?, length(route.length)?]);
    Some(())
}

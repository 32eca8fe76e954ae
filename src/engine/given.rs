//! The facts that the map gives to planning, in the language of rule files: what is written reads back.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use crate::language::names::english_name;
use crate::language::report::Named;
use crate::robot::facts_of_map;
use crate::semantics::planning::{InitialFact, PLACE_BESIDE};
use crate::strips::{Domain, Problem, in_quotes};
use crate::units::{Gather as _, Language, name_key, told, word};

use super::known::Known;
use super::task::OPERATOR;
use super::{Error, State};

impl State {
    /// The facts that the map gives to planning, all or those of a predicate; the robot is in none of them.
    ///
    /// # Errors
    /// There is no map, or the rules have no such predicate.
    pub fn facts_given(&self, predicate: Option<&str>) -> Result<Vec<InitialFact>, Error> {
        let mut facts = facts_of_map(self.world()?, self.relations()?);
        if let Some(name) = predicate {
            // The paper writes an underscore before the bracket.
            let name = name.trim_end_matches(['(', ')', '_', ' ']);
            let robot = &self.rules.robot;
            let wanted = robot.predicate(name);
            let told = |fact: &InitialFact| {
                name_key(fact.predicate) == name_key(name)
                    || (wanted.is_some() && robot.predicate(fact.predicate) == wanted)
            };
            if !facts.iter().any(told) {
                robot.known_predicate(name)?;
            }
            facts.retain(told);
        }
        Ok(facts)
    }

    /// The same as a rule file states them: what is written reads back. Empty where there are none.
    ///
    /// # Errors
    /// As [`State::facts_given`].
    pub fn facts_in_rule_text(
        &self,
        predicate: Option<&str>,
        language: Language,
    ) -> Result<String, Error> {
        let facts = self.facts_given(predicate)?;
        let names = Names::of(&facts, self.surveyed()?, &self.rules.robot, language);
        Ok(in_rule_file(&facts, &names))
    }
}

impl Known {
    /// Lets a problem speak of what the facts speak of by English names, too.
    pub(super) fn call_in_english(&self, problem: &mut Problem, facts: &[InitialFact]) {
        let english = |name| (name, self.name_in_english_rules(name));
        let names: Vec<(&str, String)> = names_in(facts).into_iter().map(english).collect();
        problem.call(names.iter().map(|(name, other)| (*name, other.as_str())));
    }

    /// What an English rule file calls an object of the facts: by its English name, where the map gives one.
    fn name_in_english_rules(&self, name: &str) -> String {
        let world = self.world();
        let called = |name: &str| {
            let bearer = self.names().find(world, name).first().copied();
            match bearer {
                Some(entity) => english_name(world, entity).to_owned(),
                None if world.domain.lifts.iter().any(|(lift, _)| lift == name) => {
                    Named::plain(name).english_name().to_owned()
                }
                None => String::new(),
            }
        };
        let english = match name.strip_prefix(PLACE_BESIDE) {
            _ if name == OPERATOR => "Operator".to_owned(),
            Some(thing) => match called(thing) {
                thing if thing.is_empty() => thing,
                thing => format!("Place by {thing}"),
            },
            None => called(name),
        };
        if english.is_empty() { name.to_owned() } else { english }
    }
}

/// What facts are of, each once.
fn names_in(facts: &[InitialFact]) -> BTreeSet<&str> {
    facts.iter().flat_map(|fact| &fact.arguments).map(|a| a.name.as_str()).gather()
}

/// What a rule file of a language calls what facts are of.
struct Names<'a> {
    domain: &'a Domain,
    language: Language,
    /// By their names, the other ones of objects that no two share.
    objects: BTreeMap<&'a str, String>,
}

impl<'a> Names<'a> {
    fn of(facts: &'a [InitialFact], known: &Known, domain: &'a Domain, language: Language) -> Self {
        // In English hyphens stand for blanks, as they do in the papers' names.
        let other = |name: &str| match language {
            Language::Russian => name.to_owned(),
            Language::English => known.name_in_english_rules(name).replace(' ', "-"),
        };
        let mut objects: BTreeMap<&str, String> =
            names_in(facts).into_iter().map(|name| (name, other(name))).collect();
        let mut bearers: BTreeMap<String, usize> = BTreeMap::new();
        let keys = objects
            .iter()
            .flat_map(|(name, other)| BTreeSet::from([name_key(name), name_key(other)]));
        keys.for_each(|key| *bearers.entry(key).or_default() += 1);
        objects.retain(|_, other| bearers[&name_key(other)] == 1);
        Self { domain, language, objects }
    }

    fn object(&self, name: &'a str) -> Cow<'_, str> {
        in_quotes(self.objects.get(name).map_or(name, String::as_str))
    }

    fn fact(&self, fact: &'a InitialFact) -> String {
        let args: Vec<_> = fact.arguments.iter().map(|a| self.object(&a.name)).collect();
        format!("{}_({})", self.domain.called(fact.predicate, self.language), args.join(", "))
    }
}

/// Facts as a rule file states them: the objects with their types, the facts, the assumptions.
fn in_rule_file<'a>(facts: &'a [InitialFact], names: &Names<'a>) -> String {
    let mut text = String::new();
    let objects: BTreeSet<(&str, &str)> = facts
        .iter()
        .flat_map(|fact| fact.arguments.iter().map(|a| (a.kind, a.name.as_str())))
        .gather();
    let mut section = |head: &str, lines: Vec<String>| {
        if !lines.is_empty() {
            let gap = if text.is_empty() { "" } else { "\n" };
            text.push_str(&format!("{gap}{head}:\n{}\n", lines.join("\n")));
        }
    };
    let object = |(kind, name): &(&str, &str)| {
        format!("{} — {}", names.object(name), names.domain.called_kind(kind, names.language))
    };
    section(&told!(names.language, "objects"), objects.iter().map(object).collect());
    let heads = [(word!("facts"), false), (word!("assumptions"), true)];
    for (head, assumed) in heads {
        let stated = facts.iter().filter(|fact| fact.assumed == assumed);
        let head = head.say(names.language);
        section(&head, stated.map(|fact| names.fact(fact)).collect());
    }
    text
}

/// `ДВЕРЬ_НАХОДИТСЯ-В_(Дверь-ВZ, Комната-В)`, names of several words in quotes.
pub(super) fn in_rule_text(fact: &InitialFact) -> String {
    let args: Vec<_> = fact.arguments.iter().map(|a| in_quotes(&a.name)).collect();
    format!("{}_({})", fact.predicate, args.join(", "))
}

//! The facts that the map gives to planning, in the language of rule files: what is written reads back.

use std::collections::BTreeSet;

use crate::robot::facts_of_map;
use crate::semantics::planning::InitialFact;
use crate::strips::in_quotes;
use crate::units::{Gather as _, name_key};

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
            let told = |fact: &InitialFact| name_key(fact.predicate) == name_key(name);
            if !facts.iter().any(told) {
                self.rules.robot.known_predicate(name)?;
            }
            facts.retain(told);
        }
        Ok(facts)
    }

    /// The same as a rule file states them: what is written reads back. Empty where there are none.
    ///
    /// # Errors
    /// As [`State::facts_given`].
    pub fn facts_in_rule_text(&self, predicate: Option<&str>) -> Result<String, Error> {
        Ok(in_rule_file(&self.facts_given(predicate)?))
    }
}

/// Facts as a rule file states them: the objects with their types, the facts, the assumptions.
fn in_rule_file(facts: &[InitialFact]) -> String {
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
    let object = |(kind, name): &(&str, &str)| format!("{} — {kind}", in_quotes(name));
    section("Объекты", objects.iter().map(object).collect());
    for (head, assumed) in [("Факты", false), ("Предположения", true)] {
        let stated = facts.iter().filter(|fact| fact.assumed == assumed);
        section(head, stated.map(in_rule_text).collect());
    }
    text
}

/// `ДВЕРЬ_НАХОДИТСЯ-В_(Дверь-ВZ, Комната-В)`, names of several words in quotes.
pub(super) fn in_rule_text(fact: &InitialFact) -> String {
    let args: Vec<_> = fact.arguments.iter().map(|a| in_quotes(&a.name)).collect();
    format!("{}_({})", fact.predicate, args.join(", "))
}

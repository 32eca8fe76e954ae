//! What is wanted where it can be had: preferences in a PDDL goal, and what the metric makes of each (A. Gerevini,
//! D. Long, 2005, PDDL3).

use super::error::RuleError;
use super::expression::Expression;
use super::fault::RuleFault;
use super::pddl::{Reader, excerpt};
use super::syntax::{Amount, Condition, Name, PreferenceText};

impl Reader<'_> {
    /// A part of the goal; a preference stands by itself, beside or within a conjunction.
    pub(super) fn wish(&mut self, part: &Expression<'_>, goal: &mut Vec<Condition>) {
        let items = part.items();
        match (part.head().as_deref(), items) {
            (Some("and"), _) => items[1..].iter().for_each(|part| self.wish(part, goal)),
            (Some("preference"), [_, Expression::Word(name, at), wanted]) => {
                let name = Name::new(name, self.source, *at);
                let condition = Condition::Any(vec![self.conjunction(wanted)]);
                self.document.preferences.push(PreferenceText { name, condition });
            }
            (Some("preference"), _) => {
                let form = ("(preference имя условие)", "(preference name condition)");
                self.expected(form, part.span());
            }
            _ => self.condition(part, false, goal),
        }
    }

    /// The least total cost is what the planner looks for; total time, in a language without time, is steps. Weights of
    /// preferences may be added to either.
    pub(super) fn metric(&mut self, section: &Expression<'_>) {
        let known = match section.items() {
            [_, Expression::Word(direction, _), what] => {
                let mut violations = Vec::new();
                let is_known = self.summand(what, Amount::ONE, &mut violations);
                let is_known = is_known && direction.eq_ignore_ascii_case("minimize");
                if is_known {
                    self.document.violations = Some(violations);
                }
                is_known
            }
            _ => false,
        };
        if !known {
            let at = section.span();
            let metric = excerpt(self.source, at);
            let fault = RuleFault::new(self.source, RuleError::Metric { metric, at });
            self.document.warnings.push(fault);
        }
    }

    /// Whether this is a part of a metric that is known: what a plan costs, or how often so much that a preference is not
    /// met, or a sum of such.
    fn summand(
        &mut self,
        part: &Expression<'_>,
        times: Amount,
        violations: &mut Vec<(Name, Amount)>,
    ) -> bool {
        if let Expression::Word(word, _) = part {
            return times == Amount::ONE
                && ["total-cost", "total-time"].contains(&word.to_lowercase().as_str());
        }
        match (part.head().as_deref(), part.items()) {
            (Some("total-cost" | "total-time"), [_]) => times == Amount::ONE,
            (Some("is-violated"), [_, Expression::Word(name, at)]) => {
                violations.push((Name::new(name, self.source, *at), times));
                true
            }
            (
                Some("*"),
                [_, Expression::Word(number, _), what] | [_, what, Expression::Word(number, _)],
            ) => {
                let number = Amount::parse(number).filter(|_| times == Amount::ONE);
                number.is_some_and(|times| self.summand(what, times, violations))
            }
            (Some("+"), [_, parts @ ..]) => {
                parts.iter().all(|part| self.summand(part, times, violations))
            }
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Preference, Scenario};
    use crate::units::Source;

    const DOMAIN: &str = "(define (domain rounds) (:types room) (:predicates (in ?r - room) (lit ?r - room) (dark ?r - room))
        (:action go :parameters (?a ?b - room) :precondition (in ?a) :effect (and (in ?b) (not (in ?a))))
        (:action light :parameters (?a - room) :precondition (and (in ?a) (dark ?a)) :effect (and (lit ?a) (not (dark ?a)))))";

    fn read(rest: &str) -> Result<Scenario, Vec<String>> {
        let problem = format!(
            "(define (problem p) (:domain rounds) (:objects a b - room) (:init (in a) (dark a) (dark b)) {rest})"
        );
        Scenario::parse_pddl(&Source::new("d", DOMAIN), &Source::new("p", &problem))
            .map_err(|faults| faults.0.iter().map(ToString::to_string).collect())
    }

    fn weights(rest: &str) -> Vec<(String, u64)> {
        let scenario = read(rest).unwrap_or_else(|faults| panic!("{faults:?}"));
        assert!(scenario.warnings.is_empty(), "{:?}", scenario.warnings);
        let told = |own: &Preference| (own.name.clone(), own.weight);
        scenario.problem.preferences().map(told).collect()
    }

    #[test]
    fn weights_come_from_the_metric() {
        let goal =
            "(:goal (and (in b) (preference p (lit a)) (and (preference q (or (dark b) (in a))))))";
        let told = |p, q| vec![("p".to_owned(), p), ("q".to_owned(), q)];
        assert_eq!(weights(goal), told(1000, 1000));
        let metric =
            "(:metric minimize (+ (* 2.5 (is-violated P)) (* (is-violated q) 3) (is-violated q)))";
        assert_eq!(weights(&format!("{goal} {metric}")), told(2500, 4000));
        let metric = "(:metric minimize (+ (total-cost) (is-violated q)))";
        assert_eq!(weights(&format!("{goal} {metric}")), told(0, 1000));
        assert_eq!(weights("(:goal (preference p (lit a)))"), vec![("p".to_owned(), 1000)]);
    }

    #[test]
    fn a_kept_preference_is_a_goal() {
        let scenario = read("(:goal (and (in b) (preference p (lit a)) (preference q (dark a))))");
        let scenario = scenario.unwrap_or_else(|faults| panic!("{faults:?}"));
        let task = |kept: fn(usize) -> bool| {
            let problem = scenario.problem.with_preferences(kept);
            super::super::ground(&scenario.domain, &problem).expect("it means something")
        };
        assert_eq!(task(|_| false).goal.len(), 1);
        assert_eq!(task(|number| number == 0).goal.len(), 2);
        assert_eq!(task(|_| true).goal.len(), 3);
    }

    #[test]
    fn what_is_not_read_is_refused_with_its_place() {
        let told = |rest: &str| read(rest).err().unwrap_or_default();
        let unknown = told("(:goal (preference p (lit a))) (:metric minimize (is-violated r))");
        assert_eq!(unknown, ["p:1:155: неизвестное желание «r»"]);
        assert!(!told("(:goal (preference p (lit c)))").is_empty());
        assert!(!told("(:goal (preference p))").is_empty());
        assert!(!told("(:goal (or (preference p (lit a)) (in b)))").is_empty());
        let maximized = read("(:goal (preference p (lit a))) (:metric maximize (is-violated p))");
        assert_eq!(maximized.map(|scenario| scenario.warnings.len()), Ok(1));
    }
}

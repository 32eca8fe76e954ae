//! What is wanted where it can be had: preferences in a PDDL goal, and what the metric makes of each (A. Gerevini,
//! D. Long, 2005, PDDL3).

use super::error::RuleError;
use super::expression::Expression;
use super::fault::RuleFault;
use super::pddl::{Reader, excerpt};
use super::syntax::{Amount, Condition, Name, PreferenceText};
use crate::units::word;

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
                let form = word!("preference-name-condition");
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

//! A plan that was found soon, made better in the time that is left: as far as the floor lets it pass.

use super::passable::{Passable, again};
use crate::graphplan::{self, Limits, Plan};
use crate::strips::{Domain, Problem, Task};

/// Makes a plan shorter, and tells how few steps are ruled out: no plan has fewer.
///
/// The searches for a plan that a floor does not refuse had [`Limits::one_of_several`]; the rest goes into that plan.
pub(super) fn improve(
    mut floor: Option<&mut dyn Passable>,
    given: (&Domain, &Problem),
    task: &Task,
    plan: &mut Plan,
    limits: &Limits,
) -> usize {
    let is_tried = floor.is_some();
    let mut take = |plan: &mut Plan, other: Plan| {
        let floor = again(&mut floor).filter(|_| other != *plan);
        if floor.is_none_or(|floor| floor.lets_pass(given, task, &other, limits)) {
            *plan = other;
        }
    };
    if is_tried && limits.shorten_effort > limits.one_of_several().shorten_effort {
        take(plan, graphplan::shorten(task, plan.clone(), limits));
    }
    let (other, at_least) = graphplan::bounded(task, plan.clone(), limits);
    take(plan, other);
    at_least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graphplan::{Outcome, validate};
    use crate::passable::Found;
    use crate::solve::{Solved, Wanted, solve_goal};
    use crate::strips::{OperatorId, Scenario};
    use crate::units::Source;

    /// A floor on which the only plan that is found goes astray, and which lets others pass or not.
    struct Winding(bool);

    impl Passable for Winding {
        fn search(
            &mut self,
            _: (&Domain, &Problem),
            task: &mut Task,
            _: &Limits,
            _: &mut dyn FnMut(&Task) -> Outcome,
        ) -> Found {
            let go = |from: usize, to: usize| {
                let [from, to] = [from, to].map(|room| format!("r{room}"));
                let is_it = |id: &OperatorId| {
                    let args = &task.operator(*id).args;
                    *args[0] == *from && *args[1] == *to
                };
                vec![task.operator_ids().find(is_it).expect("doors lead both ways")]
            };
            let steps = vec![go(0, 1), go(1, 2), go(2, 1), go(1, 2), go(2, 3)];
            (Outcome::Plan(Plan { steps }), Vec::new())
        }

        fn lets_pass(&mut self, _: (&Domain, &Problem), _: &Task, _: &Plan, _: &Limits) -> bool {
            self.0
        }
    }

    #[test]
    fn a_plan_soon_gets_shorter_in_the_time_that_is_left_if_the_floor_lets_it_pass() {
        let domain =
            "(define (domain d) (:predicates (at ?r) (door ?a ?b)) (:action go :parameters (?a ?b)
            :precondition (and (at ?a) (door ?a ?b)) :effect (and (not (at ?a)) (at ?b))))";
        let problem = "(define (problem p) (:domain d) (:objects r0 r1 r2 r3) (:init (at r0)
            (door r0 r1) (door r1 r0) (door r1 r2) (door r2 r1) (door r2 r3) (door r3 r2)) (:goal (at r3)))";
        let (domain, problem) = (Source::new("d", domain), Source::new("p", problem));
        let Scenario { domain, problem, .. } = Scenario::parse_pddl(&domain, &problem).unwrap();
        let steps = |lets_pass, shorten_effort, parallel_steps| {
            let limits = Limits { shorten_effort, parallel_steps, ..Limits::default() };
            let mut floor = Winding(lets_pass);
            let solved = solve_goal(Some(&mut floor), &domain, &problem, &limits, Wanted::Any);
            let Ok(Solved { task, outcome: Outcome::Plan(plan), .. }) = solved else {
                panic!("there is one")
            };
            assert_eq!(validate(&task, &plan), Ok(()));
            plan.steps.len()
        };
        // Within two steps no proof comes upon a shorter one.
        assert_eq!(steps(true, u64::MAX, 2), 3);
        assert_eq!(steps(false, u64::MAX, 2), 5);
        assert_eq!(steps(true, Limits::TO_START, 2), 5);
        assert_eq!(steps(true, Limits::TO_START, 3), 3);
        assert_eq!(steps(false, Limits::TO_START, 3), 5);
    }
}

//! Who deletes a fact and adds it again keeps it from everybody else for that step (A. Blum, M. Furst, 1997): one
//! message at a time on a channel.

use std::collections::BTreeSet;

use orthoframe_graphplan::{Limits, Outcome, solve, solve_any, validate};
use orthoframe_strips::{PlanText, Scenario};
use orthoframe_units::Source;

use crate::planning_judge::{Texts, stands};
use crate::planning_properties::random::Random;

const SENDING: &str = "(define (domain d) (:requirements :strips :typing) (:types rover lander message)
 (:predicates (free ?l - lander) (ready ?r - rover) (has ?r - rover ?m - message) (sent ?m - message) (tuned ?l - lander))
 (:action send :parameters (?r - rover ?l - lander ?m - message) :precondition (and (has ?r ?m) (ready ?r) (free ?l))
  :effect (and (not (ready ?r)) (not (free ?l)) (free ?l) (sent ?m) (ready ?r)))
 (:action tune :parameters (?l - lander) :precondition (free ?l) :effect (tuned ?l))
 (:action reset :parameters (?l - lander) :precondition (and) :effect (and (tuned ?l) (free ?l))))";

/// So many rovers have a message for each other, and send them over so many landers.
fn sending(rovers: usize, landers: usize, has: &[usize], tuned: bool) -> (Scenario, Texts) {
    let names = |letter: char, count: usize, kind: &str| -> String {
        (0..count).map(|n| format!("{letter}{n} - {kind} ")).collect()
    };
    let ready: String = (0..rovers).map(|r| format!("(ready r{r})")).collect();
    let free: String = (0..landers).map(|l| format!("(free l{l})")).collect();
    let held: String = has.iter().enumerate().map(|(m, r)| format!("(has r{r} m{m})")).collect();
    let goal: String = (0..has.len()).map(|m| format!("(sent m{m})")).collect();
    let tuned: String =
        if tuned { (0..landers).map(|l| format!("(tuned l{l})")).collect() } else { String::new() };
    let problem = format!(
        "(define (problem p) (:domain d) (:objects {}{}{}) (:init {ready}{free}{held}) (:goal (and {goal}{tuned})))",
        names('r', rovers, "rover"),
        names('l', landers, "lander"),
        names('m', has.len(), "message"),
    );
    let domain = Source::new("d", SENDING);
    let scenario = Scenario::parse_pddl(&domain, &Source::new("p", &problem)).unwrap();
    (scenario, Texts::Pddl { domain: SENDING.to_owned(), problem })
}

fn steps((scenario, texts): &(Scenario, Texts)) -> usize {
    let task = scenario.ground().unwrap();
    task.check_invariants();
    let Outcome::Plan(plan) = solve(&task, &Limits::default()) else { panic!("there is a plan") };
    let Outcome::Plan(any) = solve_any(&task, &Limits::default()) else {
        panic!("there is a plan")
    };
    for plan in [&plan, &any] {
        assert_eq!(validate(&task, plan), Ok(()));
        assert!(stands(texts, &task, plan));
        let text = PlanText::write(&task, &plan.steps);
        let read = PlanText::parse(&Source::new("план", text)).unwrap();
        assert!(read.check(&scenario.domain, &scenario.problem).is_ok());
    }
    assert!(any.steps.len() >= plan.steps.len());
    plan.steps.len()
}

#[test]
fn three_messages_on_one_channel_take_three_steps() {
    assert_eq!(steps(&sending(3, 1, &[0, 1, 2], false)), 3);
    // The rover is as busy as the channel.
    assert_eq!(steps(&sending(1, 3, &[0, 0, 0], false)), 3);
    assert_eq!(steps(&sending(3, 3, &[0, 1, 2], false)), 1);
}

#[test]
fn who_only_needs_the_channel_waits_for_it_too() {
    assert_eq!(steps(&sending(1, 1, &[0], true)), 2);
    assert_eq!(steps(&sending(3, 1, &[0, 1, 2], true)), 4);
    assert_eq!(steps(&sending(2, 2, &[0, 1], true)), 2);
}

#[test]
fn two_messages_in_one_step_break_a_plan() {
    let (scenario, _) = sending(2, 1, &[0, 1], false);
    let check = |text: &str| {
        let plan = PlanText::parse(&Source::new("план", text)).unwrap();
        plan.check(&scenario.domain, &scenario.problem).map_err(|faults| faults.codes())
    };
    assert_eq!(check("0: (send r0 l0 m0)\n1: (send r1 l0 m1)"), Ok(()));
    let interference = Err(vec!["strips::plan_interference".to_owned()]);
    assert_eq!(check("0: (send r0 l0 m0)\n0: (send r1 l0 m1)"), interference);
    assert_eq!(check("0: (send r0 l0 m0)\n0: (tune l0)\n1: (send r1 l0 m1)"), interference);
    // Not needing the channel, but giving it back.
    assert_eq!(check("0: (send r0 l0 m0)\n0: (reset l0)\n1: (send r1 l0 m1)"), interference);
    assert_eq!(
        check("0: (tune l0)\n0: (reset l0)\n1: (send r0 l0 m0)\n2: (send r1 l0 m1)"),
        Ok(())
    );
}

/// Messages, rovers and channels by chance: the fewest steps are those that colouring the pairs of a rover and a lander
/// takes, which for a bipartite graph is the greatest number of messages at one of them (D. König, 1916), where every
/// message may take only one lander.
#[test]
fn the_fewest_steps_are_those_of_the_busiest() {
    for seed in 1..=60 {
        let mut random = Random::new(seed);
        let (rovers, landers) = (1 + random.below(3), 1 + random.below(3));
        let pairs: BTreeSet<(usize, usize)> = (0..1 + random.below(5))
            .map(|_| (random.below(rovers), random.below(landers)))
            .collect();
        let domain = SENDING
            .replace(
                "(has ?r - rover ?m - message)",
                "(has ?r - rover ?m - message) (to ?m - message ?l - lander)",
            )
            .replace("(and (has ?r ?m) (ready ?r)", "(and (has ?r ?m) (to ?m ?l) (ready ?r)");
        let objects: String = (0..rovers)
            .map(|r| format!("r{r} - rover "))
            .chain((0..landers).map(|l| format!("l{l} - lander ")))
            .chain((0..pairs.len()).map(|m| format!("m{m} - message ")))
            .collect();
        let init: String = (0..rovers)
            .map(|r| format!("(ready r{r})"))
            .chain((0..landers).map(|l| format!("(free l{l})")))
            .chain(
                pairs
                    .iter()
                    .enumerate()
                    .map(|(m, (r, l))| format!("(has r{r} m{m})(to m{m} l{l})")),
            )
            .collect();
        let goal: String = (0..pairs.len()).map(|m| format!("(sent m{m})")).collect();
        let problem = format!(
            "(define (problem p) (:domain d) (:objects {objects}) (:init {init}) (:goal (and {goal})))"
        );
        let sources = (Source::new("d", &domain), Source::new("p", &problem));
        let scenario = Scenario::parse_pddl(&sources.0, &sources.1).unwrap();
        let given = (scenario, Texts::Pddl { domain, problem });
        let at_rover = |r| pairs.iter().filter(|pair| pair.0 == r).count();
        let at_lander = |l| pairs.iter().filter(|pair| pair.1 == l).count();
        let busiest = (0..rovers).map(at_rover).chain((0..landers).map(at_lander)).max();
        assert_eq!(Some(steps(&given)), busiest, "seed {seed}: {pairs:?}");
    }
}

//! Of the preferences that cannot all be met those whose failing costs least are left out, and that is proven.
//!
//! Sets of them that are left out are tried in the order of their weight. Where one is not enough, some few of those kept
//! are found that no plan meets together with the goal, and each next set leaves out one of these (R. Reiter, 1987, on
//! hitting sets). What is to be done then is a plain goal, planned for as any other: the fewest steps are those for what
//! is kept, for another choice that fails no more there may be fewer.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap, HashSet};

use super::passable::{Passable, again};
use super::solve::{Solved, Wanted, solve_goal};
use crate::graphplan::{Limits, Outcome};
use crate::strips::{Domain, Preference, Problem, RuleFaults};
use crate::units::{Gather as _, Language, told};

/// Which preferences a plan meets.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Wishes {
    pub met: Vec<Preference>,
    pub unmet: Vec<Preference>,
    /// Proven: no plan fails less. Else not every lighter set could be ruled out.
    pub is_least: bool,
}

impl Wishes {
    /// What failing costs, in thousandths.
    #[must_use]
    pub fn weight(&self) -> u64 {
        self.unmet.iter().map(|preference| preference.weight).sum()
    }

    #[must_use]
    pub fn in_words(&self, language: Language) -> String {
        let names = |all: &[Preference]| {
            let names = all.iter().map(|one| format!("{} ({})", one.name, written(one.weight)));
            names.collect::<Vec<_>>().join(", ")
        };
        if self.unmet.is_empty() {
            let all = names(&self.met);
            return told!(language, "wishes-met", all);
        }
        let least = match self.is_least {
            true => told!(language, "wishes-least"),
            false => {
                told!(language, "wishes-maybe-less")
            }
        };
        let (unmet, weight) = (names(&self.unmet), written(self.weight()));
        told!(language, "wishes-unmet", unmet, weight, least)
    }
}

/// Thousandths as a number.
fn written(thousandths: u64) -> String {
    let text = format!("{}.{:03}", thousandths / 1000, thousandths % 1000);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// As [`super::solve_on`], for a problem with preferences.
pub(super) fn solve(
    mut floor: Option<&mut dyn Passable>,
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
    wanted: Wanted,
) -> Result<Solved, RuleFaults> {
    let all: Vec<Preference> = problem.preferences().cloned().collect();
    let limits = &limits.one_of_several();
    let mut without = |left_out: &BTreeSet<usize>| {
        let problem = problem.with_preferences(|number| !left_out.contains(&number));
        solve_goal(again(&mut floor), domain, &problem, limits, wanted)
    };
    let told = |mut solved: Solved, left_out: &BTreeSet<usize>, is_least| {
        let (mut met, mut unmet) = (Vec::new(), Vec::new());
        for (number, preference) in all.iter().cloned().enumerate() {
            if left_out.contains(&number) { &mut unmet } else { &mut met }.push(preference);
        }
        solved.wishes = Some(Wishes { met, unmet, is_least });
        solved
    };
    let everything: BTreeSet<usize> = (0..all.len()).gather();
    // Preferences that no plan meets together.
    let mut never: Vec<BTreeSet<usize>> = Vec::new();
    let mut is_least = true;
    let mut open = BinaryHeap::from([Reverse((0, BTreeSet::new()))]);
    let mut seen = HashSet::new();
    while let Some(Reverse((_, left_out))) = open.pop() {
        let mut clash = never.iter().find(|clash| clash.is_disjoint(&left_out)).cloned();
        if clash.is_none() {
            let solved = without(&left_out)?;
            match solved.outcome {
                // Without any of them there is none either: that is why.
                Outcome::NoPlan { .. } if left_out == everything => return Ok(solved),
                Outcome::NoPlan { .. } => {
                    if never.is_empty() {
                        let plain = without(&everything)?;
                        if matches!(plain.outcome, Outcome::NoPlan { .. }) {
                            return Ok(plain);
                        }
                    }
                    let mut few: BTreeSet<usize> =
                        everything.difference(&left_out).copied().gather();
                    for one in few.clone() {
                        let fewer: BTreeSet<usize> =
                            few.iter().copied().filter(|&other| other != one).gather();
                        let rest = everything.difference(&fewer).copied().collect();
                        if matches!(without(&rest)?.outcome, Outcome::NoPlan { .. }) {
                            few = fewer;
                        }
                    }
                    never.push(few.clone());
                    clash = Some(few);
                }
                Outcome::LimitReached(ref known)
                    if known.plan.is_none()
                        && left_out != everything
                        && limits.check(0).is_ok() =>
                {
                    // Too hard to tell; what asks for less may be easier.
                    is_least = false;
                    clash = Some(everything.difference(&left_out).copied().collect());
                }
                _ => return Ok(told(solved, &left_out, is_least)),
            }
        }
        for one in clash.into_iter().flatten() {
            let mut more = left_out.clone();
            more.insert(one);
            let weight: u64 = more.iter().map(|&number| all[number].weight).sum();
            if seen.insert(more.clone()) {
                open.push(Reverse((weight, more)));
            }
        }
    }
    // Every clash was left out of in every way, and all of them together are no clash: not reached.
    without(&everything)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strips::Scenario;
    use crate::units::Source;

    /// A token that leaves each of five places for one of two others, and facts that it leaves behind or wipes out.
    fn scenario(seed: u64) -> Scenario {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        let mut below = |bound: u64| {
            state ^= state >> 12;
            state ^= state << 25;
            state ^= state >> 27;
            (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) % bound
        };
        let mut actions = String::new();
        for number in 0..8 {
            let (from, to, adds, wipes) = (below(5), below(5), below(4), below(4));
            actions += &format!(
                "(:action a{number} :precondition (p{from}) :effect (and (not (p{from})) (p{to}) (not (q{wipes})) (q{adds})))"
            );
        }
        let (mut wishes, mut sum) = (String::new(), String::new());
        for number in 0..1 + below(4) {
            let (a, b, weight) = (below(4), below(5), 1 + below(4));
            let not = if below(2) == 0 { format!("(not (q{a}))") } else { format!("(q{a})") };
            wishes += &format!("(preference w{number} (and {not} (or (p{b}) (p{}))))", below(5));
            sum += &format!("(* {weight} (is-violated w{number}))");
        }
        let predicates: String = (0..5).map(|n| format!("(p{n}) (q{n})")).collect();
        let domain = format!("(define (domain d) (:predicates {predicates}) {actions})");
        let problem = format!(
            "(define (problem p) (:domain d) (:init (p0)) (:goal (and {wishes})) (:metric minimize (+ {sum})))"
        );
        Scenario::parse_pddl(&Source::new("d", &domain), &Source::new("p", &problem))
            .unwrap_or_else(|faults| panic!("{faults}"))
    }

    /// The least weight that fails, by trying every set.
    fn least(scenario: &Scenario, limits: &Limits) -> u64 {
        let all: Vec<Preference> = scenario.problem.preferences().cloned().collect();
        let failing = (0..1_usize << all.len()).filter_map(|kept| {
            let problem = scenario.problem.with_preferences(|number| kept >> number & 1 == 1);
            let solved =
                solve_goal(None, &scenario.domain, &problem, limits, Wanted::Shortest).ok()?;
            let left = all.iter().enumerate().filter(|(number, _)| kept >> number & 1 == 0);
            solved.outcome.plan().is_some().then(|| left.map(|(_, one)| one.weight).sum())
        });
        failing.min().expect("to wish for nothing can be had")
    }

    #[test]
    fn as_little_fails_as_can() {
        let (mut some, mut none) = (0, 0);
        for seed in 1..=60 {
            let (scenario, limits) = (scenario(seed), Limits::default());
            let least = least(&scenario, &limits);
            for wanted in [Wanted::Shortest, Wanted::Any] {
                let solved =
                    super::super::solve(&scenario.domain, &scenario.problem, &limits, wanted)
                        .unwrap_or_else(|faults| panic!("{faults}"));
                assert!(solved.outcome.plan().is_some(), "seed {seed}");
                let wishes = solved.wishes.expect("it has preferences");
                assert!(wishes.is_least, "seed {seed}");
                assert_eq!(wishes.weight(), least, "seed {seed}: {wishes:?}");
            }
            if least > 0 { some += 1 } else { none += 1 }
        }
        assert!(some > 10 && none > 5, "{some} {none}");
    }

    #[test]
    fn what_fails_is_told_with_its_weight() {
        let one = |name: &str, weight| Preference { name: name.to_owned(), weight };
        let wishes = Wishes {
            met: vec![one("окно", 1000)],
            unmet: vec![one("свет", 2500), one("ключ", 1000)],
            is_least: true,
        };
        let told =
            "Желания не исполнены: свет (2.5), ключ (1); всего 3.5, меньше нельзя, это доказано.";
        assert_eq!(wishes.in_words(Language::Russian), told);
    }
}

//! The planner against breadth-first search over states on small random tasks.

use std::collections::{HashMap, HashSet};

use super::samples::{Named, Random, random_errand, random_task, random_task_with_objects, wishes};
use super::*;
use crate::proof::{Turn, search};
use crate::strips::{Operator, Task};

/// Facts as bits.
fn mask(facts: &[FactId]) -> u64 {
    facts.iter().fold(0, |mask, fact| mask | 1 << fact.0)
}

/// Every set of operators that may be carried out at once in a state: the state after it, and what it costs.
fn steps_from(task: &Task, state: u64) -> Vec<(u64, u64)> {
    let applicable: Vec<&Operator> = task
        .operators
        .iter()
        .filter(|o| state & mask(&o.preconditions) == mask(&o.preconditions))
        .collect();
    let mut steps = Vec::new();
    for set in 0_u32..1 << applicable.len() {
        let chosen: Vec<&Operator> = (0..applicable.len())
            .filter(|at| set >> at & 1 == 1)
            .map(|at| applicable[at])
            .collect();
        let free = chosen.iter().enumerate().all(|(x, a)| {
            chosen.iter().enumerate().all(|(y, b)| {
                let used = mask(&b.preconditions) | mask(&b.add_effects);
                x == y || mask(&a.del_effects) & used == 0 && mask(&a.renewed) & used == 0
            })
        });
        if free {
            let dels = chosen.iter().fold(0, |all, o| all | mask(&o.del_effects));
            let adds = chosen.iter().fold(0, |all, o| all | mask(&o.add_effects));
            let cost = chosen.iter().map(|o| u64::from(o.cost)).sum();
            steps.push((state & !dels | adds, cost));
        }
    }
    steps
}

/// Fewest parallel steps by trying every set of operators in every state.
pub(super) fn fewest_steps(task: &Task) -> Option<usize> {
    let goal = mask(&task.goal);
    let mut seen = HashSet::from([mask(&task.init)]);
    let mut layer: Vec<u64> = seen.iter().copied().collect();
    let mut steps = 0;
    while !layer.is_empty() {
        if layer.iter().any(|state| state & goal == goal) {
            return Some(steps);
        }
        let after = layer.iter().flat_map(|&state| steps_from(task, state));
        layer = after.map(|(state, _)| state).filter(|&state| seen.insert(state)).collect();
        steps += 1;
    }
    None
}

/// The least that a plan of so many parallel steps costs.
fn least_cost(task: &Task, steps: usize) -> u64 {
    let mut layer = HashMap::from([(mask(&task.init), 0)]);
    for _ in 0..steps {
        let mut next: HashMap<u64, u64> = HashMap::new();
        for (state, spent) in layer {
            for (after, cost) in steps_from(task, state) {
                let least = next.entry(after).or_insert(u64::MAX);
                *least = (spent + cost).min(*least);
            }
        }
        layer = next;
    }
    let goal = mask(&task.goal);
    layer.iter().filter(|(state, _)| **state & goal == goal).map(|(_, &cost)| cost).min().unwrap()
}

#[test]
fn of_all_plans_with_the_fewest_steps_one_of_the_cheapest_is_found() {
    let enough = Limits { fewer_actions: 1 << 20, ..Limits::default() };
    let mut improved = 0;
    for seed in 1..=3000 {
        let mut task = random_task(seed);
        if seed.is_multiple_of(3) {
            let mut random = Random(seed);
            task.operators.iter_mut().for_each(|operator| operator.cost = random.below(4) as u32);
        }
        let Outcome::Plan(plan) = solve(&task, &enough) else { continue };
        assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
        assert_eq!(plan.cost(&task), least_cost(&task, plan.steps.len()), "seed {seed}");
        let Outcome::Plan(first) = solve(&task, &Limits { fewer_actions: 0, ..enough.clone() })
        else {
            panic!("seed {seed}: the same steps")
        };
        improved += usize::from(first.cost(&task) > plan.cost(&task));
    }
    assert!(improved > 10, "{improved}");
}

#[test]
fn answers_equal_those_of_breadth_first_search() {
    compare(Turn::default());
}

#[test]
fn answers_are_the_same_when_the_solver_finds_them() {
    compare(Turn { choices: 16, ..Turn::default() });
}

fn compare(turn: Turn) {
    let (mut solved, mut unsolvable, mut searched) = (0, 0, 0);
    for seed in 1..=3000 {
        let task = random_task(seed);
        let fewest = fewest_steps(&task);
        let any = solve_any(&task, &Limits::default());
        match &any {
            Outcome::Plan(plan) => {
                assert_eq!(validate(&task, plan), Ok(()), "seed {seed}");
                assert!(Some(plan.steps.len()) >= fewest, "seed {seed}");
            }
            _ => assert_eq!(fewest, None, "seed {seed}"),
        }
        let outcome = search(&task, &Limits::default(), turn, None);
        let answer = |(found, _): (Option<_>, _)| found.expect("turns without end");
        match outcome.map_or_else(Outcome::LimitReached, answer) {
            Outcome::Plan(plan) => {
                assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                assert_eq!(Some(plan.steps.len()), fewest, "seed {seed}");
                solved += 1;
            }
            Outcome::NoPlan { reason, .. } => {
                assert_eq!(fewest, None, "seed {seed}");
                unsolvable += 1;
                searched += usize::from(matches!(reason, NoPlanReason::Together(_)));
            }
            Outcome::LimitReached(known) => panic!("seed {seed}: {known:?}"),
        }
    }
    // The generator is worth its name only if every kind of answer comes up.
    assert!(solved > 500 && unsolvable > 500 && searched > 0, "{solved} {unsolvable} {searched}");
}

#[test]
fn answers_are_the_same_when_some_plan_is_sought_first() {
    compare(Turn { choices: 16, seek: Some(0), ..Turn::default() });
}

#[test]
fn a_search_given_up_leaves_true_bounds() {
    let (mut bounded, mut with_plan) = (0, 0);
    for seed in 1..=3000 {
        let task = random_task(seed);
        let Some(fewest) = fewest_steps(&task) else { continue };
        for steps in 0..fewest {
            let limits = Limits { parallel_steps: steps, ..Limits::default() };
            let turn = Turn { seek: Some(0), ..Turn::default() };
            let Err(known) = search(&task, &limits, turn, None) else {
                panic!("seed {seed}: {steps} of {fewest} steps")
            };
            assert_eq!(known.limit, Limit::Steps, "seed {seed}");
            assert!(known.at_least == steps + 1 && known.at_least <= fewest, "seed {seed}");
            if let Some(plan) = known.plan {
                assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                assert!(plan.steps.len() >= fewest, "seed {seed}");
                with_plan += 1;
            }
            bounded += 1;
        }
    }
    assert!(bounded > 500 && with_plan > 5, "{bounded} {with_plan}");
}

#[test]
fn a_search_told_to_stop_stops() {
    let stop = crate::units::Stop::new();
    stop.raise();
    let limits = Limits { stop: Some(stop), ..Limits::default() };
    for seed in 1..=50 {
        let task = random_task(seed);
        assert_eq!(solve(&task, &limits).limit(), Some(Limit::Stopped), "seed {seed}");
    }
}

#[test]
fn no_goods_are_true_of_their_images() {
    let (mut solved, mut together) = (0, 0);
    for seed in 1..=3000 {
        let task = random_task_with_objects(seed);
        match solve(&task, &Limits::default()) {
            Outcome::Plan(plan) => {
                assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                assert_eq!(Some(plan.steps.len()), fewest_steps(&task), "seed {seed}");
                solved += usize::from(plan.steps.len() > 1);
            }
            Outcome::NoPlan { reason, .. } => {
                assert_eq!(fewest_steps(&task), None, "seed {seed}");
                together += usize::from(matches!(reason, NoPlanReason::Together(_)));
            }
            Outcome::LimitReached(limit) => panic!("seed {seed}: {limit:?}"),
        }
    }
    assert!(solved > 20 && together > 0, "{solved} {together}");
}

#[test]
fn goals_that_fit_by_pairs_but_not_together_are_refused() {
    for tokens in 2..5 {
        assert!(matches!(solve(&wishes(tokens, tokens), &Limits::default()), Outcome::Plan(_)));
        let Outcome::NoPlan { reason: NoPlanReason::Together(goals), .. } =
            solve(&wishes(tokens + 1, tokens), &Limits::default())
        else {
            panic!("{tokens} tokens grant no more than {tokens} wishes")
        };
        assert_eq!(goals.len(), tokens as usize + 1);
    }
}

#[test]
fn every_plan_passes_the_milestones_one_after_the_other() {
    let (mut rows, mut longest) = (0, 0);
    for seed in 1..=3000 {
        let task = random_task(seed);
        let row = milestones(&task);
        for outcome in [solve(&task, &Limits::default()), solve_any(&task, &Limits::default())] {
            let Outcome::Plan(plan) = outcome else { continue };
            // When each fact holds for the first time.
            let mut first: HashMap<FactId, usize> = task.init.iter().map(|&f| (f, 0)).collect();
            for (n, step) in plan.steps.iter().enumerate() {
                for &operator in step {
                    for &fact in &task.operator(operator).add_effects {
                        first.entry(fact).or_insert(n + 1);
                    }
                }
            }
            let times: Vec<usize> = row.iter().map(|fact| first[fact]).collect();
            let rises = times.windows(2).all(|pair| pair[0] < pair[1]);
            assert!(rises && times.first() != Some(&0), "seed {seed}: {times:?}");
            assert!(row.len() <= plan.steps.len(), "seed {seed}");
            (rows, longest) = (rows + usize::from(row.len() > 1), longest.max(row.len()));
        }
    }
    assert!(rows > 100 && longest > 2, "{rows} {longest}");
}

#[test]
fn a_plan_with_a_flaw_is_refused() {
    let task = (1..)
        .map(random_task)
        .find(|task| fewest_steps(task).is_some_and(|steps| steps >= 3))
        .expect("some random task takes three steps");
    let Outcome::Plan(plan) = solve(&task, &Limits::default()) else { panic!("it is solvable") };
    for missing in 0..plan.steps.len() {
        let mut broken = plan.clone();
        broken.steps.remove(missing);
        assert!(validate(&task, &broken).is_err(), "every step of a shortest plan is needed");
    }
}

#[test]
fn a_plan_found_soon_becomes_shorter_with_effort() {
    let mut shortened = 0;
    for seed in 1..=3000 {
        let task = random_task(seed);
        let at_once = Limits { shorten: 0, ..Limits::default() };
        let Outcome::Plan(first) = solve_any(&task, &at_once) else { continue };
        let Outcome::Plan(plan) = solve_any(&task, &Limits::default()) else {
            panic!("seed {seed}: there was a plan")
        };
        assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
        assert!(plan.steps.len() <= first.steps.len(), "seed {seed}");
        shortened += usize::from(plan.steps.len() < first.steps.len());
    }
    assert!(shortened > 0);
}

#[test]
fn what_is_ruled_out_of_a_plan_found_soon_is_true() {
    let (mut proven, mut apart) = (0, 0);
    for seed in 1..=3000 {
        let task = random_task(seed);
        let fewest = fewest_steps(&task);
        let at_once = crate::portfolio::steps_at_least(&task);
        assert!(fewest.is_none_or(|fewest| at_once <= fewest), "seed {seed}");
        // No time for anything but that.
        let now = Limits { deadline: Some(Instant::now()), ..Limits::default() };
        if let Outcome::LimitReached(known) = solve_any(&task, &now) {
            assert!(known.at_least >= at_once, "seed {seed}");
        }
        let Outcome::Plan(first) = solve_any(&task, &Limits::default()) else { continue };
        let (plan, at_least) = bounded(&task, first.clone(), &Limits::default());
        assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
        assert!(plan.action_count() <= first.action_count(), "seed {seed}");
        assert!(plan.steps.len() <= first.steps.len(), "seed {seed}");
        assert!(Some(at_least) <= fewest && at_least >= at_once, "seed {seed}");
        proven += usize::from(at_least == plan.steps.len());
        apart += usize::from(at_least > at_once);
        // Where there is no time, the plan stays, with what is seen at once.
        let (same, least) = bounded(&task, first.clone(), &now);
        assert_eq!((same, least), (first, at_once), "seed {seed}");
    }
    assert!(proven > 100 && apart > 10, "{proven} proven, {apart} by more than a look");
}

#[test]
fn limits_are_an_outcome() {
    let task = (1..).map(random_task).find(|t| fewest_steps(t).is_some_and(|s| s >= 2)).unwrap();
    let now = Limits { deadline: Some(Instant::now()), ..Limits::default() };
    assert_eq!(solve(&task, &now).limit(), Some(Limit::Time));
    let short = Limits { parallel_steps: 1, ..Limits::default() };
    assert_eq!(solve(&task, &short).limit(), Some(Limit::Steps));
    let small = Limits { memory_bytes: 1, ..Limits::default() };
    assert_eq!(solve(&task, &small).limit(), Some(Limit::Memory));
}

/// The task after its initial state lost a fact and grounding dropped what that made impossible.
fn without_fact(task: &Task, lost: FactId) -> Task {
    let mut rest = task.clone();
    rest.init.retain(|&fact| fact != lost);
    let mut possible: Vec<bool> = task.fact_ids().map(|fact| rest.init.contains(&fact)).collect();
    loop {
        let before = possible.iter().filter(|&&possible| possible).count();
        for operator in &task.operators {
            if operator.preconditions.iter().all(|fact| possible[fact.index()]) {
                operator.add_effects.iter().for_each(|fact| possible[fact.index()] = true);
            }
        }
        if possible.iter().filter(|&&possible| possible).count() == before {
            break;
        }
    }
    rest.operators.retain(|o| o.preconditions.iter().all(|fact| possible[fact.index()]));
    rest.goal.iter().for_each(|fact| possible[fact.index()] = true);
    let number: Vec<Option<FactId>> = possible
        .iter()
        .scan(0, |next, &possible| {
            let number = possible.then_some(FactId(*next));
            *next += u32::from(possible);
            Some(number)
        })
        .collect();
    let renumber = |facts: &mut Vec<FactId>| {
        *facts = facts.iter().filter_map(|fact| number[fact.index()]).collect();
    };
    renumber(&mut rest.init);
    renumber(&mut rest.goal);
    for operator in &mut rest.operators {
        renumber(&mut operator.preconditions);
        renumber(&mut operator.add_effects);
        renumber(&mut operator.del_effects);
        renumber(&mut operator.renewed);
    }
    let mut kept = possible.iter();
    rest.facts.retain(|_| *kept.next().unwrap());
    rest.check_invariants();
    rest
}

#[test]
fn planning_anew_with_what_was_learned_comes_to_the_same() {
    let (mut inherited, mut plans, mut together) = (0, 0, 0);
    let seeds: usize = if std::env::var_os("ORTHOFRAME_LONG").is_some() { 4000 } else { 1200 };
    for seed in 1..=seeds as u64 {
        let tasks = [random_task(seed), random_task_with_objects(seed)];
        for (kind, task) in tasks.iter().enumerate() {
            let (_, learned) = solve_learning(task, None, &Limits::default());
            let learned = learned.unwrap();
            for &lost in &task.init {
                let rest = without_fact(task, lost);
                inherited += usize::from(learned.about(&rest).is_some());
                let (again, _) = solve_learning(&rest, Some(&learned), &Limits::default());
                match (again, solve(&rest, &Limits::default())) {
                    (Outcome::Plan(again), Outcome::Plan(anew)) => {
                        assert_eq!(validate(&rest, &again), Ok(()), "{kind} seed {seed}");
                        assert_eq!(again.steps.len(), anew.steps.len(), "{kind} seed {seed}");
                        plans += usize::from(anew.steps.len() > 1);
                    }
                    (Outcome::NoPlan { reason, .. }, Outcome::NoPlan { .. }) => {
                        together += usize::from(matches!(reason, NoPlanReason::Together(_)));
                    }
                    other => panic!("{kind} seed {seed}: {other:?}"),
                }
            }
        }
    }
    let is_much = inherited * 4 > seeds * 5 && plans * 20 > seeds && together > 0;
    assert!(is_much, "{inherited} {plans} {together}");
}

#[test]
fn planning_anew_on_the_way_comes_to_the_same() {
    let (mut inherited, mut plans, mut none) = (0, 0, 0);
    for seed in 1..=4000 {
        for task in [random_task(seed), random_task_with_objects(seed)] {
            let (Outcome::Plan(plan), _) = solve_learning(&task, None, &Limits::default()) else {
                continue;
            };
            for done in 1..plan.steps.len() {
                // The last step carried out only in part, as when a surprise cuts it short.
                let mut steps = plan.steps[..done].to_vec();
                steps.last_mut().expect("one step at least").truncate(1 + seed as usize % 2);
                let (_, learned) = solve_learning(&task, None, &Limits::default());
                let learned = learned.unwrap().after(&steps).expect("a plan can be carried out");
                let here = Task { init: learned.state.clone(), ..task.clone() };
                for &lost in &here.init {
                    let rest = without_fact(&here, lost);
                    inherited += usize::from(learned.serves(&rest));
                    let (again, _) = solve_learning(&rest, Some(&learned), &Limits::default());
                    match (again, solve(&rest, &Limits::default())) {
                        (Outcome::Plan(again), Outcome::Plan(anew)) => {
                            assert_eq!(validate(&rest, &again), Ok(()), "seed {seed}");
                            assert_eq!(again.steps.len(), anew.steps.len(), "seed {seed}");
                            plans += 1;
                        }
                        (Outcome::NoPlan { .. }, Outcome::NoPlan { .. }) => none += 1,
                        other => panic!("seed {seed}: {other:?}"),
                    }
                }
            }
        }
    }
    assert!(inherited > 500 && plans > 100 && none > 100, "{inherited} {plans} {none}");
}

#[test]
fn another_initial_fact_teaches_nothing() {
    let task = random_task(1);
    let (_, learned) = solve_learning(&task, None, &Limits::default());
    let learned = learned.unwrap();
    assert!(learned.about(&task).is_some());
    let more = task.fact_ids().find(|fact| !task.init.contains(fact)).unwrap();
    let mut richer = task.clone();
    richer.init.push(more);
    richer.init.sort_unstable();
    assert!(learned.about(&richer).is_none());
    let mut other = task;
    other.operators[0].del_effects.clear();
    other.operators[0].add_effects = vec![more];
    assert!(learned.about(&other).is_none());
}

#[test]
fn what_no_shortest_plan_needs_is_left_out() {
    let (mut smaller, mut solved) = (0, 0);
    for seed in 1..=9000 {
        let task = match seed % 3 {
            0 => random_task(seed),
            1 => random_task_with_objects(seed),
            _ => random_errand(seed),
        };
        let reduced = crate::proof::needed::Reduced::of(&task, &Limits::default()).unwrap();
        reduced.task.check_invariants();
        let fewest = fewest_steps(&task);
        assert_eq!(fewest_steps(&reduced.task), fewest, "seed {seed}");
        smaller += usize::from(reduced.task.operators.len() < task.operators.len());
        solved += usize::from(fewest.is_some_and(|steps| steps > 2));
        if seed % 10 == 0
            && let Some(steps) = fewest
        {
            assert_eq!(least_cost(&reduced.task, steps), least_cost(&task, steps), "seed {seed}");
        }
        match crate::proof::solve_large(&task, &Limits::default()) {
            Ok(Outcome::Plan(plan)) => {
                assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                assert_eq!(Some(plan.steps.len()), fewest, "seed {seed}");
            }
            Ok(Outcome::NoPlan { .. }) => assert_eq!(fewest, None, "seed {seed}"),
            other => panic!("seed {seed}: {other:?}"),
        }
    }
    assert!(smaller > 3000 && solved > 1000, "{smaller} {solved}");
}

/// A robot at one of many chairs that carries a cup past them: nobody has anything to do at a chair.
#[test]
fn what_is_only_passed_through_is_left_out() {
    let mut named = Named::default();
    let places: Vec<FactId> = (0..6).map(|n| named.fact(&format!("place{n}"))).collect();
    for &from in &places {
        for &to in places.iter().filter(|to| **to != from) {
            named.operator(&[from], &[to], &[from]);
        }
    }
    let [hand, held] = ["hand", "cup held"].map(|name| named.fact(name));
    let [first, last] = [0, 5].map(|n| {
        let (here, lies) = (places[n], named.fact(&format!("cup at place{n}")));
        named.operator(&[here, hand, lies], &[held], &[hand, lies]);
        named.operator(&[here, held], &[hand, lies], &[held]);
        lies
    });
    let task = named.task(&[places[3], first, hand], &[last]);
    let reduced = crate::proof::needed::Reduced::of(&task, &Limits::default()).unwrap();
    assert_eq!(fewest_steps(&reduced.task), Some(4));
    // From the start to the cup and on: between places 0, 3 and 5 alone, and none of the ways back to the start.
    let left: Vec<String> = reduced.task.facts.iter().map(|f| f.predicate.to_string()).collect();
    assert!(!left.iter().any(|fact| ["place1", "place2", "place4"].contains(&&**fact)), "{left:?}");
}

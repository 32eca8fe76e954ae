//! The planner against breadth-first search over states on small random tasks.

use std::collections::{HashMap, HashSet};

use super::*;
use crate::strips::{Fact, Operator};

/// A small generator with a seed for an argument (xorshift64*).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        ((self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize) % bound
    }

    fn facts(&mut self, count: usize, of: usize) -> Vec<FactId> {
        let mut facts: Vec<FactId> = (0..count).map(|_| FactId(self.below(of) as u32)).collect();
        facts.sort_unstable();
        facts.dedup();
        facts
    }
}

pub(super) fn random_task(seed: u64) -> Task {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let fact_count = 4 + random.below(6);
    let facts = (0..fact_count)
        .map(|number| Fact {
            predicate: format!("f{number}").into(),
            args: Vec::new(),
            negated: false,
        })
        .collect();
    let operators = (0..3 + random.below(8))
        .map(|number| {
            let (needs, adds, dels) = (random.below(4), 1 + random.below(2), random.below(3));
            let add_effects = random.facts(adds, fact_count);
            let preconditions = random.facts(needs, fact_count);
            // Operators that use up what they need make goals that exclude each other by threes.
            let mut del_effects = if seed.is_multiple_of(2) {
                preconditions.clone()
            } else {
                random.facts(dels, fact_count)
            };
            del_effects.retain(|fact| !add_effects.contains(fact));
            Operator {
                name: format!("o{number}").into(),
                args: Vec::new(),
                preconditions,
                add_effects,
                del_effects,
                cost: 1,
            }
        })
        .collect();
    let (held, wanted) = (1 + random.below(3), 1 + random.below(4));
    let task = Task {
        facts,
        operators,
        init: random.facts(held, fact_count),
        goal: random.facts(wanted, fact_count),
        assumptions: Vec::new(),
    };
    task.check_invariants();
    task
}

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
                x == y || mask(&a.del_effects) & used == 0
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
        let Outcome::Plan(first) = solve(&task, &Limits { fewer_actions: 0, ..enough }) else {
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
            Outcome::LimitReached(limit) => panic!("seed {seed}: {limit:?}"),
        }
    }
    // The generator is worth its name only if every kind of answer comes up.
    assert!(solved > 500 && unsolvable > 500 && searched > 0, "{solved} {unsolvable} {searched}");
}

/// A task over three objects that the initial state hardly tells apart: actions come in threes.
fn random_task_with_objects(seed: u64) -> Task {
    const OBJECTS: usize = 3;
    const PREDICATES: usize = 3;
    const FLAGS: usize = 2;
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut facts = Vec::new();
    for predicate in 0..PREDICATES {
        for object in 0..OBJECTS {
            let args = vec![format!("object{object}").into()];
            facts.push(Fact { predicate: format!("p{predicate}").into(), args, negated: false });
        }
    }
    for flag in 0..FLAGS {
        facts.push(Fact {
            predicate: format!("flag{flag}").into(),
            args: Vec::new(),
            negated: false,
        });
    }
    // Numbers below PREDICATES are facts about the action's object, the others flags.
    let pick = |random: &mut Random, count: usize| -> Vec<usize> {
        (0..count).map(|_| random.below(PREDICATES + FLAGS)).collect()
    };
    let about = |numbers: &[usize], object: usize| -> Vec<FactId> {
        let fact = |&n: &usize| {
            if n < PREDICATES { n * OBJECTS + object } else { PREDICATES * (OBJECTS - 1) + n }
        };
        let mut facts: Vec<FactId> = numbers.iter().map(|n| FactId(fact(n) as u32)).collect();
        facts.sort_unstable();
        facts.dedup();
        facts
    };
    let mut operators = Vec::new();
    for schema in 0..3 {
        let (needs, adds) = (1 + random.below(3), 1 + random.below(2));
        let (needs, adds) = (pick(&mut random, needs), pick(&mut random, adds));
        let dels = if random.below(3) > 0 { needs.clone() } else { pick(&mut random, 1) };
        for object in 0..OBJECTS {
            let add_effects = about(&adds, object);
            let mut del_effects = about(&dels, object);
            del_effects.retain(|fact| !add_effects.contains(fact));
            operators.push(Operator {
                name: format!("o{schema}").into(),
                args: vec![format!("object{object}").into()],
                preconditions: about(&needs, object),
                add_effects,
                del_effects,
                cost: 1,
            });
        }
    }
    // One fact an object, mostly the same: some objects are interchangeable, some only look so.
    let mut init: Vec<FactId> = (0..OBJECTS)
        .map(|object| FactId((random.below(3) / 2 * OBJECTS + object) as u32))
        .collect();
    init.sort_unstable();
    init.extend((0..FLAGS as u32).map(|flag| FactId((PREDICATES * OBJECTS) as u32 + flag)));
    let wanted = 2 + random.below(3);
    let goal = random.facts(wanted, facts.len());
    let task = Task { facts, operators, init, goal, assumptions: Vec::new() };
    task.check_invariants();
    task
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

/// As many wishes as one likes, each granted by using up one of a few tokens.
fn wishes(wishes: u32, tokens: u32) -> Task {
    let fact = |name: String| Fact { predicate: name.into(), args: Vec::new(), negated: false };
    let granted = (0..wishes).map(|w| fact(format!("wish{w}")));
    let held = (0..tokens).map(|t| fact(format!("token{t}")));
    let operators = (0..wishes).flat_map(|w| (0..tokens).map(move |t| (w, FactId(wishes + t))));
    Task {
        facts: granted.chain(held).collect(),
        operators: operators
            .map(|(w, token)| Operator {
                name: format!("grant{w}").into(),
                args: Vec::new(),
                preconditions: vec![token],
                add_effects: vec![FactId(w)],
                del_effects: vec![token],
                cost: 1,
            })
            .collect(),
        init: (wishes..wishes + tokens).map(FactId).collect(),
        goal: (0..wishes).map(FactId).collect(),
        assumptions: Vec::new(),
    }
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
fn limits_are_an_outcome() {
    let task = (1..).map(random_task).find(|t| fewest_steps(t).is_some_and(|s| s >= 2)).unwrap();
    let now = Limits { deadline: Some(Instant::now()), ..Limits::default() };
    assert_eq!(solve(&task, &now), Outcome::LimitReached(Limit::Time));
    let short = Limits { parallel_steps: 1, ..Limits::default() };
    assert_eq!(solve(&task, &short), Outcome::LimitReached(Limit::Steps));
    let small = Limits { memory_bytes: 1, ..Limits::default() };
    assert_eq!(solve(&task, &small), Outcome::LimitReached(Limit::Memory));
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
    }
    let mut kept = possible.iter();
    rest.facts.retain(|_| *kept.next().unwrap());
    rest.check_invariants();
    rest
}

#[test]
fn planning_anew_with_what_was_learned_comes_to_the_same() {
    let (mut inherited, mut plans, mut together) = (0, 0, 0);
    for seed in 1..=4000 {
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
    assert!(inherited > 5000 && plans > 200 && together > 0, "{inherited} {plans} {together}");
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

/// A task like those of a robot in a small building: rooms in a tree, things that one hand carries, doors that are
/// closed, and sometimes a flag raised in one room.
fn random_errand(seed: u64) -> Task {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let rooms = 3 + random.below(3);
    let things = 1 + random.below(2);
    let mut names: Vec<String> = Vec::new();
    let mut operators: Vec<Operator> = Vec::new();
    let mut fact = |name: String| {
        let known = names.iter().position(|known| *known == name);
        FactId(known.unwrap_or_else(|| {
            names.push(name);
            names.len() - 1
        }) as u32)
    };
    let mut operator = |needs: Vec<FactId>, adds: Vec<FactId>, dels: Vec<FactId>| {
        let sorted = |mut facts: Vec<FactId>| {
            facts.sort_unstable();
            facts.dedup();
            facts
        };
        operators.push(Operator {
            name: format!("o{}", operators.len()).into(),
            args: Vec::new(),
            preconditions: sorted(needs),
            add_effects: sorted(adds),
            del_effects: sorted(dels),
            cost: 1,
        });
    };
    let mut init = vec![fact("hand".into()), fact("in0".into())];
    for room in 1..rooms {
        let other = random.below(room);
        let closed = random.below(3) == 0;
        let (here, there) = (fact(format!("in{room}")), fact(format!("in{other}")));
        for (a, b) in [(here, there), (there, here)] {
            let mut needs = vec![a];
            if closed {
                needs.push(fact(format!("open{room}")));
            }
            operator(needs, vec![b], vec![a]);
            if closed {
                let (open, shut) = (fact(format!("open{room}")), fact(format!("shut{room}")));
                operator(vec![a, shut], vec![open], vec![shut]);
                operator(vec![a, open], vec![shut], vec![open]);
            }
        }
        if closed {
            let state = if random.below(2) == 0 { "open" } else { "shut" };
            init.push(fact(format!("{state}{room}")));
        }
    }
    for thing in 0..things {
        let (hand, held) = (fact("hand".into()), fact(format!("held{thing}")));
        for room in 0..rooms {
            let (here, lies) = (fact(format!("in{room}")), fact(format!("lies{thing}x{room}")));
            operator(vec![here, hand, lies], vec![held], vec![hand, lies]);
            if random.below(4) > 0 {
                operator(vec![here, held], vec![hand, lies], vec![held]);
            }
        }
        init.push(fact(format!("lies{thing}x{}", random.below(rooms))));
    }
    if random.below(2) == 0 {
        let (here, flag) = (fact(format!("in{}", random.below(rooms))), fact("flag".into()));
        let held = fact("held0".into());
        let needs = if random.below(2) == 0 { vec![here] } else { vec![here, held] };
        operator(needs, vec![flag], if random.below(3) == 0 { vec![here] } else { Vec::new() });
    }
    let goal_count = 1 + random.below(2);
    let count = names.len();
    let goal = random.facts(goal_count, count);
    init.sort_unstable();
    init.dedup();
    let facts = names
        .into_iter()
        .map(|name| Fact { predicate: name.into(), args: Vec::new(), negated: false })
        .collect();
    let task = Task { facts, operators, init, goal, assumptions: Vec::new() };
    task.check_invariants();
    task
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
        let reduced = needed::Reduced::of(&task, &Limits::default()).unwrap();
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
        match solve_large(&task, &Limits::default()) {
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
    let places: Vec<String> = (0..6).map(|n| format!("place{n}")).collect();
    let mut names: Vec<String> = places.clone();
    names.extend(["cup at place0", "cup held", "cup at place5", "hand"].map(str::to_owned));
    let fact = |name: &str| {
        FactId(names.iter().position(|own| own == name).expect("a name of the list") as u32)
    };
    let mut operators = Vec::new();
    let mut operator = |needs: Vec<FactId>, adds: Vec<FactId>, deletes: Vec<FactId>| {
        let sorted = |mut facts: Vec<FactId>| {
            facts.sort_unstable();
            facts
        };
        operators.push(Operator {
            name: format!("o{}", operators.len()).into(),
            args: Vec::new(),
            preconditions: sorted(needs),
            add_effects: sorted(adds),
            del_effects: sorted(deletes),
            cost: 1,
        });
    };
    for from in &places {
        for to in places.iter().filter(|to| *to != from) {
            operator(vec![fact(from)], vec![fact(to)], vec![fact(from)]);
        }
    }
    let (hand, held) = (fact("hand"), fact("cup held"));
    for place in ["place0", "place5"] {
        let (here, lies) = (fact(place), fact(&format!("cup at {place}")));
        operator(vec![here, hand, lies], vec![held], vec![hand, lies]);
        operator(vec![here, held], vec![hand, lies], vec![held]);
    }
    let init = vec![fact("place3"), fact("cup at place0"), hand];
    let init = {
        let mut init = init;
        init.sort_unstable();
        init
    };
    let goal = vec![fact("cup at place5")];
    let facts = names
        .iter()
        .map(|name| Fact { predicate: name.as_str().into(), args: Vec::new(), negated: false })
        .collect();
    let task = Task { facts, operators, init, goal, assumptions: Vec::new() };
    task.check_invariants();
    let reduced = needed::Reduced::of(&task, &Limits::default()).unwrap();
    assert_eq!(fewest_steps(&reduced.task), Some(4));
    // From the start to the cup and on: between places 0, 3 and 5 alone, and none of the ways back to the start.
    let left: Vec<String> = reduced.task.facts.iter().map(|f| f.predicate.to_string()).collect();
    assert!(!left.iter().any(|fact| ["place1", "place2", "place4"].contains(&&**fact)), "{left:?}");
}

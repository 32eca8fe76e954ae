//! Small tasks for tests: random ones by a seed, and some by the names of their facts.

use crate::strips::{Fact, FactId, Operator, Task};

/// A small generator with a seed for an argument (xorshift64*).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        ((self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize) % bound
    }

    pub(super) fn facts(&mut self, count: usize, of: usize) -> Vec<FactId> {
        let mut facts: Vec<FactId> = (0..count).map(|_| FactId(self.below(of) as u32)).collect();
        facts.sort_unstable();
        facts.dedup();
        facts
    }
}

/// A task whose facts are told by their names.
#[derive(Default)]
pub(super) struct Named {
    facts: Vec<Fact>,
    operators: Vec<Operator>,
}

impl Named {
    /// The fact of this name, a new one if there was none.
    pub(super) fn fact(&mut self, name: &str) -> FactId {
        let known = self.facts.iter().position(|fact| &*fact.predicate == name);
        FactId(known.unwrap_or_else(|| {
            self.facts.push(Fact { predicate: name.into(), args: Vec::new(), negated: false });
            self.facts.len() - 1
        }) as u32)
    }

    pub(super) fn operator(&mut self, needs: &[FactId], adds: &[FactId], deletes: &[FactId]) {
        let (renewed, del_effects) = sorted(deletes).into_iter().partition(|f| adds.contains(f));
        self.operators.push(Operator {
            name: format!("o{}", self.operators.len()).into(),
            args: Vec::new(),
            preconditions: sorted(needs),
            add_effects: sorted(adds),
            del_effects,
            renewed,
            cost: 1,
        });
    }

    pub(super) fn task(self, init: &[FactId], goal: &[FactId]) -> Task {
        let Self { facts, operators } = self;
        let (init, goal) = (sorted(init), sorted(goal));
        let task = Task { facts, operators, init, goal, ..Task::default() };
        task.check_invariants();
        task
    }

    /// The same of facts whose names are words, the first of them the predicate.
    pub(super) fn task_in_words(self, init: &[FactId], goal: &[FactId]) -> Task {
        let mut task = self.task(init, goal);
        for fact in &mut task.facts {
            let words: Vec<String> = fact.predicate.split(' ').map(str::to_owned).collect();
            fact.predicate = words[0].as_str().into();
            fact.args = words[1..].iter().map(|word| word.as_str().into()).collect();
        }
        task
    }
}

fn sorted(facts: &[FactId]) -> Vec<FactId> {
    let mut facts = facts.to_vec();
    facts.sort_unstable();
    facts.dedup();
    facts
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
            let deleted = if seed.is_multiple_of(2) {
                preconditions.clone()
            } else {
                random.facts(dels, fact_count)
            };
            let (renewed, del_effects) =
                deleted.into_iter().partition(|fact| add_effects.contains(fact));
            Operator {
                name: format!("o{number}").into(),
                args: Vec::new(),
                preconditions,
                add_effects,
                del_effects,
                renewed,
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
        ..Task::default()
    };
    task.check_invariants();
    task
}

/// A task over three objects that the initial state hardly tells apart: actions come in threes.
pub(super) fn random_task_with_objects(seed: u64) -> Task {
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
            let (renewed, del_effects) =
                about(&dels, object).into_iter().partition(|fact| add_effects.contains(fact));
            operators.push(Operator {
                name: format!("o{schema}").into(),
                args: vec![format!("object{object}").into()],
                preconditions: about(&needs, object),
                add_effects,
                del_effects,
                renewed,
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
    let task = Task { facts, operators, init, goal, ..Task::default() };
    task.check_invariants();
    task
}

/// As many wishes as one likes, each granted by using up one of a few tokens.
pub(super) fn wishes(wishes: u32, tokens: u32) -> Task {
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
                renewed: Vec::new(),
                cost: 1,
            })
            .collect(),
        init: (wishes..wishes + tokens).map(FactId).collect(),
        goal: (0..wishes).map(FactId).collect(),
        ..Task::default()
    }
}

/// A task like those of a robot in a small building: rooms in a tree, things that one hand carries, doors that are
/// closed, and sometimes a flag raised in one room.
pub(super) fn random_errand(seed: u64) -> Task {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let rooms = 3 + random.below(3);
    let things = 1 + random.below(2);
    let mut named = Named::default();
    let mut init = vec![named.fact("hand"), named.fact("in0")];
    for room in 1..rooms {
        let other = random.below(room);
        let closed = random.below(3) == 0;
        let (here, there) = (named.fact(&format!("in{room}")), named.fact(&format!("in{other}")));
        for (a, b) in [(here, there), (there, here)] {
            let mut needs = vec![a];
            if closed {
                needs.push(named.fact(&format!("open{room}")));
            }
            named.operator(&needs, &[b], &[a]);
            if closed {
                let (open, shut) =
                    (named.fact(&format!("open{room}")), named.fact(&format!("shut{room}")));
                named.operator(&[a, shut], &[open], &[shut]);
                named.operator(&[a, open], &[shut], &[open]);
            }
        }
        if closed {
            let state = if random.below(2) == 0 { "open" } else { "shut" };
            init.push(named.fact(&format!("{state}{room}")));
        }
    }
    for thing in 0..things {
        let (hand, held) = (named.fact("hand"), named.fact(&format!("held{thing}")));
        for room in 0..rooms {
            let (here, lies) =
                (named.fact(&format!("in{room}")), named.fact(&format!("lies{thing}x{room}")));
            named.operator(&[here, hand, lies], &[held], &[hand, lies]);
            if random.below(4) > 0 {
                named.operator(&[here, held], &[hand, lies], &[held]);
            }
        }
        init.push(named.fact(&format!("lies{thing}x{}", random.below(rooms))));
    }
    if random.below(2) == 0 {
        let (here, flag) = (named.fact(&format!("in{}", random.below(rooms))), named.fact("flag"));
        let held = named.fact("held0");
        let needs = if random.below(2) == 0 { vec![here] } else { vec![here, held] };
        let left = if random.below(3) == 0 { vec![here] } else { Vec::new() };
        named.operator(&needs, &[flag], &left);
    }
    let goal_count = 1 + random.below(2);
    let goal = random.facts(goal_count, named.facts.len());
    named.task(&init, &goal)
}

/// Crates, each in a container of its own, are brought to places of a store by one or two hands; an order that has
/// all its crates is told so for good.
pub(super) fn crates(seed: u64) -> Task {
    let mut random = Random(seed);
    let mut named = Named::default();
    let (crates, places, hands) = (2 + random.below(2), 2 + random.below(2), 1 + random.below(2));
    let (mut init, mut goal) = (Vec::new(), Vec::new());
    for hand in 0..hands {
        init.push(named.fact(&format!("free h{hand}")));
    }
    for place in 0..places {
        init.push(named.fact(&format!("clear p{place}")));
    }
    for item in 0..crates {
        let stored = named.fact(&format!("stored c{item}"));
        let boxed = named.fact(&format!("on c{item} k{item}"));
        init.push(boxed);
        if random.below(5) > 0 {
            goal.push(stored);
        }
        for hand in 0..hands {
            let free = named.fact(&format!("free h{hand}"));
            let held = named.fact(&format!("held h{hand} c{item}"));
            named.operator(&[boxed, free], &[held], &[boxed, free]);
            for place in 0..places {
                let clear = named.fact(&format!("clear p{place}"));
                let lies = named.fact(&format!("on c{item} p{place}"));
                named.operator(&[held, clear], &[lies, free, stored], &[held, clear]);
                named.operator(&[lies, free], &[held, clear], &[lies, free, stored]);
            }
        }
        let (told, untold) =
            (named.fact(&format!("told c{item}")), named.fact(&format!("untold c{item}")));
        init.push(untold);
        named.operator(&[stored, untold], &[told], &[untold]);
        if random.below(3) == 0 {
            goal.push(told);
        }
    }
    named.task_in_words(&init, &goal)
}

/// Blocks that one hand takes up and puts down on others or on the table; some of them are wanted somewhere.
pub(super) fn towers(seed: u64) -> Task {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut named = Named::default();
    let blocks = 3 + random.below(2);
    let free = named.fact("free");
    for block in 0..blocks {
        let [held, clear, table] =
            ["held", "clear", "table"].map(|word| named.fact(&format!("{word} b{block}")));
        named.operator(&[clear, table, free], &[held], &[clear, table, free]);
        named.operator(&[held], &[clear, table, free], &[held]);
        for other in (0..blocks).filter(|&other| other != block) {
            let [below, on] = [format!("clear b{other}"), format!("on b{block} b{other}")]
                .map(|name| named.fact(&name));
            named.operator(&[clear, on, free], &[held, below], &[clear, on, free]);
            named.operator(&[held, below], &[clear, on, free], &[held, below]);
        }
    }
    let mut stacks = |facts: &mut Vec<FactId>, is_goal: bool| {
        let mut tops: Vec<usize> = Vec::new();
        for turn in 0..blocks {
            let block = if is_goal { blocks - 1 - turn } else { turn };
            let below = random.below(tops.len() + 1);
            let place = match tops.get(below).copied() {
                Some(top) => {
                    tops[below] = block;
                    format!("on b{block} b{top}")
                }
                None => {
                    tops.push(block);
                    format!("table b{block}")
                }
            };
            if !is_goal || random.below(3) > 0 {
                facts.push(named.fact(&place));
            }
        }
        if !is_goal {
            let clear = tops.iter().map(|top| named.fact(&format!("clear b{top}")));
            facts.extend(clear.collect::<Vec<_>>());
        }
    };
    let (mut init, mut goal) = (vec![free], Vec::new());
    stacks(&mut init, false);
    stacks(&mut goal, true);
    named.task(&init, &goal)
}

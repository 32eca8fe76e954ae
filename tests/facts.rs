//! The Datalog engine against the obvious slow evaluation, on random programs.

use std::collections::BTreeSet;

use orthoframe_facts::{Because, Database, Derived, Live, Premise, Program, Value, WhyNot};
use orthoframe_units::Source;

use crate::facts_naive::{
    Dice, Facts, Model, Tuple, heights, nearest, random_facts, random_tuple, show,
};

/// The seeds of a test: `count` of them with `ORTHOFRAME_LONG`, else a quarter; from 0, or `ORTHO_SEEDS` of them from
/// `ORTHO_SEED`, for a longer search.
fn seeds(count: u64) -> std::ops::Range<u64> {
    let number = |name: &str| std::env::var(name).ok()?.parse::<u64>().ok();
    let from = number("ORTHO_SEED").unwrap_or(0);
    let usual = if crate::files::long() { count } else { count / 4 };
    from..from + number("ORTHO_SEEDS").unwrap_or(usual)
}

pub(crate) fn parse(model: &Model) -> Program {
    Program::parse(&Source::new("random.dl", model.to_string()))
        .unwrap_or_else(|faults| panic!("{model}\n{faults}"))
}

pub(crate) fn values(tuple: &Tuple) -> Vec<Value> {
    tuple.iter().copied().map(Value::Number).collect()
}

pub(crate) fn database(program: &Program, facts: &Facts) -> Database {
    let mut database = program.database();
    for (name, tuples) in facts {
        for tuple in tuples {
            database
                .insert(name.as_str(), &values(tuple))
                .expect("random facts fit their relations");
        }
    }
    database
}

pub(crate) fn tuples(derived: &Derived, model: &Model) -> Facts {
    let of = |name: &String| -> BTreeSet<Tuple> {
        let tuples = derived.tuples(name.as_str()).expect("the relation is declared");
        tuples
            .map(|t| {
                (0..t.arity()).map(|n| t.number(n).expect("all columns are numbers")).collect()
            })
            .collect()
    };
    model.relations.iter().map(|(name, ..)| (name.clone(), of(name))).collect()
}

#[test]
fn random_programs_derive_what_trying_everything_derives() {
    for seed in seeds(1500) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let program = parse(&model);
        let facts = random_facts(&model, &mut dice);
        let derived =
            program.evaluate(&database(&program, &facts)).expect("random programs are finite");
        let (found, expected) = (tuples(&derived, &model), model.evaluate(&facts));
        assert!(
            found == expected,
            "seed {seed}\n{model}\nfound\n{}expected\n{}",
            show(&found),
            show(&expected)
        );
    }
}

#[test]
fn every_derived_tuple_has_a_proof_of_least_height() {
    for seed in seeds(250) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let program = parse(&model);
        let facts = random_facts(&model, &mut dice);
        let derived =
            program.evaluate(&database(&program, &facts)).expect("random programs are finite");
        let expected = heights(&model, &facts, &tuples(&derived, &model));
        let mut explainer = derived.explain();
        for ((name, tuple), height) in &expected {
            let proof =
                explainer.why(name.as_str(), &values(tuple)).unwrap().expect("the tuple holds");
            assert_eq!(
                proof.steps[0].height, *height,
                "seed {seed}: {name}{tuple:?}\n{model}\n{proof}"
            );
            for step in &proof.steps {
                let Because::Rule { premises, .. } = &step.because else {
                    assert_eq!(step.height, 0, "{proof}");
                    continue;
                };
                let of = |p: &Premise| {
                    if let Premise::Fact(n) = p { Some(proof.steps[*n].height) } else { None }
                };
                let highest = premises.iter().filter_map(of).max().unwrap_or(0);
                assert_eq!(step.height, highest + 1, "seed {seed}\n{proof}");
            }
        }
    }
}

#[test]
fn every_missing_tuple_has_a_failed_premise() {
    for seed in seeds(250) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let program = parse(&model);
        let facts = random_facts(&model, &mut dice);
        let derived =
            program.evaluate(&database(&program, &facts)).expect("random programs are finite");
        let found = tuples(&derived, &model);
        let mut explainer = derived.explain();
        for (name, columns, group) in &model.relations {
            let tuple = random_tuple(*columns, &mut dice);
            match explainer.why_not(name.as_str(), &values(&tuple)).unwrap() {
                WhyNot::Holds => assert!(found[name].contains(&tuple)),
                WhyNot::NotTold => assert!(*group == 0 && !found[name].contains(&tuple)),
                WhyNot::Nearest(rule) => {
                    assert!(!found[name].contains(&tuple), "seed {seed}: {name}{tuple:?}\n{model}");
                    assert!(
                        rule.failed().next().is_some(),
                        "seed {seed}: {name}{tuple:?}\n{model}\n{rule:?}"
                    );
                    let failed = rule.premises.iter().filter(|p| p.1 != Some(true)).count();
                    let least = nearest(&model, name, &tuple, &found);
                    assert!(
                        least.is_none_or(|least| failed <= least),
                        "seed {seed}: {name}{tuple:?}, {failed} failed where {least:?} would\n{model}\n{rule}\n{}",
                        show(&found)
                    );
                }
            }
        }
    }
}

#[test]
fn edits_lead_where_a_fresh_evaluation_leads() {
    for seed in seeds(500) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let program = parse(&model);
        let mut facts = random_facts(&model, &mut dice);
        let mut live = Live::new(program.clone(), database(&program, &facts))
            .expect("random programs are finite");
        let inputs = model.input_names();
        for _ in 0..6 {
            let before = tuples(live.derived(), &model);
            for _ in 0..1 + dice.roll(3) {
                let (name, columns) = &inputs[dice.roll(inputs.len())];
                let tuple = random_tuple(*columns, &mut dice);
                let known = facts.get_mut(name).expect("inputs are there");
                let present = known.iter().nth(dice.roll(known.len().max(1))).cloned();
                match present {
                    Some(tuple) if dice.one_in(2) => {
                        assert_eq!(
                            live.remove(name.as_str(), &values(&tuple)),
                            Ok(known.remove(&tuple))
                        );
                    }
                    _ => assert_eq!(
                        live.insert(name.as_str(), &values(&tuple)),
                        Ok(known.insert(tuple))
                    ),
                }
            }
            let changed = live.update().expect("random programs are finite");
            let (found, expected) = (tuples(live.derived(), &model), model.evaluate(&facts));
            assert!(
                found == expected,
                "seed {seed}\n{model}\nfound\n{}expected\n{}",
                show(&found),
                show(&expected)
            );
            for (name, ..) in &model.relations {
                let id = program.relation(name).expect("declared");
                assert_eq!(
                    changed.contains(&id),
                    before[name] != found[name],
                    "seed {seed}: {name}\n{model}"
                );
            }
        }
    }
}

const CLOSURE: &str = "
.decl edge(a: number, b: number) .input edge
.decl node(a: number)
.decl path(a: number, b: number) .output path
.decl apart(a: number, b: number) .output apart
.decl reach(a: number, n: number) .output reach
node(A), node(B) :- edge(A, B).
path(A, B) :- edge(A, B).
path(A, C) :- path(A, B), path(B, C).
apart(A, B) :- node(A), node(B), !path(A, B), !path(B, A).
reach(A, N) :- node(A), N = count : { path(A, _) }.
";

/// Tuples that only one of two results has.
fn differences(one: &Derived, other: &Derived) -> Vec<String> {
    let mut found = Vec::new();
    for name in ["path", "apart", "reach"] {
        let [one, other] = [one, other]
            .map(|derived| derived.sorted(name).unwrap().into_iter().collect::<BTreeSet<_>>());
        found.extend(one.symmetric_difference(&other).map(|tuple| {
            format!("{} {name}{tuple:?}", if one.contains(tuple) { "+" } else { "-" })
        }));
    }
    found
}

/// Large enough that some edits take a good part of the closure with them, which is then evaluated anew.
#[test]
fn edits_of_a_dense_graph_lead_where_a_fresh_evaluation_leads() {
    let program = Program::parse(&Source::new("closure.dl", CLOSURE)).unwrap();
    let mut dice = Dice::new(11);
    let mut facts = program.database();
    for n in 0..40 {
        facts.insert("edge", &[n.into(), (n + 1).into()]).unwrap();
    }
    let mut live = Live::new(program.clone(), facts).unwrap();
    for step in 0..60 {
        let edge: [Value; 2] = [(dice.roll(45) as i64).into(), (dice.roll(45) as i64).into()];
        let is_there = live.database().contains("edge", &edge).unwrap();
        if is_there || dice.one_in(2) {
            live.remove("edge", &edge).unwrap();
            // One of the chain's edges: everything across it falls, unless another way holds it.
            let n = dice.roll(40) as i64;
            live.remove("edge", &[n.into(), (n + 1).into()]).unwrap();
        } else {
            live.insert("edge", &edge).unwrap();
            let n = dice.roll(40) as i64;
            live.insert("edge", &[n.into(), (n + 1).into()]).unwrap();
        }
        let before: Vec<Vec<Value>> = live.derived().sorted("path").unwrap();
        live.update().unwrap();
        let fresh = program.evaluate(live.database()).unwrap();
        assert_eq!(differences(live.derived(), &fresh), Vec::<String>::new(), "step {step}");
        // What the update says it changed is what changed.
        let path = program.relation("path").unwrap();
        let mut after: BTreeSet<Vec<Value>> = before.into_iter().collect();
        for tuple in live.removed(path) {
            assert!(after.remove(&tuple.values()));
        }
        for tuple in live.added(path) {
            assert!(after.insert(tuple.values()));
        }
        assert_eq!(after.into_iter().collect::<Vec<_>>(), live.derived().sorted("path").unwrap());
    }
}

/// Symbols and large numbers that updates bring keep their meaning through any number of them.
#[test]
fn new_words_come_with_updates() {
    let rules = r#"
        .decl at(thing: symbol, room: symbol, far: number) .input at
        .decl label(thing: symbol, text: symbol, far: number) .output label
        label(T, cat(T, "@", R), F * 3000000000) :- at(T, R, F), !at(T, "нигде", _)."#;
    let program = Program::parse(&Source::new("words.dl", rules)).unwrap();
    let mut live = Live::new(program.clone(), program.database()).unwrap();
    for n in 0..200_i64 {
        let at = |n: i64| -> [Value; 3] {
            [
                format!("вещь-{n}").into(),
                format!("комната-{}", n / 3).into(),
                (n * 7_000_000_000).into(),
            ]
        };
        live.insert("at", &at(n)).unwrap();
        if n % 5 == 4 {
            live.remove("at", &at(n - 3)).unwrap();
        }
        live.update().unwrap();
        let label: [Value; 3] = [
            format!("вещь-{n}").into(),
            format!("вещь-{n}@комната-{}", n / 3).into(),
            (n * 7_000_000_000).checked_mul(3_000_000_000).unwrap_or(0).into(),
        ];
        let fits = (n * 7_000_000_000).checked_mul(3_000_000_000).is_some();
        assert_eq!(live.derived().contains("label", &label), Ok(fits));
    }
    let fresh = program.evaluate(live.database()).unwrap();
    assert_eq!(live.derived().sorted("label"), fresh.sorted("label"));
}

//! The Datalog engine against the obvious slow evaluation, on random programs.

use std::collections::BTreeSet;

use orthoframe::facts::{Because, Database, Derived, Live, Premise, Program, Value, WhyNot};
use orthoframe::units::Source;

use crate::facts_naive::{Dice, Facts, Model, Tuple, heights, random_facts, random_tuple, show};

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
    for seed in 0..1500 {
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
    for seed in 0..250 {
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
    for seed in 0..250 {
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
                }
            }
        }
    }
}

#[test]
fn edits_lead_where_a_fresh_evaluation_leads() {
    for seed in 0..300 {
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

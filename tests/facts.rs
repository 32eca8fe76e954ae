//! The Datalog engine against the obvious slow evaluation, on random programs.

use std::collections::BTreeSet;

use orthoframe::facts::{Database, Derived, Program, Value};
use orthoframe::units::Source;

use crate::facts_naive::{Dice, Facts, Model, Tuple, random_facts, show};

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

//! Joins divided among threads against one thread: the same rows in the same order, the same proofs and notes.

use std::time::Duration;

use super::facts_naive::{Dice, Model, random_facts};
use orthoframe_facts::{Database, EvaluateError, Limits, Program, Value};
use orthoframe_units::Source;

/// So many threads for the smallest join.
fn threads(threads: usize) -> Limits {
    Limits { threads, spread_from: Duration::ZERO, ..Limits::default() }
}

/// All rows of all relations in their order, proofs of some, and what is noted.
fn told(program: &Program, database: &Database, limits: Limits) -> String {
    let derived = program.evaluate_within(database, limits).expect("random programs are finite");
    let (mut told, mut explainer) = (String::new(), derived.explain());
    for (relation, info) in program.relations() {
        for (n, tuple) in derived.tuples(relation).expect("it is declared").enumerate() {
            let values = tuple.values();
            told += &format!("{}{values:?}\n", info.name);
            if n % 7 == 0 {
                let proof = explainer.why(relation, &values).expect("it is declared");
                told += &format!("{}\n", proof.expect("the row holds"));
            }
        }
    }
    told + &format!("{:?}", derived.notes())
}

fn check(seed: u64, program: &Program, database: &Database, text: &str) {
    let alone = told(program, database, threads(1));
    for more in [2, 3] {
        let found = told(program, database, threads(more));
        assert!(found == alone, "seed {seed}, {more} threads\n{text}\n{alone}\n---\n{found}");
    }
}

#[test]
fn random_programs_come_out_as_in_one_thread() {
    for seed in 0..1500 {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let facts = random_facts(&model, &mut dice);
        let program = Program::parse(&Source::new("random.dl", model.to_string()))
            .unwrap_or_else(|faults| panic!("{model}\n{faults}"));
        let mut database = program.database();
        for (name, tuples) in &facts {
            for tuple in tuples {
                let values: Vec<Value> = tuple.iter().copied().map(Value::Number).collect();
                database.insert(name.as_str(), &values).expect("random facts fit");
            }
        }
        check(seed, &program, &database, &model.to_string());
    }
}

/// Rules whose values are beyond what a word holds in place, and rules in which an order could show.
const RULES: &[&str] = &[
    ".decl big(a: number, b: number) big(X, X * 3000000007 + Y) :- e(X, Y).",
    ".decl big(a: number, b: number) big(X, Y) :- e(X, A), e(A, B), Y = A * B * 1000000007.",
    ".decl sums(a: number, s: number) sums(X, S) :- e(X, _), S = sum (B * 2000000011) : { e(X, B) }.",
    ".decl far(a: number, b: number) far(X, Y + 5000000000) :- e(X, Y). far(X, Z) :- far(X, Y), e(X, A), Z = Y * 3 + A, Z < 90000000000.",
    ".decl low(a: number, b: number) low(X, X * Y - 7000000000) :- e(X, Y). low(Y, M) :- e(X, Y), low(X, M).",
    ".decl path(a: number, b: number) path(X, Y) :- e(X, Y). path(X, Z) :- path(X, Y), e(Y, Z).",
    ".decl path(a: number, b: number) path(X, Y) :- e(X, Y). path(X, Z) :- path(X, Y), path(Y, Z).",
    ".decl back(a: number, b: number) back(X, Y) :- e(X, Y). back(X, Z) :- e(X, Y), back(Y, Z).",
    ".decl colour(a: number, b: number, c: number) colour(X, Y, 0) :- e(X, Y). colour(X, Z, C) :- colour(X, Y, C), e(Z, Y). colour(X, Y, 1) :- e(Y, X).",
    ".decl steps(a: number, b: number, n: number) steps(X, Y, 1) :- e(X, Y). steps(X, Z, N + 1) :- steps(X, Y, N), e(Y, Z), N < 4.",
    ".decl text(a: symbol, b: number) text(cat(to_string(X), \"-\"), Y) :- e(X, Y).",
    ".decl words(a: symbol) words(\"a\"). words(cat(A, to_string(X % 3))) :- words(A), e(X, _), strlen(A) < 4.",
    ".type P = [a: number, b: number] .decl pair(p: P) pair([X, Y]) :- e(X, Y). pair([X, Z]) :- pair([X, Y]), e(Y, Z).",
    ".decl turned(a: number, b: number) choice-domain a turned(Y, X) :- e(X, Y).",
    ".decl best(a: number, b: number) best(X, Y) :- e(X, Y). best(X, Z) :- best(X, Y), e(Y, Z). best(x, a) <= best(x, b) :- a < b.",
    ".decl number(a: number, b: number) number(autoinc(), X) :- e(X, _).",
    ".decl few(a: number) .limitsize few(n=5) few(X) :- e(X, _). few(X + 1) :- few(X), X < 60.",
    ".decl each(a: number, b: number) each(X, R) :- e(X, _), R = range(X, X + 4).",
    ".decl tens(a: float, b: float) tens(to_float(X) / 3.0, to_float(Y) * 70000000.5) :- e(X, Y).",
    ".decl none(a: number) none(X) :- e(X, _), !e(_, X).",
    ".decl most(a: number, b: number) most(X, M) :- e(X, _), M = max A * 900000001 : { e(A, X) }.",
    ".decl any(a: number) any(X) :- e(X, Y), e(Y, _), X + 4000000000 * Y > 9000000000.",
];

#[test]
fn values_that_must_be_named_are_named_in_the_same_order() {
    for seed in 0..1000 {
        let mut dice = Dice::new(seed + 77);
        let mut text = ".decl e(a: number, b: number)\n".to_owned();
        let (nodes, edges) = (2 + dice.roll(20), 1 + dice.roll(40));
        for _ in 0..edges {
            text += &format!("e({}, {}). ", dice.roll(nodes), dice.roll(nodes));
        }
        let mut declared = Vec::new();
        for _ in 0..1 + dice.roll(5) {
            let rule = RULES[dice.roll(RULES.len())];
            let name = rule.split(".decl ").nth(1).and_then(|rest| rest.split('(').next());
            if !declared.contains(&name) {
                declared.push(name);
                text += &format!("\n{rule}");
            }
        }
        let program = Program::parse(&Source::new("random.dl", text.as_str()))
            .unwrap_or_else(|faults| panic!("{text}\n{faults}"));
        check(seed, &program, &program.database(), &text);
    }
}

/// A closure dense enough to be kept as bits, whose new pairs threads find in any order.
#[test]
fn dense_relations_come_out_as_in_one_thread() {
    let rules = "
        .decl e(a: number, b: number) .input e
        .decl path(a: number, b: number)
        .decl both(a: number, b: number)
        .decl back(a: number, b: number)
        .decl more(a: number, b: number)
        back(X, Y) :- e(X, Y).
        back(X, Z) :- e(X, Y), back(Y, Z).
        path(X, Y) :- e(X, Y).
        path(X, Z) :- path(X, Y), e(Y, Z).
        both(X, Y) :- e(X, Y).
        both(X, Z) :- both(X, Y), both(Y, Z).
        more(X, Y) :- e(X, Y).
        more(X, Z) :- more(X, Y), e(Y, A), Z = (A * 7 + 5000000000) % 300 + 4999999900, Z % 2 = 0.
        more(X, Z) :- more(X, Y), e(Y, Z).";
    let program = Program::parse(&Source::new("dense.dl", rules)).unwrap();
    for seed in 0..12 {
        let mut dice = Dice::new(seed);
        let mut facts = program.database();
        for _ in 0..400 {
            let (a, b) = (dice.roll(120) as i64, dice.roll(120) as i64);
            facts.insert("e", &[a.into(), b.into()]).unwrap();
        }
        let rows = |limits: Limits| -> Vec<Vec<Vec<Value>>> {
            let derived = program.evaluate_within(&facts, limits).unwrap();
            let all = ["path", "both", "more", "back"].map(|name| derived.tuples(name).unwrap());
            all.into_iter().map(|rows| rows.map(|row| row.values()).collect()).collect()
        };
        let alone = rows(threads(1));
        assert!(alone[1].len() > 5000);
        for more in [2, 3, 8] {
            assert!(rows(threads(more)) == alone, "seed {seed}, {more} threads");
        }
    }
}

#[test]
fn limits_hold_for_all_threads_together() {
    let rules = ".decl n(x: number) .decl all(x: number, y: number, z: number)
        n(X) :- X = range(0, 400).
        all(X, Y, Z) :- n(X), n(Y), n(Z).";
    let program = Program::parse(&Source::new("all.dl", rules)).unwrap();
    let database = program.database();
    for more in [1, 2, 3] {
        let little = Limits { memory_bytes: 20 << 20, ..threads(more) };
        let error = program.evaluate_within(&database, little).unwrap_err();
        assert!(matches!(error, EvaluateError::Memory { .. }), "{error}");
        let short = Limits { time: Duration::from_millis(5), ..threads(more) };
        let error = program.evaluate_within(&database, short).unwrap_err();
        assert!(matches!(error, EvaluateError::Time { .. }), "{error}");
    }
    let rules = ".decl e(x: number, y: number) .decl path(x: number, y: number)
        e(X, X + 1) :- X = range(0, 3000).
        path(X, Y) :- e(X, Y).
        path(X, Z) :- path(X, Y), e(Y, Z).";
    let chain = Program::parse(&Source::new("chain.dl", rules)).unwrap();
    for more in [1, 2, 3] {
        let few = Limits { rows: 100_000, ..threads(more) };
        let error = chain.evaluate_within(&chain.database(), few).unwrap_err();
        assert!(matches!(error, EvaluateError::TooMany { .. }), "{error}");
        let short = Limits { time: Duration::from_millis(20), ..threads(more) };
        let error = chain.evaluate_within(&chain.database(), short).unwrap_err();
        assert!(matches!(error, EvaluateError::Time { .. }), "{error}");
        let little = Limits { memory_bytes: 8 << 20, ..threads(more) };
        let error = chain.evaluate_within(&chain.database(), little).unwrap_err();
        assert!(matches!(error, EvaluateError::Memory { .. }), "{error}");
    }
}

/// A row limit counts rows, not how often they are found; what is said of a limit names the rule and how far it came.
#[test]
fn a_row_limit_counts_rows_and_faults_say_how_far_they_came() {
    // Each pair of 60 is found in several rounds and by both rules.
    let rules = ".decl e(x: number, y: number) .decl path(x: number, y: number)
        e(X, (X * 7 + D) % 60) :- X = range(0, 60), D = range(0, 4).
        path(X, Y) :- e(X, Y).
        path(X, Z) :- path(X, Y), path(Y, Z).
        path(X, Z) :- path(X, Y), e(Y, Z).";
    let dense = Program::parse(&Source::new("dense.dl", rules)).unwrap();
    for more in [1, 2] {
        let enough = Limits { rows: 3600, ..threads(more) };
        let derived = dense.evaluate_within(&dense.database(), enough).unwrap();
        assert_eq!(derived.len("path"), Ok(3600));
        let few = Limits { rows: 3599, ..threads(more) };
        let error = dense.evaluate_within(&dense.database(), few).unwrap_err().to_string();
        assert!(error.starts_with("dense.dl:") && error.contains("3599"), "{error}");
    }
    let rules = ".decl n(x: number)
        n(1).
        n(X + 1) :- n(X).";
    let endless = Program::parse(&Source::new("endless.dl", rules)).unwrap();
    let few = Limits { rows: 1000, ..threads(1) };
    let error = endless.evaluate_within(&endless.database(), few).unwrap_err().to_string();
    assert!(error.starts_with("endless.dl:3:"), "{error}");
    let short = Limits { time: Duration::from_millis(100), ..threads(1) };
    let error = endless.evaluate_within(&endless.database(), short).unwrap_err();
    assert!(matches!(error, EvaluateError::Time { rows, .. } if rows > 100), "{error:?}");
    let little = Limits { memory_bytes: 1 << 20, ..threads(1) };
    let error = endless.evaluate_within(&endless.database(), little).unwrap_err();
    assert!(matches!(error, EvaluateError::Memory { rows, .. } if rows > 100), "{error:?}");
}

/// Strata that read nothing of each other run beside one another; of those that reach a limit of their own, the first in
/// order is named, as by one thread.
#[test]
fn limits_hold_for_strata_that_run_at_the_same_time() {
    let rules = ".decl e(x: number)
        e(X) :- X = range(0, 80).
        .decl few(x: number) few(X + 1) :- e(X).
        .decl one(x: number, y: number) one(X, Y) :- e(X), e(Y).
        .decl two(x: number, y: number) two(X, Y) :- e(Y), e(X), X < Y.
        .decl all(x: number, y: number, z: number) all(X, Y, Z) :- e(X), e(Y), e(Z).
        .decl end(x: number) end(X) :- few(X). end(X + 1) :- end(X).";
    let program = Program::parse(&Source::new("beside.dl", rules)).unwrap();
    let database = program.database();
    let few = |more| Limits { rows: 2000, ..threads(more) };
    let first = program.evaluate_within(&database, few(1)).unwrap_err();
    assert!(matches!(first, EvaluateError::TooMany { .. }), "{first}");
    for more in [1, 2, 3] {
        for _ in 0..4 {
            assert_eq!(program.evaluate_within(&database, few(more)).unwrap_err(), first);
        }
        let little = Limits { memory_bytes: 2 << 20, ..threads(more) };
        let error = program.evaluate_within(&database, little).unwrap_err();
        assert!(matches!(error, EvaluateError::Memory { .. }), "{error}");
        let short = Limits { time: Duration::from_millis(5), ..threads(more) };
        let error = program.evaluate_within(&database, short).unwrap_err();
        assert!(matches!(error, EvaluateError::Time { .. }), "{error}");
    }
}

/// More solutions than a relation may have rows, most of them the same: none is left out.
#[test]
fn solutions_are_not_rows() {
    let rules = ".decl n(x: number) .decl p(x: number, y: number)
        n(X) :- X = range(0, 520).
        p(X, Y) :- n(X), n(Y), X < Y.
        p(X, Z) :- p(X, Y), p(Y, Z), Z > 3.
        p(X, X) :- p(X, Y), p(Y, Z), p(Z, _), X = 519 - Z.";
    let program = Program::parse(&Source::new("many.dl", rules)).unwrap();
    assert!(program.evaluate(&program.database()).unwrap().len("p").unwrap() > 134_940);
}

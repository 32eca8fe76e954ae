//! Questions on demand against full evaluation and against trying everything, on random programs.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::time::Duration;

use super::facts_naive::{self, Dice, Facts, Model, Rule, Tuple, random_facts};
use miette::Diagnostic as _;
use orthoframe_facts::{
    Answers, AskError, Because, Computed, Database, EvaluateError, Limits, Live, Program, Value,
};
use orthoframe_units::{Source, Stop};

/// The seeds of a test: `count` of them with `ORTHOFRAME_LONG`, else a quarter; from 0, or `ORTHO_SEEDS` of them from
/// `ORTHO_SEED`, for a longer search.
pub(crate) fn seeds(count: u64) -> std::ops::Range<u64> {
    let number = |name: &str| std::env::var(name).ok()?.parse::<u64>().ok();
    let from = number("ORTHO_SEED").unwrap_or(0);
    let usual = if std::env::var_os("ORTHOFRAME_LONG").is_some() { count } else { count / 4 };
    from..from + number("ORTHO_SEEDS").unwrap_or(usual)
}

fn parse(model: &Model) -> Program {
    Program::parse(&Source::new("random.dl", model.to_string()))
        .unwrap_or_else(|faults| panic!("{model}\n{faults}"))
}

fn values(tuple: &Tuple) -> Vec<Value> {
    tuple.iter().copied().map(Value::Number).collect()
}

fn database(program: &Program, facts: &Facts) -> Database {
    let mut database = program.database();
    for (name, tuples) in facts {
        for tuple in tuples {
            database.insert(name.as_str(), &values(tuple)).expect("random facts fit");
        }
    }
    database
}

/// What full evaluation finds, the question being a rule of the program.
fn expected(model: &Model, question: &Rule, facts: &Facts) -> Vec<Vec<Value>> {
    let whole = parse(&model.with_question(question));
    let derived = whole.evaluate(&database(&whole, facts)).expect("random programs are finite");
    derived.sorted("q").expect("it is declared")
}

fn rows(answers: Result<Answers<'_>, AskError>, told: &str) -> Vec<Vec<Value>> {
    match answers {
        Ok(answers) => answers.rows().to_vec(),
        Err(error) => panic!("{told}\n{error}"),
    }
}

#[test]
fn answers_are_what_full_evaluation_finds() {
    for seed in seeds(2000) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let facts = random_facts(&model, &mut dice);
        let program = parse(&model);
        let database = database(&program, &facts);
        let derived = program.evaluate(&database).expect("random programs are finite");
        let rule = model.random_question(&mut dice);
        let question = Source::new("?", format!("?- {rule}."));
        let expected = expected(&model, &rule, &facts);
        let told = format!("seed {seed}: {rule}\n{model}");
        assert_eq!(rows(program.ask(&database, &question), &told), expected, "{told}");
        assert_eq!(rows(derived.ask(&question), &told), expected, "{told}");
    }
}

#[test]
fn answers_are_what_trying_everything_finds() {
    for seed in seeds(150) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let facts = random_facts(&model, &mut dice);
        let finished = model.evaluate(&facts);
        let program = parse(&model);
        let rule = model.random_question(&mut dice);
        let found: BTreeSet<Tuple> =
            rule.consequences(&finished, &finished).into_iter().map(|(_, tuple)| tuple).collect();
        let expected: Vec<Vec<Value>> = found.iter().map(values).collect();
        let question = Source::new("?", format!("?- {rule}."));
        let told = format!("seed {seed}: {rule}\n{model}");
        let answers = program.ask(&database(&program, &facts), &question);
        assert_eq!(rows(answers, &told), expected, "{told}");
    }
}

/// The relations of the upper groups are the question's own.
#[test]
fn a_question_may_bring_rules_of_its_own() {
    for seed in seeds(1000) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let facts = random_facts(&model, &mut dice);
        let rule = model.random_question(&mut dice);
        let last = model.relations.iter().map(|r| r.2).max().unwrap_or(0);
        let (lower, rest) = model.split(dice.roll(last + 1));
        let program = parse(&lower);
        let database = database(&program, &facts);
        let question = Source::new("?", format!("{rest}?- {rule}"));
        let expected = expected(&model, &rule, &facts);
        let answers = program.ask(&database, &question);
        let answers =
            answers.unwrap_or_else(|error| panic!("seed {seed}: {error}\n{lower}\n{rest}"));
        assert_eq!(answers.rows(), expected, "seed {seed}: {rule}\n{model}");
        let derived = program.evaluate(&database).expect("random programs are finite");
        let answers = derived.ask(&question).expect("it was sound before");
        assert_eq!(answers.rows(), expected, "seed {seed}: {rule}\n{model}");
    }
}

#[test]
fn proofs_of_answers_are_as_low_as_those_of_full_evaluation() {
    for seed in seeds(200) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let facts = random_facts(&model, &mut dice);
        let rule = model.random_question(&mut dice);
        let (program, whole) = (parse(&model), parse(&model.with_question(&rule)));
        let database = database(&program, &facts);
        let question = Source::new("?", format!("?- {rule}."));
        let derived = program.evaluate(&database).expect("random programs are finite");
        let on_demand = program.ask(&database, &question).expect("it is sound");
        let over_result = derived.ask(&question).expect("it is sound");
        let full = whole.evaluate(&self::database(&whole, &facts)).expect("it is finite");
        for (n, row) in on_demand.rows().iter().enumerate().take(6) {
            let expected = full.why("q", row).unwrap().expect("the answer holds");
            for answers in [&on_demand, &over_result] {
                let proof = answers.why(n).expect("no limit").expect("there is such an answer");
                assert_eq!(proof.steps[0].fact.values, *row);
                assert!(matches!(proof.steps[0].because, Because::Rule { .. }), "{proof}");
                assert_eq!(
                    proof.steps[0].height, expected.steps[0].height,
                    "seed {seed}: {rule}\n{model}\n{proof}\n{expected}"
                );
            }
        }
    }
}

#[test]
fn questions_follow_edits() {
    for seed in seeds(80) {
        let mut dice = Dice::new(seed);
        let model = Model::random(&mut dice);
        let mut facts = random_facts(&model, &mut dice);
        let program = parse(&model);
        // Beside a result that follows, the facts alone, which keep what earlier questions made ready.
        let mut alone = database(&program, &facts);
        let mut live = Live::new(program.clone(), alone.clone()).unwrap();
        let questions: Vec<Rule> = (0..3).map(|_| model.random_question(&mut dice)).collect();
        let inputs = model.input_names();
        for _ in 0..6 {
            for rule in &questions {
                let question = Source::new("?", format!("?- {rule}"));
                let answers = live.derived().ask(&question).expect("it is sound");
                let expected = expected(&model, rule, &facts);
                assert_eq!(answers.rows(), expected, "seed {seed}: {rule}\n{model}");
                let answers = program.ask(&alone, &question).expect("it is sound");
                assert_eq!(answers.rows(), expected, "seed {seed}: {rule}\n{model}");
            }
            let (name, columns) = &inputs[dice.roll(inputs.len())];
            let tuple = facts_naive::random_tuple(*columns, &mut dice);
            let known = facts.get_mut(name).expect("inputs are there");
            if known.remove(&tuple) {
                live.remove(name.as_str(), &values(&tuple)).unwrap();
                alone.remove(name.as_str(), &values(&tuple)).unwrap();
            } else {
                live.insert(name.as_str(), &values(&tuple)).unwrap();
                alone.insert(name.as_str(), &values(&tuple)).unwrap();
                known.insert(tuple);
            }
            live.update().expect("random programs are finite");
        }
    }
}

/// Large enough that calls are answered one by one at first and all at once in the end, in all kinds of premises.
#[test]
fn many_calls_are_answered_as_few_are() {
    let rules = "
        .decl edge(a: number, b: number) .input edge
        .decl node(a: number) .output node
        .decl path(a: number, b: number) .output path
        .decl far(a: number, b: number) .output far
        .decl reach(a: number, n: number) .output reach
        .decl dead(a: number) .output dead
        node(A), node(B) :- edge(A, B).
        path(A, B) :- edge(A, B).
        path(A, C) :- path(A, B), edge(B, C).
        far(A, C) :- edge(A, B), path(B, C), !edge(A, C).
        reach(A, N) :- node(A), N = count : { path(A, _) }.
        dead(A) :- node(A), !path(A, _).";
    let program = Program::parse(&Source::new("r.dl", rules)).unwrap();
    let mut facts = program.database();
    let mut dice = Dice::new(5);
    for _ in 0..500 {
        let (a, b) = (dice.roll(300) as i64, dice.roll(300) as i64);
        facts.insert("edge", &[a.into(), b.into()]).unwrap();
    }
    let derived = program.evaluate(&facts).unwrap();
    for (body, relation) in [
        ("node(A), path(A, C)", "path"),
        ("node(A), node(C), path(A, C)", "path"),
        ("node(C), path(A, C)", "path"),
        ("node(A), far(A, C)", "far"),
        ("node(C), far(A, C)", "far"),
        ("node(A), reach(A, C)", "reach"),
        ("node(A), C = count : { path(A, _) }", "reach"),
        ("path(A, C)", "path"),
    ] {
        let question = Source::new("?", format!("q(A, C) :- {body}"));
        let expected = derived.sorted(relation).unwrap();
        assert_eq!(rows(program.ask(&facts, &question), body), expected, "{body}");
    }
    let dead = Source::new("?", "?- node(A), !path(A, _)");
    assert_eq!(rows(program.ask(&facts, &dead), "dead"), derived.sorted("dead").unwrap());
    // Of these calls only this is asked: whether they have rows.
    let sources: BTreeSet<Value> =
        derived.sorted("far").unwrap().into_iter().map(|mut row| row.swap_remove(0)).collect();
    for (body, is_source) in [("far(A, _)", true), ("!far(A, _)", false)] {
        let question = Source::new("?", format!("?- node(A), {body}"));
        let nodes = derived.sorted("node").unwrap();
        let expected: Vec<Vec<Value>> =
            nodes.into_iter().filter(|row| sources.contains(&row[0]) == is_source).collect();
        assert_eq!(rows(program.ask(&facts, &question), body), expected, "{body}");
    }
}

/// `plus(a, b, c)`: any two of three numbers tell the third, and each use is counted.
struct Sum {
    declaration: Source,
    asked: std::cell::Cell<usize>,
}

impl Computed for Sum {
    fn declaration(&self) -> &Source {
        &self.declaration
    }

    fn ways(&self) -> &[(u32, f64)] {
        &[(0b011, 1.0), (0b101, 1.0), (0b110, 1.0)]
    }

    fn rows(&self, known: &[Option<Value>], tell: &mut dyn FnMut(&[Value])) {
        self.asked.set(self.asked.get() + 1);
        let number = |n: usize| match known[n] {
            Some(Value::Number(number)) => Some(number),
            _ => None,
        };
        let row = match (number(0), number(1), number(2)) {
            (Some(a), Some(b), _) => [a, b, a + b],
            (Some(a), None, Some(c)) => [a, c - a, c],
            (None, Some(b), Some(c)) => [c - b, b, c],
            _ => panic!("asked in a way that it does not offer"),
        };
        tell(&row.map(Value::Number));
    }
}

fn sum() -> Sum {
    let declaration = Source::new("sum", ".decl plus(a: number, b: number, c: number) = СУММА");
    Sum { declaration, asked: std::cell::Cell::new(0) }
}

const NUMBERS: &str = ".decl n(x: number) .output n n(1). n(2). n(3). n(4). n(7).";

fn numbers(answers: &Answers<'_>) -> Vec<Vec<i64>> {
    let number = |value: &Value| match value {
        Value::Number(number) => *number,
        _ => panic!("a number is wanted"),
    };
    answers.rows().iter().map(|row| row.iter().map(number).collect()).collect()
}

#[test]
fn computed_relations_stand_in_every_kind_of_premise() {
    let program = Program::parse(&Source::new("n.dl", NUMBERS)).unwrap();
    let facts = program.database();
    let derived = program.evaluate(&facts).unwrap();
    for (question, expected) in [
        (
            "?- n(X), n(Y), n(Z), plus(X, Y, Z), X < Y",
            vec![vec![1, 2, 3], vec![1, 3, 4], vec![3, 4, 7]],
        ),
        ("?- plus(3, X, 7)", vec![vec![4]]),
        ("?- n(X), !СУММА(X, X, 4), X < 4", vec![vec![1], vec![3]]),
        (
            "?- n(X), S = sum Y : { n(Z), plus(X, Z, Y) }, X > 3 .order X desc",
            vec![vec![7, 52], vec![4, 37]],
        ),
        // Recursion through what is computed ends where its guard says.
        (
            ".decl up(x: number) up(1). up(Y) :- up(X), plus(X, X, Y), Y < 100. ?- up(X), X > 20",
            vec![vec![32], vec![64]],
        ),
        (
            ".decl up(x: number, y: number) up(X, X) :- n(X). up(X, Z) :- up(X, Y), plus(Y, 1, Z), Z < 10. ?- up(7, Y)",
            vec![vec![7], vec![8], vec![9]],
        ),
        // Asked backwards it would go down without end: a computed value makes no call of its own group.
        (
            ".decl up(x: number, y: number) up(X, X) :- n(X). up(X, Z) :- up(X, Y), plus(Y, 1, Z), Z < 10. ?- up(7, 8), X = 1",
            vec![vec![1]],
        ),
        // No recursion, no end to care for.
        (".decl g(x: number, y: number) g(X, Y) :- n(X), plus(X, 1, Y). ?- g(X, 8)", vec![vec![7]]),
    ] {
        let source = Source::new("?", question);
        let by = sum();
        let computed: [&dyn Computed; 1] = [&by];
        let limits = Limits::default();
        let answers = program.ask_with(&facts, &source, &computed, limits.clone());
        let answers = answers.unwrap_or_else(|error| panic!("{question}: {error}"));
        assert_eq!(numbers(&answers), expected, "{question}");
        let answers = derived.ask_with(&source, &computed, limits).unwrap();
        assert_eq!(numbers(&answers), expected, "{question}");
        for n in 0..answers.rows().len() {
            let proof = answers.why(n).unwrap().expect("there is such an answer");
            assert_eq!(proof.steps[0].fact.values, answers.rows()[n], "{proof}");
        }
    }
    let by = sum();
    let source = Source::new("?", "?- n(X), plus(X, Y, Z)");
    let error = derived.ask_with(&source, &[&by], Limits::default()).unwrap_err();
    assert!(matches!(error, AskError::Blocked { .. }), "{error}");
    assert!(error.to_string().contains("a и b или a и c или b и c"), "{error}");
    assert_eq!(by.asked.get(), 0);
    // The same call is computed once.
    let source = Source::new("?", "?- n(X), n(Y), plus(1, 2, Z)");
    derived.ask_with(&source, &[&by], Limits::default()).unwrap();
    assert_eq!(by.asked.get(), 1);
}

/// An input that is computed when asked gives the program's own rules what the same rows would give if they were told.
#[test]
fn rules_read_what_is_computed_as_if_it_were_told() {
    let rules = format!(
        "{NUMBERS} .decl plus(a: number, b: number, c: number) .input plus
         .decl next(x: number, y: number) .output next next(X, Y) :- n(X), plus(X, 1, Y).
         .decl chain(x: number, y: number) .output chain chain(X, Y) :- next(X, Y), n(Y). chain(X, Z) :- chain(X, Y), next(Y, Z).
         .decl last(x: number) .output last last(X) :- n(X), !next_known(X).
         .decl next_known(x: number) next_known(X) :- next(X, Y), n(Y).
         .decl odd(x: number) .output odd odd(X) :- n(X), X % 2 = 1."
    );
    let program = Program::parse(&Source::new("n.dl", &*rules)).unwrap();
    let mut told = program.database();
    for (a, b) in (0..12).flat_map(|a| (0..12).map(move |b| (a, b))) {
        told.insert("plus", &[a, b, a + b].map(Value::Number)).unwrap();
    }
    let (whole, empty) = (program.evaluate(&told).unwrap(), program.database());
    let bare = program.evaluate(&empty).unwrap();
    for question in [
        "?- next(X, Y)",
        "?- next(X, 5)",
        "?- chain(X, Y)",
        "?- chain(1, Y)",
        "?- next_known(X)",
        "?- n(X), next_known(X)",
        "?- n(X), !next_known(X)",
        "?- last(X)",
        "?- !last(1)",
        "?- odd(X), next(X, Y), !chain(X, Y)",
        "?- n(X), C = count : { chain(X, _) }",
        "?- plus(2, 3, X)",
    ] {
        let source = Source::new("?", question);
        let expected = whole.ask(&source).unwrap().rows().to_vec();
        for held in [&program.evaluate(&told).unwrap(), &bare] {
            let by = sum();
            let answers = held.ask_with(&source, &[&by], Limits::default()).unwrap();
            assert_eq!(answers.rows(), expected, "{question}");
            for n in 0..answers.rows().len() {
                assert!(answers.why(n).unwrap().is_some(), "{question}");
            }
        }
        let by = sum();
        let answers = program.ask_with(&empty, &source, &[&by], Limits::default()).unwrap();
        assert_eq!(answers.rows(), expected, "{question}");
    }
    // What does not rest on it is not derived again, and what cannot be computed so is refused.
    let by = sum();
    bare.ask_with(&Source::new("?", "?- odd(X)"), &[&by], Limits::default()).unwrap();
    assert_eq!(by.asked.get(), 0);
    let source = Source::new("?", "?- plus(X, Y, Z)");
    let error = bare.ask_with(&source, &[&by], Limits::default()).unwrap_err();
    assert!(matches!(error, AskError::Blocked { .. }), "{error}");
}

#[test]
fn faults_of_a_question_have_their_places() {
    let program = Program::parse(&Source::new("n.dl", NUMBERS)).unwrap();
    let facts = program.database();
    for (question, expected) in [
        ("?- m(X)", "?:1:4: неизвестное отношение «m»"),
        ("?- n(X), X > \"a\"", "?:1:14: «a»: нужен тип number, а здесь symbol"),
        ("?- n(X), !n(Y)", "?:1:13: переменная «Y» ничем не связана"),
        ("?- n(X .limit 3", "?:1:8: здесь ожидается действие или «,» или «)», а стоит «.»"),
        ("?- n(X).order Z", "?:1:15: переменная «Z» ничем не связана"),
        ("n(8). ?- n(X)", "?:1:1: не поддерживается: правило вопроса для отношения программы «n»"),
        (
            ".decl a(x: number) a(X) :- n(X), !a(X). ?- a(X)",
            "?:1:35: отношение зависит от собственного отрицания или счёта: a → не a",
        ),
        ("?-", "?:1:3: здесь ожидается"),
        ("", "?:1:1: здесь ожидается"),
    ] {
        let error = program.ask(&facts, &Source::new("?", question)).expect_err(question);
        assert!(error.to_string().starts_with(expected), "{question}: {error}");
    }
}

/// Limits stand in the program, in the question or beside it; the narrowest holds, and the fault says how far it came.
#[test]
fn limits_of_a_program_and_of_a_question_hold_for_its_answers() {
    let endless = "a(1). a(X + 1) :- a(X).";
    let pairs = "n(X) :- X = range(0, 50). a(X * 50 + Y) :- n(X), n(Y).";
    let declared = ".decl n(x: number) .decl a(x: number)";
    let long = Limits::default();
    for (rules, pragma, limits, code, reached) in [
        (endless, ".pragma \"time-limit\" \"1\"", long.clone(), "facts::time", 1),
        (
            endless,
            "",
            Limits { time: Duration::from_millis(200), ..long.clone() },
            "facts::time",
            1,
        ),
        (endless, ".pragma \"row-limit\" \"3000\"", long.clone(), "facts::too_many", 0),
        (endless, "", Limits { rows: 3000, ..long.clone() }, "facts::too_many", 0),
        (endless, ".pragma \"memory-limit\" \"1\"", long.clone(), "facts::memory", 1),
        (pairs, ".pragma \"row-limit\" \"2000\"", long.clone(), "facts::too_many", 0),
        (pairs, "", Limits { rows: 2000, ..long }, "facts::too_many", 0),
    ] {
        let failed = |program: &str, question: &str, reached: usize| {
            let program = Program::parse(&Source::new("p.dl", program)).unwrap();
            let question = Source::new("?", question);
            let error =
                program.ask_with(&program.database(), &question, &[], limits.clone()).unwrap_err();
            let told = error.code().map(|code| code.to_string());
            assert_eq!(told.as_deref(), Some(code), "{pragma} {rules}: {error}");
            match error {
                AskError::Evaluate(
                    EvaluateError::Time { rows, rule, .. }
                    | EvaluateError::Memory { rows, rule, .. },
                ) => {
                    assert!(
                        rows >= reached && rule.contains(':'),
                        "{pragma} {rules}: {rows} {rule}"
                    );
                }
                AskError::Evaluate(EvaluateError::TooMany { rule, .. }) => {
                    assert!(rule.contains(':'), "{rule}");
                }
                other => panic!("{other}"),
            }
        };
        // Of pairs a question after one number finds no more than that.
        let asked = if rules == pairs { "?- a(X), X < 0" } else { "?- a(-5)" };
        failed(&format!("{declared} {rules} {pragma}"), asked, reached);
        failed("", &format!("{pragma} {declared} {rules} {asked}"), reached);
    }
}

/// A relation that raises a flag when it has been asked so often, and counts on.
struct Counted {
    declaration: Source,
    asked: Cell<usize>,
    stop: Stop,
}

const RAISED_AT: usize = 5000;

impl Computed for Counted {
    fn declaration(&self) -> &Source {
        &self.declaration
    }

    fn ways(&self) -> &[(u32, f64)] {
        &[(0b01, 1.0)]
    }

    fn rows(&self, known: &[Option<Value>], tell: &mut dyn FnMut(&[Value])) {
        self.asked.set(self.asked.get() + 1);
        if self.asked.get() == RAISED_AT {
            self.stop.raise();
        }
        if let Some(Some(Value::Number(number))) = known.first() {
            tell(&[Value::Number(*number), Value::Number(number + 1)]);
        }
    }
}

/// Of a million steps, or of endless ones, few are taken when nobody waits any more: counted, for a clock tells nothing on
/// a busy machine.
#[test]
fn a_question_ends_soon_after_nobody_waits_for_it() {
    const MORE: usize = 5000;
    let declared = ".decl n(x: number) n(X) :- X = range(0, 1000).";
    for question in [
        "?- n(X), n(Y), next(X * 1000 + Y, Z), Z < 0",
        ".decl a(x: number) a(0). a(Y) :- a(X), next(X, Y). ?- a(-5)",
        ".decl a(x: number) a(Z) :- n(X), n(Y), next(X * 1000 + Y, Z). ?- M = max X : { a(X) }",
        ".decl a(x: number) a(Z) :- n(X), n(Y), next(X * 1000 + Y, Z). ?- n(X), !a(X)",
    ] {
        let program = Program::parse(&Source::new("p.dl", declared)).unwrap();
        let declaration = Source::new("next", ".decl next(x: number, y: number)");
        let counted = Counted { declaration, asked: Cell::new(0), stop: Stop::new() };
        let limits = Limits { stop: Some(counted.stop.clone()), ..Limits::default() };
        let asked = Source::new("?", question);
        let error = program.ask_with(&program.database(), &asked, &[&counted], limits);
        let error = error.map(|answers| answers.rows().len()).unwrap_err();
        let told = matches!(&error, AskError::Evaluate(EvaluateError::Stopped { .. }));
        assert!(told, "{question}: {error}");
        let asked = counted.asked.get();
        assert!((RAISED_AT..RAISED_AT + MORE).contains(&asked), "{question}: {asked}");
    }
}

#[test]
fn answers_come_in_the_order_asked_for() {
    let program = Program::parse(&Source::new("n.dl", NUMBERS)).unwrap();
    let facts = program.database();
    for (question, expected) in [
        ("?- n(X)", vec![vec![1], vec![2], vec![3], vec![4], vec![7]]),
        ("?- n(X).order X desc.limit 2.", vec![vec![7], vec![4]]),
        (
            "?- n(X), Y = X % 2 .order Y desc, X",
            vec![vec![1, 1], vec![3, 1], vec![7, 1], vec![2, 0], vec![4, 0]],
        ),
        ("twice(X * 2) :- n(X), X < 3", vec![vec![2], vec![4]]),
        ("?- (n(X) ; X = 9), X > 4", vec![vec![7], vec![9]]),
        ("?- n(_X), _X > 5", vec![vec![]]),
        ("?- n(8)", vec![]),
    ] {
        let answers = program.ask(&facts, &Source::new("?", question));
        let answers = answers.unwrap_or_else(|error| panic!("{question}: {error}"));
        assert_eq!(numbers(&answers), expected, "{question}");
    }
}

#[test]
fn a_tuple_tells_what_its_rules_ask_of_others() {
    let program = Program::parse(&Source::new(
        "n.dl",
        r#".decl way(a: symbol, b: symbol, how: symbol, d: number) .input way
           .decl size(a: symbol, d: number) .input size
           .decl near(a: symbol, b: symbol) .output near
           near(A, B) :- wide(A, B), size(A, _).
           near(A, B) :- near(B, A), !size("wall", 3).
           .decl wide(a: symbol, b: symbol)
           wide(A, B) :- way(A, B, "along", D), D < 3.
           wide("gate", B) :- way(B, _, "across", _)."#,
    ))
    .unwrap();
    let of = ["way", "size"].map(|name| program.relation(name).unwrap());
    let told = |tuple: [&str; 2]| {
        let calls = program.calls("near", &tuple.map(Value::from), &of).unwrap();
        let told = calls.iter().map(|(relation, known)| {
            let known = known.iter().map(|k| k.as_ref().map_or("_".to_owned(), Value::to_string));
            format!("{}({})", program.info(*relation).name, known.collect::<Vec<_>>().join(","))
        });
        told.collect::<std::collections::BTreeSet<_>>().into_iter().collect::<Vec<_>>().join(" ")
    };
    let plain = "size(a,_) size(b,_) size(wall,3) way(a,b,along,_) way(b,a,along,_)";
    assert_eq!(told(["a", "b"]), plain);
    let gate = "size(b,_) size(gate,_) size(wall,3) way(b,_,across,_) way(b,gate,along,_) way(gate,b,along,_)";
    assert_eq!(told(["gate", "b"]), gate);
    assert!(program.calls("near", &[Value::Number(1)], &of).is_err());
}

#[test]
fn a_text_that_no_fact_holds_may_be_what_something_else_is_called() {
    let rules = Source::new(
        "on.dl",
        r#".decl on(a: symbol, b: symbol) .output on on("чашка", "стол"). on("cup", "пол")."#,
    );
    let program = Program::parse(&rules).unwrap();
    let derived = program.evaluate(&program.database()).unwrap();
    let called = |text: &str| {
        let known = [("table", "стол"), ("cup", "чашка")];
        known.iter().find(|(other, _)| *other == text).map(|(_, name)| (*name).to_owned())
    };
    let rows = |question: &str| {
        let source = Source::new("?", question);
        let answers = derived.ask_calling(&source, &[], &called, Limits::default()).unwrap();
        let unknown: Vec<String> = answers.unknown().map(str::to_owned).collect();
        (answers.rows().to_vec(), unknown)
    };
    assert_eq!(rows(r#"?- on(X, "table")"#), (vec![vec!["чашка".into()]], vec![]));
    // What some fact holds is that.
    assert_eq!(rows(r#"?- on("cup", X)"#), (vec![vec!["пол".into()]], vec![]));
    assert_eq!(rows(r#"?- on(X, "chair")"#), (vec![], vec!["chair".to_owned()]));
}

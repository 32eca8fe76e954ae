//! What programs derive: recursion, negation, counts, computed values.

use expect_test::{Expect, expect};
use orthoframe_facts::Program;
use orthoframe_units::Source;

/// The tuples of all `.output` relations.
fn check(text: &str, expected: &Expect) {
    let program =
        Program::parse(&Source::new("t.dl", text)).unwrap_or_else(|faults| panic!("{faults}"));
    let derived = program.evaluate(&program.database()).unwrap();
    let mut shown = String::new();
    for (id, info) in program.relations().filter(|(_, info)| !info.outputs.is_empty()) {
        for tuple in derived.sorted(id).unwrap() {
            let values: Vec<String> = tuple.iter().map(ToString::to_string).collect();
            shown += &format!("{}({})\n", info.name, values.join(", "));
        }
    }
    expected.assert_eq(&shown);
}

#[test]
fn recursion_reaches_what_is_reachable() {
    let rules = "
            .decl edge(a: number, b: number)
            .decl path(a: number, b: number)
            .output path
            edge(1, 2). edge(2, 3). edge(3, 1).
            path(A, B) :- edge(A, B).
            path(A, C) :- path(A, B), path(B, C).";
    check(
        rules,
        &expect![[r#"
                path(1, 1)
                path(1, 2)
                path(1, 3)
                path(2, 1)
                path(2, 2)
                path(2, 3)
                path(3, 1)
                path(3, 2)
                path(3, 3)
            "#]],
    );
}

#[test]
fn negation_sees_the_finished_relation() {
    let rules = r#"
            .decl комната(имя: symbol) .decl дверь(a: symbol, b: symbol)
            .decl достижима(имя: symbol) .decl отрезана(имя: symbol)
            .output отрезана
            комната("А"). комната("Б"). комната("В").
            дверь("А", "Б").
            достижима("А").
            достижима(Y) :- достижима(X), (дверь(X, Y) ; дверь(Y, X)).
            отрезана(X) :- комната(X), !достижима(X)."#;
    check(
        rules,
        &expect![[r#"
                отрезана(В)
            "#]],
    );
}

#[test]
fn aggregates_count_solutions() {
    let rules = "
            .decl r(a: number, b: number) .decl k(a: number)
            .decl c(a: number, n: number, s: number, least: number, most: number, mean: number)
            .decl total(n: number)
            .output c .output total
            k(1). k(2). k(3). r(1, 5). r(1, 7). r(2, -4).
            c(A, N, S, L, M, E) :- k(A), N = count : { r(A, _) }, S = sum B : { r(A, B) },
                L = min B : r(A, B), M = max B : r(A, B), E = mean B : { r(A, B) }.
            total(count : { r(X, Y), Y > X }).";
    check(
        rules,
        &expect![[r#"
                c(1, 2, 12, 5, 7, 6)
                c(2, 1, -4, -4, -4, -4)
                total(2)
            "#]],
    );
}

#[test]
fn values_are_computed_and_compared() {
    let rules = r#"
            .decl n(a: number) .decl out(a: number, t: symbol) .decl eq(a: number, b: number)
            .output out .output eq
            n(1). n(2). n(-7). n(9223372036854775807).
            out(X + 1, cat("x", to_string(X), "y")) :- n(X), X % 2 != 0.
            eq(X, Y) :- n(X), n(Y), X = -(Y - 1) * 8 + 1, strlen("ёж") = 2.
            out(to_number("12") / 5 ^ 1, substr("Комната", 1, 2)).
            out(1 / 0, "нет")."#;
    check(
        rules,
        &expect![[r#"
                out(-6, x-7y)
                out(2, x1y)
                out(2, ом)
                eq(-7, 2)
                eq(1, 1)
            "#]],
    );
}

#[test]
fn several_heads_and_repeated_variables() {
    let rules = "
            .decl r(a: number, b: number) .decl loop(a: number) .decl same(a: number) .decl flag()
            .output loop .output same .output flag
            r(1, 1). r(1, 2). r(2, 2).
            loop(X), same(X) :- r(X, X), X < 2.
            flag() :- r(_, 2).";
    check(
        rules,
        &expect![[r#"
                loop(1)
                same(1)
                flag()
            "#]],
    );
}

#[test]
fn a_program_without_end_is_stopped() {
    let rules = ".decl n(a: number) .limitsize n(n=50) .output n n(0). n(X + 1) :- n(X).";
    let program = Program::parse(&Source::new("t.dl", rules)).unwrap();
    assert_eq!(program.evaluate(&program.database()).unwrap().len("n"), Ok(50));
}

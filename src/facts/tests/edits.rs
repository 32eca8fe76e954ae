//! Edits through every construct of the language, against evaluation from scratch, on random programs.

use std::collections::BTreeSet;

use super::facts_naive::Dice;
use orthoframe_facts::{Live, Program, Value};
use orthoframe_units::Source;

/// What all programs read.
const INPUTS: &str = "
    .type Pair = [a: number, b: number]
    .type List = [first: number, rest: List]
    .type Tree = Leaf {} | Node { left: Tree, value: number, right: Tree }
    .decl e(a: number, b: number) .input e
    .decl p(p: Pair) .input p
    .decl t(t: Tree) .input t
    .decl s(a: symbol, b: number) .input s
    .comp Graph<N> {
        .decl edge(a: N, b: N)
        .decl path(a: N, b: N) overridable
        path(A, B) :- edge(A, B).
        path(A, C) :- path(A, B), edge(B, C).
    }
    .comp Both<N> : Graph<N> { edge(A, B) :- edge(B, A). }
    .comp Far<N> : Graph<N> { .override path path(A, C) :- edge(A, B), edge(B, C), A != C. }";

/// Pieces of programs; those that are marked keep what comes first.
const PIECES: &[(&str, bool)] = &[
    (".init one = Graph<number> one.edge(X, Y) :- e(X, Y).", false),
    (".init both = Both<number> both.edge(X, Y) :- p([X, Y]), X < Y.", false),
    (".init far = Far<number> far.edge(X, Y) :- e(X, Y), !p([X, Y]).", false),
    (".init named = Graph<symbol> named.edge(A, B) :- s(A, N), s(B, M), N < M.", false),
    (".decl pairs(p: Pair) pairs([Y, X]) :- e(X, Y). pairs([X, Z]) :- pairs([X, Y]), p([Y, Z]).", false),
    (".decl list(l: List, n: number) list(nil, 0). list([X, L], N + 1) :- list(L, N), e(X, N), N < 3.", false),
    (".decl parts(t: Tree) parts(T) :- t(T). parts(L), parts(R) :- parts($Node(L, _, R)).
      .decl values(v: number) values(V) :- parts($Node(_, V, _)).
      .decl made(t: Tree) made($Node($Leaf, X, $Leaf)) :- values(X), e(X, _).", false),
    (".decl degree(a: number, n: number) degree(X, N) :- e(X, _), N = count : { e(X, _) }.", false),
    (".decl sums(a: number, s: number) sums(X, S) :- p([X, _]), S = sum Y : { e(X, Y) }.", false),
    (".decl most(m: number) most(M) :- M = max N : { s(_, N), !e(N, _) }.", false),
    (".decl middle(m: float) middle(M) :- M = mean x : { e(_, Y), x = to_float(Y) / 3.0 }.", false),
    (".decl least(a: symbol, n: number) least(A, N) :- s(A, _), N = min M : { s(A, M) }.", false),
    (".decl text(a: symbol) text(cat(A, to_string(N))) :- s(A, N), !e(N, N).", false),
    (".decl same(a: number, b: number) eqrel same(X, Y) :- e(X, Y), X < 4.", false),
    (".decl dist(a: number, n: number) dist(0, 0). dist(Y, N + 1) :- dist(X, N), e(X, Y), N < 9. dist(x, n) <= dist(x, m) :- m < n.
      .decl near(a: number) near(X) :- dist(X, N), N < 3.", false),
    (".decl best(a: symbol, n: number) best(A, N) :- s(A, N). best(a, n) <= best(a, m) :- n < m.", false),
    (".decl chosen(a: number, b: number) choice-domain a chosen(X, Y) :- e(X, Y). chosen(X, Y) :- p([X, Y]).
      .decl after(a: number) after(Y) :- chosen(_, Y).", true),
    (".decl tree(a: number, b: number) choice-domain b tree(0, 0). tree(X, Y) :- tree(_, X), e(X, Y).", true),
    (".decl numbered(n: number, a: number) numbered(autoinc(), X) :- e(X, _).", true),
    (".decl more(n: number, a: symbol) more(autoinc(), A) :- s(A, N), N > 2.", true),
    (".decl some(a: number) .limitsize some(n=3) some(X) :- e(_, X).", true),
];

/// A random input tuple.
fn fact(dice: &mut Dice) -> (&'static str, Vec<Value>) {
    let number = |dice: &mut Dice| dice.roll(6) as i64;
    let record = |text: String| Value::Record(text.into());
    match dice.roll(5) {
        0 | 1 => ("e", vec![number(dice).into(), number(dice).into()]),
        2 => ("p", vec![record(format!("[{}, {}]", number(dice), number(dice)))]),
        3 => ("t", vec![record(tree(dice, 0))]),
        _ => ("s", vec![["a", "b", "в", "г"][dice.roll(4)].into(), number(dice).into()]),
    }
}

fn tree(dice: &mut Dice, depth: usize) -> String {
    if depth > 2 || dice.one_in(3) {
        return "$Leaf".to_owned();
    }
    let (left, value, right) = (tree(dice, depth + 1), dice.roll(6), tree(dice, depth + 1));
    format!("$Node({left}, {value}, {right})")
}

/// All rows of all relations.
fn rows(derived: &orthoframe_facts::Derived, program: &Program) -> Vec<(String, Vec<Vec<Value>>)> {
    let of = program.relations().map(|(relation, info)| {
        (info.name.clone(), derived.sorted(relation).expect("it is declared"))
    });
    of.collect()
}

#[test]
fn edits_lead_where_evaluation_from_scratch_leads() {
    for seed in crate::ask::seeds(300) {
        let mut dice = Dice::new(seed + 5);
        let picked: BTreeSet<usize> =
            (0..1 + dice.roll(6)).map(|_| dice.roll(PIECES.len())).collect();
        let pieces: Vec<_> = picked.iter().map(|n| PIECES[*n]).collect();
        let keeps_first = pieces.iter().any(|(_, keeps_first)| *keeps_first);
        let mut text = INPUTS.to_owned();
        pieces.iter().for_each(|(piece, _)| text += &format!("\n{piece}"));
        let program = Program::parse(&Source::new("random.dl", text.as_str()))
            .unwrap_or_else(|faults| panic!("{text}\n{faults}"));
        let mut facts: BTreeSet<(&str, Vec<Value>)> = BTreeSet::new();
        let mut live = Live::new(program.clone(), program.database()).expect("it is finite");
        for _ in 0..12 {
            for _ in 0..1 + dice.roll(6) {
                let (name, tuple) = fact(&mut dice);
                let known = facts.iter().nth(dice.roll(facts.len().max(1))).cloned();
                match known.filter(|_| dice.one_in(3)) {
                    Some((name, tuple)) => {
                        live.remove(name, &tuple).expect("it fits");
                        facts.remove(&(name, tuple));
                    }
                    None => {
                        live.insert(name, &tuple).expect("it fits");
                        facts.insert((name, tuple));
                    }
                }
            }
            live.update().expect("random programs are finite");
            let found = rows(live.derived(), &program);
            let again = program.evaluate(live.database()).expect("it is finite");
            let expected = rows(&again, &program);
            for (found, expected) in found.iter().zip(&expected) {
                assert_eq!(found, expected, "seed {seed}\n{text}");
            }
            // Other words: what comes first may then be another.
            if !keeps_first {
                let mut database = program.database();
                for (name, tuple) in &facts {
                    database.insert(*name, tuple).expect("it fits");
                }
                let fresh = program.evaluate(&database).expect("it is finite");
                for (found, expected) in found.iter().zip(&rows(&fresh, &program)) {
                    assert_eq!(found, expected, "seed {seed}\n{text}");
                }
            }
        }
    }
}

#[test]
fn what_edits_cannot_be_followed_through_is_told() {
    let rules = "
        .decl e(a: number, b: number) .input e
        .decl path(a: number, b: number) path(X, Y) :- e(X, Y). path(X, Z) :- path(X, Y), e(Y, Z).
        .decl chosen(a: number, b: number) choice-domain a chosen(X, Y) :- path(X, Y).
        .decl least(a: number, b: number) least(X, Y) :- e(X, Y). least(x, a) <= least(x, b) :- b < a.
        .decl numbered(n: number) numbered(autoinc()) :- e(_, _).
        .decl few(a: number) .limitsize few(n=1) few(X) :- e(X, _).";
    let program = Program::parse(&Source::new("r.dl", rules)).unwrap();
    let live = Live::new(program.clone(), program.database()).unwrap();
    let told: BTreeSet<&str> =
        live.evaluated_anew().map(|relation| program.info(relation).name.as_str()).collect();
    assert_eq!(told.into_iter().collect::<Vec<_>>(), ["chosen", "few", "least", "numbered"]);
}

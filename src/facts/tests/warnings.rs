//! Warnings against what programs do. Of two groups of premises that nothing ties, a rule finds every pair: its result is
//! the product of what is found of each, over whatever facts. A warning says so; where there is none, some facts show that
//! it is not so.

use std::collections::{BTreeSet, HashSet};
use std::fmt::Write as _;

use orthoframe_facts::{Program, RuleError, Value};
use orthoframe_units::Source;

/// A small generator of numbers: the same seed, the same program.
struct Dice(u64);

impl Dice {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    fn roll(&mut self, sides: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % sides
    }
}

/// Relations by their number of columns.
const RELATIONS: [(&str, usize); 5] =
    [("one", 1), ("two", 2), ("three", 3), ("pair", 2), ("few", 1)];
const VARIABLES: [&str; 5] = ["A", "B", "C", "D", "E"];

/// A rule for `found` over up to three atoms, with conditions between what they bind.
fn rule(dice: &mut Dice) -> (String, usize) {
    let mut bound: Vec<&str> = Vec::new();
    let mut premises = Vec::new();
    for _ in 0..2 + dice.roll(2) {
        let (name, columns) = RELATIONS[dice.roll(RELATIONS.len())];
        let mut args = Vec::new();
        for _ in 0..columns {
            let variable = VARIABLES[dice.roll(VARIABLES.len())];
            args.push(match dice.roll(8) {
                0 => "_".to_owned(),
                1 => dice.roll(3).to_string(),
                _ => {
                    bound.push(variable);
                    variable.to_owned()
                }
            });
        }
        premises.push(format!("{name}({})", args.join(", ")));
    }
    bound.sort_unstable();
    bound.dedup();
    if bound.len() < 2 {
        return rule(dice);
    }
    let one = |dice: &mut Dice| bound[dice.roll(bound.len())];
    let mut told: Vec<String> = bound.iter().map(|&name| name.to_owned()).collect();
    for n in 0..dice.roll(3) {
        let (x, y, z) = (one(dice), one(dice), one(dice));
        premises.push(match dice.roll(8) {
            0 if x != y => format!("{x} != {y}"),
            1 if x != y => format!("{x} <= {y} + 1"),
            2 => format!("!pair({x}, {y})"),
            // Made of both, and no condition.
            3 => {
                told.push(format!("M{n}"));
                format!("M{n} = {x} + 4 * {y}")
            }
            // Made of both, and then compared.
            4 if x != y => format!("N{n} = {x} + {y}, N{n} < 4"),
            5 => {
                told.push(format!("K{n}"));
                format!("K{n} = count : {{ three({x}, {y}, _) }}")
            }
            6 if x != y => format!("2 > sum W : {{ three({x}, {y}, W) }}"),
            7 if x != y && y != z => format!("({x} + {y}) % 3 != {z} % 2"),
            _ => format!("{x} < 3"),
        });
    }
    // The head tells of some; a count that it did not tell of would be none.
    told.retain(|name| name.starts_with('K') || dice.roll(4) > 0);
    if told.is_empty() {
        return rule(dice);
    }
    for n in (1..premises.len()).rev() {
        premises.swap(n, dice.roll(n + 1));
    }
    (format!("found({}) :- {}.", told.join(", "), premises.join(", ")), told.len())
}

fn program(rule: &str, columns: usize) -> Program {
    let mut text = String::new();
    for (name, columns) in RELATIONS {
        let columns: Vec<String> = (0..columns).map(|n| format!("c{n}: number")).collect();
        let _ = writeln!(text, ".decl {name}({}) input", columns.join(", "));
    }
    let columns: Vec<String> = (0..columns).map(|n| format!("c{n}: number")).collect();
    let _ = writeln!(text, ".decl found({}) output\n{rule}", columns.join(", "));
    Program::parse(&Source::new("t.dl", &text)).unwrap_or_else(|faults| panic!("{rule}: {faults}"))
}

fn warns(program: &Program) -> bool {
    let all = program.warnings().iter().flat_map(|file| &file.faults);
    all.into_iter().any(|fault| matches!(fault, RuleError::Product { .. }))
}

/// What a rule finds over facts by chance.
fn found(program: &Program, dice: &mut Dice) -> Vec<Vec<i64>> {
    let mut facts = program.database();
    for (name, columns) in RELATIONS {
        let most = 1 + dice.roll(12);
        for _ in 0..1 + dice.roll(most) {
            let tuple: Vec<Value> = (0..columns).map(|_| (dice.roll(4) as i64).into()).collect();
            facts.insert(name, &tuple).unwrap();
        }
    }
    let derived = program.evaluate(&facts).unwrap();
    let number = |value: &Value| match value {
        Value::Number(number) => *number,
        other => panic!("{other} is a number"),
    };
    let tuples = derived.tuples("found").unwrap();
    tuples.map(|tuple| tuple.values().iter().map(number).collect()).collect()
}

/// The ways to part the columns in two so that the rows are all pairs of their parts.
fn partings(rows: &[Vec<i64>], columns: usize, of: &BTreeSet<usize>) -> BTreeSet<usize> {
    let part = |row: &[i64], mask: usize| -> Vec<i64> {
        row.iter().enumerate().filter(|(n, _)| mask >> n & 1 == 1).map(|(_, v)| *v).collect()
    };
    let all = (1_usize << columns) - 1;
    let is_product = |mask: &usize| {
        let one: HashSet<Vec<i64>> = rows.iter().map(|row| part(row, *mask)).collect();
        let other: HashSet<Vec<i64>> = rows.iter().map(|row| part(row, all & !mask)).collect();
        one.len() * other.len() == rows.len()
    };
    of.iter().copied().filter(is_product).collect()
}

#[test]
fn a_product_is_told_where_all_pairs_are_found_and_nowhere_else() {
    let (mut products, mut joined) = (0, 0);
    for seed in 1..800 {
        let mut dice = Dice::new(seed);
        let (rule, columns) = rule(&mut dice);
        // What is made of both sides is none of either: such heads are tried by hand below.
        if rule.contains('M') && rule.split(":-").next().is_some_and(|head| head.contains('M')) {
            continue;
        }
        let program = program(&rule, columns);
        // Half of the columns say it all: the other half is the rest.
        let mut ways: BTreeSet<usize> =
            (1..(1_usize << columns) - 1).filter(|m| m & 1 == 1).collect();
        let is_warned = warns(&program);
        // Facts that show it may be rare; none are where there is a warning.
        let mut is_met = false;
        for _ in 0..if is_warned { 50 } else { 3000 } {
            if ways.is_empty() {
                break;
            }
            let rows = found(&program, &mut dice);
            is_met |= !rows.is_empty();
            ways = partings(&rows, columns, &ways);
        }
        // What no facts fulfil is no product of anything.
        if !is_met {
            continue;
        }
        assert_eq!(is_warned, !ways.is_empty(), "seed {seed}: {rule}");
        match ways.is_empty() {
            true => joined += 1,
            false => products += 1,
        }
    }
    assert!(products > 40 && joined > 200, "{products} products, {joined} joined");
}

#[test]
fn products_by_hand() {
    for (rule, expected) in [
        ("found(A, B) :- one(A), few(B).", true),
        ("found(A, B) :- one(A), few(B), A < B.", false),
        ("found(A, B) :- one(A), few(B), A = B.", false),
        ("found(A, B) :- one(A), few(B), two(A, B).", false),
        ("found(A, B) :- one(A), few(B), !two(A, B).", false),
        ("found(A, B) :- one(A), few(B), A = 1, B = 2.", false),
        ("found(A, B) :- one(A), two(B, C), A = 1, B = 2, C > A.", false),
        ("found(A, B) :- two(A, C), two(B, D), C = 1, D = 1.", true),
        ("found(A, A) :- one(A), few(_).", false),
        ("found(A, A) :- one(A), few(B), B > 2.", false),
        ("found(A, A) :- one(A), two(B, B), few(B).", false),
        ("found(A, A + B) :- one(A), few(B).", true),
        ("found(A, S) :- one(A), few(B), S = A + B.", true),
        ("found(A, S) :- one(A), few(B), S = A + B, S > 3.", false),
        ("found(A, S) :- one(A), few(B), S = A + B, pair(S, _).", false),
        ("found(A, S) :- one(A), few(B), S = A * 0 + 1.", false),
        ("found(A, N) :- one(A), N = count : { one(X), few(Y), two(X, Y) }.", false),
        ("found(A, N) :- one(A), N = count : { one(_), few(_) }.", false),
        ("found(A, N) :- one(A), N = count : { one(X), few(Y) }.", true),
        ("found(A, N) :- one(A), N = sum X : { one(X), few(Y) }.", true),
        ("found(A, N) :- one(A), N = max X : { one(X), few(Y), Y > 2 }.", false),
        ("found(A, N) :- one(A), N = max X + Y : { one(X), few(Y) }.", true),
        ("found(A, N) :- one(A), N = count : { two(X, A), pair(A, Y) }.", false),
        ("found(A, N) :- one(A), N = range(0, 3).", false),
        ("found(A, N) :- one(A), few(B), N = range(A, B).", false),
        ("found(A, B) :- one(A), single(B).", false),
        ("found(A, B) :- one(A), total(B).", false),
        ("found(A, B) :- one(A), (few(B) ; two(A, B)).", true),
        ("found(A, B) :- one(A), (pair(B, A) ; two(A, B)).", false),
    ] {
        let own = ".decl single(a: number) single(7).\n.decl total(a: number) total(N) :- N = count : { one(_) }, N > 2.\n";
        let shown = ".output single, total\n";
        assert_eq!(warns(&program(&format!("{own}{shown}{rule}"), 2)), expected, "{rule}");
    }
}

fn never_fires(text: &str) -> bool {
    let source = Source::new("t.dl", text);
    let program = Program::parse(&source).unwrap_or_else(|faults| panic!("{text}: {faults}"));
    let all = program.warnings().iter().flat_map(|file| &file.faults);
    all.into_iter().any(|fault| matches!(fault, RuleError::NeverFires { .. }))
}

/// A variable by its number, or a constant.
type Side = Result<usize, i64>;

/// Comparisons of three variables with each other and with constants: a warning where no three numbers fulfil them all.
#[test]
fn comparisons_that_exclude_each_other_are_told_and_no_others() {
    const SIGNS: [&str; 6] = ["=", "!=", "<", "<=", ">", ">="];
    // Three numbers below, between and above the constants.
    const NUMBERS: [i64; 15] = [-5, -3, -1, 0, 2, 4, 6, 10, 12, 14, 16, 20, 22, 24, 26];
    let mut told = [0, 0];
    for seed in 1..3000 {
        let mut dice = Dice::new(seed);
        let compares: Vec<(Side, usize, Side)> = (0..1 + dice.roll(6))
            .map(|_| {
                let left = dice.roll(3);
                let right = match dice.roll(2) {
                    0 => Ok((left + 1 + dice.roll(2)) % 3),
                    _ => Err(10 * dice.roll(3) as i64),
                };
                let sign = dice.roll(SIGNS.len());
                if dice.roll(2) == 0 { (Ok(left), sign, right) } else { (right, sign, Ok(left)) }
            })
            .collect();
        let holds = |of: [i64; 3]| {
            compares.iter().all(|(left, sign, right)| {
                let value = |side: Side| side.map_or_else(|number| number, |n| of[n]);
                let (left, right) = (value(*left), value(*right));
                match sign {
                    0 => left == right,
                    1 => left != right,
                    2 => left < right,
                    3 => left <= right,
                    4 => left > right,
                    _ => left >= right,
                }
            })
        };
        let mut all = NUMBERS.iter().flat_map(|a| NUMBERS.iter().map(move |b| (*a, *b)));
        let can_hold = all.any(|(a, b)| NUMBERS.iter().any(|c| holds([a, b, *c])));
        let told_side =
            |side: Side| side.map_or_else(|number| number.to_string(), |n| VARIABLES[n].to_owned());
        let body: Vec<String> = compares
            .iter()
            .map(|(left, sign, right)| {
                format!("{} {} {}", told_side(*left), SIGNS[*sign], told_side(*right))
            })
            .collect();
        let text = format!(
            ".decl three(a: number, b: number, c: number) input\n.decl found(a: number) output\nfound(A + B + C) :- three(A, B, C), {}.",
            body.join(", ")
        );
        let is_told = never_fires(&text);
        assert_eq!(is_told, !can_hold, "seed {seed}: {text}");
        told[usize::from(is_told)] += 1;
    }
    assert!(told[0] > 300 && told[1] > 300, "{told:?}");
}

#[test]
fn rules_that_never_fire_by_hand() {
    let own = ".decl one(a: number) input\n.decl two(a: number, b: number) input\n.decl word(a: symbol) input\n.decl part(a: float) input\n.decl none(a: number)\nnone(A) :- none(A).\n.decl found(a: number) output\n.decl said(a: symbol) output\n";
    for (rule, expected) in [
        ("found(A) :- one(A), A > 3, A < 2.", true),
        ("found(A) :- one(A), A > 2, A < 3.", false),
        ("found(A) :- one(A), A + 1 < A + 1.", true),
        ("found(A) :- one(A), A + 1 < A.", false),
        ("found(A) :- one(A), 2 < 1.", true),
        ("found(A) :- one(A), A = 1, A = 2.", true),
        ("found(A) :- two(A, B), !two(A, B).", true),
        ("found(A) :- two(A, B), !two(B, A).", false),
        ("found(A) :- two(A, B), !two(A, _), B > 0.", true),
        ("found(A) :- two(A, _), !two(A, 3).", false),
        ("found(A) :- two(A, _), !two(_, A).", false),
        ("found(A) :- one(A), none(A).", true),
        ("found(A) :- one(A), !none(A).", false),
        ("found(A) :- one(A), (A < 2, A > 3 ; A > 7).", true),
        ("found(A) :- two(A, B), one(C), A < B, B <= C, C < A.", true),
        ("found(A) :- two(A, B), one(C), A < B, B <= C, C > A.", false),
        ("found(A) :- two(A, B), one(C), A = B, B = C, A != C.", true),
        ("found(A) :- two(A, B), A + 1 < B, B < 7, A + 1 > 9.", true),
        ("found(A) :- two(A, B), A + 1 < B, B < 7, A > 9.", false),
        ("said(A) :- word(A), A > \"в\", A < \"б\".", true),
        ("said(A) :- word(A), word(B), A >= \"в\", B < \"в\", A <= B.", true),
        ("said(A) :- word(A), A > \"б\", A < \"в\".", false),
        ("said(A) :- word(A), contains(\"б\", A), !contains(\"б\", A).", false),
        ("found(to_number(to_string(A))) :- part(A), A > 1.5, A < 1.25.", true),
        ("found(A) :- one(A), A > -1, A < -2.", true),
        ("found(A) :- one(A), A > 5000000000, A < 4000000000.", true),
        ("found(A) :- one(A), A > 4000000000, A < 5000000000.", false),
        ("found(N) :- N = count : { one(_) }, N < 0, N > 0.", true),
        ("found(autoinc()) :- one(A), A != 1, A = 1.", true),
    ] {
        // `none` is told of by itself, where it is declared.
        let count = |text: &str| {
            let program = Program::parse(&Source::new("t.dl", text)).unwrap();
            let all = program.warnings().iter().flat_map(|file| &file.faults);
            all.filter(|fault| matches!(fault, RuleError::NeverFires { .. })).count()
        };
        let more = count(&format!("{own}{rule}")) > count(own);
        assert_eq!(more, expected, "{rule}");
    }
}

/// What a component declares is used where any of its instances is asked for it.
#[test]
fn a_part_of_a_component_is_unused_where_no_instance_uses_it() {
    let text = ".comp C { .decl a(n: number) a(1). .decl b(n: number) b(N) :- a(N). .decl c(n: number) c(N) :- a(N). }\n.init x = C .init y = C .init z = C\n.output x.b\n.decl idle(n: number) idle(1).\n";
    let program = Program::parse(&Source::new("t.dl", text)).unwrap();
    let unused: Vec<String> = program
        .warnings()
        .iter()
        .flat_map(|file| &file.faults)
        .filter_map(|fault| match fault {
            RuleError::NeverUsed { name, .. } => Some(name.clone()),
            _ => None,
        })
        .collect();
    assert_eq!(unused, ["x.c", "idle"]);
}

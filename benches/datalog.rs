//! Rules read at run time against the same programs written by hand on datafrog.
//!
//! `cargo bench --bench datalog` measures all cases with criterion; `… -- --quick-table` runs each a few times
//! and prints the table of `benches/README.md`.

#[path = "datalog/by_hand.rs"]
mod by_hand;
#[path = "datalog/inputs.rs"]
mod inputs;
#[path = "datalog/programs.rs"]
mod programs;

use std::hint::black_box;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use criterion::Criterion;
use inputs::{Box8, Edge};
use orthoframe::facts::{Database, Program, Value};
use orthoframe::units::Source;

/// A program with its input, in both forms.
struct Case {
    name: &'static str,
    program: Program,
    database: Database,
    by_hand: Box<dyn Fn() -> usize>,
}

impl Case {
    fn new(
        name: &'static str,
        text: &str,
        relations: &[(&str, Vec<Vec<i64>>)],
        by_hand: impl Fn() -> usize + 'static,
    ) -> Self {
        let program =
            Program::parse(&Source::new(name, text)).expect("the benchmark's program is sound");
        let mut database = program.database();
        for (relation, tuples) in relations {
            for tuple in tuples {
                let tuple: Vec<Value> = tuple.iter().copied().map(Value::Number).collect();
                database.insert(*relation, &tuple).expect("the benchmark's input fits");
            }
        }
        Self { name, program, database, by_hand: Box::new(by_hand) }
    }

    /// Derived tuples, input left out.
    fn run(&self) -> usize {
        let derived =
            self.program.evaluate(&self.database).expect("the benchmark's program is finite");
        let sizes = self.program.relations().map(|(id, info)| {
            let is_counted = info.input.is_none() && info.name != "target";
            if is_counted { derived.len(id).expect("the relation is declared") } else { 0 }
        });
        sizes.sum()
    }
}

fn edges(edges: &[Edge]) -> Vec<Vec<i64>> {
    edges.iter().map(|&(a, b)| vec![a.into(), b.into()]).collect()
}

fn closure(name: &'static str, input: Vec<Edge>) -> Case {
    let relations = [("edge", edges(&input))];
    Case::new(name, programs::CLOSURE, &relations, move || by_hand::closure(&input))
}

fn spatial(name: &'static str, (boxes, doors): (Vec<Box8>, Vec<Edge>)) -> Case {
    let relations = [("box", boxes.iter().map(|b| b.to_vec()).collect()), ("door", edges(&doors))];
    Case::new(name, programs::SPATIAL, &relations, move || by_hand::spatial(&boxes, &doors))
}

fn cases() -> Vec<Case> {
    let tree = inputs::tree(11);
    let (r, s, t) = (
        inputs::random(20_000, 100_000, 5),
        inputs::random(20_000, 100_000, 6),
        inputs::random(20_000, 100_000, 7),
    );
    let counted = inputs::random(100_000, 200_000, 8);
    vec![
        closure("chain 4000", inputs::chain(4000)),
        closure("grid 70", inputs::grid(70)),
        closure("random 4000", inputs::random(4000, 8000, 1)),
        Case::new(
            "same generation 11",
            programs::SAME_GENERATION,
            &[("parent", edges(&tree))],
            move || by_hand::same_generation(&tree),
        ),
        Case::new(
            "three-way join",
            programs::THREE_WAY,
            &[("r", edges(&r)), ("s", edges(&s)), ("t", edges(&t))],
            move || by_hand::three_way(&r, &s, &t),
        ),
        Case::new("negation, count", programs::COUNTS, &[("edge", edges(&counted))], move || {
            by_hand::counts(&counted)
        }),
        spatial("spatial 100000", inputs::boxes(100_000, 50, 7)),
        spatial("spatial 30000 x 300", inputs::boxes(30_000, 300, 7)),
    ]
}

fn quick_table(only: Option<&str>) {
    let mut table =
        "| program | tuples | by hand, ms | rules, ms | ratio |\n|---|---|---|---|---|\n"
            .to_owned();
    for case in cases().iter().filter(|case| only.is_none_or(|only| case.name.contains(only))) {
        let (tuples, expected) = (case.run(), (case.by_hand)());
        assert_eq!(tuples, expected, "{}: both find the same", case.name);
        let (mut rules, mut by_hand) = (Duration::MAX, Duration::MAX);
        // Turn about, so that other load on the machine meets both.
        for _ in 0..3 {
            rules = rules.min(timed(|| case.run()));
            by_hand = by_hand.min(timed(|| (case.by_hand)()));
        }
        let (rules, by_hand) = (rules.as_secs_f64() * 1e3, by_hand.as_secs_f64() * 1e3);
        table += &format!(
            "| {} | {tuples} | {by_hand:.1} | {rules:.1} | {:.2} |\n",
            case.name,
            rules / by_hand
        );
    }
    eprintln!("{table}");
}

/// Processor time, so that other load on the machine counts little.
fn timed(run: impl Fn() -> usize) -> Duration {
    // The system counts in ticks of several milliseconds.
    let (start, mut runs) = (processor_time(), 0);
    loop {
        black_box(run());
        runs += 1;
        let spent = processor_time() - start;
        if spent >= Duration::from_millis(100) {
            return spent / runs;
        }
    }
}

/// Of this thread; the time of day where the system does not tell.
fn processor_time() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanos = told.and_then(|text| text.split_whitespace().next()?.parse().ok());
    nanos.map_or_else(|| START.elapsed(), Duration::from_nanos)
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    if let Some(at) = args.iter().position(|arg| arg == "--quick-table") {
        quick_table(args.get(at + 1).map(String::as_str).filter(|arg| !arg.starts_with('-')));
        return;
    }
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    for case in cases() {
        let mut group = criterion.benchmark_group(case.name);
        group.bench_function("rules", |bencher| bencher.iter(|| case.run()));
        group.bench_function("by hand", |bencher| bencher.iter(|| (case.by_hand)()));
        group.finish();
    }
    criterion.final_summary();
}

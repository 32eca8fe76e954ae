//! Rules read at run time against the same programs written by hand on datafrog and compiled by `ascent`.
//!
//! `cargo bench -p benches --bench datalog` measures all cases with criterion; `… -- --table [NAME]` prints the table of
//! `benches/README.md`: every program on every engine in a process of its own, for time and for memory.
//! `… -- --threads [NAME]` prints the table of one thread against two, `… -- --questions` that of questions.

#[path = "datalog/by_hand.rs"]
mod by_hand;
#[path = "datalog/inputs.rs"]
mod inputs;
#[path = "datalog/on_ascent.rs"]
mod on_ascent;
#[path = "datalog/programs.rs"]
mod programs;

use std::hint::black_box;
use std::process::Command;
use std::time::{Duration, Instant};

use cpu_time::ThreadTime;
use criterion::Criterion;
use inputs::{Box8, Edge};
use orthoframe_facts::{Database, Limits, Program};
use orthoframe_units::Source;

/// What evaluates a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Engine {
    Rules,
    /// The rules again, and on top what is needed to ask why of any tuple.
    Explained,
    ByHand,
    Ascent,
}

impl Engine {
    const ALL: [Self; 4] = [Self::Rules, Self::Explained, Self::ByHand, Self::Ascent];

    fn name(self) -> &'static str {
        match self {
            Self::Rules => "rules",
            Self::Explained => "explained",
            Self::ByHand => "by-hand",
            Self::Ascent => "ascent",
        }
    }
}

/// A program's input; which program it is for.
enum Case {
    Closure(Vec<Edge>),
    SameGeneration(Vec<Edge>),
    ThreeWay([Vec<Edge>; 3]),
    Counts(Vec<Edge>),
    Spatial(Vec<Box8>, Vec<Edge>),
}

const CASES: [&str; 9] = [
    "chain 4000",
    "grid 70",
    "random 4000",
    "same generation 11",
    "three-way join",
    "negation, count",
    "spatial 100000",
    "spatial hospital 50000",
    "spatial 30000 x 300",
];

/// Of fewer than ten thousand rows or so: here a second thread must cost nothing.
const SMALL: [&str; 6] =
    ["chain 130", "grid 12", "random 100", "spatial 400", "three-way 2000", "counts 3000"];

impl Case {
    fn of(name: &str) -> Self {
        let dense = |seed| inputs::random(20_000, 100_000, seed);
        let spatial = |(boxes, doors)| Self::Spatial(boxes, doors);
        match name {
            "chain 4000" => Self::Closure(inputs::chain(4000)),
            "grid 70" => Self::Closure(inputs::grid(70)),
            "random 4000" => Self::Closure(inputs::random(4000, 8000, 1)),
            "same generation 11" => Self::SameGeneration(inputs::tree(11)),
            "three-way join" => Self::ThreeWay([dense(5), dense(6), dense(7)]),
            "negation, count" => Self::Counts(inputs::random(100_000, 200_000, 8)),
            "spatial 100000" => spatial(inputs::boxes(100_000, 50, 7)),
            "spatial hospital 50000" => spatial(inputs::boxes(50_000, 50, 7)),
            "spatial 30000 x 300" => spatial(inputs::boxes(30_000, 300, 7)),
            "chain 130" => Self::Closure(inputs::chain(130)),
            "grid 12" => Self::Closure(inputs::grid(12)),
            "random 100" => Self::Closure(inputs::random(100, 200, 1)),
            "spatial 400" => spatial(inputs::boxes(400, 50, 7)),
            "three-way 2000" => {
                Self::ThreeWay([5, 6, 7].map(|seed| inputs::random(400, 2_000, seed)))
            }
            "counts 3000" => Self::Counts(inputs::random(2_000, 3_000, 8)),
            other => {
                panic!("no program «{other}»; there are {}, {}", CASES.join(", "), SMALL.join(", "))
            }
        }
    }

    /// What evaluates the case on an engine and counts the derived tuples; the input is at hand in the engine's form.
    fn on(self, engine: Engine) -> Box<dyn Fn() -> usize> {
        if matches!(engine, Engine::Rules | Engine::Explained) {
            let rules = Rules::of(self);
            return Box::new(move || rules.run(engine == Engine::Explained));
        }
        let by_hand = engine == Engine::ByHand;
        Box::new(move || match &self {
            Self::Closure(e) if by_hand => by_hand::closure(e),
            Self::Closure(e) => on_ascent::closure(e),
            Self::SameGeneration(e) if by_hand => by_hand::same_generation(e),
            Self::SameGeneration(e) => on_ascent::same_generation(e),
            Self::ThreeWay([r, s, t]) if by_hand => by_hand::three_way(r, s, t),
            Self::ThreeWay([r, s, t]) => on_ascent::three_way(r, s, t),
            Self::Counts(e) if by_hand => by_hand::counts(e),
            Self::Counts(e) => on_ascent::counts(e),
            Self::Spatial(boxes, doors) if by_hand => by_hand::spatial(boxes, doors),
            Self::Spatial(boxes, doors) => on_ascent::spatial(boxes, doors),
        })
    }
}

/// A program as rule text with its database.
struct Rules {
    program: Program,
    database: Database,
}

impl Rules {
    fn of(case: Case) -> Self {
        let text = match &case {
            Case::Closure(_) => programs::CLOSURE,
            Case::SameGeneration(_) => programs::SAME_GENERATION,
            Case::ThreeWay(_) => programs::THREE_WAY,
            Case::Counts(_) => programs::COUNTS,
            Case::Spatial(..) => programs::SPATIAL,
        };
        let source = Source::new("bench.dl", text);
        let program = Program::parse(&source).expect("the benchmark's program is sound");
        let mut rules = Self { database: program.database(), program };
        match case {
            Case::Closure(edges) | Case::Counts(edges) => rules.insert_edges("edge", edges),
            Case::SameGeneration(edges) => rules.insert_edges("parent", edges),
            Case::ThreeWay(all) => {
                ["r", "s", "t"].into_iter().zip(all).for_each(|(name, edges)| {
                    rules.insert_edges(name, edges);
                });
            }
            Case::Spatial(boxes, doors) => {
                rules.insert("box", boxes.into_iter());
                rules.insert_edges("door", doors);
            }
        }
        rules
    }

    fn insert_edges(&mut self, relation: &str, edges: Vec<Edge>) {
        self.insert(relation, edges.into_iter().map(|(a, b)| [a.into(), b.into()]));
    }

    fn insert<const N: usize>(&mut self, relation: &str, tuples: impl Iterator<Item = [i64; N]>) {
        let relation = self.program.relation(relation).expect("the program declares its input");
        let mut loader = self.database.load();
        let mut values = Vec::new();
        for tuple in tuples {
            values.clear();
            values.extend(tuple.iter().map(|number| loader.number(*number)));
            loader.push(relation, &values).expect("the benchmark's input fits");
        }
        loader.finish();
    }

    /// Derived tuples, input left out; in one thread, as the other engines.
    fn run(&self, is_explained: bool) -> usize {
        self.run_in(1, is_explained)
    }

    fn run_in(&self, threads: usize, is_explained: bool) -> usize {
        let limits = Limits { threads, ..Limits::default() };
        let derived = self.program.evaluate_within(&self.database, limits);
        let derived = derived.expect("the benchmark's program is finite");
        if is_explained {
            black_box(derived.explain());
        }
        let sizes = self.program.relations().map(|(id, info)| {
            let is_counted = info.inputs.is_empty() && info.name != "target";
            if is_counted { derived.len(id).expect("the relation is declared") } else { 0 }
        });
        sizes.sum()
    }
}

/// Processor time of one run, the median of at least five.
fn median(run: &dyn Fn() -> usize) -> Duration {
    let mut times = Vec::new();
    let mut spent = Duration::ZERO;
    while times.len() < 5 || spent < Duration::from_secs(1) && times.len() < 101 {
        let start = ThreadTime::now();
        black_box(run());
        times.push(start.elapsed());
        spent += start.elapsed();
    }
    times.sort_unstable();
    times[times.len() / 2]
}

/// The most memory that this process has held, in KiB; 0 where the system does not tell.
fn peak_memory() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    line.and_then(|line| line.split_whitespace().nth(1)?.parse().ok()).unwrap_or(0)
}

/// What a process measured: derived tuples, milliseconds of processor time, MiB after one evaluation.
#[derive(Debug, Clone, Copy)]
struct Figures {
    tuples: usize,
    ms: f64,
    mib: f64,
}

/// In the child process.
fn measure(case: &str, engine: Engine) -> String {
    let run = Case::of(case).on(engine);
    // Makes the system count the peak anew, so that the making of the input does not count.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    let tuples = run();
    let peak = peak_memory();
    format!("{tuples} {} {peak}", median(&*run).as_secs_f64() * 1e3)
}

/// Measures in a process of its own, so that one engine's memory is not the other's.
fn in_process(case: &str, engine: Engine) -> Figures {
    let program = std::env::current_exe().expect("a running benchmark has a file");
    let child = Command::new(program).args(["--measure", case, engine.name()]).output();
    let child = child.expect("the benchmark starts itself");
    let told = String::from_utf8_lossy(&child.stdout);
    let mut fields = told.split_whitespace().map(|field| {
        field.parse::<f64>().unwrap_or_else(|_| panic!("{case} on {}: {told}", engine.name()))
    });
    let mut next = || fields.next().unwrap_or_else(|| panic!("{case}: {child:?}"));
    Figures { tuples: next() as usize, ms: next(), mib: next() / 1024.0 }
}

/// One thread against two: the middle of runs in turn on the clock, which needs two free cores, and the most memory.
#[expect(clippy::print_stdout, reason = "a benchmark prints its table")]
fn threads(only: Option<&str>) {
    println!("| program | one thread, ms | two, ms | one of two | one, MiB | two, MiB |");
    println!("|---|---|---|---|---|---|");
    let all = CASES.iter().map(|case| (case, 9)).chain(SMALL.iter().map(|case| (case, 1001)));
    for (case, runs) in all.filter(|(case, _)| only.is_none_or(|only| case.contains(only))) {
        let rules = Rules::of(Case::of(case));
        let mut times = [const { Vec::new() }; 2];
        for _ in 0..runs {
            for (threads, times) in (1..).zip(&mut times) {
                let start = Instant::now();
                black_box(rules.run_in(threads, false));
                times.push(start.elapsed().as_secs_f64() * 1e3);
            }
        }
        let [one, two] = times.map(|mut times| {
            times.sort_by(f64::total_cmp);
            times[runs / 2]
        });
        let memory = ["1", "2"].map(|threads| {
            let program = std::env::current_exe().expect("a running benchmark has a file");
            let child = Command::new(program).args(["--memory", case, threads]).output();
            let told = child.expect("the benchmark starts itself").stdout;
            String::from_utf8_lossy(&told).trim().parse::<f64>().unwrap_or(f64::NAN) / 1024.0
        });
        println!(
            "| {case} | {one:.3} | {two:.3} | {:.2} | {:.0} | {:.0} |",
            one / two,
            memory[0],
            memory[1]
        );
    }
}

/// In the child process: the most memory of one evaluation, KiB.
fn memory(case: &str, threads: usize) -> usize {
    let rules = Rules::of(Case::of(case));
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    black_box(rules.run_in(threads, false));
    peak_memory()
}

/// Questions of two joins over a hospital of 40 000 things: over what is stored alone, the first that a database is asked
/// and later ones, and over the result.
#[expect(clippy::print_stdout, reason = "a benchmark prints its table")]
fn questions() {
    let (boxes, doors) = inputs::boxes(40_000, 50, 7);
    let make = || Rules::of(Case::Spatial(boxes.clone(), doors.clone()));
    let (rules, fresh) = (make(), [(); 9].map(|()| make()));
    let derived = rules.program.evaluate(&rules.database).expect("it is finite");
    println!(
        "| question | answers | the first by demand, ms | by demand, ms | over the result, ms |"
    );
    println!("|---|---|---|---|---|");
    for question in [
        "?- on_top_of(X, Y), near(Y, 1203)",
        "?- near(20011, X), on_top_of(Y, X), touching(Y, Z)",
        "?- supported_by(X, Y), near(Y, 777), !clear(Y)",
        "?- on_top_of(X, 40), N = count : { near(X, _) } .order N desc",
        "?- reach(7, R), box(X, R, _, _, _, _, 0, H), H > 85, isolated(X)",
    ] {
        let source = Source::new("?", question);
        let time = |ask: &dyn Fn() -> usize| {
            let start = ThreadTime::now();
            black_box(ask());
            start.elapsed().as_secs_f64() * 1e3
        };
        let middle = |mut times: Vec<f64>| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        };
        let ask = |rules: &Rules, database: &Database| {
            let answers = rules.program.ask(database, &source);
            answers.expect("the question is sound").rows().len()
        };
        let of_stored = || ask(&rules, &rules.database);
        // A copy of a database that was not asked has no indexes yet.
        let first = fresh.iter().map(|one| {
            let database = one.database.clone();
            time(&|| ask(one, &database))
        });
        let first = middle(first.collect());
        let of_result = || derived.ask(&source).expect("the question is sound").rows().len();
        assert_eq!(of_stored(), of_result(), "{question}");
        let often = |ask: &dyn Fn() -> usize| middle((0..41).map(|_| time(ask)).collect());
        let (stored, result) = (often(&of_stored), often(&of_result));
        println!("| `{question}` | {} | {first:.3} | {stored:.3} | {result:.3} |", of_result());
    }
}

#[expect(clippy::print_stdout, reason = "a benchmark prints its table")]
fn table(only: Option<&str>) {
    println!(
        "| program | tuples | rules, ms | by hand, ms | ascent, ms | of by hand | of ascent | explained, of rules | rules, MiB | by hand, MiB | ascent, MiB | of by hand |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    let [mut of_hand, mut of_ascent, mut of_memory, mut of_rules] = [const { Vec::new() }; 4];
    for case in CASES.iter().filter(|case| only.is_none_or(|only| case.contains(only))) {
        let [rules, explained, by_hand, ascent] =
            Engine::ALL.map(|engine| in_process(case, engine));
        assert_eq!(rules.tuples, by_hand.tuples, "{case}: both find the same");
        assert_eq!(rules.tuples, ascent.tuples, "{case}: ascent finds the same");
        of_hand.push(rules.ms / by_hand.ms);
        of_ascent.push(rules.ms / ascent.ms);
        of_memory.push(rules.mib / by_hand.mib);
        of_rules.push(explained.ms / rules.ms);
        println!(
            "| {case} | {} | {:.1} | {:.1} | {:.1} | {:.2} | {:.2} | {:.2} | {:.0} | {:.0} | {:.0} | {:.2} |",
            rules.tuples,
            rules.ms,
            by_hand.ms,
            ascent.ms,
            rules.ms / by_hand.ms,
            rules.ms / ascent.ms,
            explained.ms / rules.ms,
            rules.mib,
            by_hand.mib,
            ascent.mib,
            rules.mib / by_hand.mib
        );
    }
    let middle = |mut ratios: Vec<f64>| {
        ratios.sort_by(f64::total_cmp);
        ratios[ratios.len() / 2]
    };
    println!(
        "| *median* | | | | | {:.2} | {:.2} | {:.2} | | | | {:.2} |",
        middle(of_hand),
        middle(of_ascent),
        middle(of_rules),
        middle(of_memory)
    );
}

#[expect(clippy::print_stdout, reason = "the parent process reads it")]
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, case, engine] = args.as_slice()
        && flag == "--measure"
    {
        let engine = Engine::ALL.into_iter().find(|known| known.name() == engine);
        println!("{}", measure(case, engine.expect("the parent names one of the engines")));
        return;
    }
    if let [flag, case, threads] = args.as_slice()
        && flag == "--memory"
    {
        println!("{}", memory(case, threads.parse().expect("the parent gives a number")));
        return;
    }
    let name = |at: usize| args.get(at + 1).map(String::as_str).filter(|arg| !arg.starts_with('-'));
    for (flag, print) in [("--table", table as fn(Option<&str>)), ("--threads", threads)] {
        if let Some(at) = args.iter().position(|arg| arg == flag) {
            print(name(at));
            return;
        }
    }
    if args.iter().any(|arg| arg == "--questions") {
        questions();
        return;
    }
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    for case in CASES {
        let mut group = criterion.benchmark_group(case);
        for engine in Engine::ALL {
            let run = Case::of(case).on(engine);
            group.bench_function(engine.name(), |bencher| bencher.iter(&run));
        }
        group.finish();
    }
    criterion.final_summary();
}

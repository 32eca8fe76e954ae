//! Datalog programs as other people write them: `tests/golden/datalog/<case>/program.dl` with its files of facts, and
//! what comes of it – sizes, files written, or faults with their places.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use orthoframe_facts::{FilesError, Limits, Program, run_files};
use orthoframe_units::Source;

#[test]
fn golden_programs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/datalog");
    let mut cases: Vec<PathBuf> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.sort();
    assert!(!cases.is_empty());
    for case in cases {
        let expected = case.join("expected.txt");
        if !expected.exists() {
            std::fs::write(&expected, "").unwrap();
        }
        expect_test::expect_file![&expected].assert_eq(&outcome(&case, Limits::default()));
    }
}

/// Whatever the limits, a program comes to its result or to the limit.
#[test]
fn golden_programs_within_narrow_limits() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/datalog");
    let mut limited = 0;
    for case in std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
        let expected = std::fs::read_to_string(case.join("expected.txt")).unwrap();
        let (short, small) = (Duration::ZERO, 1 << 12);
        for (time, memory_bytes) in
            [(short, usize::MAX), (Duration::MAX, small), (Duration::MAX, 4 * small)]
        {
            let found = outcome(&case, Limits { time, memory_bytes, ..Limits::default() });
            let is_limit = found.contains(" с отношение «") || found.contains(" МиБ памяти");
            assert!(is_limit || found == expected, "{}: {found}", case.display());
            limited += usize::from(is_limit);
        }
    }
    assert!(limited > 10, "{limited}");
}

/// Programs that would take all time or all memory: an endless count, a product of everything, a range without end,
/// a text that grows.
#[test]
fn a_program_without_end_is_stopped_by_time_or_memory() {
    let many: String = (0..6000).map(|n| format!("a({n}). ")).collect();
    let of_all = format!(
        ".decl b(x: number, y: number, z: number)\n{many}\nb(X, Y, Z) :- a(X), a(Y), a(Z)."
    );
    let quiet =
        format!(".decl b(x: number)\n{many}\nb(X) :- a(X), a(Y), a(Z), a(W), X + Y + Z + W = -1.");
    let counted = format!(
        ".decl b(x: number)\n{many}\nb(N) :- N = count : {{ a(X), a(Y), a(Z), X + Y + Z < 0 }}."
    );
    let programs = [
        ".decl b(x: number)\nb(0).\nb(X + 1) :- b(X).",
        ".decl b(x: number)\nb(0).\nb(X + 3000000000) :- b(X).",
        ".decl b(x: number)\nb(X) :- X = range(0, 4294967295).",
        ".decl b(x: number)\nb(X) :- X = range(-9223372036854775807, 9223372036854775807, 2).",
        ".decl b(x: symbol)\nb(\"да\").\nb(cat(X, \"нет\")) :- b(X).\nb(cat(\"то\", X)) :- b(X).",
        &of_all,
        &quiet,
        &counted,
    ];
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("program.dl");
    for text in programs {
        std::fs::write(&program, format!(".decl a(x: number)\n{text}\n.output b\n")).unwrap();
        let all = Limits::default();
        for (limits, code) in [
            (
                Limits {
                    time: Duration::from_millis(300),
                    memory_bytes: usize::MAX,
                    ..all.clone()
                },
                "за 0.3 с",
            ),
            (Limits { time: Duration::from_secs(2), memory_bytes: 1 << 22, ..all }, "4 МиБ памяти"),
        ] {
            let started = Instant::now();
            let fault = run_files(&program, folder.path(), folder.path(), limits).unwrap_err();
            assert!(matches!(fault, FilesError::Evaluate(_)), "{text}: {fault}");
            let told = fault.to_string();
            // What makes nothing takes no memory, and ends by time all the same.
            assert!(told.contains(code) || told.contains("за 2 с"), "{told}");
            assert!(told.contains("program.dl:") && told.contains("«b»"), "{told}");
            assert!(started.elapsed() < Duration::from_secs(20), "{text}");
        }
    }
}

/// Types in chains of any order and kind: each is looked at once.
#[test]
fn long_chains_of_types_end() {
    const LENGTH: usize = 20_000;
    let below: Vec<String> = (1..=LENGTH).map(|n| format!(".type T{n} <: T{}\n", n - 1)).collect();
    let chains: [(String, &str); 5] = [
        (below.concat(), "symbol"),
        (below.iter().rev().map(String::as_str).collect(), "symbol"),
        ((1..=LENGTH).map(|n| format!(".type T{n} = T{}\n", n - 1)).collect(), "symbol"),
        ((1..=LENGTH).map(|n| format!(".type T{n} = T{} | U\n", n - 1)).collect(), "symbol"),
        ((1..=LENGTH).map(|n| format!(".type T{n} = number | T{}\n", n - 1)).collect(), "number"),
    ];
    for (chain, base) in chains {
        let text = format!(
            ".type T0 <: {base}\n.type U <: {base}\n{chain}.decl a(x: T{LENGTH})\n.decl b(x: T{LENGTH})\nb(X) :- a(X).\n"
        );
        let program = Program::parse(&Source::new("t.dl", text));
        assert!(program.is_ok(), "{}", program.unwrap_err());
    }
}

#[test]
fn a_type_declared_twice_is_a_fault() {
    for second in ["<: symbol", "<: number", "= number | B", "<: A"] {
        let text = format!(
            ".type B <: number\n.type A <: symbol\n.type A {second}\n.type C <: A\n.decl a(x: A, y: C)\n.output a\na(\"x\", \"y\").\n"
        );
        let faults = Program::parse(&Source::new("t.dl", text)).unwrap_err();
        let placed: Vec<_> = faults.files.iter().flat_map(|file| file.placed()).collect();
        assert!(placed.iter().any(|(line, ..)| *line == 3), "{second}: {faults}");
        assert!(faults.to_string().contains("«A»") || !placed.is_empty(), "{faults}");
    }
}

fn outcome(case: &Path, limits: Limits) -> String {
    let out = tempfile::tempdir().unwrap();
    let mut shown = String::new();
    let warnings = match run_files(&case.join("program.dl"), case, out.path(), limits) {
        Ok(report) => {
            for (relation, size) in &report.sizes {
                let _ = writeln!(shown, "{relation}\t{size}");
            }
            shown += &report.printed;
            let mut files: Vec<PathBuf> =
                std::fs::read_dir(out.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
            files.sort();
            assert_eq!(files.len(), report.written.len());
            for file in files {
                let name = file.file_name().unwrap().to_string_lossy().into_owned();
                let _ = write!(shown, "── {name}\n{}", std::fs::read_to_string(&file).unwrap());
            }
            report.warnings
        }
        Err(FilesError::Program(faults)) => faults.files,
        Err(other) => {
            let _ = writeln!(
                shown,
                "{}",
                other.to_string().replace(&format!("{}/", case.display()), "")
            );
            Vec::new()
        }
    };
    for (line, column, fault) in warnings.iter().flat_map(|file| file.placed()) {
        let _ = writeln!(shown, "{line}:{column} {fault}");
    }
    shown
}

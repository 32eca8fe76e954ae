//! Facts that are read from files, and results that are written into them.

use orthoframe_facts::{FactError, FilesError, FilesReport, Limits, run_files};

const PROGRAM: &str = r#"
.decl дверь(a: symbol, b: symbol, см: number)
.input дверь(filename="двери.tsv")
.decl путь(a: symbol, b: symbol) = way
.output путь
.printsize путь
путь(A, B) :- дверь(A, B, W), W >= 60.
путь(A, C) :- путь(A, B), дверь(B, C, W), W >= 60.
"#;

fn run(facts: &str) -> (Result<FilesReport, FilesError>, String) {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("программа.dl");
    std::fs::write(&program, PROGRAM).unwrap();
    std::fs::write(folder.path().join("двери.tsv"), facts).unwrap();
    let report = run_files(&program, folder.path(), folder.path(), Limits::default());
    let written = std::fs::read_to_string(folder.path().join("путь.csv")).unwrap_or_default();
    (report, written)
}

/// A record's commas are its own, also where commas part the columns.
#[test]
fn records_stand_whole_in_files_parted_by_commas() {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("program.dl");
    let text = r#"
            .type P = [n: number, t: symbol]
            .type T = Leaf {} | Node {l: T, n: number}
            .decl a(s: symbol, p: P, t: T, q: P)
            .input a(delimiter=",") .input a(delimiter=", ", filename="b.facts")
            .decl out(s: symbol, p: P, t: T, q: P) .output out
            out(S, P, T, Q) :- a(S, P, T, Q)."#;
    std::fs::write(&program, text).unwrap();
    let one = "x[,[1, a], $Node($Node($Leaf, 2),3) ,nil\n";
    std::fs::write(folder.path().join("a.facts"), one).unwrap();
    std::fs::write(folder.path().join("b.facts"), "y, [2, b], $Leaf, [3, \"c], d\"]\n").unwrap();
    run_files(&program, folder.path(), folder.path(), Limits::default()).unwrap();
    let written = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    let all = "x[\t[1, a]\t$Node($Node($Leaf, 2), 3)\tnil\ny\t[2, b]\t$Leaf\t[3, c], d]\n";
    assert_eq!(written, all);
    std::fs::write(folder.path().join("a.facts"), "x,[1, a,$Leaf,nil\n").unwrap();
    let fault = run_files(&program, folder.path(), folder.path(), Limits::default());
    assert!(matches!(fault, Err(FilesError::Line { line: 1, .. })));
}

/// What is written in quotes is read again as it was: texts with any sign, alone and within records.
#[test]
fn quoted_files_are_read_as_they_were_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let text = r#"
            .type P = [n: number, t: symbol, rest: P]
            .type T = Leaf {} | Node {t: symbol, n: number}
            .decl a(s: symbol, n: number, p: P, t: T, f: float)
            .input a(rfc4180=true)
            .output a(rfc4180=true, filename="out.facts")"#;
    std::fs::write(at("program.dl"), text).unwrap();
    let given = r#"x,1,nil,$Leaf,1.5
"a,""b
c",-2,"[1, ""]\""\\"", [2, , nil]]","$Node( """" ,3)",0
"#;
    std::fs::write(at("a.facts"), given).unwrap();
    run_files(&at("program.dl"), folder.path(), folder.path(), Limits::default()).unwrap();
    let written = std::fs::read_to_string(at("out.facts")).unwrap();
    let all = r#""a,""b
c",-2,"[1, ""]\""\\"", [2, """", nil]]","$Node("""", 3)",0
"x",1,"nil","$Leaf",1.5
"#;
    assert_eq!(written, all);
    std::fs::rename(at("out.facts"), at("a.facts")).unwrap();
    run_files(&at("program.dl"), folder.path(), folder.path(), Limits::default()).unwrap();
    assert_eq!(std::fs::read_to_string(at("out.facts")).unwrap(), written);
}

#[test]
fn facts_are_read_and_results_written() {
    let (report, written) = run("А\tБ\t80\nБ\tВ\t90\nВ\tГ\t50\n");
    assert_eq!(report.unwrap().sizes, [("путь".to_owned(), 3)]);
    assert_eq!(written, "А\tБ\nА\tВ\nБ\tВ\n");
}

#[test]
fn a_bad_line_is_named() {
    let (report, _) = run("А\tБ\t80\nБ\tВ\tшироко\n");
    let message = report.unwrap_err().to_string();
    assert!(
        message.ends_with("двери.tsv:2: «дверь», столбец «см»: нужен тип number, а дано «широко»"),
        "{message}"
    );
    let (report, _) = run("А\n");
    let Err(FilesError::Line { line, cause, .. }) = report else {
        panic!("a short line is refused")
    };
    assert!(line == 1 && matches!(*cause, FactError::Arity { .. }));
}

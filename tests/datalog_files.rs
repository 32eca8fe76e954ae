//! Datalog programs as other people write them: `tests/golden/datalog/<case>/program.dl` with its files of facts, and
//! what comes of it – sizes, files written, or faults with their places.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use orthoframe::facts::{FilesError, run_files};

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
        expect_test::expect_file![&expected].assert_eq(&outcome(&case));
    }
}

fn outcome(case: &Path) -> String {
    let out = tempfile::tempdir().unwrap();
    let mut shown = String::new();
    let warnings = match run_files(&case.join("program.dl"), case, out.path()) {
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

//! Files of the project, and the data of others beside it.

use std::path::PathBuf;

/// A file or folder of the project.
pub(crate) fn project(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Whether tests that can go on for long do so: with `ORTHOFRAME_LONG` set they try all that they know, else a sample of it.
pub(crate) fn long() -> bool {
    std::env::var_os("ORTHOFRAME_LONG").is_some()
}

/// A file or folder of the data that others made, in `../shared/data`. None, with a word, where it is not there; where
/// `CI` is set that is a failure.
#[expect(clippy::print_stdout, reason = "a test that was not made should say so")]
pub(crate) fn shared(name: &str) -> Option<PathBuf> {
    let path = project("../shared/data").join(name);
    if path.exists() {
        return Some(path);
    }
    assert!(std::env::var_os("CI").is_none(), "{} is missing", path.display());
    println!("skipped: {} is not there", path.display());
    None
}

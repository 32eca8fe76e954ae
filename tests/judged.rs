//! Programs of another make look at this one.

use std::process::Command;

/// Has a judge of another make, installed by `.ci/run`, look at the program. One that lacks what it needs leaves with 77.
#[expect(clippy::print_stdout, reason = "a test that was not made should say so")]
pub(crate) fn judged(program: &str, arguments: &[String]) {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root).env("PYTHONPATH", root.join("target/judges"));
    let Ok(done) = command.env_remove("ORTHO_STORE").env("ORTHO_LANG", "ru").output() else {
        assert!(std::env::var_os("CI").is_none(), "{program} is missing");
        return println!("skipped: there is no {program}");
    };
    let told = [done.stdout, done.stderr].concat();
    let told = String::from_utf8_lossy(&told);
    match done.status.code() {
        Some(0) => println!("{told}"),
        Some(77) => {
            assert!(std::env::var_os("CI").is_none(), "a judge is missing: {arguments:?}");
            println!("skipped: {arguments:?}");
        }
        _ => panic!("{told}"),
    }
}

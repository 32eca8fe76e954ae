//! What a shell and `man` know of the program, made from its own arguments.

use std::path::Path;

use clap::CommandFactory;
use clap_complete::Shell;

use super::args::{Arguments, Common};
use super::fault::Failure;
use super::{Answer, json, say};
use crate::units::InOrder as _;

/// The completion of a shell, on standard output.
pub(super) fn completions(shell: Shell) -> Result<Answer, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "ortho", &mut script);
    say(String::from_utf8_lossy(&script).trim_end())
}

/// A page for the program and for each command, in a folder that is made when it is not there.
pub(super) fn man(common: &Common, dir: &Path) -> Result<Answer, Failure> {
    let fault = |error: std::io::Error| Failure::file(dir, &error);
    std::fs::create_dir_all(dir).map_err(fault)?;
    clap_mangen::generate_to(Arguments::command(), dir).map_err(fault)?;
    let mut written = Vec::new();
    for entry in std::fs::read_dir(dir).map_err(fault)? {
        let path = entry.map_err(fault)?.path();
        if path.extension().is_some_and(|ending| ending == "1") {
            written.push(path.display().to_string());
        }
    }
    written.order();
    if common.json {
        return say(&json::written(&written).to_string());
    }
    say(&written.join("\n"))
}

//! `ortho`: the command line of orthoframe.

use std::process::ExitCode;

fn main() -> ExitCode {
    orthoframe::cli::run()
}

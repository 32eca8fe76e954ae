//! `-v`: what the program does inside, on standard error.

use std::io::IsTerminal;

use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::fmt;
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;

use super::fault::is_coloured;

/// Tells what is done from now on: steps and their times with one `-v`, what goes amiss and does no harm with two, all with
/// three. Of packages of others only what is wrong.
pub(super) fn tell(verbose: u8) {
    let level = match verbose {
        0 => return,
        1 => LevelFilter::INFO,
        2 => LevelFilter::DEBUG,
        _ => LevelFilter::TRACE,
    };
    let own = Targets::new().with_default(LevelFilter::WARN).with_target("orthoframe", level);
    let lines = fmt::layer()
        .with_writer(std::io::stderr)
        .with_ansi(is_coloured(std::io::stderr().is_terminal()))
        .compact();
    // One that is set already, by who calls the library, stays.
    let _ = tracing_subscriber::registry().with(lines).with(own).try_init();
}

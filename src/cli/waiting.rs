//! A sign on a terminal that something takes long: it moves, and tells the time that has passed, until the first word of
//! the answer.

use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::units::{Language, told};

/// What is done within this time needs no sign.
const PATIENCE: Duration = Duration::from_millis(700);
/// Between two pictures of the sign.
const TICK: Duration = Duration::from_millis(120);

/// The terminal is one, whoever writes to it.
static SIGN: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Begins to wait for the first word. What is no terminal is shown nothing.
pub(super) fn begin(language: Language) {
    if !std::io::stderr().is_terminal() {
        return;
    }
    let sign = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
    let text = told!(language, "working", spinner = "{spinner}", elapsed = "{elapsed}");
    sign.set_style(
        ProgressStyle::with_template(&text).expect("the template is a constant and sound"),
    );
    *SIGN.lock().unwrap_or_else(PoisonError::into_inner) = Some(sign);
    std::thread::spawn(|| {
        std::thread::sleep(PATIENCE);
        if let Some(sign) = &*SIGN.lock().unwrap_or_else(PoisonError::into_inner) {
            sign.set_draw_target(ProgressDrawTarget::stderr());
            sign.enable_steady_tick(TICK);
        }
    });
}

/// Takes the sign away.
pub(super) fn over() {
    if let Some(sign) = SIGN.lock().unwrap_or_else(PoisonError::into_inner).take() {
        sign.finish_and_clear();
    }
}

//! Signals that end the program, for what ends in good order: a search for a plan, a drive under way.

use signal_hook::consts::TERM_SIGNALS;
use signal_hook::flag;

use crate::units::Stop;

/// Raised by the first signal to end (Ctrl-C is one); the second ends the program at once.
pub(super) fn stopped_by_signals() -> Stop {
    let stop = Stop::new();
    for signal in TERM_SIGNALS {
        // In this order the first signal only raises the flag, and the second finds it raised. Where the system lets
        // no handler be set, the signal ends the program as it always did.
        let armed = flag::register_conditional_shutdown(*signal, 128 + signal, stop.flag());
        if armed.and_then(|_| flag::register(*signal, stop.flag())).is_err() {
            break;
        }
    }
    stop
}

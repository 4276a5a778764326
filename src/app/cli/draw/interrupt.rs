//! Ctrl-C and termination by the system.
//!
//! POV-Ray 3.7.0.10 handles SIGINT and SIGTERM alike: it stops, stores the finished pixels for `+C`, writes no picture
//! and ends with exit code 2. So does this program while it renders; a second signal ends it at once.

use super::report::say;
use crate::app::cli::options::settings::Settings;
use crate::base::options::CancelToken;

/// The exit code of a cancelled rendering.
pub(crate) const INTERRUPTED: u8 = 2;

/// Lets signals cancel a rendering from now on.
#[cfg(unix)]
pub(crate) fn cancel_on_signals(stop: &CancelToken) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::flag;
    for signal in [SIGINT, SIGTERM] {
        // In this order: the first signal finds the flag unset. Where the system refuses, signals kill the process as
        // usual.
        let _ = flag::register_conditional_shutdown(signal, i32::from(INTERRUPTED), stop.flag());
        let _ = flag::register(signal, stop.flag());
    }
}

/// Signals are left to the system.
#[cfg(not(unix))]
pub(crate) fn cancel_on_signals(_: &CancelToken) {}

/// Reports a cancelled rendering, and how to continue it. `resumable` is the number of pixels in the checkpoint.
pub(crate) fn report_cancelled(settings: &Settings, resumable: u64, of: u64) {
    if settings.verbosity.quiet {
        return;
    }
    match resumable {
        0 => say("povr: interrupted; nothing is saved"),
        _ => say(format_args!(
            "povr: interrupted; {resumable} of {of} pixels are saved: the same command with `+C` resumes"
        )),
    }
}

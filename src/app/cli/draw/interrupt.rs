//! Ctrl-C, and the wish of the system that the program ends.
//!
//! POV-Ray 3.7.0.10 answers SIGINT and SIGTERM alike: it stops, keeps what it has drawn for `+C`, writes no picture and
//! ends with exit code 2. So does this program while it draws; a second signal ends it at once.

use super::report::say;
use crate::app::cli::options::settings::Settings;
use crate::base::options::CancelToken;

/// The exit code of a drawing that was stopped.
pub(crate) const INTERRUPTED: u8 = 2;

/// Has the signals stop a drawing from now on. `tell` says what is kept at that moment.
#[cfg(unix)]
pub(crate) fn heed(stop: &CancelToken) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::flag;
    for signal in [SIGINT, SIGTERM] {
        // In this order: the first signal finds the flag unset. Where the system refuses, signals kill as ever.
        let _ = flag::register_conditional_shutdown(signal, i32::from(INTERRUPTED), stop.flag());
        let _ = flag::register(signal, stop.flag());
    }
}

/// Signals are left to the system.
#[cfg(not(unix))]
pub(crate) fn heed(_: &CancelToken) {}

/// Says that a drawing was stopped, and how to go on with it. `kept` is the number of pixels that can be gone on with.
pub(crate) fn tell(settings: &Settings, kept: u64, of: u64) {
    if settings.talk.quiet {
        return;
    }
    match kept {
        0 => say("povr: interrupted; nothing is kept"),
        _ => say(format_args!(
            "povr: interrupted; {kept} of {of} pixels are kept: the same command with `+C` goes on"
        )),
    }
}

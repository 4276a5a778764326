//! Limits of the system on this process.

/// Has a file that grows beyond `ulimit -f` refuse what is written to it, as a full disk does. By default the process
/// would be killed by the signal `SIGXFSZ`: without a message, and with a part of a picture left behind.
pub(crate) fn outlive_file_limit() {
    #[cfg(unix)]
    {
        use signal_hook::{consts::SIGXFSZ, flag};
        // A signal with a handler is not deadly, whatever the handler does. Where there can be none, all is as before.
        let _ = flag::register(SIGXFSZ, std::sync::Arc::default());
    }
}

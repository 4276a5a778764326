//! System limits of this process.

/// Makes writes beyond `ulimit -f` fail like those to a full disk. By default the process would be killed by the signal
/// `SIGXFSZ`: without a message, and leaving a part of a picture behind.
pub(crate) fn outlive_file_limit() {
    #[cfg(unix)]
    {
        use signal_hook::{consts::SIGXFSZ, flag};
        // A handled signal does not kill, whatever the handler does. If no handler can be installed, the default
        // remains.
        let _ = flag::register(SIGXFSZ, std::sync::Arc::default());
    }
}

//! Output files and message formats that options select.

use clap::ValueEnum;

/// The format of findings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MessageFormat {
    /// POV-Ray's line, for programs that look for it.
    Povray,
    /// The lines of the scene with what is wrong beside them.
    Human,
    /// One line each: `file:line:column: error: message`.
    Short,
    /// One object a line.
    Json,
}

/// The kinds of messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Everything: `+GA`.
    All,
    /// The scene's `#debug` output: `+GD`.
    Debug,
    /// Errors: `+GF`.
    Fatal,
    /// The scene and the render options: `+GR`.
    Render,
    /// Statistics of the rendering: `+GS`.
    Statistics,
    /// Warnings: `+GW`.
    Warning,
}

impl Stream {
    /// The default file of a stream.
    pub(crate) fn file(self) -> &'static str {
        match self {
            Stream::All => "alltext.out",
            Stream::Debug => "debug.out",
            Stream::Fatal => "fatal.out",
            Stream::Render => "render.out",
            Stream::Statistics => "stats.out",
            Stream::Warning => "warning.out",
        }
    }
}

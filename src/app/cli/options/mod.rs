//! Options: POV-Ray's switches, ini files, long options, and the settings that they amount to.

pub(super) mod arg_words;
pub(super) mod as_povray;
pub(crate) mod command_line;
pub(super) mod conf;
pub(super) mod created_ini;
pub(super) mod environment;
pub(super) mod error;
pub(super) mod ini;
pub(super) mod keys;
pub(super) mod long_options;
pub(crate) mod output_kinds;
pub(super) mod raw_args;
pub(super) mod safety;
pub(super) mod settings;
pub(super) mod switches;
pub(super) mod unknown;
pub(super) mod values;

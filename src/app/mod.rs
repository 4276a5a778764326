//! The programs: the command line, batches, convergence curves and comparisons.

pub mod batch;
pub mod cli;
pub mod compare;
pub mod curve;
pub(crate) mod page;
pub mod picture_file;
pub mod program;
pub(crate) mod server;
pub(crate) mod watchdog;
pub(crate) mod worker;

#[doc(hidden)]
pub use worker::read_replies;

//! Directives: declarations, conditions, loops, macros, includes and files.

pub(super) mod branches;
pub(super) mod data_file;
pub(super) mod declare;
pub(super) mod files;
pub(super) mod flow;
pub(super) mod hash;
pub(super) mod includes;
pub(super) mod loops;
pub(super) mod macros;
pub(crate) mod open_file;
pub(super) mod output_file;
pub(super) mod sealed;
pub(super) mod semicolon;

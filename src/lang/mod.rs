//! The scene language: runs a file's directives, macros and loops, and gives the scene it describes.

mod args;
mod array;
mod budget;
mod bulk;
mod color;
mod cursor;
mod data_file;
mod datetime;
mod declare;
mod expr;
mod files;
mod flow;
mod functions;
#[cfg(test)]
mod fuzz;
mod global_blocks;
mod hints;
mod limits;
mod macros;
mod object;
mod probe;
mod reader;
mod scope;
mod similar;
mod statement;
mod strings;
mod value;

pub use probe::{Blind, Probe};
pub use reader::Reading;

use crate::options::ReadOptions;
use crate::source::{FileId, Sources};
use reader::Reader;

/// Reads the scene in `file`, which `sources` holds; includes are searched there too. `trace` and `inside` find nothing.
///
/// All findings of the run are given, errors as far as reading can go on behind them.
#[must_use]
pub fn evaluate(file: FileId, sources: &mut Sources, options: &ReadOptions) -> Reading {
    evaluate_with(file, sources, options, &mut Blind)
}

/// As [`evaluate`]; `probe` answers what the scene asks about its own objects.
#[must_use]
pub fn evaluate_with(
    file: FileId,
    sources: &mut Sources,
    options: &ReadOptions,
    probe: &mut dyn Probe,
) -> Reading {
    match Reader::new(file, sources, options, probe) {
        Ok(mut reader) => {
            reader.enter_header();
            reader.statements();
            reader.finish()
        }
        Err(findings) => Reading {
            scene: None,
            findings,
            messages: String::new(),
            undrawn: Vec::new(),
            dependencies: sources.dependencies().to_vec(),
        },
    }
}

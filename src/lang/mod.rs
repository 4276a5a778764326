//! The scene language: runs a file's directives, macros and loops, and gives the scene it describes.

mod args;
mod array;
mod budget;
mod bulk;
mod color;
mod cursor;
mod declare;
mod expr;
mod flow;
mod functions;
#[cfg(test)]
mod fuzz;
mod hints;
mod limits;
mod macros;
mod object;
mod reader;
mod replay;
mod scope;
mod similar;
mod statement;
mod strings;
mod value;

pub use reader::Reading;

use crate::options::ReadOptions;
use crate::source::{FileId, Sources};
use reader::Reader;

/// Reads the scene in `file`, which `sources` holds; includes are searched there too.
///
/// All findings of the run are given, errors as far as reading can go on behind them.
#[must_use]
pub fn evaluate(file: FileId, sources: &mut Sources, options: &ReadOptions) -> Reading {
    match Reader::new(file, sources, options) {
        Ok(mut reader) => {
            reader.enter_header();
            reader.statements();
            reader.finish()
        }
        Err(findings) => Reading {
            scene: None,
            findings,
            messages: String::new(),
        },
    }
}

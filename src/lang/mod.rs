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
mod foreign;
mod functions;
#[cfg(test)]
mod fuzz;
mod hints;
mod limits;
mod macros;
mod object;
mod reader;
mod scope;
mod similar;
mod statement;
mod strings;
mod trace;
mod unclosed;
mod value;

pub use reader::Reading;

use crate::options::ReadOptions;
use crate::source::{Diagnostic, FileId, Sources};
use reader::Reader;

/// What reading says while it is at work.
#[derive(Clone, Copy, Debug)]
pub enum Heard<'a> {
    /// Text that the scene writes.
    Said(&'a str),
    /// A finding, with the texts it is about.
    Found(&'a Diagnostic, &'a Sources),
}

/// Reads the scene in `file`, which `sources` holds; includes are searched there too.
///
/// All findings of the run are given, errors as far as reading can go on behind them.
#[must_use]
pub fn evaluate(file: FileId, sources: &mut Sources, options: &ReadOptions) -> Reading {
    evaluate_aloud(file, sources, options, &mut |_| {})
}

/// [`evaluate`] that tells what it finds, and what the scene writes, as soon as that happens.
pub fn evaluate_aloud(
    file: FileId,
    sources: &mut Sources,
    options: &ReadOptions,
    listener: &mut dyn FnMut(Heard<'_>),
) -> Reading {
    match Reader::new(file, sources, options, listener) {
        Ok(mut reader) => {
            reader.enter_header();
            reader.statements();
            reader.finish()
        }
        Err(findings) => {
            for finding in &findings {
                listener(Heard::Found(finding, sources));
            }
            Reading {
                scene: None,
                findings,
                messages: String::new(),
            }
        }
    }
}

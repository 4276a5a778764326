//! The scene language: runs a file's directives, macros and loops, and gives the scene it describes.

mod budget;
mod cursor;
mod diagnose;
mod directive;
mod element;
mod expr;
mod fast_path;
#[cfg(test)]
mod fuzz;
mod limits;
mod probe;
mod reader;
mod scope;
pub mod syntax;
mod token_cache;

pub use probe::{Blind, Probe};
pub use reader::Reading;
pub use token_cache::Lexicon;

use crate::base::options::ReadOptions;
use crate::base::source::{Diagnostic, FileId, Sources};
use reader::Reader;

/// What reading says while it is at work.
#[derive(Clone, Copy, Debug)]
pub enum Heard<'a> {
    /// Text that the scene writes.
    Said(&'a str),
    /// A finding, with the texts it is about.
    Found(&'a Diagnostic, &'a Sources),
}

/// Reads the scene in `file`, which `sources` holds; includes are searched there too. `trace` and `inside` find nothing.
///
/// All findings of the run are given, errors as far as reading can go on behind them.
#[must_use]
pub fn evaluate(file: FileId, sources: &mut Sources, options: &ReadOptions) -> Reading {
    let texts = Texts {
        scene: file,
        sources,
        lexicon: None,
    };
    evaluate_with(texts, options, &mut Blind, &mut |_| {})
}

/// A scene to read, among the texts it is one of.
#[derive(Debug)]
pub struct Texts<'a> {
    /// The scene.
    pub scene: FileId,
    /// Its own text; files that it includes are searched and added there.
    pub sources: &'a mut Sources,
    /// What an earlier reading with a copy of these sources left, and where this one leaves what it makes; `None` for
    /// a scene that is read once.
    pub lexicon: Option<&'a mut Lexicon>,
}

/// As [`evaluate`]; `probe` answers what the scene asks about its own objects, and `listener` is told what is found,
/// and what the scene writes, as soon as that happens.
pub fn evaluate_with(
    texts: Texts<'_>,
    options: &ReadOptions,
    probe: &mut dyn Probe,
    listener: &mut dyn FnMut(Heard<'_>),
) -> Reading {
    let Texts {
        scene,
        sources,
        lexicon,
    } = texts;
    match Reader::new(scene, sources, lexicon, options, probe, listener) {
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
                undrawn: Vec::new(),
                has_learnt: false,
                dependencies: sources.dependencies().to_vec(),
            }
        }
    }
}

/// As [`evaluate`], but each token is read as often as reading gets to it: nothing is replayed.
#[cfg(test)]
fn evaluate_token_by_token(file: FileId, sources: &mut Sources, options: &ReadOptions) -> Reading {
    let (mut probe, mut listener) = (Blind, |_: Heard<'_>| {});
    match Reader::new(file, sources, None, options, &mut probe, &mut listener) {
        Ok(mut reader) => {
            reader.replays.forbid();
            reader.enter_header();
            reader.statements();
            reader.finish()
        }
        Err(findings) => panic!("no tokens: {findings:?}"),
    }
}

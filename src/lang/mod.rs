//! The scene language: runs the directives, macros and loops of a file and builds the scene it describes.

mod accounting;
mod budget;
mod cursor;
mod diagnose;
mod dialect;
mod directive;
mod draft;
mod element;
mod expr;
mod fast_path;
mod frame;
#[cfg(test)]
pub(crate) mod fuzz;
mod limits;
mod probe;
mod reader;
mod report;
mod scope;
mod statement_state;
pub mod syntax;
mod token_cache;

pub use fast_path::literal_cache::LiteralCache;
pub use probe::{NoProbe, Probe};
pub use reader::{ObjectSpan, Reading};
pub use token_cache::TokenCache;

use crate::base::options::ReadOptions;
use crate::base::source::{Diagnostic, FileId, Sources, TextChange};
use reader::Reader;

/// An event while a scene is read.
#[derive(Clone, Copy, Debug)]
pub enum ReadEvent<'a> {
    /// Text written by the scene.
    SceneOutput(&'a str),
    /// An error or warning, with the texts it refers to.
    Finding(&'a Diagnostic, &'a Sources),
}

/// Reads the scene in `file`, which `sources` holds; includes are searched and added there. `trace` and `inside` hit
/// nothing.
///
/// The result holds all findings; reading goes on after errors as far as it can.
#[must_use]
pub fn evaluate(file: FileId, sources: &mut Sources, options: &ReadOptions) -> Reading {
    let texts = Texts {
        scene: file,
        sources,
        token_cache: None,
        literals: None,
    };
    evaluate_with(texts, options, &mut NoProbe, &mut |_| {})
}

/// A scene to read, with the sources it belongs to.
#[derive(Debug)]
pub struct Texts<'a> {
    /// The scene.
    pub scene: FileId,
    /// The sources with the text of the scene; included files are added.
    pub sources: &'a mut Sources,
    /// Tokens cached by an earlier reading with a copy of these sources; new ones are added. `None` for a scene that is
    /// read once.
    pub token_cache: Option<&'a mut TokenCache>,
    /// Objects of the last reading of a scene whose text may have changed, perhaps none: those of this one are cached.
    pub literals: Option<LastLiterals<'a>>,
}

/// Objects of the last reading of a scene, and the change of its text since, if all changes are reported.
pub type LastLiterals<'a> = (&'a LiteralCache, Option<&'a TextChange>);

/// As [`evaluate`]; `probe` answers `trace` and `inside`, and `listener` receives the findings and the text written by
/// the scene as they occur.
pub fn evaluate_with(
    texts: Texts<'_>,
    options: &ReadOptions,
    probe: &mut dyn Probe,
    listener: &mut dyn FnMut(ReadEvent<'_>),
) -> Reading {
    let Texts {
        scene,
        sources,
        token_cache,
        literals,
    } = texts;
    match Reader::new(
        scene,
        sources,
        (token_cache, literals),
        options,
        probe,
        listener,
    ) {
        Ok(mut reader) => {
            reader.enter_header();
            reader.statements();
            reader.finish()
        }
        Err(findings) => {
            for finding in &findings {
                listener(ReadEvent::Finding(finding, sources));
            }
            Reading {
                scene: None,
                findings,
                messages: String::new(),
                undrawn: Vec::new(),
                has_new_tokens: false,
                camera: None,
                dependencies: sources.dependencies().to_vec(),
                object_spans: Vec::new(),
                literals: None,
            }
        }
    }
}

/// As [`evaluate`], but nothing is replayed: each token is read every time.
#[cfg(test)]
fn evaluate_token_by_token(file: FileId, sources: &mut Sources, options: &ReadOptions) -> Reading {
    let (mut probe, mut listener) = (NoProbe, |_: ReadEvent<'_>| {});
    match Reader::new(
        file,
        sources,
        (None, None),
        options,
        &mut probe,
        &mut listener,
    ) {
        Ok(mut reader) => {
            reader.replays.disable();
            reader.enter_header();
            reader.statements();
            reader.finish()
        }
        Err(findings) => panic!("no tokens: {findings:?}"),
    }
}

//! Parameter reading for scene elements, independent of the source: the parser's token cursor, a test, or a Rust
//! caller.

mod intern;
mod steps;
#[cfg(test)]
pub(crate) mod text;

pub use crate::base::word::Word;
pub use intern::{Interner, interned};
pub use steps::transform_step;

use crate::base::color::{Color, Gamma};
use crate::base::source::{Code, Diagnostic, Span};
use crate::base::version::{Novelty, is_for_3_8};
use glam::{DVec2, DVec3};
use std::any::{Any, TypeId};
use std::fmt::Debug;
use std::sync::Arc;

/// An object of a scene, for readers that do not know its type.
pub trait AnyObject: Any + Debug {}

impl<T: Any + Debug> AnyObject for T {}

impl dyn AnyObject + Send + Sync {
    /// The object itself, if it has this type.
    #[must_use]
    pub fn downcast<T: Any + Send + Sync>(self: Arc<Self>) -> Option<Arc<T>> {
        let object: Arc<dyn Any + Send + Sync> = self;
        object.downcast().ok()
    }
}

/// Result of reading: a value, or the diagnostic that ended it.
pub type Parse<T> = Result<T, Box<Diagnostic>>;

/// The value after the position of an entry of a `color_map`: its colour, or the second position of an old entry.
#[derive(Clone, Copy, Debug)]
pub enum ColorOrSingle {
    /// A colour.
    Color(Color),
    /// A number.
    Single(f32),
}

/// The parameters of one element, read from left to right.
///
/// Numbers, vectors and colours are whole expressions at the additive level. Commas between them are optional in the
/// language, so readers call [`Args::comma`] where one may stand.
pub trait Args {
    /// A number.
    fn float(&mut self) -> Parse<f64>;
    /// A number in single precision, for values that POV-Ray stores as `float`.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the caller asks for single precision"
    )]
    fn single(&mut self) -> Parse<f32> {
        self.float().map(|number| number as f32)
    }
    /// A number if one is next, otherwise `default`: `metallic`, `no_shadow off`.
    fn float_or(&mut self, default: f64) -> Parse<f64>;
    /// A vector of 2 components; a number sets both.
    fn vector2(&mut self) -> Parse<DVec2>;
    /// A vector of 3 components; a number sets all.
    fn vector(&mut self) -> Parse<DVec3>;
    /// A vector of 4 components; a number sets all.
    fn vector4(&mut self) -> Parse<[f64; 4]>;
    /// A colour in any form of the language.
    fn color(&mut self) -> Parse<Color>;
    /// A colour if one is next (a colour word, a colour identifier, `rgb`, a vector of 5 components).
    fn color_if_any(&mut self) -> Parse<Option<Color>>;
    /// A colour, also as an expression that begins with a number and ends with five components, as `0.5*Red`;
    /// otherwise a number in single precision.
    fn color_or_single(&mut self) -> Parse<ColorOrSingle> {
        match self.color_if_any()? {
            Some(color) => Ok(ColorOrSingle::Color(color)),
            None => self.single().map(ColorOrSingle::Single),
        }
    }
    /// A string.
    fn string(&mut self) -> Parse<String>;
    /// Returns the bytes of the file whose name was read last. The search tries the name itself, then the name with
    /// each of `endings` appended. `what` is "the picture" or the like.
    fn file_named(&mut self, what: &str, name: &str, endings: &[&str]) -> Parse<Arc<[u8]>> {
        let _ = endings;
        let message = format!("cannot find {what} `{name}`");
        Err(Box::new(Diagnostic::error(self.last_span(), message)))
    }
    /// Reads the name of a binary file and the file itself, as [`Args::file_named`] does.
    fn file(&mut self, what: &str, endings: &[&str]) -> Parse<(String, Arc<[u8]>)> {
        let _ = endings;
        Err(self.expected(&format!("the name of {what}")))
    }
    /// Reads `function W, H { ... }` as a picture if the next word is `function`.
    fn sampled_function(&mut self) -> Parse<Option<SampledFunction>> {
        Ok(None)
    }
    /// Reads an object. The value has the type of scene objects.
    fn object_any(&mut self) -> Parse<Arc<dyn AnyObject + Send + Sync>> {
        Err(self.expected("an object"))
    }
    /// Reads an object and the transforms that follow it, and applies them. An implementation that only holds the
    /// object's name may leave the transforms unread: nothing else reads them at this point.
    fn transformed_object_any(&mut self) -> Parse<Arc<dyn AnyObject + Send + Sync>> {
        self.object_any()
    }
    /// Reads a mesh with its modifiers. The value has the type of mesh instances.
    fn mesh_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        Err(self.expected("a mesh"))
    }
    /// Reads a blob or isosurface and the transforms that follow it. The value has the type of the fields of pattern
    /// `potential`; that of another object does not.
    fn field_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        Err(self.expected("a blob or isosurface"))
    }
    /// The gamma of the working colour space; `None` without gamma handling.
    fn working_gamma(&self) -> Option<Gamma> {
        Some(Gamma::LINEAR)
    }
    /// Fast path: reads vectors of `len` components written as literal numbers, each after an optional comma, until
    /// `take` returns false; that vector stays unread. May stop early or read nothing, so callers continue with
    /// [`Args::vector`].
    fn literal_vectors(&mut self, len: usize, take: &mut dyn FnMut(&[f64]) -> bool) {
        let _ = (len, take);
    }
    /// Fast path: reads a number after an optional comma, if it is a literal and no operator follows. `None` does not
    /// mean that there is no number: callers continue with [`Args::float`].
    fn literal_number(&mut self) -> Option<f64> {
        None
    }
    /// Reads the block that follows the word `texture`. Properties that the block does not set come from the default
    /// texture.
    fn texture_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        Err(self.expected("a texture"))
    }
    /// Skips a comma if it is next, and returns true if it was.
    fn comma(&mut self) -> Parse<bool>;
    /// Skips an optional comma; returns true if there was one, or if an expression is next.
    fn has_next_value(&mut self) -> Parse<bool> {
        Ok(self.comma()? || self.at_expression()?)
    }
    /// The next token if it is a reserved word, without taking it.
    fn word(&mut self) -> Parse<Option<Word>>;
    /// Takes the next token if it is this reserved word.
    fn accept(&mut self, word: Word) -> Parse<bool>;
    /// Takes the next token if it is this punctuation mark (`[`, `]`, `,`, `(`, ...).
    fn accept_mark(&mut self, mark: char) -> Parse<bool>;
    /// Returns true if the next token is this punctuation mark, without taking it.
    fn at_mark(&mut self, mark: char) -> Parse<bool>;
    /// Takes `{`.
    fn open(&mut self) -> Parse<()>;
    /// Takes `}` if it is next.
    fn accept_close(&mut self) -> Parse<bool>;
    /// Takes `}`. Any other token is an error that names it and the `{` that is still open.
    fn close(&mut self) -> Parse<()>;
    /// Returns true if a number, vector or expression can begin at the next token.
    fn at_expression(&mut self) -> Parse<bool>;
    /// If the next token is an identifier with a value of this Rust type, takes it and returns the value. [`declared`]
    /// is the typed form.
    fn declared_any(&mut self, kind: TypeId) -> Parse<Option<Arc<dyn Any + Send + Sync>>>;
    /// The value of this Rust type set by `#default`. [`default_of`] is the typed form.
    fn default_any(&self, _kind: TypeId) -> Option<Arc<dyn Any + Send + Sync>> {
        None
    }
    /// Reads the block after the word `function`. The module `scene::function` knows the type and calls this.
    ///
    /// # Errors
    /// A malformed function.
    fn function_any(&mut self) -> Parse<Option<Arc<dyn Any + Send + Sync>>> {
        Ok(None)
    }
    /// The cache for values that many objects have in common, if there is one.
    fn interner(&self) -> Option<&Interner> {
        None
    }
    /// Span of the next token.
    fn span(&mut self) -> Span;
    /// Span of the token taken last.
    fn last_span(&self) -> Span;
    /// The error "expected `what`, found ..." at the next token. `what` is in the author's words: "a vector after
    /// `location`".
    fn expected(&mut self, what: &str) -> Box<Diagnostic>;
    /// Records a warning.
    fn warn(&mut self, warning: Diagnostic);
    /// Warns of text that POV-Ray 3.7 refuses, except in scenes of later versions. The reason is POV-Ray's objection, the
    /// remedy a text that both read.
    fn refused_by_povray(&mut self, at: Span, reason: &str, remedy: &str) {
        if !self.is_for_3_8() {
            self.warn(Diagnostic::refused_by_povray(at, reason, remedy));
        }
    }
    /// The version whose rules for pictures and light apply: without `#version`, that of scenes from before 3.7.
    fn effective_version(&self) -> f64 {
        self.version()
    }
    /// Announces that `what` will take about this number of bytes.
    ///
    /// # Errors
    /// That much memory is not available.
    fn reserve_memory(&mut self, what: &str, bytes: u64, at: Span) -> Parse<()> {
        let _ = (what, bytes, at);
        Ok(())
    }
    /// The language version in force, as `#version` writes it: 3.7, 3.1.
    fn version(&self) -> f64;
    /// True if the scene is for POV-Ray 3.8: some `#version` of it is, wherever it stands.
    fn is_for_3_8(&self) -> bool {
        is_for_3_8(self.version())
    }
    /// Notes that the scene has something which POV-Ray 3.7 lacks.
    fn note_novelty(&mut self, novelty: Novelty) {
        let _ = novelty;
    }
}

/// Values of a function over the unit square, sampled as a picture.
#[derive(Clone, Debug)]
pub struct SampledFunction {
    /// Pixels in a row, at least 1.
    pub width: usize,
    /// Rows, at least 1. The first row is at `y = 0`.
    pub height: usize,
    /// The colours in row-major order, each channel quantised to 65536 steps from 0 to 1.
    pub colors: Vec<Color>,
    /// True for a scalar function, stored as one channel.
    pub is_grey: bool,
}

/// The value of the next token if it is an identifier declared as a `T`.
///
/// # Errors
/// A faulty directive before the next token.
pub fn declared<T: Any + Send + Sync>(args: &mut dyn Args) -> Parse<Option<Arc<T>>> {
    Ok(args
        .declared_any(TypeId::of::<T>())?
        .and_then(|value| value.downcast::<T>().ok()))
}

/// The value that `#default` sets for a type of element, or the default of the type.
pub fn default_of<T: Any + Send + Sync + Clone + Default>(args: &dyn Args) -> T {
    let known = args.default_any(TypeId::of::<T>());
    known
        .and_then(|value| value.downcast::<T>().ok())
        .map_or_else(T::default, |value| T::clone(&value))
}

/// The error for a word of the language that is not supported yet: "`spotlight` is not supported yet". Its span is that of
/// the next token if that is the word, otherwise that of the token taken last.
pub fn not_built(args: &mut dyn Args, word: Word) -> Box<Diagnostic> {
    let at = if matches!(args.word(), Ok(Some(next)) if next == word) {
        args.span()
    } else {
        args.last_span()
    };
    let error = Diagnostic::error(at, format!("`{word}` is not supported yet"));
    Box::new(error.with_code(Code::NotBuilt))
}

/// Skips a comma behind the last item of a list, which POV-Ray 3.8 allows.
pub(crate) fn trailing_comma(args: &mut dyn Args) -> Parse<()> {
    if args.is_for_3_8() && args.comma()? {
        args.note_novelty(Novelty::LastComma);
    }
    Ok(())
}

/// An error for a word, read last, that an element takes since version 3.8 only.
pub(crate) fn since_3_8(args: &mut dyn Args, word: Word, element: Word) -> Parse<()> {
    if args.is_for_3_8() {
        args.note_novelty(Novelty::Word(word));
        return Ok(());
    }
    let message = format!("`{word}` in `{element}` needs version 3.8");
    let error = Diagnostic::error(args.last_span(), message);
    Err(Box::new(
        error.with_hint("Begin the scene with `#version 3.8;`."),
    ))
}

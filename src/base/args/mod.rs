//! How an element reads its parameters, whoever holds them: the language's cursor over tokens, a test, a caller in Rust.

mod intern;
mod steps;
#[cfg(test)]
pub(crate) mod text;

pub use crate::base::word::Word;
pub use intern::{Interner, alike};
pub use steps::transform_step;

use crate::base::color::{Color, Gamma};
use crate::base::source::{Code, Diagnostic, Span};
use glam::{DVec2, DVec3};
use std::any::{Any, TypeId};
use std::sync::Arc;

/// What reading gives: a value, or the finding that ended it.
pub type Parse<T> = Result<T, Box<Diagnostic>>;

/// The parameters of one element, read from left to right.
///
/// Numbers, vectors and colours are whole expressions at the additive level; commas between them are optional in the
/// language, so readers call [`Args::comma`] where one may stand.
pub trait Args {
    /// A number.
    fn float(&mut self) -> Parse<f64>;
    /// A number in single precision, where POV-Ray keeps one so.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the caller asks for single precision"
    )]
    fn single(&mut self) -> Parse<f32> {
        self.float().map(|number| number as f32)
    }
    /// A number if one begins here, otherwise `default`: `metallic`, `no_shadow off`.
    fn float_or(&mut self, default: f64) -> Parse<f64>;
    /// A vector of two; a number stands for both components.
    fn vector2(&mut self) -> Parse<DVec2>;
    /// A vector of three; a number stands for all components.
    fn vector(&mut self) -> Parse<DVec3>;
    /// A vector of four; a number stands for all components.
    fn vector4(&mut self) -> Parse<[f64; 4]>;
    /// A colour in any form the language has.
    fn color(&mut self) -> Parse<Color>;
    /// A colour if one begins here (a colour word, a colour identifier, `rgb`, a vector of five).
    fn color_if_any(&mut self) -> Parse<Option<Color>>;
    /// A string.
    fn string(&mut self) -> Parse<String>;
    /// The bytes of the file whose name was taken last. It is searched by its name and then with each of `endings`
    /// appended; `what` is "the picture" or the like.
    fn file_named(&mut self, what: &str, name: &str, endings: &[&str]) -> Parse<Arc<[u8]>> {
        let _ = endings;
        let message = format!("cannot find {what} `{name}`");
        Err(Box::new(Diagnostic::error(self.last_span(), message)))
    }
    /// Reads the name of a file that holds no text, and the file as [`Args::file_named`].
    fn file(&mut self, what: &str, endings: &[&str]) -> Parse<(String, Arc<[u8]>)> {
        let _ = endings;
        Err(self.expected(&format!("the name of {what}")))
    }
    /// Reads `function W, H { ... }` as a picture, if `function` is the next word.
    fn sampled(&mut self) -> Parse<Option<Sampled>> {
        Ok(None)
    }
    /// Reads an object, as a value of the type of objects of scenes.
    fn object_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        Err(self.expected("an object"))
    }
    /// The same with the transforms behind it, which move it. Whoever holds no more than its name may leave them where they
    /// are: nothing else takes them there.
    fn moved_object_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        self.object_any()
    }
    /// Reads a mesh with its modifiers, as a value of the type of meshes in their places.
    fn mesh_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        Err(self.expected("a mesh"))
    }
    /// How numbers of colours relate to light here: `None` without gamma handling.
    fn working_gamma(&self) -> Option<Gamma> {
        Some(Gamma::LINEAR)
    }
    /// Takes vectors of `len` components that are written as literal numbers, each with an optional comma before it, as
    /// long as `take` wants them; the first it does not want is left where it is. May stop early, or take none at
    /// all: whoever calls this for speed reads on with [`Args::vector`].
    fn literal_vectors(&mut self, len: usize, take: &mut dyn FnMut(&[f64]) -> bool) {
        let _ = (len, take);
    }
    /// Takes a number, with an optional comma before it, if it is written as a literal and nothing can go on with it
    /// into an expression. `None` says nothing: whoever calls this for speed reads on with [`Args::float`].
    fn literal_number(&mut self) -> Option<f64> {
        None
    }
    /// Reads the block of a texture behind its word, as a value of the type of textures. What the block does not say is
    /// as in the default texture.
    fn texture_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        Err(self.expected("a texture"))
    }
    /// Passes a comma if one is next, and says whether.
    fn comma(&mut self) -> Parse<bool>;
    /// The next token if it is a reserved word; it is not taken.
    fn word(&mut self) -> Parse<Option<Word>>;
    /// Takes the next token if it is this reserved word.
    fn accept(&mut self, word: Word) -> Parse<bool>;
    /// Takes the next token if it is this punctuation mark (`[`, `]`, `,`, `(`, ...).
    fn accept_mark(&mut self, mark: char) -> Parse<bool>;
    /// Whether the next token is this punctuation mark; it is not taken.
    fn at_mark(&mut self, mark: char) -> Parse<bool>;
    /// Takes `{`.
    fn open(&mut self) -> Parse<()>;
    /// Takes `}` if it is next.
    fn accept_close(&mut self) -> Parse<bool>;
    /// Takes `}`; anything else is an error that names what was found and the `{` that is still open.
    fn close(&mut self) -> Parse<()>;
    /// Whether a number, vector or expression could begin at the next token.
    fn at_expression(&mut self) -> Parse<bool>;
    /// If the next token is an identifier that holds a value of this Rust type, takes it and gives the value.
    /// Use [`declared`], which knows the type.
    fn declared_any(&mut self, kind: TypeId) -> Parse<Option<Arc<dyn Any + Send + Sync>>>;
    /// What `#default` holds of this Rust type. Use [`default_of`], which knows the type.
    fn default_any(&self, _kind: TypeId) -> Option<Arc<dyn Any + Send + Sync>> {
        None
    }
    /// The function in the block that follows, which the word `function` has announced; the room `function` knows its
    /// type and reads it by this.
    ///
    /// # Errors
    /// A malformed function.
    fn function_any(&mut self) -> Parse<Option<Arc<dyn Any + Send + Sync>>> {
        Ok(None)
    }
    /// Where values are kept that many objects say alike, if anywhere.
    fn alike(&self) -> Option<&Interner> {
        None
    }
    /// The place of the next token.
    fn span(&mut self) -> Span;
    /// The place of the token last taken.
    fn last_span(&self) -> Span;
    /// "expected WHAT, found ..." at the next token. WHAT is in the author's words: "a vector after `location`".
    fn expected(&mut self, what: &str) -> Box<Diagnostic>;
    /// Records a warning.
    fn warn(&mut self, warning: Diagnostic);
    /// The version whose rules for pictures and light hold: where nobody has set one, that of scenes from before 3.7.
    fn effective_version(&self) -> f64 {
        self.version()
    }
    /// Says that `what` will take about so many bytes.
    ///
    /// # Errors
    /// There is not that much memory.
    fn make_room(&mut self, what: &str, bytes: u64, at: Span) -> Parse<()> {
        let _ = (what, bytes, at);
        Ok(())
    }
    /// The language version in force, as `#version` writes it: 3.7, 3.1.
    fn version(&self) -> f64;
}

/// A picture of the values of a function over the unit square, which is taken from `0` to `1` in both directions.
#[derive(Clone, Debug)]
pub struct Sampled {
    /// Pixels in a row, at least 1.
    pub width: usize,
    /// Rows, at least 1. The first row is that of `y = 0`.
    pub height: usize,
    /// The colours row by row, each channel one of 65536 steps from 0 to 1.
    pub colors: Vec<Color>,
    /// Whether they are the values of a function of numbers, which are kept as one channel.
    pub is_grey: bool,
}

/// The value of the next token, if that is an identifier declared as a `T`.
///
/// # Errors
/// When finding the next token fails: a directive before it is faulty.
pub fn declared<T: Any + Send + Sync>(args: &mut dyn Args) -> Parse<Option<Arc<T>>> {
    Ok(args
        .declared_any(TypeId::of::<T>())?
        .and_then(|value| value.downcast::<T>().ok()))
}

/// What `#default` says of a kind of element, or the kind's own default.
pub fn default_of<T: Any + Send + Sync + Clone + Default>(args: &dyn Args) -> T {
    let known = args.default_any(TypeId::of::<T>());
    known
        .and_then(|value| value.downcast::<T>().ok())
        .map_or_else(T::default, |value| T::clone(&value))
}

/// The error for a word that the language has and this program does not have yet: "`spotlight` is not built yet".
/// The place is that of the next token if it is the word, otherwise that of the token last taken.
pub fn not_built(args: &mut dyn Args, word: Word) -> Box<Diagnostic> {
    let at = if matches!(args.word(), Ok(Some(next)) if next == word) {
        args.span()
    } else {
        args.last_span()
    };
    let error = Diagnostic::error(at, format!("`{word}` is not built yet"));
    Box::new(error.with_code(Code::NotBuilt))
}

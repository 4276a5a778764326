//! Parameters written as plain literals, read straight from the text: data of which no tokens are made.
//!
//! Only what can mean nothing else is read: numbers with a sign, vectors and colours of them, axes and their multiples,
//! reserved words, and identifiers that hold objects or elements. At anything else, at a fault and at a warning it gives
//! up, without a message: then the same text is read by its tokens, which have the whole of the language.

use super::known::{Held, Known};
use crate::base::args::{Args, Interner, Parse, Word};
use crate::base::color::Color;
use crate::base::source::{Diagnostic, FileId, Span};
use crate::lang::syntax::{Class, number, word_end};
use glam::{DVec2, DVec3};
use std::any::{Any, TypeId};
use std::cell::Cell;
use std::sync::Arc;

/// The most components of a vector.
const MOST: usize = 5;

/// A cursor over text that holds no strings, comments and directives.
pub(crate) struct Literal<'a> {
    text: &'a str,
    at: usize,
    file: FileId,
    known: Known<'a>,
    version: f64,
    /// The reserved word looked up last, with its first byte and the byte behind it.
    last_word: Option<(usize, Word, usize)>,
    memory: &'a Memory,
    /// Whether something was found that only the tokens can tell.
    is_doubtful: Cell<bool>,
}

/// For each first letter the reserved word that was met last. Data say the same few words again and again.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    words: [Cell<Option<Word>>; 32],
    pub(crate) alike: Interner,
}

impl Memory {
    /// The reserved word that begins at a byte, with its length.
    #[inline]
    fn word(&self, text: &str, at: usize) -> Option<(Word, usize)> {
        let bytes = &text.as_bytes()[at..];
        let last = &self.words[usize::from(*bytes.first()?) % 32];
        if let Some(word) = last.get() {
            let spelling = word.spelling().as_bytes();
            let behind = bytes.get(spelling.len()).copied().unwrap_or(b' ');
            if !(is_letter(behind) || behind.is_ascii_digit()) && bytes.starts_with(spelling) {
                return Some((word, spelling.len()));
            }
        }
        let spelling = &text[at..word_end(text.as_bytes(), at)];
        let word = Word::from_spelling(spelling)?;
        last.set(Some(word));
        Some((word, spelling.len()))
    }
}

/// The place and the surroundings of a literal.
pub(crate) struct Ground<'a> {
    pub(crate) file: FileId,
    pub(crate) known: Known<'a>,
    pub(crate) version: f64,
    pub(crate) memory: &'a Memory,
}

fn give_up<T>() -> Parse<T> {
    Err(nothing())
}

fn nothing() -> Box<Diagnostic> {
    Box::new(Diagnostic::error(None, ""))
}

impl<'a> Literal<'a> {
    /// A cursor at a byte of a text; it does not go beyond the end of `text`.
    pub(crate) fn new(text: &'a str, at: usize, ground: &Ground<'a>) -> Self {
        Literal {
            text,
            at,
            file: ground.file,
            known: ground.known,
            version: ground.version,
            memory: ground.memory,
            last_word: None,
            is_doubtful: Cell::new(false),
        }
    }

    /// Where it has come to, if all that it read is sure.
    pub(crate) fn reached(&self) -> Option<usize> {
        (!self.is_doubtful.get()).then_some(self.at)
    }

    /// The byte it has come to.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// The text from there on.
    pub(crate) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Passes by so many bytes, which are known to be whole.
    pub(crate) fn pass(&mut self, len: usize) {
        self.at += len;
    }

    /// The next byte that is no blank; 0 at the end.
    #[inline]
    fn byte(&mut self) -> u8 {
        match self.text.as_bytes().get(self.at) {
            Some(&byte) if byte > b' ' => byte,
            _ => self.byte_behind_blanks(),
        }
    }

    fn byte_behind_blanks(&mut self) -> u8 {
        let rest = self.text.as_bytes().get(self.at..).unwrap_or_default();
        match rest.iter().position(|byte| !is_blank(*byte)) {
            Some(blanks) => {
                self.at += blanks;
                rest[blanks]
            }
            None => {
                self.at = self.text.len();
                0
            }
        }
    }

    #[inline]
    fn take(&mut self, byte: u8) -> bool {
        if self.byte() != byte {
            return false;
        }
        self.at += 1;
        true
    }

    /// The reserved word at hand; `None` if there is none, or an identifier.
    fn reserved(&mut self) -> Option<Word> {
        if !is_letter(self.byte()) {
            return None;
        }
        if let Some((start, word, _)) = self.last_word
            && start == self.at
        {
            return Some(word);
        }
        let (word, len) = self.memory.word(self.text, self.at)?;
        self.last_word = Some((self.at, word, self.at + len));
        Some(word)
    }

    /// The letters, digits and `_` at hand.
    fn spelling(&self) -> &'a str {
        let end = word_end(self.text.as_bytes(), self.at);
        &self.text[self.at..end]
    }

    /// What the identifier at hand holds.
    fn held(&mut self) -> Parse<Held> {
        let spelling = self.spelling();
        let Some(held) = self.known.get(spelling) else {
            return give_up();
        };
        self.at += spelling.len();
        if is_letter(self.byte()) && self.reserved().is_none() {
            // A macro may follow.
            return give_up();
        }
        Ok(held)
    }

    /// Whether what is at hand begins something new, so that no expression goes on with it.
    fn is_at_seam(&mut self) -> bool {
        match self.byte() {
            b',' | b'}' | b'0'..=b'9' => true,
            b'<' | b'>' => self.text.as_bytes().get(self.at + 1) != Some(&b'='),
            _ => match self.reserved() {
                Some(word) => !matches!(word, Word::Declare | Word::Include),
                None => false,
            },
        }
    }

    /// The components of a vector, or of a number alone or times an axis, and how many they are.
    #[inline]
    fn components(&mut self) -> Option<([f64; MOST], usize)> {
        let mut vector = [0.0; MOST];
        let mut len = 0;
        let is_vector = self.byte() == b'<';
        let bytes = self.text.as_bytes();
        let mut at = self.at + usize::from(is_vector);
        loop {
            let Some((component, end)) = signed(bytes, at) else {
                return if is_vector { None } else { self.axis(1.0, at) };
            };
            (*vector.get_mut(len)?, at) = (component, end);
            len += 1;
            if !is_vector {
                if bytes.get(behind_blanks(bytes, at)) == Some(&b'*') {
                    return self.axis(component, behind_blanks(bytes, at) + 1);
                }
                break;
            }
            at = behind_blanks(bytes, at);
            match bytes.get(at)? {
                b',' => at += 1,
                b'>' => {
                    at += 1;
                    break;
                }
                b'0'..=b'9' => {}
                _ => return None,
            }
        }
        self.at = at;
        self.is_at_seam().then_some((vector, len))
    }

    /// So many times the axis that stands at a byte, or minus the axis.
    #[cold]
    fn axis(&mut self, mut times: f64, at: usize) -> Option<([f64; MOST], usize)> {
        let bytes = self.text.as_bytes();
        let mut at = behind_blanks(bytes, at);
        if bytes.get(at) == Some(&b'-') {
            times = -times;
            at = behind_blanks(bytes, at + 1);
        }
        let axis = match bytes.get(at)? {
            b'x' => 0,
            b'y' => 1,
            b'z' => 2,
            _ => return None,
        };
        if word_end(bytes, at) != at + 1 {
            return None;
        }
        self.at = at + 1;
        // A product, as in an expression: its zeros have a sign.
        let mut vector = [0.0; MOST];
        for (component, of_axis) in vector.iter_mut().zip([0, 1, 2]) {
            *component = times * f64::from(u8::from(of_axis == axis));
        }
        self.is_at_seam().then_some((vector, 3))
    }

    /// A vector of `N` components; a number stands for all of them, and missing ones are zero.
    fn vector_of<const N: usize>(&mut self) -> Parse<[f64; N]> {
        match self.components() {
            Some((vector, 1)) => Ok([vector[0]; N]),
            Some((vector, len)) if len <= N => Ok(std::array::from_fn(|at| vector[at])),
            _ => give_up(),
        }
    }

    /// Takes a vector of `len` components with an optional comma before it, if it is followed by what ends an item of
    /// a list.
    pub(crate) fn item(&mut self, len: usize) -> Option<[f64; MOST]> {
        let start = self.at;
        self.take(b',');
        let item = match self.byte() {
            b'<' => self.components().filter(|(_, found)| *found == len),
            _ => None,
        };
        if item.is_none() || !matches!(self.byte(), b',' | b'}' | b'<') {
            self.at = start;
            return None;
        }
        item.map(|(vector, _)| vector)
    }
}

/// A number with or without a sign, whatever follows, and where it ends.
#[inline]
fn signed(text: &[u8], at: usize) -> Option<(f64, usize)> {
    let mut at = behind_blanks(text, at);
    let is_negative = text.get(at) == Some(&b'-');
    if is_negative {
        at = behind_blanks(text, at + 1);
    }
    let (value, end) = number(text, at);
    let value = value.filter(|value| value.is_finite())?;
    (end > at).then_some((if is_negative { -value } else { value }, end))
}

#[inline]
fn behind_blanks(text: &[u8], mut at: usize) -> usize {
    while text.get(at).is_some_and(|byte| is_blank(*byte)) {
        at += 1;
    }
    at
}

/// Whether a number is finite in single precision, as colours are.
#[allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision"
)]
fn is_single(number: f64) -> bool {
    (number as f32).is_finite()
}

fn is_blank(byte: u8) -> bool {
    byte == b' ' || byte.wrapping_sub(b'\t') <= b'\r' - b'\t'
}

fn is_letter(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

impl Args for Literal<'_> {
    fn alike(&self) -> Option<&Interner> {
        Some(&self.memory.alike)
    }

    fn float(&mut self) -> Parse<f64> {
        match self.components() {
            Some((vector, 1)) => Ok(vector[0]),
            _ => give_up(),
        }
    }

    fn float_or(&mut self, default: f64) -> Parse<f64> {
        if self.at_expression()? {
            self.float()
        } else {
            Ok(default)
        }
    }

    fn vector2(&mut self) -> Parse<DVec2> {
        self.vector_of().map(DVec2::from_array)
    }

    fn vector(&mut self) -> Parse<DVec3> {
        self.vector_of().map(DVec3::from_array)
    }

    fn vector4(&mut self) -> Parse<[f64; 4]> {
        self.vector_of()
    }

    fn color(&mut self) -> Parse<Color> {
        if let Some(color) = self.color_if_any()? {
            return Ok(color);
        }
        match self.components() {
            Some((parts, 1)) if is_single(parts[0]) => Ok(Color::from_components([parts[0]; 5])),
            _ => give_up(),
        }
    }

    fn color_if_any(&mut self) -> Parse<Option<Color>> {
        let is_mark = self.byte() == b'<';
        let Some(mut word) = self.reserved().filter(|word| word.class() == Class::Color) else {
            // An identifier or a vector may be a colour.
            return if is_mark || is_letter(self.byte()) && self.reserved().is_none() {
                give_up()
            } else {
                Ok(None)
            };
        };
        if matches!(word, Word::Color | Word::Colour) {
            self.accept(word)?;
            word = match self.reserved() {
                Some(word) => word,
                None => return give_up(),
            };
        }
        let wanted = match word {
            Word::Rgb => 3,
            Word::Rgbf | Word::Rgbt => 4,
            Word::Rgbft => 5,
            _ => return give_up(),
        };
        self.accept(word)?;
        let mut parts = match self.components() {
            Some((parts, 1)) => std::array::from_fn(|at| if at < wanted { parts[0] } else { 0.0 }),
            Some((parts, len)) if len <= wanted => parts,
            _ => return give_up(),
        };
        if word == Word::Rgbt {
            parts = [parts[0], parts[1], parts[2], 0.0, parts[3]];
        }
        let is_finite = parts.iter().all(|part| is_single(*part));
        let goes_on = self
            .reserved()
            .is_some_and(|word| word.class() == Class::Color);
        if !is_finite || goes_on {
            return give_up();
        }
        Ok(Some(Color::from_components(parts)))
    }

    fn string(&mut self) -> Parse<String> {
        give_up()
    }

    fn literal_vectors(&mut self, len: usize, take: &mut dyn FnMut(&[f64]) -> bool) {
        loop {
            let start = self.at;
            let Some(vector) = self.item(len) else { return };
            if !take(&vector[..len]) {
                self.at = start;
                return;
            }
        }
    }

    fn comma(&mut self) -> Parse<bool> {
        Ok(self.take(b','))
    }

    fn word(&mut self) -> Parse<Option<Word>> {
        Ok(self.reserved())
    }

    fn accept(&mut self, word: Word) -> Parse<bool> {
        if self.reserved() != Some(word) {
            return Ok(false);
        }
        if let Some((_, _, end)) = self.last_word {
            self.at = end;
        }
        Ok(true)
    }

    fn accept_mark(&mut self, mark: char) -> Parse<bool> {
        let is_it = self.at_mark(mark)?;
        self.at += usize::from(is_it);
        Ok(is_it)
    }

    fn at_mark(&mut self, mark: char) -> Parse<bool> {
        Ok(char::from(self.byte()) == mark && mark != '\0')
    }

    // Inlined into its caller, rustc 1.95 forgets the step behind the `{` in optimised builds.
    #[inline(never)]
    fn open(&mut self) -> Parse<()> {
        if self.take(b'{') { Ok(()) } else { give_up() }
    }

    fn accept_close(&mut self) -> Parse<bool> {
        Ok(self.take(b'}'))
    }

    fn close(&mut self) -> Parse<()> {
        if self.take(b'}') { Ok(()) } else { give_up() }
    }

    fn at_expression(&mut self) -> Parse<bool> {
        match self.byte() {
            b'0'..=b'9' | b'.' | b'<' | b'-' | b'+' | b'(' | b'!' => Ok(true),
            byte if is_letter(byte) => match self.reserved().map(Word::class) {
                None | Some(Class::Value | Class::Function) => give_up(),
                _ => Ok(false),
            },
            _ => Ok(false),
        }
    }

    fn declared_any(&mut self, kind: TypeId) -> Parse<Option<Arc<dyn Any + Send + Sync>>> {
        if !is_letter(self.byte()) || self.reserved().is_some() {
            return Ok(None);
        }
        match self.held()? {
            Held::Element(element) if (*element).type_id() == kind => Ok(Some(element)),
            _ => give_up(),
        }
    }

    fn object_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        if !is_letter(self.byte()) || self.reserved().is_some() {
            return give_up();
        }
        match self.held()? {
            Held::Object(object) => Ok(object),
            Held::Element(_) => give_up(),
        }
    }

    fn default_any(&self, _: TypeId) -> Option<Arc<dyn Any + Send + Sync>> {
        self.is_doubtful.set(true);
        None
    }

    fn span(&mut self) -> Span {
        self.byte();
        self.last_span()
    }

    fn last_span(&self) -> Span {
        let at = u32::try_from(self.at).unwrap_or(u32::MAX);
        Span::new(self.file, at, at)
    }

    fn expected(&mut self, _: &str) -> Box<Diagnostic> {
        nothing()
    }

    fn warn(&mut self, _: Diagnostic) {
        self.is_doubtful.set(true);
    }

    fn version(&self) -> f64 {
        self.version
    }
}

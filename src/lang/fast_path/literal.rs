//! Parameters written as plain literals, parsed straight from the text, without tokens.
//!
//! Only the unambiguous is parsed: numbers with a sign, vectors and colours of them, axes and their multiples, reserved
//! words, and identifiers that hold objects or elements. At anything else, at an error or a warning, the parser gives
//! up without a message, and the same text is read again as tokens, with the whole language.

use super::known::{Known, KnownValue};
use crate::base::args::{AnyObject, Args, Interner, Parse, Word};
use crate::base::color::Color;
use crate::base::source::{Diagnostic, FileId, Span};
use crate::lang::syntax::{Class, number, word_end};
use glam::{DVec2, DVec3};
use std::any::{Any, TypeId};
use std::cell::Cell;
use std::sync::Arc;

/// The most components of a vector.
const MAX_COMPONENTS: usize = 5;

/// A cursor over text without strings, comments and directives.
pub(crate) struct Literal<'a> {
    text: &'a str,
    at: usize,
    file: FileId,
    known: Known<'a>,
    version: f64,
    /// The reserved word looked up last, with its first byte and the byte after it.
    last_word: Option<(usize, Word, usize)>,
    memory: &'a Memory,
    /// True if something was read that only the tokens can decide.
    needs_tokens: Cell<bool>,
}

/// The last reserved word for each first letter. Data repeat the same few words.
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

/// The context in which literals are read.
pub(crate) struct LiteralContext<'a> {
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
    /// A cursor at a byte of a text, limited to the end of `text`.
    pub(crate) fn new(text: &'a str, at: usize, context: &LiteralContext<'a>) -> Self {
        Literal {
            text,
            at,
            file: context.file,
            known: context.known,
            version: context.version,
            memory: context.memory,
            last_word: None,
            needs_tokens: Cell::new(false),
        }
    }

    /// The position of the cursor, if nothing read so far needs the tokens.
    pub(crate) fn reached(&self) -> Option<usize> {
        (!self.needs_tokens.get()).then_some(self.at)
    }

    /// The position of the cursor.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// The text after the cursor.
    pub(crate) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Skips `len` bytes, which hold whole items.
    pub(crate) fn pass(&mut self, len: usize) {
        self.at += len;
    }

    /// The next byte that is no blank; 0 at the end.
    #[inline]
    fn byte(&mut self) -> u8 {
        match self.text.as_bytes().get(self.at) {
            Some(&byte) if byte > b' ' => byte,
            _ => self.byte_after_blanks(),
        }
    }

    fn byte_after_blanks(&mut self) -> u8 {
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

    /// The next reserved word; `None` at an identifier or anything else.
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

    /// The letters, digits and `_` at the cursor.
    fn spelling(&self) -> &'a str {
        let end = word_end(self.text.as_bytes(), self.at);
        &self.text[self.at..end]
    }

    /// The value of the next identifier.
    fn held(&mut self) -> Parse<KnownValue> {
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

    /// True if the next byte begins something new, so that no expression continues there.
    fn is_at_boundary(&mut self) -> bool {
        match self.byte() {
            b',' | b'}' | b'0'..=b'9' => true,
            b'<' | b'>' => self.text.as_bytes().get(self.at + 1) != Some(&b'='),
            _ => match self.reserved() {
                Some(word) => !matches!(word, Word::Declare | Word::Include),
                None => false,
            },
        }
    }

    /// The components of a vector, a number or a multiple of an axis, and their number.
    #[inline]
    fn components(&mut self) -> Option<([f64; MAX_COMPONENTS], usize)> {
        let mut vector = [0.0; MAX_COMPONENTS];
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
                if bytes.get(after_blanks(bytes, at)) == Some(&b'*') {
                    return self.axis(component, after_blanks(bytes, at) + 1);
                }
                break;
            }
            at = after_blanks(bytes, at);
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
        self.is_at_boundary().then_some((vector, len))
    }

    /// `times` the axis named at a byte, or its negative.
    #[cold]
    fn axis(&mut self, mut times: f64, at: usize) -> Option<([f64; MAX_COMPONENTS], usize)> {
        let bytes = self.text.as_bytes();
        let mut at = after_blanks(bytes, at);
        if bytes.get(at) == Some(&b'-') {
            times = -times;
            at = after_blanks(bytes, at + 1);
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
        let mut vector = [0.0; MAX_COMPONENTS];
        for (component, of_axis) in vector.iter_mut().zip([0, 1, 2]) {
            *component = times * f64::from(u8::from(of_axis == axis));
        }
        self.is_at_boundary().then_some((vector, 3))
    }

    /// A vector of `N` components; a number is repeated, and missing components are zero.
    fn vector_of<const N: usize>(&mut self) -> Parse<[f64; N]> {
        match self.components() {
            Some((vector, 1)) => Ok([vector[0]; N]),
            Some((vector, len)) if len <= N => Ok(std::array::from_fn(|at| vector[at])),
            _ => give_up(),
        }
    }

    /// Takes a vector of `len` components with an optional comma before it, if an item of a list ends there.
    pub(crate) fn item(&mut self, len: usize) -> Option<[f64; MAX_COMPONENTS]> {
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

/// A number with an optional sign, and its end.
#[inline]
fn signed(text: &[u8], at: usize) -> Option<(f64, usize)> {
    let mut at = after_blanks(text, at);
    let is_negative = text.get(at) == Some(&b'-');
    if is_negative {
        at = after_blanks(text, at + 1);
    }
    let (value, end) = number(text, at);
    let value = value.filter(|value| value.is_finite())?;
    (end > at).then_some((if is_negative { -value } else { value }, end))
}

#[inline]
fn after_blanks(text: &[u8], mut at: usize) -> usize {
    while text.get(at).is_some_and(|byte| is_blank(*byte)) {
        at += 1;
    }
    at
}

/// True if a number is finite in single precision, the precision of colours.
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
    fn interner(&self) -> Option<&Interner> {
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

    // Inlined into its caller by rustc 1.95, the step after the `{` is lost in optimised builds.
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
            KnownValue::Element(element) if (*element).type_id() == kind => Ok(Some(element)),
            _ => give_up(),
        }
    }

    fn object_any(&mut self) -> Parse<Arc<dyn AnyObject + Send + Sync>> {
        if !is_letter(self.byte()) || self.reserved().is_some() {
            return give_up();
        }
        match self.held()? {
            KnownValue::Object(object) => Ok(object),
            KnownValue::Element(_) => give_up(),
        }
    }

    fn default_any(&self, _: TypeId) -> Option<Arc<dyn Any + Send + Sync>> {
        self.needs_tokens.set(true);
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
        self.needs_tokens.set(true);
    }

    fn version(&self) -> f64 {
        self.version
    }
}

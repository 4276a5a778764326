//! The built-in functions that give numbers and vectors.

use super::cursor::Start;
use super::reader::Reader;
use super::replay::Op;
use super::value::{Number, Value};
use crate::args::{Parse, Word};
use crate::math::noise::{Octaves, vector_turbulence};
use crate::math::{axis_rotation, hyperbolic, rotation};
use crate::source::Diagnostic;
use crate::syntax::{Kind, Symbol};
use glam::DVec3;

impl Reader<'_> {
    /// The call that begins with the function word at hand.
    pub(super) fn call_function(&mut self, word: Word) -> Parse<Number> {
        self.pass();
        let op = Op::of_call(word);
        if op.is_none() && !matches!(word, Word::Min | Word::Max) {
            self.spoil();
        }
        let name = self.taken_span();
        self.expect_call(word)?;
        let open = self.start_taken();
        let value = match word {
            Word::Defined => {
                let is_defined = self.names_a_value()?;
                Number::truth(is_defined)
            }
            Word::Strlen => Number::float(self.string()?.chars().count() as f64),
            Word::Asc => {
                let text = self.string()?;
                Number::float(text.chars().next().map_or(0.0, |c| f64::from(u32::from(c))))
            }
            Word::Val => Number::float(leading_number(&self.string()?)),
            Word::Strcmp => {
                let left = self.string()?;
                self.take_mark(',')?;
                let right = self.string()?;
                Number::float(f64::from(difference(&left, &right)))
            }
            Word::FileExists => {
                let file = self.file_name()?;
                self.publish_files(name)?;
                Number::truth(self.sources.has_data(&file, name.file))
            }
            Word::Dimensions | Word::DimensionSize => self.dimensions(word)?,
            Word::Min | Word::Max => self.extremum(word)?,
            Word::Select => self.select()?,
            Word::Rand => self.rand()?,
            Word::Seed => self.seed()?,
            Word::Vlength => vector(word, self.vector3()?),
            Word::Vnormalize => self.vnormalize()?,
            Word::Vdot | Word::Vcross | Word::Vrotate => {
                let (a, b) = self.two_vectors()?;
                vectors(word, a, b, 0.0)
            }
            Word::VaxisRotate => {
                let (a, b) = self.two_vectors()?;
                self.take_mark(',')?;
                vectors(word, a, b, self.number_at_sum()?)
            }
            Word::MinExtent | Word::MaxExtent => self.extent(word)?,
            Word::Vturbulence => self.vturbulence()?,
            Word::Trace => self.trace()?,
            Word::Inside => self.inside()?,
            _ => self.float_function(word, name)?,
        };
        self.end_of_call(word, open)?;
        if let Some(op) = op {
            self.note(op);
        }
        Ok(value)
    }

    /// The `(` of a call.
    pub(super) fn expect_call(&mut self, word: Word) -> Parse<()> {
        if self.take_mark('(')? {
            return Ok(());
        }
        Err(self.expected_here(&format!("`(` after `{word}`")))
    }

    /// The `)` of a call; a comma there means too many arguments.
    pub(super) fn end_of_call(&mut self, word: Word, open: Start) -> Parse<()> {
        if self.peek()?.is_mark(',') {
            let error = self.error_here(format!("`{word}` takes no further argument"));
            return Err(Box::new(error.with_hint("Write `)` before the comma.")));
        }
        if self.take_mark(')')? {
            return Ok(());
        }
        let what = format!("an operator or `)` at the end of `{word}(...)`");
        self.expect_end(')', &what, open)
    }

    fn float_function(&mut self, word: Word, name: crate::source::Span) -> Parse<Number> {
        if is_of_two(word) {
            let a = self.number_at_sum()?;
            self.take_mark(',')?;
            if self.peek()?.is_mark(')') {
                let error = self.error_here(format!("`{word}` takes two arguments, found one"));
                return Err(Box::new(error.with_hint(format!("Write `{word}(a, b)`."))));
            }
            let mut b = self.number_at_sum()?;
            if matches!(word, Word::BitwiseAnd | Word::BitwiseOr | Word::BitwiseXor) {
                while self.take_mark(',')? {
                    b = bits(word, b, self.number_at_sum()?);
                }
            }
            if matches!(word, Word::Div | Word::Mod) && b == 0.0 {
                let message = format!("`{word}` divides by zero");
                self.warning(Diagnostic::warning(self.taken_span(), message));
            }
            return two(word, a, b).map(Number::float).map_err(|message| {
                self.with_trace(Diagnostic::error(name.to(self.taken_span()), message))
            });
        }
        if !is_of_one(word) {
            return Err(self.with_trace(Diagnostic::error(
                name,
                format!("`{word}` is not built yet"),
            )));
        }
        let a = self.condition_value()?;
        let place = name.to(self.taken_span());
        if is_outside(word, a) {
            self.warning(Diagnostic::warning(
                place,
                format!("`{word}` of {a}: the argument is taken as {}", a.signum()),
            ));
        }
        // What does not exist is the NaN that processors make of it, which C writes with a sign.
        let with_sign = |value: f64| if value.is_nan() { -f64::NAN } else { value };
        one(word, a)
            .map(|value| Number::float(with_sign(value)))
            .map_err(|message| self.with_trace(Diagnostic::error(place, message)))
    }

    /// A corner of the box around a declared object.
    fn extent(&mut self, word: Word) -> Parse<Number> {
        let Some(object) = self.object_of_name()? else {
            return Err(self.expected_here("an object identifier"));
        };
        let extent = object.extent();
        Ok(Number::vector(if word == Word::MinExtent {
            extent.min
        } else {
            extent.max
        }))
    }

    fn two_vectors(&mut self) -> Parse<(DVec3, DVec3)> {
        let a = self.vector3()?;
        self.take_mark(',')?;
        Ok((a, self.vector3()?))
    }

    /// `lambda, omega, octaves, point`.
    fn vturbulence(&mut self) -> Parse<Number> {
        let lambda = self.number_at_sum()?;
        self.take_mark(',')?;
        let omega = self.number_at_sum()?;
        self.take_mark(',')?;
        let count = Octaves::count_of(self.number_at_sum()?);
        self.take_mark(',')?;
        let point = self.vector3()?;
        #[allow(
            clippy::cast_possible_truncation,
            reason = "single precision, as in patterns"
        )]
        let octaves = Octaves {
            count,
            lambda: lambda as f32,
            omega: omega as f32,
        };
        Ok(Number::vector(vector_turbulence(point, &octaves)))
    }

    fn vnormalize(&mut self) -> Parse<Number> {
        let v = self.vector3()?;
        if v == DVec3::ZERO {
            self.warning(Diagnostic::warning(
                self.taken_span(),
                "the zero vector has no direction; it stays zero",
            ));
        }
        Ok(vector(Word::Vnormalize, v))
    }

    fn extremum(&mut self, word: Word) -> Parse<Number> {
        let mut best = self.number_at_sum()?;
        let mut count = 1_u8;
        while self.take_mark(',')? {
            let next = self.number_at_sum()?;
            best = if word == Word::Min {
                best.min(next)
            } else {
                best.max(next)
            };
            count = count.saturating_add(1);
        }
        self.note(if word == Word::Min {
            Op::Min(count)
        } else {
            Op::Max(count)
        });
        Ok(Number::float(best))
    }

    /// `select(a, negative, zero, positive)` or `select(a, negative, zero or positive)`.
    fn select(&mut self) -> Parse<Number> {
        let test = self.number_at_sum()?;
        self.expect_mark(',', "`,` in `select`")?;
        let negative = self.sum()?;
        self.expect_mark(',', "`,` in `select`")?;
        let zero = self.sum()?;
        let positive = if self.take_mark(',')? {
            self.sum()?
        } else {
            zero
        };
        let len = negative.len.max(zero.len).max(positive.len);
        let chosen = if test < 0.0 {
            negative
        } else if test == 0.0 {
            zero
        } else {
            positive
        };
        Ok(chosen.promoted(len))
    }

    fn dimensions(&mut self, word: Word) -> Parse<Number> {
        let symbol = self.identifier("an array")?;
        let path = if self.is_raw_mark('[') {
            self.item_path(symbol)?
        } else {
            Vec::new()
        };
        let held = self.scopes.get(symbol).and_then(|held| held.item(&path));
        let Some(Value::Array(array)) = held else {
            return Err(self.error_taken("expected an array"));
        };
        let sizes = array.sizes.clone();
        if word == Word::Dimensions {
            return Ok(Number::float(sizes.len() as f64));
        }
        self.take_mark(',')?;
        let wanted = self.number_at_sum()?;
        let size = sizes
            .iter()
            .enumerate()
            .find(|(i, _)| (*i + 1) as f64 == wanted.trunc());
        match size {
            Some((_, &size)) => Ok(Number::float(size as f64)),
            None => Err(self.error_taken(format!("the array has dimensions 1 to {}", sizes.len()))),
        }
    }

    /// `seed(n)` opens a stream of random numbers and gives its handle.
    fn seed(&mut self) -> Parse<Number> {
        let start = self.number_at_sum()?;
        self.streams.push(whole(start).cast_unsigned());
        Ok(Number::float((self.streams.len() - 1) as f64))
    }

    /// The next number of a stream, in [0, 1].
    fn rand(&mut self) -> Parse<Number> {
        let handle = self.number_at_sum()?;
        let Some(stream) = stream(handle, &self.streams) else {
            return Err(self.error_taken("this is no stream of `seed`"));
        };
        Ok(Number::float(draw(&mut self.streams[stream])))
    }

    /// A bare identifier that holds a string, or anything else that begins one.
    pub(super) fn at_string(&mut self) -> Parse<bool> {
        let token = self.peek()?;
        Ok(match token.kind {
            Kind::String => true,
            Kind::Name => match self.scopes.get(Symbol(token.value)) {
                Some(Value::Text(_)) => true,
                Some(Value::Array(array)) => array
                    .items
                    .iter()
                    .flatten()
                    .any(|item| matches!(item, Value::Text(_))),
                _ => false,
            },
            Kind::Word => token.word().is_some_and(|word| self.begins_string(word)),
            _ => false,
        })
    }
}

/// The index of the stream with this handle.
pub(super) fn stream(handle: f64, streams: &[u32]) -> Option<usize> {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "out of range means no stream"
    )]
    Some(handle as usize).filter(|&stream| stream < streams.len())
}

/// The next number of a stream.
pub(super) fn draw(state: &mut u32) -> f64 {
    *state = state.wrapping_mul(1_812_433_253).wrapping_add(12345);
    f64::from(*state) / f64::from(u32::MAX)
}

/// A function of one vector.
pub(super) fn vector(word: Word, v: DVec3) -> Number {
    match word {
        Word::Vlength => Number::float(v.length()),
        _ => Number::vector(v.normalize_or_zero()),
    }
}

/// A function of two vectors, and of degrees for a turn about an axis.
pub(super) fn vectors(word: Word, a: DVec3, b: DVec3, degrees: f64) -> Number {
    match word {
        Word::Vdot => Number::float(a.dot(b)),
        Word::Vcross => Number::vector(a.cross(b)),
        Word::Vrotate => Number::vector(rotation(b) * a),
        _ if b == DVec3::ZERO => Number::vector(DVec3::splat(-f64::NAN)),
        _ => Number::vector(axis_rotation(b, degrees) * a),
    }
}

/// Whether a number is outside of where a function is defined, and is taken to the border with a warning.
pub(super) fn is_outside(word: Word, a: f64) -> bool {
    matches!(word, Word::Acos | Word::Asin) && a.abs() > 1.0
}

pub(super) fn is_of_two(word: Word) -> bool {
    use Word::{Atan2, BitwiseAnd, BitwiseOr, BitwiseXor, Div, Mod, Pow};
    matches!(
        word,
        Atan2 | BitwiseAnd | BitwiseOr | BitwiseXor | Div | Mod | Pow
    )
}

pub(super) fn is_of_one(word: Word) -> bool {
    use Word::{
        Abs, Acos, Acosh, Asin, Asinh, Atan, Atanh, Ceil, Cos, Cosh, Degrees, Exp, Floor, Int, Ln,
        Log, Radians, Sin, Sinh, Sqrt, Tan, Tanh,
    };
    matches!(
        word,
        Abs | Acos
            | Acosh
            | Asin
            | Asinh
            | Atan
            | Atanh
            | Ceil
            | Cos
            | Cosh
            | Degrees
            | Exp
            | Floor
            | Int
            | Ln
            | Log
            | Radians
            | Sin
            | Sinh
            | Sqrt
            | Tan
            | Tanh
    )
}

/// A function of one argument, or what is wrong with the argument.
pub(super) fn one(word: Word, a: f64) -> Result<f64, String> {
    Ok(match word {
        Word::Abs => a.abs(),
        Word::Acos => a.clamp(-1.0, 1.0).acos(),
        Word::Acosh => hyperbolic::acosh(a),
        Word::Asin => a.clamp(-1.0, 1.0).asin(),
        Word::Asinh => hyperbolic::asinh(a),
        Word::Atan => a.atan(),
        Word::Atanh => hyperbolic::atanh(a),
        Word::Ceil => a.ceil(),
        Word::Cos => a.cos(),
        Word::Cosh => a.cosh(),
        Word::Degrees => a.to_degrees(),
        Word::Exp => a.exp(),
        Word::Floor => a.floor(),
        Word::Int => f64::from(whole(a)),
        Word::Ln | Word::Log if a <= 0.0 => {
            return Err(format!("the logarithm of {a} does not exist"));
        }
        Word::Ln => a.ln(),
        Word::Log => a.log10(),
        Word::Radians => a.to_radians(),
        Word::Sin => a.sin(),
        Word::Sinh => a.sinh(),
        Word::Sqrt if a < 0.0 => return Err(format!("the square root of {a} does not exist")),
        Word::Sqrt => a.sqrt(),
        Word::Tan => a.tan(),
        _ => a.tanh(),
    })
}

/// A function of two arguments, or what is wrong with them.
pub(super) fn two(word: Word, a: f64, b: f64) -> Result<f64, String> {
    Ok(match word {
        Word::Atan2 if a == 0.0 && b == 0.0 => {
            return Err("`atan2(0, 0)` does not exist".to_owned());
        }
        Word::Atan2 => a.atan2(b),
        Word::BitwiseAnd | Word::BitwiseOr | Word::BitwiseXor => bits(word, a, b),
        Word::Div => f64::from(whole(a / b)),
        Word::Mod if b == 0.0 => -f64::NAN,
        Word::Mod => a % b,
        _ if a == 0.0 && b == 0.0 => return Err("`pow(0, 0)` does not exist".to_owned()),
        _ => a.powf(b),
    })
}

/// A whole number as POV-Ray has it: of 32 bits, and the least of them for all that has no place there.
fn whole(value: f64) -> i32 {
    let value = value.trunc();
    if (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value) {
        #[allow(clippy::cast_possible_truncation, reason = "checked just above")]
        let whole = value as i32;
        whole
    } else {
        i32::MIN
    }
}

fn bits(word: Word, a: f64, b: f64) -> f64 {
    let (a, b) = (whole(a), whole(b));
    f64::from(match word {
        Word::BitwiseAnd => a & b,
        Word::BitwiseOr => a | b,
        _ => a ^ b,
    })
}

/// As C's `strcmp`: the difference of the first letters that differ, where the end of a text is zero.
fn difference(left: &str, right: &str) -> i32 {
    let codes =
        |text: &str| -> Vec<i64> { text.chars().map(|c| i64::from(u32::from(c))).collect() };
    let (left, right) = (codes(left), codes(right));
    let code = |text: &[i64], at: usize| text.get(at).copied().unwrap_or(0);
    let differences = (0..left.len().max(right.len())).map(|at| code(&left, at) - code(&right, at));
    let first = differences.into_iter().find(|&difference| difference != 0);
    i32::try_from(first.unwrap_or(0)).unwrap_or(0)
}

/// The number at the start of a text as C's `atof` finds it, 0 if there is none.
fn leading_number(text: &str) -> f64 {
    let text = text.trim_start();
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
    let start = |word: &str| {
        unsigned
            .get(..word.len())
            .is_some_and(|s| s.eq_ignore_ascii_case(word))
    };
    if start("inf") {
        return sign * f64::INFINITY;
    }
    if start("nan") {
        return sign * f64::NAN;
    }
    if start("0x") {
        let digits = unsigned[2..].chars().map_while(|c| c.to_digit(16));
        return sign * digits.fold(0.0, |sum, digit| 16.0 * sum + f64::from(digit));
    }
    let is_part = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    (0..=end)
        .rev()
        .filter(|&at| text.is_char_boundary(at))
        .find_map(|at| text[..at].parse().ok())
        .unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measured with POV-Ray.
    #[test]
    fn numbers_at_the_start_of_texts_are_those_of_atof() {
        let texts = [
            "12",
            "  -1.5e-2 z",
            "abc",
            "",
            ".5",
            "0x10",
            "1e",
            "+3",
            "1,2",
            "1.2.3",
        ];
        let expected = [12.0, -0.015, 0.0, 0.0, 0.5, 16.0, 1.0, 3.0, 1.0, 1.2];
        assert_eq!(texts.map(leading_number), expected);
        assert_eq!(leading_number("inf"), f64::INFINITY);
        assert_eq!(leading_number("\u{e4}"), 0.0);
    }

    #[test]
    fn texts_are_compared_by_their_first_difference() {
        assert_eq!(difference("a", "b"), -1);
        assert_eq!(difference("abcd", "abc"), 100);
        assert_eq!(difference("", "z"), -122);
        assert_eq!(difference("abc", "abc"), 0);
    }

    #[test]
    fn whole_numbers_have_32_bits() {
        assert_eq!(whole(-3.9), -3);
        assert_eq!(whole(1e12), i32::MIN);
        assert_eq!(whole(f64::NAN), i32::MIN);
        assert_eq!(
            bits(Word::BitwiseOr, 4_294_967_296.0, 1.0),
            -2_147_483_647.0
        );
    }
}

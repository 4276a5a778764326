//! Built-in functions with numeric and vector values.

use super::builtins::{
    bits, difference, is_of_one, is_of_two, is_outside, leading_number, one, two, vector, vectors,
    whole,
};
use super::streams::Call;
use super::value::{Element, Number, STRING, Value};
use crate::base::args::{Parse, Word};
use crate::base::math::conditioning::Normalization;
use crate::base::math::noise::{Octaves, vector_turbulence};
use crate::base::source::Diagnostic;
use crate::lang::fast_path::replay::op::Op;
use crate::lang::frame::Start;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol};
use crate::scene::interior::Density;
use crate::scene::texture::{Normal, Pigment};
use glam::DVec3;
use std::sync::Arc;

impl Reader<'_> {
    /// The value of a call, whose function word is next.
    pub(crate) fn call_function(&mut self, word: Word) -> Parse<Number> {
        self.pass();
        let op = Op::of_call(word, self.normalization());
        if op.is_none() && !matches!(word, Word::Min | Word::Max) {
            self.discard_recording();
        }
        let name = self.taken_span();
        self.expect_call(word)?;
        let open = self.start_taken();
        let value = match word {
            Word::Defined => Number::truth(self.names_a_value()?),
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
            Word::Vlength => vector(word, self.vector3()?, Normalization::default()),
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
        if word == Word::Seed {
            let close = self.start_taken();
            self.streams.opened_by(Call { open, close });
        }
        if let Some(op) = op {
            self.note(op);
        }
        Ok(value)
    }

    /// The `(` of a call.
    pub(crate) fn expect_call(&mut self, word: Word) -> Parse<()> {
        if self.take_mark('(')? {
            return Ok(());
        }
        Err(self.expected_here(&format!("`(` after `{word}`")))
    }

    /// The `)` of a call; a comma there means too many arguments.
    pub(crate) fn end_of_call(&mut self, word: Word, open: Start) -> Parse<()> {
        if self.peek()?.is_mark(',') {
            let error = self.error_here(format!("`{word}` takes no further argument"));
            if let Some(remedy) = self.vector_argument(word, open) {
                return Err(Box::new(remedy.added_to(*error)));
            }
            let hint = "Write `)` before this comma, or remove what follows it.";
            return Err(Box::new(error.with_hint(hint)));
        }
        if self.take_mark(')')? {
            return Ok(());
        }
        let what = format!("an operator or `)` at the end of `{word}(...)`");
        self.expect_end(')', &what, open)
    }

    fn float_function(&mut self, word: Word, name: crate::base::source::Span) -> Parse<Number> {
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
                format!("`{word}` is not supported yet"),
            )));
        }
        let a = self.condition_value()?;
        let span = name.to(self.taken_span());
        if is_outside(word, a) {
            self.warning(Diagnostic::warning(
                span,
                format!("`{word}` of {a}: the argument is taken as {}", a.signum()),
            ));
        }
        // Undefined values are the NaN of the processor, which C prints with a sign.
        let with_sign = |value: f64| if value.is_nan() { -f64::NAN } else { value };
        one(word, a)
            .map(|value| Number::float(with_sign(value)))
            .map_err(|message| self.with_trace(Diagnostic::error(span, message)))
    }

    /// A corner of the bounding box of a declared object; `max_extent` of a pigment, normal or density is the resolution of
    /// its image or density file.
    fn extent(&mut self, word: Word) -> Parse<Number> {
        if word == Word::MaxExtent
            && let Some(resolution) = self.resolution()?
        {
            return Ok(Number::vector(resolution));
        }
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

    /// The resolution of the file of a declared pigment, normal or density; `None` if no such name is next.
    fn resolution(&mut self) -> Parse<Option<DVec3>> {
        let token = self.peek()?;
        let named = token.symbol().and_then(|name| self.scopes.get(name));
        let is_item = matches!(named, Some(Value::Array(_)));
        let value = match named {
            Some(Value::Array(_)) => {
                let start = self.reading();
                match self.array_or_item()? {
                    item @ Value::Element(_) => item,
                    item => {
                        self.read_again(item, start);
                        return Ok(None);
                    }
                }
            }
            Some(value @ Value::Element(_)) => value.clone(),
            _ => return Ok(None),
        };
        let Value::Element(Element { name, value }) = value else {
            return Ok(None);
        };
        let counts = if let Some(pigment) = value.downcast_ref::<Pigment>() {
            pigment.sample_counts()
        } else if let Some(Density(pigment)) = value.downcast_ref() {
            pigment.sample_counts()
        } else if let Some(normal) = value.downcast_ref::<Arc<Normal>>() {
            normal.sample_counts()
        } else {
            None
        };
        if !is_item {
            self.pass();
        }
        match counts {
            Some(counts) => Ok(Some(counts)),
            None => {
                let message =
                    format!("`max_extent` of a {name} that shows no image or density file");
                Err(self.error_taken(message))
            }
        }
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
        let count = Octaves::clamped_count(self.number_at_sum()?);
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

    /// The rounding of unit vectors in this scene.
    pub(crate) fn normalization(&self) -> Normalization {
        Normalization::of_version(self.draft.globals.is_for_3_8)
    }

    fn vnormalize(&mut self) -> Parse<Number> {
        let v = self.vector3()?;
        if v == DVec3::ZERO {
            self.warning(Diagnostic::warning(
                self.taken_span(),
                "the zero vector has no direction; it stays zero",
            ));
        }
        Ok(vector(Word::Vnormalize, v, self.normalization()))
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
        self.pass_hash();
        let symbol = self.identifier("an array")?;
        let path = if self.begins_item(symbol) {
            self.item_path(symbol)?
        } else {
            Vec::new()
        };
        let held = self.scopes.get(symbol).and_then(|held| held.item(&path));
        let Some(Value::Array(array)) = held else {
            return Err(self.error_taken("expected an array"));
        };
        if array.is_dictionary() {
            return Err(self.error_taken("expected an array, found a dictionary"));
        }
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

    /// `seed(n)` opens a stream of random numbers; its value is the handle.
    fn seed(&mut self) -> Parse<Number> {
        let start = self.number_at_sum()?;
        self.count_stream()?;
        Ok(Number::float(
            self.streams.open(whole(start).cast_unsigned()),
        ))
    }

    /// The next number of a stream, in [0, 1].
    fn rand(&mut self) -> Parse<Number> {
        let opens_stream = self.raw().word() == Some(Word::Seed);
        let open = Start {
            file: self.here.tokens.file,
            start: self.raw_ahead(1).start,
        };
        let handle = self.number_at_sum()?;
        let Some(stream) = self.streams.find(handle) else {
            let error = self.error_taken("this is not a stream of `seed`");
            let hint = "`#declare stream = seed(1);` makes a stream, `rand(stream)` draws from it.";
            return Err(Box::new(error.with_hint(hint)));
        };
        let close = self.start_taken();
        Ok(Number::float(if opens_stream {
            self.streams.draw_by(Call { open, close }, stream)
        } else {
            self.streams.draw(stream)
        }))
    }

    /// True if a string begins: a bare identifier that holds one, or a string expression.
    pub(crate) fn at_string(&mut self) -> Parse<bool> {
        let token = self.peek()?;
        Ok(match token.kind {
            Kind::String => true,
            Kind::Name => match self.scopes.get(Symbol(token.value)) {
                Some(Value::Text(_)) => true,
                Some(array @ Value::Array(_)) if array.is_mixed() => {
                    let item = self.mixed_item_ahead(Symbol(token.value))?;
                    matches!(item, Some(Value::Text(_)))
                }
                Some(Value::Array(array)) => array.holds == Some(STRING),
                _ => false,
            },
            Kind::Word => token.word().is_some_and(|word| self.begins_string(word)),
            _ => false,
        })
    }
}

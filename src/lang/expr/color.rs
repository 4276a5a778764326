//! Colours in all the forms of the language.

use super::callee::is_callable;
use super::value::Value;
use crate::base::args::{Args, Parse, Word};
use crate::base::color::{Color, Gamma};
use crate::base::source::Diagnostic;
use crate::lang::frame::Start;
use crate::lang::limits::EQUAL;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Symbol};

/// The last language version in which POV-Ray takes `alpha` for `filter` without a warning.
const LAST_WITH_ALPHA: f64 = 1.55;

impl Reader<'_> {
    /// A colour: words of colour in any order, a colour identifier, or a vector or number that sets all five
    /// components.
    pub(crate) fn color_value(&mut self) -> Parse<Color> {
        let start = self.start()?;
        let parts = self.color_parts(None)?;
        #[allow(
            clippy::cast_possible_truncation,
            reason = "colours are single precision"
        )]
        let stored = parts.map(|part| f64::from(part as f32));
        self.finite(&stored, start)?;
        Ok(Color::from_components(parts))
    }

    /// The parts of a colour, or those that follow `begun`.
    pub(super) fn color_parts(&mut self, begun: Option<[f64; 5]>) -> Parse<[f64; 5]> {
        let mut sum = begun.unwrap_or_default();
        let (mut has_begun, mut has_word) = (begun.is_some(), false);
        loop {
            let token = self.peek()?;
            let word = token.word().filter(|word| word.class() == Class::Color);
            match word {
                Some(word) if has_begun && !is_component(word) => {
                    return Ok(sum);
                }
                Some(Word::Color | Word::Colour) => {
                    if has_word {
                        let reason = "`color` stands once before a colour";
                        self.refused_by_povray(self.here_span(), reason, "Remove one of the two.");
                    }
                    self.pass();
                    has_word = true;
                }
                Some(Word::Red) => self.color_part(&mut sum[0])?,
                Some(Word::Green) => self.color_part(&mut sum[1])?,
                Some(Word::Blue) => self.color_part(&mut sum[2])?,
                Some(Word::Filter) => self.color_part(&mut sum[3])?,
                Some(Word::Transmit) => self.color_part(&mut sum[4])?,
                Some(Word::Alpha) => {
                    self.warn_of_alpha()?;
                    self.color_part(&mut sum[3])?;
                }
                Some(Word::Gray) => return Err(self.expected_here("a colour")),
                Some(word) => {
                    self.pass();
                    sum = self.color_vector(word)?;
                }
                None if !has_begun && self.is_missing_value(has_word)? => {
                    let text = "a colour without a value is black";
                    let warning = Diagnostic::warning(self.here_span(), text);
                    self.warning(warning.with_hint("Write `rgb 0` for black."));
                    return Ok(sum);
                }
                None if !has_begun => {
                    if has_word && token.word() == Some(Word::T) {
                        let reason = "a colour may not begin with `t`";
                        let remedy = "Write it in parentheses: `color (t)`.";
                        self.refused_by_povray(self.here_span(), reason, remedy);
                    }
                    sum = self.sum_of_five()?;
                }
                None => return Ok(sum),
            }
            if !matches!(word, Some(Word::Color | Word::Colour)) {
                has_begun = true;
            }
        }
    }

    /// True if the next token is the name of a colour.
    pub(crate) fn is_at_color_name(&mut self) -> Parse<bool> {
        let token = self.peek()?;
        let value = || self.scopes.get(Symbol(token.value));
        Ok(token.kind == Kind::Name
            && matches!(value(), Some(Value::Number(number)) if number.len == 5))
    }

    /// True if the next token is the name of a vector.
    pub(crate) fn is_at_vector_name(&mut self) -> Parse<bool> {
        let token = self.peek()?;
        let value = || self.scopes.get(Symbol(token.value));
        Ok(token.kind == Kind::Name
            && matches!(value(), Some(Value::Number(number)) if number.len > 1))
    }

    /// True if the next token is a word or mark that ends an expression; the entry of a map ends only after `color`.
    fn is_missing_value(&mut self, has_word: bool) -> Parse<bool> {
        let token = self.peek()?;
        let ends = match token.kind {
            Kind::Word => !self.begins_number()?,
            Kind::Mark if token.is_mark(']') => has_word,
            Kind::Mark => "},;".contains(char::from_u32(token.value).unwrap_or(' ')),
            _ => false,
        };
        Ok(ends)
    }

    /// Warns of `alpha`, the next token, in versions where it is deprecated.
    fn warn_of_alpha(&mut self) -> Parse<()> {
        if self.draft.version > LAST_WITH_ALPHA + EQUAL {
            let at = self.start()?;
            let warning = Diagnostic::warning(
                self.span_of(at),
                "`alpha` in a colour is the old word for `filter`",
            );
            self.warning(warning.with_hint("Write `filter` instead."));
        }
        Ok(())
    }

    fn color_part(&mut self, part: &mut f64) -> Parse<()> {
        self.pass();
        *part = self.number_at_sum()?;
        Ok(())
    }

    fn sum_of_five(&mut self) -> Parse<[f64; 5]> {
        if !self.begins_number()? {
            return Err(self.expected_here("a colour"));
        }
        Ok(self.full_of_sum()?.promoted(5).v)
    }

    /// The components after `rgb`, `rgbf`, `srgbt` and their like, in the order red, green, blue, filter, transmit.
    fn color_vector(&mut self, word: Word) -> Parse<[f64; 5]> {
        let at = self.start_taken();
        let wanted = match word {
            Word::Rgb | Word::Srgb => 3,
            Word::Rgbft | Word::Srgbft => 5,
            _ => 4,
        };
        let number = self.full_of_sum()?;
        if number.len > wanted {
            self.warning(Diagnostic::warning(
                self.span_from(at),
                format!("`{word}` takes {wanted} components, found {}; the rest count as filter and transmit", number.len),
            ));
        }
        let mut parts = number.promoted(wanted).v;
        if matches!(word, Word::Rgbt | Word::Srgbt) {
            parts = [parts[0], parts[1], parts[2], 0.0, parts[3]];
        }
        if matches!(word, Word::Srgb | Word::Srgbf | Word::Srgbt | Word::Srgbft) {
            self.decode_srgb(&mut parts, at)?;
        }
        Ok(parts)
    }

    fn decode_srgb(&mut self, parts: &mut [f64; 5], at: Start) -> Parse<()> {
        let working = match self.draft.globals.assumed_gamma {
            Some(gamma) => gamma,
            None if self.draft.version >= 3.7 - EQUAL => {
                let reason = "sRGB colours need an `assumed_gamma` above them";
                let remedy = "Write `global_settings { assumed_gamma 1 }` at the start.";
                self.refused_by_povray(self.span_of(at), reason, remedy);
                Gamma::LINEAR
            }
            None => {
                return Err(self.with_trace(
                    Diagnostic::error(self.span_of(at), "sRGB colours need a working gamma")
                        .with_hint("Set `global_settings { assumed_gamma 1 }` above."),
                ));
            }
        };
        for part in &mut parts[..3] {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "colours are single precision"
            )]
            let stored = *part as f32;
            *part = f64::from(working.encode(Gamma::Srgb.decode(stored)));
        }
        Ok(())
    }

    /// A colour if one begins here: a word of colour, a colour identifier, or a vector of five.
    pub(crate) fn color_if_begun(&mut self) -> Parse<Option<Color>> {
        let token = self.peek()?;
        let begins = match token.kind {
            Kind::Word => token
                .word()
                .is_some_and(|word| word.class() == Class::Color),
            Kind::Name => match self.mixed_item_ahead(Symbol(token.value))? {
                Some(item) => holds_color(&item),
                None => self
                    .scopes
                    .get(Symbol(token.value))
                    .is_some_and(holds_color),
            },
            Kind::Mark => token.is_mark('<'),
            _ => false,
        };
        if !begins {
            return Ok(None);
        }
        let start = self.start()?;
        if token.kind == Kind::Mark {
            let number = self.sum()?;
            if number.len != 5 {
                return Err(self.with_trace(
                    Diagnostic::error(
                        self.span_from(start),
                        format!("expected a colour, found {}", number.kind()),
                    )
                    .with_hint("Write `rgb` before the vector."),
                ));
            }
            self.finite(&number.v, start)?;
            return Ok(Some(Color::from_components(number.v)));
        }
        self.color_value().map(Some)
    }

    /// True if the next token can begin an expression.
    pub(crate) fn begins_number(&mut self) -> Parse<bool> {
        let token = self.peek()?;
        Ok(match token.kind {
            Kind::Number => true,
            Kind::Mark => "<(-+!".contains(char::from_u32(token.value).unwrap_or(' ')),
            Kind::Name => match self.scopes.get(Symbol(token.value)) {
                Some(Value::Number(_) | Value::Poison(_)) => true,
                Some(array @ Value::Array(_)) if array.is_mixed() => {
                    let item = self.mixed_item_ahead(Symbol(token.value))?;
                    item.is_some_and(|item| matches!(item, Value::Number(_)) || is_callable(&item))
                }
                Some(Value::Array(array)) => array
                    .first()
                    .is_none_or(|item| matches!(item, Value::Number(_)) || is_callable(item)),
                _ => self.at_call(),
            },
            Kind::Word => token
                .word()
                .is_some_and(|word| self.begins_expression(word)),
            _ => false,
        })
    }

    /// True if a reserved word begins an expression with a numeric value.
    pub(crate) fn begins_expression(&self, word: Word) -> bool {
        match word.class() {
            Class::Value => true,
            Class::Function => {
                !self.begins_string(word) && word != Word::Function && word != Word::Internal
            }
            _ => word == Word::Version,
        }
    }
}

/// True if a value is a colour, or an array of colours.
fn holds_color(value: &Value) -> bool {
    match value {
        Value::Number(number) => number.len == 5,
        Value::Array(array) => array.first().is_some_and(holds_color),
        _ => false,
    }
}

/// True if a word sets one component, so that it may follow a colour and change it.
pub(super) fn is_component(word: Word) -> bool {
    matches!(
        word,
        Word::Red | Word::Green | Word::Blue | Word::Filter | Word::Transmit | Word::Alpha
    )
}

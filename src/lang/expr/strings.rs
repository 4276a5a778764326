//! Strings and the functions that return them.

use super::datetime;
use super::text::Text;
use super::value::Value;
use crate::base::args::{Parse, Word};
use crate::base::source::{Diagnostic, Span};
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol};
use crate::scene::Charset;

impl Reader<'_> {
    /// True if a word begins a string.
    pub(crate) fn begins_string(&self, word: Word) -> bool {
        use Word::{Chr, Concat, Datetime, Str, Strlwr, Strupr, Substr, Vstr};
        matches!(
            word,
            Chr | Concat | Datetime | Str | Strlwr | Strupr | Substr | Vstr
        )
    }

    /// A string: a literal, an identifier, or a call of a string function.
    pub(crate) fn string(&mut self) -> Parse<String> {
        Ok(self.text()?.into_letters())
    }

    /// The same as a value.
    pub(crate) fn text(&mut self) -> Parse<Text> {
        let token = self.peek()?;
        match token.kind {
            Kind::String => {
                self.pass();
                Ok(self.string_literal(token.value)?.into())
            }
            Kind::Name => match self.scopes.get(Symbol(token.value)) {
                Some(Value::Text(text)) => {
                    let text = text.clone();
                    self.pass();
                    self.warn_of_qualified(Symbol(token.value));
                    Ok(text)
                }
                Some(Value::Array(_)) => match self.array_or_item()? {
                    Value::Text(text) => Ok(text),
                    other => {
                        Err(self.error_taken(format!("expected a string, found {}", other.kind())))
                    }
                },
                Some(Value::Poison(why)) => Err(self.consequence_of(why.as_deref())),
                _ => Err(self.expected_here("a string")),
            },
            _ => match token.word().filter(|&word| self.begins_string(word)) {
                Some(word) => self.nested(|reader| {
                    reader.statement.depth += 1;
                    let text = reader.string_function(word);
                    reader.statement.depth = reader.statement.depth.saturating_sub(1);
                    text
                }),
                None => Err(self.expected_here("a string")),
            },
        }
    }

    fn string_literal(&mut self, value: u32) -> Parse<String> {
        if let Some(escape) = self.last.tokens.bad_escape(value) {
            return Err(self.bad_escape(escape));
        }
        let is_plain = self.draft.globals.charset == Charset::Utf8
            || self.draft.version < 3.5
            || self.last.tokens.string_raw(value).is_ascii();
        if is_plain {
            return Ok(up_to_nul(self.last.tokens.string(value)));
        }
        let message = "letters beyond ASCII are read as blanks here, as in POV-Ray";
        let hint = "Write `global_settings { charset utf8 }` above, or `\\uXXXX` for the letters.";
        self.warning(Diagnostic::warning(self.taken_span(), message).with_hint(hint));
        let is_latin1 = self.sources.is_latin1(self.last.tokens.file);
        let text = self.last.tokens.string_in_ascii(value, is_latin1);
        Ok(up_to_nul(text))
    }

    fn bad_escape(&self, escape: Span) -> Box<Diagnostic> {
        let written = self.source_text(escape);
        self.with_trace(
            Diagnostic::error(escape, format!("`{written}` in a string means nothing"))
                .with_hint("Write `\\\\` for a backslash; `\\n` is a new line, `\\\"` a quote."),
        )
    }

    fn string_function(&mut self, word: Word) -> Parse<Text> {
        self.pass();
        let name = self.taken_span();
        self.expect_call(word)?;
        let open = self.start_taken();
        let text = match word {
            Word::Concat => {
                let text = self.concatenated(name)?;
                self.end_of_call(word, open)?;
                return Ok(text);
            }
            Word::Chr => {
                let code = self.number_at_sum()?;
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "checked by from_u32"
                )]
                let letter = char::from_u32(code as u32).filter(|_| (0.0..65536.0).contains(&code));
                match letter {
                    Some(letter) => up_to_nul(String::from(letter)),
                    None => return Err(self.error_taken(format!("no letter has the code {code}"))),
                }
            }
            Word::Str => {
                let value = self.number_at_sum()?;
                self.take_mark(',')?;
                let (width, digits) = self.width_and_digits()?;
                formatted(value, width, digits)
            }
            Word::Vstr => self.vstr()?,
            Word::Strlwr => self.string()?.to_ascii_lowercase(),
            Word::Strupr => self.string()?.to_ascii_uppercase(),
            Word::Substr => self.substr()?,
            Word::Datetime => self.datetime()?,
            _ => {
                return Err(self.with_trace(Diagnostic::error(
                    name,
                    format!("`{word}` is not supported yet"),
                )));
            }
        };
        self.end_of_call(word, open)?;
        Ok(text.into())
    }

    /// The strings of `concat`, whose name has this span.
    fn concatenated(&mut self, name: Span) -> Parse<Text> {
        let mut text = self.text()?;
        while self.take_mark(',')? || self.at_string()? {
            let more = self.text()?;
            self.take_memory(text.bytes_to_push(&more) as u64, name)?;
            text.push(&more);
            if text.len() > limits::STRING {
                let message = format!("a string has at most {} bytes", limits::STRING);
                return Err(self.error_taken(message));
            }
        }
        Ok(text)
    }

    fn width_and_digits(&mut self) -> Parse<(i32, i32)> {
        let width = self.number_at_sum()?;
        self.take_mark(',')?;
        let digits = self.number_at_sum()?;
        #[allow(clippy::cast_possible_truncation, reason = "clamped")]
        Ok((
            width.clamp(-400.0, 400.0) as i32,
            digits.clamp(-1.0, 60.0) as i32,
        ))
    }

    fn vstr(&mut self) -> Parse<String> {
        let count = self.number_at_sum()?;
        self.take_mark(',')?;
        // Only here a float is a single component.
        let vector = self.sum()?;
        self.take_mark(',')?;
        let between = self.string()?;
        self.take_mark(',')?;
        let (width, digits) = self.width_and_digits()?;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped"
        )]
        let count = count.clamp(2.0, 5.0) as usize;
        let parts: Vec<String> = vector.v[..count]
            .iter()
            .map(|&v| formatted(v, width, digits))
            .collect();
        Ok(parts.join(&between))
    }

    /// `days since 2000 [, format]`.
    fn datetime(&mut self) -> Parse<String> {
        let days = self.number_at_sum()?;
        if !self.take_mark(',')? {
            return Ok(datetime::text(days, datetime::DEFAULT));
        }
        let format = self.string()?;
        if format.is_empty() {
            return Err(self.error_taken("the format of `datetime` is empty"));
        }
        Ok(datetime::text(days, &format))
    }

    /// `string, first, count`, both truncated. From letter 0 on the result is empty, whatever the count.
    fn substr(&mut self) -> Parse<String> {
        let text: Vec<char> = self.string()?.chars().collect();
        self.take_mark(',')?;
        let from = self.number_at_sum()?.trunc();
        self.take_mark(',')?;
        let length = self.number_at_sum()?.trunc();
        if !(from >= 0.0 && length >= 0.0 && from - 1.0 + length <= text.len() as f64) {
            return Err(self.error_taken(format!(
                "`substr` asks for {length} characters from number {from} on of a string of {}",
                text.len()
            )));
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked just above"
        )]
        let (from, length) = (from as usize, length as usize);
        Ok(match from.checked_sub(1) {
            Some(before) => text[before..before + length].iter().collect(),
            None => String::new(),
        })
    }
}

/// Cuts a string at its first NUL.
fn up_to_nul(mut text: String) -> String {
    if let Some(end) = text.find('\0') {
        text.truncate(end);
    }
    text
}

/// As C's `%*.*f`: negative width pads with zeros, negative digits mean six.
fn formatted(value: f64, width: i32, digits: i32) -> String {
    let digits = usize::try_from(digits).unwrap_or(6);
    let length = width.unsigned_abs() as usize;
    if !value.is_finite() {
        let sign = if value.is_sign_negative() { "-" } else { "" };
        let name = if value.is_nan() { "nan" } else { "inf" };
        return format!("{:>length$}", format!("{sign}{name}"));
    }
    if width < 0 {
        format!("{value:0length$.digits$}")
    } else {
        format!("{value:length$.digits$}")
    }
}

/// As C's `%g`: six digits, without trailing zeros, in the shorter form.
pub(crate) fn general(value: f64) -> String {
    const DIGITS: i32 = 6;
    if !value.is_finite() {
        return formatted(value, 0, 0);
    }
    let scientific = format!("{value:.5e}");
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..DIGITS).contains(&exponent) {
        let places = usize::try_from(DIGITS - 1 - exponent).unwrap_or(0);
        return without_zeros(&format!("{value:.places$}")).to_owned();
    }
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{}e{sign}{:02}", without_zeros(mantissa), exponent.abs())
}

fn without_zeros(number: &str) -> &str {
    if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        number
    }
}

#[cfg(test)]
mod tests {
    use super::{formatted, general};

    /// Measured with POV-Ray's `#write`.
    #[test]
    fn numbers_are_written_as_in_c() {
        let written = [
            1.0,
            1.0 / 3.0,
            1e10,
            123_456_789.0,
            1e-7,
            -0.5,
            999_999.5,
            1e100,
            -0.0,
        ];
        let expected = "1 0.333333 1e+10 1.23457e+08 1e-07 -0.5 1e+06 1e+100 -0";
        assert_eq!(written.map(general).join(" "), expected);
        assert_eq!(general(1e-4), "0.0001");
        assert_eq!(general(100_000.0), "100000");
        assert_eq!(general(f64::INFINITY), "inf");
    }

    #[test]
    fn numbers_are_padded_as_in_c() {
        assert_eq!(formatted(std::f64::consts::PI, 8, 2), "    3.14");
        assert_eq!(formatted(std::f64::consts::PI, -8, 2), "00003.14");
        assert_eq!(formatted(2.0, 0, -1), "2.000000");
        assert_eq!(formatted(f64::NEG_INFINITY, -6, 1), "  -inf");
        assert_eq!(formatted(f64::NAN.copysign(-1.0), 0, 3), "-nan");
    }
}

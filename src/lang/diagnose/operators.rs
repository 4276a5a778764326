//! Operators as other languages write them, and words instead of operators.

use crate::base::args::Word;
use crate::base::source::Span;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::expr::value::Value;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Token};
use std::ops::Range;

/// Most tokens before and behind an operator in a value.
const OPERANDS: usize = 32;

impl Reader<'_> {
    /// The operator that is meant by the next token, where a value or an operator is expected.
    pub(super) fn foreign_operator(&self, token: Token, wanted: &str) -> Option<Remedy> {
        let is_value = wanted.starts_with("a number") || wanted == "a value";
        let is_power = token.is_mark('^') || token.is_mark('%');
        if !is_value && !wanted.contains("operator") && !is_power {
            return None;
        }
        match token.kind {
            Kind::Name => self.operator_in_letters(is_value),
            Kind::Mark => self.operator_in_marks(char::from_u32(token.value)?),
            _ => self.word_between_operands(token.word()?),
        }
    }

    /// True if the next token is an operator of another language, between a value and another.
    pub(crate) fn is_at_foreign_operator(&self) -> bool {
        let token = self.raw();
        match token.kind {
            Kind::Name => {
                let is_number = self.last.tokens.tokens[self.last.at].kind == Kind::Number;
                let touches = self.taken_span().end == self.here_span().start;
                is_number && touches || self.operator_in_letters(false).is_some()
            }
            Kind::Word => token
                .word()
                .and_then(|word| self.word_between_operands(word))
                .is_some(),
            _ => char::from_u32(token.value)
                .filter(|_| token.kind == Kind::Mark)
                .is_some_and(|mark| !mark.is_ascii() || "%^=&|<>!?:,)".contains(mark)),
        }
    }

    /// `and`, `or` and `not`, where they are not declared.
    fn operator_in_letters(&self, begins_value: bool) -> Option<Remedy> {
        let text = self.source_text(self.here_span());
        let (operator, name) = match (text.to_lowercase().as_str(), begins_value) {
            ("and", false) => ("&", "and"),
            ("or", false) => ("|", "or"),
            ("not", true) => ("!", "not"),
            _ => return None,
        };
        let is_declared = self
            .raw()
            .symbol()
            .is_some_and(|name| self.scopes.get(name).is_some());
        if is_declared {
            return None;
        }
        let hint = format!("`{operator}` means \"{name}\".");
        let (at, behind) = (self.here.at, self.here.tokens.span(self.here.at + 1));
        // `not A` is `!A`.
        let span = match begins_value && !self.raw_ahead(1).is_mark('(') {
            true => {
                let span = self.here.tokens.span(at);
                Span::new(span.file, span.start, behind.start)
            }
            false => self.here_span(),
        };
        Some(Remedy::fix(hint, span, operator))
    }

    /// A declared value with operators that stand in parentheses only: `A > B`, `A > B ? C : D`.
    pub(super) fn value_without_parentheses(&self, token: Token, wanted: &str) -> Option<Remedy> {
        let mark = char::from_u32(token.value).filter(|_| token.kind == Kind::Mark);
        if !wanted.starts_with("an operator or `;`")
            || !mark.is_some_and(|mark| "<>=!&|?".contains(mark))
        {
            return None;
        }
        let at = self.here.at;
        let is_mark = |at: usize, mark| self.token(at).is_some_and(|token| token.is_mark(mark));
        let start = (at.saturating_sub(OPERANDS)..at).rfind(|&at| is_mark(at, '='))? + 1;
        let end = (at..at + OPERANDS).find(|&at| is_mark(at, ';'))?;
        let span = self.tokens_span(start..end);
        let text = format!("({})", self.source_text(span));
        let hint = "Comparisons and choices stand in parentheses";
        Some(Remedy::fix(format!("{hint}: `{text}`."), span, text))
    }

    fn operator_in_marks(&self, mark: char) -> Option<Remedy> {
        let at = self.here.at;
        let before = at.checked_sub(1)?;
        let span = self.tokens_span(before..at + 1);
        let touches = self.here.tokens.span(before).end == self.here_span().start;
        let before = self.token(before)?;
        let begun = (before.kind == Kind::Mark && touches)
            .then(|| char::from_u32(before.value))
            .flatten();
        let single = |hint: &str, text: &str| Some(Remedy::fix(hint, span, text));
        match (begun, mark) {
            (Some('='), '=') => single("One `=` compares two values.", "="),
            (Some('&'), '&') => single("One `&` means \"and\".", "&"),
            (Some('|'), '|') => single("One `|` means \"or\".", "|"),
            (Some('<'), '>') if self.ends_operand(at.checked_sub(2)?) => {
                single("\"Not equal\" is `!=`.", "!=")
            }
            (Some('='), '<') => single("\"Less or equal\" is `<=`.", "<="),
            (Some('='), '>') => single("\"Greater or equal\" is `>=`.", ">="),
            (Some('*'), '*') => {
                self.call_of_operands(at - 1..at + 1, "pow", "A power is `pow(a, b)`.")
            }
            (_, '^') => self.call_of_operands(at..at + 1, "pow", "A power is `pow(a, b)`."),
            (_, '%') if self.is_operand(at + 1) => self.call_of_operands(
                at..at + 1,
                "mod",
                "The remainder of a division is `mod(a, b)`.",
            ),
            (_, '|') if !self.ends_operand(at - 1) => {
                Some("An absolute value is `abs(a)`, a length `vlength(v)`.".into())
            }
            _ => None,
        }
    }

    /// `a mod b` and `a div b`.
    fn word_between_operands(&self, word: Word) -> Option<Remedy> {
        let at = self.here.at;
        let is_infix = matches!(word, Word::Mod | Word::Div) && !self.raw_ahead(1).is_mark('(');
        let hint = match word {
            Word::Mod => "The remainder of a division is `mod(a, b)`.",
            _ => "A division of whole numbers is `div(a, b)`.",
        };
        (is_infix && self.is_operand(at.checked_sub(1)?))
            .then(|| self.call_of_operands(at..at + 1, word.spelling(), hint))
            .flatten()
    }

    /// The call of a function in place of an operator, where both operands are single tokens.
    fn call_of_operands(
        &self,
        operator: Range<usize>,
        function: &str,
        hint: &str,
    ) -> Option<Remedy> {
        let (left, right) = (operator.start.checked_sub(1)?, operator.end);
        let is_sign = |at: Option<usize>, signs: &[char]| {
            let token = at.and_then(|at| self.token(at));
            token.is_some_and(|token| signs.iter().any(|&sign| token.is_mark(sign)))
        };
        let is_alone = self.is_operand(left)
            && self.is_operand(right)
            && !is_sign(left.checked_sub(1), &['*', '/', '.', '^', '%'])
            && !is_sign(Some(right + 1), &['(', '[', '.', '^', '%'])
            && !(operator.len() == 2 && is_sign(Some(right + 1), &['*']));
        if !is_alone {
            return Some(hint.into());
        }
        let text = |at: usize| self.source_text(self.here.tokens.span(at));
        let call = format!("{function}({}, {})", text(left), text(right));
        Some(Remedy::fix(hint, self.tokens_span(left..right + 1), call))
    }

    /// `2R` and `2pi`, without `*`.
    pub(super) fn missing_factor(&self, token: Token) -> Option<Remedy> {
        let before = self.here.at.checked_sub(1)?;
        let last = self.here.tokens.span(before);
        let touches = last.end == self.here_span().start;
        let is_factor = self.token(before)?.kind == Kind::Number && touches;
        let value = token.symbol().and_then(|name| self.scopes.get(name));
        let is_value =
            matches!(value, Some(Value::Number(_))) || token.word().is_some_and(Word::is_value);
        (is_factor && is_value).then(|| {
            let product = format!(
                "{}*{}",
                self.source_text(last),
                self.source_text(self.here_span())
            );
            let hint = format!("Write `*` between factors: `{product}`.");
            Remedy::fix(hint, last.to(self.here_span()), product)
        })
    }

    /// True if a value ends with a token.
    fn ends_operand(&self, at: usize) -> bool {
        let closes = |token: Token| token.is_mark(')') || token.is_mark(']');
        self.is_operand(at) || self.token(at).is_some_and(closes)
    }

    /// True if a token alone is a value.
    pub(super) fn is_operand(&self, at: usize) -> bool {
        self.token(at).is_some_and(|token| match token.kind {
            Kind::Number | Kind::Name => true,
            _ => token.word().is_some_and(Word::is_value),
        })
    }
}

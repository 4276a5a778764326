//! Remedies that rewrite what was written: vectors without `<` and `>`, assignments without `#declare`, axes beside
//! numbers, strings without quotes.

use crate::base::args::Word;
use crate::base::source::Span;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::diagnose::unclosed::begins_new;
use crate::lang::expr::value::Value;
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind};

/// Most tokens that a rewritten vector spans.
const VECTOR_TOKENS: usize = 64;

/// Most bytes of braces that are rewritten.
const BRACES: usize = 400;

impl Reader<'_> {
    /// A vector in the brackets that open at a token: `(1, 0, 0)`.
    pub(crate) fn vector_in_brackets(&self, open: usize) -> Option<Remedy> {
        let brackets = [('(', ')'), ('[', ']'), ('{', '}')];
        let opening = self.token(open)?;
        let (_, close) = brackets
            .into_iter()
            .find(|&(mark, _)| opening.is_mark(mark))?;
        let mut depth = 0;
        let mut commas = 0;
        for at in open + 1..open + VECTOR_TOKENS {
            let token = self.token(at)?;
            let mark = (token.kind == Kind::Mark)
                .then(|| char::from_u32(token.value))
                .flatten();
            match (token.kind, mark) {
                (Kind::Mark, Some(mark)) if depth == 0 && mark == close => {
                    let span = self.tokens_span(open..at + 1);
                    let inner = self.source_text(span);
                    let inner = inner.get(1..inner.len() - 1)?.trim();
                    let is_short = inner.len() <= limits::QUOTED && !inner.contains(['\n', '\r']);
                    return ((1..=4).contains(&commas) && is_short).then(|| {
                        let scale = if self.holds_bytes(open, inner) {
                            "/255"
                        } else {
                            ""
                        };
                        let vector = format!("<{inner}>{scale}");
                        Remedy::fix(format!("Write a vector as `{vector}`."), span, vector)
                    });
                }
                (Kind::Mark, Some('(')) => depth += 1,
                (Kind::Mark, Some(')')) => depth -= 1,
                (Kind::Mark, Some(',')) if depth == 0 => commas += 1,
                (Kind::Mark, Some('+' | '-' | '*' | '/' | '.' | ',')) => {}
                (Kind::Number | Kind::Name, _) => {}
                (Kind::Word, _) if token.word()?.is_value() => {}
                _ => return None,
            }
        }
        None
    }

    /// True for the components of a colour from 0 to 255, in brackets that open at a token.
    fn holds_bytes(&self, open: usize, components: &str) -> bool {
        let before = open.checked_sub(1).and_then(|at| self.token(at)?.word());
        let numbers: Option<Vec<u8>> = components
            .split(',')
            .map(|number| number.trim().parse().ok())
            .collect();
        before.is_some_and(|word| word.class() == Class::Color)
            && numbers.is_some_and(|numbers| numbers.iter().any(|&number| number > 1))
    }

    /// The same for the `(` of a span in the current text.
    pub(crate) fn vector_in_parentheses(&self, open: Span) -> Option<Remedy> {
        let tokens = &self.here.tokens;
        let at = tokens
            .tokens
            .partition_point(|token| token.start < open.start);
        (tokens.file == open.file)
            .then(|| self.vector_in_brackets(at))
            .flatten()
    }

    /// `N = N + 1;`, `N += 1;` or `N++;` at the next token, a name, without `#declare`.
    pub(crate) fn assignment(&self) -> Option<Remedy> {
        let at = self.here.at;
        let name = self.source_text(self.here_span());
        let is_mark = |ahead: usize, mark| self.raw_ahead(ahead).is_mark(mark);
        let mut behind = at + 1;
        while self.raw().symbol().is_some() && self.token(behind)?.is_mark('[') {
            behind = self.end_of_brackets(behind, '[', ']')?;
        }
        let line = self.rest_of_line(at);
        let statement = line.split_inclusive(';').next()?;
        let operator = ['+', '-', '*', '/']
            .into_iter()
            .find(|&mark| is_mark(1, mark));
        let (replaced, text) = match operator {
            None if is_mark(behind - at, '=') && !is_mark(behind + 1 - at, '=') => {
                (0, "#declare ".to_owned())
            }
            Some(mark) if is_mark(2, '=') => {
                let operators = self.tokens_span(at..at + 3);
                let value = statement.get((operators.end - operators.start) as usize..)?;
                let value = value.trim_end_matches(';').trim();
                let value =
                    match value.contains(|c: char| !(c.is_alphanumeric() || "_.".contains(c))) {
                        true => format!("({value})"),
                        false => value.to_owned(),
                    };
                let end = if statement.ends_with(';') { ";" } else { "" };
                let text = format!("#declare {name} = {name} {mark} {value}{end}");
                (statement.len(), text)
            }
            Some(mark @ ('+' | '-')) if is_mark(2, mark) => {
                let operators = self.tokens_span(at..at + 3);
                let text = format!("#declare {name} = {name} {mark} 1");
                ((operators.end - operators.start) as usize, text)
            }
            _ => return None,
        };
        let rest = statement.get(replaced..)?;
        let whole = format!("{text}{rest}");
        let has_comment = whole.contains("//") || whole.contains("/*");
        if !whole.ends_with(';') || has_comment || whole.len() > limits::QUOTED {
            return Some("A name gets its value by `#declare NAME = value;`.".into());
        }
        let hint = format!("A name gets its value by `#declare`: `{whole}`.");
        Some(Remedy::fix(hint, self.bytes_from(at, replaced), text))
    }

    /// An axis and a number side by side after a transform, of which the next token is the second: `rotate y 45`.
    pub(crate) fn axis_and_number(&self) -> Option<Remedy> {
        let at = self.here.at;
        let is_number = |at: usize| {
            self.token(at)
                .is_some_and(|token| token.kind == Kind::Number)
        };
        let axis_at = |at: usize| {
            let word = self.token(at)?.word();
            word.filter(|word| matches!(word, Word::X | Word::Y | Word::Z))
        };
        let first = at.checked_sub(1)?;
        let (axis, number) = match (axis_at(first), axis_at(at)) {
            (Some(axis), None) if is_number(at) => (axis, at),
            (None, Some(axis)) if is_number(first) => (axis, first),
            _ => return None,
        };
        let has_sign = first > 0 && self.token(first - 1)?.is_mark('-');
        let start = first - usize::from(has_sign);
        let transform = self.token(start.checked_sub(1)?)?.word()?;
        let sign = if has_sign { "-" } else { "" };
        let number = self.source_text(self.here.tokens.span(number));
        let vector = match transform {
            Word::Rotate | Word::Translate => format!("{sign}{number}*{axis}"),
            Word::Scale => match axis {
                Word::X => format!("<{sign}{number}, 1, 1>"),
                Word::Y => format!("<1, {sign}{number}, 1>"),
                _ => format!("<1, 1, {sign}{number}>"),
            },
            _ => return None,
        };
        let mut written = format!("{transform} {vector}");
        let mut end = at + 1;
        // `rotate x 90 y 45`
        while transform != Word::Scale
            && let (Some(axis), true) = (axis_at(end), is_number(end + 1))
        {
            let number = self.source_text(self.here.tokens.span(end + 1));
            written.push_str(&format!(" {transform} {number}*{axis}"));
            end += 2;
        }
        let hint = format!("Write `{written}`.");
        Some(Remedy::fix(hint, self.tokens_span(start - 1..end), written))
    }

    /// Numbers in a row around the next token that should be one vector, or one number with a decimal comma.
    pub(crate) fn numbers_in_a_row(&self) -> Option<Remedy> {
        let at = self.here.at;
        if let Some(remedy) = self.decimal_comma() {
            return Some(remedy);
        }
        let is_part = |at: usize| {
            let token = self.token(at)?;
            let is_part = token.kind == Kind::Number || token.is_mark(',') || token.is_mark('-');
            is_part.then_some(token)
        };
        let mut start = at;
        while start > at.saturating_sub(VECTOR_TOKENS) && is_part(start - 1).is_some() {
            start -= 1;
        }
        // The comma after a vector that precedes the numbers.
        let is_after_comma = self.token(start)?.is_mark(',');
        start += usize::from(is_after_comma);
        let mut end = at;
        while end < at + VECTOR_TOKENS && is_part(end).is_some() {
            end += 1;
        }
        let mut numbers = Vec::new();
        let mut sign = "";
        let mut has_difference = false;
        for at in start..end {
            let token = self.token(at)?;
            if token.is_mark('-') {
                let follows_number = at > start && self.token(at - 1)?.kind == Kind::Number;
                let [before, here, after] =
                    [at.saturating_sub(1), at, at + 1].map(|at| self.here.tokens.span(at));
                let is_sign = before.end < here.start && here.end == after.start;
                has_difference |= follows_number && !is_sign;
                sign = "-";
            } else if token.kind == Kind::Number {
                let number = self.source_text(self.here.tokens.span(at));
                numbers.push(format!("{sign}{number}"));
                sign = "";
            }
        }
        let closes = self.token(end).is_some_and(|token| token.is_mark('>'));
        let mut span = self.tokens_span(start..end.max(start + 1) + usize::from(closes));
        let first = start.checked_sub(1)?;
        let before = self.token(first)?.word();
        let is_declared = self.token(first)?.is_mark('=');
        let is_pair =
            numbers.len() == 2 && self.words_of_blocks().next() == Some(Word::Superellipsoid);
        if !is_pair
            && (!(3..=5).contains(&numbers.len())
                || before.is_none() && !is_after_comma && !is_declared)
        {
            return None;
        }
        let mut vector = format!("<{}>", numbers.join(", "));
        let is_component = |word: Word| matches!(word, Word::Red | Word::Green | Word::Blue);
        if before.is_some_and(is_component) {
            vector = format!("rgb {vector}");
            span = self.here.tokens.span(first).to(span);
        }
        let is_color =
            before.is_some_and(|word| is_component(word) || word.class() == Class::Color);
        if is_color
            && numbers.iter().all(|number| number.parse::<u8>().is_ok())
            && numbers
                .iter()
                .any(|number| !matches!(number.as_str(), "0" | "1"))
        {
            vector = format!("{vector}/255");
        }
        let hint = match is_color && vector.ends_with("/255") {
            true => format!("Write the colour as `{vector}`."),
            false => format!("Write a vector as `{vector}`."),
        };
        let remedy = Remedy::fix(hint, span, vector);
        Some(match before {
            _ if (is_declared || is_pair) && !has_difference => remedy,
            Some(word)
                if numbers.len() == 3
                    && (is_component(word) || !word.is_value())
                    && !has_difference =>
            {
                remedy
            }
            _ => remedy.uncertain(),
        })
    }

    /// Two numbers that touch the comma at the next token, as no others in the line do: one number.
    fn decimal_comma(&self) -> Option<Remedy> {
        let at = self.here.at;
        let parts = at.checked_sub(1)?..at + 2;
        let is_number = |at: usize| {
            self.token(at)
                .is_some_and(|token| token.kind == Kind::Number)
        };
        let span = self.tokens_span(parts.clone());
        let (whole, fraction) = self.source_text(span).split_once(',')?;
        let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        let touches = |at: usize| {
            let here = self.here.tokens.span(at).end;
            here == self.here.tokens.span(at + 1).start
        };
        let is_comma = |at: Option<usize>| {
            at.and_then(|at| self.token(at))
                .is_some_and(|token| token.is_mark(','))
        };
        let has_others = is_comma(Some(at + 2))
            || parts.start > 0 && is_comma(parts.start.checked_sub(1)) && touches(parts.start - 1);
        let is_one = self.raw().is_mark(',')
            && is_number(parts.start)
            && is_number(at + 1)
            && is_digits(whole)
            && is_digits(fraction);
        (is_one && !has_others).then(|| {
            let number = format!("{whole}.{fraction}");
            let hint = format!("The decimal point is `.`: write `{number}`.");
            Remedy::fix(hint, span, number)
        })
    }

    /// A vector with commas for decimal points, from its `<` on: `<0,5, 1,2, 3>`, `<0,5; 1,2; 3>`.
    pub(super) fn decimal_commas(&self, open: Span) -> Option<Remedy> {
        let text = self.sources.text(open.file).get(open.start as usize..)?;
        let inner = text.lines().next()?.strip_prefix('<')?.split('>').next()?;
        let separator = if inner.contains(';') { ";" } else { ", " };
        let parts: Vec<&str> = inner.split(separator).map(str::trim).collect();
        let is_number = |part: &&str| {
            let digits = part.strip_prefix('-').unwrap_or(part);
            let (whole, fraction) = digits.split_once(',').unwrap_or((digits, "0"));
            let is_digits =
                |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
            is_digits(whole) && is_digits(fraction)
        };
        let is_vector = (2..=5).contains(&parts.len())
            && parts.iter().all(is_number)
            && parts.iter().any(|part| part.contains(','))
            && (parts.len() > 2 || parts.iter().all(|part| part.contains(',')));
        is_vector.then(|| {
            let vector = format!("<{}>", parts.join("; ").replace(',', ".").replace(';', ","));
            let end = open.start + u32::try_from(inner.len()).unwrap_or(0) + 2;
            let hint = format!("The decimal point is `.`: write `{vector}`.");
            Remedy::fix(hint, Span::new(open.file, open.start, end), vector)
        })
    }

    /// A string without quotes, in `'` or in `<` and `>`, at the next token.
    pub(crate) fn unquoted_string(&self) -> Option<Remedy> {
        let at = self.here.at;
        let line = self.rest_of_line(at);
        let is_name = |text: &str| {
            let is_part = |c: char| c.is_alphanumeric() || "_-./ ".contains(c);
            !text.is_empty() && text.chars().all(is_part)
        };
        let in_marks = |open: char, close: char| {
            let text = line.strip_prefix(open)?.split(close).next()?;
            let len = text.len() + 2;
            (is_name(text) && line.len() >= len).then_some((text, len))
        };
        let word = line
            .split(|c: char| c.is_whitespace() || ";}{,".contains(c))
            .next()?;
        let bare = (is_name(word) && word.contains('.')).then_some((word, word.len()));
        let (text, len) = in_marks('\'', '\'')
            .or_else(|| in_marks('<', '>'))
            .or_else(|| in_marks('`', '`'))
            .or(bare)?;
        let string = format!("\"{text}\"");
        let hint = format!("Strings stand in double quotes: `{string}`.");
        Some(Remedy::fix(hint, self.bytes_from(at, len), string))
    }

    /// The argument of a function without parentheses: `sin 30`.
    pub(crate) fn argument_without_parentheses(&self) -> Option<Remedy> {
        let function = self.token(self.here.at.checked_sub(1)?)?.word()?;
        let is_argument = matches!(self.raw().kind, Kind::Number | Kind::Name)
            || self
                .raw()
                .word()
                .is_some_and(|word| word.class() == Class::Value);
        let at = self.here.at;
        let end = match is_argument {
            true => at + 1,
            false if self.raw().is_mark('<') => self.end_of_brackets(at, '<', '>')?,
            false => return None,
        };
        let span = self.tokens_span(at..end);
        let argument = self.source_text(span);
        (function.class() == Class::Function).then(|| {
            let hint = format!("Arguments stand in parentheses: `{function}({argument})`.");
            Remedy::fix(hint, span, format!("({argument})"))
        })
    }

    /// `#define R 1` or `#define S(X) X*X`, from the name on, without `=`.
    pub(crate) fn definition_of_c(&self, hash: Span) -> Option<Remedy> {
        let at = self.here.at;
        let name = self
            .raw()
            .symbol()
            .map(|_| self.source_text(self.here_span()))?;
        let line = self.rest_of_line(at);
        let code = line.split("//").next()?.trim_end();
        let value = code.get(name.len()..)?;
        let is_macro = value.starts_with('(');
        let is_value = !value.trim().is_empty() && !value.contains(['=', ';']);
        if !is_value || code.len() > limits::QUOTED {
            return None;
        }
        let text = match is_macro {
            true => format!("#macro {code} #end"),
            false => format!("#declare {name} = {};", value.trim()),
        };
        let span = hash.to(self.bytes_from(at, code.len()));
        Some(Remedy::fix(format!("Write `{text}`."), span, text))
    }

    /// `--`, `/`, `'`, `;`, `%` or `!` where a statement is expected, before words of a comment: of those on the same line
    /// the first begins no statement.
    pub(crate) fn comment_of_other_languages(&self) -> Option<Remedy> {
        let (at, hint) = (self.here.at, "Comments begin with `//`.");
        let is_mark = |ahead: usize, mark| self.raw_ahead(ahead).is_mark(mark);
        let span = match self.raw() {
            token if token.is_mark('-') && is_mark(1, '-') => self.tokens_span(at..at + 2),
            token
                if ['/', '\'', ';', '%', '!']
                    .iter()
                    .any(|&mark| token.is_mark(mark)) =>
            {
                self.here_span()
            }
            _ => return None,
        };
        let is_word = |at: usize| {
            let token = self.token(at)?;
            let is_near = self.sources.line_column(self.here.tokens.span(at)).0
                == self.sources.line_column(span).0;
            let is_undeclared = |name| self.scopes.get(name).is_none();
            let is_word = match token.kind {
                Kind::Name => token.symbol().is_some_and(is_undeclared),
                Kind::Word => !begins_new(token),
                _ => false,
            };
            Some(is_near && is_word)
        };
        let is_dashed = span.end - span.start == 2;
        (is_dashed || is_word(at + 1) == Some(true)).then(|| Remedy::fix(hint, span, "//"))
    }

    /// A `{` where a statement is expected: after the head of a directive, or after the name of an object.
    pub(crate) fn braces_of_other_languages(&self) -> Option<Remedy> {
        let before = self.here.at.checked_sub(1)?;
        if let Some(name) = self.token(before)?.symbol()
            && matches!(self.scopes.get(name), Some(Value::Object(_)))
        {
            let span = self.tokens_span(before..before + 2);
            let name = self.source_text(self.here.tokens.span(before));
            let changed = format!("object {{ {name}");
            let hint = format!("Write `{changed} ... }}`.");
            return Some(Remedy::fix(hint, span, changed));
        }
        let mut depth = 0;
        let open = (0..=before).rev().find(|&at| {
            let Some(token) = self.token(at) else {
                return false;
            };
            depth += i32::from(token.is_mark(')')) - i32::from(token.is_mark('('));
            depth == 0
        })?;
        let is_directive = |back: usize| {
            let token = open.checked_sub(back).and_then(|at| self.token(at));
            token.is_some_and(|token| token.kind == Kind::Directive)
        };
        (self.token(open)?.is_mark('(') && (is_directive(1) || is_directive(2))).then(|| {
            let hint = "Directives take no `{` and `}`: write `#end` where they end.";
            self.end_for_braces(self.here.at)
                .unwrap_or_else(|| hint.into())
        })
    }

    /// The braces behind the head of a directive, of which the first opens at a token: their contents with `#end`.
    pub(crate) fn end_for_braces(&self, mut open: usize) -> Option<Remedy> {
        let file = self.here.tokens.file;
        let mut end = self.here.tokens.span(open.checked_sub(1)?).end;
        let start = end;
        let between = |from: u32, to: u32| self.source_text(Span::new(file, from, to));
        let mut text = String::new();
        loop {
            let opened = self.here.tokens.span(open);
            text.push_str(between(end, opened.start).trim_end_matches(' '));
            let behind = self.end_of_long_brackets(open, '{', '}')?;
            let closed = self.here.tokens.span(behind - 1);
            text.push_str(between(opened.end, closed.start));
            end = closed.end;
            match self.branch(behind) {
                Some(next) => {
                    end = self.here.tokens.span(behind).start;
                    open = next;
                }
                None => text.push_str("#end"),
            }
            if end == closed.end {
                break;
            }
        }
        (text.len() <= BRACES).then(|| {
            let hint = "Directives take no `{` and `}`: write `#end` where they end.";
            Remedy::fix(hint, Span::new(file, start, end), text)
        })
    }

    /// The body of a macro in braces, from its `#macro` on.
    pub(crate) fn braces_of_macro(&self, at: usize) -> Option<Remedy> {
        let open = self.end_of_brackets(at + 2, '(', ')')?;
        self.token(open)?
            .is_mark('{')
            .then(|| self.end_for_braces(open))?
    }

    /// The `{` behind the head of an `#else` or `#elseif` at a token.
    fn branch(&self, at: usize) -> Option<usize> {
        let token = self
            .token(at)
            .filter(|token| token.kind == Kind::Directive)?;
        let open = match self.here.tokens.directives[token.value as usize].word? {
            Word::Else => at + 1,
            Word::Elseif => self.end_of_brackets(at + 1, '(', ')')?,
            _ => return None,
        };
        self.token(open)?.is_mark('{').then_some(open)
    }
}

//! Values, blocks and names in the notation of other languages.

use crate::base::args::Word;
use crate::base::source::Span;
use crate::lang::diagnose::css_colors::{hexadecimal_color, written_color};
use crate::lang::diagnose::other_dialects;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::expr::value::Value;
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Token};
use std::ops::Range;

/// Most tokens of a condition, an equation or a name in parts.
const SHORT: usize = 64;

impl Reader<'_> {
    /// A block or value in other brackets, or in none.
    pub(super) fn foreign_brackets(&self, token: Token, wanted: &str) -> Option<Remedy> {
        if wanted == "`{` after `)`" && token.is_mark('(') {
            return self.rebracketed(
                '(',
                ')',
                "{",
                "}",
                "The body of a function stands in braces",
            );
        }
        if wanted == "`{` after `)`" {
            let body = self.until_mark(self.here.at, &[';', '{', '}'])?;
            let text = format!("{{ {} }}", self.source_text(body));
            let hint = format!("The body of a function stands in braces: `{text}`.");
            return Some(Remedy::fix(hint, body, text));
        }
        if let Some(word) = wanted.strip_prefix("`{` after `") {
            let word = word.trim_start_matches('#').strip_suffix('`')?;
            return self.block_without_braces(token, Word::from_spelling(word)?);
        }
        let is_in_map = || self.words_of_blocks().next().is_some_and(is_map);
        if wanted.starts_with("`[` and an entry of") || wanted == "`}`" && is_in_map() {
            return self.entry_without_brackets(token);
        }
        if wanted.starts_with("a value for `") && token.is_mark('{') {
            return self.array_without_size();
        }
        if wanted.starts_with("a value for `") && token.is_mark('[') {
            return self.array_in_brackets();
        }
        if wanted.starts_with("`=` after `#") && token.is_mark('[') {
            return self.array_by_name_and_size();
        }
        if wanted == "`(` after `#ifdef`" && token.kind == Kind::Name {
            let text = format!("({})", self.source_text(self.here_span()));
            let hint = format!("The name stands in parentheses: `{text}`.");
            return Some(Remedy::fix(hint, self.here_span(), text));
        }
        if wanted.starts_with("`(` and a condition") {
            return self.condition_without_parentheses();
        }
        if wanted.starts_with("`function` at the start of `isosurface`") {
            return self.equation_without_function();
        }
        None
    }

    /// The contents of the brackets at the next token, in other brackets.
    pub(super) fn rebracketed(
        &self,
        open: char,
        close: char,
        opening: &str,
        closing: &str,
        hint: &str,
    ) -> Option<Remedy> {
        let end = self.end_of_brackets(self.here.at, open, close)?;
        let span = self.tokens_span(self.here.at..end);
        let inner = self.source_text(span);
        let inner = inner.get(1..inner.len() - 1)?;
        if inner.len() > limits::QUOTED || inner.contains(['\n', '\r']) {
            return Some(format!("{hint}, `{opening}` and `{closing}`.").into());
        }
        let text = format!("{opening}{inner}{closing}");
        Some(Remedy::fix(format!("{hint}: `{text}`."), span, text))
    }

    /// The block of a word in `(` and `)`, `[` and `]`, or without brackets.
    fn block_without_braces(&self, token: Token, word: Word) -> Option<Remedy> {
        let at = self.here.at;
        let hint = format!("The parameters of `{word}` stand in braces");
        if token.is_mark('(') {
            return self.rebracketed('(', ')', "{", "}", &hint);
        }
        if token.is_mark('[') && is_map(word) {
            return self.entries_without_braces(word);
        }
        if token.is_mark('[') {
            return self.rebracketed('[', ']', "{", "}", &hint);
        }
        let end = match (word, token.kind) {
            (Word::ImageMap | Word::BumpMap | Word::HeightField, Kind::String) => {
                let name = self.source_text(self.here_span());
                let format = format_of(name.trim_matches('"'))?;
                let span = self.tokens_span(at..self.end_of_picture(at + 1));
                let behind = Span::new(span.file, self.here_span().end, span.end);
                let text = format!("{{ {format} {name}{} }}", self.source_text(behind));
                return Some(Remedy::fix(format!("Write `{word} {text}`."), span, text));
            }
            (Word::ImageMap | Word::BumpMap, Kind::Word)
                if self.raw_ahead(1).kind == Kind::String =>
            {
                self.end_of_picture(at + 2)
            }
            (_, Kind::Word) => return self.block_of_one_value(word),
            _ => return None,
        };
        let span = self.tokens_span(at..end);
        let text = format!("{{ {} }}", self.source_text(span));
        Some(Remedy::fix(format!("Write `{word} {text}`."), span, text))
    }

    /// The entries of a map from its `[` on, with a `{` before them; with a `}` behind them, too, if that is missing.
    fn entries_without_braces(&self, word: Word) -> Option<Remedy> {
        let mut end = self.here.at;
        while self.token(end)?.is_mark('[') {
            end = self.end_of_long_brackets(end, '[', ']')?;
        }
        let hint = format!("The entries of `{word}` stand in braces.");
        let span = self.tokens_span(self.here.at..end);
        if self.has_more_closing_braces() {
            let start = Span::new(span.file, span.start, span.start);
            return Some(Remedy::fix(hint, start, "{ "));
        }
        let text = format!("{{ {} }}", self.source_text(span));
        Some(Remedy::fix(hint, span, text))
    }

    /// The token behind the parameters of a picture in the line, from one of them on.
    fn end_of_picture(&self, mut at: usize) -> usize {
        let words = [Word::Interpolate, Word::MapType, Word::Gamma];
        loop {
            let word = self.token(at).and_then(|token| token.word());
            at += match word {
                Some(Word::Once) => 1,
                Some(word) if words.contains(&word) => 2,
                _ => return at,
            };
        }
    }

    /// An entry of a map in other brackets than `[` and `]`.
    fn entry_without_brackets(&self, token: Token) -> Option<Remedy> {
        let hint = "Each entry stands in brackets";
        if token.is_mark('{') {
            return self.rebracketed('{', '}', "[", "]", hint);
        }
        if token.is_mark('(') {
            return self.rebracketed('(', ')', "[", "]", hint);
        }
        if token.kind != Kind::Number {
            return None;
        }
        let at = self.here.at;
        let value = at + 1 + usize::from(self.raw_ahead(1).is_mark(','));
        let end = self.end_of_value(value)?;
        let span = self.tokens_span(at..end);
        let text = format!("[{}]", self.source_text(span));
        let is_short = text.len() <= limits::QUOTED && !text.contains(['\n', '\r']);
        is_short.then(|| Remedy::fix(format!("{hint}: `{text}`."), span, text))
    }

    /// `V[0]` for a component of a vector, from its `[` on.
    pub(crate) fn component_by_number(&self) -> Option<Remedy> {
        let name = self.token(self.here.at.checked_sub(1)?)?.symbol()?;
        let Some(Value::Number(number)) = self.scopes.get(name) else {
            return None;
        };
        if number.len < 2 {
            return None;
        }
        let hint = "Components of a vector are `.x`, `.y` and `.z`.";
        let end = self.end_of_brackets(self.here.at, '[', ']')?;
        let span = self.tokens_span(self.here.at..end);
        Some(match self.source_text(span) {
            "[0]" => Remedy::fix(hint, span, ".x"),
            "[1]" => Remedy::fix(hint, span, ".y"),
            "[2]" => Remedy::fix(hint, span, ".z"),
            _ => hint.into(),
        })
    }

    /// A condition without `(` and `)`.
    fn condition_without_parentheses(&self) -> Option<Remedy> {
        let at = self.here.at;
        let line = self.sources.line_column(self.here_span()).0;
        let is_part = |at: usize| {
            let token = self.token(at)?;
            let is_value = match token.kind {
                Kind::Number | Kind::LessEqual | Kind::GreaterEqual | Kind::NotEqual => true,
                Kind::Name => !matches!(
                    token.symbol().and_then(|name| self.scopes.get(name)),
                    Some(Value::Object(_) | Value::Element(_) | Value::Macro(_))
                ),
                Kind::Mark => "<>=!&|+-*/".contains(char::from_u32(token.value)?),
                _ => token
                    .word()
                    .is_some_and(|word| word.class() == Class::Value),
            };
            let is_near = self.sources.line_column(self.here.tokens.span(at)).0 == line;
            Some(is_value && is_near)
        };
        let end = (at..at + SHORT).find(|&at| is_part(at) != Some(true))?;
        if end == at || self.goes_on(at..end, line) {
            return Some("A condition stands in parentheses: `#if (A > 1)`.".into());
        }
        let condition = self.tokens_span(at..end);
        let text = format!("({})", self.source_text(condition));
        let has_colon = self.token(end)?.is_mark(':');
        let span = self.tokens_span(at..end + usize::from(has_colon));
        Some(Remedy::fix(format!("Write `{text}`."), span, text))
    }

    /// True if the tokens of a condition are not all of it, or hold operators of other languages.
    fn goes_on(&self, condition: Range<usize>, line: usize) -> bool {
        let mark = |at: usize| {
            let token = self.token(at).filter(|token| token.kind == Kind::Mark)?;
            char::from_u32(token.value)
        };
        let end = condition.end;
        let next = self.token(end);
        let is_near = self.sources.line_column(self.here.tokens.span(end)).0 == line;
        let is_function = next
            .and_then(|token| token.word())
            .is_some_and(|word| word.class() == Class::Function);
        let goes_on = is_function || mark(end).is_some_and(|mark| mark != ':');
        let is_doubled = |at: usize| {
            mark(at).is_some_and(|first| "=&|".contains(first)) && mark(at) == mark(at + 1)
        };
        is_near && goes_on || mark(end - 1).is_some() || condition.clone().any(is_doubled)
    }

    /// `isosurface { x*x - 1 ...`.
    fn equation_without_function(&self) -> Option<Remedy> {
        let at = self.here.at;
        let is_part = |at: usize| {
            let token = self.token(at)?;
            let is_value = |word: Word| matches!(word.class(), Class::Value | Class::Function);
            Some(match token.kind {
                Kind::Number | Kind::Name => true,
                Kind::Mark => "()+-*/^,".contains(char::from_u32(token.value)?),
                _ => token.word().is_some_and(is_value),
            })
        };
        let end = (at..at + SHORT).find(|&at| is_part(at) != Some(true))?;
        let span = self.tokens_span(at..end.max(at + 1));
        let equation = self.source_text(span);
        let text = format!("function {{ {equation} }}");
        let hint = "The equation stands in `function { }`.";
        Some(
            match end > at + 1 && equation.len() <= limits::QUOTED && !equation.contains('\n') {
                true => Remedy::fix(hint, span, text),
                false => hint.into(),
            },
        )
    }

    /// A name with spaces, dashes, points or foreign letters after `#declare`.
    pub(super) fn name_in_parts(&self, wanted: &str) -> Option<Remedy> {
        let start = match wanted.starts_with("`=` after `#") {
            true => self.here.at.checked_sub(1)?,
            false if wanted == "a name to declare" => self.here.at,
            false => return None,
        };
        if self.raw().is_mark('(') {
            return (start < self.here.at).then(|| self.function_in_parentheses(start))?;
        }
        let end = (start..start + SHORT)
            .find(|&at| self.token(at).is_none_or(|token| token.is_mark('=')))?;
        let first = self.token(start)?;
        let is_vector = first.symbol().and_then(|name| self.scopes.get(name));
        if matches!(is_vector, Some(Value::Number(number)) if number.len > 1)
            && self.token(start + 1)?.is_mark('.')
        {
            let directive = self.directive_before(start);
            return Some(
                format!("Components are not assigned: `{directive} V = <3, V.y, V.z>;`.").into(),
            );
        }
        let next = self.here.tokens.span(start + 1);
        let type_span = self.here.tokens.span(start);
        if TYPES.contains(&self.source_text(type_span)) && end == start + 2 {
            let span = Span::new(type_span.file, type_span.start, next.start);
            return Some(Remedy::fix("Declarations have no types.", span, ""));
        }
        let span = self.tokens_span(start..end.max(start + 1));
        let written = self.source_text(span);
        let mut name = String::new();
        for letter in written.chars() {
            match letter {
                'a'..='z' | 'A'..='Z' | '0'..='9' | '_' => name.push(letter),
                ' ' | '-' | '.' if !name.ends_with('_') => name.push('_'),
                ' ' | '-' | '.' | '$' => {}
                _ => name.push_str(in_ascii(letter)?),
            }
        }
        if name.starts_with(|letter: char| letter.is_ascii_digit()) {
            name.insert(0, '_');
        }
        let is_name = self.token(end)?.is_mark('=')
            && !name.ends_with('_')
            && !name.is_empty()
            && name != written
            && Word::from_spelling(&name).is_none();
        is_name.then(|| {
            let rule = match name.starts_with('_') && !written.starts_with('_') {
                true => "A name begins with a letter or `_`",
                false => "Names consist of letters, digits and `_`",
            };
            let hint = format!("{rule}: write `{name}` wherever this is used.");
            Remedy::fix(hint, span, name)
        })
    }

    /// The directive before a name.
    fn directive_before(&self, name: usize) -> &str {
        let before = name.checked_sub(1);
        before.map_or("#declare", |at| self.source_text(self.here.tokens.span(at)))
    }

    /// `#declare F(x) = x*2;`.
    fn function_in_parentheses(&self, name: usize) -> Option<Remedy> {
        let at = self.here.at;
        let directive = self.directive_before(name);
        let hint = format!(
            "A function is `{directive} F = function(x) {{ x*2 }};`, a macro `#macro F(x) x*2 #end`."
        );
        let end = self.end_of_brackets(at, '(', ')')?;
        let parameters = self.source_text(self.tokens_span(at..end));
        let line = self.rest_of_line(name);
        let statement = line.split_inclusive(';').next()?;
        let (_, body) = statement.split_once('=')?;
        let is_whole =
            statement.ends_with(';') && self.token(end)?.is_mark('=') && !body.contains("//");
        if !is_whole {
            return Some(hint.into());
        }
        let name_text = self.source_text(self.here.tokens.span(name));
        let text = format!(
            "{name_text} = function{parameters} {{ {} }};",
            body.trim_end_matches(';').trim()
        );
        Some(Remedy::fix(
            hint,
            self.bytes_from(name, statement.len()),
            text,
        ))
    }

    /// The name of a parameter before its value, as in `sphere { center <0, 0, 0>, radius 1 }`.
    pub(super) fn named_parameter(&self, token: Token, wanted: &str) -> Option<Remedy> {
        let block = self.words_of_blocks().next()?;
        let is_shape = block.class() == Class::Shape || block == Word::LightSource;
        if !is_shape || !wanted.starts_with("a number") {
            return None;
        }
        let span = self.here_span();
        let name = self.source_text(span);
        let is_name = match token.kind {
            Kind::Name => NAMES_OF_PARAMETERS.contains(&name.to_lowercase().as_str()),
            _ => matches!(
                token.word()?,
                Word::Location | Word::Radius | Word::Size | Word::MajorRadius
            ),
        };
        let sign = ['=', ':']
            .iter()
            .any(|&mark| self.raw_ahead(1).is_mark(mark));
        let at = self.here.at + 1 + usize::from(sign);
        let is_free = token
            .symbol()
            .is_none_or(|name| self.scopes.get(name).is_none());
        let has_value = self.token(at).is_some_and(|value| match value.kind {
            Kind::Number | Kind::Name => true,
            Kind::Mark => value.is_mark('<') || value.is_mark('-'),
            _ => value
                .word()
                .is_some_and(|word| word.class() == Class::Value),
        });
        let value = self.here.tokens.span(at);
        (is_name && is_free && has_value).then(|| {
            let hint = format!("The parameters of `{block}` have no names: remove `{name}`.");
            let whole = Span::new(span.file, span.start, value.start);
            let has_comment = self.source_text(whole).contains('/');
            let removed = if has_comment {
                self.with_blanks(span)
            } else {
                whole
            };
            Remedy::fix(hint, removed, "")
        })
    }

    /// A call that makes a vector in other languages: `vec3(1, 2, 3)`.
    pub(super) fn vector_by_call(&self, token: Token) -> Option<Remedy> {
        let name = self.source_text(self.here_span()).to_lowercase();
        let is_vector = token.kind == Kind::Name
            && self.raw_ahead(1).is_mark('(')
            && matches!(
                name.as_str(),
                "vec"
                    | "vec2"
                    | "vec3"
                    | "vec4"
                    | "vector"
                    | "vector2"
                    | "vector3"
                    | "point"
                    | "point3"
                    | "float3"
            );
        let end = is_vector.then(|| self.end_of_brackets(self.here.at + 1, '(', ')'))??;
        if end == self.here.at + 3 {
            return Some("A vector is written `<x, y, z>`.".into());
        }
        let arguments = self.source_text(self.tokens_span(self.here.at + 2..end - 1));
        let vector = format!("<{arguments}>");
        let span = self.tokens_span(self.here.at..end);
        Some(Remedy::fix(
            format!("Write a vector as `{vector}`."),
            span,
            vector,
        ))
    }

    /// A number in another notation than decimal digits, and indices of vectors.
    pub(super) fn foreign_value(&self, token: Token) -> Option<Remedy> {
        if token.is_mark('[') {
            return self.component_by_number();
        }
        let before = self.here.at.checked_sub(1)?;
        let last = self.here.tokens.span(before);
        let name = self.source_text(self.here_span());
        let is_number = token.kind == Kind::Name
            && self.token(before)?.kind == Kind::Number
            && last.end == self.here_span().start;
        if !is_number {
            return self.missing_factor(token);
        }
        let whole = last.to(self.here_span());
        let digits = name
            .strip_prefix(['x', 'X'])
            .filter(|_| self.source_text(last) == "0");
        if let Some(value) = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()) {
            let word = before.checked_sub(1).and_then(|at| self.token(at)?.word());
            let is_color = word.is_some_and(|word| word.class() == Class::Color) && name.len() == 7;
            if !is_color {
                let hint = format!("Numbers are decimal: write `{value}`.");
                return Some(Remedy::fix(hint, whole, value.to_string()));
            }
            let color = written_color(hexadecimal_color(&name[1..])?);
            return Some(self.colored(before, whole, color));
        }
        let is_grouped =
            name.starts_with('_') && name[1..].bytes().all(|byte| byte.is_ascii_digit());
        if !is_grouped {
            return self.missing_factor(token);
        }
        let number = self.source_text(whole).replace('_', "");
        let hint = format!("Digits are not grouped: write `{number}`.");
        Some(Remedy::fix(hint, whole, number))
    }

    /// A colour in place of a span that begins at a token, and of the words for colours before it.
    pub(crate) fn colored(&self, at: usize, span: Span, color: String) -> Remedy {
        let is_color = |at: usize| {
            let word = self.token(at).and_then(|token| token.word());
            word.is_some_and(|word| word.class() == Class::Color)
        };
        let mut start = at;
        while start > 0 && is_color(start - 1) {
            start -= 1;
        }
        let first = self.here.tokens.span(start);
        let span = if start < at { first.to(span) } else { span };
        Remedy::fix(format!("Write the colour as `{color}`."), span, color)
    }

    /// A second vector after a transform, or the angle after its axis: `rotate 45*y 30*x`, `rotate <0, 1, 0> 45`.
    pub(super) fn transform_in_parts(&self, token: Token) -> Option<Remedy> {
        let at = self.here.at;
        let number = at + usize::from(token.is_mark(','));
        if self.token(number)?.kind != Kind::Number {
            return None;
        }
        let start = (1..=16)
            .map_while(|back| at.checked_sub(back))
            .find(|&at| {
                let word = self.token(at).and_then(|token| token.word());
                word.is_some_and(|word| word.class() != Class::Value)
            })?;
        let word = self.token(start)?.word()?;
        if !matches!(word, Word::Rotate | Word::Translate) {
            return None;
        }
        let number_text = self.source_text(self.here.tokens.span(number));
        if self.token(number + 1)?.is_mark('*') {
            let hint = format!("Each vector needs a `{word}` of its own.");
            let span = self.tokens_span(at..number + 1);
            let blank = if number > at { " " } else { "" };
            return Some(Remedy::fix(
                hint,
                span,
                format!("{blank}{word} {number_text}"),
            ));
        }
        if word != Word::Rotate {
            return None;
        }
        let axis = self.tokens_span(start + 1..at);
        let axis_text = self.source_text(axis);
        let digits: Vec<&str> = axis_text
            .trim_matches(['<', '>'])
            .split(',')
            .map(str::trim)
            .collect();
        let is_vector = axis_text.starts_with('<') && axis_text.ends_with('>');
        let is_unit = match digits.as_slice() {
            [one] => matches!(*one, "x" | "y" | "z"),
            [_, _, _] => {
                digits.iter().filter(|&&digit| digit == "1").count() == 1
                    && digits.iter().filter(|&&digit| digit == "0").count() == 2
            }
            _ => false,
        };
        if !is_unit && !is_vector {
            return None;
        }
        if !is_unit {
            let hint = "`rotate` takes the angles about x, y and z; `Axis_Rotate_Trans(axis, angle)` of `transforms.inc` turns about any axis.";
            return Some(hint.into());
        }
        let text = format!("{number_text}*{axis_text}");
        let span = axis.to(self.here.tokens.span(number));
        Some(Remedy::fix(format!("Write `rotate {text}`."), span, text))
    }

    /// The first `end` without `#` behind a token.
    pub(crate) fn end_without_hash(&self, at: usize) -> Option<Remedy> {
        let behind = self.here.tokens.tokens.get(at..)?;
        let text = |at: usize| self.source_text(self.here.tokens.span(at));
        let is_end = |index: usize| {
            let is_behind_hash = index > 0 && self.here.tokens.is_hash(behind[index - 1]);
            let is_foreign = || other_dialects::directive(text(at + index)) == Some("#end");
            behind[index].word() == Some(Word::End) || is_behind_hash && is_foreign()
        };
        let end = at + (0..behind.len()).find(|&index| is_end(index))?;
        let span = self.here.tokens.span(end);
        let line = self.sources.line_column(span).0;
        if text(end) != Word::End.spelling() {
            let hint = format!("Line {line} says `#{}`: write `#end`.", text(end));
            let both = self.here.tokens.span(end - 1).to(span);
            return Some(Remedy::fix(hint, both, "#end"));
        }
        let hint = format!("The `end` of line {line} lacks its `#`.");
        Some(Remedy::fix(hint, span, "#end"))
    }

    /// The text of a string, or of a number as a string; `None` for anything else.
    fn string_of(&self, tokens: Range<usize>) -> Option<String> {
        let first = self.token(tokens.start).filter(|_| !tokens.is_empty())?;
        let text = self.source_text(self.tokens_span(tokens.clone()));
        let value = first.symbol().and_then(|name| self.scopes.get(name));
        let is_string = first.kind == Kind::String || matches!(value, Some(Value::Text(_)));
        let is_number = first.kind == Kind::Number || matches!(value, Some(Value::Number(_)));
        match (is_string, is_number) {
            _ if STRING_FUNCTIONS
                .iter()
                .any(|&word| first.word() == Some(word)) =>
            {
                Some(text.to_owned())
            }
            (true, _) if tokens.len() == 1 => Some(text.to_owned()),
            (_, true) if tokens.len() == 1 => Some(format!("str({text}, 0, -1)")),
            _ => None,
        }
    }

    /// Strings with `+` between them, at the first `+`.
    pub(super) fn sum_of_strings(&self) -> Option<Remedy> {
        let start = self.here.at.checked_sub(1)?;
        let line = self.sources.line_column(self.here_span()).0;
        let (mut depth, mut parts, mut first, mut at) = (0, Vec::new(), start, start);
        loop {
            let token = self.token(at)?;
            let is_here = self.sources.line_column(self.here.tokens.span(at)).0 == line;
            let is_part = matches!(
                token.kind,
                Kind::String | Kind::Number | Kind::Name | Kind::Mark
            ) || token
                .word()
                .is_some_and(|word| matches!(word.class(), Class::Function | Class::Value));
            let is_end = [';', ',', '}', ']', ')']
                .iter()
                .any(|&mark| token.is_mark(mark));
            let ends = !is_here || !is_part || at > start + SHORT || depth == 0 && is_end;
            if ends || depth == 0 && token.is_mark('+') {
                parts.push(self.string_of(first..at)?);
                first = at + 1;
            }
            depth += i32::from(token.is_mark('(')) - i32::from(token.is_mark(')'));
            if ends {
                break;
            }
            at += 1;
        }
        let text = format!("concat({})", parts.join(", "));
        let span = self.tokens_span(start..at);
        (depth == 0 && text.len() <= limits::QUOTED)
            .then(|| Remedy::fix("Strings are joined by `concat(a, b)`.", span, text))
    }
}

/// True for blocks of entries in brackets.
pub(super) fn is_map(word: Word) -> bool {
    matches!(
        word,
        Word::ColorMap
            | Word::ColourMap
            | Word::PigmentMap
            | Word::NormalMap
            | Word::SlopeMap
            | Word::TextureMap
            | Word::DensityMap
    )
}

/// Functions whose value is a string.
const STRING_FUNCTIONS: &[Word] = &[
    Word::Chr,
    Word::Concat,
    Word::Str,
    Word::Strlwr,
    Word::Strupr,
    Word::Substr,
    Word::Vstr,
];

/// Types of other languages.
pub(crate) const TYPES: &[&str] = &[
    "bool", "const", "double", "float", "int", "let", "string", "var",
];

/// Names that people give to the parameters of shapes and lights.
const NAMES_OF_PARAMETERS: &[&str] = &[
    "center", "centre", "corner", "corner1", "end", "from", "height", "normal", "origin", "pos",
    "position", "r", "start", "to",
];

/// The format of a picture, by the end of its name.
fn format_of(name: &str) -> Option<&'static str> {
    let (_, ending) = name.rsplit_once('.')?;
    Some(match ending.to_lowercase().as_str() {
        "png" => "png",
        "jpg" | "jpeg" => "jpeg",
        "gif" => "gif",
        "tga" => "tga",
        "bmp" => "bmp",
        "tif" | "tiff" => "tiff",
        "hdr" => "hdr",
        "exr" => "exr",
        _ => return None,
    })
}

/// A letter of a European alphabet in ASCII.
fn in_ascii(letter: char) -> Option<&'static str> {
    Some(match letter {
        'ä' | 'æ' => "ae",
        'ö' | 'ø' | 'œ' => "oe",
        'ü' => "ue",
        'ß' => "ss",
        'à' | 'á' | 'â' | 'ã' | 'å' => "a",
        'ç' => "c",
        'è' | 'é' | 'ê' | 'ë' => "e",
        'ì' | 'í' | 'î' | 'ï' => "i",
        'ñ' => "n",
        'ò' | 'ó' | 'ô' | 'õ' => "o",
        'ù' | 'ú' | 'û' => "u",
        'Ä' => "Ae",
        'Ö' => "Oe",
        'Ü' => "Ue",
        _ => return None,
    })
}

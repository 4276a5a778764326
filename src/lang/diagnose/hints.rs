//! Hints for tokens that do not belong where they stand.

use crate::base::args::Word;
use crate::base::nearest::nearest;
use crate::base::source::{Diagnostic, Span};
use crate::lang::diagnose::css_colors::{css_color, hexadecimal_color, written_color};
use crate::lang::diagnose::names::NUMBER_FOR_STRING;
use crate::lang::diagnose::notation::is_map;
use crate::lang::diagnose::other_dialects;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::expr::value::Value;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, END_OF_FILE, Kind, Symbol, Token, Tokens};

/// Most include files that are searched for a name.
pub(super) const INCLUDE_FILES: usize = 200;

impl Reader<'_> {
    /// A hint for the next token, which cannot stand where `wanted` is expected.
    pub(crate) fn remedy(&self, token: Token, wanted: &str) -> Option<Remedy> {
        if wants_value(wanted)
            && let Some(remedy) = self.value_after_operator(token)
        {
            return Some(remedy);
        }
        let remedy = self
            .name_in_parts(wanted)
            .or_else(|| self.look_alikes())
            .or_else(|| self.pasted(token, wanted))
            .or_else(|| self.suffix_of_number(token))
            .or_else(|| self.other_case(token, wanted))
            .or_else(|| self.typography(token))
            .or_else(|| self.foreign_operator(token, wanted))
            .or_else(|| self.value_without_parentheses(token, wanted))
            .or_else(|| self.foreign_value(token))
            .or_else(|| self.foreign_brackets(token, wanted))
            .or_else(|| self.rewritten(token, wanted));
        if remedy.is_some() {
            return remedy;
        }
        match token.kind {
            Kind::Name if wanted.ends_with("component after `.`") => {
                let name = self.source_text(self.here_span());
                let known = ["red", "green", "blue", "gray", "transmit", "filter"];
                let meant = match name {
                    "r" => Some("red"),
                    "g" => Some("green"),
                    "b" => Some("blue"),
                    "f" => Some("filter"),
                    "a" | "alpha" => Some("transmit"),
                    _ => nearest(&name.to_lowercase(), known),
                };
                let Some(meant) = meant else {
                    return Some(
                        "Components are `.x`, `.y`, `.z`, `.red`, `.green` and `.blue`.".into(),
                    );
                };
                let hint = match name {
                    "grey" => "`grey` is a word of POV-Ray 3.8: write `.gray`, or begin the scene with `#version 3.8;`.".to_owned(),
                    _ => format!("The component is called `.{meant}`."),
                };
                Some(Remedy::fix(hint, self.here_span(), meant))
            }
            Kind::Name => self
                .color_of_css(token, wanted)
                .or_else(|| self.remedy_of_name(Symbol(token.value), wanted)),
            Kind::Mark => self.remedy_of_mark(char::from_u32(token.value)?, wanted),
            Kind::Word => self.remedy_of_word(token.word()?, wanted),
            Kind::String if wanted.starts_with("a colour") => {
                let name = self.source_text(self.here_span()).trim_matches('"');
                let digits = name.strip_prefix('#').unwrap_or_default();
                let color = hexadecimal_color(digits).or_else(|| Some(css_color(name)?.1))?;
                Some(self.colored(self.here.at, self.here_span(), written_color(color)))
            }
            Kind::String if self.statement.is_in_version => {
                let number = self.source_text(self.here_span()).trim_matches('"');
                let hint = format!("The version is a number: `{number}`.");
                Some(Remedy::fix(hint, self.here_span(), number))
            }
            Kind::Number if wanted == "a string" => Some(NUMBER_FOR_STRING.into()),
            Kind::Number if wanted.starts_with("a parameter of `interior`") => {
                let number = self.source_text(self.here_span());
                let text = format!("ior {number}");
                let hint = format!("A number follows its word: `{text}`.");
                Some(Remedy::fix(hint, self.here_span(), text))
            }
            _ => None,
        }
    }

    fn remedy_of_word(&self, word: Word, wanted: &str) -> Option<Remedy> {
        let is_directive = word.class() == Class::Directive;
        let at = self.here.at;
        if word == Word::For
            && self.raw_ahead(1).is_mark('(')
            && let Some(remedy) = self.loop_of_c(at, at + 1)
        {
            return Some(remedy);
        }
        if wanted == "a colour in `background`"
            && let Some(end) = self
                .end_of_brackets(at + 1, '{', '}')
                .filter(|&end| end > at + 3)
        {
            let color = self.source_text(self.tokens_span(at + 2..end - 1));
            let hint = format!("The background has a colour and no pigment: `{color}`.");
            return Some(Remedy::fix(hint, self.tokens_span(at..end), color));
        }
        if wanted.contains("statement")
            && let Some(remedy) = self.texture_of_parts()
        {
            return Some(remedy);
        }
        if wants_value(wanted) && self.is_in_entry(word) {
            return Some("An entry begins with its position: `[0.5 rgb 1]`.".into());
        }
        if wants_value(wanted)
            && let Some(remedy) = self.number_of_points()
        {
            return Some(remedy);
        }
        if is_directive && wanted.contains("statement") {
            if let Some(remedy) = self.remedy_after_directive(word) {
                return Some(remedy);
            }
            let directive = format!("#{word}");
            let hint = format!("Directives begin with `#`: `{directive}`.");
            return Some(Remedy::fix(hint, self.here_span(), directive));
        }
        if word == Word::Gray && wanted == "a colour" {
            let hint = "`gray` is a component of colours, no colour.";
            return Some(Remedy::fix(hint, self.here_span(), "rgb 0.5"));
        }
        self.remedy_after_directive(word)
            .or_else(|| self.pattern_behind_modifier(word, wanted))
            .or_else(|| self.color_in_texture_map(word))
            .or_else(|| self.remedy_of_foreign_word(word, wanted))
            .or_else(|| self.misplaced(word, wanted))
            .or_else(|| hint_beside(word, wanted).map(Remedy::from))
            .or_else(|| self.named_parameter(self.raw(), wanted))
            .or_else(|| self.remedy_of_no_value(wanted))
    }

    /// A directive without `#`, or a reserved word that means something else in other programs.
    fn remedy_of_foreign_word(&self, word: Word, wanted: &str) -> Option<Remedy> {
        if word.class() == Class::Directive && (wants_word(wanted) || wants_value(wanted)) {
            return Some(format!("Directives begin with `#`: `#{word}`.").into());
        }
        if let Some(meant) = other_dialects::translated(word.spelling(), false) {
            return Some(match meant.word {
                Some(word) => Remedy::fix(meant.hint, self.here_span(), word),
                None => meant.hint.into(),
            });
        }
        let is_second = wanted.ends_with("comes first, and once");
        is_second.then(|| "Remove one of the two, or blend them in a `pigment_map`.".into())
    }

    /// A colour that CSS knows by the name at the next token.
    fn color_of_css(&self, token: Token, wanted: &str) -> Option<Remedy> {
        let is_undeclared = self.scopes.get(Symbol(token.value)).is_none();
        let name = self.source_text(self.here_span());
        if !is_undeclared || !wanted.starts_with("a colour") {
            return None;
        }
        let (known, channels) = css_color(name)?;
        if let Some(library) = self
            .sources
            .library_file_that_declares(known, INCLUDE_FILES)
        {
            let file = library.file;
            return Some(match known == name {
                true => format!("`{file}` declares `{name}`: write `#include \"{file}\"` above."),
                false => format!("`{file}` declares `{known}`: write `#include \"{file}\"` above, and `{known}` here."),
            }
            .into());
        }
        let color = written_color(channels);
        let hint = format!("`{name}` is a colour of web pages: write `{color}`.");
        Some(Remedy::fix(hint, self.here_span(), color))
    }

    /// Notes the name that a declaration of another language would declare, as `float f(float x) { ... }`, so that it is
    /// not reported as undeclared.
    pub(crate) fn note_name_of_foreign_declaration(&mut self) {
        let directive = other_dialects::directive(self.source_text(self.here_span()));
        if matches!(directive, Some("#declare" | "#macro"))
            && let Some(name) = self.raw_ahead(1).symbol()
            && self.scopes.get(name).is_none()
        {
            self.usage.undeclared.insert(name);
            // Each declaration is a mistake of its own.
            if let Some(word) = self.raw().symbol() {
                self.usage.undeclared.remove(&word);
            }
        }
    }

    /// `float A = 1;` for `#declare A = 1;`.
    fn declaration_by_type(&self) -> Option<Remedy> {
        let name = self.source_text(self.here_span());
        let is_declaration = self.raw_ahead(1).symbol().is_some() && self.raw_ahead(2).is_mark('=');
        let meant = match name {
            "int" => "#declare",
            _ => other_dialects::directive(name)?,
        };
        if meant == "#declare"
            && self.raw_ahead(1).symbol().is_some()
            && self.raw_ahead(2).is_mark('(')
        {
            let hint = "A function is `#declare F = function(x) { x*2 };`, a macro `#macro F(x) x*2 #end`.";
            return Some(hint.into());
        }
        (is_declaration && meant == "#declare").then(|| {
            let hint = "A name gets its value by `#declare`.";
            Remedy::fix(hint, self.here_span(), meant)
        })
    }

    /// A remedy that rewrites the text around the next token.
    fn rewritten(&self, token: Token, wanted: &str) -> Option<Remedy> {
        let is_statement = wanted.contains("statement");
        if matches!(token.kind, Kind::Name | Kind::Word)
            && is_statement
            && let Some(remedy) = self.declaration_by_type()
        {
            return Some(remedy);
        }
        if is_statement && let Some(remedy) = self.comment_of_other_languages() {
            return Some(remedy);
        }
        match token.kind {
            _ if wanted.starts_with("`(` after") => self.argument_without_parentheses(),
            Kind::Mark | Kind::Name | Kind::Word if wanted == "a string" => self
                .number_for_string(token)
                .or_else(|| self.unquoted_string()),
            Kind::Name
                if wanted.ends_with("in `text`") && self.raw_ahead(1).kind == Kind::String =>
            {
                Some(Remedy::fix(
                    "The word before the file of a font is `ttf`.",
                    self.here_span(),
                    "ttf",
                ))
            }
            Kind::Name => (is_statement.then(|| self.assignment()).flatten())
                .or_else(|| self.keyword_in_capitals(Symbol(token.value), wanted))
                .or_else(|| self.vector_by_call(token))
                .or_else(|| self.named_parameter(token, wanted)),
            Kind::Mark if is_statement && token.is_mark('{') => self.braces_of_other_languages(),
            Kind::Mark if wants_value(wanted) && !self.is_doubled_brace() => {
                self.vector_in_brackets(self.here.at)
            }
            Kind::Number | Kind::Word if wanted.contains("`}`") => self
                .axis_and_number()
                .or_else(|| self.transform_in_parts(token))
                .or_else(|| (token.kind == Kind::Number).then(|| self.numbers_in_a_row())?),
            Kind::Mark if token.is_mark(',') && wanted.starts_with("an operator or `;`") => {
                self.numbers_in_a_row()
            }
            Kind::Mark if token.is_mark(',') && wanted.contains("`}`") => self
                .transform_in_parts(token)
                .or_else(|| self.numbers_in_a_row()),
            _ => None,
        }
    }

    /// The name of a number, or a component of a vector, where a string is expected.
    fn number_for_string(&self, token: Token) -> Option<Remedy> {
        let at = self.here.at;
        let value = token.symbol().and_then(|name| self.scopes.get(name));
        let is_mark = |at: usize, mark| self.token(at).is_some_and(|token| token.is_mark(mark));
        let is_component = is_mark(at + 1, '.') && self.token(at + 2)?.word().is_some();
        let end = at + if is_component { 3 } else { 1 };
        let is_alone = !['+', '-', '*', '/', '.', '(']
            .iter()
            .any(|&mark| is_mark(end, mark));
        let is_number =
            matches!(value, Some(Value::Number(number)) if (number.len == 1) != is_component);
        (is_number && is_alone).then(|| {
            let span = self.tokens_span(at..end);
            let text = format!("str({}, 0, -1)", self.source_text(span));
            Remedy::fix(NUMBER_FOR_STRING, span, text)
        })
    }

    /// `#else if` for `#elseif`.
    fn remedy_after_directive(&self, word: Word) -> Option<Remedy> {
        let before = self.here.tokens.tokens[self.here.at.checked_sub(1)?];
        let is_else = before.kind == Kind::Directive
            && self.here.tokens.directives[before.value as usize].word == Some(Word::Else);
        (is_else && word == Word::If).then(|| {
            let span = self.tokens_span(self.here.at - 1..self.here.at + 1);
            Remedy::fix("Write `#elseif`.", span, "#elseif")
        })
    }

    /// A word whose value is missing: `rotate }`.
    fn remedy_of_no_value(&self, wanted: &str) -> Option<Remedy> {
        let before = self.word_back(1)?;
        if !wants_value(wanted) || before.is_value() {
            return None;
        }
        let color = match before {
            Word::Red => "rgb <1, 0, 0>",
            Word::Green => "rgb <0, 1, 0>",
            Word::Blue => "rgb <0, 0, 1>",
            _ => return Some(format!("Write a value after `{before}`.").into()),
        };
        let span = self.here.tokens.span(self.here.at - 1);
        if let Some(remedy) = self.declared_in_other_case(before.spelling(), span) {
            return Some(remedy);
        }
        Some(Remedy::fix(
            format!("`{before}` is a component of colours: write `{color}`."),
            span,
            color,
        ))
    }

    fn remedy_of_mark(&self, mark: char, wanted: &str) -> Option<Remedy> {
        let removed = |hint: &str| Some(Remedy::fix(hint, self.here_span(), ""));
        if matches!(mark, '}' | ',' | '<')
            && let Some(remedy) = self.number_of_points()
        {
            return Some(remedy);
        }
        if let Some(remedy) = self.foreign_mark(mark, wanted) {
            return Some(remedy);
        }
        let remedy = match mark {
            '(' => self.constant_with_parentheses(),
            ')' if wants_value(wanted) => self.missing_arguments(),
            '=' | ':' => self.angle_with_sign(),
            _ => None,
        };
        if remedy.is_some() {
            return remedy;
        }
        match mark {
            ';' if wanted.starts_with("an item of the array") => {
                Some(Remedy::fix("Items are separated by `,`.", self.here_span(), ","))
            }
            ';' if wants_word(wanted) => {
                removed(
                    "Only declarations of numbers, and some directives, end with `;`; remove it.",
                )
            }
            ',' if wanted == "`}`" && self.is_after_mark(']')
                || wants_word(wanted) && !self.is_between_numbers() =>
            {
                removed("Remove this comma: items in a block are not separated by commas.")
            }
            '}' if wants_value(wanted) && self.is_in_blob() => {
                Some("Components of a `blob` end with their strength: `sphere { <centre>, radius, strength }`.".into())
            }
            '}' => self.remedy_of_no_value(wanted),
            '+' if self.is_after_string() => {
                self
                    .sum_of_strings()
                    .or_else(|| Some("Strings are joined by `concat(a, b)`.".into()))
            }
            ',' if wanted == "`]` after the index" => {
                let next = self.here.tokens.span(self.here.at + 1);
                let span = Span::new(next.file, self.here_span().start, next.start);
                Some(Remedy::fix("Each index has brackets of its own: `A[0][1]`.", span, "]["))
            }
            ')' if wanted.starts_with("an operator or `;`") => {
                removed("This `)` closes nothing: remove it.")
            }
            '=' if wanted.contains("the start of `#for`") => {
                let open = self.here.at.checked_sub(2)?;
                let start = open.checked_sub(1)?;
                self.loop_of_c(start, open)
                    .or_else(|| Some("Write `#for (I, first, last)`, with commas only.".into()))
            }
            '=' | ':'
                if self.word_back(1).is_some_and(|word| !word.is_value())
                    && !wanted.contains("#for") =>
            {
                self.value_after_sign()
            }
            _ => self.hint_of_mark(mark, wanted).map(Remedy::from),
        }
    }

    /// True if a colour is the first value of an entry of a map.
    fn is_in_entry(&self, word: Word) -> bool {
        word.class() == Class::Color
            && self.is_after_mark('[')
            && self.words_of_blocks().next().is_some_and(is_map)
    }

    /// A value behind its word and a sign: `location = <0, 0, -5>`.
    fn value_after_sign(&self) -> Option<Remedy> {
        let word = self.word_back(1)?;
        let at = self.here.at;
        let is_color = self
            .raw_ahead(1)
            .word()
            .is_some_and(|word| word.class() == Class::Color);
        if word == Word::Pigment
            && is_color
            && let Some(end) = self.end_of_value(at + 1)
        {
            let color = self.source_text(self.tokens_span(at + 1..end));
            let text = format!("{{ {color} }}");
            let hint = format!("A block follows its word without a sign: `{word} {text}`.");
            return Some(Remedy::fix(hint, self.tokens_span(at..end), text));
        }
        if BLOCKS.contains(&word) && !self.raw_ahead(1).is_mark('{') {
            return Some(
                format!("A block follows its word without a sign: `{word} {{ ... }}`.").into(),
            );
        }
        let [last, next] = [at - 1, at + 1].map(|at| self.here.tokens.span(at));
        let between = Span::new(last.file, last.end, next.start);
        let is_bare = self.source_text(between).trim().len() == 1;
        let (span, text) = match is_bare {
            true => (between, " "),
            false => (self.with_blanks(self.here_span()), ""),
        };
        let hint = format!("A value follows its word without a sign: `{word} ...`.");
        Some(Remedy::fix(hint, span, text))
    }

    /// True if the innermost block is a component of a blob.
    fn is_in_blob(&self) -> bool {
        let blocks: Vec<Word> = self.words_of_blocks().take(2).collect();
        matches!(
            blocks.as_slice(),
            [Word::Sphere | Word::Cylinder, Word::Blob]
        )
    }

    fn hint_of_mark(&self, mark: char, wanted: &str) -> Option<String> {
        let before = self.mark_before();
        let text = match mark {
            '[' => "Only an array has items in `[` and `]`.",
            ')' if before == Some('(') && self.word_back(2) == Some(Word::Rand) => {
                "`rand(stream)` draws a number; `#declare stream = seed(1);` makes the stream."
            }
            '+' | '-' | '*' | '/' if wanted.starts_with("`=` after") => {
                "Write the name again after `=`: `#declare N = N + 1;`."
            }
            ',' if wants_word(wanted) && self.is_between_numbers() => {
                "Write a vector as `<1, 2, 3>`."
            }
            '(' if wants_word(wanted) => {
                "Parameters belong in `{` and `}`, or in no brackets at all."
            }
            '=' | ':' if wants_word(wanted) || self.word_back(1).is_some() => {
                "A value follows its word without a sign."
            }
            _ => return None,
        };
        Some(text.to_owned())
    }

    /// The mark directly before the next token.
    fn mark_before(&self) -> Option<char> {
        let at = self.here.at.checked_sub(1)?;
        let token = self.here.tokens.tokens[at];
        let touches = self.here.tokens.span(at).end == self.here_span().start;
        (token.kind == Kind::Mark && touches).then(|| char::from_u32(token.value))?
    }

    /// True if the next token stands between two numbers.
    fn is_between_numbers(&self) -> bool {
        let kind = |at: usize| self.here.tokens.tokens.get(at).map(|token| token.kind);
        let before = self.here.at.checked_sub(1).and_then(kind);
        let behind = self.raw_ahead(1);
        let is_signed = behind.is_mark('-') && self.raw_ahead(2).kind == Kind::Number;
        before == Some(Kind::Number) && (behind.kind == Kind::Number || is_signed)
    }

    /// The reserved word that is this many tokens before the next one.
    fn word_back(&self, back: usize) -> Option<Word> {
        self.here.tokens.tokens[self.here.at.checked_sub(back)?].word()
    }

    fn is_after_string(&self) -> bool {
        let before = self.here.at.checked_sub(1);
        before.is_some_and(|at| self.here.tokens.tokens[at].kind == Kind::String)
    }

    /// A sign in the parameters of the block at this depth that was probably meant to begin a value: `<0, 0, 0> -1`.
    pub(crate) fn subtracting_sign(&self, depth: usize) -> Option<Span> {
        let open = *self.blocks.get(depth.checked_sub(1)?)?;
        let tokens = &self.here.tokens;
        if tokens.file != open.file {
            return None;
        }
        let first = tokens
            .tokens
            .partition_point(|token| token.start <= open.start);
        let text = tokens.text().as_bytes();
        let is_blank = |at: usize| text.get(at).is_some_and(u8::is_ascii_whitespace);
        let at = (first + 1..self.here.at).rfind(|&at| {
            let token = tokens.tokens[at];
            let start = token.start as usize;
            let before = tokens.tokens[at - 1];
            let is_behind_value =
                !matches!(before.kind, Kind::Mark) || before.is_mark('>') || before.is_mark(')');
            (token.is_mark('-') || token.is_mark('+'))
                && is_behind_value
                && is_blank(start - 1)
                && !is_blank(start + 1)
        })?;
        Some(tokens.span(at))
    }

    /// The last directive of a file whose group has no `#end` there.
    pub(crate) fn unclosed_directive(tokens: &Tokens) -> Option<Span> {
        let opens = |token: &Token| {
            if token.kind != Kind::Directive {
                return false;
            }
            let directive = &tokens.directives[token.value as usize];
            directive.end == END_OF_FILE && directive.word.is_some_and(opens_group)
        };
        let at = tokens.tokens.iter().rposition(opens)?;
        Some(tokens.span(at))
    }

    /// True if this name was reported as undeclared before, or may stand in a missing include file: then its error is a
    /// consequence of one already reported.
    pub(crate) fn is_known_as_undeclared(&mut self, token: Token) -> bool {
        let symbol = Symbol(token.value);
        token.kind == Kind::Name
            && self.scopes.get(symbol).is_none()
            && (self.usage.lacks_file || !self.usage.undeclared.insert(symbol))
    }

    /// The error for the name of a value that could not be read.
    pub(crate) fn poison_error(&self, token: Token) -> Option<Box<Diagnostic>> {
        if token.kind != Kind::Name {
            return None;
        }
        match self.scopes.get(Symbol(token.value)) {
            Some(Value::Poison(why)) => Some(self.consequence_of(why.as_deref())),
            _ => None,
        }
    }
}

/// True for directives that need an `#end`.
pub(crate) fn opens_group(word: Word) -> bool {
    matches!(
        word,
        Word::If
            | Word::Ifdef
            | Word::Ifndef
            | Word::While
            | Word::For
            | Word::Switch
            | Word::Macro
    )
}

/// Words of blocks that people write with a sign.
const BLOCKS: [Word; 5] = [
    Word::Texture,
    Word::Pigment,
    Word::Normal,
    Word::Finish,
    Word::Interior,
];

/// True if a word of a block or a statement is expected.
pub(super) fn wants_word(wanted: &str) -> bool {
    wanted.contains("`}`") || wanted.contains("statement")
}

/// True if a numeric value is expected.
pub(super) fn wants_value(wanted: &str) -> bool {
    wanted.starts_with("a number")
}

/// True if a word may stand where `wanted` is expected, as far as its class shows.
pub(super) fn fits(word: Word, wanted: &str) -> bool {
    let is_value = word.is_value();
    if wants_value(wanted) {
        is_value
    } else if wanted.starts_with("an object") {
        let is_object = matches!(word.class(), Class::Shape | Class::Csg);
        is_object || wanted.contains("statement") && word.class() == Class::Statement
    } else {
        !wants_word(wanted) || !is_value && word.class() != Class::Directive
    }
}

/// A hint for a part of an object in another one.
fn hint_beside(word: Word, wanted: &str) -> Option<String> {
    let is_part = matches!(
        word,
        Word::Texture | Word::Pigment | Word::Normal | Word::Finish | Word::Interior
    );
    let is_in_part = wanted.contains("in `pigment`") || wanted.ends_with("`finish` or `}`");
    (is_part && is_in_part).then(|| {
        format!("`{word}` belongs beside this block, not in it: write it behind the `}}`.")
    })
}

//! Marks that do not belong where they stand: brackets of another kind or too many, and signs of other languages.

use crate::base::args::Word;
use crate::base::source::Span;
use crate::lang::diagnose::hints::wants_value;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind};

impl Reader<'_> {
    /// A remedy for a mark at the next token that has nothing to do with the values around it.
    pub(super) fn foreign_mark(&self, mark: char, wanted: &str) -> Option<Remedy> {
        let removed = |hint: &str| Some(Remedy::fix(hint, self.here_span(), ""));
        let is_statement = wanted.contains("statement");
        match mark {
            '[' if wanted.starts_with("`]` after an entry") => {
                let hint = "Write the `]` before `[`.";
                Some(Remedy::fix(hint, self.behind_last_token()?, "]"))
            }
            ')' | ']' if wanted.contains("`}`") && !is_statement && !self.lacks_closing_brace() => {
                removed(&format!("This `{mark}` closes nothing: remove it."))
            }
            ')' | ']' if wanted.contains("`}`") && !is_statement => {
                let hint = format!("`}}` closes this, not `{mark}`.");
                Some(Remedy::fix(hint, self.here_span(), "}"))
            }
            '>' if self.is_after_mark('>') => removed("This `>` closes nothing: remove it."),
            '{' if wants_value(wanted) && self.is_doubled_brace() => {
                removed("One `{` is enough: remove this one.")
            }
            ';' if wanted.contains("end of `#for`") => Some(Remedy::fix(
                "The parts of `#for` are separated by `,`.",
                self.here_span(),
                ",",
            )),
            '=' if self.statement.is_in_version => {
                removed("The version follows its word without a sign: remove `=`.")
            }
            ',' if wanted.starts_with("an operator or `;`") => self.second_declaration(),
            '*' if is_statement && self.raw_ahead(1).is_mark('/') => {
                let span = self.tokens_span(self.here.at..self.here.at + 2);
                Some(Remedy::fix(
                    "This `*/` closes no comment: remove it.",
                    span,
                    "",
                ))
            }
            '$' if self.raw_ahead(1).kind == Kind::Name => {
                removed("Names begin with a letter or `_`: remove `$`.")
            }
            '@' if self.is_before_directive() => Some(Remedy::fix(
                "Directives begin with `#`.",
                self.here_span(),
                "#",
            )),
            '\\' => self.backslash(),
            '%' => self.percentage(),
            _ => None,
        }
    }

    /// True at the second of two `{` of which one is too many.
    pub(super) fn is_doubled_brace(&self) -> bool {
        self.raw().is_mark('{') && self.is_after_mark('{') && self.lacks_closing_brace()
    }

    /// The position behind the last token.
    fn behind_last_token(&self) -> Option<Span> {
        let last = self.here.tokens.span(self.here.at.checked_sub(1)?);
        Some(Span::new(last.file, last.end, last.end))
    }

    /// `#declare A = 1, B = 2;`, at the comma.
    fn second_declaration(&self) -> Option<Remedy> {
        let is_second = self.raw_ahead(1).symbol().is_some() && self.raw_ahead(2).is_mark('=');
        let next = self.here.tokens.span(self.here.at + 1);
        let span = Span::new(next.file, self.here_span().start, next.start);
        let hint = "Each name has a `#declare` of its own.";
        is_second.then(|| Remedy::fix(hint, span, "; #declare "))
    }

    /// True if the word of a directive touches the next token.
    fn is_before_directive(&self) -> bool {
        let next = self.raw_ahead(1);
        let touches = self.here.tokens.span(self.here.at + 1).start == self.here_span().end;
        let class = next.word().map(Word::class);
        touches && class == Some(Class::Directive)
    }

    /// `\` at the end of a line, or before the letter of an escape sequence.
    fn backslash(&self) -> Option<Remedy> {
        let line = self.rest_of_line(self.here.at).trim_end();
        match line {
            "\\" => {
                let hint = "A line that goes on needs no `\\` at its end.";
                Some(Remedy::fix(hint, self.here_span(), ""))
            }
            "\\n" | "\\r\\n" | "\\n\\n" => {
                let hint = format!("`{line}` stands for the end of a line: remove it.");
                Some(self.removed_bytes(hint, line.len()))
            }
            _ => None,
        }
    }

    /// `50%`, at the `%`.
    fn percentage(&self) -> Option<Remedy> {
        let at = self.here.at;
        let before = at.checked_sub(1)?;
        let number = self.here.tokens.span(before);
        let touches = number.end == self.here_span().start;
        let percent: f64 = self.source_text(number).parse().ok()?;
        let is_share =
            self.token(before)?.kind == Kind::Number && touches && !self.is_operand(at + 1);
        is_share.then(|| {
            let share = format!("{}", percent / 100.0);
            let hint = format!("A share is a number: `{share}`.");
            Remedy::fix(hint, self.tokens_span(before..at + 1), share)
        })
    }

    /// `pigment rgb 1`, `clipped_by plane { ... }` and `object sphere { ... }`, behind the word.
    pub(super) fn block_of_one_value(&self, word: Word) -> Option<Remedy> {
        let at = self.here.at;
        let class = self.raw().word()?.class();
        let is_shape = matches!(class, Class::Shape | Class::Csg);
        let holds_shape = matches!(
            word,
            Word::ClippedBy | Word::BoundedBy | Word::ContainedBy | Word::LooksLike
        );
        if word == Word::Object && is_shape {
            let before = self.here.tokens.span(at.checked_sub(1)?);
            let span = Span::new(before.file, before.start, self.here_span().start);
            let hint = "A shape stands without `object`: remove this word.";
            return Some(Remedy::fix(hint, span, ""));
        }
        let holds_value = matches!(word, Word::Pigment | Word::Background) && class == Class::Color;
        // Where a `}` is there, only the `{` is missing.
        if self.has_more_closing_braces() {
            return None;
        }
        let is_known = holds_value || holds_shape && is_shape || word == Word::Default;
        let end = is_known.then(|| self.end_of_value(at))??;
        let span = self.tokens_span(at..end);
        let text = format!("{{ {} }}", self.source_text(span));
        let name = match word {
            Word::Default => "#default".to_owned(),
            word => word.to_string(),
        };
        Some(Remedy::fix(format!("Write `{name} {text}`."), span, text))
    }

    /// The pattern of a pigment that stands behind a modifier.
    pub(super) fn pattern_behind_modifier(&self, word: Word, wanted: &str) -> Option<Remedy> {
        let open = self.span_of(*self.blocks.last()?);
        let tokens = &self.here.tokens;
        let at = tokens
            .tokens
            .partition_point(|token| token.start <= open.start);
        let first = self.token(at)?.word()?;
        let is_late = wanted.ends_with("comes first, and once")
            && tokens.file == open.file
            && word.class() == Class::Pattern
            && !matches!(first.class(), Class::Pattern | Class::Color);
        is_late.then(|| format!("The pattern comes first: write `{word}` before `{first}`.").into())
    }

    /// `[1 rgb 1]` in a `texture_map`, at the colour.
    pub(super) fn color_in_texture_map(&self, word: Word) -> Option<Remedy> {
        let is_it =
            word.class() == Class::Color && self.words_of_blocks().next() == Some(Word::TextureMap);
        let end = is_it.then(|| self.end_of_value(self.here.at))??;
        let span = self.tokens_span(self.here.at..end);
        let text = format!("pigment {{ {} }}", self.source_text(span));
        let hint = format!("A texture begins with its parts: `{text}`.");
        self.token(end)?
            .is_mark(']')
            .then(|| Remedy::fix(hint, span, text))
    }
}

//! Arrays in the notation of other languages.

use crate::lang::diagnose::remedy::Remedy;
use crate::lang::reader::Reader;
use crate::lang::syntax::Kind;

impl Reader<'_> {
    /// `{1, 2, 3}` where a value is declared.
    pub(super) fn array_without_size(&self) -> Option<Remedy> {
        let text = format!("array[{}] {{", self.items_in_braces()?);
        let hint = format!("An array begins with its size: `{text}`.");
        Some(Remedy::fix(hint, self.here_span(), text))
    }

    /// `[1, 2, 3]` where a value is declared.
    pub(super) fn array_in_brackets(&self) -> Option<Remedy> {
        let count = self.items_in('[', ']')?;
        let end = self.end_of_brackets(self.here.at, '[', ']')?;
        let span = self.tokens_span(self.here.at..end);
        let items = self
            .source_text(span)
            .strip_prefix('[')?
            .strip_suffix(']')?;
        let text = format!("array[{count}] {{ {} }}", items.trim());
        let hint = format!("An array begins with its size: `{text}`.");
        Some(Remedy::fix(hint, span, text))
    }

    /// `#declare A[3] = { 1, 2, 3 }`, from its `[` on.
    pub(super) fn array_by_name_and_size(&self) -> Option<Remedy> {
        let end = self.end_of_brackets(self.here.at, '[', ']')?;
        let size = self.tokens_span(self.here.at..end);
        let array = format!(" = array{}", self.source_text(size));
        let name = self
            .here
            .at
            .checked_sub(1)
            .map(|at| self.here.tokens.span(at));
        let name = name.map_or("", |name| self.source_text(name));
        let hint = format!("Write the size behind the `=`: `{name}{array}`.");
        let has_sign = self.token(end)?.is_mark('=');
        let is_whole = match has_sign {
            true => self.token(end + 1)?.is_mark('{'),
            false => self.token(end)?.is_mark(';'),
        };
        let span = self.tokens_span(self.here.at..end + usize::from(has_sign));
        Some(match is_whole {
            true => Remedy::fix(hint, span, array),
            false => hint.into(),
        })
    }

    /// The number of items in the braces that open at the next token, if there are any.
    fn items_in_braces(&self) -> Option<usize> {
        self.items_in('{', '}')
    }

    fn items_in(&self, open: char, close: char) -> Option<usize> {
        let at = self.here.at;
        let end = self.end_of_brackets(at, open, close)?;
        let mut depth = 0;
        let mut commas = 0;
        for at in at + 1..end - 1 {
            let token = self.token(at)?;
            let opens = ['<', '(', '{'].iter().any(|&mark| token.is_mark(mark));
            let closes = ['>', ')', '}'].iter().any(|&mark| token.is_mark(mark));
            depth += i32::from(opens) - i32::from(closes);
            commas += usize::from(depth == 0 && token.is_mark(','));
        }
        (end > at + 2).then_some(commas + 1)
    }

    /// The size of an array without brackets, in others, or missing, behind the word `array`.
    pub(crate) fn size_of_array(&self) -> Option<Remedy> {
        let token = self.raw();
        let of_3_8 = token.symbol().and_then(|name| self.word_of_3_8(name));
        if of_3_8.is_some() {
            return of_3_8;
        }
        let hint = "The size of an array stands in brackets";
        match token.kind {
            Kind::Mark if token.is_mark('(') => self.rebracketed('(', ')', "[", "]", hint),
            Kind::Mark if token.is_mark('{') => {
                let text = format!("[{}] {{", self.items_in_braces()?);
                let hint = format!("An array begins with its size: `array{text}`.");
                Some(Remedy::fix(hint, self.here_span(), text))
            }
            Kind::Number | Kind::Name => {
                let text = format!("[{}]", self.source_text(self.here_span()));
                Some(Remedy::fix(
                    format!("{hint}: `{text}`."),
                    self.here_span(),
                    text,
                ))
            }
            _ => None,
        }
    }

    /// `A(1)` for an item of an array, from its `(` on.
    pub(crate) fn item_in_parentheses(&self) -> Option<Remedy> {
        let is_call = self.raw().is_mark('(');
        let remedy = || self.rebracketed('(', ')', "[", "]", "An index stands in brackets");
        is_call.then(remedy)?
    }
}

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

    /// The number of items in the braces that open at the next token, if there are any.
    fn items_in_braces(&self) -> Option<usize> {
        let at = self.here.at;
        let end = self.end_of_brackets(at, '{', '}')?;
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

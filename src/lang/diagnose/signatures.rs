//! Calls of functions with too few arguments.

use crate::base::args::Word;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::reader::Reader;

/// Most tokens of the arguments of a call.
const ARGUMENTS: usize = 64;

/// Functions of several arguments, and their arguments.
const SIGNATURES: &[(Word, &str)] = &[
    (Word::Atan2, "y, x"),
    (Word::DimensionSize, "array, dimension"),
    (Word::Div, "a, b"),
    (Word::Inside, "object, <point>"),
    (Word::Mod, "a, b"),
    (Word::Pow, "base, exponent"),
    (Word::Seed, "number"),
    (Word::Select, "number, below zero, otherwise"),
    (Word::Str, "number, length, digits"),
    (Word::Strcmp, "string, string"),
    (Word::Substr, "string, start, length"),
    (Word::Trace, "object, <start>, <direction>"),
    (Word::VaxisRotate, "<vector>, <axis>, angle"),
    (Word::Vcross, "<vector>, <vector>"),
    (Word::Vdot, "<vector>, <vector>"),
    (Word::Vrotate, "<vector>, <angles>"),
    (Word::Vstr, "count, <vector>, separator, length, digits"),
];

impl Reader<'_> {
    /// The arguments of the function whose call ends at the next token, a `)`.
    pub(super) fn missing_arguments(&self) -> Option<Remedy> {
        let at = self.here.at;
        let mut depth = 0;
        let open = (at.saturating_sub(ARGUMENTS)..at).rev().find(|&at| {
            let is_mark = |mark| self.token(at).is_some_and(|token| token.is_mark(mark));
            depth += i32::from(is_mark('(')) - i32::from(is_mark(')'));
            depth > 0
        })?;
        let word = self.token(open.checked_sub(1)?)?.word()?;
        let (_, arguments) = SIGNATURES.iter().find(|(known, _)| *known == word)?;
        Some(format!("Write `{word}({arguments})`.").into())
    }
}

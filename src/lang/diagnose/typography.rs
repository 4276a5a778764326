//! Characters that word processors and web pages put in the place of ASCII: dashes, quotes, spaces, full-width signs,
//! HTML's entities.

use crate::base::source::Span;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::limits;
use crate::lang::reader::Reader;
use crate::lang::syntax::{self, Token};

/// Tokens among which the beginning of a call is searched for.
const CALL_TOKENS: usize = 32;

/// A character or entity, and the ASCII text that is meant by it.
struct Sign {
    /// Its bytes in the scene.
    len: usize,
    /// The text that replaces it.
    meant: String,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Visible,
    Space,
    Nothing,
    Entity,
}

impl Reader<'_> {
    /// The ASCII text for the next token, and for all such signs behind it in the line.
    pub(super) fn typography(&self, token: Token) -> Option<Remedy> {
        let letter = (token.kind == syntax::Kind::Mark)
            .then(|| char::from_u32(token.value))
            .flatten()
            .filter(|&letter| !letter.is_ascii() || letter == '&')?;
        let at = self.here.at;
        let line = self.rest_of_line(at);
        match letter {
            '°' => {
                return Some(match self.is_in_call() {
                    true => self.in_radians(),
                    false => {
                        let hint = "Angles are in degrees already: remove `°`.";
                        Remedy::fix(hint, self.here_span(), "")
                    }
                });
            }
            '²' | '³' => return Some(self.raised(if letter == '²' { 2 } else { 3 })),
            '¼' | '½' | '¾' => {
                let number = match letter {
                    '¼' => "0.25",
                    '½' => "0.5",
                    _ => "0.75",
                };
                let hint = format!("Write `{letter}` as `{number}`.");
                return Some(Remedy::fix(hint, self.here_span(), number));
            }
            '…' => return Some("`…` stands for text that was left out: write that text.".into()),
            _ => {}
        }
        let Some(first) = sign(line) else {
            return self.letter_of_name(letter);
        };
        let start = self.here_span().start as usize;
        let before = self.sources.text(self.here.tokens.file).get(..start);
        let last = before.and_then(|before| before.chars().next_back());
        let (len, text) = line_in_ascii(last, line);
        let written = &line[..first.len];
        let hint = match first.kind {
            Kind::Visible => format!(
                "`{written}` (U+{:04X}) is not `{}`.",
                u32::from(letter),
                first.meant
            ),
            Kind::Space => format!(
                "The character U+{:04X} looks like a space and is none.",
                u32::from(letter)
            ),
            Kind::Nothing => format!(
                "The invisible character U+{:04X} is here: remove it.",
                u32::from(letter)
            ),
            Kind::Entity => format!("`{written}` is HTML: write `{}`.", first.meant),
        };
        Some(Remedy::fix(hint, self.bytes_from(at, len), text))
    }

    /// A word with letters of other alphabets that look like those of ASCII, of which the next token is a part.
    pub(super) fn look_alikes(&self) -> Option<Remedy> {
        let text = self.sources.text(self.here.tokens.file);
        let at = self.here_span().start as usize;
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let before = text.get(..at)?.trim_end_matches(is_part).len();
        let word = text.get(before..)?;
        let word = &word[..word.find(|c| !is_part(c)).unwrap_or(word.len())];
        let foreign = word.chars().find(|c| !c.is_ascii())?;
        let meant: Option<String> = word.chars().map(in_latin).collect();
        let meant = meant.filter(|_| word.len() <= limits::QUOTED)?;
        let file = self.here.tokens.file;
        let offset = |at: usize| u32::try_from(at).ok();
        let span = Span::new(file, offset(before)?, offset(before + word.len())?);
        let hint = format!(
            "`{foreign}` (U+{:04X}) looks like `{}` and is not: write `{meant}`.",
            u32::from(foreign),
            in_latin(foreign)?
        );
        Some(Remedy::fix(hint, span, meant))
    }

    /// `r²` for `pow(r, 2)`.
    fn raised(&self, power: u32) -> Remedy {
        let before = self.here.at.checked_sub(1);
        let is_base = |at: usize| {
            let earlier = at.checked_sub(1).and_then(|at| self.token(at));
            let is_part =
                |token: Token| token.is_mark('.') || token.kind == syntax::Kind::Directive;
            self.is_operand(at) && !earlier.is_some_and(is_part)
        };
        let is_declared = |at: usize| {
            let earlier = at.checked_sub(1).and_then(|at| self.token(at));
            earlier.is_some_and(|token| token.kind == syntax::Kind::Directive)
        };
        if before.is_some_and(is_declared) {
            return "Names consist of letters, digits and `_`: write the digit as such.".into();
        }
        let base = before.filter(|&at| is_base(at));
        let base = base.map(|at| self.here.tokens.span(at));
        match base.filter(|base| base.end == self.here_span().start) {
            Some(base) => {
                let text = format!("pow({}, {power})", self.source_text(base));
                Remedy::fix(format!("Write `{text}`."), base.to(self.here_span()), text)
            }
            None => self
                .raised_parentheses(power)
                .unwrap_or_else(|| "A power is `pow(a, b)`.".into()),
        }
    }

    /// The angle before a degree sign, for a function.
    fn in_radians(&self) -> Remedy {
        let angle = self
            .here
            .at
            .checked_sub(1)
            .filter(|&at| self.is_operand(at));
        let Some(angle) = angle.map(|at| self.here.tokens.span(at)) else {
            return "Functions take angles in radians: write `radians(45)`.".into();
        };
        let text = format!("radians({})", self.source_text(angle));
        let hint = format!("Functions take angles in radians: write `{text}`.");
        Remedy::fix(hint, angle.to(self.here_span()), text)
    }

    /// `(a + b)²` for `pow(a + b, 2)`.
    fn raised_parentheses(&self, power: u32) -> Option<Remedy> {
        let close = self.here.at.checked_sub(1)?;
        let mut depth = 0;
        let open = (close.saturating_sub(CALL_TOKENS)..=close).rfind(|&at| {
            let is = |mark: char| self.token(at).is_some_and(|token| token.is_mark(mark));
            depth += i32::from(is(')')) - i32::from(is('('));
            depth == 0
        })?;
        let before = open.checked_sub(1).and_then(|at| self.token(at));
        let is_call =
            before.is_some_and(|token| token.symbol().is_some() || token.word().is_some());
        let inner = self.source_text(self.tokens_span(open..close + 1));
        let inner = inner.strip_prefix('(')?.strip_suffix(')')?;
        let text = format!("pow({inner}, {power})");
        (!is_call && inner.len() <= limits::QUOTED).then(|| {
            let span = self.tokens_span(open..self.here.at + 1);
            Remedy::fix(format!("Write `{text}`."), span, text)
        })
    }

    /// True between the parentheses of a function.
    fn is_in_call(&self) -> bool {
        let mut depth = 0;
        let start = self.here.at.saturating_sub(CALL_TOKENS);
        let open = (start..self.here.at).rev().find(|&at| {
            let is = |mark: char| self.token(at).is_some_and(|token| token.is_mark(mark));
            depth += i32::from(is('(')) - i32::from(is(')'));
            depth == 1
        });
        let name = open.and_then(|at| self.token(at.checked_sub(1)?)?.word());
        name.is_some_and(|word| word.class() == syntax::Class::Function)
    }

    /// A letter of another alphabet, as part of a name.
    fn letter_of_name(&self, letter: char) -> Option<Remedy> {
        letter.is_alphabetic().then(|| {
            format!("Names consist of the letters a to z, digits and `_`: write another one for `{letter}`.").into()
        })
    }
}

/// A text up to the last foreign sign in it, before any string or comment, in ASCII; and its length before. `last` is the
/// character in front of it.
fn line_in_ascii(last: Option<char>, line: &str) -> (usize, String) {
    let (mut at, mut text) = (0, String::new());
    let mut known = (0, 0);
    while let Some(next) = line[at..].chars().next() {
        let rest = &line[at..];
        if at > limits::QUOTED || rest.starts_with('"') || rest.starts_with("//") {
            break;
        }
        if let Some(sign) = sign(rest) {
            at += sign.len;
            let is_factor = |c: char| c.is_ascii_alphanumeric() || "_)".contains(c);
            let is_pi = sign.meant == "pi";
            if is_pi && text.chars().next_back().or(last).is_some_and(is_factor) {
                text.push('*');
            }
            text.push_str(&sign.meant);
            if is_pi && line[at..].starts_with(|c: char| c.is_ascii_alphanumeric()) {
                text.push('*');
            }
            known = (at, text.len());
        } else {
            at += next.len_utf8();
            text.push(next);
        }
    }
    text.truncate(known.1);
    (known.0, text)
}

/// The letter of ASCII that a Cyrillic or Greek one looks like; ASCII stays as it is.
fn in_latin(letter: char) -> Option<char> {
    let foreign = "АВЕКМНОРСТХІЈЅаеорсухіјѕΑΒΕΖΗΙΚΜΝΟΡΤΥΧορν";
    let latin = "ABEKMHOPCTXIJSaeopcyxijsABEZHIKMNOPTYXopv";
    let at = || foreign.chars().position(|known| known == letter);
    match letter.is_ascii() {
        true => Some(letter),
        false => latin.chars().nth(at()?),
    }
}

/// The sign that begins a text.
fn sign(text: &str) -> Option<Sign> {
    if let Some(entity) = text.strip_prefix('&') {
        let (name, _) = entity.split_once(';')?;
        let (_, meant) = ENTITIES.iter().find(|(entity, _)| *entity == name)?;
        return Some(Sign {
            len: name.len() + 2,
            meant: (*meant).to_owned(),
            kind: Kind::Entity,
        });
    }
    let letter = text.chars().next()?;
    let (meant, kind) = match letter {
        '\u{a0}'
        | '\u{2000}'..='\u{200a}'
        | '\u{202f}'
        | '\u{205f}'
        | '\u{3000}'
        | '\u{2028}'
        | '\u{2029}' => (" ".to_owned(), Kind::Space),
        '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}' => {
            (String::new(), Kind::Nothing)
        }
        '\u{ff01}'..='\u{ff5e}' => {
            let ascii = char::from_u32(u32::from(letter) - 0xfee0)?;
            (ascii.to_string(), Kind::Visible)
        }
        _ => {
            let (_, meant) = SIGNS.iter().find(|(letters, _)| letters.contains(letter))?;
            ((*meant).to_owned(), Kind::Visible)
        }
    };
    Some(Sign {
        len: letter.len_utf8(),
        meant,
        kind,
    })
}

/// Signs with the text that is meant. Those from U+0091 to U+0097 are of Windows' character set.
const SIGNS: &[(&str, &str)] = &[
    ("‐‑‒–—―−﹣\u{96}\u{97}", "-"),
    ("“”„‟«»″‘’‚‛′´\u{91}\u{92}\u{93}\u{94}", "\""),
    ("×∗·∙⋅", "*"),
    ("÷∕⁄", "/"),
    ("≤", "<="),
    ("≥", ">="),
    ("≠", "!="),
    ("‹⟨〈", "<"),
    ("›⟩〉", ">"),
    ("π", "pi"),
    ("、", ","),
    ("。", "."),
];

/// HTML's entities.
const ENTITIES: &[(&str, &str)] = &[
    ("lt", "<"),
    ("gt", ">"),
    ("amp", "&"),
    ("quot", "\""),
    ("nbsp", " "),
    ("minus", "-"),
    ("ndash", "-"),
    ("times", "*"),
];

#[cfg(test)]
mod tests {
    use super::line_in_ascii;

    #[test]
    fn signs_become_ascii_up_to_a_string_or_comment() {
        assert_eq!(line_in_ascii(None, "–1, −2>"), (9, "-1, -".to_owned()));
        assert_eq!(
            line_in_ascii(None, "“a.inc”  // – b"),
            (11, "\"a.inc\"".to_owned())
        );
        assert_eq!(line_in_ascii(None, "&lt;0&gt;, 1"), (9, "<0>".to_owned()));
        assert_eq!(line_in_ascii(Some('2'), "π/2"), (2, "*pi".to_owned()));
        assert_eq!(line_in_ascii(Some('('), "π"), (2, "pi".to_owned()));
    }
}

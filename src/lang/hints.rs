//! What to do about a token that does not belong where it stands.

use super::reader::Reader;
use super::value::Value;
use crate::args::Word;
use crate::source::Span;
use crate::syntax::{Class, END_OF_FILE, Kind, Symbol, Token, Tokens};

/// Folders hold so many include files at most that are searched for a name.
const INCLUDE_FILES: usize = 200;

impl Reader<'_> {
    /// What the token at hand, which cannot stand there, was probably meant to be.
    pub(super) fn remedy(&self, token: Token, wanted: &str) -> Option<String> {
        match token.kind {
            Kind::Name => self.remedy_of_name(Symbol(token.value), wanted),
            Kind::Mark => self.remedy_of_mark(char::from_u32(token.value)?, wanted),
            Kind::Word => remedy_of_word(token.word()?, wanted),
            _ => None,
        }
    }

    fn remedy_of_mark(&self, mark: char, wanted: &str) -> Option<String> {
        let before = self.mark_before();
        let text = match mark {
            '=' if before == Some('=') => "One `=` compares two values.",
            '&' if before == Some('&') => "One `&` means \"and\".",
            '|' if before == Some('|') => "One `|` means \"or\".",
            '[' => "Only an array has items in `[` and `]`.",
            '+' if self.is_behind_string() => "Strings are joined by `concat(a, b)`.",
            '%' => "The remainder of a division is `mod(a, b)`.",
            '^' => "A power is `pow(a, b)`.",
            '+' | '-' | '*' | '/' if wanted.starts_with("`=` after") => {
                "Write the name again behind `=`: `#declare N = N + 1;`."
            }
            '=' if wanted.contains("the start of `#for`") => {
                "Write `#for (I, first, last)`, with commas only."
            }
            ',' if wanted.contains("modifier") => {
                "Parts of a block stand without commas; remove it."
            }
            ';' if wanted.contains("modifier") || wanted.contains("statement") => {
                "Only declarations of numbers, and some directives, end with `;`; remove it."
            }
            _ => return None,
        };
        Some(text.to_owned())
    }

    /// The mark that stands right before the token at hand.
    fn mark_before(&self) -> Option<char> {
        let at = self.here.at.checked_sub(1)?;
        let token = self.here.tokens.tokens[at];
        let touches = self.here.tokens.span(at).end == self.here_span().start;
        (token.kind == Kind::Mark && touches).then(|| char::from_u32(token.value))?
    }

    fn is_behind_string(&self) -> bool {
        let before = self.here.at.checked_sub(1);
        before.is_some_and(|at| self.here.tokens.tokens[at].kind == Kind::String)
    }

    fn remedy_of_name(&self, symbol: Symbol, wanted: &str) -> Option<String> {
        let name = self.names.spelling(symbol);
        if let Some(value) = self.scopes.get(symbol) {
            let element = match value {
                Value::Element(element) => element.name,
                Value::Object(_) => "object",
                _ => return None,
            };
            let is_statement = wanted.contains("`}`") || wanted.contains("statement");
            return is_statement.then(|| format!("Write `{element} {{ {name} }}`."));
        }
        let small = name.to_lowercase();
        if let Some(word) = Word::from_spelling(&small)
            && matches!(word.class(), Class::Shape | Class::Csg | Class::Statement)
        {
            return Some(format!("Reserved words have small letters: `{small}`."));
        }
        if let Some(file) = self.sources.library_file_that_declares(name, INCLUDE_FILES) {
            return Some(format!(
                "`{file}` declares `{name}`: write `#include \"{file}\"` above."
            ));
        }
        Some(match self.similar_name(name) {
            Some(near) => format!("Did you mean `{near}`?"),
            None => format!("Declare `{name}` above, or include the file that does."),
        })
    }

    /// A declared name or a reserved word that differs from this one by a letter or two.
    fn similar_name(&self, wanted: &str) -> Option<String> {
        let mut known: Vec<&str> = Word::all().map(Word::spelling).collect();
        let declared = self.scopes.defined();
        known.extend(declared.map(|symbol| self.names.spelling(symbol)));
        super::similar::nearest(wanted, known.into_iter()).map(str::to_owned)
    }

    /// The directive whose spelling is nearest.
    pub(super) fn similar_directive(wanted: &str) -> Option<&'static str> {
        let words = Word::all().filter(|word| word.class() == Class::Directive);
        super::similar::nearest(wanted, words.map(Word::spelling))
    }

    /// How an object is written, for those who leave out a part of it.
    pub(super) fn usage(word: Word) -> Option<&'static str> {
        Some(match word {
            Word::Sphere => "`sphere { <centre>, radius ... }`",
            Word::Box => "`box { <corner>, <opposite corner> ... }`",
            Word::Cylinder => "`cylinder { <end>, <other end>, radius ... }`",
            Word::Cone => "`cone { <end>, radius, <other end>, radius ... }`",
            Word::Plane => "`plane { <normal>, distance ... }`",
            Word::Disc => "`disc { <centre>, <normal>, radius [, hole] ... }`",
            Word::Torus => "`torus { major, minor ... }`",
            Word::Quadric => "`quadric { <A, B, C>, <D, E, F>, <G, H, I>, J ... }`",
            Word::Blob => "`blob { threshold value sphere { <centre>, radius, strength } ... }`",
            Word::Superellipsoid => "`superellipsoid { <e, n> ... }`",
            Word::Prism => "`prism { height, other height, number of points, <x, z>, ... }`",
            Word::Lathe => "`lathe { number of points, <r, y>, ... }`",
            Word::Sor => "`sor { number of points, <r, y>, ... }`",
            Word::Polygon => "`polygon { number of points, <point>, ... }`",
            Word::Poly => "`poly { order, <coefficients> ... }`",
            Word::Cubic => "`cubic { <20 coefficients> ... }`",
            Word::Quartic => "`quartic { <35 coefficients> ... }`",
            Word::Ovus => "`ovus { bottom radius, top radius ... }`",
            Word::Triangle => "`triangle { <corner>, <corner>, <corner> ... }`",
            Word::SmoothTriangle => {
                "`smooth_triangle { <corner>, <normal>, <corner>, <normal>, <corner>, <normal> ... }`"
            }
            Word::LightSource => "`light_source { <place>, colour ... }`",
            _ => return None,
        })
    }

    /// The opened `{` that the missing `}` belongs to, where the indentation tells: a block whose `}` begins a line
    /// with less indentation than the line of its `{` has swallowed the `}` of the block around it.
    pub(super) fn swallowed_end(&self, open: Span) -> Option<(Span, Span)> {
        let tokens = &self.here.tokens;
        if open.file != tokens.file || open.start > self.here_span().start {
            return None;
        }
        let text = self.sources.text(open.file);
        let mut inner: Vec<usize> = Vec::new();
        let first = tokens
            .tokens
            .partition_point(|token| token.start <= open.start);
        for at in first..self.here.at {
            let token = tokens.tokens[at];
            if token.is_mark('{') {
                inner.push(at);
            } else if token.is_mark('}') {
                let (start, end) = (tokens.span(inner.pop()?), tokens.span(at));
                let (opened, _) = indentation(text, start.start as usize);
                let (closed, is_first) = indentation(text, end.start as usize);
                if is_first && closed < opened {
                    return Some((start, end));
                }
            }
        }
        None
    }

    /// The last directive of a file whose group has no `#end` there.
    pub(super) fn unclosed_directive(tokens: &Tokens) -> Option<Span> {
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

    /// Whether this name has been found undeclared before, or may stand in a file that was not found: then its error
    /// is a consequence of one that was told.
    pub(super) fn is_known_as_undeclared(&mut self, token: Token) -> bool {
        let symbol = Symbol(token.value);
        token.kind == Kind::Name
            && self.scopes.get(symbol).is_none()
            && (self.lacks_file || !self.undeclared.insert(symbol))
    }

    /// Whether a value is one that failed.
    pub(super) fn is_poison(&self, token: Token) -> bool {
        token.kind == Kind::Name
            && matches!(self.scopes.get(Symbol(token.value)), Some(Value::Poison))
    }
}

/// Whether a directive needs an `#end`.
pub(super) fn opens_group(word: Word) -> bool {
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

fn remedy_of_word(word: Word, wanted: &str) -> Option<String> {
    let is_in = |block: &str| wanted.ends_with(block);
    if word.class() == Class::Color && is_in("`texture`") {
        return Some("A colour stands in `pigment { }`.".to_owned());
    }
    let is_part = matches!(
        word,
        Word::Texture | Word::Pigment | Word::Normal | Word::Finish | Word::Interior
    );
    if is_part && (is_in("`pigment`") || is_in("`finish` or `}`")) {
        return Some(format!(
            "`{word}` stands beside this block, not in it: close it with `}}` first."
        ));
    }
    None
}

/// How far the line of a byte is indented, and whether the byte is its first.
fn indentation(text: &str, at: usize) -> (usize, bool) {
    let line = text[..at].rfind(['\n', '\r']).map_or(0, |end| end + 1);
    let before = &text[line..at];
    let indent = before.len() - before.trim_start().len();
    (indent, indent == before.len())
}

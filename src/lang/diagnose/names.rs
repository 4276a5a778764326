//! Names that are not declared, or not what is expected, and the words and names that they resemble.

use crate::base::args::Word;
use crate::base::nearest::nearest;
use crate::base::source::Span;
use crate::lang::diagnose::hints::{INCLUDE_FILES, fits, wants_value, wants_word};
use crate::lang::diagnose::other_dialects;
use crate::lang::diagnose::remedy::Remedy;
use crate::lang::expr::value::Value;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Symbol, Token};

pub(super) const NUMBER_FOR_STRING: &str = "A number becomes a string by `str(number, 0, digits)`.";

impl Reader<'_> {
    /// A declared name that differs from the next token, an undeclared name or a word, by capitals only.
    pub(super) fn other_case(&self, token: Token, wanted: &str) -> Option<Remedy> {
        let is_free = match token.kind {
            Kind::Name => self.scopes.get(Symbol(token.value)).is_none(),
            Kind::Word => wants_value(wanted) || wanted.starts_with("a colour"),
            _ => false,
        };
        let name = self.source_text(self.here_span());
        is_free.then(|| self.declared_in_other_case(name, self.here_span()))?
    }

    /// A declared name that differs from a text by capitals only.
    pub(super) fn declared_in_other_case(&self, name: &str, span: Span) -> Option<Remedy> {
        let declared = self.scopes.defined();
        let names = declared.map(|symbol| self.names.spelling(symbol));
        let mut similar = names.filter(|known| known.eq_ignore_ascii_case(name));
        let known = similar.next()?;
        let remedy = Remedy::fix(format!("Names differ by capitals: `{known}`."), span, known);
        Some(match similar.next() {
            Some(_) => remedy.uncertain(),
            None => remedy,
        })
    }

    /// A remedy for a word of version 3.8 in an older scene.
    pub(super) fn word_of_3_8(&self, symbol: Symbol) -> Option<Remedy> {
        let name = self.names.spelling(symbol);
        self.dialect.is_of_3_8(symbol, &self.names).then(|| {
            let hint = "begin the scene with `#version 3.8;`.";
            format!("`{name}` is a word of POV-Ray 3.8: {hint}").into()
        })
    }

    /// A remedy for a name that cannot stand where `wanted` is expected.
    pub(super) fn remedy_of_name(&self, symbol: Symbol, wanted: &str) -> Option<Remedy> {
        let name = self.names.spelling(symbol);
        if let Some(value) = self.scopes.get(symbol) {
            return self.remedy_of_value(name, value, wanted);
        }
        if let Some(remedy) = self.word_of_3_8(symbol) {
            return Some(remedy);
        }
        if other_dialects::is_of_hg_povray(name) {
            let hint = format!("`{name}` is a word of HG-POV, which POV-Ray does not read either.");
            return Some(hint.into());
        }
        if let Some(line) = self.declared_further_down(symbol) {
            let hint = format!("`{name}` is declared only in line {line}: move that above this.");
            return Some(hint.into());
        }
        if let Some(known) = self.sources.library_file_that_declares(name, INCLUDE_FILES) {
            let file = known.file;
            let include = format!("`{file}` declares `{name}`: write `#include \"{file}\"` above");
            let is_color =
                Word::from_spelling(&known.kind).is_some_and(|word| word.class() == Class::Color);
            let hint = match is_color && wanted.ends_with("`texture`") {
                true => format!("{include}, and `pigment {{ {name} }}` here, for it is a colour."),
                false => format!("{include}."),
            };
            return Some(hint.into());
        }
        if name == "rgba" {
            return Some(self.color_with_opacity());
        }
        if self.is_loop_variable() {
            return Some("Write `#for (I, first, last)`.".into());
        }
        let is_call = wanted.contains("statement") && self.raw_ahead(1).is_mark('(');
        let meant = || {
            let meant = other_dialects::translated(name, wants_value(wanted))
                .or_else(|| other_dialects::translated(name, wanted == "a value"))?;
            Some(match meant.word {
                Some(word) => Remedy::fix(meant.hint, self.here_span(), word),
                None => meant.hint.into(),
            })
        };
        let similar = || {
            let near = self.similar_name(name, wanted)?;
            let hint = format!("Did you mean `{near}`?");
            Some(Remedy::fix(hint, self.here_span(), near))
        };
        // A capital begins a name of the author's own.
        let is_own = is_call || name.starts_with(char::is_uppercase);
        let remedy = match is_own {
            true => similar().or_else(meant),
            false => meant().or_else(similar),
        };
        let in_string = || self.name_in_string(name, wanted);
        remedy.or_else(in_string).or_else(|| {
            let hint = match wants_word(wanted) && !wanted.contains("statement") {
                _ if is_call => {
                    format!("Define the macro `{name}` above, or include the file that does.")
                }
                true => format!("There is no word `{name}`, and nothing of that name is declared."),
                false => format!("Declare `{name}` above, or include the file that does."),
            };
            Some(hint.into())
        })
    }

    /// A word that lacks its quotes, or stands behind a quote within a string.
    fn name_in_string(&self, name: &str, wanted: &str) -> Option<Remedy> {
        let before = self.here.at.checked_sub(1)?;
        let touches = self.here.tokens.span(before).end == self.here_span().start;
        if self.token(before)?.kind == Kind::String && touches {
            return Some("A quote within a string is written `\\\"`.".into());
        }
        (wanted == "a string").then(|| {
            let string = format!("\"{name}\"");
            let hint = format!("Strings stand in double quotes: `{string}`.");
            Remedy::fix(hint, self.here_span(), string)
        })
    }

    /// `rgba <1, 0, 0, 0.5>`, whose last component is the opacity in other programs.
    fn color_with_opacity(&self) -> Remedy {
        let hint = "`rgba` is not a colour: the fourth component of `rgbt` is transparency, 1 minus the opacity.";
        let opacity = |at: usize| {
            let end = self.end_of_brackets(at, '<', '>')?;
            let span = self.tokens_span(at..end);
            let inner = self
                .source_text(span)
                .strip_prefix('<')?
                .strip_suffix('>')?;
            let parts: Vec<&str> = inner.split(',').map(str::trim).collect();
            let [red, green, blue, opacity] = parts.as_slice() else {
                return None;
            };
            let clear = match *opacity {
                "1" | "1.0" => "0".to_owned(),
                opacity => format!("1 - {opacity}"),
            };
            let text = format!("rgbt <{red}, {green}, {blue}, {clear}>");
            Some(Remedy::fix(hint, self.here_span().to(span), text))
        };
        opacity(self.here.at + 1).unwrap_or_else(|| hint.into())
    }

    /// A remedy for a declared name of another kind than is expected.
    fn remedy_of_value(&self, name: &str, value: &Value, wanted: &str) -> Option<Remedy> {
        let element = match value {
            Value::Element(element) => element.name,
            Value::Object(_) => "object",
            Value::Number(_) if wanted == "a string" => return Some(NUMBER_FOR_STRING.into()),
            Value::Number(number) if number.len > 2 && wanted.ends_with("in `texture`") => {
                "pigment"
            }
            _ => return None,
        };
        let is_part = ["texture", "pigment", "finish", "normal", "interior"]
            .iter()
            .any(|part| {
                wanted.ends_with(&format!("`{part}`")) || wanted.contains(&format!("of `{part}`"))
            });
        let written = format!("{element} {{ {name} }}");
        let hint = match element {
            "object" if is_part => {
                format!("`{name}` is drawn by `object {{ {name} }}`; it is not part of a texture.")
            }
            "object" if wants_value(wanted) => {
                format!("`{name}` is drawn by `object {{ {name} }}`; a number is expected here.")
            }
            "object" if wanted.starts_with("a modifier") || wanted.starts_with("a transform") => {
                format!(
                    "The operands of a CSG object come before its modifiers: move `{name}` up, or after the `}}`."
                )
            }
            "texture" | "pigment" | "finish" | "normal" if wanted.contains("statement") => {
                format!("A {element} belongs in an object: `{written}`.")
            }
            _ if wants_word(wanted) => {
                let hint = format!("Write `{written}`.");
                return Some(Remedy::fix(hint, self.span_of_block_of_name(), written));
            }
            _ => return None,
        };
        Some(hint.into())
    }

    /// The name at the next token, or a part of an object that holds nothing else: `pigment { Gold }`.
    fn span_of_block_of_name(&self) -> Span {
        let at = self.here.at;
        let is_part = |at: usize| {
            let word = self.token(at).and_then(|token| token.word());
            matches!(
                word,
                Some(Word::Pigment | Word::Normal | Word::Finish | Word::Interior)
            )
        };
        let is_mark = |at: usize, mark| self.token(at).is_some_and(|token| token.is_mark(mark));
        match at >= 2 && is_part(at - 2) && is_mark(at - 1, '{') && is_mark(at + 1, '}') {
            true => self.tokens_span(at - 2..at + 2),
            false => self.here_span(),
        }
    }

    /// A keyword with capitals, which is an undeclared name.
    pub(super) fn keyword_in_capitals(&self, name: Symbol, wanted: &str) -> Option<Remedy> {
        let word = Word::from_spelling(&self.names.spelling(name).to_lowercase())?;
        // `Red` is the colour of that name, not the word `red`.
        let is_part_of_color = matches!(
            word,
            Word::Red | Word::Green | Word::Blue | Word::Gray | Word::Filter | Word::Transmit
        );
        if self.scopes.get(name).is_some() || is_part_of_color || !fits(word, wanted) {
            return None;
        }
        let hint = format!("Keywords are lower case: `{word}`.");
        Some(Remedy::fix(hint, self.here_span(), word.spelling()))
    }

    /// True if the next token is the variable of a `#for` without `(`.
    fn is_loop_variable(&self) -> bool {
        let before = self
            .here
            .at
            .checked_sub(1)
            .map(|at| self.here.tokens.tokens[at]);
        before.is_some_and(|before| {
            before.kind == Kind::Directive
                && self.here.tokens.directives[before.value as usize].word == Some(Word::For)
        })
    }

    /// The line of the same file, below this one, that declares a name.
    fn declared_further_down(&self, symbol: Symbol) -> Option<usize> {
        let tokens = &self.here.tokens;
        let declares = |pair: &[Token]| {
            let [directive, name] = pair else {
                return false;
            };
            name.symbol() == Some(symbol)
                && directive.kind == Kind::Directive
                && matches!(
                    tokens.directives[directive.value as usize].word,
                    Some(Word::Declare | Word::Local | Word::Macro)
                )
        };
        let behind = tokens.tokens.get(self.here.at..)?;
        let at = self.here.at + behind.windows(2).position(declares)?;
        Some(self.sources.line_column(tokens.span(at)).0)
    }

    /// A declared name or a reserved word within a letter or two of this one that could stand here.
    fn similar_name(&self, name: &str, wanted: &str) -> Option<String> {
        let words = Word::all().filter(|&word| fits(word, wanted));
        let mut known: Vec<&str> = words.map(Word::spelling).collect();
        let declared = self.scopes.defined();
        known.extend(declared.map(|symbol| self.names.spelling(symbol)));
        nearest(name, known).map(str::to_owned)
    }

    /// The directive whose spelling is nearest.
    pub(crate) fn similar_directive(wanted: &str) -> Option<&'static str> {
        let words = Word::all().filter(|word| word.class() == Class::Directive);
        nearest(wanted, words.map(Word::spelling))
    }
}

//! Hints for tokens that do not belong where they stand.

use crate::base::args::Word;
use crate::base::nearest::nearest;
use crate::base::source::{Diagnostic, Span};
use crate::lang::diagnose::other_dialects;
use crate::lang::diagnose::rewrite::Remedy;
use crate::lang::expr::value::Value;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, END_OF_FILE, Kind, Symbol, Token, Tokens};

/// Most include files that are searched for a name.
const INCLUDE_FILES: usize = 200;

impl Reader<'_> {
    /// A hint for the next token, which cannot stand where `wanted` is expected.
    pub(crate) fn remedy(&self, token: Token, wanted: &str) -> Option<Remedy> {
        if let Some(rewritten) = self.rewritten(token, wanted) {
            return Some(rewritten);
        }
        let hint = match token.kind {
            Kind::Name => self.remedy_of_name(Symbol(token.value), wanted),
            Kind::Mark => self.remedy_of_mark(char::from_u32(token.value)?, wanted),
            Kind::Word => self
                .remedy_after_directive(token.word()?)
                .or_else(|| remedy_of_word(token.word()?, wanted))
                .or_else(|| self.remedy_of_no_value(wanted)),
            Kind::Number if wanted == "a string" => Some(NUMBER_FOR_STRING.to_owned()),
            _ => None,
        };
        hint.map(Remedy::from)
    }

    /// A remedy that rewrites the text around the next token.
    fn rewritten(&self, token: Token, wanted: &str) -> Option<Remedy> {
        let is_statement = wanted.contains("statement");
        match token.kind {
            _ if wanted.starts_with("`(` after") => self.argument_without_parentheses(),
            Kind::Mark | Kind::Name | Kind::Word if wanted == "a string" => self.unquoted_string(),
            Kind::Name => (is_statement.then(|| self.assignment()).flatten())
                .or_else(|| self.keyword_in_capitals(Symbol(token.value), wanted)),
            Kind::Mark if is_statement && token.is_mark('{') => self.braces_of_other_languages(),
            Kind::Mark if is_statement && token.is_mark('-') && self.raw_ahead(1).is_mark('-') => {
                self.comment_of_other_languages()
            }
            Kind::Mark if wants_value(wanted) => self.vector_in_brackets(self.here.at),
            Kind::Number | Kind::Word if wanted.contains("`}`") => self
                .axis_and_number()
                .or_else(|| (token.kind == Kind::Number).then(|| self.numbers_in_a_row())?),
            Kind::Mark if token.is_mark(',') && wanted.contains("`}`") => self.numbers_in_a_row(),
            _ => None,
        }
    }

    /// `#else if` for `#elseif`.
    fn remedy_after_directive(&self, word: Word) -> Option<String> {
        let before = self.here.tokens.tokens[self.here.at.checked_sub(1)?];
        let is_else = before.kind == Kind::Directive
            && self.here.tokens.directives[before.value as usize].word == Some(Word::Else);
        (is_else && word == Word::If).then(|| "Write `#elseif`.".to_owned())
    }

    /// A word whose value is missing: `rotate }`.
    fn remedy_of_no_value(&self, wanted: &str) -> Option<String> {
        let before = self.word_back(1)?;
        (wants_value(wanted) && !before.is_value())
            .then(|| format!("Write a value after `{before}`."))
    }

    fn remedy_of_mark(&self, mark: char, wanted: &str) -> Option<String> {
        let before = self.mark_before();
        let text = match mark {
            '=' if before == Some('=') => "One `=` compares two values.",
            '&' if before == Some('&') => "One `&` means \"and\".",
            '|' if before == Some('|') => "One `|` means \"or\".",
            '[' => "Only an array has items in `[` and `]`.",
            '*' if before == Some('*') => "A power is `pow(a, b)`.",
            ')' if before == Some('(') && self.word_back(2) == Some(Word::Rand) => {
                "`rand(stream)` draws a number; `#declare stream = seed(1);` makes the stream."
            }
            '+' if self.is_after_string() => "Strings are joined by `concat(a, b)`.",
            '%' => "The remainder of a division is `mod(a, b)`.",
            '^' => "A power is `pow(a, b)`.",
            '+' | '-' | '*' | '/' if wanted.starts_with("`=` after") => {
                "Write the name again after `=`: `#declare N = N + 1;`."
            }
            '=' if wanted.contains("the start of `#for`") => {
                "Write `#for (I, first, last)`, with commas only."
            }
            ',' if wants_word(wanted) && self.is_between_numbers() => {
                "Write a vector as `<1, 2, 3>`."
            }
            ',' if wants_word(wanted) => {
                "Remove this comma: items in a block are not separated by commas."
            }
            ';' if wants_word(wanted) => {
                "Only declarations of numbers, and some directives, end with `;`; remove it."
            }
            '(' if wants_word(wanted) => {
                "Parameters belong in `{` and `}`, or in no brackets at all."
            }
            '}' => return self.remedy_of_no_value(wanted),
            '=' | ':' if wants_word(wanted) || self.word_back(1).is_some() => {
                "A value follows its word without a sign: `ambient 0.2`."
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

    fn remedy_of_name(&self, symbol: Symbol, wanted: &str) -> Option<String> {
        let name = self.names.spelling(symbol);
        if let Some(value) = self.scopes.get(symbol) {
            return remedy_of_value(name, value, wanted);
        }
        if self.dialect.is_of_3_8(symbol, &self.names) {
            return Some(format!(
                "`{name}` is a word of POV-Ray 3.8: begin the scene with `#version 3.8;`."
            ));
        }
        if other_dialects::is_of_hg_povray(name) {
            return Some(format!(
                "`{name}` is a word of HG-POV, which POV-Ray does not read either."
            ));
        }
        if let Some(line) = self.declared_further_down(symbol) {
            return Some(format!(
                "`{name}` is declared only in line {line}: move that above this."
            ));
        }
        if let Some(known) = self.sources.library_file_that_declares(name, INCLUDE_FILES) {
            let file = known.file;
            let include = format!("`{file}` declares `{name}`: write `#include \"{file}\"` above");
            let is_color =
                Word::from_spelling(&known.kind).is_some_and(|word| word.class() == Class::Color);
            return Some(match is_color && wanted.ends_with("`texture`") {
                true => format!("{include}, and `pigment {{ {name} }}` here, for it is a colour."),
                false => format!("{include}."),
            });
        }
        if wanted.contains("statement") && self.raw_ahead(1).is_mark('(') {
            return Some(match self.similar_name(name, wanted) {
                Some(near) => format!("Did you mean `{near}`?"),
                None => format!("Define the macro `{name}` above, or include the file that does."),
            });
        }
        if self.is_loop_variable() {
            return Some("Write `#for (I, first, last)`.".to_owned());
        }
        let translated = other_dialects::translated(name, wants_value(wanted))
            .or_else(|| other_dialects::translated(name, wanted == "a value"));
        // A capital begins a name of the author's own.
        let is_own = name.starts_with(char::is_uppercase);
        let similar = || {
            let near = self.similar_name(name, wanted)?;
            Some(format!("Did you mean `{near}`?"))
        };
        let hint = match is_own {
            true => similar().or(translated),
            false => translated.or_else(similar),
        };
        if hint.is_some() {
            return hint;
        }
        Some(match wants_word(wanted) && !wanted.contains("statement") {
            true => format!("There is no word `{name}`, and nothing of that name is declared."),
            false => format!("Declare `{name}` above, or include the file that does."),
        })
    }

    /// A keyword with capitals, which is an undeclared name.
    fn keyword_in_capitals(&self, name: Symbol, wanted: &str) -> Option<Remedy> {
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

    /// The syntax of an object, for messages about a missing part.
    pub(crate) fn usage(word: Word) -> Option<&'static str> {
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
            Word::Polynomial => "`polynomial { order, xyz(2, 0, 0): coefficient, ... }`",
            Word::Cubic => "`cubic { <20 coefficients> ... }`",
            Word::Quartic => "`quartic { <35 coefficients> ... }`",
            Word::Lemon => "`lemon { <base>, base radius, <apex>, apex radius, inner radius ... }`",
            Word::Ovus => "`ovus { bottom radius, top radius ... }`",
            Word::Triangle => "`triangle { <corner>, <corner>, <corner> ... }`",
            Word::SmoothTriangle => {
                "`smooth_triangle { <corner>, <normal>, <corner>, <normal>, <corner>, <normal> ... }`"
            }
            Word::Text => "`text { ttf \"cyrvetic.ttf\" \"words\" thickness, <offset> ... }`",
            Word::LightSource => "`light_source { <location>, colour ... }`",
            _ => return None,
        })
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

const NUMBER_FOR_STRING: &str = "A number becomes a string by `str(number, 0, digits)`.";

/// A hint for a value that cannot stand here.
fn remedy_of_value(name: &str, value: &Value, wanted: &str) -> Option<String> {
    let element = match value {
        Value::Element(element) => element.name,
        Value::Object(_) => "object",
        Value::Number(_) if wanted == "a string" => return Some(NUMBER_FOR_STRING.to_owned()),
        _ => return None,
    };
    let is_part = ["texture", "pigment", "finish", "normal", "interior"]
        .iter()
        .any(|part| {
            wanted.ends_with(&format!("`{part}`")) || wanted.contains(&format!("of `{part}`"))
        });
    Some(match element {
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
        _ if wanted.contains("statement") => {
            format!("A {element} belongs in an object: `{element} {{ {name} }}`.")
        }
        _ if wants_word(wanted) => format!("Write `{element} {{ {name} }}`."),
        _ => return None,
    })
}

/// True if a word of a block or a statement is expected.
fn wants_word(wanted: &str) -> bool {
    wanted.contains("`}`") || wanted.contains("statement")
}

/// True if a numeric value is expected.
fn wants_value(wanted: &str) -> bool {
    wanted.starts_with("a number")
}

/// True if a word may stand where `wanted` is expected, as far as its class shows.
fn fits(word: Word, wanted: &str) -> bool {
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

fn remedy_of_word(word: Word, wanted: &str) -> Option<String> {
    let is_in = |block: &str| wanted.ends_with(block);
    if word.class() == Class::Directive && (wants_word(wanted) || wants_value(wanted)) {
        return Some(format!("Directives begin with `#`: `#{word}`."));
    }
    if let Some(translated) = other_dialects::translated(word.spelling(), false) {
        return Some(translated);
    }
    let in_pigment = wanted.contains("in `pigment`");
    if wanted.ends_with("comes first, and once") {
        return Some("Remove one of the two, or blend them in a `pigment_map`.".to_owned());
    }
    if let Some(block) = block_of(word)
        && (wanted.starts_with("a modifier") || in_pigment)
        && !wanted.contains(&format!("`{block}`"))
    {
        return Some(match in_pigment {
            true => format!(
                "`{word}` belongs in `{block} {{ }}`, beside this block: close it with `}}` first."
            ),
            false => format!("`{word}` belongs in `{block} {{ }}`."),
        });
    }
    if word.class() == Class::Color && is_in("`texture`") {
        return Some("A colour belongs in `pigment { }`.".to_owned());
    }
    let is_part = matches!(
        word,
        Word::Texture | Word::Pigment | Word::Normal | Word::Finish | Word::Interior
    );
    if is_part && (in_pigment || is_in("`finish` or `}`")) {
        return Some(format!(
            "`{word}` belongs beside this block, not in it: close it with `}}` first."
        ));
    }
    None
}

/// The block of a texture that a word belongs in.
fn block_of(word: Word) -> Option<&'static str> {
    use Word::{
        Ambient, Brilliance, Bumps, Crand, Dents, Diffuse, Emission, Irid, Metallic, Phong,
        PhongSize, Reflection, Ripples, Roughness, Specular, Waves, Wrinkles,
    };
    match word {
        Ambient | Brilliance | Crand | Diffuse | Emission | Irid | Metallic | Phong | PhongSize
        | Reflection | Roughness | Specular => Some("finish"),
        Bumps | Dents | Ripples | Waves | Wrinkles => Some("normal"),
        _ if word.class() == Class::Pattern => Some("pigment"),
        _ => None,
    }
}

//! `#declare`, `#local`, `#undef`, `#include`, `#version`, and the values that identifiers are given.

use super::cursor::{Declaring, Entered, Frame, Place, Start, is_bare_directive};
use super::function::{FUNCTION, is_callable};
use super::limits;
use super::reader::Reader;
use super::replay::Level;
use super::value::{Element, Number, Value};
use crate::args::{Args, Parse, Word, transform_step};
use crate::atmosphere::{Fog, Rainbow, SkySphere};
use crate::camera::Camera;
use crate::color::Color;
use crate::interior::{Density, Interior, Media};
use crate::pattern::{Keys, Map};
use crate::source::{Code, Diagnostic};
use crate::syntax::{Class, Kind, Symbol, Token};
use crate::texture::{Finish, Material, Normal, Pigment, Texture};
use std::rc::Rc;

/// What `deprecated` says of a name.
#[derive(Debug)]
pub(super) struct Deprecation {
    is_once: bool,
    message: Option<String>,
}

/// What a name holds, as far as it matters to what it may hold next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kept {
    Function,
    Macro,
    Poison,
    Other,
}

impl Kept {
    fn of(value: &Value) -> Self {
        match value {
            Value::Macro(_) => Kept::Macro,
            Value::Element(element) if element.name == FUNCTION => Kept::Function,
            Value::Poison(_) => Kept::Poison,
            _ => Kept::Other,
        }
    }

    /// Functions and macros stay what they are, and nothing else becomes a function.
    fn keeps_out(self, next: Kept) -> bool {
        self != Kept::Poison
            && next != Kept::Poison
            && (self != Kept::Other || next == Kept::Function)
    }
}

impl Reader<'_> {
    /// `#declare Name = value` and `#local Name = value`, and the same for an item of an array.
    pub(super) fn run_declare(&mut self, is_local: bool) -> Parse<()> {
        let deprecation = self.deprecation()?;
        let symbol = self.identifier("a name to declare")?;
        let name = self.start_taken();
        match deprecation {
            Some(deprecation) => {
                self.deprecated.insert(symbol, deprecation);
            }
            None if !self.deprecated.is_empty() => {
                self.deprecated.remove(&symbol);
            }
            None => {}
        }
        if matches!(self.scopes.get(symbol), Some(Value::Array(_))) && self.is_raw_mark('[') {
            return self.declare_item(symbol, is_local);
        }
        if !self.take_mark('=')? {
            let spelling = self.names.spelling(symbol).to_owned();
            let mut error = self.expected_here(&format!("`=` after `#declare {spelling}`"));
            if !error.message.is_empty() && error.hints.is_empty() {
                *error = error.with_hint(format!("Write `#declare {spelling} = ...`."));
            }
            return Err(error);
        }
        let outer = self.declaring.take();
        let mut place = self.declaring_here(symbol, is_local);
        let known = if is_local {
            self.scopes.bound_at(symbol, place.scope)
        } else {
            self.scopes.get(symbol)
        };
        let known = known.map(Kept::of);
        let mut start = name;
        self.without_semicolon = None;
        let value = self.replayed(Level::Value, |reader| {
            // Directives before the value run before it and may enter a file or a macro where it is then read:
            // `#declare N = #declare A = 1; N + A;`.
            reader.peek()?;
            place = Declaring {
                scope: place.scope,
                ..reader.declaring_here(symbol, is_local)
            };
            start = reader.start_here();
            reader.declaring = Some(place);
            reader.read_value("a value")
        });
        self.declaring = outer;
        match value {
            Ok(Some(value)) => {
                // The name has its value before the `;` is looked for: a directive may stand there and use it.
                let is_number = matches!(value, Value::Number(_));
                if let Some(known) = known
                    && known.keeps_out(Kept::of(&value))
                {
                    let error = self.name_is_taken(symbol, name);
                    self.record(*error);
                }
                self.assign(&place, value);
                let outer = self.declaring.replace(Declaring {
                    is_complete: true,
                    ..place
                });
                let end = self.end_of_declaration(is_number);
                self.declaring = outer;
                end
            }
            Ok(None) => {
                self.assign(&place, Value::Poison(None));
                let spelling = self.names.spelling(symbol).to_owned();
                let error = self.expected_here(&format!("a value for `{spelling}`"));
                let name = self.span_of(name);
                Err(Box::new(error.with_label(name, "declared here")))
            }
            Err(error) if error.code == Some(Code::NotBuilt) => {
                // A directive may stand behind the value and use the name.
                self.assign(&place, Value::Poison(Some(Rc::new(*error))));
                self.has_faulty_directive = false;
                self.skip_value(place, start)
            }
            Err(error) => {
                self.assign(&place, Value::Poison(None));
                Err(error)
            }
        }
    }

    /// The error for a name that holds a function or a macro, or shall hold one and is something else.
    pub(super) fn name_is_taken(&self, symbol: Symbol, name: Start) -> Box<Diagnostic> {
        let spelling = self.names.spelling(symbol);
        let known = self.scopes.get(symbol);
        let known = known.map_or("in use".to_owned(), Value::kind);
        let error = Diagnostic::error(
            self.span_of(name),
            format!("`{spelling}` is {known} already"),
        );
        self.with_trace(error.with_hint(format!(
            "Write `#undef {spelling}` above, or take another name."
        )))
    }

    /// Goes behind the value that is being declared, in which something is not built yet.
    fn skip_value(&mut self, place: Declaring, start: Start) -> Parse<()> {
        let is_expression = match self.raw().kind {
            Kind::Name | Kind::Word if self.start_here() == start => {
                let next = self.raw_ahead(1);
                ['(', '[', '.', '+', '-', '*', '/']
                    .into_iter()
                    .any(|mark| next.is_mark(mark))
            }
            Kind::Word => false,
            _ => true,
        };
        if is_expression && self.blocks.len() <= place.blocks {
            while !self.peek()?.is_mark(';') && self.raw().kind != Kind::End {
                self.pass();
            }
        } else {
            self.skip_blocks(place.blocks)?;
        }
        self.depth = place.depth;
        if self.raw().is_mark(';') {
            self.pass();
        }
        Ok(())
    }

    /// Goes behind a value or an object in which something is not built yet, to where so many blocks were open. Nothing
    /// is wrong with it: directives in it run.
    pub(super) fn skip_blocks(&mut self, outside: usize) -> Parse<()> {
        let mut open = self.blocks.len().saturating_sub(outside);
        loop {
            let token = self.peek()?;
            if token.kind == Kind::End {
                break;
            }
            if token.is_mark('}') && open == 0 {
                break;
            }
            self.pass();
            if token.is_mark('{') {
                open += 1;
            } else if token.is_mark('}') {
                open -= 1;
            }
            // The word that is not built may stand before its block, and further layers of a texture behind it.
            let next = self.raw();
            if open == 0 && !next.is_mark('{') && next.word() != Some(Word::Texture) {
                break;
            }
        }
        self.blocks.truncate(outside);
        Ok(())
    }

    /// `deprecated [once] ["message"]` before a name that is declared.
    fn deprecation(&mut self) -> Parse<Option<Deprecation>> {
        if self.raw().word() != Some(Word::Deprecated) {
            return Ok(None);
        }
        self.pass();
        let is_once = self.raw().word() == Some(Word::Once);
        if is_once {
            self.pass();
        }
        let message = if self.raw().kind == Kind::String {
            Some(self.string()?)
        } else {
            None
        };
        Ok(Some(Deprecation { is_once, message }))
    }

    /// Warns where a deprecated name is used, or only where it is used first.
    pub(super) fn warn_of_deprecated(&mut self, symbol: Symbol) {
        let Some(deprecation) = self.deprecated.get(&symbol) else {
            return;
        };
        let name = self.names.spelling(symbol);
        let message = match &deprecation.message {
            Some(message) => message.trim_end().to_owned(),
            None => format!("`{name}` was declared deprecated"),
        };
        if deprecation.is_once {
            self.deprecated.remove(&symbol);
        }
        self.warning(Diagnostic::warning(self.here_span(), message));
    }

    /// A declaration whose value begins here.
    pub(super) fn declaring_here(&self, symbol: Symbol, is_local: bool) -> Declaring {
        Declaring {
            symbol,
            is_local,
            scope: self.scopes.depth(),
            is_item: false,
            frames: self.frames.len(),
            depth: self.depth,
            blocks: self.blocks.len(),
            is_complete: false,
        }
    }

    /// Looks at what follows a value that may be complete. A directive or a macro call there may use the name that is
    /// being declared, so it gets what it has until now.
    pub(super) fn peek_behind(&mut self, value: impl FnOnce() -> Value) -> Parse<Token> {
        let place = (self.depth, self.blocks.len());
        let open = self
            .declaring
            .filter(|open| (open.depth, open.blocks) == place);
        if let Some(open) = open {
            let next = self.raw();
            let is_run = match next.kind {
                Kind::Directive => true,
                Kind::Name => self.scopes.is_macro(Symbol(next.value)),
                Kind::Word => is_bare_directive(next),
                _ => false,
            };
            if is_run && !open.is_item {
                self.assign(&open, value());
            }
            self.declaring = Some(Declaring {
                is_complete: true,
                ..open
            });
        }
        let token = self.peek();
        if open.is_some() {
            self.declaring = open;
        }
        token
    }

    /// Gives a name its value. A macro may have been entered since the name was read, and may end behind the value.
    fn assign(&mut self, to: &Declaring, value: Value) {
        if to.scope < self.scopes.depth() {
            self.scopes
                .assign_from(to.scope, to.symbol, value, to.is_local);
        } else if to.is_local {
            self.scopes.local(to.symbol, value);
        } else {
            self.scopes.declare(to.symbol, value);
        }
    }

    pub(super) fn is_raw_mark(&self, mark: char) -> bool {
        let token = self.raw();
        token.kind == Kind::Mark && token.value == mark as u32
    }

    /// Whether no macro or file has been entered, and nothing left, since so many frames were open.
    pub(super) fn is_within(&self, frames: usize) -> bool {
        let is_macro_or_file =
            |frame: &Frame| matches!(frame.kind, Entered::Macro { .. } | Entered::Include { .. });
        self.frames
            .get(frames..)
            .is_some_and(|entered| !entered.iter().any(is_macro_or_file))
    }

    /// Behind a part of a number that is being declared: if a directive follows, a `;` is probably missing. The directive
    /// runs before the name has its value, and must not find the name undeclared.
    pub(super) fn look_for_semicolon(&mut self) {
        if self.raw().kind != Kind::Directive || self.version < 3.5 {
            return;
        }
        let place = (self.depth, self.blocks.len());
        let Some(open) = self
            .declaring
            .filter(|open| (open.depth, open.blocks) == place)
        else {
            return;
        };
        if self.is_end_of_macro() && self.scopes.depth() > open.scope {
            return;
        }
        self.without_semicolon = Some((self.taken_span(), self.here.clone(), self.frames.len()));
        if !open.is_item && self.scopes.get(open.symbol).is_none() {
            self.assign(&open, Value::Poison(None));
        }
    }

    /// Numbers must end with `;` from version 3.5 on; elsewhere it is optional.
    pub(super) fn end_of_declaration(&mut self, is_number: bool) -> Parse<()> {
        if self.take_mark(';')? {
            while self.is_raw_mark(';') {
                self.pass();
            }
            if let Some((last, ..)) = self.without_semicolon.take() {
                self.miss_semicolon(last);
            }
            return Ok(());
        }
        if !is_number {
            self.without_semicolon = None;
            return Ok(());
        }
        let next = self.raw();
        let is_operator = |mark| next.is_mark(mark);
        if self.version >= 3.5
            && self.without_semicolon.is_none()
            && ['%', '^', '=', '&', '|'].into_iter().any(is_operator)
        {
            return Err(self.expected_here("an operator or `;` behind the value"));
        }
        let last = match self.without_semicolon.take() {
            Some((last, place, frames)) => {
                // The directive has run without the value; from here on it is there.
                if self.is_within(frames) {
                    self.frames.truncate(frames);
                    self.here = place;
                }
                last
            }
            None => self.taken_span(),
        };
        self.miss_semicolon(last);
        Ok(())
    }

    /// Tells that a `;` is missing behind the number that ends there.
    fn miss_semicolon(&mut self, last: crate::source::Span) {
        let behind = crate::source::Span::new(last.file, last.end.saturating_sub(1), last.end);
        let message = "a declared number, vector or colour must end with `;`";
        if self.version >= 3.5 {
            let error = Diagnostic::error(behind, message).with_hint("Write `;` behind this.");
            self.record(*self.with_trace(error));
        } else {
            self.warning(Diagnostic::warning(behind, message));
        }
    }

    pub(super) fn run_undef(&mut self) -> Parse<()> {
        let symbol = self.identifier("a name after `#undef`")?;
        if matches!(self.scopes.get(symbol), Some(Value::Array(_))) && self.is_raw_mark('[') {
            let path = self.item_path(symbol)?;
            let array = self.scopes.get_mut(symbol);
            if let Some(item) = array.and_then(|array| array.item_mut(&path)) {
                *item = None;
            }
            return Ok(());
        }
        if let Some(&Value::File(handle)) = self.scopes.get(symbol) {
            self.scopes.undefine(symbol);
            return self.close_file(handle, self.taken_span());
        }
        if !self.scopes.undefine(symbol) {
            let name = self.names.spelling(symbol).to_owned();
            self.warning(Diagnostic::warning(
                self.taken_span(),
                format!("`{name}` is not declared; nothing to undo"),
            ));
        }
        Ok(())
    }

    /// The bracketed name of `#ifdef`, perhaps an item of an array.
    pub(super) fn is_defined(&mut self) -> Parse<bool> {
        self.expect_mark('(', "`(` after `#ifdef`")?;
        // A reserved word is no identifier.
        let is_word = self.raw().kind == Kind::Word;
        if is_word {
            self.pass();
        }
        let is_defined = !is_word && self.names_a_value()?;
        self.expect_mark(')', "`)` after the name")?;
        Ok(is_defined)
    }

    /// Whether the identifier at hand, with its indices, has a value.
    pub(super) fn names_a_value(&mut self) -> Parse<bool> {
        let symbol = self.identifier("a name")?;
        let is_array = matches!(self.scopes.get(symbol), Some(Value::Array(_)));
        let path = if is_array && self.is_raw_mark('[') {
            self.item_path(symbol)?
        } else {
            Vec::new()
        };
        let held = self.scopes.get(symbol);
        Ok(held.is_some_and(|value| value.item(&path).is_some()))
    }

    pub(super) fn run_include(&mut self) -> Parse<()> {
        let name = self.file_name()?;
        let from = self.taken_span();
        self.publish_files(from)?;
        let depth = self
            .frames
            .iter()
            .filter(|frame| matches!(frame.kind, Entered::Include { .. }))
            .count();
        if depth >= limits::INCLUDES {
            return Err(self.with_trace(
                Diagnostic::error(
                    from,
                    format!(
                        "files include each other more than {} deep",
                        limits::INCLUDES
                    ),
                )
                .with_hint("A file that includes itself needs an `#ifndef` around the `#include`."),
            ));
        }
        let file = match self.sources.find_include(&name, from.file) {
            Ok(file) => file,
            Err(mut error) => {
                self.lacks_file = true;
                error.span = Some(from);
                error.code = Some(Code::MissingFile);
                self.suggest_include(&mut error, &name);
                return Err(self.with_trace(*error));
            }
        };
        self.enter_file(file, from)
    }

    /// Enters the file that the command line asks to include before the scene.
    pub(super) fn enter_header(&mut self) {
        let Some(header) = &self.options.include_header else {
            return;
        };
        let from = self.here_span();
        let entered = self
            .sources
            .load_file(header)
            .and_then(|file| self.enter_file(file, from));
        if let Err(error) = entered {
            self.record(*error);
        }
    }

    fn enter_file(&mut self, file: crate::source::FileId, from: crate::source::Span) -> Parse<()> {
        let tokens = self.tokens_of(file)?;
        let kind = Entered::Include {
            back: self.here.clone(),
            from,
        };
        self.enter_frame(Rc::clone(&tokens), u32::MAX, kind);
        self.scopes.enter();
        self.here = Place { tokens, at: 0 };
        Ok(())
    }

    pub(super) fn run_version(&mut self) -> Parse<()> {
        let version = self.float()?;
        self.take_mark(';')?;
        if version > 3.7 + super::flow::EQUAL {
            return Err(self.with_trace(
                Diagnostic::error(
                    self.taken_span(),
                    format!("this scene asks for version {version}; povr draws as POV-Ray 3.7"),
                )
                .with_hint("Write `#version 3.7;` if the scene uses nothing newer."),
            ));
        }
        self.version = version;
        self.has_version = true;
        Ok(())
    }

    /// `#debug`, `#warning`, `#error`, `#render`, `#statistics` and their string.
    pub(super) fn run_message(&mut self, word: Word, span: crate::source::Span) -> Parse<()> {
        let text = self.string()?;
        match word {
            Word::Error => {
                // What follows was written for a scene that is right so far.
                self.is_over = true;
                let text = match text.trim_end() {
                    "" => "the scene stops itself here",
                    text => text,
                };
                Err(self.with_trace(Diagnostic::error(span, text).with_code(Code::Author)))
            }
            Word::Warning => {
                let warning = Diagnostic::warning(span, text.trim_end().to_owned());
                self.warning(warning.with_code(Code::Author));
                Ok(())
            }
            _ => {
                if self.say(&text) <= limits::MESSAGES {
                    return Ok(());
                }
                self.is_over = true;
                Err(self.with_trace(Diagnostic::error(
                    span,
                    format!(
                        "a scene writes at most {} bytes of messages",
                        limits::MESSAGES
                    ),
                )))
            }
        }
    }

    /// A value of any kind, if one begins at hand: what may stand behind `#declare X =`.
    pub(super) fn value(&mut self, what: &str) -> Parse<Option<Value>> {
        self.replayed(Level::Value, |reader| reader.read_value(what))
    }

    fn read_value(&mut self, what: &str) -> Parse<Option<Value>> {
        let token = self.peek()?;
        if !self.begins_number()? {
            self.spoil();
        }
        match token.kind {
            Kind::Number => Ok(Some(Value::Number(self.sum()?))),
            Kind::String => Ok(Some(Value::Text(self.string()?.into()))),
            Kind::Mark if "<(-+!".contains(char::from_u32(token.value).unwrap_or(' ')) => {
                Ok(Some(Value::Number(self.sum()?)))
            }
            Kind::Name => self.value_of_name(Symbol(token.value), what),
            Kind::Word => token
                .word()
                .map_or(Ok(None), |word| self.value_of_word(word)),
            _ => Ok(None),
        }
    }

    fn value_of_name(&mut self, symbol: Symbol, what: &str) -> Parse<Option<Value>> {
        match self.scopes.get(symbol) {
            None => Err(self.expected_here(what)),
            Some(Value::Number(_)) => self.number_or_color().map(Some),
            Some(Value::Array(_)) => {
                if self.raw_ahead(1).is_mark('[') && self.begins_number()? {
                    return self.number_or_color().map(Some);
                }
                self.spoil();
                let before = self.here.clone();
                let item = self.array_or_item()?;
                let is_called = is_callable(&item) && self.is_raw_mark('(');
                match item {
                    _ if is_called || matches!(item, Value::Number(_)) => {
                        // An item that is a number may begin an expression: read it again as one.
                        self.here = before;
                        self.number_or_color().map(Some)
                    }
                    other => Ok(Some(other)),
                }
            }
            Some(Value::Poison(why)) => Err(self.consequence_of(why.as_deref())),
            Some(Value::File(_)) => Err(self.expected_here(what)),
            Some(_) if self.at_call() => self.number_or_color().map(Some),
            Some(Value::Element(element)) if element.name == "texture" => Ok(Some(Value::Element(
                Element::new("texture", self.texture_layers()?),
            ))),
            Some(other) => {
                let value = other.clone();
                self.pass();
                Ok(Some(value))
            }
        }
    }

    fn value_of_word(&mut self, word: Word) -> Parse<Option<Value>> {
        let element =
            |name: &'static str| move |value: Element| Value::Element(Element { name, ..value });
        match word {
            Word::Texture => {
                let texture = self.texture_layers()?;
                Ok(Some(Value::Element(Element::new("texture", texture))))
            }
            Word::Pigment => {
                self.pass();
                let default = self.default_layer.pigment.clone();
                let pigment = Pigment::read(self, &default)?;
                Ok(Some(Value::Element(Element::new("pigment", pigment))))
            }
            Word::ColorMap | Word::ColourMap => {
                self.pass();
                let map = Map::read_colors(self)?;
                Ok(Some(Value::Element(Element::new("color_map", map))))
            }
            Word::PigmentMap => {
                self.pass();
                let map = Pigment::read_map(Keys::Positions, self)?;
                Ok(Some(Value::Element(Element::new("pigment_map", map))))
            }
            Word::Normal => {
                self.pass();
                let default = self.default_layer.normal.clone();
                let normal = Normal::read(self, default.as_ref())?;
                Ok(Some(Value::Element(Element::new("normal", normal))))
            }
            Word::NormalMap => {
                self.pass();
                let map = Normal::read_map(Keys::Positions, self)?;
                Ok(Some(Value::Element(Element::new("normal_map", map))))
            }
            Word::SlopeMap => {
                self.pass();
                let map = Normal::read_slopes(self)?;
                Ok(Some(Value::Element(Element::new("slope_map", map))))
            }
            Word::TextureMap => {
                self.pass();
                let default = self.default_layer.clone();
                let map = Texture::read_map(Keys::Positions, self, &default)?;
                Ok(Some(Value::Element(Element::new("texture_map", map))))
            }
            Word::DensityMap => {
                self.pass();
                let map = Density::read_map(Keys::Positions, self)?;
                Ok(Some(Value::Element(Element::new("density_map", map))))
            }
            Word::Finish => {
                self.pass();
                let default = self.default_layer.finish.clone();
                let finish = Finish::read(self, &default)?;
                Ok(Some(Value::Element(Element::new("finish", finish))))
            }
            Word::Interior => {
                self.pass();
                let interior = Interior::read(self)?;
                Ok(Some(element("interior")(Element::new(
                    "interior", interior,
                ))))
            }
            Word::Material => {
                self.pass();
                let default = self.default_layer.clone();
                let material = Material::read(self, &default)?;
                Ok(Some(Value::Element(Element::new("material", material))))
            }
            Word::Fog => {
                self.pass();
                let fog = Fog::read(self)?;
                Ok(Some(Value::Element(Element::new("fog", fog))))
            }
            Word::Rainbow => {
                self.pass();
                let rainbow = Rainbow::read(self)?;
                Ok(Some(Value::Element(Element::new("rainbow", rainbow))))
            }
            Word::Media => {
                self.pass();
                let media = Media::read(self)?;
                Ok(Some(Value::Element(Element::new("media", media))))
            }
            Word::Density => {
                self.pass();
                let density = Density::read(self)?;
                Ok(Some(Value::Element(Element::new("density", density))))
            }
            Word::SkySphere => {
                self.pass();
                let sky = SkySphere::read(self)?;
                Ok(Some(Value::Element(Element::new("sky_sphere", sky))))
            }
            Word::Camera => {
                self.pass();
                let camera = Camera::read(self, &Camera::default())?;
                Ok(Some(Value::Element(Element::new("camera", camera))))
            }
            Word::Transform | Word::Translate | Word::Rotate | Word::Scale | Word::Matrix => {
                let step = transform_step(self)?;
                Ok(step.map(|step| Value::Element(Element::new("transform", step.transform()))))
            }
            Word::Array => self.array_value().map(Some),
            Word::Function => self.function_value().map(Some),
            Word::Spline => self.spline_value().map(Some),
            Word::LightSource => Ok(self.object()?.map(Value::Object)),
            _ if self.begins_string(word) => Ok(Some(Value::Text(self.string()?.into()))),
            _ => match word.class() {
                Class::Shape | Class::Csg => Ok(self.object()?.map(Value::Object)),
                Class::Color | Class::Value | Class::Function => self.number_or_color().map(Some),
                _ if self.begins_expression(word) => self.number_or_color().map(Some),
                _ => Ok(None),
            },
        }
    }

    /// An expression at the additive level, or a colour in words.
    fn number_or_color(&mut self) -> Parse<Value> {
        let token = self.peek()?;
        let is_color_word = token
            .word()
            .is_some_and(|word| word.class() == Class::Color);
        let number = if is_color_word {
            color_number(self.color_value()?)
        } else {
            self.sum()?
        };
        Ok(Value::Number(number))
    }

    /// All layers of `texture { } texture { }`, or the texture of an identifier and further layers.
    pub(super) fn texture_layers(&mut self) -> Parse<Texture> {
        let mut sum: Option<Texture> = None;
        loop {
            let next = if self.take_word(Word::Texture)? {
                let default = self.default_layer.clone();
                Texture::read(self, &default)?
            } else if let Some(known) = crate::args::declared::<Texture>(self)? {
                (*known).clone()
            } else {
                break;
            };
            match &mut sum {
                None => sum = Some(next),
                Some(sum) => {
                    self.check_layers(sum, &next)?;
                    sum.lay_over(next, self.version);
                }
            }
            if let Some(sum) = &sum {
                self.peek_behind(|| Value::Element(Element::new("texture", sum.clone())))?;
            }
        }
        sum.ok_or_else(|| self.expected_here("`texture`"))
    }

    /// Textures that are chosen by a pattern have no layers, and textures that hold themselves twice double theirs.
    pub(super) fn check_layers(&self, lower: &Texture, upper: &Texture) -> Parse<()> {
        if lower.is_patterned() || upper.is_patterned() {
            return Err(self.error_taken("a texture that a pattern chooses is no layer of another"));
        }
        if lower.layers().len() + upper.layers().len() <= limits::LAYERS {
            return Ok(());
        }
        Err(self.error_taken(format!("a texture has at most {} layers", limits::LAYERS)))
    }
}

/// A colour as the five numbers it is in expressions.
pub(super) fn color_number(color: Color) -> Number {
    let Color {
        rgb,
        filter,
        transmit,
    } = color;
    Number {
        v: [rgb.r, rgb.g, rgb.b, filter, transmit].map(f64::from),
        len: 5,
    }
}

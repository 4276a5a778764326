//! `#declare`, `#local`, `#undef`, `#include`, `#version`, and the values that identifiers are given.

use super::cursor::{Entered, Frame, Place};
use super::limits;
use super::reader::Reader;
use super::value::{Array, Element, Number, Value};
use crate::args::{Parse, Word, transform_step};
use crate::camera::Camera;
use crate::color::Color;
use crate::interior::Interior;
use crate::source::Diagnostic;
use crate::syntax::{Class, Kind, Symbol};
use crate::texture::{Finish, Material, Pigment, Texture};
use std::rc::Rc;

impl Reader<'_> {
    /// `#declare Name = value` and `#local Name = value`, and the same for an item of an array.
    pub(super) fn run_declare(&mut self, is_local: bool) -> Parse<()> {
        if self.raw().kind == Kind::Word && self.raw().value == Word::Deprecated as u32 {
            self.pass();
            self.take_word(Word::Once)?;
            self.string()?;
        }
        let symbol = self.identifier("a name to declare")?;
        let name_span = self.taken_span();
        if matches!(self.scopes.get(symbol), Some(Value::Array(_))) && self.is_raw_mark('[') {
            return self.declare_item(symbol);
        }
        if !self.take_mark('=')? {
            let spelling = self.names.spelling(symbol).to_owned();
            return Err(self.expected_here(&format!("`=` after `#declare {spelling}`")));
        }
        let place = (self.frames.len(), self.depth, self.blocks.len());
        let outer = self.declaring.replace(place);
        let value = self.value("a value");
        self.declaring = outer;
        match value {
            Ok(Some(value)) => {
                // The name has its value before the `;` is looked for: a directive may stand there and use it.
                let is_number = matches!(value, Value::Number(_));
                self.assign(symbol, value, is_local);
                let outer = self.declaring.replace(place);
                let end = self.end_of_declaration(is_number);
                self.declaring = outer;
                end
            }
            Ok(None) => {
                self.assign(symbol, Value::Poison, is_local);
                let spelling = self.names.spelling(symbol).to_owned();
                let error = self.expected_here(&format!("a value for `{spelling}`"));
                Err(Box::new(error.with_label(name_span, "declared here")))
            }
            Err(error) => {
                self.assign(symbol, Value::Poison, is_local);
                Err(error)
            }
        }
    }

    fn assign(&mut self, symbol: Symbol, value: Value, is_local: bool) {
        if is_local {
            self.scopes.local(symbol, value);
        } else {
            self.scopes.declare(symbol, value);
        }
    }

    fn is_raw_mark(&self, mark: char) -> bool {
        let token = self.raw();
        token.kind == Kind::Mark && token.value == mark as u32
    }

    /// Numbers must end with `;` from version 3.5 on; elsewhere it is optional.
    fn end_of_declaration(&mut self, is_number: bool) -> Parse<()> {
        if self.take_mark(';')? || !is_number {
            return Ok(());
        }
        let behind = self.taken_span();
        let message = "a declared number, vector or colour must end with `;`";
        if self.version >= 3.5 {
            Err(self.with_trace(
                Diagnostic::error(behind, message).with_hint("Put `;` behind the value."),
            ))
        } else {
            self.warning(Diagnostic::warning(behind, message));
            Ok(())
        }
    }

    fn declare_item(&mut self, symbol: Symbol) -> Parse<()> {
        let Some(Value::Array(array)) = self.scopes.get(symbol) else {
            return Ok(());
        };
        let sizes = array.sizes.clone();
        let at = self.array_index(&sizes)?;
        if !self.take_mark('=')? {
            return Err(self.expected_here("`=` after the item of an array"));
        }
        let Some(value) = self.value("a value")? else {
            return Err(self.expected_here("a value"));
        };
        self.end_of_declaration(matches!(value, Value::Number(_)))?;
        if let Some(Value::Array(array)) = self.scopes.get_mut(symbol) {
            Rc::make_mut(array).items[at] = Some(value);
        }
        Ok(())
    }

    /// `[i][j]...` as an index into the row-major items of an array with these sizes.
    pub(super) fn array_index(&mut self, sizes: &[usize]) -> Parse<usize> {
        let mut at = 0;
        for &size in sizes {
            self.expect_mark('[', "`[` and an index of the array")?;
            let index = self.number_at_sum()?;
            let span = self.taken_span();
            self.expect_mark(']', "`]` after the index")?;
            at = at * size + self.checked_index(index, size, span)?;
        }
        Ok(at)
    }

    fn checked_index(&self, index: f64, size: usize, span: crate::source::Span) -> Parse<usize> {
        let whole = (index + super::flow::EQUAL).trunc();
        if whole < 0.0 || !whole.is_finite() || whole >= size as f64 {
            return Err(self.with_trace(
                Diagnostic::error(
                    span,
                    format!(
                        "the index {whole} is outside of the array, which has {size} items here"
                    ),
                )
                .with_hint(format!("Indices run from 0 to {}.", size.saturating_sub(1))),
            ));
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 <= whole < size"
        )]
        Ok(whole as usize)
    }

    pub(super) fn run_undef(&mut self) -> Parse<()> {
        let symbol = self.identifier("a name after `#undef`")?;
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
        let is_defined = self.names_a_value()?;
        self.expect_mark(')', "`)` after the name")?;
        Ok(is_defined)
    }

    /// Whether the identifier at hand, with its indices, has a value.
    pub(super) fn names_a_value(&mut self) -> Parse<bool> {
        let symbol = self.identifier("a name")?;
        if let Some(Value::Array(array)) = self.scopes.get(symbol) {
            let array = Rc::clone(array);
            if self.is_raw_mark('[') {
                let at = self.array_index(&array.sizes)?;
                return Ok(array.items[at].is_some());
            }
        }
        Ok(self.scopes.get(symbol).is_some())
    }

    pub(super) fn run_include(&mut self) -> Parse<()> {
        let token = self.peek()?;
        let name = if token.kind == Kind::String {
            self.pass();
            self.last_tokens.string_raw(token.value).into_owned()
        } else {
            self.string()?
        };
        let from = self.taken_span();
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
                error.span = Some(from);
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
        self.frames.push(Frame {
            home: Rc::clone(&tokens),
            end: u32::MAX,
            kind,
        });
        self.scopes.enter();
        self.here = Place { tokens, at: 0 };
        Ok(())
    }

    pub(super) fn run_version(&mut self) -> Parse<()> {
        let version = self.number_at_sum()?;
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
                Err(self.with_trace(Diagnostic::error(span, text.trim_end().to_owned())))
            }
            Word::Warning => {
                self.warning(Diagnostic::warning(span, text.trim_end().to_owned()));
                Ok(())
            }
            _ => {
                self.messages.push_str(&text);
                Ok(())
            }
        }
    }

    /// A value of any kind, if one begins at hand: what may stand behind `#declare X =`.
    pub(super) fn value(&mut self, what: &str) -> Parse<Option<Value>> {
        let token = self.peek()?;
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
                let before = self.here.clone();
                match self.array_or_item()? {
                    Value::Number(_) => {
                        // An item that is a number may begin an expression: read it again as one.
                        self.here = before;
                        self.number_or_color().map(Some)
                    }
                    other => Ok(Some(other)),
                }
            }
            Some(Value::Poison) => Err(self.consequence()),
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
            Word::LightSource => self.light_value().map(Some),
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
                Some(sum) => sum.lay_over(next, self.version),
            }
        }
        sum.ok_or_else(|| self.expected_here("`texture`"))
    }

    /// `array[n][m] { ... }`.
    fn array_value(&mut self) -> Parse<Value> {
        self.pass();
        let mut sizes = Vec::new();
        while self.take_mark('[')? {
            let size = self.number_at_sum()?;
            let span = self.taken_span();
            self.expect_mark(']', "`]` after the size of the array")?;
            let whole = (size + super::flow::EQUAL).trunc();
            if !(1.0..=limits::ARRAY_ITEMS as f64).contains(&whole) {
                return Err(self.with_trace(Diagnostic::error(
                    span,
                    format!("an array cannot have {size} items"),
                )));
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "checked just above"
            )]
            sizes.push(whole as usize);
        }
        if sizes.is_empty() || sizes.len() > 5 {
            return Err(self.error_taken("an array has one to five dimensions"));
        }
        let total = sizes
            .iter()
            .try_fold(1usize, |product, &size| product.checked_mul(size));
        let Some(total) = total.filter(|&total| total <= limits::ARRAY_ITEMS) else {
            return Err(self.error_taken(format!(
                "an array has at most {} items",
                limits::ARRAY_ITEMS
            )));
        };
        let mut array = Array {
            items: vec![None; total],
            sizes,
        };
        if self.peek()?.kind == Kind::Mark && self.raw().value == '{' as u32 {
            self.array_items(&mut array, 0, 0)?;
        }
        Ok(Value::Array(Rc::new(array)))
    }

    fn array_items(&mut self, array: &mut Array, dimension: usize, from: usize) -> Parse<()> {
        self.open_block()?;
        let inner: usize = array.sizes[dimension + 1..].iter().product();
        let mut index = 0;
        while !self.take_close()? {
            if index == array.sizes[dimension] {
                return Err(self.error_here(format!("the array has only {index} items here")));
            }
            let at = from + index * inner;
            if dimension + 1 < array.sizes.len() {
                self.array_items(array, dimension + 1, at)?;
            } else {
                let Some(value) = self.value("an item of the array")? else {
                    return Err(self.expected_here("an item of the array or `}`"));
                };
                array.items[at] = Some(value);
            }
            self.take_mark(',')?;
            index += 1;
        }
        Ok(())
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

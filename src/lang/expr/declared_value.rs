//! Values of identifiers: everything that may stand after `#declare X =`.

use super::callee::is_callable;
use super::color::is_component;
use super::value::{Element, Number, Value};
use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::color::Color;
use crate::lang::fast_path::replay::cache::Level;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind, Symbol};
use crate::scene::atmosphere::{Fog, Rainbow, SkySphere};
use crate::scene::camera::Camera;
use crate::scene::interior::{Density, Interior, Media};
use crate::scene::pattern::{Keys, Map};
use crate::scene::texture::{Finish, Material, Normal, Pigment, Texture};

impl Reader<'_> {
    /// A value of any kind, if one begins at the next token: anything that may stand after `#declare X =`.
    pub(crate) fn value(&mut self, what: &str) -> Parse<Option<Value>> {
        self.replayed(Level::Value, |reader| reader.read_value(what))
    }

    pub(crate) fn read_value(&mut self, what: &str) -> Parse<Option<Value>> {
        let token = self.peek()?;
        if !self.begins_number()? {
            self.discard_recording();
        }
        match token.kind {
            Kind::Number => Ok(Some(Value::Number(self.sum()?))),
            Kind::String => Ok(Some(Value::Text(self.text()?))),
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
            Some(array @ Value::Array(_)) if array.is_mixed() => {
                match self.mixed_item_ahead(symbol)? {
                    Some(item)
                        if matches!(item, Value::Number(_))
                            || is_callable(&item) && !self.is_item_alone() =>
                    {
                        self.number_or_color().map(Some)
                    }
                    _ => self.array_or_item().map(Some),
                }
            }
            Some(Value::Array(array)) => {
                let is_copied = array.first().is_some_and(is_callable) && self.is_item_alone();
                if self.raw_ahead(1).is_mark('[') && !is_copied && self.begins_number()? {
                    return self.number_or_color().map(Some);
                }
                self.discard_recording();
                let start = self.reading();
                let item = self.array_or_item()?;
                let is_called = is_callable(&item) && self.is_raw_mark('(');
                match item {
                    _ if is_called || matches!(item, Value::Number(_)) => {
                        // A numeric item may begin an expression: read it again as one.
                        self.read_again(item, start);
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

    /// True if the next item of an array stands alone: its indices and keys are followed by neither a call nor an operator,
    /// but by something that may follow a value.
    fn is_item_alone(&self) -> bool {
        let tokens = &self.here.tokens.tokens;
        let mut at = self.here.at + 1;
        let mut open = 0_usize;
        while open > 0 || tokens[at].is_mark('[') || tokens[at].is_mark('.') {
            match tokens[at].kind {
                Kind::DataSegment | Kind::End => return false,
                Kind::Mark if open == 0 && tokens[at].is_mark('.') => {
                    let is_key = matches!(tokens[at + 1].kind, Kind::Name | Kind::Word);
                    at += usize::from(is_key);
                }
                _ if tokens[at].is_mark('[') => open += 1,
                _ if tokens[at].is_mark(']') => open -= 1,
                _ => {}
            }
            at += 1;
        }
        let (_, behind) = self.after_ends(at);
        match behind.kind {
            Kind::Mark => [';', ',', '}', ')']
                .into_iter()
                .any(|mark| behind.is_mark(mark)),
            Kind::Word | Kind::Name | Kind::Number | Kind::String => true,
            _ => false,
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
                let default = self.draft.default_layer.pigment.clone();
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
                let default = self.draft.default_layer.normal.clone();
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
                let default = self.draft.default_layer.clone();
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
                let default = self.draft.default_layer.finish.clone();
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
                let default = self.draft.default_layer.clone();
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
                let base = self.draft.default_camera.clone();
                let camera = Camera::read(self, &base)?;
                Ok(Some(Value::Element(Element::new("camera", camera))))
            }
            Word::Transform | Word::Translate | Word::Rotate | Word::Scale | Word::Matrix => {
                if word != Word::Transform {
                    let reason = format!("`{word}` is no value");
                    let remedy = format!("Write `transform {{ {word} ... }}`.");
                    self.refused_by_povray(self.here_span(), &reason, &remedy);
                }
                let step = transform_step(self)?;
                Ok(step.map(|step| Value::Element(Element::new("transform", step.transform()))))
            }
            Word::T => {
                let reason = "a value may not begin with `t`";
                self.refused_by_povray(self.here_span(), reason, "Write it in parentheses: `(t)`.");
                self.number_or_color().map(Some)
            }
            Word::Dictionary => self.dictionary_value().map(Some),
            Word::Array => self.array_value().map(Some),
            Word::Function => self.function_value().map(Some),
            Word::Spline => self.spline_value().map(Some),
            Word::LightSource => Ok(self.object()?.map(Value::Object)),
            _ if self.begins_string(word) => Ok(Some(Value::Text(self.text()?))),
            _ => match word.class() {
                Class::Shape | Class::Csg => Ok(self.object()?.map(Value::Object)),
                Class::Color | Class::Value | Class::Function => self.number_or_color().map(Some),
                _ if self.begins_expression(word) => self.number_or_color().map(Some),
                _ => Ok(None),
            },
        }
    }

    /// An expression at the additive level, or a colour in words. Before version 3.5 components may follow an expression
    /// that begins with the name of a colour.
    fn number_or_color(&mut self) -> Parse<Value> {
        let may_go_on = self.draft.version < 3.5 && self.is_at_color_name()?;
        let token = self.peek()?;
        let is_color_word = token
            .word()
            .is_some_and(|word| word.class() == Class::Color);
        let mut number = if is_color_word {
            color_number(self.color_value()?)
        } else {
            self.sum()?
        };
        if may_go_on && number.len == 5 && self.peek()?.word().is_some_and(is_component) {
            self.discard_recording();
            let start = self.start()?;
            number.v = self.color_parts(Some(number.v))?;
            self.finite(&number.v, start)?;
        }
        Ok(Value::Number(number))
    }

    /// All layers of `texture { } texture { }`, or the texture of an identifier and further layers.
    pub(crate) fn texture_layers(&mut self) -> Parse<Texture> {
        let mut sum: Option<Texture> = None;
        let level = (self.statement.depth, self.blocks.len());
        let declaring = self.statement.declaring;
        let is_declared = declaring.is_some_and(|open| (open.depth, open.blocks) == level);
        loop {
            let is_behind_directive = self.statement.directive_end == self.taken;
            let at = self.here_span();
            let is_named = self.raw().kind == Kind::Name;
            let next = if self.take_word(Word::Texture)? {
                let default = self.draft.default_layer.clone();
                Texture::read(self, &default)?.as_lowest(self.draft.version)
            } else if let Some(known) = crate::base::args::declared::<Texture>(self)? {
                (*known).clone()
            } else {
                break;
            };
            match &mut sum {
                None => sum = Some(next),
                Some(sum) => {
                    if is_declared && (is_behind_directive || is_named) {
                        let reason = "each layer of a declared texture follows the last one as `texture { }`";
                        let remedy = "Write `texture { A } texture { B }`, with any directive above the declaration.";
                        self.refused_by_povray(at, reason, remedy);
                    }
                    self.check_layers(sum, &next)?;
                    sum.lay_over(next, self.draft.version);
                }
            }
            if let Some(sum) = &sum {
                self.peek_after(|| Value::Element(Element::new("texture", sum.clone())))?;
            }
        }
        sum.ok_or_else(|| self.expected_here("`texture`"))
    }

    /// Rejects layers on patterned textures, and textures whose layers would double.
    pub(crate) fn check_layers(&self, lower: &Texture, upper: &Texture) -> Parse<()> {
        match lower.layering_error(upper) {
            Some(fault) => Err(self.error_taken(fault)),
            None => Ok(()),
        }
    }
}

/// A colour as a number of five components, as expressions see it.
pub(crate) fn color_number(color: Color) -> Number {
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

//! [`Args`] for [`Reader`]: how elements read their parameters.

use crate::base::args::{AnyObject, Args, ColorOrSingle, Interner, Parse, SampledFunction, Word};
use crate::base::color::{Color, Gamma};
use crate::base::math::Transform;
use crate::base::source::{Diagnostic, Span};
use crate::base::version::Novelty;
use crate::lang::expr::value::{Number, Value};
use crate::lang::frame::Start;
use crate::lang::reader::Reader;
use crate::lang::syntax::{Kind, Symbol};
use crate::scene;
use crate::scene::pattern::Field;
use crate::scene::shape::{MeshInstance, Shape};
use crate::scene::texture::{Layer, Normal, Pigment, Texture};
use crate::scene::{Object, ObjectField};
use glam::{DVec2, DVec3};
use std::any::{Any, TypeId};
use std::sync::Arc;

/// First version with gamma handling in scenes that set no gamma.
const GAMMA_SINCE: f64 = 3.7;

impl Args for Reader<'_> {
    fn interner(&self) -> Option<&Interner> {
        Some(&self.memory.alike)
    }

    fn float(&mut self) -> Parse<f64> {
        let start = self.start()?;
        let number = self.number_at_sum()?;
        self.finite(&[number], start)?;
        Ok(number)
    }

    fn float_or(&mut self, default: f64) -> Parse<f64> {
        // The name of a colour begins no number: in an object it is the colour of the object.
        if self.begins_number()? && !self.is_at_color_name()? {
            self.float()
        } else {
            Ok(default)
        }
    }

    fn vector2(&mut self) -> Parse<DVec2> {
        let number = self.finite_vector(2)?;
        Ok(DVec2::new(number.v[0], number.v[1]))
    }

    fn vector(&mut self) -> Parse<DVec3> {
        let number = self.finite_vector(3)?;
        Ok(DVec3::new(number.v[0], number.v[1], number.v[2]))
    }

    fn vector4(&mut self) -> Parse<[f64; 4]> {
        let number = self.finite_vector(4)?;
        Ok([number.v[0], number.v[1], number.v[2], number.v[3]])
    }

    fn color(&mut self) -> Parse<Color> {
        self.color_value()
    }

    fn color_if_any(&mut self) -> Parse<Option<Color>> {
        self.color_if_begun()
    }

    #[allow(
        clippy::cast_possible_truncation,
        reason = "positions of entries are single precision"
    )]
    fn color_or_single(&mut self) -> Parse<ColorOrSingle> {
        if let Some(color) = self.color_if_begun()? {
            return Ok(ColorOrSingle::Color(color));
        }
        let start = self.start()?;
        // As in POV-Ray, a sign or a vector does not begin a colour here.
        let may_be_color =
            !self.at_mark('-')? && !self.at_mark('+')? && !self.is_at_vector_name()?;
        let number = self.sum()?;
        self.finite(&number.v[..usize::from(number.len)], start)?;
        if may_be_color && number.len == 5 {
            return Ok(ColorOrSingle::Color(Color::from_components(number.v)));
        }
        let number = self.only_float(number, start)?;
        Ok(ColorOrSingle::Single(number as f32))
    }

    fn string(&mut self) -> Parse<String> {
        Reader::string(self)
    }

    fn file_named(&mut self, what: &str, name: &str, endings: &[&str]) -> Parse<Arc<[u8]>> {
        let at = self.taken_span();
        let found = self.sources.find_bytes(what, name, at.file, endings);
        found.map_err(|mut error| {
            error.span = Some(at);
            self.with_trace(*error)
        })
    }

    fn file(&mut self, what: &str, endings: &[&str]) -> Parse<(String, Arc<[u8]>)> {
        let name = self.file_name()?;
        let bytes = self.file_named(what, &name, endings)?;
        Ok((name, bytes))
    }

    fn sampled_function(&mut self) -> Parse<Option<SampledFunction>> {
        if !self.take_word(Word::Function)? {
            return Ok(None);
        }
        self.picture_of_function().map(Some)
    }

    fn object_any(&mut self) -> Parse<Arc<dyn AnyObject + Send + Sync>> {
        match self.object_or_name()? {
            Some(object) => {
                self.check_probed(&object)?;
                Ok(object)
            }
            None => Err(self.expected_here("an object")),
        }
    }

    fn transformed_object_any(&mut self) -> Parse<Arc<dyn AnyObject + Send + Sync>> {
        let Some(object) = self.object_or_name()? else {
            return Err(self.expected_here("an object"));
        };
        self.check_probed(&object)?;
        let mut moved = [object];
        self.move_all(&mut moved)?;
        let [object] = moved;
        Ok(object)
    }

    fn mesh_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        let at = Args::span(self);
        if let Some(object) = self.object()?
            && let scene::Kind::Shape(shape) = &object.kind
            && let Shape::Mesh(mesh) = &**shape
        {
            let transform = Transform::from_steps(&object.steps);
            return Ok(Arc::new(MeshInstance::new(mesh.clone(), transform)));
        }
        let message = "this is not a mesh".to_owned();
        Err(self.with_trace(Diagnostic::error(at, message)))
    }

    fn field_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        let object = self.transformed_object_any()?.downcast::<Object>();
        let field = object.and_then(|object| ObjectField::new(&object));
        Ok(match field {
            Some(field) => Arc::new(Arc::new(field) as Arc<dyn Field>),
            None => Arc::new(()),
        })
    }

    fn working_gamma(&self) -> Option<Gamma> {
        match self.draft.globals.assumed_gamma {
            None if self.effective_version() >= GAMMA_SINCE => Some(Gamma::LINEAR),
            known => known,
        }
    }

    fn literal_vectors(&mut self, len: usize, take: &mut dyn FnMut(&[f64]) -> bool) {
        self.take_literal_vectors(len, take);
    }

    fn literal_number(&mut self) -> Option<f64> {
        self.take_literal_number()
    }

    fn texture_any(&mut self) -> Parse<Arc<dyn Any + Send + Sync>> {
        let default = self.draft.default_layer.clone();
        Ok(Arc::new(Texture::read(self, &default)?))
    }

    fn at_mark(&mut self, mark: char) -> Parse<bool> {
        Ok(self.peek()?.is_mark(mark))
    }

    fn comma(&mut self) -> Parse<bool> {
        self.take_mark(',')
    }

    fn word(&mut self) -> Parse<Option<Word>> {
        Ok(self.peek()?.word())
    }

    fn accept(&mut self, word: Word) -> Parse<bool> {
        self.take_word(word)
    }

    fn accept_mark(&mut self, mark: char) -> Parse<bool> {
        match mark {
            '{' if self.peek()?.is_mark('{') => self.open_block().map(|()| true),
            '}' => self.take_close(),
            _ => self.take_mark(mark),
        }
    }

    fn open(&mut self) -> Parse<()> {
        self.open_block()
    }

    fn accept_close(&mut self) -> Parse<bool> {
        self.take_close()
    }

    fn close(&mut self) -> Parse<()> {
        if self.take_close()? {
            Ok(())
        } else {
            Err(self.expected_here("`}`"))
        }
    }

    fn at_expression(&mut self) -> Parse<bool> {
        self.begins_number()
    }

    fn declared_any(&mut self, kind: TypeId) -> Parse<Option<Arc<dyn Any + Send + Sync>>> {
        let token = self.peek()?;
        if token.kind != Kind::Name {
            return Ok(None);
        }
        match self.scopes.get(Symbol(token.value)) {
            Some(Value::Element(element)) if element.kind() == kind => {
                let value = Arc::clone(&element.value);
                self.pass();
                Ok(Some(value))
            }
            Some(array @ Value::Array(_)) if array.is_mixed() => {
                match self.mixed_item_ahead(Symbol(token.value))? {
                    Some(Value::Element(element)) if element.kind() == kind => {
                        self.array_or_item()?;
                        Ok(Some(element.value))
                    }
                    _ => Ok(None),
                }
            }
            Some(Value::Array(array)) if array.holds_elements(kind) => {
                match self.array_or_item()? {
                    Value::Element(element) if element.kind() == kind => Ok(Some(element.value)),
                    other => Err(self.error_taken(format!("{} is not allowed here", other.kind()))),
                }
            }
            Some(Value::Poison(why)) => Err(self.consequence_of(why.as_deref())),
            _ => Ok(None),
        }
    }

    fn default_any(&self, kind: TypeId) -> Option<Arc<dyn Any + Send + Sync>> {
        let layer = &self.draft.default_layer;
        if kind == TypeId::of::<Pigment>() {
            Some(Arc::new(layer.pigment.clone()))
        } else if kind == TypeId::of::<Option<Arc<Normal>>>() {
            Some(Arc::new(layer.normal.clone()))
        } else if kind == TypeId::of::<Layer>() {
            Some(Arc::new(layer.clone()))
        } else {
            None
        }
    }

    fn function_any(&mut self) -> Parse<Option<Arc<dyn Any + Send + Sync>>> {
        Ok(Some(self.function_block()?))
    }

    fn span(&mut self) -> Span {
        if let Err(error) = self.peek() {
            // A faulty directive before the token has been passed, so its error is recorded now.
            let error = self.with_trace(*error);
            self.record(*error);
        }
        self.here_span()
    }

    fn last_span(&self) -> Span {
        self.taken_span()
    }

    fn expected(&mut self, what: &str) -> Box<Diagnostic> {
        self.expected_here(what)
    }

    fn warn(&mut self, warning: Diagnostic) {
        self.warning(warning);
    }

    fn version(&self) -> f64 {
        self.draft.version
    }

    fn is_for_3_8(&self) -> bool {
        self.draft.globals.is_for_3_8
    }

    fn note_novelty(&mut self, novelty: Novelty) {
        self.draft.note_novelty(novelty);
    }

    fn effective_version(&self) -> f64 {
        self.draft.version_of_rules()
    }

    fn reserve_memory(&mut self, what: &str, bytes: u64, at: Span) -> Parse<()> {
        self.take_memory_for(what, bytes, at)
    }
}

impl Reader<'_> {
    fn finite_vector(&mut self, len: u8) -> Parse<Number> {
        let start = self.start()?;
        let number = self.vector_of(len)?;
        self.finite(&number.v[..usize::from(len)], start)?;
        Ok(number)
    }

    /// Elements take finite numbers only: no ray hits an infinite sphere, and an image has no infinite colour.
    pub(crate) fn finite(&self, numbers: &[f64], start: Start) -> Parse<()> {
        let Some(bad) = numbers.iter().find(|number| !number.is_finite()) else {
            return Ok(());
        };
        let (is, hint) = if bad.is_nan() {
            ("no number", "It comes of `0 * infinity` or the like.")
        } else {
            ("infinite", "Caused by a division by zero or an overflow.")
        };
        let span = self.span_from(start);
        Err(self.with_trace(Diagnostic::error(span, format!("this value is {is}")).with_hint(hint)))
    }
}

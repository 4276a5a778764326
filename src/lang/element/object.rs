//! Objects and their modifiers.

use super::fold::{baked, fold_steps, own_texture};
use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::math::merge_steps;
use crate::base::source::{Code, Diagnostic};
use crate::lang::expr::value::Value;
use crate::lang::fast_path::common_object::Read;
use crate::lang::fast_path::literal_cache::CachedObjects;
use crate::lang::fast_path::parallel::{Defaults, LiteralSink};
use crate::lang::reader::Reader;
use crate::lang::syntax::{Class, Kind as Tok, Symbol};
use crate::scene::interior::Interior;
use crate::scene::shape::{Geometry, Shape};
use crate::scene::texture::{Material, Texture};
use crate::scene::{Kind, Object, Operation};
use std::sync::Arc;

/// Collects the parts of an object.
impl LiteralSink for Vec<Arc<Object>> {
    type Item = Arc<Object>;

    fn item(read: Read, defaults: &Defaults<'_>) -> Arc<Object> {
        Arc::new(read.into_object(defaults.layer))
    }

    fn to_cached(objects: Vec<Arc<Object>>) -> CachedObjects {
        CachedObjects::Parts(objects.into())
    }

    fn suits(objects: &CachedObjects) -> bool {
        matches!(objects, CachedObjects::Parts(_))
    }

    fn take_cached(&mut self, reader: &mut Reader<'_>, objects: &CachedObjects) -> Parse<()> {
        let CachedObjects::Parts(parts) = objects else {
            return Ok(());
        };
        self.extend_from_slice(parts);
        reader.count_objects(parts.len() as u64)
    }

    fn take(&mut self, reader: &mut Reader<'_>, mut piece: Vec<Arc<Object>>) -> Parse<()> {
        let count = piece.len() as u64;
        self.append(&mut piece);
        reader.count_objects(count)
    }
}

impl Reader<'_> {
    /// The next object, if one begins at the cursor.
    pub(crate) fn object(&mut self) -> Parse<Option<Arc<Object>>> {
        let token = self.peek()?;
        let Some(word) = token.word() else {
            return Ok(None);
        };
        if let Some(read) = self.replay_object()? {
            return Ok(Some(Arc::new(read.into_object(&self.draft.default_layer))));
        }
        self.object_of_tokens(word)
    }

    /// The object of the next word, read token by token.
    pub(crate) fn object_of_tokens(&mut self, word: Word) -> Parse<Option<Arc<Object>>> {
        let mut object = match word {
            Word::Union => self.csg(Operation::Union)?,
            Word::Composite => {
                let text = "`composite` is the old word for `union`";
                let warning = Diagnostic::warning(self.here_span(), text);
                self.warning(warning.with_hint("Write `union` instead."));
                self.csg(Operation::Union)?
            }
            Word::Merge => self.csg(Operation::Merge)?,
            Word::Intersection => self.csg(Operation::Intersection)?,
            Word::Difference => self.csg(Operation::Difference)?,
            Word::Object => self.object_block()?,
            Word::LightSource => self.light()?,
            _ if word.class() == Class::Shape => self.shape(word)?,
            Word::LightGroup => self.light_group()?,
            _ => return Ok(None),
        };
        object.steps.shrink_to_fit();
        Ok(Some(Arc::new(object)))
    }

    /// The object of the next identifier.
    pub(crate) fn object_of_name(&mut self) -> Parse<Option<Arc<Object>>> {
        let token = self.peek()?;
        if token.kind != Tok::Name {
            return Ok(None);
        }
        let value = match self.scopes.get(Symbol(token.value)) {
            Some(array @ Value::Array(_)) if array.is_mixed() => {
                match self.mixed_item_ahead(Symbol(token.value))? {
                    Some(Value::Object(_)) => self.array_or_item()?,
                    _ => return Ok(None),
                }
            }
            Some(Value::Array(_)) => self.array_or_item()?,
            Some(Value::Poison(why)) => return Err(self.consequence_of(why.as_deref())),
            Some(value @ Value::Object(_)) => {
                let value = value.clone();
                self.pass();
                self.warn_of_qualified(Symbol(token.value));
                value
            }
            _ => return Ok(None),
        };
        match value {
            Value::Object(object) => Ok(Some(object)),
            other => Err(self.error_taken(format!("expected an object, found {}", other.kind()))),
        }
    }

    /// The same where a vector is allowed as well: an item of an array may be either.
    pub(crate) fn object_in_shape(&mut self) -> Parse<Option<Arc<Object>>> {
        let token = self.peek()?;
        let name = token.symbol().and_then(|name| self.scopes.get(name));
        if !matches!(name, Some(array @ Value::Array(_)) if !array.is_mixed()) {
            return self.object_of_name();
        }
        let start = self.reading();
        match self.array_or_item()? {
            Value::Object(object) => Ok(Some(object)),
            item => {
                self.read_again(item, start);
                Ok(None)
            }
        }
    }

    /// The next object, written out or by name.
    pub(crate) fn object_or_name(&mut self) -> Parse<Option<Arc<Object>>> {
        match self.object()? {
            Some(object) => Ok(Some(object)),
            None => self.object_of_name(),
        }
    }

    /// Applies the transforms that follow to objects.
    pub(crate) fn move_all(&mut self, objects: &mut [Arc<Object>]) -> Parse<()> {
        let mut steps = Vec::new();
        while let Some(step) = transform_step(self)? {
            steps.push(step);
            merge_steps(&mut steps, 0);
        }
        if steps.is_empty() {
            return Ok(());
        }
        for object in objects {
            let object = Arc::make_mut(object);
            object.steps.extend_from_slice(&steps);
            fold_steps(object);
        }
        Ok(())
    }

    /// `object { Identifier ... }` or `object { sphere { ... } ... }`.
    fn object_block(&mut self) -> Parse<Object> {
        self.pass();
        self.open_block()?;
        let Some(inner) = self.object_or_name()? else {
            return Err(self.expected_here("an object in `object { }`"));
        };
        let mut object = (*inner).clone();
        self.modifiers(&mut object, "object")?;
        Ok(object)
    }

    fn shape(&mut self, word: Word) -> Parse<Object> {
        self.pass();
        let start = self.start_taken();
        self.open_block()?;
        let depth = self.blocks.len();
        if self.raw().is_mark(',') {
            let reason = "no comma stands before the first value";
            self.refused_by_povray(self.here_span(), reason, "Remove it.");
        }
        let mut object = match self.object_in_shape()? {
            Some(object) => (*object).clone(),
            None => match Shape::read(word, self) {
                Some(Ok(shape)) => Object::new(Kind::Shape(Arc::new(shape))),
                Some(Err(error)) => return Err(self.with_usage(error, word, depth)),
                None => {
                    let error = Diagnostic::error(
                        self.span_of(start),
                        format!("`{word}` is not supported yet"),
                    );
                    return Err(self.with_trace(error.with_code(Code::NotBuilt)));
                }
            },
        };
        self.modifiers(&mut object, word.spelling())?;
        Ok(object)
    }

    /// Adds the syntax of the object to an error, if its parameters are at fault.
    pub(crate) fn with_usage(
        &mut self,
        error: Box<Diagnostic>,
        word: Word,
        depth: usize,
    ) -> Box<Diagnostic> {
        let is_ours = self.blocks.len() == depth
            && error.message.starts_with("expected")
            && error.hints.is_empty()
            && (matches!(self.raw().kind, Tok::Word | Tok::String)
                || ['}', ','].iter().any(|&mark| self.raw().is_mark(mark)));
        if !is_ours {
            return error;
        }
        if let Some(sign) = self.subtracting_sign(depth) {
            let text = "this sign adds or subtracts, and makes one value of two";
            return Box::new(
                error
                    .with_label(sign, text)
                    .with_hint("Write `,` before the sign, to begin a value of its own."),
            );
        }
        match Self::usage(word) {
            Some(usage) => Box::new(error.with_hint(format!("Write {usage}."))),
            None => error,
        }
    }

    /// Everything after the parameters of an object, up to its `}`.
    pub(crate) fn modifiers(&mut self, object: &mut Object, of: &str) -> Parse<()> {
        loop {
            if self.take_close()? {
                object.keep_extent();
                object.update_visibility_box();
                return self.check_sides(object);
            }
            if let Some(step) = transform_step(self)? {
                object.steps.push(step);
                fold_steps(object);
                continue;
            }
            let token = self.peek()?;
            let is_known = match token.word() {
                Some(word) => self.modifier(object, word)?,
                None => token.kind == Tok::Name && self.unused_color()?,
            };
            if !is_known {
                return Err(self.unknown_modifier(of));
            }
        }
    }

    /// Rejects an interior texture on an object without a texture.
    fn check_sides(&self, object: &Object) -> Parse<()> {
        if object.texture.is_some() || object.interior_texture().is_none() {
            return Ok(());
        }
        let text = "an object with an `interior_texture` needs a `texture` for its outer side too";
        let hint = "Give it a texture or a pigment: `texture { pigment { rgb 1 } }`.";
        Err(Box::new(
            Diagnostic::error(self.taken_span(), text).with_hint(hint),
        ))
    }

    fn unknown_modifier(&mut self, of: &str) -> Box<Diagnostic> {
        let token = self.raw();
        if token
            .word()
            .is_some_and(|word| matches!(word.class(), Class::Shape | Class::Csg))
        {
            return self.expected_here(&format!("a modifier of `{of}` or its `}}`"));
        }
        self.expected_here(&format!(
            "a modifier (texture, pigment, finish, transform, ...) or `}}` in `{of}`"
        ))
    }

    /// Reads one modifier; false if the word is none.
    fn modifier(&mut self, object: &mut Object, word: Word) -> Parse<bool> {
        match word {
            Word::Texture => {
                let texture = self.texture_layers()?;
                self.lay_over(object, texture)?;
            }
            Word::Pigment | Word::Normal | Word::Finish => self.texture_part(object, word)?,
            Word::InteriorTexture => {
                self.pass();
                let default = self.draft.default_layer.clone();
                let texture = Texture::read(self, &default)?;
                let texture = texture.as_lowest(self.draft.version);
                object.set_interior_texture(Arc::new(texture));
            }
            Word::Interior => {
                self.pass();
                let interior = Interior::read(self)?;
                object.interior = Some(Arc::new(interior.after(&object.steps)));
            }
            Word::Material => self.material(object)?,
            Word::Radiosity => {
                object.flags.importance = self.importance()?.or(object.flags.importance)
            }
            Word::ClippedBy | Word::BoundedBy => self.clip_or_bound(object, word)?,
            _ => return self.switch(object, word),
        }
        Ok(true)
    }

    fn switch(&mut self, object: &mut Object, word: Word) -> Parse<bool> {
        match word {
            Word::NoShadow => object.flags.no_shadow = true,
            Word::UvMapping if object.texture.is_some() => {
                let text = "expected `uv_mapping` before the texture of the object, found it after";
                let hint = "Move `uv_mapping` before the texture, or into it: `texture { uv_mapping ... }`.";
                return Err(Box::new(self.error_here(text).with_hint(hint)));
            }
            Word::UvMapping => object.flags.uv_mapping = true,
            Word::Inverse => object.invert(),
            Word::CutawayTextures => {
                if !object.set_cutaway_textures() {
                    let text = "`cutaway_textures` belongs only in `intersection` and `difference`";
                    return Err(self.error_here(text));
                }
            }
            Word::NoImage
            | Word::NoReflection
            | Word::NoRadiosity
            | Word::DoubleIlluminate
            | Word::Hollow
            | Word::Hierarchy
            | Word::SplitUnion
            | Word::Sturm => {
                self.pass();
                self.warn_of_idle_switch(object, word);
                let is_on = self.float_or(1.0)? != 0.0;
                match word {
                    Word::NoImage => object.flags.no_image = is_on,
                    Word::NoReflection => object.flags.no_reflection = is_on,
                    Word::NoRadiosity => object.flags.no_radiosity = is_on,
                    Word::DoubleIlluminate => object.flags.double_illuminate = is_on,
                    Word::Hollow => object.flags.hollow = Some(is_on),
                    Word::SplitUnion => object.flags.keeps_union = !is_on,
                    Word::Sturm if is_on => {
                        if let Kind::Shape(shape) = &mut object.kind {
                            Arc::make_mut(shape).use_sturm();
                        }
                    }
                    // The others do not affect the image.
                    _ => {}
                }
                return Ok(true);
            }
            Word::Photons => {
                self.pass();
                object.photons_mut().read(self)?;
                return Ok(true);
            }
            _ => return self.unused_color(),
        }
        self.pass();
        Ok(true)
    }

    /// Warns of a switch without effect on an object of a kind for which POV-Ray rejects it.
    fn warn_of_idle_switch(&mut self, object: &Object, word: Word) {
        let is_suited = match (word, &object.kind) {
            (Word::Sturm, Kind::Shape(shape)) => shape.takes_sturm(),
            (Word::Hierarchy, Kind::Shape(shape)) => shape.takes_hierarchy(),
            (Word::SplitUnion, Kind::Csg { operation, .. }) => {
                matches!(operation, Operation::Union | Operation::Merge)
            }
            (Word::Sturm | Word::Hierarchy | Word::SplitUnion, _) => false,
            _ => true,
        };
        if !is_suited {
            let reason = format!("`{word}` has no effect on this object");
            self.refused_by_povray(self.taken_span(), &reason, "Remove it.");
        }
    }

    /// Reads a colour of the object itself, which has no effect; false if none is next.
    fn unused_color(&mut self) -> Parse<bool> {
        let at = self.here_span();
        if self.color_if_begun()?.is_none() {
            return Ok(false);
        }
        self.warning(
            Diagnostic::warning(at, "a colour of an object itself has no effect here")
                .with_hint("Put it into `pigment { }`."),
        );
        Ok(true)
    }

    /// `pigment`, `normal` or `finish` directly in an object: they change the top layer of its texture.
    fn texture_part(&mut self, object: &mut Object, word: Word) -> Parse<()> {
        if let Some(known) = &object.texture
            && known.what.is_patterned()
        {
            let message = format!("`{word}` cannot change a texture that a pattern chooses");
            return Err(self.error_here(message));
        }
        own_texture(object, &self.draft.default_layer);
        baked(object).top_mut().read_part(word, self)?;
        Ok(())
    }

    /// Sets the texture of an object, or adds a layer to it.
    fn lay_over(&mut self, object: &mut Object, texture: Texture) -> Parse<()> {
        match &object.texture {
            Some(lower) => {
                self.check_layers(&lower.what, &texture)?;
                baked(object).lay_over(texture, self.draft.version);
            }
            None => object.texture = Some(object.attach(Arc::new(texture))),
        }
        Ok(())
    }

    fn material(&mut self, object: &mut Object) -> Parse<()> {
        self.pass();
        let default = self.draft.default_layer.clone();
        let material = Material::read(self, &default)?.in_version(self.draft.version);
        if let Some(texture) = material.texture {
            self.lay_over(object, texture)?;
        }
        if let Some(texture) = material.interior_texture {
            object.set_interior_texture(Arc::new(texture));
        }
        if let Some(interior) = material.interior {
            object.interior = Some(Arc::new(interior.after(&object.steps)));
        }
        Ok(())
    }
}

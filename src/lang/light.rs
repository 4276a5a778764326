//! `light_source`: a light with the objects that it may hold.

use super::reader::Reader;
use crate::args::{Parse, Word, transform_step};
use crate::light::Light;
use crate::math::Step;
use crate::scene::{Kind, Object};
use std::sync::Arc;

/// The objects that a light holds.
#[derive(Default)]
struct Held {
    looks_like: Option<Arc<Object>>,
    projected_through: Option<Arc<Object>>,
}

impl Reader<'_> {
    /// `light_source { ... }`. Behind a name stand the modifiers of any object.
    pub(super) fn light(&mut self) -> Parse<Object> {
        self.has_light = true;
        self.pass();
        self.open_block()?;
        if let Some(known) = self.object_of_name()? {
            let mut object = (*known).clone();
            self.modifiers(&mut object, Word::LightSource.spelling())?;
            return Ok(object);
        }
        let depth = self.blocks.len();
        match self.light_items() {
            Ok(object) => Ok(object),
            Err(error) => Err(self.with_usage(error, Word::LightSource, depth)),
        }
    }

    fn light_items(&mut self) -> Parse<Object> {
        self.has_light = true;
        let mut light = Light::begin(self)?;
        let mut held = Held::default();
        while !self.take_close()? {
            if let Some(step) = transform_step(self)? {
                light.transform(&step);
                let objects = [&mut held.looks_like, &mut held.projected_through];
                for object in objects.into_iter().flatten() {
                    Arc::make_mut(object).steps.push(step.clone());
                }
                continue;
            }
            let word = self.peek()?.word();
            match word {
                Some(word @ (Word::LooksLike | Word::ProjectedThrough)) => {
                    self.held_object(word, &light, &mut held)?;
                }
                _ if light.read_item(self)? => {}
                _ => return Err(self.expected_here("a parameter of `light_source` or `}`")),
            }
        }
        light.end(self)?;
        Ok(Object::new(Kind::Light {
            light: Arc::new(light),
            looks_like: held.looks_like,
            projected_through: held.projected_through,
        }))
    }

    /// `looks_like { OBJECT modifiers }` and `projected_through { OBJECT modifiers }`.
    fn held_object(&mut self, word: Word, light: &Light, held: &mut Held) -> Parse<()> {
        self.pass();
        let is_look = word == Word::LooksLike;
        let slot = if is_look {
            &mut held.looks_like
        } else {
            &mut held.projected_through
        };
        if slot.is_some() {
            return Err(self.error_taken(format!("a light has one `{word}` at most")));
        }
        self.open_block()?;
        let known = match self.object_of_name()? {
            Some(object) => Some(object),
            None => self.object()?,
        };
        let Some(known) = known else {
            return Err(self.expected_here(&format!("an object in `{word}`")));
        };
        let mut object = (*known).clone();
        if is_look {
            // Its own modifiers come after it has been put into its place, as in POV-Ray.
            object.steps.push(Step::Translate(light.centre));
            object.flags.no_shadow = true;
        }
        self.modifiers(&mut object, word.spelling())?;
        *slot = Some(self.with_default_texture(Arc::new(object)));
        Ok(())
    }
}

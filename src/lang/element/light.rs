//! `light_source`: a light with the objects attached to it. `light_group`: lights with the objects they illuminate.

use super::fold::fold_steps;
use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::math::Step;
use crate::base::source::Diagnostic;
use crate::lang::diagnose::recover::is_part;
use crate::lang::reader::Reader;
use crate::scene::light::Light;
use crate::scene::{Kind, LightGroup, Object, Operation};
use std::sync::Arc;

/// The objects attached to a light.
#[derive(Default)]
struct Held {
    looks_like: Option<Arc<Object>>,
    projected_through: Option<Arc<Object>>,
}

impl Reader<'_> {
    /// `light_source { ... }`. After an object's name any object modifiers may stand.
    pub(crate) fn light(&mut self) -> Parse<Object> {
        self.draft.has_light = true;
        self.pass();
        self.open_block()?;
        if let Some(known) = self.object_in_shape()? {
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
        self.draft.has_light = true;
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

    /// `light_group { ... }`: objects and lights, then transforms, `global_lights` and `photons`, and nothing else.
    /// Unlike in CSG, a name may come first.
    pub(crate) fn light_group(&mut self) -> Parse<Object> {
        self.pass();
        let start = self.taken_span();
        self.open_block()?;
        let children = self.children()?;
        let mut object = Object::new(Kind::Csg {
            operation: Operation::Union,
            children: Arc::new(children),
        });
        self.check_size(&object, start)?;
        let mut group = LightGroup::default();
        while !self.take_close()? {
            if let Some(step) = transform_step(self)? {
                object.steps.push(step);
                fold_steps(&mut object);
            } else if self.take_word(Word::GlobalLights)? {
                group.global_lights = self.float_or(1.0)? != 0.0;
            } else if self.take_word(Word::Photons)? {
                object.photons_mut().read(self)?;
            } else {
                return Err(self.not_of_a_group());
            }
        }
        object.light_group = Some(group);
        Ok(object)
    }

    /// The error for a token that cannot stand in a light group after its objects.
    fn not_of_a_group(&mut self) -> Box<Diagnostic> {
        let wanted = "a transform, `global_lights`, `photons` or `}` in `light_group`";
        let mut error = self.expected_here(wanted);
        if let Some(word) = self.raw().word().filter(|&word| is_part(word)) {
            let text = format!("A light group has no `{word}`: give it to the objects in it.");
            error.hints = vec![text];
        }
        error
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
        let Some(known) = self.object_or_name()? else {
            return Err(self.expected_here(&format!("an object in `{word}`")));
        };
        let mut object = (*known).clone();
        if is_look {
            // Its own modifiers apply after the translation to the light, as in POV-Ray.
            object.steps.push(Step::Translate(light.centre));
            object.flags.no_shadow = true;
        }
        self.modifiers(&mut object, word.spelling())?;
        *slot = Some(self.with_default_texture(Arc::new(object)));
        Ok(())
    }
}

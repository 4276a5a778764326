//! Objects that are written without anything unusual, from whoever gives their parameters.
//!
//! What is read here is read as the statements of a scene read it; at anything else it is left to them.

use super::object::{baked, fold_steps};
use crate::args::{Args, Parse, Word, transform_step};
use crate::interior::Interior;
use crate::scene::{Kind, Object};
use crate::shape::Shape;
use crate::syntax::Class;
use crate::texture::{Layer, Texture};
use std::sync::Arc;

/// An object with its modifiers: a shape, or a copy of an object with a name. `None` if something else stands here.
pub(super) fn plain_object<A: Args>(args: &mut A, default: &Layer) -> Parse<Option<Object>> {
    let Some(word) = args.word()? else {
        return Ok(None);
    };
    let object = match word {
        Word::Object => {
            args.accept(word)?;
            args.open()?;
            let known = args.object_any()?.downcast::<Object>();
            known.ok().map(|known| (*known).clone())
        }
        _ if word.class() == Class::Shape => {
            args.accept(word)?;
            args.open()?;
            let shape = Shape::read(word, args).transpose()?;
            shape.map(|shape| Object::new(Kind::Shape(Arc::new(shape))))
        }
        _ => None,
    };
    match object {
        Some(object) => modified(object, args, default),
        None => Ok(None),
    }
}

/// An object with what stands behind its parameters.
fn modified<A: Args>(mut object: Object, args: &mut A, default: &Layer) -> Parse<Option<Object>> {
    while !args.accept_close()? {
        let Some(word) = args.word()? else {
            return Ok(None);
        };
        match word {
            Word::Texture if object.texture.is_none() => {
                args.accept(word)?;
                let texture = Texture::read(args, default)?;
                object.texture = Some(object.attach(Arc::new(texture)));
            }
            Word::Pigment | Word::Normal | Word::Finish if object.texture.is_none() => {
                let mut layer = default.clone();
                layer.read_part(word, args)?;
                object.texture = Some(object.attach(Arc::new(Texture::from(layer))));
            }
            Word::Pigment | Word::Normal | Word::Finish => {
                let texture = baked(&mut object);
                if texture.is_patterned() {
                    return Ok(None);
                }
                texture.top_mut().read_part(word, args)?;
            }
            Word::Interior => {
                args.accept(word)?;
                let interior = Interior::read(args)?;
                object.interior = Some(Arc::new(interior.after(&object.steps)));
            }
            Word::NoShadow => {
                args.accept(word)?;
                object.flags.no_shadow = true;
            }
            Word::Inverse => {
                args.accept(word)?;
                object.is_inverse = !object.is_inverse;
            }
            Word::Translate | Word::Rotate | Word::Scale | Word::Matrix | Word::Transform => {
                if let Some(step) = transform_step(args)? {
                    object.steps.push(step);
                    fold_steps(&mut object);
                }
            }
            _ => return Ok(None),
        }
    }
    Ok(Some(object))
}

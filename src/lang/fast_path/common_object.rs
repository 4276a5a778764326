//! Objects in their common form, from any source of parameters.
//!
//! The result is the one that the statements of a scene give; anything unusual is left to them.

use super::literal::{Literal, LiteralContext};
use super::part_cache::{Part, Parts};
use crate::base::args::{Args, Parse, Word, transform_step};
use crate::base::color::Color;
use crate::lang::element::fold::{baked, fold_steps};
use crate::lang::limits;
use crate::lang::syntax::Class;
use crate::scene::interior::Interior;
use crate::scene::shape::Shape;
use crate::scene::texture::{Layer, Pigment, PigmentSyntax, Texture};
use crate::scene::{Kind, Object, Operation};
use std::sync::Arc;

/// An object in its common form.
pub(crate) enum Read {
    /// A shape and nothing else, of one colour or with the default texture.
    Shape {
        /// The shape.
        shape: Shape,
        /// Its colour, if it has one.
        color: Option<Color>,
    },
    /// Any other object.
    Object(Object),
}

/// An object that is written as plain literals.
pub(crate) struct LiteralObject {
    pub(crate) read: Read,
    /// Number of objects in it.
    pub(crate) parts: u32,
    /// The byte after it.
    pub(crate) end: usize,
}

/// Longer CSG objects are read as tokens, and their parts as literals: not much is parsed in vain where almost all of
/// an object is literal.
const MAX_CSG_BYTES: usize = 1 << 12;

/// So are CSG objects that are nested deeper than this.
const MAX_CSG_DEPTH: u32 = 8;

impl Read {
    /// Converts it into an object; one without a texture gets none.
    pub(crate) fn into_object(self, default: &Layer) -> Object {
        let (shape, color) = match self {
            Read::Object(object) => return object,
            Read::Shape { shape, color } => (shape, color),
        };
        let mut object = Object::new(Kind::Shape(Arc::new(shape)));
        if let Some(color) = color {
            let layer = colored(color, default);
            object.texture = Some(object.attach(Arc::new(Texture::from(layer))));
        }
        object
    }
}

/// The default layer with a plain pigment.
fn colored(color: Color, default: &Layer) -> Layer {
    Layer {
        pigment: Pigment::plain(color),
        ..default.clone()
    }
}

/// A CSG object while it is read.
struct Outermost<'k, 'a> {
    start: usize,
    /// Number of objects in it so far.
    parts: u32,
    known: &'k mut Parts<'a>,
}

/// The object that begins at a byte, if it is written as plain literals; `known` caches parts of the objects before it
/// in the same text.
pub(crate) fn literal_object<'a>(
    text: &'a str,
    at: usize,
    context: &LiteralContext<'a>,
    default: &Layer,
    known: &mut Parts<'a>,
) -> Option<LiteralObject> {
    let mut args = Literal::new(text, at, context);
    let mut whole = Outermost {
        start: at,
        parts: 0,
        known,
    };
    let read = shape_or_combination(&mut args, default, &mut whole, 0).ok()??;
    let end = args.reached()?;
    Some(LiteralObject {
        read,
        parts: whole.parts,
        end,
    })
}

/// A shape, a copy or a CSG object.
fn shape_or_combination<'a>(
    args: &mut Literal<'a>,
    default: &Layer,
    whole: &mut Outermost<'_, 'a>,
    depth: u32,
) -> Parse<Option<Read>> {
    let word = args.word()?;
    let operation = match word {
        Some(Word::Union) => Operation::Union,
        Some(Word::Merge) => Operation::Merge,
        Some(Word::Intersection) => Operation::Intersection,
        Some(Word::Difference) => Operation::Difference,
        _ => return plain_object(args, default),
    };
    if depth == MAX_CSG_DEPTH {
        return Ok(None);
    }
    word.map(|word| args.accept(word)).transpose()?;
    args.open()?;
    let mut children = Vec::new();
    while !args.at_mark('}')?
        && let Some(word) = args.word()?
        && (matches!(word.class(), Class::Shape | Class::Csg) || word == Word::Object)
    {
        let child = part(args, default, whole, depth + 1)?;
        let Some(child) = child.filter(|_| args.at() < whole.start + MAX_CSG_BYTES) else {
            return Ok(None);
        };
        children.push(child);
        whole.parts += 1;
    }
    if children.len() < 2 {
        return Ok(None);
    }
    let object = Object::new(Kind::Csg {
        operation,
        children: Arc::new(children),
    });
    if limits::exceeded(&object).is_some() {
        return Ok(None);
    }
    modified(object, args, default)
}

/// The next part of a CSG object.
fn part<'a>(
    args: &mut Literal<'a>,
    default: &Layer,
    whole: &mut Outermost<'_, 'a>,
    depth: u32,
) -> Parse<Option<Arc<Object>>> {
    let rest = args.rest();
    if let Some(part) = whole.known.find(rest) {
        args.pass(part.text.len());
        whole.parts += part.parts;
        return Ok(Some(part.object));
    }
    let before = whole.parts;
    let Some(read) = shape_or_combination(args, default, whole, depth)? else {
        return Ok(None);
    };
    let object = Arc::new(read.into_object(default));
    whole.known.note(Part {
        text: &rest[..rest.len() - args.rest().len()],
        object: Arc::clone(&object),
        parts: whole.parts - before,
    });
    Ok(Some(object))
}

/// An object with its modifiers: a shape, or a copy of a named object. `None` for anything else.
pub(crate) fn plain_object<A: Args>(args: &mut A, default: &Layer) -> Parse<Option<Read>> {
    let Some(word) = args.word()? else {
        return Ok(None);
    };
    if word == Word::Object {
        args.accept(word)?;
        args.open()?;
        return match args.object_any()?.downcast::<Object>() {
            Some(known) => modified((*known).clone(), args, default),
            None => Ok(None),
        };
    }
    if word.class() != Class::Shape {
        return Ok(None);
    }
    args.accept(word)?;
    args.open()?;
    let Some(shape) = Shape::read(word, args).transpose()? else {
        return Ok(None);
    };
    let mut color = None;
    loop {
        if args.accept_close()? {
            return Ok(Some(Read::Shape { shape, color }));
        }
        if color.is_some() || !default.is_bare() || !args.accept(Word::Pigment)? {
            let object = Read::Shape { shape, color }.into_object(default);
            return modified(object, args, default);
        }
        args.open()?;
        let is_color = |word: Word| word.class() == Class::Color;
        if args.word()?.is_some_and(is_color) {
            color = args.color_if_any()?;
        }
        if color.is_some() && args.accept_close()? {
            continue;
        }
        let pigment = match color {
            Some(color) => {
                Pigment::plain(color).read_parts_to_block_end(args, PigmentSyntax::Pigment)?
            }
            None => Pigment::read_inside(args, &default.pigment)?,
        };
        let layer = Layer {
            pigment,
            ..default.clone()
        };
        let mut object = Object::new(Kind::Shape(Arc::new(shape)));
        object.texture = Some(object.attach(Arc::new(Texture::from(layer))));
        return modified(object, args, default);
    }
}

/// An object with the modifiers after its parameters.
fn modified<A: Args>(mut object: Object, args: &mut A, default: &Layer) -> Parse<Option<Read>> {
    while !args.accept_close()? {
        let Some(word) = args.word()? else {
            return Ok(None);
        };
        match word {
            Word::Texture if object.texture.is_none() => {
                args.accept(word)?;
                let texture = Texture::read(args, default)?.as_lowest(args.version());
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
    object.steps.shrink_to_fit();
    object.update_visibility_box();
    Ok(Some(Read::Object(object)))
}

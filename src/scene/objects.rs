//! The objects of a scene: a list in which plain ones take little room.
//!
//! Programs write scenes of millions of objects, most of them a shape and its colour. Such an object is kept as that, and
//! made into an [`Object`] when somebody asks for it.

use super::{Attached, Kind, Object};
use crate::base::color::Color;
use crate::base::math::Step;
use crate::scene::shape::{Shape, Sphere};
use crate::scene::texture::{Finish, Layer, Texture};
use std::borrow::Cow;
use std::sync::Arc;

/// Objects are kept in pieces of so many, so that the room of those taken out is free before the last one is.
const PIECE: usize = 4096;

/// Objects in the order of the file.
#[derive(Clone, Debug, Default)]
pub struct Objects {
    /// All but the last are full.
    pieces: Vec<Vec<Entry>>,
}

/// A shape that stands where its own numbers say, with nothing but its looks.
#[derive(Clone, Debug)]
pub struct Plain {
    /// What it is.
    pub shape: Shape,
    /// How it looks.
    pub look: Look,
}

/// How a [`Plain`] object looks.
#[derive(Clone, Debug)]
pub enum Look {
    /// Of one colour everywhere.
    Color(Color, Arc<Finish>),
    /// As a texture says.
    Texture(Arc<Texture>),
}

/// An object as it is taken out.
#[derive(Debug)]
pub(crate) enum Taken {
    /// A shape that stands where its own numbers say, of one colour everywhere and nothing else.
    Colored(Shape, Color, Arc<Finish>),
    /// Any other.
    Object(Arc<Object>),
}

/// An object as it is kept. The numbers of balls stand in the list itself, for there may be millions of them.
#[derive(Clone, Debug)]
pub(crate) enum Entry {
    Whole(Arc<Object>),
    Ball {
        sphere: Sphere,
        color: Color,
        finish: Arc<Finish>,
    },
    TexturedBall {
        sphere: Sphere,
        texture: Arc<Texture>,
    },
    Colored {
        shape: Arc<Shape>,
        color: Color,
        finish: Arc<Finish>,
    },
    Textured {
        shape: Arc<Shape>,
        texture: Arc<Texture>,
    },
    Moved {
        shape: Arc<Shape>,
        color: Color,
        finish: Arc<Finish>,
        steps: Box<[Step]>,
    },
}

/// A shape of one colour and how it is moved.
pub(crate) struct Colored<'a> {
    pub(crate) shape: Cow<'a, Shape>,
    pub(crate) finish: &'a Arc<Finish>,
    pub(crate) steps: &'a [Step],
}

impl Objects {
    /// Adds an object.
    pub fn push(&mut self, object: Arc<Object>) {
        self.push_entry(object.into());
    }

    /// Adds a plain object.
    pub fn push_plain(&mut self, plain: Plain) {
        self.push_entry(plain.into());
    }

    /// Adds a sphere.
    #[inline]
    pub(crate) fn push_ball(&mut self, sphere: Sphere, look: Look) {
        self.push_entry(Entry::of_ball(sphere, look));
    }

    /// Adds what stands in a list.
    pub(crate) fn append(&mut self, entries: Vec<Entry>) {
        let mut entries = entries.into_iter();
        while let Some(next) = entries.next() {
            self.push_entry(next);
            if let Some(piece) = self.pieces.last_mut() {
                let room = PIECE.saturating_sub(piece.len());
                piece.extend(entries.by_ref().take(room));
            }
        }
    }

    fn push_entry(&mut self, entry: Entry) {
        match self.pieces.last_mut() {
            Some(piece) if piece.len() < PIECE => piece.push(entry),
            _ => {
                let room = if self.pieces.is_empty() { 4 } else { PIECE };
                let mut piece = Vec::with_capacity(room);
                piece.push(entry);
                self.pieces.push(piece);
            }
        }
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        let full = self.pieces.len().saturating_sub(1) * PIECE;
        full + self.pieces.last().map_or(0, Vec::len)
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = Arc<Object>> + Clone {
        self.entries().map(|entry| entry.clone().into_object())
    }

    /// All of them, each let go before the next.
    pub fn one_by_one(self) -> impl Iterator<Item = Arc<Object>> {
        self.pieces.into_iter().flatten().map(Entry::into_object)
    }

    /// All of them, in pieces of which all but the last are of a size, and this size.
    pub(crate) fn into_pieces(self) -> (Vec<Vec<Entry>>, usize) {
        (self.pieces, PIECE)
    }

    /// Those that are more than plain shapes, or may be: all others have neither parts nor lights nor an interior.
    pub(crate) fn whole(&self) -> impl Iterator<Item = &Arc<Object>> {
        self.entries().filter_map(Entry::whole)
    }

    /// The textures of the others, those of one colour left out.
    pub(crate) fn textures_of_plain(&self) -> impl Iterator<Item = &Arc<Texture>> {
        self.entries().filter_map(|entry| match entry {
            Entry::TexturedBall { texture, .. } | Entry::Textured { texture, .. } => Some(texture),
            _ => None,
        })
    }

    /// The finishes of those of one colour.
    pub(crate) fn finishes_of_plain(&self) -> impl Iterator<Item = &Arc<Finish>> {
        self.entries().filter_map(|entry| match entry {
            Entry::Ball { finish, .. }
            | Entry::Colored { finish, .. }
            | Entry::Moved { finish, .. } => Some(finish),
            _ => None,
        })
    }

    fn entries(&self) -> impl Iterator<Item = &Entry> + Clone {
        self.pieces.iter().flatten()
    }
}

impl FromIterator<Arc<Object>> for Objects {
    fn from_iter<T: IntoIterator<Item = Arc<Object>>>(all: T) -> Self {
        let mut objects = Objects::default();
        for object in all {
            objects.push(object);
        }
        objects
    }
}

impl From<Arc<Object>> for Entry {
    fn from(object: Arc<Object>) -> Self {
        match plain_parts(&object) {
            Some((shape, look)) if object.steps.is_empty() => match &**shape {
                Shape::Sphere(sphere) => Entry::of_ball(*sphere, look),
                _ => Entry::of_shape(Arc::clone(shape), look),
            },
            Some((shape, Look::Color(color, finish))) => Entry::Moved {
                shape: Arc::clone(shape),
                color,
                finish,
                steps: object.steps.as_slice().into(),
            },
            _ => Entry::Whole(object),
        }
    }
}

impl From<Plain> for Entry {
    fn from(Plain { shape, look }: Plain) -> Self {
        match shape {
            Shape::Sphere(sphere) => Entry::of_ball(sphere, look),
            shape => Entry::of_shape(Arc::new(shape), look),
        }
    }
}

impl Entry {
    /// The object, if it is more than a plain shape, or may be.
    pub(crate) fn whole(&self) -> Option<&Arc<Object>> {
        match self {
            Entry::Whole(object) => Some(object),
            _ => None,
        }
    }

    fn of_ball(sphere: Sphere, look: Look) -> Self {
        match look {
            Look::Color(color, finish) => Entry::Ball {
                sphere,
                color,
                finish,
            },
            Look::Texture(texture) => Entry::TexturedBall { sphere, texture },
        }
    }

    fn of_shape(shape: Arc<Shape>, look: Look) -> Self {
        match look {
            Look::Color(color, finish) => Entry::Colored {
                shape,
                color,
                finish,
            },
            Look::Texture(texture) => Entry::Textured { shape, texture },
        }
    }

    /// It as a ball of one colour, if it is one.
    pub(crate) fn ball(&self) -> Option<Sphere> {
        match self {
            Entry::Ball { sphere, .. } => Some(*sphere),
            _ => None,
        }
    }

    /// The colour and finish of a shape of one colour, if it is one.
    pub(crate) fn looks(&self) -> Option<(Color, &Arc<Finish>)> {
        match self {
            Entry::Ball { color, finish, .. }
            | Entry::Colored { color, finish, .. }
            | Entry::Moved { color, finish, .. } => Some((*color, finish)),
            _ => None,
        }
    }

    /// It as a shape of one colour, if it is one.
    pub(crate) fn colored(&self) -> Option<Colored<'_>> {
        let (shape, finish, steps) = match self {
            Entry::Ball { sphere, finish, .. } => {
                (Cow::Owned(Shape::Sphere(*sphere)), finish, &[][..])
            }
            Entry::Colored { shape, finish, .. } => (Cow::Borrowed(&**shape), finish, &[][..]),
            Entry::Moved {
                shape,
                finish,
                steps,
                ..
            } => (Cow::Borrowed(&**shape), finish, &**steps),
            _ => return None,
        };
        Some(Colored {
            shape,
            finish,
            steps,
        })
    }

    /// The object, taken out.
    pub(crate) fn taken(self) -> Taken {
        match self {
            Entry::Ball {
                sphere,
                color,
                finish,
            } => Taken::Colored(Shape::Sphere(sphere), color, finish),
            Entry::Colored {
                shape,
                color,
                finish,
            } => Taken::Colored(Arc::unwrap_or_clone(shape), color, finish),
            other => Taken::Object(other.into_object()),
        }
    }

    fn into_object(self) -> Arc<Object> {
        let ball = |sphere| Arc::new(Shape::Sphere(sphere));
        let (shape, look) = match self {
            Entry::Whole(object) => return object,
            Entry::Ball {
                sphere,
                color,
                finish,
            } => (ball(sphere), Look::Color(color, finish)),
            Entry::TexturedBall { sphere, texture } => (ball(sphere), Look::Texture(texture)),
            Entry::Colored {
                shape,
                color,
                finish,
            } => (shape, Look::Color(color, finish)),
            Entry::Textured { shape, texture } => (shape, Look::Texture(texture)),
            Entry::Moved {
                shape,
                color,
                finish,
                steps,
            } => {
                let mut object = object_of(shape, Look::Color(color, finish));
                object.steps = steps.into_vec();
                return Arc::new(object);
            }
        };
        Arc::new(object_of(shape, look))
    }
}

impl From<Plain> for Object {
    fn from(plain: Plain) -> Self {
        object_of(Arc::new(plain.shape), plain.look)
    }
}

fn object_of(shape: Arc<Shape>, look: Look) -> Object {
    let texture = match look {
        Look::Texture(texture) => texture,
        Look::Color(color, finish) => Arc::new(Texture::from(Layer::colored(color, finish))),
    };
    let mut object = Object::new(Kind::Shape(shape));
    object.texture = Some(object.attach(texture));
    object
}

/// The shape and the looks of an object that has nothing else but transforms. Those do not move a colour.
fn plain_parts(object: &Object) -> Option<(&Arc<Shape>, Look)> {
    let Kind::Shape(shape) = &object.kind else {
        return None;
    };
    let Attached {
        what: texture,
        after,
    } = object.plain_texture()?;
    // What others have as well is kept once.
    if Arc::strong_count(texture) == 1
        && let Some((color, finish)) = texture.bare()
    {
        return Some((shape, Look::Color(color, Arc::clone(finish))));
    }
    (*after == 0).then(|| (shape, Look::Texture(Arc::clone(texture))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn ball(x: f64) -> Shape {
        Shape::Sphere(Sphere {
            centre: DVec3::X * x,
            radius: 1.0,
        })
    }

    fn red() -> Look {
        Look::Color(
            Color::from_components([1.0, 0.0, 0.0, 0.25, 0.5]),
            Arc::default(),
        )
    }

    fn told(object: &Object) -> String {
        format!("{object:?}")
    }

    #[test]
    fn an_entry_of_a_ball_takes_64_bytes() {
        assert_eq!(size_of::<Entry>(), 64);
    }

    #[test]
    fn plain_objects_come_out_as_they_went_in() {
        let texture = Arc::new(Texture::from(Layer::default()));
        let shared = Look::Texture(Arc::clone(&texture));
        let disc = Shape::read(
            crate::base::args::Word::Disc,
            &mut crate::base::args::text::TextArgs::new("0, <0, 1, 0>, 1 }"),
        );
        let mut objects = Objects::default();
        let mut expected = Vec::new();
        for shape in [ball(1.0), disc.unwrap().unwrap()] {
            for look in [red(), shared.clone()] {
                let plain = Plain {
                    shape: shape.clone(),
                    look,
                };
                let object = Object::from(plain.clone());
                expected.push(told(&object));
                expected.push(told(&object));
                objects.push_plain(plain);
                objects.push(Arc::new(object));
            }
        }
        let made: Vec<String> = objects.iter().map(|object| told(&object)).collect();
        assert_eq!(made, expected);
        assert_eq!(objects.whole().count(), 0);
        assert_eq!(objects.one_by_one().count(), 8);
    }

    #[test]
    fn an_object_with_more_to_it_stays_whole() {
        let plain = || {
            Object::from(Plain {
                shape: ball(0.0),
                look: red(),
            })
        };
        let changes: [fn(&mut Object); 4] = [
            |object| object.is_inverse = true,
            |object| object.flags.hollow = Some(false),
            |object| object.interior = Some(Arc::default()),
            |object| object.texture = None,
        ];
        for change in changes {
            let mut objects = Objects::default();
            let mut object = plain();
            change(&mut object);
            objects.push(Arc::new(object));
            assert_eq!(objects.whole().count(), 1);
        }
    }

    #[test]
    fn a_moved_shape_of_one_colour_is_kept_small_and_comes_out_as_it_went_in() {
        let moved = |look: Look| {
            let shape = ball(1.0);
            let mut object = Object::from(Plain { shape, look });
            object.steps = vec![Step::Rotate(DVec3::X), Step::Translate(DVec3::Y)];
            object
        };
        let object = moved(red());
        let expected = told(&object);
        let mut objects = Objects::default();
        objects.push(Arc::new(object));
        assert_eq!(objects.whole().count(), 0);
        let out: Vec<String> = objects.iter().map(|out| told(&out)).collect();
        assert_eq!(out, [expected]);
        // A texture that others have as well is kept as it is.
        let texture = Arc::new(Texture::from(Layer::default()));
        let shared = moved(Look::Texture(Arc::clone(&texture)));
        objects.push(Arc::new(shared));
        assert_eq!(objects.whole().count(), 1);
    }

    #[test]
    fn they_are_counted_over_all_pieces() {
        let shape = ball(0.0);
        let plain = || Plain {
            shape: shape.clone(),
            look: red(),
        };
        let mut objects = Objects::default();
        assert!(objects.is_empty());
        for count in 1..=2 * PIECE + 3 {
            objects.push_plain(plain());
            assert_eq!(objects.len(), count);
        }
        let more = vec![Entry::from(plain()); PIECE + 10];
        objects.append(more);
        assert_eq!(objects.len(), 3 * PIECE + 13);
        assert_eq!(objects.iter().count(), objects.len());
    }
}

//! The objects of a scene, in a compact list.
//!
//! Programs write scenes of millions of objects, most of them a shape and its colour. Such an object is stored as these
//! two, and converted to an [`Object`] on demand.

use super::{Attached, Kind, Object};
use crate::base::color::Color;
use crate::base::math::Step;
use crate::scene::shape::{Shape, Sphere};
use crate::scene::texture::{Finish, Layer, Texture};
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Objects per chunk. Chunks are freed one by one while their objects are consumed.
const CHUNK: usize = 4096;

/// The objects of a scene, in file order.
#[derive(Clone, Debug, Default)]
pub struct Objects {
    /// All but the last chunk are full.
    chunks: Vec<Vec<Entry>>,
}

/// A shape with a material, without transforms or other attributes.
#[derive(Clone, Debug)]
pub struct PlainObject {
    /// The shape.
    pub shape: Shape,
    /// The material.
    pub look: ColorOrTexture,
}

/// Material of a [`PlainObject`] object.
#[derive(Clone, Debug)]
pub enum ColorOrTexture {
    /// A single colour.
    Color(Color, Arc<Finish>),
    /// A texture.
    Texture(Arc<Texture>),
}

/// An object removed from the list.
#[derive(Debug)]
pub(crate) enum OwnedObject {
    /// A shape of a single colour, without transforms or other attributes.
    Colored(Shape, Color, Arc<Finish>),
    /// Any other object.
    Object(Arc<Object>),
}

/// An object as stored in the list. Spheres are stored inline, because there may be millions of them.
#[derive(Clone, Debug)]
pub(crate) enum Entry {
    Whole(Arc<Object>),
    Sphere {
        sphere: Sphere,
        color: Color,
        finish: Arc<Finish>,
    },
    TexturedSphere {
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

/// A shape of a single colour and its transforms.
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
    pub fn push_plain(&mut self, plain: PlainObject) {
        self.push_entry(plain.into());
    }

    /// Adds one object for each index below `count`: like `model` in everything except its shape, and its colour where
    /// there are `colors`. A colour replaces the pigment of the top layer of the texture. All threads make them, each in
    /// the order of the indices.
    pub fn extend_like(
        &mut self,
        model: &Object,
        count: usize,
        shape: impl Fn(usize) -> Shape + Sync,
        colors: Option<&(dyn Fn(usize) -> Color + Sync)>,
    ) {
        let model = Model::of(model);
        let entries: Vec<Entry> = (0..count)
            .into_par_iter()
            .with_min_len(CHUNK)
            .map(|index| model.entry(shape(index), colors.map(|color| color(index))))
            .collect();
        self.append(entries);
    }

    /// Removes the last object and returns it.
    pub fn pop(&mut self) -> Option<Arc<Object>> {
        let chunk = self.chunks.last_mut()?;
        let last = chunk.pop();
        if chunk.is_empty() {
            self.chunks.pop();
        }
        last.map(Entry::into_object)
    }

    /// Adds a sphere.
    #[inline]
    pub(crate) fn push_sphere(&mut self, sphere: Sphere, look: ColorOrTexture) {
        self.push_entry(Entry::from_sphere(sphere, look));
    }

    /// Appends a list of entries.
    pub(crate) fn append(&mut self, entries: Vec<Entry>) {
        let mut entries = entries.into_iter();
        while let Some(next) = entries.next() {
            self.push_entry(next);
            if let Some(chunk) = self.chunks.last_mut() {
                let free = CHUNK.saturating_sub(chunk.len());
                chunk.extend(entries.by_ref().take(free));
            }
        }
    }

    fn push_entry(&mut self, entry: Entry) {
        match self.chunks.last_mut() {
            Some(chunk) if chunk.len() < CHUNK => chunk.push(entry),
            _ => {
                let capacity = if self.chunks.is_empty() { 4 } else { CHUNK };
                let mut chunk = Vec::with_capacity(capacity);
                chunk.push(entry);
                self.chunks.push(chunk);
            }
        }
    }

    /// Number of objects.
    #[must_use]
    pub fn len(&self) -> usize {
        let full = self.chunks.len().saturating_sub(1) * CHUNK;
        full + self.chunks.last().map_or(0, Vec::len)
    }

    /// Returns true if there are no objects.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.chunks.is_empty()
    }

    /// All objects, converted on the fly.
    pub fn iter(&self) -> impl Iterator<Item = Arc<Object>> + Clone {
        self.entries().map(|entry| entry.clone().into_object())
    }

    /// All objects by value; each can be dropped before the next is converted.
    pub fn into_objects(self) -> impl Iterator<Item = Arc<Object>> {
        self.chunks.into_iter().flatten().map(Entry::into_object)
    }

    /// The chunks, and the size of all but the last.
    pub(crate) fn into_chunks(self) -> (Vec<Vec<Entry>>, usize) {
        (self.chunks, CHUNK)
    }

    /// The objects that may be more than plain shapes. All others have no parts, lights or interior.
    pub(crate) fn whole(&self) -> impl Iterator<Item = &Arc<Object>> {
        self.entries().filter_map(Entry::whole)
    }

    /// The textures of plain shapes, without those of a single colour.
    pub(crate) fn textures_of_plain(&self) -> impl Iterator<Item = &Arc<Texture>> {
        self.entries().filter_map(|entry| match entry {
            Entry::TexturedSphere { texture, .. } | Entry::Textured { texture, .. } => {
                Some(texture)
            }
            _ => None,
        })
    }

    /// The finishes of shapes of a single colour.
    pub(crate) fn finishes_of_plain(&self) -> impl Iterator<Item = &Arc<Finish>> {
        self.entries().filter_map(|entry| match entry {
            Entry::Sphere { finish, .. }
            | Entry::Colored { finish, .. }
            | Entry::Moved { finish, .. } => Some(finish),
            _ => None,
        })
    }

    pub(super) fn entries(&self) -> impl Iterator<Item = &Entry> + Clone {
        self.chunks.iter().flatten()
    }
}

/// The common part of the objects of [`Objects::extend_like`].
enum Model<'a> {
    /// A shape of one colour, without transforms or other attributes.
    Colored(Color, Arc<Finish>),
    /// Any other object.
    Object(&'a Object),
}

impl Model<'_> {
    fn of(object: &Object) -> Model<'_> {
        match plain_parts(object) {
            Some((_, ColorOrTexture::Color(color, finish))) if object.steps.is_empty() => {
                Model::Colored(color, finish)
            }
            _ => Model::Object(object),
        }
    }

    fn entry(&self, shape: Shape, color: Option<Color>) -> Entry {
        match self {
            Model::Colored(own, finish) => Entry::from(PlainObject {
                shape,
                look: ColorOrTexture::Color(color.unwrap_or(*own), Arc::clone(finish)),
            }),
            Model::Object(object) => {
                Entry::from(Arc::new(object.with_shape_and_color(shape, color)))
            }
        }
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
                Shape::Sphere(sphere) => Entry::from_sphere(*sphere, look),
                _ => Entry::from_shape(Arc::clone(shape), look),
            },
            Some((shape, ColorOrTexture::Color(color, finish))) => Entry::Moved {
                shape: Arc::clone(shape),
                color,
                finish,
                steps: object.steps.as_slice().into(),
            },
            _ => Entry::Whole(object),
        }
    }
}

impl From<PlainObject> for Entry {
    fn from(PlainObject { shape, look }: PlainObject) -> Self {
        match shape {
            Shape::Sphere(sphere) => Entry::from_sphere(sphere, look),
            shape => Entry::from_shape(Arc::new(shape), look),
        }
    }
}

impl Entry {
    /// The object, if it may be more than a plain shape.
    pub(crate) fn whole(&self) -> Option<&Arc<Object>> {
        match self {
            Entry::Whole(object) => Some(object),
            _ => None,
        }
    }

    fn from_sphere(sphere: Sphere, look: ColorOrTexture) -> Self {
        match look {
            ColorOrTexture::Color(color, finish) => Entry::Sphere {
                sphere,
                color,
                finish,
            },
            ColorOrTexture::Texture(texture) => Entry::TexturedSphere { sphere, texture },
        }
    }

    fn from_shape(shape: Arc<Shape>, look: ColorOrTexture) -> Self {
        match look {
            ColorOrTexture::Color(color, finish) => Entry::Colored {
                shape,
                color,
                finish,
            },
            ColorOrTexture::Texture(texture) => Entry::Textured { shape, texture },
        }
    }

    /// The sphere, for a sphere of a single colour.
    pub(crate) fn sphere(&self) -> Option<Sphere> {
        match self {
            Entry::Sphere { sphere, .. } => Some(*sphere),
            _ => None,
        }
    }

    /// The colour and finish, for a shape of a single colour.
    pub(crate) fn color_and_finish(&self) -> Option<(Color, &Arc<Finish>)> {
        match self {
            Entry::Sphere { color, finish, .. }
            | Entry::Colored { color, finish, .. }
            | Entry::Moved { color, finish, .. } => Some((*color, finish)),
            _ => None,
        }
    }

    /// The entry as a shape of a single colour, if it is one.
    pub(crate) fn colored(&self) -> Option<Colored<'_>> {
        let (shape, finish, steps) = match self {
            Entry::Sphere { sphere, finish, .. } => {
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

    /// The object by value.
    pub(crate) fn into_owned(self) -> OwnedObject {
        match self {
            Entry::Sphere {
                sphere,
                color,
                finish,
            } => OwnedObject::Colored(Shape::Sphere(sphere), color, finish),
            Entry::Colored {
                shape,
                color,
                finish,
            } => OwnedObject::Colored(Arc::unwrap_or_clone(shape), color, finish),
            other => OwnedObject::Object(other.into_object()),
        }
    }

    pub(super) fn into_object(self) -> Arc<Object> {
        let sphere_shape = |sphere| Arc::new(Shape::Sphere(sphere));
        let (shape, look) = match self {
            Entry::Whole(object) => return object,
            Entry::Sphere {
                sphere,
                color,
                finish,
            } => (sphere_shape(sphere), ColorOrTexture::Color(color, finish)),
            Entry::TexturedSphere { sphere, texture } => {
                (sphere_shape(sphere), ColorOrTexture::Texture(texture))
            }
            Entry::Colored {
                shape,
                color,
                finish,
            } => (shape, ColorOrTexture::Color(color, finish)),
            Entry::Textured { shape, texture } => (shape, ColorOrTexture::Texture(texture)),
            Entry::Moved {
                shape,
                color,
                finish,
                steps,
            } => {
                let mut object = object_of(shape, ColorOrTexture::Color(color, finish));
                object.steps = steps.into_vec();
                return Arc::new(object);
            }
        };
        Arc::new(object_of(shape, look))
    }
}

impl From<PlainObject> for Object {
    fn from(plain: PlainObject) -> Self {
        object_of(Arc::new(plain.shape), plain.look)
    }
}

fn object_of(shape: Arc<Shape>, look: ColorOrTexture) -> Object {
    let texture = match look {
        ColorOrTexture::Texture(texture) => texture,
        ColorOrTexture::Color(color, finish) => {
            Arc::new(Texture::from(Layer::colored(color, finish)))
        }
    };
    let mut object = Object::new(Kind::Shape(shape));
    object.texture = Some(object.attach(texture));
    object
}

/// The shape and material of an object without other properties except transforms, which do not affect a single colour.
fn plain_parts(object: &Object) -> Option<(&Arc<Shape>, ColorOrTexture)> {
    let Kind::Shape(shape) = &object.kind else {
        return None;
    };
    let Attached {
        what: texture,
        after,
    } = object.plain_texture()?;
    // A shared texture stays shared.
    if Arc::strong_count(texture) == 1
        && let Some((color, finish)) = texture.bare()
    {
        return Some((shape, ColorOrTexture::Color(color, Arc::clone(finish))));
    }
    (*after == 0).then(|| (shape, ColorOrTexture::Texture(Arc::clone(texture))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn sphere(x: f64) -> Shape {
        Shape::Sphere(Sphere {
            centre: DVec3::X * x,
            radius: 1.0,
        })
    }

    fn red() -> ColorOrTexture {
        ColorOrTexture::Color(
            Color::from_components([1.0, 0.0, 0.0, 0.25, 0.5]),
            Arc::default(),
        )
    }

    fn debug_text(object: &Object) -> String {
        format!("{object:?}")
    }

    #[test]
    fn a_sphere_entry_takes_64_bytes() {
        assert_eq!(size_of::<Entry>(), 64);
    }

    #[test]
    fn plain_objects_are_stored_unchanged() {
        let texture = Arc::new(Texture::from(Layer::default()));
        let shared = ColorOrTexture::Texture(Arc::clone(&texture));
        let disc = Shape::read(
            crate::base::args::Word::Disc,
            &mut crate::base::args::text::TextArgs::new("0, <0, 1, 0>, 1 }"),
        );
        let mut objects = Objects::default();
        let mut expected = Vec::new();
        for shape in [sphere(1.0), disc.unwrap().unwrap()] {
            for look in [red(), shared.clone()] {
                let plain = PlainObject {
                    shape: shape.clone(),
                    look,
                };
                let object = Object::from(plain.clone());
                expected.push(debug_text(&object));
                expected.push(debug_text(&object));
                objects.push_plain(plain);
                objects.push(Arc::new(object));
            }
        }
        let made: Vec<String> = objects.iter().map(|object| debug_text(&object)).collect();
        assert_eq!(made, expected);
        assert_eq!(objects.whole().count(), 0);
        assert_eq!(objects.into_objects().count(), 8);
    }

    #[test]
    fn an_object_with_more_to_it_stays_whole() {
        let plain = || {
            Object::from(PlainObject {
                shape: sphere(0.0),
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
    fn a_transformed_shape_of_one_colour_is_stored_compactly_and_unchanged() {
        let moved = |look: ColorOrTexture| {
            let shape = sphere(1.0);
            let mut object = Object::from(PlainObject { shape, look });
            object.steps = vec![Step::Rotate(DVec3::X), Step::Translate(DVec3::Y)];
            object
        };
        let object = moved(red());
        let expected = debug_text(&object);
        let mut objects = Objects::default();
        objects.push(Arc::new(object));
        assert_eq!(objects.whole().count(), 0);
        let out: Vec<String> = objects.iter().map(|out| debug_text(&out)).collect();
        assert_eq!(out, [expected]);
        // An entry with a shared texture stays an object.
        let texture = Arc::new(Texture::from(Layer::default()));
        let shared = moved(ColorOrTexture::Texture(Arc::clone(&texture)));
        objects.push(Arc::new(shared));
        assert_eq!(objects.whole().count(), 1);
    }

    #[test]
    fn objects_like_another_differ_in_shape_and_colour() {
        let color =
            |index: usize| Color::from_components([0.1, 0.0, 0.0, 0.0, f64::from(index == 1)]);
        let center = |index: usize| sphere(if index == 1 { 5.0 } else { 0.0 });
        let plain = || {
            Object::from(PlainObject {
                shape: sphere(0.0),
                look: red(),
            })
        };
        let mut moved = plain();
        moved.steps = vec![Step::Translate(DVec3::Y)];
        moved.flags.no_shadow = true;
        for model in [plain(), moved] {
            for colors in [None, Some(&color as &(dyn Fn(usize) -> Color + Sync))] {
                let mut objects = Objects::default();
                objects.extend_like(&model, 3, center, colors);
                for (index, object) in objects.iter().enumerate() {
                    let mut expected = model.clone();
                    expected.kind = Kind::Shape(Arc::new(center(index)));
                    if let (Some(color), Some(texture)) = (colors, &mut expected.texture) {
                        texture.what = Arc::new(texture.what.with_color(color(index)));
                    }
                    assert_eq!(debug_text(&object), debug_text(&expected));
                }
            }
        }
    }

    #[test]
    fn objects_are_counted_over_all_chunks() {
        let shape = sphere(0.0);
        let plain = || PlainObject {
            shape: shape.clone(),
            look: red(),
        };
        let mut objects = Objects::default();
        assert!(objects.is_empty());
        for count in 1..=2 * CHUNK + 3 {
            objects.push_plain(plain());
            assert_eq!(objects.len(), count);
        }
        let more = vec![Entry::from(plain()); CHUNK + 10];
        objects.append(more);
        assert_eq!(objects.len(), 3 * CHUNK + 13);
        assert_eq!(objects.iter().count(), objects.len());
    }
}

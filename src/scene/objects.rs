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
use std::ops::Deref;
use std::sync::Arc;

/// Objects per chunk. Chunks are freed one by one while their objects are consumed.
const CHUNK: usize = 4096;

/// The objects of a scene, in file order.
#[derive(Clone, Debug, Default)]
pub struct Objects {
    chunks: Vec<Chunk>,
    len: usize,
}

/// Successive objects.
#[derive(Clone, Debug)]
enum Chunk {
    Own(Vec<Entry>),
    /// Those that are in other lists too.
    Shared(SharedEntries),
}

/// Objects that several lists share.
#[derive(Clone, Debug)]
pub(crate) struct SharedEntries {
    entries: Arc<[Entry]>,
    has_whole: bool,
    has_textures: bool,
}

impl From<Vec<Entry>> for SharedEntries {
    fn from(entries: Vec<Entry>) -> Self {
        let mut has_textures = entries.iter().map(|entry| entry.texture().is_some());
        SharedEntries {
            has_textures: has_textures.any(|has_texture| has_texture),
            has_whole: entries.iter().any(|entry| entry.whole().is_some()),
            entries: entries.into(),
        }
    }
}

impl Deref for SharedEntries {
    type Target = [Entry];

    fn deref(&self) -> &[Entry] {
        &self.entries
    }
}

impl SharedEntries {
    /// True if some may be more than plain shapes.
    pub(crate) fn has_whole(&self) -> bool {
        self.has_whole
    }
}

impl Deref for Chunk {
    type Target = [Entry];

    fn deref(&self) -> &[Entry] {
        match self {
            Chunk::Own(entries) => entries,
            Chunk::Shared(shared) => shared,
        }
    }
}

impl Chunk {
    fn into_entries(self) -> Vec<Entry> {
        match self {
            Chunk::Own(entries) => entries,
            Chunk::Shared(shared) => shared.to_vec(),
        }
    }
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
        let mut entries = self.chunks.pop()?.into_entries();
        let last = entries.pop();
        self.len -= usize::from(last.is_some());
        if !entries.is_empty() {
            self.chunks.push(Chunk::Own(entries));
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
            if let Some(Chunk::Own(chunk)) = self.chunks.last_mut() {
                let before = chunk.len();
                let free = CHUNK.saturating_sub(before);
                chunk.extend(entries.by_ref().take(free));
                self.len += chunk.len() - before;
            }
        }
    }

    /// Appends entries that stay in other lists too.
    pub(crate) fn append_shared(&mut self, entries: &SharedEntries) {
        if !entries.is_empty() {
            self.len += entries.len();
            self.chunks.push(Chunk::Shared(entries.clone()));
        }
    }

    fn push_entry(&mut self, entry: Entry) {
        self.len += 1;
        match self.chunks.last_mut() {
            Some(Chunk::Own(chunk)) if chunk.len() < CHUNK => chunk.push(entry),
            _ => {
                let capacity = if self.chunks.is_empty() { 4 } else { CHUNK };
                let mut chunk = Vec::with_capacity(capacity);
                chunk.push(entry);
                self.chunks.push(Chunk::Own(chunk));
            }
        }
    }

    /// Number of objects.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
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
        let entries = self.chunks.into_iter().flat_map(Chunk::into_entries);
        entries.map(Entry::into_object)
    }

    /// The objects in chunks, and the size of all but the last.
    pub(crate) fn into_chunks(self) -> (Vec<Vec<Entry>>, usize) {
        let before_last = self.chunks.len().saturating_sub(1);
        let mut others = self.chunks.iter().take(before_last);
        let is_regular = others.all(|chunk| matches!(chunk, Chunk::Own(own) if own.len() == CHUNK));
        let last = self.chunks.last().map_or(0, |chunk| chunk.iter().len());
        if is_regular && last <= CHUNK {
            let chunks = self.chunks.into_iter().map(Chunk::into_entries);
            return (chunks.collect(), CHUNK);
        }
        let mut chunks: Vec<Vec<Entry>> = Vec::with_capacity(self.len.div_ceil(CHUNK));
        for entry in self.chunks.into_iter().flat_map(Chunk::into_entries) {
            match chunks.last_mut() {
                Some(chunk) if chunk.len() < CHUNK => chunk.push(entry),
                _ => {
                    let mut chunk = Vec::with_capacity(CHUNK);
                    chunk.push(entry);
                    chunks.push(chunk);
                }
            }
        }
        (chunks, CHUNK)
    }

    /// The objects that may be more than plain shapes. All others have no parts, lights or interior.
    pub(crate) fn whole(&self) -> impl Iterator<Item = &Arc<Object>> {
        let some_in = |chunk: &&Chunk| !matches!(chunk, Chunk::Shared(shared) if !shared.has_whole);
        let chunks = self.chunks.iter().filter(some_in);
        chunks
            .flat_map(|chunk| chunk.iter())
            .filter_map(Entry::whole)
    }

    /// The textures of plain shapes, without those of a single colour.
    pub(crate) fn textures_of_plain(&self) -> impl Iterator<Item = &Arc<Texture>> {
        let some_in =
            |chunk: &&Chunk| !matches!(chunk, Chunk::Shared(shared) if !shared.has_textures);
        let chunks = self.chunks.iter().filter(some_in);
        chunks
            .flat_map(|chunk| chunk.iter())
            .filter_map(Entry::texture)
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
        self.chunks.iter().flat_map(|chunk| chunk.iter())
    }

    /// Visits the pairs of the entries of two lists of the same length, with their indices, without those that the lists
    /// share, until `visit` returns false. Returns true if it never does.
    pub(super) fn unshared_pairs<'a>(
        &'a self,
        other: &'a Objects,
        mut visit: impl FnMut(usize, &'a Entry, &'a Entry) -> bool,
    ) -> bool {
        let (mut own, mut others) = (Position::of(self), Position::of(other));
        let mut index = 0;
        while let (Some(a), Some(b)) = (own.rest(), others.rest()) {
            let count = a.len().min(b.len());
            // A rest that two chunks share lies at the same addresses.
            if !std::ptr::eq(a.as_ptr(), b.as_ptr()) {
                for (at, (a, b)) in (index..).zip(a.iter().zip(b)).take(count) {
                    if !visit(at, a, b) {
                        return false;
                    }
                }
            }
            own.skip(count);
            others.skip(count);
            index += count;
        }
        true
    }
}

/// A position between two entries of a list.
struct Position<'a> {
    chunks: std::slice::Iter<'a, Chunk>,
    rest: &'a [Entry],
}

impl<'a> Position<'a> {
    fn of(objects: &'a Objects) -> Self {
        Position {
            chunks: objects.chunks.iter(),
            rest: &[],
        }
    }

    /// The next entries of the list, at least one; `None` at its end.
    fn rest(&mut self) -> Option<&'a [Entry]> {
        while self.rest.is_empty() {
            self.rest = self.chunks.next()?;
        }
        Some(self.rest)
    }

    fn skip(&mut self, count: usize) {
        self.rest = &self.rest[count..];
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

    /// The texture, for a plain shape that has one.
    fn texture(&self) -> Option<&Arc<Texture>> {
        match self {
            Entry::TexturedSphere { texture, .. } | Entry::Textured { texture, .. } => {
                Some(texture)
            }
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
mod tests;

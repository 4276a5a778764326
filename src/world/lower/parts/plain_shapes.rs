//! Shapes of one colour each, before they become primitives.

use crate::base::color::Color;
use crate::base::memory::prefetch;
use crate::scene::shape::Sphere;
use crate::scene::texture::{Finish, PreparedTexture};
use crate::scene::{Colored, Entry};
use crate::world::interiors::InteriorId;
use crate::world::lights::LightList;
use crate::world::surface::flags::ObjectFlags;
use crate::world::surface::{OwnedOrShared, Surface};
use rayon::prelude::*;
use std::ptr;
use std::sync::Arc;

/// Shapes of one colour each, in chunks that have the same size except for the last.
#[derive(Debug)]
pub(crate) struct PlainShapes {
    pub(crate) pieces: Vec<Vec<Entry>>,
    /// Logarithm (base 2) of the chunk size; a single chunk may be smaller.
    pub(crate) log_size: u32,
}

/// Per-thread template for surfaces that differ only in colour. Each thread has its own copy of the finish, since
/// contention on a shared reference count would serialise the threads.
#[derive(Default)]
pub(crate) struct SurfaceTemplate {
    /// Address of the last finish seen.
    pub(crate) seen: usize,
    pub(crate) finish: Arc<Finish>,
    /// Surfaces with this finish: in an opaque colour, and in a transmissive one.
    pub(crate) known: [Option<Surface>; 2],
}

impl PlainShapes {
    /// Takes chunks whose size is a power of two, or a single chunk.
    pub(crate) fn new(pieces: Vec<Vec<Entry>>, size: usize) -> Self {
        debug_assert!(pieces.len() == 1 || size.is_power_of_two());
        PlainShapes {
            pieces,
            log_size: size.next_power_of_two().trailing_zeros(),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.pieces.iter().map(Vec::len).sum()
    }

    pub(crate) fn entry(&self, at: usize) -> &Entry {
        let piece = at >> self.log_size;
        &self.pieces[piece][at - (piece << self.log_size)]
    }

    /// The object at an index.
    pub(crate) fn object(&self, at: usize) -> Colored<'_> {
        let colored = self.entry(at).colored();
        colored.expect("it was found to be of one colour")
    }

    /// The object at an index, if it is a sphere.
    pub(crate) fn sphere(&self, at: usize) -> Option<Sphere> {
        self.entry(at).sphere()
    }

    /// Prefetches the object at an index.
    #[inline]
    pub(crate) fn expect(&self, at: usize) {
        prefetch(self.entry(at));
    }

    pub(crate) fn has_only_spheres(&self) -> bool {
        let is_sphere = |entry: &Entry| entry.sphere().is_some();
        let pieces = self.pieces.par_iter();
        pieces.all(|piece| piece.iter().all(is_sphere))
    }

    /// Frees them in parallel.
    pub(crate) fn free(self) {
        self.pieces.into_par_iter().for_each(drop);
    }
}

impl SurfaceTemplate {
    /// The surface of the shape at an index.
    #[inline]
    pub(crate) fn surface_at(
        &mut self,
        shapes: &PlainShapes,
        at: usize,
        interior: InteriorId,
    ) -> Surface {
        let attributes = shapes.entry(at).color_and_finish();
        let (color, finish) = attributes.expect("it was found to be of one colour");
        self.surface(color, finish, interior)
    }

    /// The surface with this colour and finish.
    #[inline]
    pub(crate) fn surface(
        &mut self,
        color: Color,
        finish: &Arc<Finish>,
        interior: InteriorId,
    ) -> Surface {
        let address = ptr::from_ref(&**finish).addr();
        if self.seen != address {
            self.seen = address;
            if *self.finish != **finish {
                self.finish = Arc::new((**finish).clone());
                self.known = [None, None];
            }
        }
        let known = &mut self.known[usize::from(color.is_transparent())];
        let like = known.get_or_insert_with(|| {
            let texture = PreparedTexture::colored(color, Arc::clone(&self.finish));
            Surface::new(
                OwnedOrShared::Own(texture),
                None,
                Box::default(),
                interior,
                LightList::default(),
                ObjectFlags::default(),
            )
        });
        let surface = like.in_color(color, interior);
        surface.expect("what is alike is of one colour")
    }
}

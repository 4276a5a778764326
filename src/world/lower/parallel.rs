//! Parallel lowering of runs of top-level shapes of one colour, of which there may be millions.

use super::lowering::Lowering;
use super::parts::model::PendingItem;
use super::parts::plain_shapes::{PlainShapes, SurfaceTemplate};
use crate::base::math::Bounds;
use crate::base::memory;
use crate::scene::shape::Geometry;
use crate::scene::{Colored, Entry, Object, Objects};
use crate::world::index::index;
use crate::world::interiors::InteriorId;
use crate::world::primitive::{Absorb, Extent, Leaf};
use rayon::prelude::*;
use std::mem::take;
use std::sync::Arc;

/// Fewest objects worth parallel lowering.
const MIN_PARALLEL: usize = 64;

/// Number of freed objects from which trimming the heap pays off.
const LARGE: usize = 4096;

impl Lowering {
    /// Lowers all top-level objects; passes each to `drop_object` when it is no longer needed.
    pub(crate) fn lower_all(&mut self, objects: Objects, drop_object: &mut dyn FnMut(Arc<Object>)) {
        let (pieces, size) = objects.into_chunks();
        let suits = |piece: &Vec<Entry>| piece.iter().all(|entry| self.is_plain_entry(entry));
        let suited: Vec<bool> = pieces.par_iter().map(suits).collect();
        let mut pieces = pieces.into_iter().zip(suited).peekable();
        while let Some((piece, is_suited)) = pieces.next() {
            if is_suited {
                let mut shapes = vec![piece];
                while let Some((piece, _)) = pieces.next_if(|(_, is_suited)| *is_suited) {
                    shapes.push(piece);
                }
                self.add_plain_shapes(PlainShapes::new(shapes, size));
                continue;
            }
            let mut run = Vec::new();
            for entry in piece {
                if self.is_plain_entry(&entry) {
                    run.push(entry);
                } else {
                    self.add_run(take(&mut run), drop_object);
                    self.add_one(entry, drop_object);
                }
            }
            self.add_run(run, drop_object);
        }
    }

    fn add_one(&mut self, entry: Entry, drop_object: &mut dyn FnMut(Arc<Object>)) {
        self.note_items(1);
        if let Some(object) = self.take(entry.into_owned()) {
            drop_object(object);
        }
    }

    /// Notes the first items of the next objects, each of which has one unless it is the only one here.
    fn note_items(&mut self, objects: usize) {
        let first = index(self.parts.items.len());
        if let Some(first_items) = &mut self.first_items {
            first_items.extend(first..first + index(objects));
        }
    }

    /// Lowers plain entries: in parallel, if there are enough.
    fn add_run(&mut self, run: Vec<Entry>, drop_object: &mut dyn FnMut(Arc<Object>)) {
        if run.len() < MIN_PARALLEL {
            run.into_iter()
                .for_each(|entry| self.add_one(entry, drop_object));
        } else {
            let size = run.len();
            self.add_plain_shapes(PlainShapes::new(vec![run], size));
        }
    }

    /// Returns true if lowering an object only appends to the lists. Photons need the positions of objects.
    fn is_plain_entry(&self, entry: &Entry) -> bool {
        let is_plain = |Colored { shape, finish, .. }: Colored<'_>| {
            shape.face_textures().is_empty() && !finish.has_interior() && !shape.bounds().is_empty()
        };
        self.targets.is_none() && entry.colored().is_some_and(is_plain)
    }

    fn add_plain_shapes(&mut self, shapes: PlainShapes) {
        self.last_surface = None;
        self.note_items(shapes.len());
        let interior = self.interiors.unnamed_ones(index(shapes.len()));
        if shapes.has_only_spheres() {
            self.add_spheres(shapes, interior);
        } else {
            self.add_shapes(&shapes, interior);
            let is_large = shapes.len() >= LARGE;
            shapes.free();
            if is_large {
                memory::trim_heap();
            }
        }
    }

    /// Adds the shapes, all spheres, as deferred spheres; their interiors start at `interior`.
    fn add_spheres(&mut self, shapes: PlainShapes, interior: InteriorId) {
        let count = index(shapes.len());
        let parts = &mut self.parts;
        let indices = (0..shapes.len()).into_par_iter();
        let bounds = |at| {
            shapes
                .sphere(at)
                .map_or(Bounds::EMPTY, |sphere| sphere.bounds())
        };
        parts.bounds.par_extend(indices.map(bounds));
        let first = parts.spheres.add(shapes, count, interior);
        let spheres = (first..first + count).into_par_iter();
        parts.items.par_extend(spheres.map(PendingItem::Sphere));
    }

    /// Adds the shapes as leaves; their interiors start at `interior`.
    fn add_shapes(&mut self, shapes: &PlainShapes, interior: InteriorId) {
        let surface = index(self.surfaces.len());
        self.add_surfaces(shapes, interior);
        let count = shapes.len();
        let numbers = |first: u32| first..first + index(count);
        let (leaves, surfaces) = (numbers(index(self.parts.leaves.len())), numbers(surface));
        let indices = (0..count).into_par_iter();
        let mut lists = (take(&mut self.parts.leaves), take(&mut self.parts.bounds));
        let leaf = |(at, surface)| {
            let Colored { shape, steps, .. } = shapes.object(at);
            let alone = self.shape_alone(shape.into_owned());
            Leaf::new(alone, steps, Absorb::AllItCan, surface, Extent::Surface)
        };
        lists.par_extend(indices.clone().zip(surfaces).map(leaf));
        let parts = &mut self.parts;
        (parts.leaves, parts.bounds) = lists;
        parts
            .items
            .par_extend(leaves.clone().into_par_iter().map(PendingItem::Leaf));
        let rounded = |(at, number): (usize, u32)| {
            let leaf = &self.parts.leaves[number as usize];
            let tying = self.parts.own_boxes.len() + at;
            let object = self.may_round(leaf, tying).then(|| shapes.object(at))?;
            let rounded = self.rounded(&object.shape, object.steps, leaf, tying)?;
            Some((number, rounded))
        };
        let rounded: Vec<_> = indices.zip(leaves).filter_map(rounded).collect();
        for (leaf, (rounded, own_box)) in rounded {
            self.parts.round(leaf, rounded, own_box);
        }
    }

    /// Adds the surfaces of the shapes.
    fn add_surfaces(&mut self, shapes: &PlainShapes, InteriorId(first): InteriorId) {
        let count = shapes.len();
        let surface = |template: &mut SurfaceTemplate, (at, interior)| {
            template.surface_at(shapes, at, InteriorId(interior))
        };
        let indices = (0..count).into_par_iter();
        let surfaces = indices.zip(first..first + index(count));
        let surfaces = surfaces.map_init(SurfaceTemplate::default, surface);
        self.surfaces.par_extend(surfaces);
    }
}

#[cfg(test)]
mod tests {
    use crate::base::options::{ReadOptions, RenderOptions};
    use crate::base::source::Sources;
    use crate::lang::evaluate;
    use std::fmt::Write;

    #[test]
    fn a_surface_of_one_color_is_a_line_of_memory() {
        assert_eq!(size_of::<crate::world::Surface>(), 64);
    }

    #[test]
    fn deferred_spheres_keep_their_surfaces_in_any_tree_order() {
        let mut text = String::from(
            "#version 3.7; global_settings { assumed_gamma 1 } light_source { 9, 1 } plane { y, -50 pigment { rgb 1 } }\n",
        );
        for at in 0..5000 {
            let (x, z) = (at * 37 % 101, at / 101);
            let red = f64::from(x) / 128.0;
            let object = format!("sphere {{ <{x}, 0, {z}>, 0.25 pigment {{ rgb <{red}, 0, 0>");
            let more = match at {
                2000 => "} } box { <-9, -9, -9>, <-8, -8, -8> pigment { rgb 1",
                _ if at % 3 == 0 => " transmit 0.5",
                _ => "",
            };
            writeln!(text, "{object}{more} }} }}").unwrap();
        }
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("test.pov", &text);
        let reading = evaluate(file, &mut sources, &ReadOptions::default());
        let world = crate::world::compile(reading.scene.unwrap(), &RenderOptions::default());
        let mut spheres = 0;
        for leaf in world.leaves() {
            let Some((centre, _)) = leaf.sphere() else {
                continue;
            };
            spheres += 1;
            let surface = &world.surfaces[leaf.surface as usize];
            let (color, _) = surface.texture.plain().unwrap();
            assert_eq!(f64::from(color.rgb.r), centre.x / 128.0);
            assert_eq!(surface.is_opaque(), !color.is_transparent());
        }
        assert_eq!(spheres, 5000);
    }
}

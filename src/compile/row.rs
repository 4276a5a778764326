//! Plain coloured shapes that follow each other at the top level of a scene: taken in by all threads, for there may be
//! millions of them.

use super::flatten::{Flat, index};
use super::interiors::InteriorId;
use super::leaf::{Absorb, Extent, Leaf};
use super::lights::LightList;
use super::model::Item;
use super::surface::{Flags, Kept, Surface};
use crate::color::Color;
use crate::math::Bounds;
use crate::scene::{Object, Objects, Taken};
use crate::shape::{Geometry, Shape};
use crate::texture::{Finish, PreparedTexture};
use rayon::prelude::*;
use std::sync::Arc;

/// So many are taken in together.
const ROW: usize = 1 << 13;

/// Shapes that stand where their own numbers say, and how they look.
#[derive(Default)]
struct Row {
    shapes: Vec<Shape>,
    looks: Vec<(Color, Arc<Finish>)>,
    /// What the shapes come to.
    leaves: Vec<Leaf>,
    bounds: Vec<Bounds>,
}

impl Flat {
    /// Takes in all objects of the scene's top level; `let_go` gets those that are needed no more, one by one.
    pub(super) fn take_all(&mut self, objects: Objects, let_go: &mut dyn FnMut(Arc<Object>)) {
        let mut row = Row::default();
        for object in objects.taken_apart() {
            match object {
                Taken::Colored(shape, color, finish) if self.suits_row(&shape, &finish) => {
                    row.shapes.push(shape);
                    row.looks.push((color, finish));
                    if row.shapes.len() == ROW {
                        self.take_row(&mut row);
                    }
                }
                other => {
                    self.take_row(&mut row);
                    if let Some(object) = self.take(other) {
                        let_go(object);
                    }
                }
            }
        }
        self.take_row(&mut row);
    }

    /// Whether a shape takes nothing but a place in the lists. Photons have to know where things stand.
    fn suits_row(&self, shape: &Shape, finish: &Finish) -> bool {
        shape.skins().is_empty()
            && self.targets.is_none()
            && !finish.has_interior()
            && !shape.bounds().is_empty()
    }

    /// Takes in a row of shapes, and leaves it empty.
    fn take_row(&mut self, row: &mut Row) {
        let count = index(row.shapes.len());
        if count == 0 {
            return;
        }
        let numbers = |first: usize| {
            let first = index(first);
            first..first + count
        };
        let leaves = numbers(self.parts.leaves.len());
        let shapes = row.shapes.par_drain(..);
        let leaf =
            |(shape, surface)| Leaf::new(shape, (&[], Absorb::AllItCan), surface, Extent::Surface);
        let made = shapes.zip(numbers(self.surfaces.len())).map(leaf);
        let parts = &mut self.parts;
        made.unzip_into_vecs(&mut row.leaves, &mut row.bounds);
        parts.leaves.append(&mut row.leaves);
        parts.bounds.append(&mut row.bounds);
        parts.items.extend(leaves.map(Item::Leaf));
        let InteriorId(interior) = self.interiors.unnamed_ones(count);
        let surface = |((color, finish), interior)| {
            let texture = Kept::Own(PreparedTexture::colored(color, finish));
            let lit = (LightList::default(), Flags::default());
            Surface::new(texture, None, Box::default(), InteriorId(interior), lit)
        };
        let looks = row.looks.par_drain(..).zip(interior..interior + count);
        self.surfaces.par_extend(looks.map(surface));
        self.last_surface = None;
    }
}

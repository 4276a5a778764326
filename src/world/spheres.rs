//! Balls that become leaves when the order of the tree is known, and get their looks then: where there are a million of them,
//! going through them once less is a tenth of the time it takes to prepare them, and what is seen together lies together.

use super::bvh_items::AHEAD;
use super::interiors::InteriorId;
use super::lower::flatten::index;
use super::lower::parallel::{PlainShapes, SurfaceTemplate};
use super::primitive::{Absorb, Extent, Leaf};
use super::surface::Surface;
use crate::scene::shape::{Shape, Sphere};
use rayon::prelude::*;

/// Balls of one colour in the order of the file, by a number of their own.
#[derive(Debug, Default)]
pub(super) struct DeferredSpheres {
    stretches: Vec<SphereRun>,
    count: u32,
}

/// Balls that follow each other in the file.
#[derive(Debug)]
struct SphereRun {
    first: u32,
    /// The interior of the first; those of the others follow.
    interior: InteriorId,
    row: PlainShapes,
}

impl DeferredSpheres {
    /// Adds a row of `count` balls whose interiors begin at `interior`; gives the number of the first.
    pub(super) fn add(&mut self, row: PlainShapes, count: u32, interior: InteriorId) -> u32 {
        let first = self.count;
        self.count += count;
        self.stretches.push(SphereRun {
            first,
            interior,
            row,
        });
        first
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.count as usize
    }

    /// Where a ball is: its stretch, and the number in that.
    #[inline]
    fn place(&self, number: u32) -> (&SphereRun, u32) {
        let behind = self.stretches.partition_point(|one| one.first <= number);
        let stretch = &self.stretches[behind - 1];
        (stretch, number - stretch.first)
    }

    /// The ball of this number.
    #[inline]
    pub(super) fn ball(&self, number: u32) -> Sphere {
        let (stretch, at) = self.place(number);
        let sphere = stretch.row.ball(at as usize);
        sphere.expect("the row is one of balls")
    }

    /// The leaf of the ball of this number with this surface, and how it looks.
    #[inline]
    fn leaf(&self, number: u32, surface: u32, alike: &mut SurfaceTemplate) -> (Leaf, Surface) {
        let (stretch, at) = self.place(number);
        let InteriorId(interior) = stretch.interior;
        let looks = alike.surface_at(&stretch.row, at as usize, InteriorId(interior + at));
        let sphere = stretch.row.ball(at as usize);
        let shape = Shape::Sphere(sphere.expect("the row is one of balls"));
        let place = (&[][..], Absorb::AllItCan);
        (Leaf::new(shape, place, surface, Extent::Surface).0, looks)
    }

    /// The leaves of all of them in this order; their looks are added to `surfaces` in the same.
    pub(super) fn into_leaves(self, order: &[u32], surfaces: &mut Vec<Surface>) -> Vec<Leaf> {
        let first = surfaces.len();
        let leaf = |alike: &mut SurfaceTemplate, (place, &number): (usize, &u32)| {
            // Each comes from somewhere else.
            if let Some(&ahead) = order.get(place + AHEAD) {
                let (stretch, at) = self.place(ahead);
                stretch.row.expect(at as usize);
            }
            self.leaf(number, index(first + place), alike)
        };
        let order = order.par_iter().enumerate();
        let mut lists = (Vec::new(), std::mem::take(surfaces));
        lists.par_extend(order.map_init(SurfaceTemplate::default, leaf));
        let leaves;
        (leaves, *surfaces) = lists;
        for stretch in self.stretches {
            stretch.row.forget();
        }
        leaves
    }
}

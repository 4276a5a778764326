//! The tree over the items of a model, and their leaves in its order: what lies together in space lies together in
//! memory.

use super::csg::program::CsgProgram;
use super::instance::Instance;
use super::lower::flatten::index;
use super::model::{Item, ModelBuilder, PendingItem};
use super::primitive::Leaf;
use super::sphere_soa::SphereSoa;
use super::surface::Surface;
use crate::base::accel::Bvh;
use crate::base::math::Bounds;
use crate::base::memory::prefetch;
use glam::DVec3;
use rayon::prelude::*;
use std::mem::take;

/// How many leaves before its turn one is sent for: as long as memory takes.
pub(super) const AHEAD: usize = 32;

/// An item with its number, which is its place in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct IndexedItem {
    pub(super) number: u32,
    pub(super) item: Item,
}

/// How the items of a model are found.
#[derive(Debug)]
pub(super) struct ItemBvh {
    /// Over `bounded`.
    pub(super) tree: Bvh,
    /// In the order of the tree.
    pub(super) bounded: Vec<IndexedItem>,
    /// Those that no box holds.
    pub(super) unbounded: Vec<IndexedItem>,
}

impl ItemBvh {
    /// Builds the tree and brings what `parts` holds into its order; the looks of its balls are added to `surfaces`, and
    /// `projectors` follow their leaves.
    pub(super) fn new<'p>(
        parts: &mut ModelBuilder,
        surfaces: &mut Vec<Surface>,
        projectors: impl Iterator<Item = &'p mut CsgProgram>,
    ) -> Self {
        let count = index(parts.items.len());
        let is_unbounded = |&number: &u32| !parts.bounds[number as usize].is_finite();
        let numbers = (0..count).into_par_iter();
        let unbounded: Vec<u32> = numbers.filter(is_unbounded).collect();
        // How many bounded ones come before each of them.
        let gaps: Vec<u32> = (0..).zip(&unbounded).map(|(i, at)| at - i).collect();
        let number = |place: u32| place + index(gaps.partition_point(|&gap| gap <= place));
        let bounds = |place: usize| {
            let number = number(index(place)) as usize;
            let bounds = &parts.bounds[number];
            match parts.items[number] {
                PendingItem::Ball(_) => (*bounds, true),
                PendingItem::Leaf(leaf) => {
                    let leaf = &parts.leaves[leaf as usize];
                    match leaf.ball() {
                        Some((centre, radius)) => {
                            (Bounds::new(centre - radius, centre + radius), true)
                        }
                        None => (leaf.tightened(bounds), false),
                    }
                }
                PendingItem::Program(_) | PendingItem::Instance(_) => (*bounds, false),
            }
        };
        let (mut tree, mut order) =
            Bvh::build_in_order(parts.items.len() - unbounded.len(), bounds);
        if !gaps.is_empty() {
            order.iter_mut().for_each(|place| *place = number(*place));
        }
        // In large scenes the room is needed.
        parts.bounds = Vec::new();
        let mut sorter = LeafReorder::new(take(parts));
        let (unbounded, bounded) = (sorter.take(unbounded), sorter.take(order));
        *parts = sorter.finish(surfaces, projectors);
        let (leaves, programs) = (&parts.leaves, &parts.programs);
        tree.set_bounding_spheres(bounded.len(), |place| match bounded[place].item {
            Item::Leaf(leaf) => leaves[leaf as usize].ball_around(),
            Item::Program(program) => programs[program as usize].ball_around(leaves),
            Item::Instance(_) => None,
        });
        ItemBvh {
            tree,
            bounded,
            unbounded,
        }
    }

    /// All items together, if they are few and round.
    pub(super) fn cluster(&self, parts: &ModelBuilder) -> Option<SphereSoa> {
        if !self.unbounded.is_empty() || parts.leaves.len() != self.bounded.len() {
            return None;
        }
        SphereSoa::new(self.bounded.len(), |place| match self.bounded[place].item {
            Item::Leaf(leaf) => {
                let leaf = &parts.leaves[leaf as usize];
                leaf.ball().filter(|_| leaf.shape.has_roots_of_four())
            }
            Item::Program(_) | Item::Instance(_) => None,
        })
    }

    /// The items that may hold a point.
    pub(super) fn around(&self, point: DVec3) -> Vec<IndexedItem> {
        let mut items = self.unbounded.clone();
        self.tree.around(point, |place| {
            items.push(self.bounded[place as usize]);
            false
        });
        items
    }
}

/// What a model is made from on its way to the order of its items.
struct LeafReorder {
    from: ModelBuilder,
    instances: Vec<Option<Instance>>,
    /// The balls by their numbers in the file. They are the first leaves.
    balls: Vec<u32>,
    /// Behind them, the other leaves by theirs.
    leaves: Vec<u32>,
    /// For each of these in the file, its place among all leaves.
    places: Vec<u32>,
    to: ModelBuilder,
}

impl LeafReorder {
    fn new(mut from: ModelBuilder) -> Self {
        let to = ModelBuilder {
            programs: Vec::with_capacity(from.programs.len()),
            instances: Vec::with_capacity(from.instances.len()),
            ..ModelBuilder::default()
        };
        LeafReorder {
            instances: from.instances.drain(..).map(Some).collect(),
            balls: Vec::with_capacity(from.balls.len()),
            leaves: Vec::with_capacity(from.leaves.len()),
            places: vec![u32::MAX; from.leaves.len()],
            from,
            to,
        }
    }

    /// Takes the items of these numbers in the file.
    fn take(&mut self, numbers: Vec<u32>) -> Vec<IndexedItem> {
        // Several threads fetch them: each lies somewhere else.
        let items = &self.from.items;
        let parts = numbers.par_iter().map(|&number| items[number as usize]);
        let parts: Vec<PendingItem> = parts.collect();
        let numbers = numbers.into_iter().zip(parts);
        numbers
            .map(|(number, part)| self.take_part(number, part))
            .collect()
    }

    fn take_part(&mut self, number: u32, part: PendingItem) -> IndexedItem {
        let item = match part {
            PendingItem::Ball(ball) => {
                self.balls.push(ball);
                Item::Leaf(index(self.balls.len() - 1))
            }
            PendingItem::Leaf(leaf) => Item::Leaf(self.take_leaf(leaf)),
            PendingItem::Program(from) => {
                let program = take(&mut self.from.programs[from as usize]);
                for leaf in program.first..program.first + program.len() {
                    self.take_leaf(leaf);
                }
                self.to.programs.push(program);
                Item::Program(index(self.to.programs.len() - 1))
            }
            PendingItem::Instance(from) => {
                let instance = self.instances[from as usize].take();
                self.to.instances.extend(instance);
                Item::Instance(index(self.to.instances.len() - 1))
            }
        };
        IndexedItem { number, item }
    }

    fn take_leaf(&mut self, leaf: u32) -> u32 {
        let place = index(self.from.balls.len() + self.leaves.len());
        self.places[leaf as usize] = place;
        self.leaves.push(leaf);
        place
    }

    /// All in order, when every item is taken; the looks of the balls are added to `surfaces`, and `projectors` use leaves
    /// too.
    fn finish<'p>(
        mut self,
        surfaces: &mut Vec<Surface>,
        projectors: impl Iterator<Item = &'p mut CsgProgram>,
    ) -> ModelBuilder {
        // Behind the others the leaves of what bounds combinations, and of what lights are projected through.
        for leaf in 0..index(self.places.len()) {
            if self.places[leaf as usize] == u32::MAX {
                self.take_leaf(leaf);
            }
        }
        let mut next = index(self.balls.len() + self.leaves.len());
        for instance in &mut self.to.instances {
            instance.first = next;
            next += instance.model.len();
        }
        let programs = self.to.programs.par_iter_mut();
        programs.for_each(|program| program.move_leaves(&self.places));
        projectors.for_each(|program| program.move_leaves(&self.places));
        self.to.leaves = self.from.balls.into_leaves(&self.balls, surfaces);
        self.to.leaves.reserve_exact(self.leaves.len());
        let mut unsorted = self.from.leaves;
        for (place, &leaf) in self.leaves.iter().enumerate() {
            if let Some(&ahead) = self.leaves.get(place + AHEAD) {
                prefetch(&unsorted[ahead as usize]);
            }
            let leaf = std::mem::replace(&mut unsorted[leaf as usize], Leaf::NOTHING);
            self.to.leaves.push(leaf);
        }
        self.to
    }
}

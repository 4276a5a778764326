//! Builds models: the BVH over their items, with the leaves stored in its order, so that neighbours in space are
//! neighbours in memory.

use super::spheres::{AHEAD, DeferredSpheres};
use crate::base::accel::Bvh;
use crate::base::math::Bounds;
use crate::base::memory::prefetch;
use crate::scene::shape::{Geometry, Rounded, Shape};
use crate::world::csg::program::CsgProgram;
use crate::world::index::index;
use crate::world::model::{IndexedItem, Instance, Item, ItemBvh, Model};
use crate::world::primitive::Leaf;
use crate::world::rounding::Rounding;
use crate::world::slabs::SingleBox;
use crate::world::sphere_soa::SphereSoa;
use crate::world::surface::Surface;
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::mem::take;

/// An item before the BVH is built.
#[derive(Clone, Copy, Debug)]
pub(in crate::world) enum PendingItem {
    /// A single primitive.
    Leaf(u32),
    /// A sphere without a leaf yet: one of [`ModelBuilder::spheres`].
    Sphere(u32),
    /// A CSG program.
    Program(u32),
    /// An instance of another model.
    Instance(u32),
}

/// The parts of a model in file order.
#[derive(Debug, Default)]
pub(in crate::world) struct ModelBuilder {
    pub(in crate::world) leaves: Vec<Leaf>,
    pub(in crate::world) programs: Vec<CsgProgram>,
    pub(in crate::world) instances: Vec<Instance>,
    pub(in crate::world) items: Vec<PendingItem>,
    pub(in crate::world) spheres: DeferredSpheres,
    /// Bounds of the items.
    pub(in crate::world) bounds: Vec<Bounds>,
    /// Leaves whose hits are wanted with POV-Ray's rounding.
    pub(in crate::world) rounded: FxHashMap<u32, Rounded>,
    /// POV-Ray's boxes of those that decide ties.
    pub(in crate::world) own_boxes: FxHashMap<u32, Bounds>,
    /// POV-Ray's boxes of the first meshes that have a matrix.
    pub(in crate::world) mesh_boxes: FxHashMap<u32, Bounds>,
    /// POV-Ray's boxes of the first programs.
    pub(in crate::world) program_boxes: Vec<Bounds>,
}

impl ModelBuilder {
    pub(in crate::world) fn push(&mut self, item: PendingItem, bounds: Bounds) {
        self.items.push(item);
        self.bounds.push(bounds);
    }

    /// The bounds of the items in single precision.
    pub(in crate::world) fn single_boxes(&self) -> Vec<SingleBox> {
        self.bounds.par_iter().map(SingleBox::new).collect()
    }

    /// POV-Ray's boxes of the items that have one of their own, by the number of the item.
    pub(in crate::world) fn povray_boxes(&self) -> FxHashMap<u32, SingleBox> {
        let are_none = self.own_boxes.is_empty() && self.mesh_boxes.is_empty();
        if are_none && self.program_boxes.is_empty() {
            return FxHashMap::default();
        }
        let own_box = |(number, item): (u32, &PendingItem)| {
            let own_box = match *item {
                PendingItem::Leaf(leaf) => {
                    let own_box = self.own_boxes.get(&leaf);
                    own_box.or_else(|| self.mesh_boxes.get(&leaf))
                }
                PendingItem::Program(program) => self.program_boxes.get(program as usize),
                _ => None,
            };
            own_box.map(|own_box| (number, SingleBox::new(own_box)))
        };
        (0..).zip(&self.items).filter_map(own_box).collect()
    }

    /// Returns true if a face across an axis, of a shape that decides ties, lies in one plane with a face of another: then
    /// roundings show. Triangles do not count as faces of others, nor do meshes but for the sides of their boxes.
    pub(in crate::world) fn has_flush_faces(&self) -> bool {
        let mut faces = Faces::default();
        for (&leaf, bounds) in &self.own_boxes {
            faces.add(leaf, bounds);
            // The box of a disc is a little thicker.
            if let Some(Shape::Disc(_)) = self.leaves.get(leaf as usize).map(|leaf| &leaf.shape) {
                let middle = 0.5 * (bounds.min + bounds.max);
                faces.add(leaf, &Bounds::new(middle, middle));
            }
        }
        let mut triangles = Faces::default();
        let mut flat = 0;
        for (number, leaf) in (0..).zip(&self.leaves) {
            match &leaf.shape {
                Shape::Mesh(_) => faces.add(number, &box_in_world(leaf)),
                Shape::Triangle(triangle) if flat < MOST_FLAT => {
                    let Bounds { min, max } = triangle.bounds();
                    let at = DVec3::select(min.cmpeq(max), min, DVec3::splat(f64::NAN));
                    if !at.is_nan_mask().all() {
                        triangles.add(number, &Bounds { min: at, max: at });
                        flat += 1;
                    }
                }
                _ => {}
            }
        }
        faces.sort();
        triangles.sort();
        let mut leaves = (0..).zip(&self.leaves);
        faces.meet_each_other()
            || self.own_boxes.values().any(|bounds| triangles.meet(bounds))
            || leaves.any(|(number, leaf)| match &leaf.shape {
                _ if self.own_boxes.contains_key(&number) => false,
                Shape::Mesh(_) => triangles.meet(&box_in_world(leaf)),
                _ => sides(leaf).is_some_and(|at| faces.meet(&at) || triangles.meet(&at)),
            })
    }

    /// Sets the rounded form of a leaf, and POV-Ray's box of it if it decides ties.
    pub(in crate::world) fn round(&mut self, leaf: u32, rounded: Rounded, own_box: Option<Bounds>) {
        self.rounded.insert(leaf, rounded);
        if let Some(own_box) = own_box {
            self.own_boxes.insert(leaf, own_box);
        }
    }

    /// Removes the leaves from `first` on.
    pub(in crate::world) fn truncate_leaves(&mut self, first: u32) {
        for leaf in first..index(self.leaves.len()) {
            self.rounded.remove(&leaf);
            self.own_boxes.remove(&leaf);
            self.mesh_boxes.remove(&leaf);
        }
        self.leaves.truncate(first as usize);
    }
}

/// A box around a leaf in the world.
fn box_in_world(leaf: &Leaf) -> Bounds {
    let bounds = leaf.shape.bounds();
    let to_object = leaf.object_from_world.as_ref();
    to_object.map_or(bounds, |to_object| bounds.transformed(&to_object.inverse()))
}

/// The places of the faces of a box or plane across each axis, not finite where there are none.
fn sides(leaf: &Leaf) -> Option<Bounds> {
    match &leaf.shape {
        Shape::Cuboid(_) => Some(box_in_world(leaf)),
        Shape::Plane(plane) => {
            let is_across = plane.normal.abs().cmpgt(DVec3::splat(ALONG));
            let nowhere = DVec3::splat(f64::NAN);
            let at = DVec3::select(is_across, plane.distance * plane.normal, nowhere);
            Some(Bounds { min: at, max: at })
        }
        _ => None,
    }
}

/// Least component of the unit normal of a plane across an axis.
const ALONG: f64 = 1.0 - 1e-9;

/// The most triangles across an axis that are compared with other faces.
const MOST_FLAT: u32 = 1 << 16;

/// A face across an axis.
#[derive(Clone, Copy)]
struct Face {
    at: f64,
    /// Error of the position: boxes are stored in single precision, by a corner and the sides.
    blur: f64,
    leaf: u32,
    /// The highest end of this face and those before it, and the lowest of this one and those behind it, with their
    /// errors.
    ends: [f64; 2],
}

/// The faces across each axis.
#[derive(Default)]
struct Faces {
    across: [Vec<Face>; 3],
    /// The largest coordinate of a face.
    reach: f64,
}

impl Faces {
    /// Error of a face, relative to its coordinate and to the side of its box.
    const SINGLE: f64 = 1e-6;
    /// Distance of faces in one plane, relative to the largest coordinate.
    const OF_REACH: f64 = 1e-12;

    fn add(&mut self, leaf: u32, bounds: &Bounds) {
        for (axis, faces) in self.across.iter_mut().enumerate() {
            let ends = [bounds.min[axis], bounds.max[axis]];
            let side = ends[1] - ends[0];
            for at in ends.into_iter().filter(|at| at.is_finite()) {
                let side = if side.is_finite() { side } else { 0.0 };
                let blur = Self::SINGLE * at.abs().max(side);
                let ends = [at + blur, at - blur];
                faces.push(Face {
                    at,
                    blur,
                    leaf,
                    ends,
                });
                self.reach = self.reach.max(at.abs());
            }
        }
    }

    fn sort(&mut self) {
        for faces in &mut self.across {
            faces.sort_by(|a, b| a.at.total_cmp(&b.at));
            for i in 1..faces.len() {
                faces[i].ends[0] = faces[i].ends[0].max(faces[i - 1].ends[0]);
            }
            for i in (1..faces.len()).rev() {
                faces[i - 1].ends[1] = faces[i - 1].ends[1].min(faces[i].ends[1]);
            }
        }
    }

    fn are_flush(&self, face: &Face, at: f64) -> bool {
        (face.at - at).abs() <= face.blur + Self::OF_REACH * self.reach
    }

    /// Returns true if faces of two leaves are flush; some of these are neighbours.
    fn meet_each_other(&self) -> bool {
        let meet = |pair: &[Face]| {
            pair[0].leaf != pair[1].leaf
                && (self.are_flush(&pair[0], pair[1].at) || self.are_flush(&pair[1], pair[0].at))
        };
        let mut axes = self.across.iter();
        axes.any(|faces| faces.windows(2).any(meet))
    }

    /// Returns true if a side of a box is flush with a face.
    fn meet(&self, bounds: &Bounds) -> bool {
        self.across.iter().enumerate().any(|(axis, faces)| {
            [bounds.min[axis], bounds.max[axis]].into_iter().any(|at| {
                let (before, behind) = faces.split_at(faces.partition_point(|face| face.at < at));
                let slack = Self::OF_REACH * self.reach;
                before.last().is_some_and(|face| at <= face.ends[0] + slack)
                    || behind
                        .first()
                        .is_some_and(|face| face.ends[1] - slack <= at)
            })
        })
    }
}

impl Model {
    /// Builds the BVH over these parts and reorders them to match. The surfaces of the deferred spheres are appended to
    /// `surfaces`; `projectors` are further programs over the leaves.
    pub(in crate::world) fn new<'p>(
        mut parts: ModelBuilder,
        surfaces: &mut Vec<Surface>,
        projectors: impl Iterator<Item = &'p mut CsgProgram>,
    ) -> Model {
        let bvh = ItemBvh::new(&mut parts, surfaces, projectors);
        let cluster = bvh.cluster(&parts);
        let strategies = parts.programs.iter();
        Model {
            strategies: strategies
                .map(|program| program.packet_strategy(&parts.leaves))
                .collect(),
            leaves: parts.leaves,
            programs: parts.programs,
            instances: parts.instances,
            rounding: Rounding {
                forms: parts.rounded,
                ..Rounding::default()
            },
            bvh,
            cluster,
        }
    }
}

impl ItemBvh {
    /// Builds the BVH and reorders `parts` to match. The surfaces of its deferred spheres are appended to `surfaces`,
    /// and the leaf indices of `projectors` are updated.
    pub(in crate::world) fn new<'p>(
        parts: &mut ModelBuilder,
        surfaces: &mut Vec<Surface>,
        projectors: impl Iterator<Item = &'p mut CsgProgram>,
    ) -> Self {
        let count = index(parts.items.len());
        let is_unbounded = |&number: &u32| !parts.bounds[number as usize].is_finite();
        let numbers = (0..count).into_par_iter();
        let unbounded: Vec<u32> = numbers.filter(is_unbounded).collect();
        // For each unbounded item, the number of bounded items before it.
        let gaps: Vec<u32> = (0..).zip(&unbounded).map(|(i, at)| at - i).collect();
        let number = |position: u32| position + index(gaps.partition_point(|&gap| gap <= position));
        let bounds = |position: usize| {
            let number = number(index(position)) as usize;
            let bounds = &parts.bounds[number];
            match parts.items[number] {
                PendingItem::Sphere(_) => (*bounds, true),
                PendingItem::Leaf(leaf) => {
                    let leaf = &parts.leaves[leaf as usize];
                    match leaf.sphere() {
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
            order
                .iter_mut()
                .for_each(|position| *position = number(*position));
        }
        // Freed early: large scenes need the memory.
        parts.bounds = Vec::new();
        let mut sorter = LeafReorder::new(take(parts));
        let (unbounded, bounded) = (sorter.take(unbounded), sorter.take(order));
        *parts = sorter.finish(surfaces, projectors);
        let (leaves, programs) = (&parts.leaves, &parts.programs);
        tree.set_bounding_spheres(bounded.len(), |position| match bounded[position].item {
            Item::Leaf(leaf) => leaves[leaf as usize].bounding_sphere(),
            Item::Program(program) => programs[program as usize].bounding_sphere(leaves),
            Item::Instance(_) => None,
        });
        ItemBvh {
            tree,
            bounded,
            unbounded,
        }
    }

    /// All items as one array of spheres, if there are only a few spheres.
    pub(in crate::world) fn cluster(&self, parts: &ModelBuilder) -> Option<SphereSoa> {
        if !self.unbounded.is_empty() || parts.leaves.len() != self.bounded.len() {
            return None;
        }
        SphereSoa::new(self.bounded.len(), |position| {
            match self.bounded[position].item {
                Item::Leaf(leaf) => {
                    let leaf = &parts.leaves[leaf as usize];
                    leaf.sphere().filter(|_| leaf.shape.has_nearest_packet())
                }
                Item::Program(_) | Item::Instance(_) => None,
            }
        })
    }
}

/// Reorders the parts of a model to match the order of its items.
struct LeafReorder {
    from: ModelBuilder,
    instances: Vec<Option<Instance>>,
    /// The deferred spheres, by index in file order. They become the first leaves.
    spheres: Vec<u32>,
    /// The other leaves, which follow the spheres, by index in file order.
    leaves: Vec<u32>,
    /// For each of the other leaves in file order, its index among all leaves.
    positions: Vec<u32>,
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
            spheres: Vec::with_capacity(from.spheres.len()),
            leaves: Vec::with_capacity(from.leaves.len()),
            positions: vec![u32::MAX; from.leaves.len()],
            from,
            to,
        }
    }

    /// Takes the items with these indices in file order.
    fn take(&mut self, numbers: Vec<u32>) -> Vec<IndexedItem> {
        // In parallel: the items are scattered in memory.
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
            PendingItem::Sphere(sphere) => {
                self.spheres.push(sphere);
                Item::Leaf(index(self.spheres.len() - 1))
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
        let position = index(self.from.spheres.len() + self.leaves.len());
        self.positions[leaf as usize] = position;
        self.leaves.push(leaf);
        position
    }

    /// The reordered parts, once every item is taken. The surfaces of the spheres are appended to `surfaces`;
    /// `projectors` use leaves too.
    fn finish<'p>(
        mut self,
        surfaces: &mut Vec<Surface>,
        projectors: impl Iterator<Item = &'p mut CsgProgram>,
    ) -> ModelBuilder {
        // Last come the leaves of the bounds of CSG programs, and of objects that lights are projected through.
        for leaf in 0..index(self.positions.len()) {
            if self.positions[leaf as usize] == u32::MAX {
                self.take_leaf(leaf);
            }
        }
        let mut next = index(self.spheres.len() + self.leaves.len());
        for instance in &mut self.to.instances {
            instance.first = next;
            next += instance.model.len();
        }
        let programs = self.to.programs.par_iter_mut();
        programs.for_each(|program| program.move_leaves(&self.positions));
        projectors.for_each(|program| program.move_leaves(&self.positions));
        self.to.leaves = self.from.spheres.into_leaves(&self.spheres, surfaces);
        let rounded = take(&mut self.from.rounded).into_iter();
        let positions = &self.positions;
        self.to.rounded = rounded
            .map(|(leaf, rounded)| (positions[leaf as usize], rounded))
            .collect();
        self.to.leaves.reserve_exact(self.leaves.len());
        let mut unsorted = self.from.leaves;
        for (position, &leaf) in self.leaves.iter().enumerate() {
            if let Some(&ahead) = self.leaves.get(position + AHEAD) {
                prefetch(&unsorted[ahead as usize]);
            }
            let leaf = std::mem::replace(&mut unsorted[leaf as usize], Leaf::NOTHING);
            self.to.leaves.push(leaf);
        }
        self.to
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn flush_faces_are_those_of_all_pairs() {
        let mut rng = Random::new(3);
        let mut counts = [0; 2];
        for _ in 0..2_000 {
            let mut faces = Faces::default();
            for leaf in 0..6 {
                let at = 1e-4 * rng.uniform();
                let side = 100.0 * rng.uniform() * rng.uniform();
                let bounds = Bounds::new(DVec3::splat(at - side), DVec3::splat(at));
                faces.add(leaf, &bounds);
            }
            faces.sort();
            let across = &faces.across[0];
            let meet = across.iter().enumerate().any(|(i, a)| {
                let others = across.iter().enumerate();
                others
                    .into_iter()
                    .any(|(j, b)| i != j && a.leaf != b.leaf && faces.are_flush(a, b.at))
            });
            assert_eq!(faces.meet_each_other(), meet);
            let at = 1e-4 * rng.uniform();
            let plane = Bounds::new(DVec3::splat(at), DVec3::splat(at + 1e9));
            let meet = across.iter().any(|face| faces.are_flush(face, at));
            assert_eq!(faces.meet(&plane), meet);
            counts[usize::from(meet)] += 1;
        }
        assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
    }
}

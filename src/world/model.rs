//! A model: primitives and combinations made ready for rays, with the tree over them. The world is one; so is each
//! large union that a scene shows again and again, which is prepared once and placed by a matrix for each copy.
//!
//! Numbers of leaves go on from the model's own ones through its instances, one stretch for each, so that a number
//! tells every copy of every primitive apart however deep instances lie in each other.

use super::bvh_items::ItemBvh;
use super::csg::program::CsgProgram;
use super::instance::Instance;
use super::primitive::Leaf;
use super::query::packet::csg::PacketStrategy;
use super::sphere_soa::SphereSoa;
use super::spheres::DeferredSpheres;
use super::surface::Surface;
use crate::base::math::Bounds;
use crate::scene::shape::{Shape, TextureWeights};
use glam::DVec3;

/// What a tree holds.
#[derive(Clone, Copy, Debug)]
pub(super) enum Item {
    /// A shape by itself.
    Leaf(u32),
    /// A combination.
    Program(u32),
    /// A model of its own, in its place.
    Instance(u32),
}

/// What becomes an [`Item`].
#[derive(Clone, Copy, Debug)]
pub(super) enum PendingItem {
    /// A shape by itself.
    Leaf(u32),
    /// A shape by itself that is no leaf yet: one of [`ModelBuilder::balls`].
    Ball(u32),
    /// A combination.
    Program(u32),
    /// A model of its own, in its place.
    Instance(u32),
}

/// What a model is made from, in the order of the file.
#[derive(Debug, Default)]
pub(super) struct ModelBuilder {
    pub(super) leaves: Vec<Leaf>,
    pub(super) programs: Vec<CsgProgram>,
    pub(super) instances: Vec<Instance>,
    pub(super) items: Vec<PendingItem>,
    pub(super) balls: DeferredSpheres,
    /// The bounds of the items.
    pub(super) bounds: Vec<Bounds>,
}

impl ModelBuilder {
    pub(super) fn push(&mut self, item: PendingItem, bounds: Bounds) {
        self.items.push(item);
        self.bounds.push(bounds);
    }
}

/// Primitives and combinations ready for rays.
#[derive(Debug)]
pub(super) struct Model {
    pub(super) leaves: Vec<Leaf>,
    pub(super) programs: Vec<CsgProgram>,
    /// In the order of their numbers.
    pub(super) instances: Vec<Instance>,
    pub(super) finder: ItemBvh,
    /// All items, if they are leaves, few and round; four rays can then be asked about them at once.
    pub(super) cluster: Option<SphereSoa>,
    /// For each program, in which way four rays can be asked about it at once.
    ways_of_four: Vec<PacketStrategy>,
}

impl Model {
    /// Builds the tree over these parts, and brings them into its order; the looks of its balls are added to `surfaces`,
    /// and `projectors` are the programs that use leaves of theirs besides.
    pub(super) fn new<'p>(
        mut parts: ModelBuilder,
        surfaces: &mut Vec<Surface>,
        projectors: impl Iterator<Item = &'p mut CsgProgram>,
    ) -> Model {
        let finder = ItemBvh::new(&mut parts, surfaces, projectors);
        let cluster = finder.cluster(&parts);
        let ways_of_four = parts.programs.iter();
        Model {
            ways_of_four: ways_of_four
                .map(|program| program.way_of_four(&parts.leaves))
                .collect(),
            leaves: parts.leaves,
            programs: parts.programs,
            instances: parts.instances,
            finder,
            cluster,
        }
    }

    /// How many primitives it shows, those of its instances included.
    pub(super) fn len(&self) -> u32 {
        match self.instances.last() {
            Some(last) => last.first + last.model.len(),
            None => u32::try_from(self.leaves.len()).expect("the number of objects is limited"),
        }
    }

    /// In which way four rays can be asked about a program at once.
    #[inline(always)]
    pub(super) fn way_of_four(&self, program: u32) -> PacketStrategy {
        self.ways_of_four[program as usize]
    }

    /// Whether four rays can be asked about an item at once.
    #[inline(always)]
    pub(super) fn suits_four(&self, item: Item) -> bool {
        match item {
            Item::Program(program) => self.way_of_four(program) != PacketStrategy::Scalar,
            Item::Leaf(leaf) => self.leaves[leaf as usize].shape.has_roots_of_four(),
            Item::Instance(copy) => self.instances[copy as usize].model.cluster.is_some(),
        }
    }

    /// Where a leaf is a part of an instance, that one.
    fn instance_of(&self, leaf: u32) -> Option<&Instance> {
        let is_own = (leaf as usize) < self.leaves.len();
        let behind = || self.instances.partition_point(|one| one.first <= leaf);
        if is_own {
            None
        } else {
            self.instances.get(behind() - 1)
        }
    }

    /// The unit outward normals at a point of a leaf: the geometric one, and that for shading.
    #[inline]
    pub(super) fn normals(&self, leaf: u32, point: DVec3, face: u32) -> (DVec3, DVec3) {
        match self.leaves.get(leaf as usize) {
            Some(leaf) => leaf.normals(point, face),
            None => self
                .instance_of(leaf)
                .map_or((DVec3::ZERO, DVec3::ZERO), |instance| {
                    instance.normals(leaf, point, face)
                }),
        }
    }

    /// The shares of the shape's own textures at a point of a leaf.
    pub(super) fn shares(&self, leaf: u32, point: DVec3, face: u32) -> TextureWeights {
        match self.instance_of(leaf) {
            Some(instance) => {
                let point = instance.object_from_world.transform_point3(point);
                instance.model.shares(leaf - instance.first, point, face)
            }
            None => self.leaves[leaf as usize].shares(point, face),
        }
    }

    /// The texture coordinates at a point of a leaf; `None` for those of the world.
    pub(super) fn uv(&self, leaf: u32, point: DVec3, face: u32) -> Option<[f64; 2]> {
        match self.instance_of(leaf) {
            Some(instance) => {
                let point = instance.object_from_world.transform_point3(point);
                instance.model.uv(leaf - instance.first, point, face)
            }
            None => self.leaves[leaf as usize].uv(point, face),
        }
    }

    /// Whether inside and outside of a primitive are exchanged where it stands: it is inverse, or a difference takes it
    /// away.
    pub(super) fn is_inverse(&self, leaf: u32) -> bool {
        if let Some(instance) = self.instance_of(leaf) {
            return instance.model.is_inverse(leaf - instance.first);
        }
        let behind = self
            .programs
            .partition_point(|program| program.first <= leaf);
        let program = behind.checked_sub(1).map(|at| &self.programs[at]);
        program.is_some_and(|program| program.is_inverse(leaf - program.first))
    }

    /// The shape of a primitive.
    pub(super) fn shape(&self, leaf: u32) -> &Shape {
        match self.instance_of(leaf) {
            Some(instance) => instance.model.shape(leaf - instance.first),
            None => &self.leaves[leaf as usize].shape,
        }
    }

    /// The surface of the object that an item is, if it holds a point; of an instance all those that do, added to
    /// `surfaces` with `base` for the model's own first one.
    pub(super) fn surfaces_around(
        &self,
        item: Item,
        point: DVec3,
        base: u32,
        surfaces: &mut Vec<u32>,
    ) {
        let (holds, first) = match item {
            Item::Leaf(leaf) => (self.leaves[leaf as usize].contains(point), leaf),
            Item::Program(program) => {
                let program = &self.programs[program as usize];
                (program.contains(&self.leaves, point), program.first)
            }
            Item::Instance(instance) => {
                let instance = &self.instances[instance as usize];
                let point = instance.object_from_world.transform_point3(point);
                let model = &*instance.model;
                for number in model.finder.around(point) {
                    let base = base + instance.surface;
                    model.surfaces_around(number.item, point, base, surfaces);
                }
                return;
            }
        };
        if holds {
            surfaces.push(base + self.leaves[first as usize].surface);
        }
    }

    /// Whether an item holds a point.
    pub(super) fn item_holds(&self, item: Item, point: DVec3) -> bool {
        match item {
            Item::Leaf(leaf) => self.leaves[leaf as usize].contains(point),
            Item::Program(program) => self.programs[program as usize].contains(&self.leaves, point),
            Item::Instance(instance) => {
                let instance = &self.instances[instance as usize];
                let point = instance.object_from_world.transform_point3(point);
                instance.model.holds(point)
            }
        }
    }

    /// Whether a point lies in any object.
    pub(super) fn holds(&self, point: DVec3) -> bool {
        let mut unbounded = self.finder.unbounded.iter();
        unbounded.any(|item| self.item_holds(item.item, point))
            || self.finder.tree.around(point, |place| {
                self.item_holds(self.finder.bounded[place as usize].item, point)
            })
    }
}

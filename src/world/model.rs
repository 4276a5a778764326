//! A model: primitives and CSG programs ready for intersection, with the BVH over them. The world is one; so is each
//! large union that a scene repeats, which is prepared once and placed by a matrix for each instance.
//!
//! The indices of leaves continue from the model's own ones through its instances, one range for each. So an index
//! identifies every copy of every primitive, however deeply instances are nested.

use super::csg::packet_strategy::PacketStrategy;
use super::csg::program::CsgProgram;
use super::primitive::Leaf;
use super::rounding::Rounding;
use super::sphere_soa::SphereSoa;
use crate::base::accel::{BoundingCylinder, Bvh};
use crate::base::math::normal_from_inverse;
use crate::scene::shape::{Rounded, Shape, Sphere, TextureWeights};
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// An item of the BVH.
#[derive(Clone, Copy, Debug)]
pub(super) enum Item {
    /// A single primitive.
    Leaf(u32),
    /// A CSG program.
    Program(u32),
    /// An instance of another model.
    Instance(u32),
}

/// Primitives and CSG programs ready for intersection.
#[derive(Debug)]
pub(super) struct Model {
    pub(super) leaves: Vec<Leaf>,
    pub(super) programs: Vec<CsgProgram>,
    /// By ascending index of their first leaf.
    pub(super) instances: Vec<Instance>,
    pub(super) rounding: Rounding,
    pub(super) bvh: ItemBvh,
    /// All items as one array of spheres, if there are only a few spheres; packets can intersect them.
    pub(super) cluster: Option<SphereSoa>,
    /// The packet algorithm of each program.
    pub(super) strategies: Vec<PacketStrategy>,
}

impl Model {
    /// The infinite cylinder around an item, if it has one.
    pub(super) fn bounding_cylinder(&self, item: Item) -> Option<BoundingCylinder> {
        match item {
            Item::Leaf(leaf) => self.leaves[leaf as usize].bounding_cylinder(),
            Item::Program(_) | Item::Instance(_) => None,
        }
    }

    /// Marks the leaves whose hits are rounded: those of surfaces for which `is_wanted` holds, and those that a search
    /// finds.
    pub(super) fn round_leaves(&mut self, is_wanted: impl Fn(u32) -> bool) {
        let mut bits = vec![0; self.leaves.len().div_ceil(u64::BITS as usize)];
        for (number, leaf) in self.leaves.iter().enumerate() {
            let form = u32::try_from(number)
                .ok()
                .and_then(|at| self.rounding.forms.get(&at));
            let can_be = leaf.knows_rounding() || form.is_some();
            if can_be && is_wanted(leaf.surface) || form.is_some_and(Rounded::is_search) {
                bits[number / u64::BITS as usize] |= 1 << (number % u64::BITS as usize);
            }
        }
        self.rounding.leaves = bits;
    }

    /// Number of its primitives, with those of its instances.
    pub(super) fn len(&self) -> u32 {
        match self.instances.last() {
            Some(last) => last.first + last.model.len(),
            None => u32::try_from(self.leaves.len()).expect("the number of objects is limited"),
        }
    }

    /// The packet algorithm of a program.
    #[inline(always)]
    pub(super) fn packet_strategy(&self, program: u32) -> PacketStrategy {
        self.strategies[program as usize]
    }

    /// Returns true if packets of four rays can intersect an item.
    #[inline(always)]
    pub(super) fn suits_packets(&self, item: Item) -> bool {
        match item {
            Item::Program(program) => self.packet_strategy(program) != PacketStrategy::Scalar,
            Item::Leaf(leaf) => {
                let shape = &self.leaves[leaf as usize].shape;
                shape.has_nearest_packet()
                    || matches!(shape, Shape::Mesh(mesh) if mesh.suits_packets())
            }
            Item::Instance(copy) => self.instances[copy as usize].model.cluster.is_some(),
        }
    }

    /// The instance that a leaf belongs to, unless it is the model's own.
    fn instance_of(&self, leaf: u32) -> Option<&Instance> {
        let is_own = (leaf as usize) < self.leaves.len();
        let behind = || self.instances.partition_point(|one| one.first <= leaf);
        if is_own {
            None
        } else {
            self.instances.get(behind() - 1)
        }
    }

    /// A leaf, if it is a sphere in world coordinates.
    pub(super) fn world_sphere(&self, leaf: u32) -> Option<&Sphere> {
        self.leaves.get(leaf as usize)?.world_sphere()
    }

    /// The unit outward normals at a point of a leaf that a ray in direction `dir` hit: the geometric one and the shading
    /// normal.
    #[inline]
    pub(super) fn normals(&self, leaf: u32, point: DVec3, dir: DVec3, face: u32) -> (DVec3, DVec3) {
        match self.leaves.get(leaf as usize) {
            Some(leaf) => leaf.normals(point, dir, face),
            None => self
                .instance_of(leaf)
                .map_or((DVec3::ZERO, DVec3::ZERO), |instance| {
                    instance.normals(leaf, point, dir, face)
                }),
        }
    }

    /// The weights of the shape's own textures at a point of a leaf.
    pub(super) fn texture_weights(&self, leaf: u32, point: DVec3, face: u32) -> TextureWeights {
        match self.instance_of(leaf) {
            Some(instance) => {
                let point = instance.object_from_world.transform_point3(point);
                instance
                    .model
                    .texture_weights(leaf - instance.first, point, face)
            }
            None => self.leaves[leaf as usize].texture_weights(point, face),
        }
    }

    /// The texture coordinates at a point of a leaf; `None` if the world's apply.
    pub(super) fn uv(&self, leaf: u32, point: DVec3, face: u32) -> Option<[f64; 2]> {
        match self.instance_of(leaf) {
            Some(instance) => {
                let point = instance.object_from_world.transform_point3(point);
                instance.model.uv(leaf - instance.first, point, face)
            }
            None => self.leaves[leaf as usize].uv(point, face),
        }
    }

    /// Returns true if inside and outside of a primitive are exchanged: it is inverse, or a difference subtracts it.
    pub(super) fn is_inverse(&self, leaf: u32) -> bool {
        if let Some(instance) = self.instance_of(leaf) {
            return instance.model.is_inverse(leaf - instance.first);
        }
        let program = self.program_of(leaf);
        program.is_some_and(|program| program.is_inverse(leaf - program.first))
    }

    /// The program of which one of the model's own leaves is an operand.
    pub(super) fn program_of(&self, leaf: u32) -> Option<&CsgProgram> {
        let behind = self
            .programs
            .partition_point(|program| program.first <= leaf);
        let program = behind.checked_sub(1).map(|at| &self.programs[at])?;
        program.leaves().contains(&leaf).then_some(program)
    }

    /// The shape of a primitive.
    pub(super) fn shape(&self, leaf: u32) -> &Shape {
        match self.instance_of(leaf) {
            Some(instance) => instance.model.shape(leaf - instance.first),
            None => &self.leaves[leaf as usize].shape,
        }
    }

    /// Appends the surface of an item to `surfaces` if it contains a point; for an instance, the surfaces of all its
    /// items that do. `base` is the index of the model's first surface.
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
                for number in model.bvh.around(point) {
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

    /// Returns true if an item contains a point.
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

    /// Returns true if a point lies in any item.
    pub(super) fn holds(&self, point: DVec3) -> bool {
        let mut unbounded = self.bvh.unbounded.iter();
        unbounded.any(|item| self.item_holds(item.item, point))
            || self.bvh.tree.visit_containing(point, |position| {
                self.item_holds(self.bvh.bounded[position as usize].item, point)
            })
    }
}

/// An item with its index in file order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IndexedItem {
    pub(crate) number: u32,
    pub(crate) item: Item,
}

/// The items of a model and the BVH over them.
#[derive(Debug)]
pub(crate) struct ItemBvh {
    /// BVH over `bounded`.
    pub(crate) tree: Bvh,
    /// In BVH order.
    pub(crate) bounded: Vec<IndexedItem>,
    /// Items without a finite box.
    pub(crate) unbounded: Vec<IndexedItem>,
}

impl ItemBvh {
    /// The items whose boxes contain a point.
    pub(crate) fn around(&self, point: DVec3) -> Vec<IndexedItem> {
        let mut items = self.unbounded.clone();
        self.tree.visit_containing(point, |position| {
            items.push(self.bounded[position as usize]);
            false
        });
        items
    }
}

/// A shared model with its transform.
#[derive(Debug)]
pub(crate) struct Instance {
    /// The shared model.
    pub(crate) model: Arc<Model>,
    /// World-to-model matrix; the world is the surrounding model.
    pub(crate) object_from_world: DAffine3,
    /// Index of its first leaf.
    pub(crate) first: u32,
    /// Index of its first surface.
    pub(crate) surface: u32,
}

impl Instance {
    /// The same as [`Model::normals`].
    pub(crate) fn normals(&self, leaf: u32, point: DVec3, dir: DVec3, face: u32) -> (DVec3, DVec3) {
        let local = self.object_from_world.transform_point3(point);
        let dir = self.object_from_world.transform_vector3(dir);
        let (geometric, shading) = self.model.normals(leaf - self.first, local, dir, face);
        let around =
            |normal| normal_from_inverse(&self.object_from_world, normal).normalize_or_zero();
        let turned = around(geometric);
        let is_smooth = shading != geometric;
        (turned, if is_smooth { around(shading) } else { turned })
    }
}

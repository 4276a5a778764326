//! The compiled scene: prepared surfaces, the BVH over the objects, lights, camera, and global shading settings.

use super::csg::sweep::RawHit;
use super::interiors::{InteriorId, Interiors};
use super::light_buffers::LightBuffers;
use super::lights::Lights;
use super::model::{IndexedItem, Item, ItemBvh, Model};
use super::photons::PhotonMapping;
use super::primitive::Leaf;
use super::slabs::{SingleBox, SlabTree};
use super::surface::{Surface, SurfaceSummary};
use crate::base::color::{Color, Gamma, Rgb};
use crate::base::math::Bounds;
use crate::base::math::conditioning::Normalization;
use crate::base::math::noise::NoiseGenerator;
use crate::base::options::TMinRule;
use crate::scene::atmosphere::{Fog, PreparedSky, Rainbow};
use crate::scene::camera::{Camera, Lens};
use crate::scene::function::RidgedCalls;
use crate::scene::interior::PreparedMedia;
use crate::scene::shape::{Geometry, Shape, TextureWeights};
use crate::scene::{RadiositySettings, Subsurface};
use crate::world::ray::{Hit, RayKind, SpawnSurface};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use std::sync::{Arc, OnceLock};

/// Global shading settings.
#[derive(Clone, Debug)]
pub struct Globals {
    /// The noise generator of patterns and bumps.
    pub noise: NoiseGenerator,
    /// `adc_bailout`.
    pub adc_bailout: f64,
    /// Length that stands for one unit in POV-Ray's own absolute lengths.
    pub unit: f64,
    /// `mm_per_unit`, for units of the world: millimetres per unit of length.
    pub mm_per_unit: f64,
    /// The origin of the scene's own coordinate system.
    pub origin: DVec3,
    /// `max_trace_level`.
    pub max_trace_level: u32,
    /// `radiosity { importance }` of objects without their own: the share of sample rays that count there.
    pub importance: f64,
    /// `ambient_light`.
    pub ambient_light: Rgb,
    /// `irid_wavelength`.
    pub irid_wavelength: Rgb,
    /// If true, transparency and background follow the rules of version 3.7 and later (the effective version).
    pub rules_37: bool,
    /// True if the scene follows the rules of version 3.8.
    pub is_3_8: bool,
    /// If true, the picture has an alpha channel: the transparency of the background.
    pub has_alpha: bool,
    /// The working space; `None` without gamma handling.
    pub working_gamma: Option<Gamma>,
    /// The calls of `f_ridged_mf`.
    pub ridged_calls: Arc<RidgedCalls>,
}

impl Globals {
    /// The rounding of unit vectors.
    #[must_use]
    pub fn normalization(&self) -> Normalization {
        Normalization::of_version(self.is_3_8)
    }
}

/// A compiled scene.
#[derive(Debug)]
pub struct World {
    /// The camera.
    pub camera: Camera,
    /// Its lens, if it has one.
    pub lens: Option<Lens>,
    /// The lights, in the order of the scene.
    pub lights: Lights,
    /// The surface attributes of the objects, by [`Hit::surface`].
    pub surfaces: Vec<Surface>,
    /// The interiors, by [`InteriorId`].
    pub interiors: Interiors,
    /// The colour of rays that hit nothing.
    pub background: Color,
    /// The sky in front of it.
    pub sky: Option<PreparedSky>,
    /// Media that fill all space.
    pub media: Vec<PreparedMedia>,
    /// The fogs, without those that have no effect.
    pub fogs: Vec<Fog>,
    /// The rainbows.
    pub rainbows: Vec<Rainbow>,
    /// The settings of radiosity (indirect diffuse light), if it is on.
    pub radiosity: Option<RadiositySettings>,
    /// The settings of subsurface light, if some surface uses it.
    pub subsurface: Option<Subsurface>,
    /// Photon mapping, if it is on.
    pub photons: Option<PhotonMapping>,
    /// The settings of shading.
    pub globals: Globals,
    /// All objects.
    pub(super) model: Model,
    /// The large meshes that bundles traverse; empty if there are too many.
    pub(super) meshes: Vec<IndexedItem>,
    /// Single-precision boxes of the items.
    pub(super) boxes: Vec<SingleBox>,
    /// POV-Ray's boxes of items of which they are others, by the number of the item.
    pub(super) povray_boxes: FxHashMap<u32, SingleBox>,
    /// POV-Ray's tree of its boxes, built for the first tie that needs it.
    pub(super) slab_tree: OnceLock<SlabTree>,
    pub(super) ties_by_box: bool,
    /// Properties of the surfaces as a whole.
    pub(super) summary: SurfaceSummary,
    pub(super) least_distance: TMinRule,
    /// Distance from which hits are ignored: that of POV-Ray with radiosity or where its distances are followed, else infinite.
    pub(super) t_max: f64,
    pub(super) light_buffers: LightBuffers,
    /// True if packets of four incoherent rays intersect the unbounded items: some are CSG programs that suit packets.
    pub(super) uses_packets: bool,
    /// True if streams of incoherent rays traverse the BVH: many of its items are such programs. Other items are so
    /// cheap to intersect that the best traversal order of each ray counts for more.
    pub(super) streams: bool,
}

impl World {
    /// Counts the CSG programs among these items that packets of four rays can intersect, and the other items.
    pub(super) fn packet_programs(&self, items: &[IndexedItem]) -> (usize, usize) {
        let suits = |item: &&IndexedItem| {
            matches!(item.item, Item::Program(_)) && self.model.suits_packets(item.item)
        };
        let suited = items.iter().filter(suits).count();
        (suited, items.len() - suited)
    }

    #[inline(always)]
    pub(super) fn bvh(&self) -> &ItemBvh {
        &self.model.bvh
    }

    /// Returns true if the closest hit on an item settles the query: rays of this kind see it, and for shadow rays it
    /// is opaque or the whole item is transmissive.
    #[inline(always)]
    pub(super) fn is_decisive(&self, item: Item, hit: &RawHit, kind: RayKind) -> bool {
        self.is_seen(hit, kind)
            && (kind != RayKind::Shadow || self.ends_light(hit) || self.is_clear(item))
    }

    /// Returns true if a hit ends a shadow ray: its surface is opaque, or counts as such for the shape that was hit.
    #[inline(always)]
    pub(super) fn ends_light(&self, hit: &RawHit) -> bool {
        let surface = hit.surface;
        let ends = || self.blocks_light_from_inside(surface, self.model.shape(hit.leaf));
        self.summary.is_opaque
            || self.summary.ends_light[surface as usize]
            || self.summary.has_clear_insides && ends()
    }

    /// Returns true if a shape with this surface ends shadow rays although its `interior_texture` is not opaque.
    #[inline(never)]
    fn blocks_light_from_inside(&self, surface: u32, shape: &Shape) -> bool {
        self.surfaces[surface as usize].has_clear_inside() && shape.casts_shadow_of_outside()
    }

    /// Returns true if a primitive ends shadow rays; for scenes that are not all opaque.
    fn blocks_light_everywhere(&self, leaf: &Leaf) -> bool {
        self.summary.ends_light[leaf.surface as usize]
            || self.summary.has_clear_insides
                && self.blocks_light_from_inside(leaf.surface, &leaf.shape)
    }

    /// Returns true if hits within POV-Ray's minimum distances are left out.
    #[must_use]
    pub fn has_povray_distances(&self) -> bool {
        self.least_distance == TMinRule::PovRay
    }

    /// Returns true if all primitives of an item end shadow rays; false if unknown.
    pub(super) fn is_all_opaque(&self, item: Item) -> bool {
        let is_opaque = |leaf: &Leaf| self.blocks_light_everywhere(leaf);
        let leaves = self.leaves_of(item);
        self.summary.is_opaque || leaves.is_some_and(|leaves| leaves.iter().all(is_opaque))
    }

    /// Returns true if shadow rays are traced faster in packets although those that pass transmissive surfaces are traced
    /// again: there is CSG to be spared, and all of it is opaque.
    #[must_use]
    pub fn suits_shadow_packets(&self) -> bool {
        let items = self.bvh().unbounded.iter().chain(self.bvh().bounded.iter());
        let mut parts = items.filter(|item| !matches!(item.item, Item::Leaf(_)));
        self.summary.is_opaque
            || parts.next().is_some_and(|first| {
                self.is_all_opaque(first.item) && parts.all(|item| self.is_all_opaque(item.item))
            })
    }

    /// Returns true if no primitive of an item is known to end shadow rays; false if unknown.
    #[inline(never)]
    fn is_clear(&self, item: Item) -> bool {
        let leaves = self.leaves_of(item);
        let is_opaque = |leaf: &Leaf| self.blocks_light_everywhere(leaf);
        leaves.is_some_and(|leaves| !leaves.iter().any(is_opaque))
    }

    /// Returns true if rays of this kind see nothing of an item; false if unknown.
    #[inline(always)]
    pub(super) fn is_hidden(&self, item: Item, kind: RayKind) -> bool {
        self.summary.hides_some && self.is_all_hidden(item, kind)
    }

    #[inline(never)]
    fn is_all_hidden(&self, item: Item, kind: RayKind) -> bool {
        let is_seen = |leaf: &Leaf| self.surfaces[leaf.surface as usize].is_seen(kind);
        let leaves = self.leaves_of(item);
        leaves.is_some_and(|leaves| !leaves.iter().any(is_seen))
    }

    /// The leaves of an item, unless it is an instance.
    fn leaves_of(&self, item: Item) -> Option<&[Leaf]> {
        let leaves = match item {
            Item::Leaf(leaf) => leaf..leaf + 1,
            Item::Program(number) => self.model.programs[number as usize].leaves(),
            Item::Instance(_) => return None,
        };
        Some(&self.model.leaves[leaves.start as usize..leaves.end as usize])
    }

    /// Returns true if there is neither fog nor a rainbow.
    #[must_use]
    pub fn has_clear_atmosphere(&self) -> bool {
        self.fogs.is_empty() && self.rainbows.is_empty()
    }

    /// Returns true if nothing in the scene is transmissive.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.summary.is_opaque
    }

    /// Transmittance of a surface, if it is uniform. `None` for all surfaces of an opaque scene.
    #[must_use]
    #[inline]
    pub fn uniform_transmittance(&self, surface: u32) -> Option<Rgb> {
        let filters = &self.summary.filters;
        filters.get(surface as usize).copied().flatten()
    }

    /// Returns true if some surface has a Fresnel reflection.
    #[must_use]
    pub fn has_fresnel(&self) -> bool {
        self.summary.has_fresnel
    }

    /// Returns true if light from behind may matter to some surface.
    #[must_use]
    pub fn needs_backface_light(&self) -> bool {
        self.summary.needs_backface_light
    }

    /// Returns true if some surfaces do not respond to light sources.
    #[must_use]
    pub fn has_unlit(&self) -> bool {
        self.summary.has_unlit
    }

    /// The interiors of all objects that contain a point: of the unbounded ones first, then of the others in file
    /// order. Where POV-Ray builds no tree, all in file order.
    #[must_use]
    pub fn interiors_at(&self, point: DVec3) -> SmallVec<[InteriorId; 4]> {
        let mut items = self.model.bvh.around(point);
        let is_bounded = |number: u32| self.ties_by_box && self.tree_box(number).is_some();
        items.sort_unstable_by_key(|item| (is_bounded(item.number), item.number));
        self.interiors_of(&items, point)
    }

    /// The interiors in which photons of a light at this point start: those of all objects that contain it, in file
    /// order. POV-Ray tests no boxes there, although the insides of discs and of inverse objects reach beyond theirs.
    #[must_use]
    pub fn interiors_at_light(&self, point: DVec3) -> SmallVec<[InteriorId; 4]> {
        let bvh = &self.model.bvh;
        let reaches_farther = |item: &&IndexedItem| match item.item {
            Item::Leaf(leaf) => {
                let shape = &self.model.leaves[leaf as usize].shape;
                !shape.solid_bounds().is_finite()
            }
            Item::Program(_) => true,
            Item::Instance(_) => false,
        };
        let mut items = bvh.around(point);
        items.extend(bvh.bounded.iter().filter(reaches_farther));
        items.sort_unstable_by_key(|item| item.number);
        items.dedup_by_key(|item| item.number);
        self.interiors_of(&items, point)
    }

    /// The interiors of those of these items that contain a point.
    fn interiors_of(&self, items: &[IndexedItem], point: DVec3) -> SmallVec<[InteriorId; 4]> {
        let mut surfaces = Vec::new();
        for item in items {
            self.model
                .surfaces_around(item.item, point, 0, &mut surfaces);
        }
        let interior = |surface: u32| self.surfaces[surface as usize].interior;
        surfaces.into_iter().map(interior).collect()
    }

    /// Returns true if POV-Ray's normals of a primitive point into its shape: it is inverse, or a difference subtracts it.
    #[must_use]
    pub fn turns_normals(&self, leaf: u32) -> bool {
        let shape = self.model.shape(leaf);
        self.model.is_inverse(leaf)
            && !shape.keeps_normal()
            && (self.globals.is_3_8 || !shape.keeps_normal_before_3_8())
    }

    /// Returns true if a point lies in any object.
    #[must_use]
    pub fn holds(&self, point: DVec3) -> bool {
        self.model.holds(point)
    }

    /// The weights of the textures in [`Surface::face_textures`] at a hit; empty if the object's own texture applies.
    #[must_use]
    pub fn texture_weights(&self, hit: &Hit) -> TextureWeights {
        if let Some(cutaway) = self.surfaces[hit.surface as usize].cutaway() {
            return cutaway.texture_weights(hit.point);
        }
        let SpawnSurface { leaf, face, .. } = hit.spawn_surface;
        self.model.texture_weights(leaf, hit.point, face)
    }

    /// Returns true if a hit looks the same from both sides, regardless of `interior_texture`: that holds for blobs
    /// whose components have their own textures, and not for meshes (checked with POV-Ray).
    #[must_use]
    pub fn has_one_side(&self, hit: &Hit) -> bool {
        let has_one_side = || self.model.shape(hit.spawn_surface.leaf).has_one_side();
        !self.surfaces[hit.surface as usize]
            .face_textures()
            .is_empty()
            && has_one_side()
    }

    /// The texture coordinates at a hit: those of the shape before all transforms, or the position in world space.
    #[must_use]
    pub fn uv(&self, hit: &Hit) -> DVec2 {
        let SpawnSurface { leaf, face, .. } = hit.spawn_surface;
        let own = match self.surfaces[hit.surface as usize].unmoved() {
            Some(unmoved) => unmoved.uv(hit.point, face),
            None => self.model.uv(leaf, hit.point, face),
        };
        match own {
            Some(uv) => DVec2::from(uv),
            None => ((hit.point - self.globals.origin) / self.globals.unit).truncate(),
        }
    }

    /// Returns true if some surface is hidden from some kind of ray.
    pub(super) fn hides_some(&self) -> bool {
        self.summary.hides_some
    }

    /// The primitives of the world, without those of instances.
    #[must_use]
    pub fn leaves(&self) -> &[Leaf] {
        &self.model.leaves
    }

    /// The box of an item that POV-Ray compares where two surfaces tie; none of one that is unbounded to it.
    pub(super) fn tree_box(&self, item: u32) -> Option<&SingleBox> {
        let own_box = self.povray_boxes.get(&item);
        let item_box = own_box.unwrap_or(&self.boxes[item as usize]);
        item_box.is_bounded(self.globals.unit).then_some(item_box)
    }

    /// Boxes around all objects, wider by the roundings to single precision.
    pub fn boxes(&self) -> impl Iterator<Item = Bounds> {
        self.boxes.iter().map(SingleBox::bounds)
    }

    /// Number of visible primitives, with those of instances.
    #[must_use]
    pub fn primitive_count(&self) -> u32 {
        self.model.len()
    }

    #[inline(always)]
    pub(super) fn is_seen(&self, hit: &RawHit, kind: RayKind) -> bool {
        !self.summary.hides_some || self.surfaces[hit.surface as usize].is_seen(kind)
    }
}

impl World {
    /// Returns true if the camera and all lights have light buffers.
    #[must_use]
    pub fn has_all_light_buffers(&self) -> bool {
        self.light_buffers.are_all_known()
    }

    /// Returns true if camera rays between these slopes certainly hit nothing; slopes run across and up the picture
    /// from -0.5 to 0.5.
    #[must_use]
    pub fn is_background(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        let camera = self.light_buffers.camera.as_ref();
        self.bvh().unbounded.is_empty()
            && camera.is_some_and(|light_buffer| light_buffer.is_empty(low, high))
    }
}

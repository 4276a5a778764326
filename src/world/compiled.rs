//! What rays need and no more: prepared surfaces, a tree over them, lights, camera, and the settings of shading.

use super::bvh_items::{IndexedItem, ItemBvh};
use super::csg::program::RawHit;
use super::interiors::{InteriorId, Interiors};
use super::lights::Lights;
use super::lower::flatten::Lowering;
use super::lower::light_buffers::LightBuffers;
use super::model::{Item, Model};
use super::primitive::Leaf;
use super::query::{Hit, RayKind, SpawnSurface};
use super::surface::{Surface, SurfaceSummary};
use crate::base::color::{Color, Gamma, Rgb};
use crate::base::math::Bounds;
use crate::base::math::noise::NoiseGenerator;
use crate::base::options::{LeastDistance, RenderOptions};
use crate::render::photons::Photons;
use crate::render::radiosity::Radiosity;
use crate::scene::Scene;
use crate::scene::atmosphere::{Fog, PreparedSky, Rainbow};
use crate::scene::camera::{Camera, Lens};
use crate::scene::interior::PreparedMedia;
use crate::scene::shape::{Shape, TextureWeights};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use smallvec::SmallVec;

/// The settings of shading.
#[derive(Clone, Debug)]
pub struct Globals {
    /// The noise of what is uneven.
    pub noise: NoiseGenerator,
    /// `adc_bailout`.
    pub adc_bailout: f64,
    /// The length in which POV-Ray's own lengths count.
    pub unit: f64,
    /// Where the origin of the scene's own coordinates lies.
    pub origin: DVec3,
    /// `max_trace_level`.
    pub max_trace_level: u32,
    /// `ambient_light`.
    pub ambient_light: Rgb,
    /// `irid_wavelength`.
    pub irid_wavelength: Rgb,
    /// Whether the rules of version 3.7 and later hold for transparency and background (the effective version).
    pub rules_37: bool,
    /// Whether the picture keeps the transparency of the background.
    pub has_alpha: bool,
    /// The working space; `None` without gamma handling.
    pub working_gamma: Option<Gamma>,
}

/// With fewer objects and lights than this POV-Ray keeps no tree, and ties go by the order of the file.
const TREE_FROM: usize = 3;

/// Below this quality there is no radiosity (facts 4.11).
const QUALITY_OF_RADIOSITY: u8 = 9;

/// A scene, ready for rays.
#[derive(Debug)]
pub struct World {
    /// The camera.
    pub camera: Camera,
    /// Its lens, if it has one.
    pub lens: Option<Lens>,
    /// The lights, in the order of the scene.
    pub lights: Lights,
    /// The looks of the objects, by [`Hit::surface`].
    pub surfaces: Vec<Surface>,
    /// The interiors, by [`InteriorId`].
    pub interiors: Interiors,
    /// The colour of rays that hit nothing.
    pub background: Color,
    /// The sky in front of it.
    pub sky: Option<PreparedSky>,
    /// What fills all space.
    pub media: Vec<PreparedMedia>,
    /// The fogs, none that does nothing.
    pub fogs: Vec<Fog>,
    /// The rainbows.
    pub rainbows: Vec<Rainbow>,
    /// Light that surfaces gather from each other, if it is drawn.
    pub radiosity: Option<Radiosity>,
    /// How photons are shot, if any are.
    pub photons: Option<Photons>,
    /// The settings of shading.
    pub globals: Globals,
    /// All objects.
    pub(super) model: Model,
    /// The large meshes, if there are few.
    pub(super) meshes: Vec<IndexedItem>,
    /// The boxes of the items in single precision, as POV-Ray compares them where two surfaces tie.
    pub(super) boxes: Vec<SingleBox>,
    pub(super) ties_by_box: bool,
    /// What holds of its surfaces.
    pub(super) overview: SurfaceSummary,
    pub(super) least_distance: LeastDistance,
    pub(super) vistas: LightBuffers,
    /// True if unbounded items are intersected by packets of four incoherent rays: some are CSG programs that suit packets.
    pub(super) asks_in_fours: bool,
    /// True if streams of incoherent rays traverse the tree: most of its items are such programs. Other items are so cheap
    /// to intersect that the best traversal order of each ray counts for more.
    pub(super) streams: bool,
}

impl World {
    pub(super) fn new(scene: &Scene, mut flat: Lowering, options: &RenderOptions) -> World {
        let has_tree = flat.parts.items.len() + flat.lights.len() >= TREE_FROM;
        let boxes = flat.parts.bounds.par_iter().map(SingleBox::new).collect();
        let parts = std::mem::take(&mut flat.parts);
        let model = Model::new(parts, &mut flat.surfaces, flat.lights.projectors_mut());
        let transparent = Color {
            transmit: 1.0,
            ..Color::default()
        };
        let radiosity = scene.globals.radiosity;
        let radiosity = radiosity.filter(|_| options.quality >= QUALITY_OF_RADIOSITY);
        // From version 3.7 on gathered light stands for `ambient`.
        let ambient_light = match radiosity {
            Some(_) if scene.version >= 3.7 => Rgb::BLACK,
            _ => scene.globals.ambient_light,
        };
        let mut world = World {
            camera: scene.camera.prepared(&scene.pattern_settings()),
            lens: Lens::new(&scene.camera, &scene.pattern_settings()),
            background: scene.background.color.unwrap_or(transparent),
            sky: scene
                .atmosphere
                .sky_sphere
                .as_ref()
                .map(|sky| sky.prepare(&scene.pattern_settings(), scene.version >= 3.7)),
            media: scene
                .atmosphere
                .media
                .iter()
                .map(|media| media.prepare(&[], &scene.pattern_settings()))
                .collect(),
            fogs: scene
                .atmosphere
                .fogs
                .iter()
                .filter(|fog| fog.exists())
                .cloned()
                .collect(),
            rainbows: scene.atmosphere.rainbows.clone(),
            globals: Globals {
                noise: scene.pattern_settings().noise_generator,
                adc_bailout: scene.globals.adc_bailout,
                unit: scene.globals.unit,
                origin: scene.globals.origin,
                max_trace_level: scene.globals.max_trace_level,
                ambient_light,
                irid_wavelength: scene.globals.irid_wavelength,
                rules_37: scene.version >= 3.7,
                has_alpha: options.alpha,
                working_gamma: scene.working_gamma(),
            },
            ties_by_box: has_tree,
            least_distance: options.least_distance,
            overview: SurfaceSummary::of(&flat.surfaces),
            radiosity: radiosity
                .map(|settings| Radiosity::new(settings, scene.globals.importance.share())),
            photons: flat.targets.and_then(|targets| {
                let settings = scene.globals.photons.as_ref()?;
                Photons::new(settings, targets.into_list(), &scene.globals)
            }),
            boxes,
            lights: flat.lights,
            surfaces: flat.surfaces,
            interiors: flat.interiors,
            model,
            meshes: Vec::new(),
            vistas: LightBuffers::default(),
            asks_in_fours: false,
            streams: false,
        };
        let (suited, _) = world.combinations_for_four(&world.finder().unbounded);
        world.asks_in_fours = suited > 0;
        let (suited, others) = world.combinations_for_four(&world.finder().bounded);
        world.streams = suited > 0 && suited >= others;
        world.meshes = world.large_meshes();
        world
    }

    /// Counts the CSG programs among these items that packets of four rays can intersect, and the other items.
    fn combinations_for_four(&self, items: &[IndexedItem]) -> (usize, usize) {
        let suits = |item: &&IndexedItem| {
            matches!(item.item, Item::Program(_)) && self.model.suits_four(item.item)
        };
        let suited = items.iter().filter(suits).count();
        (suited, items.len() - suited)
    }

    #[inline(always)]
    pub(super) fn finder(&self) -> &ItemBvh {
        &self.model.finder
    }

    /// Whether the nearest surface of an item tells all about it: such rays see it, and if they go to a light it lets none
    /// through, or all of the item lets some through.
    #[inline(always)]
    pub(super) fn tells_all(&self, item: Item, found: &RawHit, seen: RayKind) -> bool {
        self.is_seen(found, seen)
            && (seen != RayKind::Shadow || self.ends_light(found) || self.is_clear(item))
    }

    /// Whether a surface lets no light through.
    #[inline(always)]
    pub(super) fn ends_light(&self, found: &RawHit) -> bool {
        self.overview.is_opaque || self.overview.opaque[found.surface as usize]
    }

    /// Whether no surface of an item is opaque; what is not known is false.
    #[inline(never)]
    fn is_clear(&self, item: Item) -> bool {
        let leaves = self.leaves_of(item);
        let is_opaque = |leaf: &Leaf| self.overview.opaque[leaf.surface as usize];
        leaves.is_some_and(|leaves| !leaves.iter().any(is_opaque))
    }

    /// Whether such rays see nothing of an item; what is not known is false.
    #[inline(always)]
    pub(super) fn is_hidden(&self, item: Item, seen: RayKind) -> bool {
        self.overview.hides_some && self.is_all_hidden(item, seen)
    }

    #[inline(never)]
    fn is_all_hidden(&self, item: Item, seen: RayKind) -> bool {
        let is_seen = |leaf: &Leaf| self.surfaces[leaf.surface as usize].is_seen(seen);
        let leaves = self.leaves_of(item);
        leaves.is_some_and(|leaves| !leaves.iter().any(is_seen))
    }

    /// The leaves of an item that is no instance.
    fn leaves_of(&self, item: Item) -> Option<&[Leaf]> {
        let leaves = match item {
            Item::Leaf(leaf) => leaf..leaf + 1,
            Item::Program(number) => self.model.programs[number as usize].leaves(),
            Item::Instance(_) => return None,
        };
        Some(&self.model.leaves[leaves.start as usize..leaves.end as usize])
    }

    /// Whether there is neither fog nor a rainbow.
    #[must_use]
    pub fn has_clear_air(&self) -> bool {
        self.fogs.is_empty() && self.rainbows.is_empty()
    }

    /// Whether nothing in the scene lets light through.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.overview.is_opaque
    }

    /// The share of light that passes a surface, if that is the same everywhere and something can be seen through any.
    #[must_use]
    #[inline]
    pub fn even_filter(&self, surface: u32) -> Option<Rgb> {
        let filters = &self.overview.filters;
        filters.get(surface as usize).copied().flatten()
    }

    /// Whether the view through some surface matters to its mirror images.
    #[must_use]
    pub fn has_fresnel(&self) -> bool {
        self.overview.has_fresnel
    }

    /// Whether light that arrives from behind may matter to some surface.
    #[must_use]
    pub fn needs_backface_light(&self) -> bool {
        self.overview.minds_backs
    }

    /// Whether some surfaces take no light.
    #[must_use]
    pub fn has_unlit(&self) -> bool {
        self.overview.has_unlit
    }

    /// The interiors of all objects that hold a point: of the unbounded ones first, then of the others in the order
    /// of the file. Where POV-Ray keeps no tree, all are in the order of the file.
    #[must_use]
    pub fn interiors_at(&self, point: DVec3) -> SmallVec<[InteriorId; 4]> {
        let mut items = self.model.finder.around(point);
        let is_bounded =
            |number: u32| self.ties_by_box && self.boxes[number as usize].bounds().is_finite();
        items.sort_unstable_by_key(|item| (is_bounded(item.number), item.number));
        let mut surfaces = Vec::new();
        for item in items {
            self.model
                .surfaces_around(item.item, point, 0, &mut surfaces);
        }
        let interior = |surface: u32| self.surfaces[surface as usize].interior;
        surfaces.into_iter().map(interior).collect()
    }

    /// Whether inside and outside of a primitive are exchanged where it stands: it is inverse, or a difference takes it
    /// away.
    pub(super) fn is_inverse(&self, leaf: u32) -> bool {
        self.model.is_inverse(leaf)
    }

    /// The shape of a primitive.
    pub(super) fn shape(&self, leaf: u32) -> &Shape {
        self.model.shape(leaf)
    }

    /// Whether a point lies in any object.
    #[must_use]
    pub fn holds(&self, point: DVec3) -> bool {
        self.model.holds(point)
    }

    /// The shares of the textures in [`Surface::skins`] at a hit; none if it looks as the object does.
    #[must_use]
    pub fn shares(&self, hit: &Hit) -> TextureWeights {
        if let Some(cutaway) = self.surfaces[hit.surface as usize].cutaway() {
            return cutaway.shares(hit.point);
        }
        let SpawnSurface { leaf, face, .. } = hit.departure;
        self.model.shares(leaf, hit.point, face)
    }

    /// Whether a hit looks from inside as it does from outside, whatever `interior_texture` says: so it is with blobs whose
    /// components have textures of their own, and not with meshes (checked with POV-Ray).
    #[must_use]
    pub fn has_one_side(&self, hit: &Hit) -> bool {
        let is_blob = || matches!(self.model.shape(hit.departure.leaf), Shape::Blob(_));
        !self.surfaces[hit.surface as usize].skins().is_empty() && is_blob()
    }

    /// The texture coordinates at a hit: those of the shape as it was before all transforms, or the place in the world.
    #[must_use]
    pub fn uv(&self, hit: &Hit) -> DVec2 {
        let SpawnSurface { leaf, face, .. } = hit.departure;
        let own = match self.surfaces[hit.surface as usize].unmoved() {
            Some(unmoved) => unmoved.uv(hit.point, face),
            None => self.model.uv(leaf, hit.point, face),
        };
        match own {
            Some(uv) => DVec2::from(uv),
            None => ((hit.point - self.globals.origin) / self.globals.unit).truncate(),
        }
    }

    /// Whether some surface cannot be seen by some rays.
    pub(super) fn hides_some(&self) -> bool {
        self.overview.hides_some
    }

    /// The primitives of the world, without those of instances.
    #[must_use]
    pub fn leaves(&self) -> &[Leaf] {
        &self.model.leaves
    }

    /// The boxes of all objects, in single precision: they may be smaller than the objects by a rounding.
    pub fn boxes(&self) -> impl Iterator<Item = Bounds> {
        self.boxes.iter().map(SingleBox::bounds)
    }

    /// How many primitives there are to be seen, those of instances included.
    #[must_use]
    pub fn shown(&self) -> u32 {
        self.model.len()
    }

    #[inline(always)]
    pub(super) fn is_seen(&self, found: &RawHit, seen: RayKind) -> bool {
        !self.overview.hides_some || self.surfaces[found.surface as usize].is_seen(seen)
    }
}

/// A box in single precision, rounded to the nearest.
#[derive(Clone, Copy, Debug)]
pub(super) struct SingleBox([[f32; 3]; 2]);

impl SingleBox {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "POV-Ray keeps boxes in single precision"
    )]
    fn new(bounds: &Bounds) -> Self {
        // Spelt out: `map` is not always inlined.
        let single = |end: DVec3| [end.x as f32, end.y as f32, end.z as f32];
        SingleBox([single(bounds.min), single(bounds.max)])
    }

    /// The box.
    pub(super) fn bounds(&self) -> Bounds {
        let [min, max] = self.0.map(|end| DVec3::from(end.map(f64::from)));
        Bounds { min, max }
    }
}

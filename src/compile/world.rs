//! What rays need and no more: prepared surfaces, a tree over them, lights, camera, and the settings of shading.

use super::csg::{Found, Program, Sweep, hide_departure};
use super::flatten::{Flat, Item};
use super::interiors::{InteriorId, Interiors};
use super::leaf::Leaf;
use super::lights::{LightList, Lights};
use super::order::{Finder, Numbered};
use super::passed::Items;
use super::rays::Rays;
use crate::accel::Bundle;
use crate::atmosphere::{Fog, PreparedSky, Rainbow};
use crate::camera::{Camera, Lens};
use crate::color::{Color, Rgb};
use crate::math::lanes::with_widest;
use crate::math::mersenne::Stream;
use crate::math::noise::NoiseGenerator;
use crate::math::{Bounds, Ray};
use crate::options::{LeastDistance, RenderOptions};
use crate::scene::Scene;
use crate::shape::{Crossing, Geometry, Root, Shape, Shares};
use crate::texture::PreparedTexture;
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

/// The object switches that matter while tracing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// Casts no shadow.
    pub no_shadow: bool,
    /// Not seen by camera rays and their straight or refracted continuations.
    pub no_image: bool,
    /// Not seen by reflected rays.
    pub no_reflection: bool,
    /// Does not displace the atmosphere around it.
    pub hollow: bool,
    /// Lit from both sides.
    pub double_illuminate: bool,
}

/// How the surface of an object looks and what lies behind it.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The layers, with all transforms of the object taken in.
    pub texture: Arc<PreparedTexture>,
    /// The texture seen from inside, if the scene gives one.
    pub inside_texture: Option<Arc<PreparedTexture>>,
    /// The textures that pieces of the shape have of their own, moved like the layers.
    pub skins: Vec<Arc<PreparedTexture>>,
    /// The interior of the object.
    pub interior: InteriorId,
    /// The lights that shine on it.
    pub lights: LightList,
    /// Its switches.
    pub flags: Flags,
    /// What follows from its textures.
    traits: Traits,
}

/// Answers about the textures of a surface that every ray may ask for: the textures lie elsewhere in memory.
#[derive(Clone, Copy, Debug, Default)]
struct Traits {
    is_opaque: bool,
    is_lit_from_behind: bool,
    has_fresnel: bool,
}

impl Surface {
    /// A surface that looks so.
    pub(super) fn new(
        texture: Arc<PreparedTexture>,
        inside_texture: Option<Arc<PreparedTexture>>,
        skins: Vec<Arc<PreparedTexture>>,
        interior: InteriorId,
        (lights, flags): (LightList, Flags),
    ) -> Self {
        let textures = || {
            let two = std::iter::once(&texture).chain(&inside_texture);
            two.chain(&skins)
        };
        let layers = || textures().flat_map(|texture| texture.layers());
        let traits = Traits {
            is_opaque: textures().all(|texture| texture.is_opaque()),
            is_lit_from_behind: layers().any(|layer| layer.finish.diffuse_back != 0.0),
            has_fresnel: layers().any(|layer| layer.finish.reflection.is_fresnel),
        };
        Surface {
            texture,
            inside_texture,
            skins,
            interior,
            lights,
            flags,
            traits,
        }
    }

    /// Whether light that comes from behind can be seen on it.
    #[must_use]
    pub fn is_lit_from_behind(&self) -> bool {
        self.flags.double_illuminate || self.traits.is_lit_from_behind
    }

    /// Whether the view through it matters to its mirror images.
    #[must_use]
    pub fn has_fresnel(&self) -> bool {
        self.traits.has_fresnel
    }

    /// Whether the two need not be told apart.
    pub(super) fn is_same(&self, other: &Surface) -> bool {
        let same_inside = match (&self.inside_texture, &other.inside_texture) {
            (None, None) => true,
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            _ => false,
        };
        let same_skins = self.skins.is_empty() && other.skins.is_empty();
        same_inside
            && same_skins
            && Arc::ptr_eq(&self.texture, &other.texture)
            && self.interior == other.interior
            && self.lights == other.lights
            && self.flags == other.flags
    }

    /// Whether nothing can be seen through it.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.traits.is_opaque
    }
}

/// The root that a spawned ray left, so that it does not find it again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// The leaf.
    pub leaf: u32,
    /// The piece of its surface.
    pub face: u32,
    /// The outward geometric normal there, in the world.
    pub normal: DVec3,
    /// What the old ray did there.
    pub crossing: Crossing,
    /// A bound on the error of coordinates at the point: below this distance nothing can be told apart.
    pub blur: f64,
}

/// What a ray found.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance along the (unit) ray.
    pub t: f64,
    /// The point in the world.
    pub point: DVec3,
    /// The unit outward geometric normal in the world.
    pub normal: DVec3,
    /// The unit normal for shading, before any `normal` pattern; differs on smooth triangles only.
    pub shading_normal: DVec3,
    /// Index into [`World::surfaces`].
    pub surface: u32,
    /// For the rays that leave from here.
    pub departure: Departure,
}

/// Who looks: decides between `no_image`, `no_reflection` and `no_shadow`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// A camera ray, or its straight or refracted continuation.
    Image,
    /// A reflected ray and what comes of it.
    Reflection,
    /// A ray to a light.
    Shadow,
}

/// One question to the world.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// The ray; its direction has length 1.
    pub ray: Ray,
    /// The root it left, for all but camera rays.
    pub from: Option<Departure>,
    /// Nothing at or beyond this distance counts; infinite for none.
    pub far: f64,
    /// Who asks.
    pub seen: Seen,
}

/// Buffers that a thread keeps between questions.
#[derive(Debug, Default)]
pub struct Scratch {
    /// The light that came from each lamp of the area light at hand, as far as it is known.
    pub lamps: Vec<Option<Rgb>>,
    /// How many rays were followed.
    pub rays: Rays,
    /// The random numbers of the sample at hand.
    pub stream: Stream,
    /// The state of the generator that `crand` draws from.
    pub crand: u32,
    pub(super) sweep: Sweep,
    pub(super) roots: Vec<Root>,
    /// For each light, the item that stood last in its way.
    blockers: SmallVec<[u32; 8]>,
    pub(super) bundle: Bundle,
    pub(super) bests: Vec<Option<Best>>,
    /// What the ray to a light meets that is being followed.
    pub(super) among: Items,
}

/// What lies between a point and a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Nothing.
    Free,
    /// Only surfaces that may let light through.
    Filtered,
    /// Something opaque.
    Blocked,
}

/// The settings of shading.
#[derive(Clone, Debug)]
pub struct Globals {
    /// The noise of what is uneven.
    pub noise: NoiseGenerator,
    /// `adc_bailout`.
    pub adc_bailout: f64,
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
}

/// Below this share of the coordinates' size two surfaces are not told apart by a ray that leaves one of them:
/// 4096 roundings of a double, which covers a chain of transforms and a slanted hit.
const BLUR: f64 = 1.0 / (1u64 << 40) as f64;
/// POV-Ray's least distances, in units of the scene: for shadows and for all other rays.
const POV_RAY_SHADOW: f64 = 1e-3;
const POV_RAY_LEAST: f64 = 1e-4;
/// With fewer objects and lights than this POV-Ray keeps no tree, and ties go by the order of the file.
const TREE_FROM: usize = 3;

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
    /// The fogs, none that does nothing.
    pub fogs: Vec<Fog>,
    /// The rainbows.
    pub rainbows: Vec<Rainbow>,
    /// The settings of shading.
    pub globals: Globals,
    pub(super) leaves: Vec<Leaf>,
    pub(super) programs: Vec<Program>,
    /// For each program, whether four rays can be asked about at once.
    suits_four: Vec<bool>,
    items: Vec<Item>,
    /// The boxes of the items in single precision, as POV-Ray compares them where two surfaces tie.
    boxes: Vec<Bounds>,
    finder: Finder,
    ties_by_box: bool,
    is_opaque: bool,
    /// For each surface, whether nothing can be seen through it.
    opaque: Vec<bool>,
    /// Whether some surface cannot be seen by some rays.
    hides_some: bool,
    least_distance: LeastDistance,
}

/// The best surface on a ray so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Best {
    pub(super) found: Found,
    item: u32,
}

impl World {
    pub(super) fn new(scene: &Scene, mut flat: Flat, options: &RenderOptions) -> World {
        let finder = Finder::new(&mut flat);
        let transparent = Color {
            transmit: 1.0,
            ..Color::default()
        };
        World {
            camera: scene.camera.clone(),
            lens: Lens::new(&scene.camera, &scene.pattern_settings()),
            background: scene.background.color.unwrap_or(transparent),
            sky: scene
                .atmosphere
                .sky_sphere
                .as_ref()
                .map(|sky| sky.prepare(&scene.pattern_settings(), scene.version >= 3.7)),
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
                max_trace_level: scene.globals.max_trace_level,
                ambient_light: scene.globals.ambient_light,
                irid_wavelength: scene.globals.irid_wavelength,
                rules_37: scene.version >= 3.7,
                has_alpha: options.alpha,
            },
            ties_by_box: flat.items.len() + flat.lights.len() >= TREE_FROM,
            least_distance: options.least_distance,
            is_opaque: flat.surfaces.iter().all(Surface::is_opaque),
            opaque: flat.surfaces.iter().map(Surface::is_opaque).collect(),
            hides_some: flat.surfaces.iter().any(|surface| {
                let flags = &surface.flags;
                flags.no_image || flags.no_reflection || flags.no_shadow
            }),
            boxes: flat.bounds.iter().map(single_precision).collect(),
            lights: flat.lights,
            surfaces: flat.surfaces,
            interiors: flat.interiors,
            suits_four: flat
                .programs
                .iter()
                .map(|program| program.suits_four(&flat.leaves))
                .collect(),
            leaves: flat.leaves,
            programs: flat.programs,
            items: flat.items,
            finder,
        }
    }

    /// The nearest visible surface on a ray.
    #[must_use]
    pub fn nearest(&self, query: &Query, scratch: &mut Scratch) -> Option<Hit> {
        scratch.rays.count(query);
        let best = with_widest(
            #[inline(always)]
            || self.nearest_found(query, scratch),
        );
        best.map(|best| self.hit(query, &best.found))
    }

    #[inline(always)]
    fn nearest_found(&self, query: &Query, scratch: &mut Scratch) -> Option<Best> {
        let mut best: Option<Best> = None;
        let mut far = query.far;
        for &item in &self.finder.unbounded {
            far = self.try_item(item, query, far, &mut best, scratch);
        }
        self.nearest_bounded(query, &mut best, scratch);
        best
    }

    /// Makes `best` the nearest of itself and all bounded items.
    #[inline(always)]
    pub(super) fn nearest_bounded(
        &self,
        query: &Query,
        best: &mut Option<Best>,
        scratch: &mut Scratch,
    ) {
        let far = best.map_or(query.far, |best| best.found.root.t);
        self.finder.tree.nearest(
            &query.ray,
            0.0,
            far,
            #[inline(always)]
            |number, far| {
                let item = self.finder.bounded[number as usize];
                self.try_item(item, query, far, best, scratch)
            },
        );
    }

    /// How the items are found.
    #[inline(always)]
    pub(super) fn finder(&self) -> &Finder {
        &self.finder
    }

    /// How far a ray to a light at `centre` goes so that a surface on which the light itself stands is not met.
    #[must_use]
    pub fn reach(&self, centre: DVec3, distance: f64) -> f64 {
        match self.least_distance {
            LeastDistance::Rounding => distance - BLUR * centre.abs().max_element().max(distance),
            LeastDistance::PovRay => distance - POV_RAY_SHADOW,
        }
    }

    /// How far things cast shadows on a ray to a light that asks up to `query.far`; `None` where no light comes along
    /// the ray, since it misses what the light is projected through.
    #[must_use]
    pub fn shadow_reach(&self, query: &Query, light: u32, scratch: &mut Scratch) -> Option<f64> {
        self.lights.reach(light, &self.leaves, query, scratch)
    }

    /// What lies on a ray to the light of this number.
    #[must_use]
    pub fn way(&self, query: &Query, light: u32, scratch: &mut Scratch) -> Way {
        scratch.rays.shadow += 1;
        with_widest(
            #[inline(always)]
            || self.way_found(query, light, scratch),
        )
    }

    #[inline(always)]
    pub(super) fn way_found(&self, query: &Query, light: u32, scratch: &mut Scratch) -> Way {
        let light = light as usize;
        if scratch.blockers.len() <= light {
            scratch.blockers.resize(light + 1, 0);
        }
        let mut way = Way::Free;
        // Neighbouring points are often in the shadow of the same object.
        let last = scratch.blockers[light];
        if let Some(&item) = self.items.get(last as usize)
            && self.blocks(Numbered { number: last, item }, query, &mut way, scratch)
        {
            return Way::Blocked;
        }
        for &item in &self.finder.unbounded {
            if self.blocks(item, query, &mut way, scratch) {
                scratch.blockers[light] = item.number;
                return Way::Blocked;
            }
        }
        let is_blocked = self.finder.tree.any(
            &query.ray,
            0.0,
            query.far,
            #[inline(always)]
            |number| {
                let item = self.finder.bounded[number as usize];
                let blocks = self.blocks(item, query, &mut way, scratch);
                if blocks {
                    scratch.blockers[light] = item.number;
                }
                blocks
            },
        );
        if is_blocked { Way::Blocked } else { way }
    }

    /// Whether four rays can be asked about an item at once: they see all surfaces alike, and its form is a simple one.
    #[inline(always)]
    pub(super) fn suits_four(&self, item: Item, seen: Seen) -> bool {
        let sees_all = !self.hides_some && (seen != Seen::Shadow || self.is_opaque);
        sees_all
            && match item {
                Item::Program(program) => self.suits_four[program as usize],
                Item::Leaf(leaf) => self.leaves[leaf as usize].shape.has_roots_of_four(),
            }
    }

    /// Whether an item lies opaque on a ray to a light; notes if it lies there and is not opaque.
    #[inline(always)]
    pub(super) fn blocks(
        &self,
        item: Numbered,
        query: &Query,
        way: &mut Way,
        scratch: &mut Scratch,
    ) -> bool {
        let found = self.find(
            item,
            query,
            query.far,
            scratch,
            #[inline(always)]
            |found: &Found| {
                let is_opaque = self.is_opaque || self.opaque[self.surface_number(found)];
                if !is_opaque && found.root.t < query.far {
                    *way = Way::Filtered;
                }
                is_opaque
            },
        );
        found.is_some_and(|found| found.root.t < query.far)
    }

    /// Whether nothing in the scene lets light through.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.is_opaque
    }

    /// The interiors of all objects that hold a point: of the unbounded ones first, then of the others in the order
    /// of the file. Where POV-Ray keeps no tree, all are in the order of the file.
    #[must_use]
    pub fn interiors_at(&self, point: DVec3) -> SmallVec<[InteriorId; 4]> {
        let mut interiors = SmallVec::new();
        let mut numbers: Vec<u32> = Vec::new();
        self.finder.tree.around(point, |number| {
            numbers.push(self.finder.bounded[number as usize].number);
            false
        });
        numbers.extend(self.finder.unbounded.iter().map(|item| item.number));
        let is_bounded = |number: u32| self.ties_by_box && self.boxes[number as usize].is_finite();
        numbers.sort_unstable_by_key(|&number| (is_bounded(number), number));
        for number in numbers {
            let (holds, first) = match self.items[number as usize] {
                Item::Leaf(leaf) => (self.leaves[leaf as usize].contains(point), leaf),
                Item::Program(program) => {
                    let program = &self.programs[program as usize];
                    (program.contains(&self.leaves, point), program.first)
                }
            };
            if holds {
                interiors
                    .push(self.surfaces[self.leaves[first as usize].surface as usize].interior);
            }
        }
        interiors
    }

    /// Whether inside and outside of a primitive are exchanged where it stands: it is inverse, or a difference takes it
    /// away.
    pub(super) fn is_inverse(&self, leaf: u32) -> bool {
        let behind = self
            .programs
            .partition_point(|program| program.first <= leaf);
        let program = behind.checked_sub(1).map(|at| &self.programs[at]);
        program.is_some_and(|program| program.is_inverse(leaf - program.first))
    }

    /// The shape of a primitive.
    pub(super) fn shape(&self, leaf: u32) -> &Shape {
        &self.leaves[leaf as usize].shape
    }

    /// Whether a point lies in any object.
    #[must_use]
    pub fn holds(&self, point: DVec3) -> bool {
        let holds = |number: u32| match self.items[number as usize] {
            Item::Leaf(leaf) => self.leaves[leaf as usize].contains(point),
            Item::Program(program) => self.programs[program as usize].contains(&self.leaves, point),
        };
        let mut unbounded = self.finder.unbounded.iter();
        unbounded.any(|item| holds(item.number))
            || self.finder.tree.around(point, |place| {
                holds(self.finder.bounded[place as usize].number)
            })
    }

    /// The shares of the textures in [`Surface::skins`] at a hit; none if it looks as the object does.
    #[must_use]
    pub fn shares(&self, hit: &Hit) -> Shares {
        let Departure { leaf, face, .. } = hit.departure;
        self.leaves[leaf as usize].shares(hit.point, face)
    }

    /// What the tree holds.
    pub(super) fn items(&self) -> &[Item] {
        &self.items
    }

    /// Whether some surface cannot be seen by some rays.
    pub(super) fn hides_some(&self) -> bool {
        self.hides_some
    }

    /// The primitives of the world.
    #[must_use]
    pub fn leaves(&self) -> &[Leaf] {
        &self.leaves
    }

    #[inline(always)]
    fn surface_number(&self, found: &Found) -> usize {
        self.leaves[found.leaf as usize].surface as usize
    }

    #[inline(always)]
    fn is_seen(&self, found: &Found, seen: Seen) -> bool {
        !self.hides_some || is_seen(&self.surfaces[self.surface_number(found)].flags, seen)
    }

    /// Tries one item; gives the new far limit.
    #[inline(always)]
    pub(super) fn try_item(
        &self,
        item: Numbered,
        query: &Query,
        far: f64,
        best: &mut Option<Best>,
        scratch: &mut Scratch,
    ) -> f64 {
        match self.find(item, query, far, scratch, |_| true) {
            None => far,
            Some(found) => self.offer(item.number, found, query, far, best),
        }
    }

    /// Takes what was found of an item if it is the best so far; gives the new far limit.
    #[inline(always)]
    pub(super) fn offer(
        &self,
        item: u32,
        found: Found,
        query: &Query,
        far: f64,
        best: &mut Option<Best>,
    ) -> f64 {
        if found.root.t >= query.far {
            return far;
        }
        let is_better = match best {
            None => true,
            Some(best) => {
                found.root.t < best.found.root.t
                    || (found.root.t == best.found.root.t
                        && self.comes_first(item, best.item, &query.ray))
            }
        };
        if !is_better {
            return far;
        }
        *best = Some(Best { found, item });
        found.root.t
    }

    /// The distance up to which surfaces are not met: the error of the point that the ray leaves.
    pub(super) fn least_distance(&self, query: &Query) -> f64 {
        match (self.least_distance, query.seen) {
            (LeastDistance::Rounding, _) => query.from.map_or(0.0, |left| left.blur),
            (LeastDistance::PovRay, Seen::Shadow) => POV_RAY_SHADOW,
            (LeastDistance::PovRay, _) => POV_RAY_LEAST,
        }
    }

    /// The first surface of an item up to and including `far` that the asker can see and wants.
    #[inline(always)]
    fn find(
        &self,
        item: Numbered,
        query: &Query,
        far: f64,
        scratch: &mut Scratch,
        mut wanted: impl FnMut(&Found) -> bool,
    ) -> Option<Found> {
        let from = self.least_distance(query);
        let mut wanted = |found: &Found| self.is_seen(found, query.seen) && wanted(found);
        match item.item {
            Item::Program(number) => {
                let program = &self.programs[number as usize];
                let departure = query.from.as_ref();
                let sweep = &mut scratch.sweep;
                program.nearest(
                    &self.leaves,
                    &query.ray,
                    (from, far),
                    departure,
                    sweep,
                    wanted,
                )
            }
            Item::Leaf(number) => {
                let leaf = &self.leaves[number as usize];
                let root = match &query.from {
                    Some(left) if left.leaf == number && leaf.shape.is_faceted() => {
                        leaf.nearest_beside(&query.ray, from, next_after(far), left.face)?
                    }
                    Some(left) if left.leaf == number => {
                        nearest_but(leaf, left, query, from, &mut scratch.roots)?
                    }
                    _ => leaf.nearest(&query.ray, from, next_after(far))?,
                };
                let found = Found { root, leaf: number };
                (root.t <= far && wanted(&found)).then_some(found)
            }
        }
    }

    /// Which of two items at exactly the same distance is drawn: unbounded ones come first, then the one whose box
    /// the ray enters first, then the one that stands first in the file (facts 11.2).
    #[cold]
    fn comes_first(&self, a: u32, b: u32, ray: &Ray) -> bool {
        if self.ties_by_box {
            let entry = |item: u32| {
                let bounds = &self.boxes[item as usize];
                if bounds.is_finite() {
                    slab_entry(bounds, ray)
                } else {
                    f64::NEG_INFINITY
                }
            };
            let (entry_a, entry_b) = (entry(a), entry(b));
            if entry_a != entry_b {
                return entry_a < entry_b;
            }
        }
        a < b
    }

    pub(super) fn hit(&self, query: &Query, found: &Found) -> Hit {
        let leaf = &self.leaves[found.leaf as usize];
        let Root {
            t, face, crossing, ..
        } = found.root;
        let point = query.ray.at(t);
        let (normal, shading_normal) = leaf.normals(point, face);
        let blur = BLUR * point.abs().max_element().max(t);
        let departure = Departure {
            leaf: found.leaf,
            face,
            normal,
            crossing,
            blur,
        };
        Hit {
            t,
            point,
            normal,
            shading_normal,
            surface: leaf.surface,
            departure,
        }
    }
}

fn is_seen(flags: &Flags, seen: Seen) -> bool {
    match seen {
        Seen::Image => !flags.no_image,
        Seen::Reflection => !flags.no_reflection,
        Seen::Shadow => !flags.no_shadow,
    }
}

/// The first visible root beyond `from`, on the leaf that the ray has just left.
#[inline(never)]
fn nearest_but(
    leaf: &Leaf,
    left: &Departure,
    query: &Query,
    from: f64,
    roots: &mut Vec<Root>,
) -> Option<Root> {
    // From a convex solid outward: the one place where the line leaves it is the one just left.
    if left.normal.dot(query.ray.dir) > 0.0 && leaf.is_left_behind(&query.ray) {
        return None;
    }
    roots.clear();
    leaf.roots(&query.ray, roots);
    hide_departure(roots, left, leaf, query.ray.dir);
    roots
        .iter()
        .find(|root| root.is_visible && root.t > from)
        .copied()
}

/// The next larger number, so that a limit that is left out takes `far` in.
fn next_after(far: f64) -> f64 {
    far.next_up()
}

/// Where the line of a ray enters a box, not clamped at its start.
fn slab_entry(bounds: &Bounds, ray: &Ray) -> f64 {
    (0..3).fold(f64::NEG_INFINITY, |entry, axis| {
        let d = ray.dir[axis];
        if d == 0.0 {
            return entry;
        }
        let near = if d > 0.0 {
            bounds.min[axis]
        } else {
            bounds.max[axis]
        };
        entry.max((near - ray.origin[axis]) / d)
    })
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "POV-Ray keeps boxes in single precision"
)]
fn single_precision(bounds: &Bounds) -> Bounds {
    let round = |v: DVec3| {
        DVec3::new(
            f64::from(v.x as f32),
            f64::from(v.y as f32),
            f64::from(v.z as f32),
        )
    };
    Bounds {
        min: round(bounds.min),
        max: round(bounds.max),
    }
}

//! Surface attributes of an object: textures, interior, lights, and visibility by kind of ray.

pub(super) mod cutaway;
pub(super) mod flags;

use super::interiors::InteriorId;
use super::lights::LightList;
use super::surface::cutaway::Cutaway;
use super::surface::flags::{ObjectFlags, SurfaceFlags};
use crate::base::color::{Color, Rgb};
use crate::base::math::{Step, Transform};
use crate::scene::Importance;
use crate::scene::light::PhotonRole;
use crate::scene::shape::{Geometry, Shape};
use crate::scene::texture::{PreparedLayer, PreparedPigment, PreparedTexture};
use crate::world::ray::RayKind;
use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use std::ops::Deref;
use std::sync::Arc;

/// Smallest number of surfaces worth a parallel task.
const SURFACES_PER_TASK: usize = 4096;

/// A shape before its transforms, for texture coordinates, where the shape itself has absorbed the transforms.
#[derive(Clone, Debug)]
pub(super) struct ObjectSpaceShape {
    shape: Shape,
    object_from_world: DAffine3,
}

impl ObjectSpaceShape {
    /// The shape to which these steps will be applied.
    pub(super) fn new(shape: &Shape, steps: &[Step]) -> Self {
        ObjectSpaceShape {
            shape: shape.clone(),
            object_from_world: Transform::from_steps(steps).object_from_world,
        }
    }

    /// The texture coordinates at a world point of a face.
    pub(super) fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        let local = self.object_from_world.transform_point3(point);
        self.shape.uv(local, face)
    }
}

/// The texture of a surface: stored inline, unless it is shared. There may be a million unshared ones, and many small
/// allocations between freed memory would fragment the heap.
#[derive(Debug)]
pub enum OwnedOrShared {
    /// Owned by one surface.
    Own(PreparedTexture),
    /// Shared by any number of surfaces.
    Shared(Arc<PreparedTexture>),
}

impl Deref for OwnedOrShared {
    type Target = PreparedTexture;

    #[inline(always)]
    fn deref(&self) -> &PreparedTexture {
        match self {
            OwnedOrShared::Own(texture) => texture,
            OwnedOrShared::Shared(texture) => texture,
        }
    }
}

impl OwnedOrShared {
    /// Converts the texture to a shared one.
    pub(super) fn shared(self) -> Arc<PreparedTexture> {
        match self {
            OwnedOrShared::Own(texture) => Arc::new(texture),
            OwnedOrShared::Shared(texture) => texture,
        }
    }

    /// Returns true if both are the same allocation; equal ones do not count.
    fn is_same(&self, other: &OwnedOrShared) -> bool {
        match (self, other) {
            (OwnedOrShared::Shared(a), OwnedOrShared::Shared(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

/// Surface attributes of an object and its interior. A surface of one colour fits a cache line.
#[derive(Debug)]
#[repr(align(64))]
pub struct Surface {
    /// The layers, with all transforms of the object taken in.
    pub texture: OwnedOrShared,
    /// The interior of the object.
    pub interior: InteriorId,
    /// The lights that shine on it.
    pub lights: LightList,
    /// The switches of the object, and properties of its textures.
    traits: SurfaceFlags,
    /// Attributes that only few surfaces have; of the others there may be a million.
    rare: Option<Box<RareSurface>>,
}

/// Attributes that only few surfaces have.
#[derive(Debug, Default)]
struct RareSurface {
    inside_texture: Option<Arc<PreparedTexture>>,
    skins: Box<[Arc<PreparedTexture>]>,
    unmoved: Option<ObjectSpaceShape>,
    cutaway: Option<Arc<Cutaway>>,
    /// Share of the radiosity sample rays to it that count, if set.
    importance: Option<Importance>,
    /// Its photon settings, if photons are on.
    photons: PhotonRole,
}

/// Properties of all surfaces of a world, collected in one pass: there may be millions of surfaces.
#[derive(Debug)]
pub(super) struct SurfaceSummary {
    /// For each surface, true if it ends shadow rays; empty if all are opaque.
    pub(super) ends_light: Vec<bool>,
    /// For each surface, its transmittance if that is uniform; empty if all are opaque.
    pub(super) filters: Vec<Option<Rgb>>,
    /// True if all surfaces are opaque.
    pub(super) is_opaque: bool,
    /// True if some surfaces are opaque but for their `interior_texture`.
    pub(super) has_clear_insides: bool,
    /// True if some surfaces are hidden from some kinds of ray.
    pub(super) hides_some: bool,
    /// True if some surfaces have a Fresnel reflection.
    pub(super) has_fresnel: bool,
    /// True if light from behind may matter to some surfaces.
    pub(super) needs_backface_light: bool,
    /// True if some surfaces do not respond to light sources.
    pub(super) has_unlit: bool,
    /// True if some finish has `crand`.
    pub(super) is_grainy: bool,
    /// True if some finish has `subsurface`.
    pub(super) has_subsurface: bool,
}

impl SurfaceSummary {
    pub(super) fn of(surfaces: &[Surface]) -> SurfaceSummary {
        let surfaces = surfaces.par_iter().with_min_len(SURFACES_PER_TASK);
        let is_some = surfaces.clone().map(|surface| {
            [
                !surface.is_opaque(),
                surface.has_clear_inside(),
                surface.traits.hides_from_some(),
                surface.has_fresnel(),
                surface.is_lit_from_behind() || surface.is_bumpy(),
                !surface.takes_light(),
                surface.traits.has(SurfaceFlags::GRAINY),
                surface.has_subsurface(),
            ]
        });
        let either = |mut all: [bool; 8], one: [bool; 8]| {
            all.iter_mut().zip(one).for_each(|(all, one)| *all |= one);
            all
        };
        let [
            shows_through,
            has_clear_insides,
            hides_some,
            has_fresnel,
            needs_backface_light,
            has_unlit,
            is_grainy,
            has_subsurface,
        ] = is_some.reduce(|| [false; 8], either);
        let (mut ends_light, mut filters) = (Vec::new(), Vec::new());
        if shows_through {
            surfaces
                .clone()
                .map(Surface::ends_light)
                .collect_into_vec(&mut ends_light);
            surfaces
                .map(Surface::even_filter)
                .collect_into_vec(&mut filters);
        }
        SurfaceSummary {
            ends_light,
            filters,
            is_opaque: !shows_through,
            has_clear_insides,
            hides_some,
            has_fresnel,
            needs_backface_light,
            has_unlit,
            is_grainy,
            has_subsurface,
        }
    }
}

impl SurfaceSummary {
    /// Notes another surface with an index, or the next one, of which some surface has all the properties.
    pub(super) fn put(&mut self, index: usize, surface: &Surface) {
        if self.is_opaque {
            return;
        }
        let (ends_light, filter) = (surface.ends_light(), surface.even_filter());
        match self
            .ends_light
            .get_mut(index)
            .zip(self.filters.get_mut(index))
        {
            Some((known, known_filter)) => (*known, *known_filter) = (ends_light, filter),
            None => {
                self.ends_light.push(ends_light);
                self.filters.push(filter);
            }
        }
    }
}

impl RareSurface {
    /// Returns true if the two are interchangeable.
    fn is_same(&self, other: &RareSurface) -> bool {
        let same_inside = match (&self.inside_texture, &other.inside_texture) {
            (None, None) => true,
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            _ => false,
        };
        let has_more = |rare: &RareSurface| {
            !rare.skins.is_empty() || rare.unmoved.is_some() || rare.cutaway.is_some()
        };
        same_inside
            && self.importance == other.importance
            && self.photons == other.photons
            && !has_more(self)
            && !has_more(other)
    }
}

impl Surface {
    /// A surface with these attributes.
    pub(super) fn new(
        texture: OwnedOrShared,
        inside_texture: Option<Arc<PreparedTexture>>,
        skins: Box<[Arc<PreparedTexture>]>,
        interior: InteriorId,
        lights: LightList,
        flags: ObjectFlags,
    ) -> Self {
        let textures = || {
            let others = inside_texture.iter().chain(&skins);
            std::iter::once(&*texture).chain(others.map(|texture| &**texture))
        };
        let has = |is_such: &dyn Fn(&PreparedLayer) -> bool| {
            textures().any(|texture| texture.has_layer(is_such))
        };
        let uses_uv = flags.uv_mapping || textures().any(|texture| texture.uses_uv());
        let is_one = textures().count() == 1;
        let known = [
            (SurfaceFlags::USES_UV, uses_uv),
            (
                SurfaceFlags::OPAQUE,
                textures().all(|texture| texture.is_opaque()),
            ),
            (
                SurfaceFlags::ENDS_LIGHT,
                textures().all(|texture| texture.ends_light()),
            ),
            (
                SurfaceFlags::OUTSIDE_ENDS_LIGHT,
                texture.ends_light() && skins.iter().all(|texture| texture.ends_light()),
            ),
            (
                SurfaceFlags::TAKES_LIGHT,
                has(&|layer| layer.finish.takes_light()),
            ),
            (
                SurfaceFlags::LIT_FROM_BEHIND,
                has(&|layer| layer.finish.diffuse_back != 0.0),
            ),
            (
                SurfaceFlags::FRESNEL,
                has(&|layer| layer.finish.reflection.is_fresnel || layer.finish.fresnel != 0.0),
            ),
            (
                SurfaceFlags::PLAIN,
                is_one && texture.is_plain() && !uses_uv,
            ),
            (
                SurfaceFlags::NEARLY_PLAIN,
                is_one && texture.is_nearly_plain() && !uses_uv,
            ),
            (
                SurfaceFlags::PLAIN_FINISHES,
                !has(&|layer| !layer.has_plain_finish()),
            ),
            (SurfaceFlags::BUMPY, has(&|layer| layer.normal().is_some())),
            (SurfaceFlags::GRAINY, has(&|layer| layer.finish.crand > 0.0)),
            (
                SurfaceFlags::SUBSURFACE,
                has(&|layer| layer.finish.subsurface.is_some()),
            ),
            (
                SurfaceFlags::FILTERS_EVENLY,
                is_one && texture.has_uniform_color(),
            ),
        ];
        let traits = SurfaceFlags::new(&known, &flags);
        let ObjectFlags {
            importance,
            photons,
            ..
        } = flags;
        let is_rare = inside_texture.is_some()
            || !skins.is_empty()
            || importance.is_some()
            || photons != PhotonRole::default();
        let rare = is_rare.then(|| {
            Box::new(RareSurface {
                inside_texture,
                skins,
                unmoved: None,
                cutaway: None,
                importance,
                photons,
            })
        });
        Surface {
            texture,
            interior,
            lights,
            traits,
            rare,
        }
    }

    /// A copy in another colour; for surfaces of one colour, and for colours that are opaque or transmissive like this
    /// one.
    pub(super) fn in_color(&self, color: Color, interior: InteriorId) -> Option<Self> {
        Some(Surface {
            texture: OwnedOrShared::Own(self.texture.with_color(color)?),
            interior,
            lights: self.lights,
            traits: self.traits,
            rare: None,
        })
    }

    /// Takes the place of another surface of the same shape, whose interior and lights it gets. Returns true if the world
    /// is compiled alike for both, and rays find the same objects: only colours, bumps and the like differ.
    pub(super) fn replaces(&mut self, other: &Surface) -> bool {
        self.interior = other.interior;
        self.lights = other.lights;
        self.traits == other.traits
            && self.rare.is_none()
            && other.rare.is_none()
            && self.has_jumps() == other.has_jumps()
            && self.sends_rays() == other.sends_rays()
    }

    /// Moves the texture inline if nothing else shares it.
    pub(super) fn take_texture(&mut self) {
        if let OwnedOrShared::Shared(texture) = &mut self.texture
            && let Some(texture) = Arc::get_mut(texture)
        {
            self.texture = OwnedOrShared::Own(std::mem::take(texture));
        }
    }

    /// The texture seen from inside, if the scene gives one.
    #[must_use]
    pub fn inside_texture(&self) -> Option<&Arc<PreparedTexture>> {
        self.rare.as_ref()?.inside_texture.as_ref()
    }

    /// Textures of single faces or components of the shape, transformed like the layers, or those taken from the cut
    /// objects by `cutaway_textures`.
    #[must_use]
    pub fn face_textures(&self) -> &[Arc<PreparedTexture>] {
        self.rare.as_ref().map_or(&[], |rare| &rare.skins)
    }

    /// All its textures.
    pub(super) fn textures(&self) -> impl Iterator<Item = &PreparedTexture> {
        let others = self
            .inside_texture()
            .into_iter()
            .chain(self.face_textures());
        std::iter::once(&*self.texture).chain(others.map(|texture| &**texture))
    }

    /// The untransformed shape that gives the texture coordinates, if the leaf does not.
    pub(super) fn unmoved(&self) -> Option<&ObjectSpaceShape> {
        self.rare.as_ref()?.unmoved.as_ref()
    }

    /// Takes its texture coordinates from an untransformed shape.
    pub(super) fn set_unmoved(&mut self, unmoved: ObjectSpaceShape) {
        self.rare.get_or_insert_default().unmoved = Some(unmoved);
    }

    /// The source of its textures by `cutaway_textures`, if it has none of its own.
    pub(super) fn cutaway(&self) -> Option<&Cutaway> {
        self.rare.as_ref()?.cutaway.as_deref()
    }

    /// Takes its textures from the objects it cuts.
    pub(super) fn set_cutaway(&mut self, cutaway: Arc<Cutaway>) {
        self.rare.get_or_insert_default().cutaway = Some(cutaway);
    }

    /// Returns true if this kind of ray sees it.
    #[inline]
    pub(super) fn is_seen(&self, kind: RayKind) -> bool {
        self.traits.is_seen(kind)
    }

    /// Makes it visible to the camera.
    pub(super) fn show(&mut self) {
        self.traits.show();
    }

    /// True if a pattern on it jumps where surfaces may lie.
    pub(super) fn has_jumps(&self) -> bool {
        self.textures().any(PreparedTexture::jumps)
    }

    /// True if rays go on from it: a texture of it reflects, or lets light through.
    #[must_use]
    pub fn sends_rays(&self) -> bool {
        self.textures()
            .any(|texture| texture.has_reflection() || !texture.is_opaque())
    }

    /// Share of the radiosity sample rays to it that count, if set.
    #[must_use]
    pub fn importance(&self) -> Option<Importance> {
        self.rare.as_ref()?.importance
    }

    /// Its photon settings, if photons are on.
    #[must_use]
    pub fn photons(&self) -> PhotonRole {
        self.rare
            .as_ref()
            .map(|rare| rare.photons)
            .unwrap_or_default()
    }

    /// Returns true if all its patterns are evaluated at texture coordinates.
    #[must_use]
    pub fn is_mapped(&self) -> bool {
        self.traits.has(SurfaceFlags::UV_MAPPING)
    }

    /// Returns true if it is lit from both sides.
    #[must_use]
    pub fn is_double_illuminated(&self) -> bool {
        self.traits.has(SurfaceFlags::DOUBLE_ILLUMINATE)
    }

    /// Returns true if some attribute needs texture coordinates.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        self.traits.has(SurfaceFlags::USES_UV)
    }

    /// Returns true if it responds to light sources.
    #[must_use]
    #[inline]
    pub fn takes_light(&self) -> bool {
        self.traits.has(SurfaceFlags::TAKES_LIGHT)
    }

    /// Returns true if it responds to light from behind.
    #[must_use]
    pub fn is_lit_from_behind(&self) -> bool {
        self.traits
            .has(SurfaceFlags::DOUBLE_ILLUMINATE | SurfaceFlags::LIT_FROM_BEHIND)
    }

    /// Returns true for a single opaque layer without bumps, reflection, thin film or grain.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.traits.has(SurfaceFlags::PLAIN)
    }

    /// Same as [`Surface::is_plain`], except that it may reflect and be transparent.
    #[must_use]
    pub fn is_nearly_plain(&self) -> bool {
        self.traits.has(SurfaceFlags::NEARLY_PLAIN)
    }

    /// Returns true if all layers of its textures have only diffuse light, highlights and reflection.
    #[must_use]
    pub fn has_plain_finishes(&self) -> bool {
        self.traits.has(SurfaceFlags::PLAIN_FINISHES)
    }

    /// Returns true if some layer scatters light below the surface, where the scene enables it.
    #[must_use]
    pub fn has_subsurface(&self) -> bool {
        self.traits.has(SurfaceFlags::SUBSURFACE)
    }

    /// Returns true if some layer has bumps.
    #[must_use]
    pub fn is_bumpy(&self) -> bool {
        self.traits.has(SurfaceFlags::BUMPY)
    }

    /// Transmittance of its textures, if uniform.
    fn even_filter(&self) -> Option<Rgb> {
        let layers = self.texture.layers().iter();
        let share = layers.fold(Rgb::WHITE, |light, layer| match &layer.pigment {
            PreparedPigment::Plain(color) => light * color.transmission(),
            _ => light,
        });
        self.traits
            .has(SurfaceFlags::FILTERS_EVENLY)
            .then_some(share)
    }

    /// Returns true if it has a Fresnel reflection.
    #[must_use]
    pub fn has_fresnel(&self) -> bool {
        self.traits.has(SurfaceFlags::FRESNEL)
    }

    /// Returns true if its interior shows nowhere: no ray enters it, and no Fresnel reflection depends on it.
    pub(super) fn hides_interior(&self) -> bool {
        self.is_opaque() && !self.has_fresnel()
    }

    /// Returns true if the two are interchangeable, where interiors that the scene does not write may be hidden.
    pub(super) fn is_same(&self, other: &Surface) -> bool {
        let has_no_inside = |one: &Surface| one.hides_interior() && one.interior.is_unnamed();
        let same_beside = match (&self.rare, &other.rare) {
            (None, None) => true,
            (Some(a), Some(b)) => a.is_same(b),
            _ => false,
        };
        same_beside
            && self.texture.is_same(&other.texture)
            && (self.interior == other.interior || has_no_inside(self) && has_no_inside(other))
            && self.lights == other.lights
            && self.traits == other.traits
    }

    /// Returns true if only its `interior_texture` lets light through.
    pub(super) fn has_clear_inside(&self) -> bool {
        self.traits.has(SurfaceFlags::OUTSIDE_ENDS_LIGHT) && !self.ends_light()
    }

    /// Returns true if it ends shadow rays wherever they hit it.
    pub(super) fn ends_light(&self) -> bool {
        self.traits.has(SurfaceFlags::ENDS_LIGHT)
    }

    /// Returns true if it is opaque.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.traits.has(SurfaceFlags::OPAQUE)
    }
}

//! How the surface of an object looks, and who sees it.

use super::interiors::InteriorId;
use super::lights::LightList;
use super::lower::cutaway::Cutaway;
use super::query::RayKind;
use super::surface_flags::{ObjectFlags, SurfaceFlags};
use crate::base::color::{Color, Rgb};
use crate::base::math::{Step, Transform};
use crate::scene::Importance;
use crate::scene::light::PhotonRole;
use crate::scene::shape::{Geometry, Shape};
use crate::scene::texture::{PreparedLayer, PreparedPigment, PreparedTexture};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use std::ops::Deref;
use std::sync::Arc;

/// So few surfaces are not worth asking other threads.
const FEW: usize = 4096;

/// A shape before its transforms, where they have gone into its own numbers and texture coordinates are asked for.
#[derive(Clone, Debug)]
pub(super) struct ObjectSpaceShape {
    shape: Shape,
    object_from_world: DAffine3,
}

impl ObjectSpaceShape {
    /// The shape that these steps will move.
    pub(super) fn new(shape: &Shape, steps: &[Step]) -> Self {
        ObjectSpaceShape {
            shape: shape.clone(),
            object_from_world: Transform::from_steps(steps).object_from_world,
        }
    }

    /// The texture coordinates at a world point of a piece of the surface.
    pub(super) fn uv(&self, point: DVec3, face: u32) -> Option<[f64; 2]> {
        let local = self.object_from_world.transform_point3(point);
        self.shape.uv(local, face)
    }
}

/// A texture as a surface keeps it: in itself, unless others have it too. There may be a million that nothing shares,
/// and small pieces of memory among others that are let go hold on to all of it.
#[derive(Debug)]
pub enum OwnedOrShared {
    /// Of one surface alone.
    Own(PreparedTexture),
    /// Of any number of them.
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
    /// The texture, to be shared.
    pub(super) fn shared(self) -> Arc<PreparedTexture> {
        match self {
            OwnedOrShared::Own(texture) => Arc::new(texture),
            OwnedOrShared::Shared(texture) => texture,
        }
    }

    /// Whether both are the same, not only alike.
    fn is_same(&self, other: &OwnedOrShared) -> bool {
        match (self, other) {
            (OwnedOrShared::Shared(a), OwnedOrShared::Shared(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

/// How the surface of an object looks and what lies behind it. One of one colour is a line of memory.
#[derive(Debug)]
#[repr(align(64))]
pub struct Surface {
    /// The layers, with all transforms of the object taken in.
    pub texture: OwnedOrShared,
    /// The interior of the object.
    pub interior: InteriorId,
    /// The lights that shine on it.
    pub lights: LightList,
    /// Its switches, and what follows from its textures.
    traits: SurfaceFlags,
    /// What few surfaces have; of others there may be a million.
    rare: Option<Box<RareSurface>>,
}

/// What few surfaces have.
#[derive(Debug, Default)]
struct RareSurface {
    inside_texture: Option<Arc<PreparedTexture>>,
    skins: Box<[Arc<PreparedTexture>]>,
    unmoved: Option<ObjectSpaceShape>,
    cutaway: Option<Arc<Cutaway>>,
    /// How many of the rays that gather light and meet it count, if it says so.
    importance: Option<Importance>,
    /// What it does with photons, where these are shot.
    photons: PhotonRole,
}

/// What holds of the surfaces of a world, found by looking at each once: there may be millions.
#[derive(Debug)]
pub(super) struct SurfaceSummary {
    /// For each, whether nothing can be seen through it; empty if all are so.
    pub(super) opaque: Vec<bool>,
    /// For each, the share of light that passes its textures everywhere, if there is such; empty if all are opaque.
    pub(super) filters: Vec<Option<Rgb>>,
    /// Whether all are so.
    pub(super) is_opaque: bool,
    /// Whether some cannot be seen by some rays.
    pub(super) hides_some: bool,
    /// Whether the view through some matters to their mirror images.
    pub(super) has_fresnel: bool,
    /// Whether light that arrives from behind may matter to some.
    pub(super) minds_backs: bool,
    /// Whether some take no light.
    pub(super) has_unlit: bool,
    /// Whether some finish has `crand`.
    pub(super) is_grainy: bool,
}

impl SurfaceSummary {
    pub(super) fn of(surfaces: &[Surface]) -> SurfaceSummary {
        let surfaces = surfaces.par_iter().with_min_len(FEW);
        let is_some = surfaces.clone().map(|surface| {
            [
                !surface.is_opaque(),
                surface.traits.hides_from_some(),
                surface.has_fresnel(),
                surface.is_lit_from_behind() || surface.is_bumpy(),
                !surface.takes_light(),
                surface.traits.has(SurfaceFlags::GRAINY),
            ]
        });
        let either = |mut all: [bool; 6], one: [bool; 6]| {
            all.iter_mut().zip(one).for_each(|(all, one)| *all |= one);
            all
        };
        let [
            shows_through,
            hides_some,
            has_fresnel,
            minds_backs,
            has_unlit,
            is_grainy,
        ] = is_some.reduce(|| [false; 6], either);
        let (mut opaque, mut filters) = (Vec::new(), Vec::new());
        if shows_through {
            surfaces
                .clone()
                .map(Surface::is_opaque)
                .collect_into_vec(&mut opaque);
            surfaces
                .map(Surface::even_filter)
                .collect_into_vec(&mut filters);
        }
        SurfaceSummary {
            opaque,
            filters,
            is_opaque: !shows_through,
            hides_some,
            has_fresnel,
            minds_backs,
            has_unlit,
            is_grainy,
        }
    }
}

impl RareSurface {
    /// Whether the two need not be told apart.
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
    /// A surface that looks so.
    pub(super) fn new(
        texture: OwnedOrShared,
        inside_texture: Option<Arc<PreparedTexture>>,
        skins: Box<[Arc<PreparedTexture>]>,
        interior: InteriorId,
        (lights, flags): (LightList, ObjectFlags),
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
                SurfaceFlags::TAKES_LIGHT,
                has(&|layer| layer.finish.takes_light()),
            ),
            (
                SurfaceFlags::LIT_FROM_BEHIND,
                has(&|layer| layer.finish.diffuse_back != 0.0),
            ),
            (
                SurfaceFlags::FRESNEL,
                has(&|layer| layer.finish.reflection.is_fresnel),
            ),
            (
                SurfaceFlags::PLAIN,
                is_one && texture.is_plain() && !uses_uv,
            ),
            (
                SurfaceFlags::NEARLY_PLAIN,
                is_one && texture.is_nearly_plain() && !uses_uv,
            ),
            (SurfaceFlags::BUMPY, has(&|layer| layer.normal().is_some())),
            (SurfaceFlags::GRAINY, has(&|layer| layer.finish.crand > 0.0)),
            (SurfaceFlags::FILTERS_EVENLY, is_one && texture.is_even()),
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

    /// The surface of one colour that looks as this one does but for the colour, which lets light through if that of
    /// this one does.
    pub(super) fn in_color(&self, color: Color, interior: InteriorId) -> Option<Self> {
        Some(Surface {
            texture: OwnedOrShared::Own(self.texture.in_color(color)?),
            interior,
            lights: self.lights,
            traits: self.traits,
            rare: None,
        })
    }

    /// Keeps its texture in itself if nothing else has it.
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

    /// The textures that pieces of the shape have of their own, moved like the layers, or those that it takes from what it
    /// cuts.
    #[must_use]
    pub fn skins(&self) -> &[Arc<PreparedTexture>] {
        self.rare.as_ref().map_or(&[], |rare| &rare.skins)
    }

    /// All its textures.
    pub(super) fn textures(&self) -> impl Iterator<Item = &PreparedTexture> {
        let others = self.inside_texture().into_iter().chain(self.skins());
        std::iter::once(&*self.texture).chain(others.map(|texture| &**texture))
    }

    /// What gives its texture coordinates, if that is not the leaf as it is.
    pub(super) fn unmoved(&self) -> Option<&ObjectSpaceShape> {
        self.rare.as_ref()?.unmoved.as_ref()
    }

    /// Takes its texture coordinates from a shape that is not moved.
    pub(super) fn set_unmoved(&mut self, unmoved: ObjectSpaceShape) {
        self.rare.get_or_insert_default().unmoved = Some(unmoved);
    }

    /// What lends it textures, if it has none of its own.
    pub(super) fn cutaway(&self) -> Option<&Cutaway> {
        self.rare.as_ref()?.cutaway.as_deref()
    }

    /// Takes its textures from what it cuts.
    pub(super) fn set_cutaway(&mut self, cutaway: Arc<Cutaway>) {
        self.rare.get_or_insert_default().cutaway = Some(cutaway);
    }

    /// Whether who looks sees it.
    #[inline]
    pub(super) fn is_seen(&self, seen: RayKind) -> bool {
        self.traits.is_seen(seen)
    }

    /// Lets the camera see it.
    pub(super) fn show(&mut self) {
        self.traits.show();
    }

    /// How many of the rays that gather light and meet it count, if it says so.
    #[must_use]
    pub fn importance(&self) -> Option<Importance> {
        self.rare.as_ref()?.importance
    }

    /// What it does with photons, where these are shot.
    #[must_use]
    pub fn photons(&self) -> PhotonRole {
        self.rare
            .as_ref()
            .map(|rare| rare.photons)
            .unwrap_or_default()
    }

    /// Whether all its patterns are asked at texture coordinates.
    #[must_use]
    pub fn is_mapped(&self) -> bool {
        self.traits.has(SurfaceFlags::UV_MAPPING)
    }

    /// Whether it is lit from both sides.
    #[must_use]
    pub fn is_double_illuminated(&self) -> bool {
        self.traits.has(SurfaceFlags::DOUBLE_ILLUMINATE)
    }

    /// Whether something in its looks asks for texture coordinates.
    #[must_use]
    pub fn uses_uv(&self) -> bool {
        self.traits.has(SurfaceFlags::USES_UV)
    }

    /// Whether light of lamps can be seen on it.
    #[must_use]
    #[inline]
    pub fn takes_light(&self) -> bool {
        self.traits.has(SurfaceFlags::TAKES_LIGHT)
    }

    /// Whether light that comes from behind can be seen on it.
    #[must_use]
    pub fn is_lit_from_behind(&self) -> bool {
        self.traits
            .has(SurfaceFlags::DOUBLE_ILLUMINATE | SurfaceFlags::LIT_FROM_BEHIND)
    }

    /// Whether it is one opaque layer all over, with nothing to it but light and highlights.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.traits.has(SurfaceFlags::PLAIN)
    }

    /// Whether it is that but for a mirror image and what shines through.
    #[must_use]
    pub fn is_nearly_plain(&self) -> bool {
        self.traits.has(SurfaceFlags::NEARLY_PLAIN)
    }

    /// Whether bumps tilt its normal somewhere.
    #[must_use]
    pub fn is_bumpy(&self) -> bool {
        self.traits.has(SurfaceFlags::BUMPY)
    }

    /// The share of light that passes its textures, if that is the same everywhere.
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

    /// Whether the view through it matters to its mirror images.
    #[must_use]
    pub fn has_fresnel(&self) -> bool {
        self.traits.has(SurfaceFlags::FRESNEL)
    }

    /// Whether the two need not be told apart. Into what is opaque no ray goes, so that all interiors are alike there
    /// that no scene has written.
    pub(super) fn is_same(&self, other: &Surface) -> bool {
        let has_no_inside = |one: &Surface| one.is_opaque() && one.interior.is_unnamed();
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

    /// Whether nothing can be seen through it.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.traits.has(SurfaceFlags::OPAQUE)
    }
}

//! Features that the shading of a scene needs; the rest is left out of its loops.

use super::direct;
use crate::world::World;

/// Features switched off by a quality below 9 (`+Q`); measured with POV-Ray 3.7.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Quality {
    /// From 2 on: lighting. Below, the pigment of the lowest layer is the colour.
    pub(super) has_light: bool,
    /// From 4 on: shadows.
    pub(super) has_shadows: bool,
    /// From 5 on: area lights.
    pub(super) has_area_lights: bool,
    /// From 6 on: the real pigments rather than `quick_color`, and transparency.
    pub(super) has_transparency: bool,
    /// From 8 on: reflection.
    pub(super) has_reflection: bool,
    /// From 8 on: bump mapping.
    pub(super) has_normals: bool,
}

impl Quality {
    /// Every feature.
    pub(super) const FULL: Quality = Quality {
        has_light: true,
        has_shadows: true,
        has_area_lights: true,
        has_transparency: true,
        has_reflection: true,
        has_normals: true,
    };

    /// The features of a quality (`+Q`).
    pub(super) fn new(quality: u8) -> Quality {
        Quality {
            has_light: quality >= 2,
            has_shadows: quality >= 4,
            has_area_lights: quality >= 5,
            has_transparency: quality >= 6,
            has_reflection: quality >= 8,
            has_normals: quality >= 8,
        }
    }
}

/// Features of a scene that cost time with each ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Features {
    /// Some ray needs its interior stack.
    pub(super) needs_interiors: bool,
    /// Some ray crosses media.
    pub(super) has_media: bool,
    /// Some interior attenuates light with distance.
    pub(super) light_fades: bool,
    /// Some material is lit from behind.
    pub(super) needs_backface_light: bool,
    /// The lights that matter differ between surfaces in more than the side that faces them.
    pub(super) light_varies_by_surface: bool,
}

impl Features {
    /// The features of `world` at a quality (`+Q`).
    pub(super) fn new(world: &World, quality: u8) -> Features {
        let has_media = quality >= 9 && (!world.media.is_empty() || world.interiors.have_media());
        let needs_backface_light = world.needs_backface_light();
        Features {
            needs_interiors: !world.is_opaque()
                || world.has_fresnel()
                || has_media
                || !world.has_clear_air(),
            has_media,
            light_fades: world.interiors.fade_light(),
            needs_backface_light,
            light_varies_by_surface: needs_backface_light || world.has_unlit(),
        }
    }
}

/// The ways to trace many rays at once that a scene permits.
#[derive(Clone, Copy, Debug)]
pub(super) struct FastPaths {
    /// Secondary rays from plain surfaces may be traced as a wavefront. Not if light is dispersed, nor if random
    /// numbers are drawn in the order of the rays.
    pub(super) wavefront: bool,
    /// The same for all surfaces. Not with radiosity either: its samples depend on the order of the rays.
    pub(super) queues_all_surfaces: bool,
    /// Plain surfaces may be shaded in packets ([`direct`]).
    pub(super) packets: bool,
}

impl FastPaths {
    /// The fast paths of `world`.
    pub(super) fn new(world: &World, quality: Quality, features: Features) -> FastPaths {
        let wavefront = !world.interiors.split_light() && !world.uses_random();
        let has_radiosity = world.radiosity.is_some();
        FastPaths {
            wavefront,
            queues_all_surfaces: wavefront && !has_radiosity,
            packets: !features.has_media
                && !has_radiosity
                && direct::opaque::supports(world, quality),
        }
    }
}

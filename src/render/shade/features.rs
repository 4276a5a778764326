//! Features that the shading of a scene needs; the rest is left out of its loops.

use super::direct;
use super::quality::Quality;
use crate::world::World;

/// Features of a scene that cost time with each ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Features {
    /// Some ray needs its interior stack.
    pub(super) needs_interiors: bool,
    /// Some ray crosses media.
    pub(super) has_media: bool,
    /// Random numbers decide about the picture, so that all samples are taken in POV-Ray's order.
    pub(super) uses_random: bool,
    /// Some light is an area light.
    pub(super) has_area_lights: bool,
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
        let has_media =
            quality >= 9 && (!world.media.is_empty() || world.interiors.any_has_media());
        let needs_backface_light = world.needs_backface_light();
        Features {
            needs_interiors: !world.is_opaque()
                || world.has_fresnel()
                || has_media
                || !world.has_clear_atmosphere()
                || world.subsurface.is_some(),
            has_media,
            uses_random: world.uses_random(),
            has_area_lights: world.lights.iter().any(|light| light.area.is_some()),
            light_fades: world.interiors.any_attenuates(),
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
    /// Shadow rays from a wavefront are traced in packets.
    pub(super) shadow_packets: bool,
}

impl FastPaths {
    /// The fast paths of `world`.
    pub(super) fn new(world: &World, quality: Quality, features: Features) -> FastPaths {
        let wavefront = !world.interiors.any_disperses() && !features.uses_random;
        let has_radiosity = world.radiosity.is_some();
        FastPaths {
            wavefront,
            queues_all_surfaces: wavefront && !has_radiosity,
            shadow_packets: world.suits_shadow_packets(),
            packets: !features.has_media
                && !has_radiosity
                && direct::opaque::supports(world, quality),
        }
    }
}

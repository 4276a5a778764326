//! Atmosphere along a ray outside of solid objects: media, rainbows and fog.

use super::{Path, Sample, Tracer};
use crate::base::math::Ray;
use crate::render::shade::Scratch;
use crate::scene::atmosphere::{MISS_DISTANCE, Tint, combined_tint, mean_tint};
use crate::world::{InteriorId, LightList, SpawnSurface};

/// Attenuation and in-scattered light along a ray, in the order in which they apply.
#[derive(Clone, Copy, Debug)]
pub(super) struct AtmosphereTint {
    /// The media of the interiors around the ray.
    inside: Option<Tint>,
    rainbow: Option<Tint>,
    /// The media of the atmosphere.
    media: Option<Tint>,
    fog: Option<Tint>,
}

/// The surface where a ray's segment ends.
#[derive(Clone, Copy)]
pub(super) struct SegmentEnd {
    /// The distance from the origin of the ray.
    pub(super) length: f64,
    pub(super) surface: SpawnSurface,
    /// The lights that media scatter before it.
    pub(super) lights: LightList,
}

/// The end of a ray's segment through the atmosphere.
#[derive(Clone, Copy)]
pub(super) enum End {
    Surface(SegmentEnd),
    /// No hit.
    Nothing,
}

impl Tracer<'_> {
    /// Returns true if the scene has media, fog or rainbows.
    pub(super) fn has_atmosphere(&self) -> bool {
        self.features.has_media || !self.world.has_clear_atmosphere()
    }

    /// The effect of the atmosphere on light along a ray; `None` where it has none. A ray without a hit is affected by the
    /// media of the atmosphere, but not by those of the interiors around it (measured with POV-Ray).
    ///
    /// An object that is not `hollow` keeps the atmosphere out, even if it is only the half-space of a plane.
    pub(super) fn atmosphere(
        &self,
        path: &Path,
        end: End,
        scratch: &mut Scratch,
    ) -> Option<AtmosphereTint> {
        if !self.has_atmosphere()
            || self.is_without_atmosphere(path)
            || !self.is_outside_solids(&path.inside)
        {
            return None;
        }
        let surface = match &end {
            End::Surface(end) => Some(end.surface),
            End::Nothing => None,
        };
        let (inside, length, lights) = match end {
            End::Surface(end) => {
                let inside = self.media_inside(path, &end, scratch);
                (inside, end.length, end.lights)
            }
            End::Nothing => {
                let length = self.world.globals.unit * MISS_DISTANCE;
                (None, length, LightList::default())
            }
        };
        // The last rainbow comes first, as in POV-Ray: it matters where they draw random numbers.
        let (rainbows, dir) = (self.world.rainbows.iter().rev(), path.ray.dir);
        let stream = &mut scratch.random.lights;
        let arcs = rainbows.filter_map(|rainbow| rainbow.tint(dir, length, stream));
        Some(AtmosphereTint {
            inside,
            rainbow: mean_tint(arcs),
            media: self.atmospheric_media(path, length, lights, surface, scratch),
            fog: self.fog(&path.ray, length),
        })
    }

    /// The effect of fog along a ray in the atmosphere.
    pub(super) fn fog(&self, ray: &Ray, length: f64) -> Option<Tint> {
        let fogs = &self.world.fogs;
        let noise = self.world.globals.noise;
        (!fogs.is_empty())
            .then(|| combined_tint(fogs.iter().map(|fog| fog.tint(ray, length, noise))))
    }

    /// Returns true if no solid object is around a ray.
    pub(super) fn is_outside_solids(&self, inside: &[InteriorId]) -> bool {
        let interiors = &self.world.interiors;
        inside.iter().all(|&id| interiors.is_hollow(id))
    }
}

impl Sample {
    /// The sample behind the atmosphere.
    pub(super) fn behind_atmosphere(self, atmosphere: Option<AtmosphereTint>) -> Sample {
        let Some(atmosphere) = atmosphere else {
            return self;
        };
        let tints = [
            atmosphere.inside,
            atmosphere.rainbow,
            atmosphere.media,
            atmosphere.fog,
        ];
        tints.into_iter().flatten().fold(self, |seen, tint| Sample {
            rgb: tint.apply(seen.rgb),
            transmit: seen.transmit * tint.factor.grey(),
        })
    }
}

//! What rays cross on their way: media, rainbows and fog, where nothing solid is around them.

use super::{Inside, Path, Sample, Tracer};
use crate::base::math::Ray;
use crate::scene::atmosphere::{Tint, WAY_TO_NOTHING, mean_of, sum_of};
use crate::world::{LightList, Scratch};

/// What the air does to light, the rainbows first.
#[derive(Clone, Copy, Debug)]
pub(super) struct AirTint {
    /// The media of the interiors that the ray is in.
    inside: Option<Tint>,
    rainbow: Option<Tint>,
    /// The media of the atmosphere.
    media: Option<Tint>,
    fog: Option<Tint>,
}

/// Where the way of a ray through the air ends.
#[derive(Clone, Copy)]
pub(super) enum End {
    /// At a surface this far away, with the lights that media scatter before it.
    Surface(f64, LightList),
    /// Nowhere.
    Nothing,
}

impl Tracer<'_> {
    /// Whether air does anything anywhere.
    pub(super) fn has_air(&self) -> bool {
        self.has_media || !self.world.has_clear_air()
    }

    /// What the air does to light along a ray from its start; `None` where it does nothing. A ray that meets nothing is not
    /// touched by the media of what it is in, but by those of the atmosphere (measured with POV-Ray).
    ///
    /// An object that is not `hollow` keeps the air out, also where it is only the half-space of a plane.
    pub(super) fn air(&self, path: &Path, end: End, scratch: &mut Scratch) -> Option<AirTint> {
        if !self.has_air() || self.is_airless(path) || !self.is_in_air(&path.inside) {
            return None;
        }
        let (inside, length, lights) = match end {
            End::Surface(length, lights) => {
                let inside = self.media_inside(path, length, lights, scratch);
                (inside, length, lights)
            }
            End::Nothing => {
                let length = self.world.globals.unit * WAY_TO_NOTHING;
                (None, length, LightList::default())
            }
        };
        // The last comes first, as in POV-Ray: that counts where they take random numbers.
        let (rainbows, dir) = (self.world.rainbows.iter().rev(), path.ray.dir);
        let stream = &mut scratch.stream;
        let arcs = rainbows.filter_map(|rainbow| rainbow.tint(dir, length, stream));
        Some(AirTint {
            inside,
            rainbow: mean_of(arcs),
            media: self.media_of_air(path, length, lights, scratch),
            fog: self.fog(&path.ray, length),
        })
    }

    /// What fog does to light along a ray that is in the air.
    pub(super) fn fog(&self, ray: &Ray, length: f64) -> Option<Tint> {
        let fogs = &self.world.fogs;
        let noise = self.world.globals.noise;
        (!fogs.is_empty()).then(|| sum_of(fogs.iter().map(|fog| fog.tint(ray, length, noise))))
    }

    /// Whether nothing solid is around a ray.
    pub(super) fn is_in_air(&self, inside: &Inside) -> bool {
        let interiors = &self.world.interiors;
        inside.iter().all(|&id| interiors.is_hollow(id))
    }
}

impl Sample {
    /// The same behind air.
    pub(super) fn through(self, air: Option<AirTint>) -> Sample {
        let Some(air) = air else { return self };
        let tints = [air.inside, air.rainbow, air.media, air.fog];
        tints.into_iter().flatten().fold(self, |seen, tint| Sample {
            rgb: tint.of(seen.rgb),
            transmit: seen.transmit * tint.factor.grey(),
        })
    }
}

//! What rays cross on their way: rainbows, and fog, where nothing solid is around them.

use super::{Inside, Sample, Tracer};
use crate::atmosphere::{Tint, mean_of, sum_of};
use crate::math::Ray;
use crate::math::mersenne::Stream;

/// What the air does to light, the rainbows first.
#[derive(Clone, Copy)]
pub(super) struct Air {
    rainbow: Option<Tint>,
    fog: Option<Tint>,
}

impl Tracer<'_> {
    /// Whether air does anything anywhere.
    pub(super) fn has_air(&self) -> bool {
        !(self.world.fogs.is_empty() && self.world.rainbows.is_empty())
    }

    /// What the air does to light along a ray from its start over `length`; `None` where it does nothing.
    ///
    /// An object that is not `hollow` keeps the air out, also where it is only the half-space of a plane.
    pub(super) fn air(
        &self,
        ray: &Ray,
        length: f64,
        inside: &Inside,
        stream: &mut Stream,
    ) -> Option<Air> {
        if !self.has_air() || !self.is_in_air(inside) {
            return None;
        }
        let rainbows = self.world.rainbows.iter();
        let arcs = rainbows.filter_map(|rainbow| rainbow.tint(ray.dir, length, stream));
        Some(Air {
            rainbow: mean_of(arcs),
            fog: self.fog(ray, length),
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
    pub(super) fn through(self, air: Option<Air>) -> Sample {
        let Some(air) = air else { return self };
        let tints = air.rainbow.into_iter().chain(air.fog);
        tints.fold(self, |seen, tint| Sample {
            rgb: tint.of(seen.rgb),
            transmit: seen.transmit * tint.factor.grey(),
        })
    }
}

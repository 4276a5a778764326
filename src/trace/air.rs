//! What rays cross on their way: fog, where nothing solid is around them.

use super::{Inside, Sample, Tracer};
use crate::atmosphere::{Tint, sum_of};
use crate::math::Ray;

impl Tracer<'_> {
    /// What the air does to light along a ray from its start over `length`; `None` where it does nothing.
    ///
    /// An object that is not `hollow` keeps the air out, also where it is only the half-space of a plane.
    pub(super) fn air(&self, ray: &Ray, length: f64, inside: &Inside) -> Option<Tint> {
        let world = self.world;
        if world.fogs.is_empty() || !inside.iter().all(|&id| world.interiors.is_hollow(id)) {
            return None;
        }
        let noise = world.globals.noise;
        Some(sum_of(
            world.fogs.iter().map(|fog| fog.tint(ray, length, noise)),
        ))
    }
}

impl Sample {
    /// The same behind air.
    pub(super) fn through(self, air: Option<Tint>) -> Sample {
        match air {
            None => self,
            Some(tint) => Sample {
                rgb: tint.of(self.rgb),
                transmit: self.transmit * tint.factor.grey(),
            },
        }
    }
}

//! Shadow rays to lights that are projected through an object (`projected_through`).

use super::QueryScratch;
use crate::world::csg::sweep::{RawHit, RayInterval, SweepContext};
use crate::world::lights::Lights;
use crate::world::primitive::Leaf;
use crate::world::ray::Query;

impl Lights {
    /// Far limit of a shadow ray: the first wanted hit on the object that the light is projected through, beyond
    /// `least`. `None` if the ray misses the object, so that no light arrives.
    pub(in crate::world) fn t_max_at_projector(
        &self,
        light: u32,
        leaves: &[Leaf],
        query: &Query,
        least: f64,
        wanted: impl FnMut(&RawHit) -> bool,
        scratch: &mut QueryScratch,
    ) -> Option<f64> {
        let Some(program) = self.projector(light) else {
            return Some(query.t_max);
        };
        let interval = RayInterval {
            from: least,
            to: query.t_max,
        };
        let context = SweepContext {
            leaves,
            ray: &query.ray,
            departure: query.origin_surface.as_ref(),
            is_shadow: true,
            rounding: None,
        };
        program
            .nearest(context, interval, &mut scratch.sweep, wanted)
            .map(|hit| hit.root.t)
    }
}

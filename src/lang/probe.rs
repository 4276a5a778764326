//! `trace` and `inside`: ray and point queries on the scene's own objects while it is read.

use crate::base::math::conditioning::Normalization;
use crate::scene::Object;
use crate::scene::pattern::SolidOf;
use glam::DVec3;
use std::sync::Arc;

/// Answers queries on objects of the scene that is being read. Points and directions are in the coordinates
/// that contain the object: world space at top level.
pub trait Probe {
    /// The first surface on the ray from `from` along `dir`, which need not be normalised: the point, and the normal of
    /// length 1 that the object gives there, smoothed where the object is, not turned towards the ray. Last digits are
    /// those of this normalization.
    fn trace(
        &mut self,
        object: &Arc<Object>,
        from: DVec3,
        dir: DVec3,
        normalization: Normalization,
    ) -> Option<(DVec3, DVec3)>;

    /// True if a point lies in a solid object.
    fn is_inside(&mut self, object: &Arc<Object>, point: DVec3) -> bool;

    /// The compiler of objects for the `object` pattern in functions; without it, nothing is inside of anything.
    fn solid_of(&self) -> Option<SolidOf> {
        None
    }
}

/// A [`Probe`] that hits nothing, for reading without a renderer.
#[derive(Clone, Copy, Debug)]
pub struct NoProbe;

impl Probe for NoProbe {
    fn trace(
        &mut self,
        _: &Arc<Object>,
        _: DVec3,
        _: DVec3,
        _: Normalization,
    ) -> Option<(DVec3, DVec3)> {
        None
    }

    fn is_inside(&mut self, _: &Arc<Object>, _: DVec3) -> bool {
        false
    }
}

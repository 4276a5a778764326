//! How many rays were followed, by kind.

use super::query::{Query, RayKind};
use std::ops::AddAssign;

/// Numbers of rays by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the camera.
    pub camera: u64,
    /// Straight on or bent through surfaces.
    pub onward: u64,
    /// Mirror images, and what comes of them.
    pub reflected: u64,
    /// For radiosity, with what comes of them.
    pub gathering: u64,
    /// From a point to a light.
    pub shadow: u64,
    /// From surface to surface on the way to a light.
    pub filtered: u64,
}

impl RayCounts {
    /// All of them.
    #[must_use]
    pub fn sum(&self) -> u64 {
        self.camera + self.onward + self.reflected + self.gathering + self.shadow + self.filtered
    }

    /// Counts a search for the nearest surface.
    #[inline]
    pub(super) fn count(&mut self, query: &Query) {
        match (query.kind, &query.origin_surface) {
            (RayKind::Camera, None) => self.camera += 1,
            (RayKind::Camera, Some(_)) => self.onward += 1,
            (RayKind::Reflection, _) => self.reflected += 1,
            (RayKind::Radiosity | RayKind::RadiosityReflection, _) => self.gathering += 1,
            (RayKind::Shadow, _) => self.filtered += 1,
        }
    }
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, other: RayCounts) {
        self.camera += other.camera;
        self.onward += other.onward;
        self.reflected += other.reflected;
        self.gathering += other.gathering;
        self.shadow += other.shadow;
        self.filtered += other.filtered;
    }
}

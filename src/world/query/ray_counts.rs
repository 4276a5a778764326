//! Ray statistics: numbers of rays traced, by kind.

use crate::world::ray::{Query, RayKind};
use std::ops::AddAssign;

/// Numbers of rays by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Camera rays.
    pub camera: u64,
    /// Straight or refracted continuations of camera rays.
    pub onward: u64,
    /// Reflected rays and their continuations.
    pub reflected: u64,
    /// Radiosity sample rays and their continuations.
    pub gathering: u64,
    /// Shadow rays.
    pub shadow: u64,
    /// Segments of shadow rays behind a transmissive surface.
    pub filtered: u64,
}

impl RayCounts {
    /// The sum over all kinds.
    #[must_use]
    pub fn sum(&self) -> u64 {
        self.camera + self.onward + self.reflected + self.gathering + self.shadow + self.filtered
    }

    /// Counts a closest-hit query.
    #[inline]
    pub(in crate::world) fn count(&mut self, query: &Query) {
        match (query.kind, &query.origin_surface) {
            (RayKind::Camera, None) => self.camera += 1,
            (RayKind::Camera, Some(_)) | (RayKind::Subsurface, _) => self.onward += 1,
            (RayKind::Reflection, _) => self.reflected += 1,
            (RayKind::Radiosity | RayKind::RadiosityReflection, _) => self.gathering += 1,
            (RayKind::Shadow | RayKind::Photon | RayKind::PhotonReflection, _) => {
                self.filtered += 1;
            }
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

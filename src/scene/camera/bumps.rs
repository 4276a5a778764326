//! `normal` in a camera: bump mapping applied to ray directions. The direction of a ray is perturbed as a surface
//! normal would be, at its image point in the coordinates of the projection; with a lens, at the point of the lens
//! sample.

use crate::base::math::Ray;
use crate::scene::pattern::{Settings, SurfacePoint};
use crate::scene::texture::{Normal, PreparedNormal};
use glam::DVec2;
use std::sync::Arc;

/// Bumps of a camera.
#[derive(Clone, Debug)]
pub(super) struct Bumps {
    normal: Arc<Normal>,
    /// Length of a scene unit in the camera frame.
    pub(super) unit: f64,
    prepared: Option<Arc<PreparedNormal>>,
}

/// Bumps are equal if they share the same `normal` block.
impl PartialEq for Bumps {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.normal, &other.normal)
    }
}

impl Bumps {
    pub(super) fn new(normal: Arc<Normal>) -> Self {
        Bumps {
            normal,
            unit: 1.0,
            prepared: None,
        }
    }

    /// Prepares the normal for evaluation.
    pub(super) fn prepare(&mut self, settings: &Settings) {
        self.prepared = PreparedNormal::new(&self.normal, &[], settings).map(Arc::new);
    }

    /// Perturbs a ray of unit direction at a point of the image.
    #[cold]
    pub(super) fn bend(&self, at: DVec2, ray: Ray) -> Ray {
        let point = at.extend(0.0);
        let dir = match &self.prepared {
            Some(bumps) => bumps.tilted(point, ray.dir, &SurfacePoint::at(point)),
            None => ray.dir,
        };
        Ray { dir, ..ray }
    }
}

//! `normal` in a camera: every ray is bent as the normal of a bumpy surface would be, at its point of the picture in the
//! measure of the camera; behind a lens that of the sample.

use crate::base::math::Ray;
use crate::scene::pattern::{Settings, SurfacePoint};
use crate::scene::texture::{Normal, PreparedNormal};
use glam::DVec2;
use std::sync::Arc;

/// Bumps before a camera.
#[derive(Clone, Debug)]
pub(super) struct Bumps {
    normal: Arc<Normal>,
    /// How long a unit of the scene is in the frame of the camera.
    pub(super) unit: f64,
    prepared: Option<Arc<PreparedNormal>>,
}

/// Bumps are the same if they come from the same text.
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

    /// Makes them ready for rays.
    pub(super) fn prepare(&mut self, settings: &Settings) {
        self.prepared = PreparedNormal::new(&self.normal, &[], settings).map(Arc::new);
    }

    /// A ray of unit direction behind them.
    #[cold]
    pub(super) fn bent(&self, place: DVec2, ray: Ray) -> Ray {
        let point = place.extend(0.0);
        let dir = match &self.prepared {
            Some(bumps) => bumps.tilted(point, ray.dir, &SurfacePoint::at(point)),
            None => ray.dir,
        };
        Ray { dir, ..ray }
    }
}

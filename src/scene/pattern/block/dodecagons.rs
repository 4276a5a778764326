//! The pattern `tiling 22`: dodecagons of side 1 with triangles between them, whose sides fall at two slopes, unlike
//! those of [`super::tiling`].

use crate::base::math::rounding::floor;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;

/// The square root of 3, and half of it.
const ROOT: f64 = 1.732_050_807_568_877_2;
const HALF_ROOT: f64 = 0.866_025_403_784_438_6;

#[derive(Clone, Copy, Debug)]
pub(super) struct Dodecagons;

impl Pattern for Dodecagons {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }
}

impl PatternEval for Dodecagons {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let (mut x, mut z) = (point.x, point.z);
        x -= (2.0 + ROOT) * floor(x / (2.0 + ROOT));
        z -= (3.0 + 2.0 * ROOT) * floor(z / (3.0 + 2.0 * ROOT));
        if z > ROOT + 1.5 {
            z -= ROOT + 1.5;
            x += if x < 1.0 + HALF_ROOT {
                1.0 + HALF_ROOT
            } else {
                -(1.0 + HALF_ROOT)
            };
        }
        if x > 1.0 + HALF_ROOT {
            x = 2.0 + ROOT - x;
        }
        let points_down = z > 1.0 + HALF_ROOT;
        if points_down {
            z = 2.0 + ROOT - z;
        }
        let mut slanted = x - HALF_ROOT - 0.5 + z * ROOT;
        if slanted < 0.0 {
            (x, z) = (
                (1.0 + ROOT) / 4.0 + x / 2.0 - HALF_ROOT * z,
                (3.0 + ROOT) / 4.0 - HALF_ROOT * x - z / 2.0,
            );
            slanted = -slanted;
        }
        let beside = (z - HALF_ROOT - 0.5 + x * ROOT) * ROOT;
        if beside < 0.0 {
            let first = if points_down { 2.0 } else { 1.0 };
            return (beside.max(-1.0) + first) / 3.0;
        }
        let nearest = (3.0 * z)
            .min(slanted * ROOT)
            .min(beside)
            .min(3.0 * x)
            .min(1.0);
        (3.000_000_1 - nearest) / 3.0
    }
}

//! `warp { cubic }`: the unit square of the xy plane wrapped around a cube, as a cross of six faces of 1/4 by 1/3.
//!
//! Points are projected from the origin onto the cube. The third coordinate of the result is the largest absolute
//! coordinate of the point (measured).

use super::{Warp, WarpEval};
use crate::base::args::{Args, Parse};
use crate::scene::pattern::Settings;
use glam::DVec3;

#[derive(Clone, Copy, Debug)]
struct Cubic;

#[allow(clippy::unnecessary_wraps, reason = "readers of other warps fail")]
pub(super) fn read(_args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    Ok(Box::new(Cubic))
}

impl Warp for Cubic {
    fn prepare(&self, _settings: &Settings) -> Box<dyn WarpEval> {
        Box::new(*self)
    }
}

impl WarpEval for Cubic {
    fn moved(&self, point: DVec3) -> DVec3 {
        let size = point.abs().max_element();
        if size == 0.0 {
            return DVec3::ZERO;
        }
        let p = point / size;
        let (u, v) = if point.x.abs() == size {
            // The faces +x and -x adjoin the face +z on either side, so that z runs in opposite directions.
            (
                0.375 + point.x.signum() * (0.25 - p.z * 0.125),
                0.5 + p.y / 6.0,
            )
        } else if point.y.abs() == size {
            let outwards = (2.0 - p.z) / 6.0;
            (0.375 + p.x * 0.125, 0.5 + point.y.signum() * outwards)
        } else if point.z > 0.0 {
            (0.375 + p.x * 0.125, 0.5 + p.y / 6.0)
        } else {
            (0.875 - p.x * 0.125, 0.5 + p.y / 6.0)
        };
        DVec3::new(u, v, size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_layout_of_the_faces_matches_pov_ray() {
        // Printed by POV-Ray 3.7.
        for (point, u, v) in [
            ([2.0, 0.4, 0.6], 0.5875, 0.53333),
            ([-2.0, 0.4, 0.6], 0.1625, 0.53333),
            ([0.4, 2.0, 0.6], 0.4, 0.78333),
            ([0.4, -2.0, 0.6], 0.4, 0.21667),
            ([0.4, 0.6, 2.0], 0.4, 0.55),
            ([0.4, 0.6, -2.0], 0.85, 0.55),
        ] {
            let moved = Cubic.moved(DVec3::from(point));
            let expected = DVec3::new(u, v, 2.0);
            assert!(
                (moved - expected).abs().max_element() < 1e-5,
                "{point:?}: {moved}"
            );
        }
    }
}

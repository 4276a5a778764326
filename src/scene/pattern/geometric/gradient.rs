//! `gradient`: linear along a direction, with period 1.

use crate::base::args::{Args, Parse};
use crate::base::math::rounding::floor;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;

#[derive(Clone, Copy, Debug)]
struct Gradient {
    /// A unit vector; zero where the scene gives none.
    dir: DVec3,
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    let dir = args.vector()?.normalize_or_zero();
    Ok(Box::new(Gradient { dir }))
}

impl Pattern for Gradient {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }
}

impl PatternEval for Gradient {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let along = point.dot(self.dir);
        // The wave wraps the value again, at slightly more than 1. Negative values are wrapped by the wave alone.
        if along > 1.0 {
            along - floor(along)
        } else {
            along
        }
    }
}

//! `aoi`: the angle of incidence, from 0.5 where the ray grazes the surface to 1 at
//! normal incidence.

use crate::base::args::{Args, Parse};
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;
use std::f64::consts::PI;

#[derive(Clone, Copy, Debug)]
struct AngleOfIncidence;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(AngleOfIncidence))
}

impl Pattern for AngleOfIncidence {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }
}

impl PatternEval for AngleOfIncidence {
    fn value(&self, _point: DVec3, spot: &SurfacePoint) -> f64 {
        spot.normal.dot(spot.dir).clamp(-1.0, 1.0).acos() / PI
    }

    fn needs_normal(&self) -> bool {
        true
    }
}

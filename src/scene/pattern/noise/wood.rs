//! `wood`: rings around the z axis, which turbulence shifts by sines.

use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::base::math::noise::{Octaves, vector_turbulence};
use crate::scene::pattern::wave::cycloidal;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, Stop, SurfacePoint, Wave};
use glam::DVec3;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 4] = [
    (0.0, Color::opaque(Rgb::new(0.666, 0.312, 0.2))),
    (0.6, Color::opaque(Rgb::new(0.666, 0.312, 0.2))),
    (0.6, Color::opaque(Rgb::new(0.4, 0.1333, 0.066))),
    (1.0, Color::opaque(Rgb::new(0.4, 0.1333, 0.066))),
];

#[derive(Clone, Copy, Debug)]
struct Wood;

#[derive(Debug)]
struct Prepared {
    amount: DVec3,
    octaves: Octaves,
}

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Wood))
}

impl Pattern for Wood {
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(Prepared {
            amount: context.turbulence,
            octaves: context.octaves,
        })
    }

    fn default_map(&self) -> &'static [Stop] {
        &COLORS
    }

    fn default_wave(&self) -> Wave {
        Wave::TRIANGLE
    }

    fn is_displaced(&self) -> bool {
        false
    }
}

impl PatternEval for Prepared {
    fn jumps(&self) -> bool {
        false
    }

    fn value(&self, p: DVec3, _spot: &SurfacePoint) -> f64 {
        let (mut x, mut y) = (p.x, p.y);
        if self.amount != DVec3::ZERO {
            let shift = vector_turbulence(p, &self.octaves);
            x += cycloidal((p.x + shift.x) * self.amount.x);
            y += cycloidal((p.y + shift.y) * self.amount.y);
        }
        (x * x + y * y).sqrt()
    }
}

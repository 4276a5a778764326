//! `marble`: layers perpendicular to x, which turbulence shifts along x only.

use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::base::math::noise::{NoiseGenerator, Octaves};
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, Stop, SurfacePoint, Wave};
use glam::DVec3;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 4] = [
    (0.0, Color::opaque(Rgb::new(0.9, 0.8, 0.8))),
    (0.9, Color::opaque(Rgb::new(0.9, 0.08, 0.08))),
    (0.9, Color::opaque(Rgb::BLACK)),
    (1.0, Color::opaque(Rgb::BLACK)),
];

#[derive(Clone, Copy, Debug)]
struct Marble;

#[derive(Debug)]
struct Prepared {
    amount: f64,
    octaves: Octaves,
    noise: NoiseGenerator,
}

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Marble))
}

impl Pattern for Marble {
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(Prepared {
            amount: context.turbulence.x,
            octaves: context.octaves,
            noise: context.noise,
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

    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        if self.amount == 0.0 {
            return point.x;
        }
        point.x + self.amount * self.noise.turbulence(point, &self.octaves)
    }

    fn values_x4(&self, points: &[DVec3; 4], _spots: [&SurfacePoint; 4]) -> [f64; 4] {
        if self.amount == 0.0 {
            return points.map(|point| point.x);
        }
        let turbulences = self.noise.turbulence_x4(points, &self.octaves);
        std::array::from_fn(|i| points[i].x + self.amount * turbulences[i])
    }
}

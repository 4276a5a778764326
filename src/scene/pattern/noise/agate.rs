//! `agate`: bands perpendicular to z, bent by turbulence of their own.

use crate::base::args::{Args, Parse, Word};
use crate::base::color::{Color, Rgb};
use crate::base::math::noise::{NoiseGenerator, Octaves};
use crate::scene::pattern::wave::cycloidal;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, Stop, SurfacePoint};
use glam::DVec3;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 6] = [
    (0.0, Color::opaque(Rgb::WHITE)),
    (0.5, Color::opaque(Rgb::new(0.95, 0.75, 0.5))),
    (0.5, Color::opaque(Rgb::new(0.9, 0.7, 0.5))),
    (0.6, Color::opaque(Rgb::new(0.9, 0.7, 0.4))),
    (0.6, Color::opaque(Rgb::new(1.0, 0.7, 0.4))),
    (1.0, Color::opaque(Rgb::new(0.6, 0.3, 0.0))),
];

#[derive(Clone, Copy, Debug)]
struct Agate {
    /// `agate_turb`: amount by which the bands are bent, in addition to `turbulence`, which displaces the whole
    /// pattern.
    turbulence: f32,
}

#[derive(Debug)]
struct Prepared {
    amount: f64,
    octaves: Octaves,
    noise: NoiseGenerator,
}

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Agate { turbulence: 1.0 }))
}

impl Pattern for Agate {
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(Prepared {
            amount: f64::from(self.turbulence),
            octaves: context.octaves,
            noise: context.noise,
        })
    }

    fn default_map(&self) -> &'static [Stop] {
        &COLORS
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let is_known = word == Word::AgateTurb && args.accept(word)?;
        if is_known {
            self.turbulence = args.single()?;
        }
        Ok(is_known)
    }
}

impl PatternEval for Prepared {
    fn jumps(&self) -> bool {
        false
    }

    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        self.band(point, self.noise.turbulence(point, &self.octaves))
    }

    fn values_x4(&self, points: &[DVec3; 4], _spots: [&SurfacePoint; 4]) -> [f64; 4] {
        let turbulences = self.noise.turbulence_x4(points, &self.octaves);
        std::array::from_fn(|i| self.band(points[i], turbulences[i]))
    }
}

impl Prepared {
    /// The value at a point with this turbulence.
    #[inline]
    fn band(&self, point: DVec3, turbulence: f64) -> f64 {
        let bend = self.amount * turbulence;
        let band = cycloidal(1.3 * bend + 1.1 * point.z) + 1.0;
        (0.5 * band).clamp(0.0, 1.0).powf(0.77)
    }
}

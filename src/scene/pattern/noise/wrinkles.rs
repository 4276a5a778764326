//! `wrinkles`: ten octaves of noise, each clamped to its range.

use crate::base::args::{Args, Parse};
use crate::base::math::noise::{NoiseGenerator, OctaveTerm, clamped, vector_octaves};
use crate::base::math::simd::F64Lanes;
use crate::scene::pattern::Pattern;
use crate::scene::pattern::geometric::formula::NoiseFormula;
use glam::DVec3;

/// Number of octaves.
const OCTAVES: u32 = 10;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    NoiseFormula::new(value)
        .with_x4(values_x4)
        .with_tilt(tilt)
        .boxed()
}

fn value(generator: NoiseGenerator, point: DVec3) -> f64 {
    generator.octaves(point, (OCTAVES, 1.0), InRange) / 2.0
}

fn values_x4(generator: NoiseGenerator, points: &[DVec3; 4]) -> [f64; 4] {
    let sums = generator.octaves_x4(points, (OCTAVES, 1.0), InRange);
    sums.map(|sum| sum / 2.0)
}

/// Noise clamped to its range.
#[derive(Clone, Copy)]
struct InRange;

impl OctaveTerm for InRange {
    #[inline(always)]
    fn of<F: F64Lanes>(self, generator: NoiseGenerator, noise: F, _is_first: F::Mask) -> F {
        match generator {
            NoiseGenerator::Original => noise,
            _ => clamped(F::splat(2.0) * noise - F::splat(0.5)),
        }
    }
}

fn tilt(_generator: NoiseGenerator, point: DVec3) -> DVec3 {
    vector_octaves(point, OCTAVES, |noise, frequency| (noise / frequency).abs())
}

//! `granite`: six octaves of noise, folded at the middle of its range.

use crate::base::args::{Args, Parse};
use crate::base::math::noise::{NoiseGenerator, OctaveTerm};
use crate::base::math::simd::F64Lanes;
use crate::scene::pattern::Pattern;
use crate::scene::pattern::geometric::formula::NoiseFormula;
use glam::DVec3;

/// Number of octaves.
const OCTAVES: u32 = 6;
/// The scale of the first octave.
const SCALE: f64 = 4.0;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    NoiseFormula::new(value).with_x4(values_x4).boxed()
}

fn value(generator: NoiseGenerator, point: DVec3) -> f64 {
    generator.octaves(point, (OCTAVES, SCALE), Folded)
}

fn values_x4(generator: NoiseGenerator, points: &[DVec3; 4]) -> [f64; 4] {
    generator.octaves_x4(points, (OCTAVES, SCALE), Folded)
}

/// Noise folded at the middle of its range.
#[derive(Clone, Copy)]
struct Folded;

impl OctaveTerm for Folded {
    #[inline(always)]
    fn of<F: F64Lanes>(self, generator: NoiseGenerator, noise: F, _is_first: F::Mask) -> F {
        let half = F::splat(0.5);
        match generator {
            NoiseGenerator::Original => (half - noise).abs(),
            _ => (F::splat(1.0) - F::splat(2.0) * noise).abs().lane_min(half),
        }
    }
}

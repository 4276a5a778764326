//! `granite`: six octaves of noise, folded at the middle of its range.

use crate::base::args::{Args, Parse};
use crate::base::math::noise::NoiseGenerator;
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
    generator.octaves(point, (OCTAVES, SCALE), |noise| folded(generator, noise))
}

fn values_x4(generator: NoiseGenerator, points: &[DVec3; 4]) -> [f64; 4] {
    generator.octaves_x4(points, (OCTAVES, SCALE), |noise| folded(generator, noise))
}

#[inline(always)]
fn folded(generator: NoiseGenerator, noise: f64) -> f64 {
    match generator {
        NoiseGenerator::Original => (0.5 - noise).abs(),
        _ => (1.0 - 2.0 * noise).abs().min(0.5),
    }
}

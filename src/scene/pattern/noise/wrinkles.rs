//! `wrinkles`: ten octaves of noise, each clamped to its range.

use crate::base::args::{Args, Parse};
use crate::base::math::noise::{NoiseGenerator, vector_octaves};
use crate::scene::pattern::Pattern;
use crate::scene::pattern::geometric::formula::NoiseFormula;
use glam::DVec3;

/// Number of octaves.
const OCTAVES: u32 = 10;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    NoiseFormula::new(value).with_tilt(tilt).boxed()
}

fn value(generator: NoiseGenerator, point: DVec3) -> f64 {
    let sum = generator.octaves(point, (OCTAVES, 1.0), |noise| match generator {
        NoiseGenerator::Original => noise,
        _ => (2.0 * noise - 0.5).clamp(0.0, 1.0),
    });
    sum / 2.0
}

fn tilt(_generator: NoiseGenerator, point: DVec3) -> DVec3 {
    vector_octaves(point, OCTAVES, |noise, frequency| (noise / frequency).abs())
}

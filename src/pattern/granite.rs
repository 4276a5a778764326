//! `granite`: six octaves of noise folded at its middle.

use super::Pattern;
use super::formula::NoiseFormula;
use crate::args::{Args, Parse};
use crate::math::noise::NoiseGenerator;
use glam::DVec3;

/// How many octaves are summed.
const OCTAVES: u32 = 6;
/// The scale of the first octave.
const SCALE: f64 = 4.0;

pub(super) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    NoiseFormula::new(value).boxed()
}

fn value(generator: NoiseGenerator, point: DVec3) -> f64 {
    let folded = |point: DVec3| match generator {
        NoiseGenerator::Original => (0.5 - generator.noise(point)).abs(),
        _ => (1.0 - 2.0 * generator.noise(point)).abs().min(0.5),
    };
    let mut frequency = 1.0;
    let mut sum = 0.0;
    for _ in 0..OCTAVES {
        sum += folded(point * (SCALE * frequency)) / frequency;
        frequency *= 2.0;
    }
    sum
}

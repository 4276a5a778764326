//! `granite`: six octaves of noise folded at its middle.

use super::Pattern;
use super::formula::NoiseFormula;
use crate::args::{Args, Parse};
use crate::math::lanes::with_widest;
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
    with_widest(
        #[inline(always)]
        |lanes| {
            let folded = |point: DVec3| {
                let noise = generator.noise_in(lanes, point);
                match generator {
                    NoiseGenerator::Original => (0.5 - noise).abs(),
                    _ => (1.0 - 2.0 * noise).abs().min(0.5),
                }
            };
            let mut frequency = 1.0;
            let mut sum = 0.0;
            for _ in 0..OCTAVES {
                sum += folded(point * (SCALE * frequency)) / frequency;
                frequency *= 2.0;
            }
            sum
        },
    )
}

//! `dents`: the cube of noise, with rare peaks.

use crate::base::args::{Args, Parse};
use crate::base::math::noise::{NoiseGenerator, vector_noise};
use crate::scene::pattern::Pattern;
use crate::scene::pattern::geometric::formula::NoiseFormula;
use glam::DVec3;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    NoiseFormula::new(value)
        .with_tilt(|generator, point| value(generator, point) * vector_noise(point))
        .boxed()
}

fn value(generator: NoiseGenerator, point: DVec3) -> f64 {
    let noise = generator.noise(point);
    noise * noise * noise
}

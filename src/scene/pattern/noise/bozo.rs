//! `bozo`, `spotted` and `bumps`: plain noise.

use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::base::math::noise::{NoiseGenerator, vector_noise};
use crate::scene::pattern::geometric::formula::NoiseFormula;
use crate::scene::pattern::{Pattern, Stop};

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 8] = [
    (0.0, Color::opaque(Rgb::WHITE)),
    (0.4, Color::opaque(Rgb::WHITE)),
    (0.4, Color::opaque(Rgb::new(0.0, 1.0, 0.0))),
    (0.6, Color::opaque(Rgb::new(0.0, 1.0, 0.0))),
    (0.6, Color::opaque(Rgb::new(0.0, 0.0, 1.0))),
    (0.8, Color::opaque(Rgb::new(0.0, 0.0, 1.0))),
    (0.8, Color::opaque(Rgb::new(1.0, 0.0, 0.0))),
    (1.0, Color::opaque(Rgb::new(1.0, 0.0, 0.0))),
];

/// `bozo`, with default colours of its own.
pub(crate) fn bozo(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    NoiseFormula::new(NoiseGenerator::noise)
        .with_x4(NoiseGenerator::noise_x4)
        .with_map(&COLORS)
        .boxed()
}

/// `bumps`, from black to white; as a normal it adds vector noise.
pub(crate) fn bumps(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    NoiseFormula::new(NoiseGenerator::noise)
        .with_x4(NoiseGenerator::noise_x4)
        .with_tilt(|_, point| vector_noise(point))
        .boxed()
}

/// `spotted`, from black to white.
pub(crate) fn spotted(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    NoiseFormula::new(NoiseGenerator::noise)
        .with_x4(NoiseGenerator::noise_x4)
        .boxed()
}

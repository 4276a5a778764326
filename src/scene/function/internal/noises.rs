//! Noise, and landscapes from noise: Musgrave's multifractals (Ebert et al., "Texturing and Modeling", 1994, chapter
//! 16) and POV-Ray's `f_ridge`.
//!
//! POV-Ray computes the octave weights of `f_ridged_mf` once per run, from the `H` and lacunarity of the first call.
//! Scenes for 3.8 do so too (`first_call.rs`); in others every call computes its own.

use super::Internal;
use crate::base::math::noise::NoiseGenerator;
use glam::DVec3;

/// Limit on octaves; further ones are far below the last bit of any sum.
const MAX_OCTAVES: f64 = 1000.0;

/// The functions of this group.
pub(super) static LIST: &[Internal] = &[
    Internal::new(29, "f_hetero_mf", 6, hetero_mf),
    Internal::new(58, "f_ridge", 6, ridge),
    Internal::new(super::RIDGED_MF, "f_ridged_mf", 6, |p| {
        ridged_mf(p, [p[3], p[4]])
    }),
    // When a scene is parsed, the scene's own generator replaces this function.
    Internal::new(super::NOISE_3D, "f_noise3d", 0, |p| {
        NoiseGenerator::default().noise(point(p))
    }),
    Internal::new(78, "f_noise_generator", 1, |p| {
        generator(p[3]).noise(point(p))
    }),
];

fn point(p: &[f64]) -> DVec3 {
    DVec3::new(p[0], p[1], p[2])
}

/// The generator selected by the last two bits of a parameter.
fn generator(number: f64) -> NoiseGenerator {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "what does not fit names no generator anyway"
    )]
    NoiseGenerator::of_number(f64::from(number as i32 & 3))
}

/// `H, lacunarity, octaves, offset, T, generator`: each octave is weighted by the sum of the previous ones to the power
/// T; for a fractional last octave T is 1.
fn hetero_mf(p: &[f64]) -> f64 {
    let [_, _, _, h, lacunarity, octaves, offset, power, number] = *p else {
        return 0.0;
    };
    let noise = generator(number);
    let signed = |at: DVec3| 2.0 * noise.noise(at) - 1.0 + offset;
    #[allow(
        clippy::cast_possible_truncation,
        reason = "a float that does not fit goes to the nearest bound"
    )]
    let power = power.max(0.0) as i32;
    let octaves = octaves.min(MAX_OCTAVES);
    let (mut at, mut frequency) = (point(p), 1.0);
    let mut value = signed(at);
    let mut next = || {
        at *= lacunarity;
        frequency *= lacunarity;
        f64::powf(frequency, -h) * signed(at)
    };
    let mut octave = 1.0;
    while octave < octaves {
        value += next() * value.powi(power);
        octave += 1.0;
    }
    let part = octaves.fract();
    if part > 0.0 {
        value += part * next() * value;
    }
    value
}

/// `H, lacunarity, octaves, offset, gain, generator`: the octaves are folded at zero, squared, and weighted by the
/// previous one.
pub(in crate::scene::function) fn ridged_mf(p: &[f64], [h, growth]: [f64; 2]) -> f64 {
    let [_, _, _, _, lacunarity, octaves, offset, gain, number] = *p else {
        return 0.0;
    };
    let noise = generator(number);
    let folded = |at: DVec3| {
        let signal = offset - (2.0 * noise.noise(at) - 1.0).abs();
        signal * signal
    };
    let octaves = octaves.min(MAX_OCTAVES);
    let (mut at, mut frequency) = (point(p), 1.0);
    let mut signal = folded(at);
    let mut value = signal;
    let mut octave = 1.0;
    while octave < octaves {
        at *= lacunarity;
        frequency *= growth;
        signal = folded(at) * (signal * gain).clamp(0.0, 1.0);
        value += signal * f64::powf(frequency, -h);
        octave += 1.0;
    }
    value
}

/// `lambda, octaves, omega, offset, ridge, generator`: the weighted mean of octaves, each folded at `ridge`, where it
/// is 0. The mean is then rescaled by `offset`, which keeps one end of its range.
fn ridge(p: &[f64]) -> f64 {
    let [_, _, _, lambda, octaves, omega, offset, fold, number] = *p else {
        return 0.0;
    };
    let noise = generator(number);
    let folded = |at: DVec3| {
        let value = noise.noise(at);
        let side = if fold < 0.5 {
            (1.0 - value) / (1.0 - fold) - 1.0
        } else {
            1.0 - value / fold
        };
        side.abs()
    };
    let octaves = octaves.min(MAX_OCTAVES);
    let (mut at, mut size) = (point(p), 1.0);
    let (mut sum, mut sizes) = (folded(at), 1.0);
    let mut add = |part: f64| {
        at *= lambda;
        size *= omega;
        sum += part * size * folded(at);
        sizes += part * size;
    };
    let mut octave = 1.0;
    while octave < octaves.trunc() {
        add(1.0);
        octave += 1.0;
    }
    let part = octaves.fract();
    if part > 0.0 {
        add(part);
    }
    let mean = sum / sizes;
    if offset < 0.5 {
        (mean - offset) / (1.0 - offset)
    } else {
        mean / offset - 1.0
    }
}

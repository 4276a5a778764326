//! Noise, and landscapes made of it: Musgrave's multifractals (Ebert et al., "Texturing and Modeling", 1994, chapter 16)
//! and a ridge of POV-Ray's own.
//!
//! POV-Ray computes the sizes of the octaves of `f_ridged_mf` once in a run, for whatever `H` and lacunarity come first;
//! here every call has its own.

use super::Internal;
use crate::base::math::noise::NoiseGenerator;
use glam::DVec3;

/// More octaves are not summed; these are far below the last bit of any sum.
const MOST_OCTAVES: f64 = 1000.0;

/// The rows of this list.
pub(super) static LIST: &[Internal] = &[
    Internal::new(29, "f_hetero_mf", 6, hetero_mf),
    Internal::new(58, "f_ridge", 6, ridge),
    Internal::new(59, "f_ridged_mf", 6, ridged_mf),
    // Where a scene is read, its own generator takes this place.
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

/// The generator of a parameter: its last two bits.
fn generator(number: f64) -> NoiseGenerator {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "what does not fit names no generator anyway"
    )]
    NoiseGenerator::of_number(f64::from(number as i32 & 3))
}

/// `H, lacunarity, octaves, offset, T, generator`: each octave counts as much as the height below it to the power T; for
/// the part of an octave at the end T is 1.
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
    let octaves = octaves.min(MOST_OCTAVES);
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

/// `H, lacunarity, octaves, offset, gain, generator`: the octaves are folded at zero, squared, and weighted by the one
/// before.
fn ridged_mf(p: &[f64]) -> f64 {
    let [_, _, _, h, lacunarity, octaves, offset, gain, number] = *p else {
        return 0.0;
    };
    let noise = generator(number);
    let folded = |at: DVec3| {
        let signal = offset - (2.0 * noise.noise(at) - 1.0).abs();
        signal * signal
    };
    let octaves = octaves.min(MOST_OCTAVES);
    let (mut at, mut frequency) = (point(p), 1.0);
    let mut signal = folded(at);
    let mut value = signal;
    let mut octave = 1.0;
    while octave < octaves {
        at *= lacunarity;
        frequency *= lacunarity;
        signal = folded(at) * (signal * gain).clamp(0.0, 1.0);
        value += signal * f64::powf(frequency, -h);
        octave += 1.0;
    }
    value
}

/// `lambda, octaves, omega, offset, ridge, generator`: the mean of octaves, each folded at `ridge`, where it is 0, and then
/// stretched so that one end of its range stays and the other moves by `offset`.
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
    let octaves = octaves.min(MOST_OCTAVES);
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

//! Compares the estimated error of a pixel with known errors.

#![allow(
    clippy::cast_possible_truncation,
    reason = "colours are single precision"
)]

use super::estimate::{ChannelRange, estimate, limited_by_half};
use super::sample::AdaptiveSample;
use super::slope::Slopes;
use crate::base::math::sampling::sobol::Sobol;

/// Root mean square of the true and the estimated error with `n` samples of a function, over many pixels. The function
/// receives the number of the pixel and a point in the unit square; its mean is known.
fn errors(n: u32, value: impl Fn(u32, [f64; 2]) -> f64, mean: impl Fn(u32) -> f64) -> (f64, f64) {
    const PIXELS: u32 = 400;
    let side = |v: u32| f64::from(v) / 2f64.powi(32);
    let (mut true_error, mut estimated) = (0.0, 0.0);
    for pixel in 0..PIXELS {
        let sobol = Sobol::of_pixel(pixel.cast_signed(), 3);
        let samples: Vec<AdaptiveSample> = (0..n)
            .map(|number| {
                let (x, y) = sobol.point(number);
                AdaptiveSample::of(sobol, number, value(pixel, [side(x), side(y)]) as f32)
            })
            .collect();
        let estimate_of =
            |samples: &[AdaptiveSample]| estimate(samples, 3, &Slopes::default(), &mut Vec::new());
        let estimate = limited_by_half(
            estimate_of(&samples),
            &estimate_of(&samples[..samples.len() / 2]),
            3,
        );
        true_error += (estimate.mean[0] - mean(pixel)).powi(2);
        estimated += estimate.error.powi(2);
    }
    let root = |sum: f64| (sum / f64::from(PIXELS)).sqrt();
    (root(true_error), root(estimated))
}

#[test]
fn the_error_at_vertical_edges_is_not_underestimated() {
    for n in [16, 64, 256] {
        let at = |pixel: u32| f64::from(pixel % 97) / 97.0;
        let (true_error, estimated) =
            errors(n, |pixel, [x, _]| f64::from(u8::from(x < at(pixel))), at);
        assert!(true_error < estimated, "{n}: {true_error} {estimated}");
    }
}

#[test]
fn the_error_at_slanted_edges_falls_with_the_power_of_three_quarters() {
    // The line x + y / 2 = s cuts off s - 1/4 of the square for s from 1/2 to 1.
    let at = |pixel: u32| 0.5 + f64::from(pixel % 89) / 178.0;
    let of = |n| {
        let value = |pixel, [x, y]: [f64; 2]| f64::from(u8::from(x + y / 2.0 < at(pixel)));
        errors(n, value, |pixel| at(pixel) - 0.25)
    };
    let (coarse, fine) = (of(16), of(1024));
    assert!(fine.0 < coarse.0 * 64f64.powf(-0.74), "{coarse:?} {fine:?}");
    for (true_error, estimated) in [coarse, fine] {
        assert!(
            true_error < estimated && estimated < 4.0 * true_error,
            "{true_error} {estimated}"
        );
    }
}

#[test]
fn the_error_of_slopes_and_of_noise_is_not_underestimated() {
    let (true_error, estimated) = errors(16, |_, [x, y]| x + 0.3 * y, |_| 0.65);
    assert!(true_error < estimated, "slope: {true_error} {estimated}");
    let noise = |pixel: u32, [x, y]: [f64; 2]| {
        let cell = [x * 1e6, y * 1e6, f64::from(pixel)].map(f64::to_bits);
        let mixed = cell.iter().fold(7u64, |all, bits| {
            (all ^ bits)
                .wrapping_mul(0x9e37_79b9_7f4a_7c15)
                .rotate_left(29)
        });
        f64::from((mixed >> 40) as u32) / f64::from(1u32 << 24)
    };
    let (true_error, estimated) = errors(64, noise, |_| 0.5);
    assert!(
        true_error < 1.5 * estimated,
        "noise: {true_error} {estimated}"
    );
}

#[test]
fn values_above_white_have_no_error() {
    let bright = |_, [x, _]: [f64; 2]| if x < 0.5 { 5.0 } else { 9.0 };
    let (_, estimated) = errors(16, bright, |_| 7.0);
    assert!(estimated < 1e-9, "{estimated}");
    let samples: Vec<AdaptiveSample> = [5.0, 9.0]
        .map(|value| AdaptiveSample::of(Sobol::of_pixel(0, 0), 0, value))
        .into();
    assert!(ChannelRange::of(&samples).contrast(3) < 1e-9);
}

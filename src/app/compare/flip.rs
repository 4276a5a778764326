//! The visible difference of two pictures: LDR-FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and
//! Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images"), by the formulas and constants of the paper.
//!
//! Colours are filtered by the contrast sensitivity of the eye and compared in a perceptual space. Edges and points are
//! compared in lightness; where they differ the colour difference counts for more. The filter of the blue-yellow
//! channel is a sum of two Gaussians, each of which is separable.

use super::kinds::shown;
use image::{DynamicImage, RgbImage};

/// The paper's usual distance: a screen 0.7 m wide with 3,840 pixels in a row, seen from 0.7 m.
const PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// The contrast sensitivity of the achromatic, the red-green and the blue-yellow channel as sums of Gaussians: weight
/// and width of each (table 1).
const SENSITIVITY: [&[(f64, f64)]; 3] = [
    &[(1.0, 0.0047)],
    &[(1.0, 0.0053)],
    &[(34.1, 0.04), (13.5, 0.025)],
];
/// The exponent of colour differences, and the knee of their mapping: the share of the largest difference, and its
/// value.
const COLOR_EXPONENT: f64 = 0.7;
const COLOR_KNEE: (f64, f64) = (0.4, 0.95);
/// The width of the edge and point detectors in degrees, and the exponent of their response.
const FEATURE_WIDTH: f64 = 0.082;
const FEATURE_EXPONENT: f64 = 0.5;

/// D65.
const WHITE: [f64; 3] = [0.950_428_545, 1.0, 1.088_900_371];
const XYZ_FROM_RGB: [[f64; 3]; 3] = [
    [0.412_386_563, 0.357_591_491, 0.180_450_491],
    [0.212_636_822, 0.715_182_982, 0.072_180_196],
    [0.019_330_620, 0.119_197_164, 0.950_372_587],
];
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.241_003_275, -1.537_398_934, -0.498_615_861],
    [-0.969_224_334, 1.875_930_071, 0.041_554_224],
    [0.055_639_423, -0.204_011_202, 1.057_148_933],
];

/// The mean FLIP error of two pictures of one size: 0 for pictures that look the same, 1 for black against white. Alpha
/// is ignored, and linear light is clipped at white.
#[must_use]
pub fn flip(expected: &DynamicImage, actual: &DynamicImage) -> f64 {
    let [expected, actual] = [expected, actual].map(|picture| shown(picture).to_rgb8());
    if expected.dimensions() != actual.dimensions() || expected.is_empty() {
        return 0.0;
    }
    let (expected, actual) = (opponents(&expected), opponents(&actual));
    let (features, others) = (Features::of(&expected[0]), Features::of(&actual[0]));
    let (expected, actual) = (seen(expected), seen(actual));
    let most = largest_difference();
    let pixels = expected[0].values.len();
    let sum: f64 = (0..pixels)
        .map(|at| {
            let color = color_difference(&expected, &actual, at, most);
            color.powf(1.0 - features.difference(&others, at))
        })
        .sum();
    #[allow(clippy::cast_precision_loss, reason = "no picture has 2^52 pixels")]
    let pixels = pixels as f64;
    sum / pixels
}

/// One value for each pixel, row by row.
struct Plane {
    width: usize,
    values: Vec<f32>,
}

impl Plane {
    /// The plane filtered along rows and along columns; pixels beyond an edge repeat the edge.
    fn filtered(&self, along_rows: &[f64], along_columns: &[f64]) -> Plane {
        let (width, height) = (self.width, self.values.len() / self.width);
        let rows = self.values.chunks_exact(width);
        let rows =
            rows.flat_map(|row| (0..width).map(|x| sum(along_rows, x, |x| row[x.min(width - 1)])));
        let rows: Vec<f32> = rows.collect();
        let value =
            |x: usize, y: usize| sum(along_columns, y, |y| rows[y.min(height - 1) * width + x]);
        Plane {
            width,
            values: (0..height)
                .flat_map(|y| (0..width).map(move |x| (x, y)))
                .map(|(x, y)| value(x, y))
                .collect(),
        }
    }

    fn at(&self, pixel: usize) -> f64 {
        f64::from(self.values[pixel])
    }
}

/// The weighted sum of values around an index; the middle weight belongs to the index itself.
fn sum(weights: &[f64], index: usize, value: impl Fn(usize) -> f32) -> f32 {
    let radius = weights.len() / 2;
    let weighted = weights.iter().enumerate();
    let sum: f64 = weighted
        .map(|(at, weight)| weight * f64::from(value((index + at).saturating_sub(radius))))
        .sum();
    single(sum)
}

#[allow(clippy::cast_possible_truncation, reason = "seven digits are enough")]
fn single(value: f64) -> f32 {
    value as f32
}

fn times(matrix: &[[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * x + row[1] * y + row[2] * z)
}

/// The opponent channels YyCxCz of a picture.
fn opponents(picture: &RgbImage) -> [Plane; 3] {
    let linear: Vec<f64> = (0..=255_u8)
        .map(|level| match f64::from(level) / 255.0 {
            v if v <= 0.04045 => v / 12.92,
            v => ((v + 0.055) / 1.055).powf(2.4),
        })
        .collect();
    let mut planes = [const { Vec::new() }; 3];
    for pixel in picture.pixels() {
        let rgb = pixel.0.map(|level| linear[usize::from(level)]);
        let xyz = times(&XYZ_FROM_RGB, rgb);
        let [x, y, z] = [0, 1, 2].map(|axis| xyz[axis] / WHITE[axis]);
        let channels = [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)];
        for (plane, channel) in planes.iter_mut().zip(channels) {
            plane.push(single(channel));
        }
    }
    let width = picture.width() as usize;
    planes.map(|values| Plane { width, values })
}

/// The channels after the filter of the eye, in Hunt-adjusted L*a*b*.
fn seen(channels: [Plane; 3]) -> [Plane; 3] {
    let mut filtered =
        [0, 1, 2].map(|channel| sensitively(&channels[channel], SENSITIVITY[channel]));
    drop(channels);
    for at in 0..filtered[0].values.len() {
        let [y, cx, cz] = [0, 1, 2].map(|channel| filtered[channel].at(at));
        let y = (y + 16.0) / 116.0;
        let xyz = [y + cx / 500.0, y, y - cz / 200.0];
        let xyz = [0, 1, 2].map(|axis| xyz[axis] * WHITE[axis]);
        let rgb = times(&RGB_FROM_XYZ, xyz).map(|v| v.clamp(0.0, 1.0));
        for (plane, value) in filtered.iter_mut().zip(hunt(rgb)) {
            plane.values[at] = single(value);
        }
    }
    filtered
}

/// A channel filtered by a sum of Gaussians with a total weight of 1.
fn sensitively(plane: &Plane, gaussians: &[(f64, f64)]) -> Plane {
    let pi = std::f64::consts::PI;
    let widest = SENSITIVITY.iter().flat_map(|all| all.iter());
    let widest = widest.map(|&(_, b)| b).fold(0.0, f64::max);
    let radius = (3.0 * (widest / (2.0 * pi * pi)).sqrt() * PIXELS_PER_DEGREE).ceil();
    let kernels: Vec<Vec<f64>> = gaussians
        .iter()
        .map(|&(a, b)| {
            // The square root, because the separable filter is applied twice.
            let height = (a * (pi / b).sqrt()).sqrt();
            taps(radius, |x| {
                let degrees = x / PIXELS_PER_DEGREE;
                height * (-pi * pi * degrees * degrees / b).exp()
            })
        })
        .collect();
    let total: f64 = kernels
        .iter()
        .map(|kernel| kernel.iter().sum::<f64>().powi(2))
        .sum();
    let parts = kernels.into_iter().map(|kernel| {
        let kernel: Vec<f64> = kernel.iter().map(|weight| weight / total.sqrt()).collect();
        plane.filtered(&kernel, &kernel)
    });
    let sum = parts.reduce(|mut sum, part| {
        for (sum, part) in sum.values.iter_mut().zip(&part.values) {
            *sum += part;
        }
        sum
    });
    sum.expect("every channel has a Gaussian")
}

/// A function sampled at integers from `-radius` to `radius`.
fn taps(radius: f64, function: impl Fn(f64) -> f64) -> Vec<f64> {
    let positions = std::iter::successors(Some(-radius), |x| Some(x + 1.0));
    positions
        .take_while(|&x| x <= radius)
        .map(function)
        .collect()
}

/// L*a*b* of linear light; a* and b* are reduced for dark colours (Hunt).
fn hunt(rgb: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let xyz = times(&XYZ_FROM_RGB, rgb);
    let [x, y, z] = [0, 1, 2].map(|axis| match xyz[axis] / WHITE[axis] {
        v if v > DELTA * DELTA * DELTA => v.cbrt(),
        v => v / (3.0 * DELTA * DELTA) + 4.0 / 29.0,
    });
    let lightness = 116.0 * y - 16.0;
    let chroma = 0.01 * lightness;
    [
        lightness,
        chroma * 500.0 * (x - y),
        chroma * 200.0 * (y - z),
    ]
}

/// The HyAB distance of two colours, raised to the exponent of colours.
fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    let [l, a, b] = [0, 1, 2].map(|axis| one[axis] - other[axis]);
    (l.abs() + a.hypot(b)).powf(COLOR_EXPONENT)
}

/// The distance of green and blue, which no two colours exceed.
fn largest_difference() -> f64 {
    distance(hunt([0.0, 1.0, 0.0]), hunt([0.0, 0.0, 1.0]))
}

/// The colour difference of a pixel, from 0 to 1.
fn color_difference(expected: &[Plane; 3], actual: &[Plane; 3], at: usize, most: f64) -> f64 {
    let color = |planes: &[Plane; 3]| [0, 1, 2].map(|channel| planes[channel].at(at));
    let difference = distance(color(expected), color(actual));
    let (share, height) = COLOR_KNEE;
    let knee = share * most;
    if difference < knee {
        difference * height / knee
    } else {
        height + (difference - knee) / (most - knee) * (1.0 - height)
    }
}

/// Edges and points of a picture: first and second derivatives of its smoothed lightness, along rows and columns.
struct Features {
    edges: [Plane; 2],
    points: [Plane; 2],
}

impl Features {
    fn of(achromatic: &Plane) -> Features {
        let lightness = Plane {
            width: achromatic.width,
            values: achromatic
                .values
                .iter()
                .map(|y| (y + 16.0) / 116.0)
                .collect(),
        };
        let deviation = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
        let radius = (3.0 * deviation).ceil();
        let square = |x: f64| x * x / (deviation * deviation);
        let bell = |x: f64| (-0.5 * square(x)).exp();
        let smooth = balanced(taps(radius, bell));
        let first = balanced(taps(radius, |x| -x * bell(x)));
        let second = balanced(taps(radius, |x| (square(x) - 1.0) * bell(x)));
        let both = |kernel: &[f64]| {
            [
                lightness.filtered(kernel, &smooth),
                lightness.filtered(&smooth, kernel),
            ]
        };
        Features {
            edges: both(&first),
            points: both(&second),
        }
    }

    /// The feature difference of a pixel, edges or points, whichever is larger, from 0 to 1.
    fn difference(&self, other: &Features, at: usize) -> f64 {
        let strength = |planes: &[Plane; 2]| planes[0].at(at).hypot(planes[1].at(at));
        let edges = (strength(&self.edges) - strength(&other.edges)).abs();
        let points = (strength(&self.points) - strength(&other.points)).abs();
        (edges.max(points) / std::f64::consts::SQRT_2).powf(FEATURE_EXPONENT)
    }
}

/// Scales positive weights to a sum of 1, and negative ones to a sum of -1.
fn balanced(weights: Vec<f64>) -> Vec<f64> {
    let positive: f64 = weights.iter().filter(|&&weight| weight > 0.0).sum();
    let negative: f64 = weights.iter().filter(|&&weight| weight < 0.0).sum();
    let balance = |weight: f64| match weight > 0.0 {
        true => weight / positive,
        false if negative < 0.0 => -weight / negative,
        false => weight,
    };
    weights.into_iter().map(balance).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    fn paint(width: u32, height: u32, color: impl Fn(u32, u32) -> [u8; 3]) -> DynamicImage {
        RgbImage::from_fn(width, height, |x, y| Rgb(color(x, y))).into()
    }

    fn noise(x: u32, y: u32, channel: u32) -> u8 {
        let mut value = x.wrapping_mul(73_856_093)
            ^ y.wrapping_mul(19_349_663)
            ^ channel.wrapping_mul(83_492_791);
        value ^= value >> 13;
        value = value.wrapping_mul(0x5bd1_e995);
        value ^= value >> 15;
        value.to_le_bytes()[1]
    }

    /// Means by the authors' program, as in the crate `nv-flip` 0.1.2.
    #[test]
    fn means_are_those_of_the_authors() {
        let level = |value: u32| value.to_le_bytes()[0];
        let flat = |color| paint(40, 30, move |_, _| color);
        let slope = |more: u8| {
            paint(64, 48, move |x, y| {
                let blue = level(2 * (x + y)).saturating_add(more);
                [level(4 * x), level(5 * y), blue]
            })
        };
        let speckled = || paint(64, 48, |x, y| [0, 1, 2].map(|channel| noise(x, y, channel)));
        let step = |at: u32| {
            paint(64, 48, move |x, y| match x > at && y > 10 {
                true => [250, 240, 20],
                false => [20, 30, 200],
            })
        };
        let dots = paint(64, 48, |x, y| match x % 9 == 4 && y % 7 == 3 {
            true => [255; 3],
            false => [60; 3],
        });
        let small = |channel| paint(3, 2, move |x, y| [noise(x, y, channel); 3]);
        for (name, expected, actual, mean) in [
            ("black, white", flat([0; 3]), flat([255; 3]), 0.967_397_0),
            ("green, blue", flat([0, 255, 0]), flat([0, 0, 255]), 1.0),
            ("slope, shifted", slope(0), slope(9), 0.123_550_9),
            ("slope, speckled", slope(0), speckled(), 0.782_724_2),
            ("speckled, step", speckled(), step(20), 0.960_837_4),
            ("step, moved", step(20), step(21), 0.071_433_4),
            (
                "dots, none",
                dots,
                paint(64, 48, |_, _| [60; 3]),
                0.127_878_1,
            ),
            ("small", small(0), small(5), 0.567_362_9),
            (
                "one pixel",
                paint(1, 1, |_, _| [10, 20, 30]),
                paint(1, 1, |_, _| [90, 20, 30]),
                0.467_968_2,
            ),
        ] {
            let result = flip(&expected, &actual);
            assert!(
                (result - mean).abs() < 1e-4,
                "{name}: {result} is not {mean}"
            );
            assert!(flip(&expected, &expected).abs() < 1e-9, "{name}");
        }
    }

    #[test]
    fn pictures_without_pixels_look_the_same() {
        let none = DynamicImage::from(RgbImage::new(0, 0));
        assert!(flip(&none, &none).abs() < 1e-9);
    }
}

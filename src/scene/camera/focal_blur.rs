//! Focal blur (depth of field): rays from points on a lens through a common point of the plane in focus.
//!
//! Samples are taken in batches until their variance is small enough or `blur_samples` is reached. All random numbers
//! are POV-Ray's, drawn from tables by pixel position (measured: images agree to the last bit).

use super::lens_points::LensPoints;
use super::{Camera, Frame, Screen, ray};
use crate::base::args::{Args, Parse, Word};
use crate::base::color::Rgb;
use crate::base::math::sampling::chi_square::chi_square;
use crate::base::math::sampling::hash::hashed;
use crate::base::math::{Ray, jitter};
use crate::base::source::Diagnostic;
use crate::scene::pattern::{Settings, SurfacePoint};
use crate::scene::texture::{Pigment, PreparedPigment};
use glam::DVec3;
use std::sync::Arc;

/// Largest accepted number of samples.
const MAX_SAMPLES: f64 = 65536.0;
/// Defaults, also used in place of values out of range.
const CONFIDENCE: f64 = 0.9;
const VARIANCE: f64 = 1e-4;
/// Cells of the grid of sample positions in a pixel, along each side.
const GRID_SIZE: i32 = 16;

/// Focal blur parameters of a camera.
#[derive(Clone, Debug)]
pub struct FocalBlur {
    /// The diameter of the lens; 0 for none.
    aperture: f64,
    /// The minimum and the maximum number of samples; a maximum of 0 means no blur.
    samples: [usize; 2],
    confidence: f64,
    variance: f64,
    focal_point: Option<DVec3>,
    /// The distance in focus.
    distance: f64,
    /// Brightness of each point of the lens.
    bokeh: Option<Arc<Pigment>>,
}

impl Default for FocalBlur {
    fn default() -> Self {
        FocalBlur {
            aperture: 0.0,
            samples: [0, 0],
            confidence: CONFIDENCE,
            variance: VARIANCE,
            focal_point: None,
            distance: 1.0,
            bokeh: None,
        }
    }
}

impl FocalBlur {
    /// Reads the parameter `word` and its value. False, with nothing read, if it is not a parameter of focal blur.
    ///
    /// # Errors
    /// A malformed value, or an invalid number of samples.
    pub(super) fn read_item(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let at = args.span();
        match word {
            Word::Aperture => {
                args.accept(word)?;
                self.aperture = args.float()?;
            }
            Word::FocalPoint => {
                args.accept(word)?;
                self.focal_point = Some(args.vector()?);
            }
            Word::BlurSamples => {
                args.accept(word)?;
                self.samples = samples(args)?;
            }
            Word::Confidence => {
                args.accept(word)?;
                self.confidence = checked(word, args.float()?, 0.0..1.0, CONFIDENCE, args);
            }
            Word::Variance => {
                args.accept(word)?;
                self.variance = checked(word, args.float()?, 0.0..=1.0, VARIANCE, args);
            }
            Word::Bokeh => {
                args.accept(word)?;
                args.open()?;
                if !args.accept(Word::Pigment)? {
                    return Err(args.expected("`pigment` in `bokeh`"));
                }
                let pigment = Pigment::read(args, &Pigment::default())?;
                self.bokeh = Some(Arc::new(pigment));
                args.close()?;
            }
            _ => return Ok(false),
        }
        if self.samples[0] > self.samples[1] {
            let message = "`blur_samples` has its least number of samples first";
            return Err(Box::new(Diagnostic::error(
                at.to(args.last_span()),
                message,
            )));
        }
        Ok(true)
    }

    /// True if the lens blurs the image.
    pub(super) fn is_active(&self) -> bool {
        self.aperture != 0.0 && self.samples[1] != 0
    }

    /// The parameters as a line of a statement, empty without a blur; `None` with a bokeh, which is a pigment.
    pub(super) fn text(&self) -> Option<String> {
        if !self.is_active() {
            return Some(String::new());
        }
        let FocalBlur {
            aperture,
            samples: [least, most],
            confidence,
            variance,
            focal_point,
            bokeh: None,
            ..
        } = self
        else {
            return None;
        };
        let least = match least {
            0 => String::new(),
            least => format!("{least}, "),
        };
        let point = focal_point.map(|DVec3 { x, y, z }| format!(" focal_point <{x}, {y}, {z}>"));
        Some(format!(
            "  aperture {aperture} blur_samples {least}{most} confidence {confidence} variance {variance}{}\n",
            point.unwrap_or_default()
        ))
    }

    /// Multiplies all lengths by a factor.
    pub(super) fn scale(&mut self, factor: f64) {
        self.aperture *= factor;
        self.distance *= factor;
        if let Some(point) = &mut self.focal_point {
            *point *= factor;
        }
    }

    /// Sets the distance in focus to the length of the camera's direction, as `look_at` does (measured). A focal point
    /// takes precedence in [`FocalBlur::update_distance`].
    pub(super) fn reset_distance(&mut self, frame: &Frame) {
        self.distance = frame.direction.length();
    }

    /// Computes the distance in focus from the focal point, once the camera frame is known.
    pub(super) fn update_distance(&mut self, frame: &Frame) {
        if let Some(point) = self.focal_point {
            self.distance = (point - frame.location).length();
        }
        if self.distance == 0.0 {
            self.distance = 1.0;
        }
    }
}

/// Reads `blur_samples MAX` or `blur_samples MIN, MAX` after its keyword: minimum and maximum.
fn samples(args: &mut dyn Args) -> Parse<[usize; 2]> {
    let first = sample_count(args)?;
    if args.has_next_value()? {
        return Ok([first, sample_count(args)?]);
    }
    Ok([0, first])
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is checked"
)]
fn sample_count(args: &mut dyn Args) -> Parse<usize> {
    let at = args.span();
    let count = args.float()?.trunc();
    if (1.0..=MAX_SAMPLES).contains(&count) {
        return Ok(count as usize);
    }
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("`blur_samples` runs from 1 to {MAX_SAMPLES}, not {count}"),
    )))
}

/// The value if it is within bounds, otherwise the default, with a warning.
fn checked(
    word: Word,
    value: f64,
    bounds: impl std::ops::RangeBounds<f64>,
    default: f64,
    args: &mut dyn Args,
) -> f64 {
    if bounds.contains(&value) {
        return value;
    }
    args.warn(Diagnostic::warning(
        args.last_span(),
        format!("`{word}` must lie between 0 and 1; {default} is taken"),
    ));
    default
}

/// Bokeh pigments are compared by identity.
impl PartialEq for FocalBlur {
    fn eq(&self, other: &Self) -> bool {
        let same_bokeh = match (&self.bokeh, &other.bokeh) {
            (None, None) => true,
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            _ => false,
        };
        same_bokeh
            && (self.aperture, self.samples) == (other.aperture, other.samples)
            && (self.confidence, self.variance) == (other.confidence, other.variance)
            && (self.focal_point, self.distance) == (other.focal_point, other.distance)
    }
}

/// A lens prepared for sampling.
#[derive(Debug)]
pub struct Lens {
    points: LensPoints,
    /// Per batch, the variance of the mean below which sampling stops.
    max_variances: Vec<f64>,
    min_samples: usize,
    aperture: f64,
    /// Horizontal unit vector in the plane of the lens; `upwards` is the vertical one.
    across: DVec3,
    upwards: DVec3,
    /// The distance in focus, in lengths of the camera's direction.
    focus: f64,
    /// The row of the jitter of a sample, relative to its own: -0.5 before version 3.8, 0.5 from there on (measured).
    jitter_row: f64,
    /// True if the lens is centred at the camera's location, even of orthographic cameras, as in POV-Ray 3.7; in 3.8 it is
    /// centred at the start of the sharp ray.
    is_at_location: bool,
}

/// A lens sample of an image point.
#[derive(Clone, Copy, Debug)]
pub struct LensRay {
    /// Index of the lens sample.
    pub sample: usize,
    /// Column of the image point; integers are pixel centres.
    pub x: f64,
    /// Row of the image point, counted downwards.
    pub y: f64,
}

/// Running sums over the samples of a pixel, for their variance.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spread {
    sum: [f64; 4],
    squares: [f64; 4],
}

impl Lens {
    /// The lens of a camera; `settings` are the scene-wide settings of patterns. `None` without focal blur.
    #[must_use]
    pub fn new(camera: &Camera, settings: &Settings) -> Option<Lens> {
        let blur = &camera.blur;
        let count = blur.samples[1];
        if !blur.is_active() {
            return None;
        }
        let points = match &blur.bokeh {
            None => LensPoints::uniform(count),
            Some(pigment) => {
                let pigment = PreparedPigment::new(pigment, &[], settings);
                let brightness = |at: glam::DVec2| {
                    let color = pigment.color(&SurfacePoint::at(at.extend(0.0)));
                    f64::from(color.rgb.grey())
                };
                LensPoints::weighted(count, brightness)
            }
        };
        let at_max = chi_square(degrees_of_freedom(count - 1), blur.confidence);
        let max_variances = points
            .batch_ends
            .iter()
            .map(|&end| {
                blur.variance * chi_square(degrees_of_freedom(end), blur.confidence) / at_max
            })
            .collect();
        let frame = &camera.frame;
        let across = frame.up.cross(frame.direction).normalize_or_zero();
        Some(Lens {
            points,
            max_variances,
            min_samples: blur.samples[0],
            aperture: blur.aperture,
            across,
            upwards: frame.direction.cross(across).normalize_or_zero(),
            focus: blur.distance / frame.direction.length(),
            jitter_row: if settings.is_3_8 { 0.5 } else { -0.5 },
            is_at_location: !settings.is_3_8,
        })
    }

    /// Sample counts after which to test convergence, in rising order; the last is the total.
    #[must_use]
    pub fn batch_ends(&self) -> &[usize] {
        &self.points.batch_ends
    }

    /// True if the samples up to the end of this batch suffice.
    #[must_use]
    pub fn is_enough(&self, batch: usize, spread: &Spread) -> bool {
        let count = self.points.batch_ends[batch];
        count >= self.min_samples && spread.is_below(self.max_variances[batch], as_float(count))
    }

    /// The ray of a lens sample.
    #[must_use]
    pub fn ray(&self, camera: &Camera, sample: &LensRay, width: u32, height: u32) -> Option<Ray> {
        let LensRay { sample, x, y } = *sample;
        let (dx, dy) = position_in_pixel(x, y, sample);
        let (start, dir) = camera.start(x + dx, y + dy, width, height)?;
        let centre = match self.is_at_location {
            true => camera.location(),
            false => start,
        };
        let (jx, jy) = jitter(x + dx + 0.5, y + dy + self.jitter_row);
        let point = self.points.points[sample];
        let spread = 2.0 * self.points.spread;
        let half = 0.5 * self.aperture;
        let deflection = half * (point.x + spread * jx) * self.across
            - half * (point.y + spread * jy) * self.upwards;
        let dir = dir * self.focus - deflection;
        let ray = ray(centre + deflection, dir, camera.normalization)?;
        Some(match &camera.bumps {
            None => ray,
            Some(bumps) => {
                let screen = Screen::new(x + dx, y + dy, [width, height], camera.normalization);
                bumps.bend(camera.bump_point(screen), ray)
            }
        })
    }
}

impl Spread {
    /// Adds a sample.
    pub fn add(&mut self, rgb: Rgb, transmit: f32) {
        for (i, value) in [rgb.r, rgb.g, rgb.b, transmit].into_iter().enumerate() {
            let value = f64::from(value);
            self.sum[i] += value;
            self.squares[i] += value * value;
        }
    }

    /// True if the variance of the mean is below `limit` in every channel.
    fn is_below(&self, limit: f64, count: f64) -> bool {
        self.sum.iter().zip(&self.squares).all(|(sum, square)| {
            let mean = sum / count;
            (square / count - mean * mean) / count < limit
        })
    }
}

/// Position of a sample in its pixel, relative to the centre.
#[allow(
    clippy::cast_possible_truncation,
    reason = "pictures have fewer than 2^20 columns and rows, and samples are few"
)]
fn position_in_pixel(x: f64, y: f64, sample: usize) -> (f64, f64) {
    let seed = (313.0 * x + 11.0) as i32 + (311.0 * y + 17.0) as i32;
    let sample = sample as i32;
    let offset = |number: i32| f64::from(2 * (hashed(number) % GRID_SIZE) + 1) / 32.0 - 0.5;
    let (dx, dy) = (offset(seed + sample), offset(seed + sample + 1));
    let (jx, jy) = jitter(dx, dy);
    (
        dx + (jx - 0.5) / f64::from(GRID_SIZE),
        dy + (jy - 0.5) / f64::from(GRID_SIZE),
    )
}

fn degrees_of_freedom(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[allow(clippy::cast_precision_loss, reason = "samples are few")]
fn as_float(count: usize) -> f64 {
    count as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    #[test]
    fn equal_samples_are_enough() {
        let mut spread = Spread::default();
        for _ in 0..7 {
            spread.add(Rgb::splat(0.5), 0.0);
        }
        assert!(spread.is_below(1e-4, 7.0));
        spread.add(Rgb::WHITE, 0.0);
        assert!(!spread.is_below(1e-4, 8.0));
    }

    fn read(text: &str) -> Parse<FocalBlur> {
        let mut args = TextArgs::new(text);
        let mut blur = FocalBlur::default();
        while let Some(word) = args.word()? {
            assert!(blur.read_item(word, &mut args)?);
        }
        Ok(blur)
    }

    #[test]
    fn one_number_of_samples_is_the_maximum() {
        assert_eq!(read("blur_samples 5").unwrap().samples, [0, 5]);
        assert_eq!(read("blur_samples 5, 8").unwrap().samples, [5, 8]);
        let error = read("blur_samples 8, 5").expect_err("the wrong way round");
        assert_eq!(
            error.message,
            "`blur_samples` has its least number of samples first"
        );
        let error = read("blur_samples 0").expect_err("no samples");
        assert_eq!(error.message, "`blur_samples` runs from 1 to 65536, not 0");
    }

    #[test]
    fn values_out_of_range_are_replaced() {
        let blur = read("confidence 1 variance 2").unwrap();
        assert_eq!((blur.confidence, blur.variance), (CONFIDENCE, VARIANCE));
    }
}

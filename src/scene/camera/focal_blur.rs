//! Focal blur: rays from all over a lens, all through the same point of the plane in focus.
//!
//! Samples come in batches until their spread is small enough, or there are as many as the scene allows. All random
//! numbers are those of POV-Ray, drawn from tables by the place of the pixel (measured; the fact is that pictures
//! agree to the last bit).

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

/// More samples than any picture is worth.
const MOST_SAMPLES: f64 = 65536.0;
/// What is taken for values that make no sense, and where the scene says nothing.
const CONFIDENCE: f64 = 0.9;
const VARIANCE: f64 = 1e-4;
/// The places of a sample in its pixel, along each side.
const PLACES: i32 = 16;

/// What a scene says of the lens of a camera.
#[derive(Clone, Debug)]
pub struct FocalBlur {
    /// The diameter of the lens; 0 for none.
    aperture: f64,
    /// The least and the most samples; no blur with 0.
    samples: [usize; 2],
    confidence: f64,
    variance: f64,
    focal_point: Option<DVec3>,
    /// The distance in focus.
    distance: f64,
    /// The light that each part of the lens lets through.
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
    /// Takes `word` and its value if it is one of this element, and says whether it was.
    ///
    /// # Errors
    /// A malformed value, or a number of samples that is none.
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
                self.confidence = share(word, args.float()?, 0.0..1.0, CONFIDENCE, args);
            }
            Word::Variance => {
                args.accept(word)?;
                self.variance = share(word, args.float()?, 0.0..=1.0, VARIANCE, args);
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

    /// Whether the lens blurs anything.
    pub(super) fn exists(&self) -> bool {
        self.aperture != 0.0 && self.samples[1] != 0
    }

    /// Makes its lengths larger by a factor.
    pub(super) fn scale(&mut self, factor: f64) {
        self.aperture *= factor;
        self.distance *= factor;
        if let Some(point) = &mut self.focal_point {
            *point *= factor;
        }
    }

    /// Without a focal point, `look_at` brings the length of the camera's direction into focus (measured).
    pub(super) fn look(&mut self, frame: &Frame) {
        self.distance = frame.direction.length();
    }

    /// Finds the distance in focus, once the vectors of a camera are known.
    pub(super) fn focus(&mut self, frame: &Frame) {
        if let Some(point) = self.focal_point {
            self.distance = (point - frame.location).length();
        }
        if self.distance == 0.0 {
            self.distance = 1.0;
        }
    }
}

/// `blur_samples MOST` or `blur_samples LEAST, MOST`.
fn samples(args: &mut dyn Args) -> Parse<[usize; 2]> {
    let first = sample_count(args)?;
    if args.comma()? || args.at_expression()? {
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
    if (1.0..=MOST_SAMPLES).contains(&count) {
        return Ok(count as usize);
    }
    Err(Box::new(Diagnostic::error(
        at.to(args.last_span()),
        format!("`blur_samples` runs from 1 to {MOST_SAMPLES}, not {count}"),
    )))
}

/// A value within bounds, or the usual one with a warning.
fn share(
    word: Word,
    value: f64,
    bounds: impl std::ops::RangeBounds<f64>,
    usual: f64,
    args: &mut dyn Args,
) -> f64 {
    if bounds.contains(&value) {
        return value;
    }
    args.warn(Diagnostic::warning(
        args.last_span(),
        format!("`{word}` must lie between 0 and 1; {usual} is taken"),
    ));
    usual
}

/// Pigments are equal only to themselves.
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

/// A lens ready for rays.
#[derive(Debug)]
pub struct Lens {
    points: LensPoints,
    /// For each of the stops of the points, the variance below which the samples are enough.
    enough: Vec<f64>,
    least: usize,
    aperture: f64,
    /// The unit vectors across the lens.
    across: DVec3,
    upwards: DVec3,
    /// The distance in focus in units of the length of the camera's direction.
    focus: f64,
}

/// One ray of a lens: which sample, and of which point of the picture.
#[derive(Clone, Copy, Debug)]
pub struct LensRay {
    /// The number of the sample.
    pub sample: usize,
    /// The point, to the right; whole numbers are centres of pixels.
    pub x: f64,
    /// The point, downwards.
    pub y: f64,
}

/// The sums over the samples of a pixel, by which their variance is known.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spread {
    sum: [f64; 4],
    squares: [f64; 4],
}

impl Lens {
    /// The lens of a camera that has one; `settings` are what patterns take from the whole scene.
    #[must_use]
    pub fn new(camera: &Camera, settings: &Settings) -> Option<Lens> {
        let blur = &camera.blur;
        let count = blur.samples[1];
        if !blur.exists() {
            return None;
        }
        let points = match &blur.bokeh {
            None => LensPoints::even(count),
            Some(pigment) => {
                let pigment = PreparedPigment::new(pigment, &[], settings);
                let brightness = |at: glam::DVec2| {
                    let color = pigment.color(&SurfacePoint::at(at.extend(0.0)));
                    f64::from(color.rgb.grey())
                };
                LensPoints::shaped(count, brightness)
            }
        };
        let all = chi_square(degrees(count - 1), blur.confidence);
        let enough = points
            .stops
            .iter()
            .map(|&stop| blur.variance * chi_square(degrees(stop), blur.confidence) / all)
            .collect();
        let frame = &camera.frame;
        let across = frame.up.cross(frame.direction).normalize_or_zero();
        Some(Lens {
            points,
            enough,
            least: blur.samples[0],
            aperture: blur.aperture,
            across,
            upwards: frame.direction.cross(across).normalize_or_zero(),
            focus: blur.distance / frame.direction.length(),
        })
    }

    /// The numbers of samples after which to ask whether they are enough; the last is all of them.
    #[must_use]
    pub fn stops(&self) -> &[usize] {
        &self.points.stops
    }

    /// Whether the samples up to the stop of this index are enough.
    #[must_use]
    pub fn is_enough(&self, stop: usize, spread: &Spread) -> bool {
        let count = self.points.stops[stop];
        count >= self.least && spread.is_below(self.enough[stop], as_float(count))
    }

    /// The ray of one sample.
    #[must_use]
    pub fn ray(&self, camera: &Camera, sample: &LensRay, width: u32, height: u32) -> Option<Ray> {
        let LensRay { sample, x, y } = *sample;
        let (dx, dy) = place_in_pixel(x, y, sample);
        // POV-Ray lets all rays of a lens start at the camera, also those of orthographic views.
        let (_, dir) = camera.start(x + dx, y + dy, width, height)?;
        let (jx, jy) = jitter(x + dx + 0.5, y + dy - 0.5);
        let point = self.points.points[sample];
        let spread = 2.0 * self.points.spread;
        let half = 0.5 * self.aperture;
        let deflection = half * (point.x + spread * jx) * self.across
            - half * (point.y + spread * jy) * self.upwards;
        let ray = ray(
            camera.location() + deflection,
            dir * self.focus - deflection,
        )?;
        Some(match &camera.bumps {
            None => ray,
            Some(bumps) => {
                let screen = Screen::new(x + dx, y + dy, width, height);
                bumps.bent(camera.measure(screen), ray)
            }
        })
    }
}

impl Spread {
    /// Takes in a sample.
    pub fn add(&mut self, rgb: Rgb, transmit: f32) {
        for (i, value) in [rgb.r, rgb.g, rgb.b, transmit].into_iter().enumerate() {
            let value = f64::from(value);
            self.sum[i] += value;
            self.squares[i] += value * value;
        }
    }

    fn is_below(&self, most: f64, count: f64) -> bool {
        self.sum.iter().zip(&self.squares).all(|(sum, square)| {
            let mean = sum / count;
            (square / count - mean * mean) / count < most
        })
    }
}

/// Where in its pixel a sample lies, relative to the centre.
#[allow(
    clippy::cast_possible_truncation,
    reason = "pictures have fewer than 2^20 columns and rows, and samples are few"
)]
fn place_in_pixel(x: f64, y: f64, sample: usize) -> (f64, f64) {
    let seed = (313.0 * x + 11.0) as i32 + (311.0 * y + 17.0) as i32;
    let sample = sample as i32;
    let place = |number: i32| f64::from(2 * (hashed(number) % PLACES) + 1) / 32.0 - 0.5;
    let (dx, dy) = (place(seed + sample), place(seed + sample + 1));
    let (jx, jy) = jitter(dx, dy);
    (
        dx + (jx - 0.5) / f64::from(PLACES),
        dy + (jy - 0.5) / f64::from(PLACES),
    )
}

fn degrees(count: usize) -> u32 {
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
    fn one_number_of_samples_is_the_most() {
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
    fn values_without_sense_are_replaced() {
        let blur = read("confidence 1 variance 2").unwrap();
        assert_eq!((blur.confidence, blur.variance), (CONFIDENCE, VARIANCE));
    }
}

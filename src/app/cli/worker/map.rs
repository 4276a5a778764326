//! Maps of a live scene: the cost of each pixel, and its estimated error.

use super::live::LiveScene;
use crate::CompiledScene;
use crate::app::worker::{MapKind, MapReport};
use crate::base::film::Film;
use crate::base::options::{Adaptive, Failure, RenderOptions, Sampling};
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use plotters::style::colors::colormaps::{ColorMap, ViridisRGB};

/// The part of the pixels that have a colour of their own: those above have the brightest one.
const SCALED: f64 = 0.999;
/// Steps of a channel from black to white.
const LEVELS: f64 = 255.0;
/// Ratio of the estimated errors of a picture that is sampled adaptively and of the one that it is compared with.
const FINER: f64 = 4.0;

impl LiveScene<'_> {
    /// A map as a PNG file, with its scale. `known` is the whole picture, if it has been drawn.
    ///
    /// # Errors
    /// When the work is cancelled, or has not enough memory.
    pub(super) fn map(
        &self,
        scene: &CompiledScene,
        kind: MapKind,
        known: Option<&Film>,
    ) -> Result<(Vec<u8>, MapReport), Failure> {
        let values = match kind {
            MapKind::Rays | MapKind::Time => {
                let costs = scene.costs(self.render, self.session);
                let value = |cost: crate::render::cost::PixelCost| match kind {
                    #[allow(clippy::cast_precision_loss, reason = "few rays of a pixel")]
                    MapKind::Rays => cost.rays as f64,
                    _ => 1e6 * cost.time.as_secs_f64(),
                };
                costs.into_iter().map(value).collect()
            }
            MapKind::Error => self.errors(scene, known)?,
        };
        if self.render.stop.is_cancelled() {
            return Err(Failure { errors: Vec::new() });
        }
        Ok(drawn(&values, (self.render.width, self.render.height)))
    }

    /// The difference of each pixel from one that is sampled until its estimated error is small, in steps of 1/255 of the
    /// working space.
    fn errors(&self, scene: &CompiledScene, known: Option<&Film>) -> Result<Vec<f64>, Failure> {
        let whole;
        let film = match known {
            Some(film) => film,
            None => {
                whole = scene.draw(self.read, self.render, &|_| {}, self.session)?;
                &whole.film
            }
        };
        let error = match self.render.sampling {
            Sampling::Adaptive(Adaptive { error, .. }) => error / FINER,
            Sampling::Centres | Sampling::PovRay(_) => 1.0,
        };
        let render = RenderOptions {
            sampling: Sampling::Adaptive(Adaptive { error, time: None }),
            ..self.render.clone()
        };
        let better = scene.draw(self.read, &render, &|_| {}, self.session)?;
        let pairs = film.pixels.iter().zip(&better.film.pixels);
        let errors = pairs.map(|(a, b)| {
            let channels = [a.rgb.r - b.rgb.r, a.rgb.g - b.rgb.g, a.rgb.b - b.rgb.b];
            let largest = channels.map(f32::abs).into_iter().fold(0.0, f32::max);
            LEVELS * f64::from(largest)
        });
        Ok(errors.collect())
    }
}

/// The picture of values on a logarithmic scale from zero, row by row, and the scale.
fn drawn(values: &[f64], (width, height): (u32, u32)) -> (Vec<u8>, MapReport) {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a part of the number of pixels"
    )]
    let at = (SCALED * sorted.len().saturating_sub(1) as f64) as usize;
    let brightest = sorted.get(at).copied().unwrap_or_default();
    let scale = brightest.max(f64::MIN_POSITIVE).ln_1p();
    let color = |value: &f64| match value.ln_1p() / scale {
        share if share.is_finite() => color_of(share.min(1.0)),
        _ => color_of(1.0),
    };
    let bytes: Vec<u8> = values.iter().flat_map(color).collect();
    let mut png = Vec::new();
    // Nothing fails in memory but a size that does not fit.
    let _ = PngEncoder::new(&mut png).write_image(&bytes, width, height, ExtendedColorType::Rgb8);
    #[allow(clippy::cast_precision_loss, reason = "pixels are fewer than 2^52")]
    let mean = sorted.iter().sum::<f64>() / sorted.len().max(1) as f64;
    let largest = sorted.last().copied().unwrap_or_default();
    let report = MapReport {
        brightest,
        largest,
        mean,
    };
    (png, report)
}

/// The colour of a part of the scale.
fn color_of(share: f64) -> [u8; 3] {
    let color = ViridisRGB.get_color(share);
    [color.0, color.1, color.2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_begins_at_zero_and_is_logarithmic() {
        let values: Vec<f64> = (0..64).map(|value| f64::from(value % 4)).collect();
        let (png, report) = drawn(&values, (8, 8));
        let picture = image::load_from_memory(&png).expect("a picture").to_rgb8();
        for (x, share) in [(0, 0.0), (1, 0.5), (3, 1.0)] {
            assert_eq!(picture.get_pixel(x, 0).0, color_of(share));
        }
        let MapReport {
            brightest,
            largest,
            mean,
        } = report;
        assert_eq!((brightest, largest, mean), (3.0, 3.0, 1.5));
    }
}

//! Comparison of two pictures.

use super::value_error;
use super::watch::same_process;
use image::{DynamicImage, ImageBuffer, Pixel};
use povr::app::compare::{Thresholds, pictures};
use povr::app::picture_file;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use std::path::PathBuf;

/// A picture to compare.
#[derive(FromPyObject)]
pub(crate) enum Compared {
    /// A file of any format that povr reads.
    File(PathBuf),
    /// Columns, rows, channels, bits of a channel (8, 16, or 32 for floating point), and the pixels in native byte
    /// order.
    Array(u32, u32, usize, u8, PyBackedBytes),
}

impl Compared {
    fn open(&self) -> PyResult<DynamicImage> {
        match self {
            Compared::File(path) => picture_file::open(path).map_err(|error| {
                PyOSError::new_err(format!("cannot read `{}`: {error}", path.display()))
            }),
            Compared::Array(width, height, channels, bits, bytes) => {
                let size = (*width, *height);
                let picture = match (bits, channels) {
                    (8, 3) => whole(size, bytes.to_vec()).map(DynamicImage::ImageRgb8),
                    (8, 4) => whole(size, bytes.to_vec()).map(DynamicImage::ImageRgba8),
                    (16, 3) => whole(size, words(bytes)).map(DynamicImage::ImageRgb16),
                    (16, 4) => whole(size, words(bytes)).map(DynamicImage::ImageRgba16),
                    (32, 3) => whole(size, floats(bytes)).map(DynamicImage::ImageRgb32F),
                    (32, 4) => whole(size, floats(bytes)).map(DynamicImage::ImageRgba32F),
                    _ => None,
                };
                picture.ok_or_else(|| value_error(&"the array is no picture"))
            }
        }
    }
}

fn whole<P: Pixel>(
    (width, height): (u32, u32),
    values: Vec<P::Subpixel>,
) -> Option<ImageBuffer<P, Vec<P::Subpixel>>> {
    ImageBuffer::from_raw(width, height, values)
}

fn words(bytes: &[u8]) -> Vec<u16> {
    let words = bytes.as_chunks().0.iter();
    words.map(|&word| u16::from_ne_bytes(word)).collect()
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    let floats = bytes.as_chunks().0.iter();
    floats.map(|&float| f32::from_ne_bytes(float)).collect()
}

/// Compares two pictures: the pixels equal, off by one and off by more, mean, RMS and largest difference in steps, PSNR
/// in decibels, FLIP, and the place of the largest difference.
#[pyfunction]
pub(crate) fn compare<'py>(
    py: Python<'py>,
    expected: Compared,
    actual: Compared,
) -> PyResult<Vec<(&'static str, f64)>> {
    same_process()?;
    let compared = py.detach(|| {
        let (expected, actual) = (expected.open()?, actual.open()?);
        let compared = pictures(&expected, &actual, &Thresholds::default());
        compared.map_err(|mismatch| value_error(&mismatch))
    });
    let (_, _, compared) = compared?;
    let comparison = &compared.comparison;
    #[allow(clippy::cast_precision_loss, reason = "exact below 2^53 pixels")]
    let count = |pixels: u64| pixels as f64;
    let mut fields = vec![
        ("pixels", count(comparison.pixels())),
        ("equal", count(comparison.same)),
        ("off_by_one", count(comparison.off_by_one)),
        ("off_by_more", count(comparison.off_by_many)),
        ("mean", comparison.mean),
        ("rms", comparison.rms),
        ("max", comparison.max()),
        ("psnr", comparison.psnr()),
        ("flip", compared.flip),
    ];
    if let Some(worst) = &comparison.worst {
        fields.extend([("x", f64::from(worst.x)), ("y", f64::from(worst.y))]);
    }
    Ok(fields)
}

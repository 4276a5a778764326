//! The reference picture for all others: rendered once, with many samples, and stored.
//!
//! It is this program's own, so that only the error of sampling is measured; systematic differences of POV-Ray show as
//! the level below which its curve does not fall. Every pixel gets at least 32 samples, so that hardly any feature is
//! missed, and its own error is estimated like that of any picture.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::error::Linear;
use super::{CurveError, Draw, Drawn};
use crate::base::options::{Adaptive, Sampling};

/// Its requested error, in steps of 1/255.
pub const ERROR: f64 = 0.08;
const PICTURE: &str = "truth.f32";
const FACTS: &str = "truth.json";

/// Properties of the reference picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// The scene and size.
    pub(super) key: String,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Its estimated error: the root of the mean of the squares over all pixels, in linear light from 0 to 1.
    pub rms: f64,
    /// The same of the worst pixel.
    pub largest: f64,
    /// Camera rays for each pixel.
    #[serde(alias = "samples_a_pixel")]
    pub samples_per_pixel: f64,
    /// Seconds, over all processors.
    pub processor: f64,
}

/// The reference picture with this key from a folder, or rendered and stored there.
pub(super) fn stored_or_rendered(
    key: &str,
    error: f64,
    folder: &Path,
    draw: &Draw<'_>,
) -> Result<(Truth, Linear), CurveError> {
    let key = format!("{key} {error}");
    if let Some(stored) = stored(&key, folder) {
        return Ok(stored);
    }
    let sampling = Sampling::Adaptive(Adaptive { error, time: None });
    let Drawn {
        picture,
        reached,
        samples_per_pixel,
        processor,
        ..
    } = draw(sampling)?;
    let (rms, largest) = reached.map_or((0.0, 0.0), |reached| (reached.rms, reached.largest));
    let truth = Truth {
        key,
        size: (picture.width, picture.height),
        rms: rms / 255.0,
        largest: largest / 255.0,
        samples_per_pixel,
        processor,
    };
    let values = picture.pixels.iter().flatten();
    let bytes: Vec<u8> = values.flat_map(|c| c.to_le_bytes()).collect();
    super::files::write(&folder.join(PICTURE), &bytes)?;
    super::files::write_json(&folder.join(FACTS), &truth)?;
    Ok((truth, picture))
}

fn stored(key: &str, folder: &Path) -> Option<(Truth, Linear)> {
    let facts = std::fs::read(folder.join(FACTS)).ok()?;
    let truth: Truth = serde_json::from_slice(&facts).ok()?;
    let bytes = std::fs::read(folder.join(PICTURE)).ok()?;
    let (width, height) = truth.size;
    if truth.key != key || bytes.len() as u64 != 12 * u64::from(width) * u64::from(height) {
        return None;
    }
    let value = |at: &[u8]| f32::from_le_bytes([at[0], at[1], at[2], at[3]]);
    let pixels = bytes
        .chunks_exact(12)
        .map(|pixel| [0, 4, 8].map(|at| value(&pixel[at..at + 4])))
        .collect();
    Some((
        truth,
        Linear {
            width,
            height,
            pixels,
        },
    ))
}

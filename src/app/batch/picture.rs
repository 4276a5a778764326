//! A picture that a batch is to draw.

use crate::base::options::{ReadOptions, RenderOptions};
use crate::output::EncodeOptions;
use std::path::PathBuf;

/// A picture to render.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The scene.
    pub scene: PathBuf,
    /// Successive pictures with the same number are frames of one animation.
    pub series: usize,
    /// The file, relative to the folder of the run. The ending matches the format.
    pub output: PathBuf,
    /// Options for reading the scene.
    pub read: ReadOptions,
    /// Options for rendering; `threads` is ignored.
    pub render: RenderOptions,
    /// Options for encoding; the working colour space comes from the scene.
    pub encode: EncodeOptions,
}

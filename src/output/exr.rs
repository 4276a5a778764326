//! OpenEXR: linear light in half or single precision, with premultiplied alpha.

use std::io::Cursor;

use exr::prelude::*;

use super::quantize::to_linear;
use super::{EncodeOptions, EncodeResult, Format, FormatProperties};
use crate::base::film::Film;

impl Format {
    /// OpenEXR.
    pub const EXR: Format = Format(&FormatProperties {
        name: "EXR",
        letter: 'E',
        extensions: &["exr"],
        has_alpha: true,
        has_grey: false,
        has_words: false,
        is_linear: true,
        bits: 16,
        max_side: u32::MAX,
    });
}

/// ZIP compression of blocks of 16 lines, the default of POV-Ray's library.
const ENCODING: Encoding = Encoding {
    compression: Compression::ZIP16,
    blocks: Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

pub(super) fn encode(film: &Film, options: &EncodeOptions) -> EncodeResult {
    let linear = to_linear(options.working);
    let samples = |value_of: &dyn Fn(&crate::base::film::Pixel) -> f32| {
        let values = film.pixels.iter().map(value_of);
        if options.bits > 16 {
            FlatSamples::F32(values.collect())
        } else {
            FlatSamples::F16(values.map(f16::from_f32).collect())
        }
    };
    let mut channels = vec![
        AnyChannel::new("R", samples(&|p| linear(p.rgb.r))),
        AnyChannel::new("G", samples(&|p| linear(p.rgb.g))),
        AnyChannel::new("B", samples(&|p| linear(p.rgb.b))),
    ];
    if options.alpha {
        channels.push(AnyChannel::new("A", samples(&|p| 1.0 - p.transmit)));
    }
    let layer = Layer::new(
        (film.width as usize, film.height as usize),
        LayerAttributes::default(),
        ENCODING,
        AnyChannels::sort(channels.into_iter().collect()),
    );
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .to_buffered(&mut file)
        .map_err(|e| e.to_string())?;
    Ok(file.into_inner())
}

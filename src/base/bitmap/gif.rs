//! GIF decoding: the first frame and its palette. Interlaced rows stay in file order, as in POV-Ray.

use super::format::Format;
use super::handling::{Fault, Handling};
use super::png::{palette_color, words};
use super::{Bitmap, Samples};
use crate::base::color::Color;
use std::io::Cursor;

pub(super) fn decode(bytes: &[u8], handling: &Handling) -> Result<Bitmap, Fault> {
    let fault = |error: gif::DecodingError| error.to_string();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    options.set_memory_limit(gif::MemoryLimit::Unlimited);
    let mut decoder = options.read_info(Cursor::new(bytes)).map_err(fault)?;
    let global = decoder.global_palette().map(<[u8]>::to_vec);
    let frame = decoder.next_frame_info().map_err(fault)?;
    let frame = frame.ok_or("it holds no image")?.clone();
    let mut buffer = vec![0; decoder.buffer_size()];
    decoder.read_into_buffer(&mut buffer).map_err(fault)?;
    let (width, height) = (usize::from(frame.width), usize::from(frame.height));
    let transfer = handling.transfer(Format::Gif, None);
    let rgb_entries = frame.palette.or(global).unwrap_or_default();
    let mut palette: Vec<Color> = rgb_entries
        .chunks_exact(3)
        .map(|rgb| palette_color(words([rgb[0], rgb[1], rgb[2], u8::MAX]), transfer))
        .collect();
    if let Some(transparent_index) = frame.transparent
        && let Some(color) = palette.get_mut(usize::from(transparent_index))
    {
        color.transmit = 1.0;
    }
    if buffer.len() != width * height {
        return Err("it ends early".to_owned());
    }
    let indices = if frame.interlaced {
        let row = |y: usize| &buffer[y * width..(y + 1) * width];
        interlaced_row_order(height)
            .flat_map(row)
            .copied()
            .collect()
    } else {
        buffer
    };
    Ok(Bitmap {
        width,
        height,
        samples: Samples::Indexed(indices, palette),
        has_alpha: frame.transparent.is_some(),
        stores_alpha: false,
        is_premultiplied: handling.is_premultiplied.unwrap_or(false),
    })
}

/// Width and height of the first frame, and the bytes that decoding needs.
pub(super) fn size(bytes: &[u8]) -> Result<([u64; 2], u64), Fault> {
    let fault = |error: gif::DecodingError| error.to_string();
    let options = gif::DecodeOptions::new();
    let mut decoder = options.read_info(Cursor::new(bytes)).map_err(fault)?;
    let frame = decoder.next_frame_info().map_err(fault)?;
    let frame = frame.ok_or("it holds no image")?;
    let size = [frame.width, frame.height].map(u64::from);
    Ok((size, 2 * size[0] * size[1]))
}

/// Image rows in the order in which an interlaced file stores them.
fn interlaced_row_order(height: usize) -> impl Iterator<Item = usize> {
    let passes = [(0, 8), (4, 8), (2, 4), (1, 2)];
    passes
        .into_iter()
        .flat_map(move |(first, step)| (first..height).step_by(step))
}

#[cfg(test)]
mod tests {
    #[test]
    fn interlaced_rows_come_in_passes() {
        let order: Vec<_> = super::interlaced_row_order(9).collect();
        assert_eq!(order, [0, 8, 4, 2, 6, 1, 3, 5, 7]);
    }
}

//! JPEG decoder for baseline and progressive 8-bit files with Huffman codes (ITU-T T.81). The samples equal libjpeg's
//! byte for byte, because POV-Ray reads JPEG through libjpeg.
//!
//! The standard leaves three choices to the decoder; this one follows libjpeg. The inverse DCT is the integer version
//! of Loeffler, Ligtenberg and Moschytz 1989 ([`transform`]), chroma of half the resolution is upsampled with a
//! triangle filter ([`upsample`]), and YCbCr is converted to RGB in fixed point with 16 fractional bits ([`color`]).
//! Invalid codes decode to the same values as in libjpeg. A file that ends before its EOI marker is rejected, as in
//! POV-Ray.
//!
//! Missing: arithmetic coding, and block smoothing of progressive files that lack refinement scans. Also rejected by
//! POV-Ray: images of two or four channels, 12-bit samples, and the lossless and hierarchical modes.

mod bits;
mod block;
mod color;
mod header;
mod huffman;
mod scan;
mod tables;
mod transform;
mod upsample;

use super::handling::Fault;
use header::{ColorModel, Reader, Segment};
use image::{DynamicImage, GrayImage, RgbImage};
use scan::Decoder;

/// Width and height of the image, and the approximate number of bytes that decoding needs.
pub(crate) fn size(bytes: &[u8]) -> Result<([u64; 2], u64), Fault> {
    let mut reader = Reader::new(bytes)?;
    let Segment::Frame = reader.next_segment()? else {
        return Err("it holds no image".to_owned());
    };
    let frame = reader.frame.ok_or("it holds no image")?;
    let size = [u64::from(frame.width), u64::from(frame.height)];
    Ok((size, frame.bytes_to_decode()))
}

/// Decodes a file to a grey or RGB image.
pub(crate) fn decode(bytes: &[u8]) -> Result<DynamicImage, Fault> {
    let mut reader = Reader::new(bytes)?;
    let mut decoder: Option<Decoder> = None;
    loop {
        match reader.next_segment()? {
            Segment::Frame => {}
            Segment::Scan(scan) => {
                let frame = reader.frame.as_ref().ok_or("its frame is missing")?;
                let decoder = match &mut decoder {
                    Some(decoder) if decoder.is_complete() => {
                        return Err("it holds more scans than one".to_owned());
                    }
                    Some(decoder) => decoder,
                    empty => empty.insert(Decoder::new(frame)?),
                };
                decoder.scan(frame, &scan, &reader.tables, &mut reader.input)?;
            }
            Segment::End => break,
        }
    }
    let (frame, decoder) = (reader.frame, decoder);
    let (Some(frame), Some(decoder)) = (frame, decoder) else {
        return Err("it holds no image".to_owned());
    };
    let is_ycc = frame.color_model(&reader.color_markers)? == ColorModel::YCbCr;
    let planes = decoder.into_planes();
    let (width, height) = (u32::from(frame.width), u32::from(frame.height));
    let image = if frame.components.len() == 1 {
        let grey = upsample::pixels(&frame, &planes, |row, out| {
            out.extend_from_slice(row[0]);
        })?;
        GrayImage::from_raw(width, height, grey).map(DynamicImage::ImageLuma8)
    } else {
        let convert = if is_ycc {
            color::ycc_to_rgb
        } else {
            color::interleave_rgb
        };
        let pixels = upsample::pixels(&frame, &planes, convert)?;
        RgbImage::from_raw(width, height, pixels).map(DynamicImage::ImageRgb8)
    };
    Ok(image.expect("as many samples as pixels were made"))
}

#[cfg(test)]
mod tests;

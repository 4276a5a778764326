//! JPEG: baseline and progressive files of eight bits with Huffman codes (ITU-T T.81), down to the bytes that libjpeg
//! makes of them, which is what POV-Ray sees.
//!
//! The standard leaves a decoder free in three things, and libjpeg's choices are reproduced here: the inverse transform
//! is the one of Loeffler, Ligtenberg and Moschytz 1989 in integers ([`transform`]), colours of half the resolution are
//! spread by a triangle filter ([`upsample`]), and YCC becomes RGB in steps of 1/65536 ([`color`]). Damaged codes decode
//! to whatever libjpeg makes of them; a file that ends before its end mark is refused, as POV-Ray refuses it.
//!
//! Missing: arithmetic codes and the smoothing of progressive files whose refinements are left out. Refused by POV-Ray
//! too: pictures of four or two channels, twelve bits, lossless and hierarchical ones.

mod bits;
mod block;
mod color;
mod header;
mod huffman;
mod scan;
mod tables;
mod transform;
mod upsample;

use super::decode::Fault;
use header::{Coding, Reader, Segment};
use image::{DynamicImage, GrayImage, RgbImage};
use scan::Decoder;

/// The width and height of a file, and about how many bytes decoding it takes.
pub(crate) fn size(bytes: &[u8]) -> Result<([u64; 2], u64), Fault> {
    let mut reader = Reader::new(bytes)?;
    let Segment::Frame = reader.next_segment()? else {
        return Err("it holds no picture".to_owned());
    };
    let frame = reader.frame.ok_or("it holds no picture")?;
    let size = [u64::from(frame.width), u64::from(frame.height)];
    Ok((size, frame.bytes()))
}

/// The picture of a file, grey or in colours.
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
                    none => none.insert(Decoder::new(frame)?),
                };
                decoder.scan(frame, &scan, &reader.tables, &mut reader.rest)?;
            }
            Segment::End => break,
        }
    }
    let (frame, decoder) = (reader.frame, decoder);
    let (Some(frame), Some(decoder)) = (frame, decoder) else {
        return Err("it holds no picture".to_owned());
    };
    let is_ycc = frame.coding(&reader.marks)? == Coding::Ycc;
    let planes = decoder.planes();
    let (width, height) = (u32::from(frame.width), u32::from(frame.height));
    let picture = if frame.components.len() == 1 {
        let grey = upsample::rows(&frame, &planes, |row, out| {
            out.extend_from_slice(row[0]);
        })?;
        GrayImage::from_raw(width, height, grey).map(DynamicImage::ImageLuma8)
    } else {
        let convert = if is_ycc { color::ycc } else { color::rgb };
        let pixels = upsample::rows(&frame, &planes, convert)?;
        RgbImage::from_raw(width, height, pixels).map(DynamicImage::ImageRgb8)
    };
    Ok(picture.expect("as many samples as pixels were made"))
}

#[cfg(test)]
mod tests;

//! Contact sheets: pictures beside each other, as a picture and as a page.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::codecs::png::CompressionType;
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};
use rayon::prelude::*;

use super::BatchError;
use crate::app::picture_file::{self, png};

/// Pictures in a row.
const COLUMNS: u32 = 8;
/// The gap between pictures.
const GAP: u32 = 4;
const PAPER: Rgb<u8> = Rgb([255, 255, 255]);
/// The frame of a picture that is missing or wrong.
const WRONG: Rgb<u8> = Rgb([220, 0, 0]);
/// The size of a picture of a batch on its sheet.
const CELL: (u32, u32) = (160, 120);
/// Placeholder for a missing picture.
const NOTHING: Rgb<u8> = Rgb([225, 225, 225]);
/// Upper limit of pictures on one sheet; the page has all.
const MOST: usize = 2000;

const STYLE: &str = "\
body { font: 14px/1.4 sans-serif; margin: 2em; color: #222; background: #fff }
main { display: flex; flex-wrap: wrap; gap: 1em }
figure { margin: 0; max-width: 20em; overflow-wrap: anywhere }
figure.overview { max-width: 100%; flex-basis: 100% }
img { max-width: 100%; display: block; border: 1px solid #ccc }
figure.wrong img { border: 3px solid #d00 }
figcaption b { display: block }
code { color: #555 }
small { color: #777 }
figure.wrong small { color: #b00 }
";

/// A picture of a batch on its sheet.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The name below the picture.
    pub name: String,
    /// Its file, relative to the folder of the sheet.
    pub file: PathBuf,
    /// The reason if it is missing.
    pub missing: Option<String>,
}

/// Writes `index.html` and `contact.png` into a folder of pictures.
///
/// # Errors
/// When they cannot be written. Pictures that cannot be read are grey.
pub fn write_index(folder: &Path, figures: &[Figure]) -> Result<(), BatchError> {
    let cells: Vec<(RgbImage, bool)> = figures
        .par_iter()
        .map(|figure| match small(folder, figure) {
            Some(picture) => (picture, false),
            None => (RgbImage::from_pixel(CELL.0, CELL.1, NOTHING), true),
        })
        .collect();
    let texts: Vec<String> = figures
        .par_iter()
        .zip(&cells)
        .map(|(figure, (cell, _))| text(figure, cell))
        .collect();
    let missing = figures.iter().filter(|figure| figure.missing.is_some());
    let about = format!("{} pictures, {} missing.", figures.len(), missing.count());
    put(
        &folder.join("index.html"),
        page("Pictures", &about, &texts.concat()).as_bytes(),
    )?;
    let sheet = pasted(&cells[..cells.len().min(MOST)], CELL.0);
    put(
        &folder.join("contact.png"),
        &png(&sheet, CompressionType::Default),
    )
}

/// Writes a file atomically: another part of the run may be writing the same one.
fn put(path: &Path, bytes: &[u8]) -> Result<(), BatchError> {
    let part = path.with_extension(format!("{}.part", std::process::id()));
    fs::write(&part, bytes)
        .and_then(|()| fs::rename(&part, path))
        .map_err(|error| {
            let _ = fs::remove_file(&part);
            BatchError::of_file("write", path, &error)
        })
}

/// The picture scaled down and centred in a cell.
fn small(folder: &Path, figure: &Figure) -> Option<RgbImage> {
    if figure.missing.is_some() {
        return None;
    }
    let picture = picture_file::open(&folder.join(&figure.file)).ok()?;
    let picture = picture.thumbnail(CELL.0, CELL.1).into_rgb8();
    let mut cell = RgbImage::from_pixel(CELL.0, CELL.1, PAPER);
    let (x, y) = (CELL.0 - picture.width(), CELL.1 - picture.height());
    imageops::replace(&mut cell, &picture, i64::from(x / 2), i64::from(y / 2));
    Some(cell)
}

/// The HTML of a figure. A browser loads the picture itself, if it can show it.
fn text(figure: &Figure, cell: &RgbImage) -> String {
    let name = escaped(&figure.name);
    let address = address(&figure.file);
    if let Some(why) = &figure.missing {
        let why = escaped(why);
        return format!(
            "<figure class=\"wrong\"><figcaption><b>{name}</b><small>{why}</small></figcaption></figure>\n"
        );
    }
    let ending = figure.file.extension().unwrap_or_default();
    let is_shown = ["png", "jpg", "bmp"].iter().any(|known| ending == *known);
    let source = if is_shown {
        address.clone()
    } else {
        format!(
            "data:image/png;base64,{}",
            STANDARD.encode(png(cell, CompressionType::Default))
        )
    };
    format!(
        "<figure><a href=\"{address}\"><img loading=\"lazy\" alt=\"{name}\" src=\"{source}\" width=\"{}\"></a>\
         <figcaption><b>{name}</b></figcaption></figure>\n",
        2 * CELL.0
    )
}

/// A relative URL for a path.
fn address(path: &Path) -> String {
    let mut address = String::new();
    for byte in path.to_string_lossy().bytes() {
        if byte.is_ascii_alphanumeric() || b"/-_.~".contains(&byte) {
            address.push(char::from(byte));
        } else {
            // Writing to a string cannot fail.
            let _ = write!(address, "%{byte:02X}");
        }
    }
    address
}

/// A page of figures.
#[must_use]
pub fn page(title: &str, about: &str, figures: &str) -> String {
    let title = escaped(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title>\n\
         <style>\n{STYLE}</style></head>\n<body><h1>{title}</h1><p>{about}</p>\n<main>\n{figures}</main></body></html>\n"
    )
}

/// Escapes a text for HTML.
#[must_use]
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// Pastes pictures of one size into rows of `width` pictures, with a frame around those that are wrong.
#[must_use]
pub fn pasted(pictures: &[(RgbImage, bool)], width: u32) -> RgbImage {
    let Some((first, _)) = pictures.first() else {
        return RgbImage::new(1, 1);
    };
    let height = (u64::from(first.height()) * u64::from(width) / u64::from(first.width())).max(1);
    let height = u32::try_from(height).unwrap_or(width);
    let count = u32::try_from(pictures.len()).unwrap_or(u32::MAX);
    let columns = COLUMNS.min(count);
    let (across, down) = (width + GAP, height + GAP);
    let size = (columns * across + GAP, count.div_ceil(columns) * down + GAP);
    let mut sheet = RgbImage::from_pixel(size.0, size.1, PAPER);
    for (number, (picture, is_wrong)) in (0_u32..).zip(pictures) {
        let (x, y) = (
            GAP + number % columns * across,
            GAP + number / columns * down,
        );
        if *is_wrong {
            let frame = RgbImage::from_pixel(width + 2 * GAP, height + 2 * GAP, WRONG);
            imageops::replace(&mut sheet, &frame, i64::from(x - GAP), i64::from(y - GAP));
        }
        if picture.dimensions() == (width, height) {
            imageops::replace(&mut sheet, picture, i64::from(x), i64::from(y));
            continue;
        }
        let small = imageops::resize(picture, width, height, FilterType::Triangle);
        imageops::replace(&mut sheet, &small, i64::from(x), i64::from(y));
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_stand_in_rows_and_wrong_ones_in_frames() {
        let grey = RgbImage::from_pixel(8, 4, Rgb([90, 90, 90]));
        let pictures: Vec<_> = (0..9).map(|number| (grey.clone(), number == 8)).collect();
        let sheet = pasted(&pictures, 8);
        assert_eq!(sheet.dimensions(), (8 * 12 + 4, 2 * 8 + 4));
        assert_eq!(*sheet.get_pixel(0, 0), PAPER);
        assert_eq!(*sheet.get_pixel(4, 4), Rgb([90, 90, 90]));
        assert_eq!(*sheet.get_pixel(1, 9), WRONG);
    }

    #[test]
    fn transforms_are_text_in_a_page() {
        assert_eq!(escaped("scale <1, 2, 3>"), "scale &lt;1, 2, 3&gt;");
    }

    #[test]
    fn urls_escape_special_characters() {
        assert_eq!(address(Path::new("a b/é#1.png")), "a%20b/%C3%A9%231.png");
    }
}

//! Contact sheets: the pictures of a shape beside each other, as a picture and as a page that needs no other file.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};

use super::{Entry, OVERVIEW, failed};
use crate::cli::error::CliError;

/// Pictures in a row.
const COLUMNS: u32 = 8;
/// The width of each on the sheet, at most.
const MOST_WIDTH: u32 = 160;
/// Between pictures.
const GAP: u32 = 4;
const PAPER: Rgb<u8> = Rgb([255, 255, 255]);
/// Around a picture that is not POV-Ray's.
const WRONG: Rgb<u8> = Rgb([220, 0, 0]);

const STYLE: &str = "\
body { font: 14px/1.4 sans-serif; margin: 2em; color: #222; background: #fff }
main { display: flex; flex-wrap: wrap; gap: 1em }
figure { margin: 0; max-width: 20em }
figure.overview { max-width: 100%; flex-basis: 100% }
img { max-width: 100%; display: block; border: 1px solid #ccc }
figure.wrong img { border: 3px solid #d00 }
figcaption b { display: block }
code { color: #555 }
small { color: #777 }
";

/// Writes `sheet.png` and `sheet.html` into the folder of a shape.
pub(super) fn write(
    folder: &Path,
    shape: &str,
    entries: &[Entry],
    width: u32,
) -> Result<(), CliError> {
    let mut pictures = Vec::new();
    let mut figures = String::new();
    for entry in entries {
        let path = folder.join(format!("{}.png", entry.name));
        let bytes = fs::read(&path).map_err(|error| failed("read", &path, &error))?;
        let is_overview = entry.name == OVERVIEW.0;
        let class = match (is_overview, entry.verdict.is_wrong()) {
            (true, false) => "overview",
            (true, true) => "overview wrong",
            (false, false) => "",
            (false, true) => "wrong",
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            figures,
            "<figure class=\"{class}\"><img alt=\"{name}\" src=\"data:image/png;base64,{data}\">\
             <figcaption><b>{name}</b><code>{text}</code> <small>{verdict}</small></figcaption></figure>",
            name = entry.name,
            data = STANDARD.encode(&bytes),
            text = escaped(&entry.text),
            verdict = entry.verdict,
        );
        if !is_overview || entries.len() == 1 {
            let picture = image::load_from_memory(&bytes);
            let picture = picture.map_err(|error| failed("read", &path, &error))?;
            pictures.push((picture.into_rgb8(), entry.verdict.is_wrong()));
        }
    }
    let sheet = pasted(&pictures, width.min(MOST_WIDTH));
    let path = folder.join("sheet.png");
    sheet
        .save(&path)
        .map_err(|error| failed("write", &path, &error))?;
    let about = "Transforms of one object. x is blue, y is yellow, z is red.";
    super::write(&folder.join("sheet.html"), &page(shape, about, &figures))
}

/// Writes `index.html` above the folders of several shapes.
pub(super) fn write_index(folder: &Path, shapes: &[String]) -> Result<(), CliError> {
    let mut figures = String::new();
    for shape in shapes {
        let _ = writeln!(
            figures,
            "<figure><a href=\"{shape}/sheet.html\"><img alt=\"{shape}\" src=\"{shape}/{}.png\"></a>\
             <figcaption><b>{shape}</b></figcaption></figure>",
            OVERVIEW.0
        );
    }
    let text = page("All shapes", "Each under all transforms.", &figures);
    super::write(&folder.join("index.html"), &text)
}

fn page(title: &str, about: &str, figures: &str) -> String {
    let title = escaped(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title>\n\
         <style>\n{STYLE}</style></head>\n<body><h1>{title}</h1><p>{about}</p>\n<main>\n{figures}</main></body></html>\n"
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Pictures of one size in rows, with a frame around those that are wrong.
fn pasted(pictures: &[(RgbImage, bool)], width: u32) -> RgbImage {
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
}

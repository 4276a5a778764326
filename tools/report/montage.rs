//! All rows of pictures on one sheet, with a line of text above each.

use crate::sheet::{FACTOR, GAP};
use image::{Rgb, RgbImage, imageops};
use resvg::{tiny_skia, usvg};
use std::fmt::Write as _;
use std::io::Error;

/// Rows side by side.
const COLUMNS: usize = 3;
/// Margin around a row, and height of its line of text.
const MARGIN: u32 = 14;
const LINE: u32 = 18;
/// Height of the column titles.
const HEAD: u32 = 44;
/// Characters that fit into a line of text.
const MAX_LETTERS: usize = 84;

/// The sheet.
///
/// # Errors
/// If the text cannot be drawn.
pub(crate) fn of(rows: &[(String, RgbImage)]) -> Result<RgbImage, Error> {
    let width = rows.iter().map(|row| row.1.width()).max().unwrap_or(1);
    let height = rows.iter().map(|row| row.1.height()).max().unwrap_or(1);
    let (step, rise) = (width + 2 * MARGIN, height + LINE + MARGIN);
    let lines = u32::try_from(rows.len().div_ceil(COLUMNS)).unwrap_or(1);
    let columns = u32::try_from(COLUMNS).unwrap_or(1);
    let size = (columns * step, HEAD + lines * rise);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" font-family=\"DejaVu Sans\" font-size=\"12\">",
        size.0, size.1
    );
    let panel = 48 * FACTOR + GAP;
    for column in 0..columns {
        for (index, head) in ["right", "POV-Ray 3.7", "povr", "wrong pixels"]
            .into_iter()
            .enumerate()
        {
            let left = column * step + MARGIN + u32::try_from(index).unwrap_or(0) * panel;
            let _ = write!(
                text,
                "<text x=\"{left}\" y=\"28\" font-size=\"11\" font-weight=\"bold\">{head}</text>"
            );
        }
    }
    let corner = |number: usize| {
        let number = u32::try_from(number).unwrap_or(0);
        let (down, across) = (number / columns, number % columns);
        (across * step + MARGIN, HEAD + down * rise)
    };
    for (number, (caption, _)) in rows.iter().enumerate() {
        let (left, top) = corner(number);
        let short: String = caption.chars().take(MAX_LETTERS).collect();
        let safe = short.replace('&', "&amp;").replace('<', "&lt;");
        let _ = write!(text, "<text x=\"{left}\" y=\"{}\">{safe}</text>", top + 12);
    }
    text += "</svg>";
    let mut sheet = drawn(&text, size)?;
    for (number, (_, row)) in rows.iter().enumerate() {
        let (left, top) = corner(number);
        imageops::replace(&mut sheet, row, i64::from(left), i64::from(top + LINE));
    }
    Ok(sheet)
}

/// Text on white.
fn drawn(svg: &str, (width, height): (u32, u32)) -> Result<RgbImage, Error> {
    let mut options = usvg::Options {
        font_family: "DejaVu Sans".to_owned(),
        ..usvg::Options::default()
    };
    options.fontdb_mut().load_system_fonts();
    let tree = usvg::Tree::from_str(svg, &options).map_err(Error::other)?;
    let mut pixmap =
        tiny_skia::Pixmap::new(width, height).ok_or_else(|| Error::other("no memory for it"))?;
    pixmap.fill(tiny_skia::Color::WHITE);
    let identity = tiny_skia::Transform::identity();
    resvg::render(&tree, identity, &mut pixmap.as_mut());
    Ok(RgbImage::from_fn(width, height, |x, y| {
        let pixel = pixmap.pixel(x, y);
        pixel.map_or(Rgb([255; 3]), |p| Rgb([p.red(), p.green(), p.blue()]))
    }))
}

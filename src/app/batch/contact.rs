//! Contact sheets: pictures beside each other, as a picture and as a page.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf, absolute};

use image::codecs::png::CompressionType;
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};
use rayon::prelude::*;

use super::BatchError;
use crate::app::page::{FILTER, GALLERY, Page, escaped, png_url};
use crate::app::picture_file::{self, png};

const STYLE: &str = "\
.failures { display: grid; gap: 1rem; }
figure.wrong { border-left: 4px solid var(--failure); padding-left: 0.8rem; }
.stage { display: grid; place-items: center; }
.stage img { max-width: 100%; max-height: 100%; object-fit: contain; }
";
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

/// A picture of a batch on its sheet.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The name below the picture.
    pub name: String,
    /// Its file, relative to the folder of the sheet.
    pub file: PathBuf,
    /// Its scene.
    pub scene: PathBuf,
    /// Seconds that it took, if this run drew it.
    pub seconds: Option<f64>,
    /// The reason if it is missing: lines of text.
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
        .map(|(figure, (cell, _))| text(folder, figure, cell))
        .collect();
    put(
        &folder.join("index.html"),
        html(folder, figures, &texts).as_bytes(),
    )?;
    let sheet = pasted(&cells[..cells.len().min(MOST)], CELL.0);
    put(
        &folder.join("contact.png"),
        &png(&sheet, CompressionType::Default),
    )
}

/// The page of all pictures, those that failed first.
fn html(folder: &Path, figures: &[Figure], texts: &[String]) -> String {
    let of = |is_missing: bool| {
        let both = figures.iter().zip(texts);
        both.filter(move |(figure, _)| figure.missing.is_some() == is_missing)
            .map(|(_, text)| text.as_str())
    };
    let failed = of(true).count();
    let count = figures.len() - failed;
    let noun = if count == 1 { "picture" } else { "pictures" };
    let headline = match failed {
        0 => format!("{count} {noun}"),
        _ => format!("{count} {noun}, {failed} failed"),
    };
    let name = absolute(folder).unwrap_or_else(|_| folder.to_owned());
    let name = escaped(&name.display().to_string());
    let mut body = format!(
        "<h1>{headline}</h1>\n<p class=\"quiet\"><code>{name}</code> <time id=\"when\"></time></p>\n\
         <div class=\"bar\">{FILTER}</div>\n"
    );
    for (title, is_missing) in [("Failed", true), ("Pictures", false)] {
        let figures: String = of(is_missing).collect();
        if !figures.is_empty() {
            let class = if is_missing { "failures" } else { "gallery" };
            body += &format!(
                "<section class=\"group\"><h2>{title}</h2>\n<div class=\"{class}\">\n{figures}</div></section>\n"
            );
        }
    }
    body += GALLERY;
    Page {
        title: &format!("{headline} – povr batch"),
        style: STYLE,
        body: &body,
    }
    .html()
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
fn text(folder: &Path, figure: &Figure, cell: &RgbImage) -> String {
    let name = escaped(&figure.name);
    let scene = format!(
        "<a href=\"{}\">scene</a>",
        address(&from_folder(folder, &figure.scene))
    );
    if let Some(why) = &figure.missing {
        let why = escaped(why);
        return format!(
            "<figure id=\"{name}\" class=\"wrong\"><figcaption><b>{name}</b> {scene}<pre>{why}</pre></figcaption></figure>\n"
        );
    }
    let file = address(&figure.file);
    let ending = figure.file.extension().unwrap_or_default();
    let is_shown = ["png", "jpg", "bmp"].iter().any(|known| ending == *known);
    let source = if is_shown {
        file.clone()
    } else {
        png_url(&png(cell, CompressionType::Default))
    };
    let time = figure
        .seconds
        .map_or_else(|| "up to date".to_owned(), |s| format!("{s:.2} s"));
    let path = folder.join(&figure.file);
    let size = image::image_dimensions(&path).map_or_else(
        |_| String::new(),
        |(width, height)| format!(" · {width} × {height}"),
    );
    let kilobytes = fs::metadata(&path).map_or(0, |file| file.len().div_ceil(1000));
    format!(
        "<figure id=\"{name}\"><a class=\"shot\" href=\"{file}\"><img loading=\"lazy\" alt=\"{name}\" src=\"{source}\"></a>\
         <figcaption><b>{name}</b> <span>{time}{size} · {kilobytes} kB</span> <a href=\"{file}\">file</a> {scene}</figcaption></figure>\n"
    )
}

/// The path of a scene as seen from a folder.
fn from_folder(folder: &Path, scene: &Path) -> PathBuf {
    // `..` in the path of the folder would be taken for a folder to leave.
    let real = |path: &Path| fs::canonicalize(path).or_else(|_| absolute(path));
    let (Ok(folder), Ok(scene)) = (real(folder), real(scene)) else {
        return scene.to_owned();
    };
    let parts = |path: &Path| {
        path.components()
            .map(|c| c.as_os_str().to_owned())
            .collect::<Vec<_>>()
    };
    let (from, to) = (parts(&folder), parts(&scene));
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = from[common..].iter().map(|_| "..".into());
    up.chain(to[common..].iter().cloned()).collect()
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
    fn scenes_are_linked_from_the_folder_of_the_page() {
        let linked = |folder, scene| from_folder(Path::new(folder), Path::new(scene));
        assert_eq!(linked("/a/out", "/a/in/x.pov"), Path::new("../in/x.pov"));
        assert_eq!(linked("out/deep", "x.pov"), Path::new("../../x.pov"));
    }

    #[test]
    fn failures_come_first_and_are_counted() {
        let figure = |name: &str, missing: Option<&str>| Figure {
            name: name.to_owned(),
            file: PathBuf::from(name),
            scene: PathBuf::from(name),
            seconds: None,
            missing: missing.map(str::to_owned),
        };
        let figures = [figure("a", None), figure("b", Some("error: <b>"))];
        let texts = figures
            .clone()
            .map(|one| text(Path::new("."), &one, &RgbImage::new(1, 1)));
        let page = html(Path::new("."), &figures, &texts);
        assert!(page.contains("<title>1 picture, 1 failed – povr batch</title>"));
        assert!(
            page.find("error: &lt;b&gt;") < page.find("id=\"a\""),
            "{page}"
        );
    }

    #[test]
    fn urls_escape_special_characters() {
        assert_eq!(address(Path::new("a b/é#1.png")), "a%20b/%C3%A9%231.png");
    }
}

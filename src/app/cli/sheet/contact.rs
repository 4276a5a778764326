//! Contact sheets: the pictures of a shape side by side, as a picture and as a self-contained page.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use image::codecs::png::CompressionType;

use super::{Entry, OVERVIEW, failed};
use crate::app::batch::{escaped, page, pasted};
use crate::app::cli::options::error::CliError;
use crate::app::picture_file::png;

/// Maximum width of each picture on the sheet.
const MAX_WIDTH: u32 = 160;
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
    let sheet = pasted(&pictures, width.min(MAX_WIDTH));
    let path = folder.join("sheet.png");
    fs::write(&path, png(&sheet, CompressionType::Default))
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

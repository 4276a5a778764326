//! Contact sheets: the pictures of a shape side by side, as a picture and as a self-contained page.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use image::codecs::png::CompressionType;

use super::judge::Verdict;
use super::{Entry, OVERVIEW, failed};
use crate::app::batch::pasted;
use crate::app::cli::options::error::CliError;
use crate::app::page::{FILTER, GALLERY, Page, escaped, png_url};
use crate::app::picture_file::png;

/// Maximum width of each picture on the sheet.
const MAX_WIDTH: u32 = 160;
const STYLE: &str = "\
.gallery { grid-template-columns: repeat(auto-fill, minmax(min(100%, 190px), 1fr)); }
#overview { grid-column: 1 / -1; max-width: 640px; }
figure.wrong img { border: 3px solid var(--failure); }
figure.wrong .badge, .badge.differs { --shade: var(--failure); }
.axes span { font-weight: 600; margin-right: 0.8rem; }
.axes i { display: inline-block; width: 0.8em; height: 0.8em; border-radius: 50%; margin-right: 0.3em; }
.stage { display: grid; place-items: center; }
.stage img { max-width: 100%; max-height: 100%; object-fit: contain; }
.viewer figure .more, .viewer footer .more { display: block; flex-basis: 100%; }
";
/// The colours of the axes in the pictures.
const AXES: &str = "<p class=\"quiet axes\"><span><i style=\"background:#ff1a1a\"></i>x</span>\
    <span><i style=\"background:#1aa61a\"></i>y</span><span><i style=\"background:#2a4bff\"></i>z</span>\
    arrows point to the positive ends; the object is red and blue at two opposite corners</p>\n";

/// Writes `sheet.png` and `sheet.html` into the folder of a shape.
pub(super) fn write(
    folder: &Path,
    shape: &str,
    entries: &[Entry],
    width: u32,
) -> Result<(), CliError> {
    let mut pictures = Vec::new();
    let mut groups: Vec<(&str, String)> = Vec::new();
    for entry in entries {
        let path = folder.join(format!("{}.png", entry.of.name));
        let bytes = fs::read(&path).map_err(|error| failed("read", &path, &error))?;
        let scene = path.with_extension("pov");
        let text = fs::read_to_string(&scene).map_err(|error| failed("read", &scene, &error))?;
        let is_overview = entry.of.name == OVERVIEW.0;
        let group = if is_overview { "All" } else { entry.of.group() };
        let at = groups.iter().position(|(name, _)| *name == group);
        let at = at.unwrap_or_else(|| {
            groups.push((group, String::new()));
            groups.len() - 1
        });
        groups[at].1 += &figure(entry, &bytes, &text);
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
    let headline = headline(shape, entries);
    let mut body = format!(
        "<h1>{}</h1>\n{AXES}<div class=\"bar\">{FILTER}</div>\n",
        escaped(&headline)
    );
    for (group, figures) in groups {
        // Writing to a string cannot fail.
        let _ = writeln!(
            body,
            "<section class=\"group\"><h2>{group}</h2>\n<div class=\"gallery\">\n{figures}</div></section>"
        );
    }
    body += GALLERY;
    let page = Page {
        title: &format!("{headline} – povr sheet"),
        style: STYLE,
        body: &body,
    };
    super::write(&folder.join("sheet.html"), &page.html())
}

/// The result in a few words.
fn headline(shape: &str, entries: &[Entry]) -> String {
    let wrong = entries.iter().filter(|one| one.verdict.is_wrong()).count();
    let is_alone = entries
        .iter()
        .all(|one| one.verdict == Verdict::NotCompared);
    match (wrong, is_alone) {
        (_, true) => format!("{shape}: {} pictures", entries.len()),
        (0, _) => format!(
            "{shape}: all {} pictures agree with POV-Ray's",
            entries.len()
        ),
        _ => format!(
            "{shape}: {wrong} of {} pictures differ from POV-Ray's",
            entries.len()
        ),
    }
}

/// A picture with the text of its scene. Only an exception says how it compares.
fn figure(entry: &Entry, bytes: &[u8], scene: &str) -> String {
    let name = &entry.of.name;
    let is_equal = matches!(entry.verdict, Verdict::Compared { same, .. } if same == 100.0);
    let verdict = match entry.verdict {
        Verdict::NotCompared => String::new(),
        _ if is_equal => String::new(),
        verdict if verdict.is_wrong() => format!(" <span class=\"badge\">{verdict}</span>"),
        verdict => format!(" <span class=\"quiet\">{verdict}</span>"),
    };
    let class = if entry.verdict.is_wrong() {
        " class=\"wrong\""
    } else {
        ""
    };
    format!(
        "<figure id=\"{name}\"{class}><a class=\"shot\" href=\"{name}.png\"><img alt=\"{name}\" src=\"{}\"></a>\
         <figcaption><b>{name}</b> <code>{}</code>{verdict}<pre class=\"more\">{}</pre></figcaption></figure>\n",
        png_url(bytes),
        escaped(&entry.of.text),
        escaped(scene.trim()),
    )
}

/// Writes `index.html` above the folders of several shapes, each with the number of pictures that differ.
pub(super) fn write_index(folder: &Path, shapes: &[(String, usize)]) -> Result<(), CliError> {
    let wrong = shapes
        .iter()
        .filter(|(_, differing)| *differing > 0)
        .count();
    let headline = match wrong {
        0 => format!("{} shapes, none differs", shapes.len()),
        _ => format!("{wrong} of {} shapes differ", shapes.len()),
    };
    let mut body = format!("<h1>{headline}</h1>\n<div class=\"gallery\">\n");
    for (shape, differing) in shapes {
        let badge = match differing {
            0 => String::new(),
            _ => format!(" <span class=\"badge differs\">{differing} differ</span>"),
        };
        let _ = writeln!(
            body,
            "<figure><a href=\"{shape}/sheet.html\"><img alt=\"{shape}\" src=\"{shape}/{}.png\"></a>\
             <figcaption><b>{shape}</b>{badge}</figcaption></figure>",
            OVERVIEW.0
        );
    }
    body += "</div>\n";
    let page = Page {
        title: &format!("{headline} – povr sheet"),
        style: STYLE,
        body: &body,
    };
    super::write(&folder.join("index.html"), &page.html())
}

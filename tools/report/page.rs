//! The report: a page, a sheet of pictures, and the table as text.

use crate::Answered;
use crate::case::{Asks, Outcome};
use crate::curves::Curve;
use crate::sheet;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::{ImageFormat, Rgb, RgbImage, imageops};
use std::fmt::Write as _;
use std::io::{Cursor, Error};
use std::path::Path;

const STYLE: &str = "
body { margin: 0 auto; max-width: 1300px; padding: 1rem 1.5rem 4rem; color: #1c1c1c; background: #fff;
  font: 16px/1.45 system-ui, 'DejaVu Sans', sans-serif; }
h1 { font-size: 1.6rem; margin: 0.5rem 0; } h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; }
.wide { overflow-x: auto; } .plots svg { max-width: 100%; height: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 0.9rem; }
th, td { padding: 0.2rem 0.7rem; text-align: right; border-bottom: 1px solid #ddd; }
td.text, th.text { text-align: left; } .bad { color: #b3261e; font-weight: 600; }
figure { margin: 0 0 1rem; } figure img { max-width: 100%; image-rendering: pixelated; display: block; }
figcaption { font-size: 0.85rem; }
";

/// Why POV-Ray is wrong, by item, where the reason is known.
fn why(item: u8) -> &'static str {
    match item {
        1 | 2 | 8 => {
            "a hit must be 1e-4 away; roots of the quartic are compared with fixed numbers"
        }
        11 | 12 | 45 => {
            "half chords below 1e-5, boxes thinner than 1e-6 and depths beyond 1e7 do not exist"
        }
        9 | 17 => "depths are compared in units of the object",
        10 | 46 | 47 => "a shadow's cause must be 1e-3 away",
        13 | 54 => "1e-4, 1e-3, 1e7 are lengths of the scene",
        14 | 15 => "boxes in single precision; translations multiplied into coefficients",
        19..=25 | 53 => {
            "points of a face are asked whether they are inside the other face: rounding decides"
        }
        26 | 27 => "one stack frame for each difference",
        36 => "a light's last 1e-3 casts no shadow; nothing is met beyond 1e7",
        37..=40 => "surfaces within 1e-4 (shadows: 1e-3) of the last one are skipped",
        49 => "nothing is met beyond 1e7",
        _ => "",
    }
}

/// Writes `index.html`, `sheet.png` and `table.md`.
pub(crate) fn write(folder: &Path, answered: &[Answered], curves: &[Curve]) -> Result<(), Error> {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Stability</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>Right where rounding goes wrong</h1>\n\
         <p>Each pixel or ray has an answer that is known to 77 digits; those whose answer changes with the millionth part \
         of a pixel (or with half a step of the scene's own numbers) are not counted.</p>\n{}",
        summary(answered)
    );
    page += "<h2>Unit and place</h2>\n<div class=\"plots\">\n";
    for curve in curves {
        page += &curve.svg();
    }
    page += "</div>\n";
    if let Ok(roots) = std::fs::read_to_string(folder.join("root_error.html")) {
        page += &roots;
    }
    page += "<h2>Cases</h2>\n<div class=\"wide\"><table>\n<thead><tr><th>item</th><th class=\"text\">case</th><th>certain</th>\
        <th>POV-Ray wrong</th><th>povr wrong</th><th class=\"text\">remark</th></tr></thead>\n<tbody>\n";
    let mut table = "| item | case | certain | POV-Ray wrong | povr wrong | remark |\n|--:|---|--:|--:|--:|---|\n".to_owned();
    for one in answered {
        row(&mut page, &mut table, one);
    }
    page += "</tbody></table></div>\n<h2>Pictures</h2>\n\
        <p>What is right | POV-Ray | its wrong pixels | povr | its wrong pixels. Of the cases with something wrong.</p>\n";
    let mut rows = Vec::new();
    for one in answered.iter().filter(|one| is_shown(one)) {
        let outcomes: Vec<&Outcome> = one.pov_ray.iter().chain([&one.povr]).collect();
        let picture = sheet::row(&one.case, &outcomes);
        let _ = writeln!(
            page,
            "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{2}: {0}</figcaption></figure>",
            escaped(&one.case.name),
            STANDARD.encode(png(&picture)?),
            one.case.item
        );
        rows.push(picture);
    }
    page += "</body>\n</html>\n";
    std::fs::write(folder.join("index.html"), page)?;
    std::fs::write(folder.join("table.md"), table)?;
    if !rows.is_empty() {
        std::fs::write(folder.join("sheet.png"), png(&stacked(&rows))?)?;
    }
    Ok(())
}

fn summary(answered: &[Answered]) -> String {
    let wrong = |of: &dyn Fn(&Answered) -> Option<usize>| {
        answered
            .iter()
            .filter(|one| of(one).is_some_and(|wrong| wrong > 0))
            .count()
    };
    let asked = answered.iter().filter(|one| one.pov_ray.is_some()).count();
    format!(
        "<p>{} cases. povr is wrong in {}; POV-Ray, asked {asked} of them, in {}.</p>\n",
        answered.len(),
        wrong(&|one| Some(one.povr.wrong)),
        wrong(&|one| one.pov_ray.as_ref().map(|outcome| outcome.wrong))
    )
}

/// Whether there are pictures worth a look.
fn is_shown(one: &Answered) -> bool {
    let has_picture = !matches!(
        one.case.asks,
        Asks::Rays(_) | Asks::Refused { .. } | Asks::Sound(_)
    );
    let is_wrong = |outcome: &Outcome| outcome.wrong > 0;
    has_picture && (is_wrong(&one.povr) || one.pov_ray.as_ref().is_some_and(is_wrong))
}

fn row(page: &mut String, table: &mut String, one: &Answered) {
    let case = &one.case;
    let pov_ray = one.pov_ray.as_ref().map(|outcome| outcome.wrong);
    let mut remark = String::new();
    if pov_ray.is_some_and(|wrong| wrong > 0) {
        remark.push_str(why(case.item));
    }
    if let Some(because) = case.no_pov_ray {
        let _ = write!(remark, "POV-Ray not asked: {because}");
    }
    if let (Some((_, because)), true) = (case.allowed, one.povr.wrong > 0) {
        let _ = write!(remark, " povr: {because}");
    }
    let told = pov_ray.map_or_else(|| "–".to_owned(), |wrong| wrong.to_string());
    let class = |is_bad: bool| if is_bad { " class=\"bad\"" } else { "" };
    let _ = writeln!(
        page,
        "<tr><td>{}</td><td class=\"text\">{}</td><td>{}</td><td{}>{told}</td><td{}>{}</td><td class=\"text\">{}</td></tr>",
        case.item,
        escaped(&case.name),
        one.povr.decided,
        class(pov_ray.is_some_and(|wrong| wrong > 0)),
        class(one.povr.wrong > 0),
        one.povr.wrong,
        escaped(&remark)
    );
    let _ = writeln!(
        table,
        "| {} | {} | {} | {told} | {} | {} |",
        case.item,
        case.name.replace('|', "/"),
        one.povr.decided,
        one.povr.wrong,
        remark
    );
}

fn stacked(rows: &[RgbImage]) -> RgbImage {
    let width = rows.iter().map(RgbImage::width).max().unwrap_or(1);
    let gap = 4;
    let height = rows.iter().map(|row| row.height() + gap).sum();
    let mut sheet = RgbImage::from_pixel(width, height, Rgb([255; 3]));
    let mut top = 0;
    for row in rows {
        imageops::replace(&mut sheet, row, 0, i64::from(top));
        top += row.height() + gap;
    }
    sheet
}

fn png(picture: &RgbImage) -> Result<Vec<u8>, Error> {
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(Error::other)?;
    Ok(bytes.into_inner())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

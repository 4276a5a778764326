//! The report: a page, a sheet of pictures, and the table as text.

use crate::Answered;
use crate::case::{Asks, Outcome};
use crate::curves::Curve;
use crate::items::{ITEMS, why};
use crate::{montage, sheet};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::{ImageFormat, RgbImage};
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
.plots { display: flex; flex-wrap: wrap; gap: 1rem; } .plots svg { flex: 1 1 560px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(592px, 1fr)); gap: 1.2rem 1.5rem; }
figure { margin: 0; } figure img { max-width: 100%; image-rendering: pixelated; display: block; }
figcaption { font-size: 0.85rem; }
.heads { display: grid; grid-template-columns: repeat(4, 148px); font-size: 0.75rem; color: #666; }
.first { color: #c83c28; } .second { color: #146ebe; } summary { cursor: pointer; font-weight: 600; margin: 0.6rem 0; }
nav { margin: 0.6rem 0; } nav a { margin-right: 1.2rem; }
";

/// Writes `index.html`, `sheet.png`, `items.md` and `table.md`.
pub(crate) fn write(folder: &Path, answered: &[Answered], curves: &[Curve]) -> Result<(), Error> {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>povr: stability</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>Right where rounding goes wrong</h1>\n\
         <p>A catalogue of hard scenes and rays, drawn by POV-Ray 3.7 and by povr. What each pixel shows is worked out with \
         numbers of 77 digits. A pixel is <em>certain</em> if its answer does not change with a millionth of its width, nor \
         with half a step of the scene's own numbers; only certain ones are counted.</p>\n{}\
         <nav><a href=\"#items\">Items</a><a href=\"#unit\">Unit and place</a><a href=\"#pictures\">Pictures</a>\
         <a href=\"#roots\">Root finders</a><a href=\"#cases\">All cases</a></nav>\n",
        summary(answered)
    );
    let mut items = String::new();
    let mut list = String::new();
    for (number, name) in (1..).zip(ITEMS) {
        item_row(&mut items, &mut list, number, name, answered);
    }
    let _ = write!(
        page,
        "<h2 id=\"items\">Items</h2>\n<div class=\"wide\"><table>\n<thead><tr><th>item</th><th class=\"text\">about</th>\
         <th>cases</th><th>certain pixels, rays or scenes</th><th>POV-Ray wrong</th><th>povr wrong</th>\
         <th class=\"text\">why POV-Ray is wrong</th></tr></thead>\n<tbody>\n{items}</tbody></table></div>\n\
         <p>– : POV-Ray was not asked.</p>\n"
    );
    page += "<h2 id=\"unit\">Unit and place</h2>\n<p>One room with every kind of solid, lit, in other units of length and \
        at other places. Dashed: the share of pixels that are certain. From 10^16 on the places of camera and light \
        are rounded to the next number that there is; the answers are those of the scene with them there. povr draws what \
        stands far from the origin around the camera.</p>\n\
        <div class=\"plots\">\n";
    for curve in curves {
        page += &curve.svg();
    }
    page += "</div>\n<h2 id=\"pictures\">Pictures</h2>\n\
        <p>Of the cases with something wrong. Wrong pixels are <span class=\"first\">red</span> where POV-Ray is wrong, \
        <span class=\"second\">blue</span> where povr is, violet where both are. Stripes: there is no picture.</p>\n\
        <div class=\"pictures\">\n";
    let mut rows = Vec::new();
    for one in answered.iter().filter(|one| is_shown(one)) {
        let outcomes: Vec<&Outcome> = one.pov_ray.iter().chain([&one.povr]).collect();
        let picture = sheet::row(&one.case, &outcomes);
        let caption = caption(one);
        let heads: Vec<&str> = ["right", "POV-Ray", "povr", "wrong pixels"]
            .into_iter()
            .filter(|head| one.pov_ray.is_some() || *head != "POV-Ray")
            .collect();
        let _ = writeln!(
            page,
            "<figure><figcaption>{}</figcaption><div class=\"heads\"><span>{}</span></div>\
             <img alt=\"{0}\" src=\"data:image/png;base64,{}\"></figure>",
            escaped(&caption),
            heads.join("</span><span>"),
            STANDARD.encode(png(&picture)?),
        );
        rows.push((caption, picture));
    }
    page += "</div>\n<div id=\"roots\">\n";
    if let Ok(roots) = std::fs::read_to_string(folder.join("root_error.html")) {
        page += &roots;
    }
    page += "</div>\n<h2 id=\"cases\">All cases</h2>\n<details><summary>Table</summary><div class=\"wide\"><table>\n\
        <thead><tr><th>item</th><th class=\"text\">case</th><th>certain</th>\
        <th>POV-Ray wrong</th><th>povr wrong</th><th class=\"text\">remark</th></tr></thead>\n<tbody>\n";
    let mut table = "| item | case | certain | POV-Ray wrong | povr wrong | remark |\n|--:|---|--:|--:|--:|---|\n".to_owned();
    for one in answered {
        row(&mut page, &mut table, one);
    }
    page += "</tbody></table></div></details>\n</body>\n</html>\n";
    std::fs::write(folder.join("index.html"), page)?;
    std::fs::write(folder.join("table.md"), table)?;
    let head = "| item | about | cases | certain | POV-Ray wrong | povr wrong | why POV-Ray is wrong |\n\
        |--:|---|--:|--:|--:|--:|---|\n";
    std::fs::write(folder.join("items.md"), format!("{head}{list}"))?;
    if !rows.is_empty() {
        std::fs::write(folder.join("sheet.png"), png(&montage::of(&rows)?)?)?;
    }
    Ok(())
}

fn caption(one: &Answered) -> String {
    let (case, certain) = (&one.case, one.povr.decided);
    let of = |outcome: &Outcome| outcome.wrong.to_string();
    let pov_ray = one
        .pov_ray
        .as_ref()
        .map_or_else(|| "not asked".to_owned(), of);
    format!(
        "{} {}: POV-Ray {pov_ray}, povr {} of {certain}",
        case.item, case.name, one.povr.wrong
    )
}

/// One item in numbers, for the page and as text.
fn item_row(page: &mut String, list: &mut String, item: u8, name: &str, answered: &[Answered]) {
    let own = || answered.iter().filter(|one| one.case.item == item);
    if own().next().is_none() {
        return;
    }
    let outcomes: Vec<&Outcome> = own().filter_map(|one| one.pov_ray.as_ref()).collect();
    let wrong: usize = outcomes.iter().map(|outcome| outcome.wrong).sum();
    let pov_ray = if outcomes.is_empty() {
        "–".to_owned()
    } else {
        wrong.to_string()
    };
    let reason = if wrong > 0 { why(item) } else { "" };
    let cases = own().count();
    let certain: usize = own().map(|one| one.povr.decided).sum();
    let povr: usize = own().map(|one| one.povr.wrong).sum();
    let class = |is_bad: bool| if is_bad { " class=\"bad\"" } else { "" };
    let _ = writeln!(
        page,
        "<tr><td>{item}</td><td class=\"text\">{}</td><td>{cases}</td><td>{certain}</td><td{}>{pov_ray}</td>\
         <td{}>{povr}</td><td class=\"text\">{}</td></tr>",
        escaped(name),
        class(wrong > 0),
        class(povr > 0),
        escaped(reason)
    );
    let _ = writeln!(
        list,
        "| {item} | {name} | {cases} | {certain} | {pov_ray} | {povr} | {reason} |"
    );
}

fn summary(answered: &[Answered]) -> String {
    let wrong = |of: &dyn Fn(&Answered) -> Option<usize>| {
        answered
            .iter()
            .filter(|one| of(one).is_some_and(|wrong| wrong > 0))
            .count()
    };
    let compared = answered.iter().filter(|one| one.pov_ray.is_some()).count();
    format!(
        "<p>{} cases. povr is wrong in {}; POV-Ray, asked {compared} of them, in {}.</p>\n",
        answered.len(),
        wrong(&|one| Some(one.povr.wrong)),
        wrong(&|one| one.pov_ray.as_ref().map(|outcome| outcome.wrong))
    )
}

/// True if its pictures are worth showing.
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
    let pov_ray_text = pov_ray.map_or_else(|| "–".to_owned(), |wrong| wrong.to_string());
    let class = |is_bad: bool| if is_bad { " class=\"bad\"" } else { "" };
    let _ = writeln!(
        page,
        "<tr><td>{}</td><td class=\"text\">{}</td><td>{}</td><td{}>{pov_ray_text}</td><td{}>{}</td><td class=\"text\">{}</td></tr>",
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
        "| {} | {} | {} | {pov_ray_text} | {} | {} |",
        case.item,
        case.name.replace('|', "/"),
        one.povr.decided,
        one.povr.wrong,
        remark
    );
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

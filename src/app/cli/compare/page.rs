//! The report as one self-contained page: every comparison with its pictures and numbers, with sorting, filters, and a
//! viewer. Without scripts it is a table, worst first.

use std::fmt::Write;

use super::row::{Row, Status};
use super::table::Total;
use crate::app::page::{Page, escaped, png_url};

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The header of a page.
pub(super) struct About<'a> {
    /// Follows the result in the title.
    pub(super) title: &'a str,
    /// A sentence, as HTML.
    pub(super) text: String,
    /// Names of the two pictures.
    pub(super) sides: (&'a str, &'a str),
}

/// The columns: key, title, description.
const COLUMNS: [(&str, &str, &str); 9] = [
    ("differ", "differ %", "pixels that differ at all"),
    (
        "many",
        "by >1 %",
        "pixels that are off by more than one step",
    ),
    (
        "rms",
        "RMS",
        "root of the mean squared difference of the channels, in steps",
    ),
    ("psnr", "PSNR", "peak signal-to-noise ratio in decibels"),
    (
        "max",
        "max",
        "the largest difference of a channel, in steps",
    ),
    ("flip", "FLIP", "how different the pictures look, 0 to 1"),
    ("povray", "POV-Ray s", "seconds of the whole process"),
    ("povr", "povr s", "seconds of the whole process"),
    ("ratio", "faster ×", "POV-Ray's time over povr's"),
];

/// The page.
pub(super) fn html(rows: &[Row], total: &Total, about: &About<'_>) -> String {
    let headline = headline(rows, total);
    let mut page = format!(
        "<h1>{}</h1>\n<p class=\"quiet\">{}</p>\n",
        escaped(&headline),
        about.text
    );
    if let Some(faster) = total.faster {
        // Writing to a string cannot fail.
        let _ = writeln!(
            page,
            "<p class=\"quiet\">Where both draw: POV-Ray {:.1} s, povr {:.1} s; povr is {faster:.1} times as fast \
             (geometric mean over scenes).</p>",
            total.povray_seconds, total.povr_seconds
        );
    }
    words(&mut page, total);
    bar(&mut page, total);
    page += "<div class=\"wide\"><table class=\"scenes\">\n<thead><tr>\
             <th class=\"left\" data-key=\"name\"><button>scene</button></th><th class=\"left\">";
    let _ = write!(
        page,
        "{} · {} · difference",
        escaped(about.sides.0),
        escaped(about.sides.1)
    );
    page += "</th>";
    for (key, title, what) in COLUMNS {
        let _ = write!(
            page,
            "<th data-key=\"{key}\" title=\"{what}\"><button>{title}</button></th>"
        );
    }
    page += "</tr></thead>\n<tbody class=\"rows\">\n";
    for row in rows {
        table_row(&mut page, row, about);
    }
    page += "</tbody></table>\n<table class=\"tiles\"><tbody></tbody></table></div>\n<p id=\"empty\" hidden>No scenes match the filter.</p>\n";
    page += VIEWER;
    let _ = write!(page, "<script>\n{SCRIPT}</script>\n");
    Page {
        title: &format!("{headline} – {}", about.title),
        style: STYLE,
        body: &page,
    }
    .html()
}

/// The result in a few words.
fn headline(rows: &[Row], total: &Total) -> String {
    let faster = total
        .faster
        .map_or_else(String::new, |faster| format!(" · {faster:.1} × as fast"));
    if let [row] = rows {
        let result = match (&row.numbers, row.status) {
            (Some(n), _) if n.same == n.pixels => "equal in every pixel".to_owned(),
            (Some(n), _) => format!("{:.3} % of the pixels differ", n.differing_percent),
            (None, status) => status.title().to_lowercase(),
        };
        return format!("{}: {result}{faster}", row.name);
    }
    let passes = total.counts.get(&Status::Pass).unwrap_or(&0);
    format!("{passes} of {} match{faster}", total.scenes)
}

const VIEWER: &str = "<dialog aria-label=\"viewer\"><div class=\"viewer\"><header><h2></h2>\
    <button data-mode=\"beside\" title=\"1\">side by side</button><button data-mode=\"slider\" title=\"2\">slider</button>\
    <button data-mode=\"flicker\" title=\"3\">flicker</button><button data-mode=\"difference\" title=\"4\">difference</button>\
    <select id=\"zoom\" aria-label=\"zoom\"><option value=\"fit\">fit</option><option value=\"1\">1×</option>\
    <option value=\"2\">2×</option><option value=\"4\">4×</option><option value=\"8\">8×</option></select>\
    <button id=\"previous\" title=\"left arrow\">‹</button><button id=\"next\" title=\"right arrow\">›</button>\
    <button id=\"close\">close</button></header><div class=\"stage\"></div>\
    <footer><span id=\"numbers\"></span><input type=\"range\" id=\"slide\" min=\"0\" max=\"100\" step=\"0.2\" value=\"50\" \
    aria-label=\"slider\"><span id=\"pixel\"></span></footer></div></dialog>\n";

/// The table of missing keywords.
fn words(page: &mut String, total: &Total) {
    if total.missing.is_empty() {
        return;
    }
    *page += "<details><summary>What povr cannot draw yet, by missing word</summary>\
              <table class=\"words\"><thead><tr><th>word</th><th>scenes</th><th>lack nothing else</th></tr></thead><tbody>\n";
    for missing in &total.missing {
        let word = escaped(&missing.word);
        let _ = writeln!(
            page,
            "<tr><td><button data-word=\"{word}\"><code>{word}</code></button></td><td>{}</td><td>{}</td></tr>",
            missing.scenes, missing.alone
        );
    }
    *page += "</tbody></table></details>\n";
}

/// The sticky bar: the filter, a button for each status, the order, and the scale of the differences.
fn bar(page: &mut String, total: &Total) {
    *page += "<div class=\"bar\"><input type=\"search\" id=\"search\" placeholder=\"filter by name or word\" \
              aria-label=\"filter\">";
    for (status, count) in &total.counts {
        let _ = write!(
            page,
            "<button class=\"chip {class}\" data-status=\"{class}\" aria-pressed=\"true\" \
             title=\"shift: only these\">{count} {}</button>",
            status.title(),
            class = class(*status)
        );
    }
    *page += "<select id=\"order\" aria-label=\"order\"><option value=\"worst-\">worst first</option>\
              <option value=\"name+\">by name</option>";
    for (key, title, _) in COLUMNS {
        let up = matches!(key, "psnr" | "ratio");
        let _ = write!(
            page,
            "<option value=\"{key}{}\">{title}, {} first</option>",
            if up { '+' } else { '-' },
            if up { "lowest" } else { "highest" }
        );
    }
    let _ = writeln!(
        page,
        "</select><label><input type=\"checkbox\" id=\"grid\" checked> tiles for PASS</label><span class=\"quiet\" id=\"shown\">{}</span><span class=\"scale\" title=\"colours of differences, in \
         steps of 1/255\"><canvas></canvas><span><i>1</i><i>4</i><i>16</i><i>64</i><i>255</i></span></span></div>",
        total.scenes
    );
}

fn table_row(page: &mut String, row: &Row, about: &About<'_>) {
    let class = class(row.status);
    let name = escaped(&row.name);
    let why = escaped(&row.why);
    let title = row.status.title();
    let cells = cells(row);
    let _ = write!(
        page,
        "<tr data-name=\"{name}\" data-status=\"{class}\" data-text=\"{} {} {}\" data-worst=\"{:.6}\" \
         data-left=\"{}\" data-right=\"{}\" data-numbers=\"{}\"",
        name.to_lowercase(),
        why.to_lowercase(),
        title.to_lowercase(),
        row.badness(),
        escaped(about.sides.0),
        escaped(about.sides.1),
        escaped(&spoken(row)),
    );
    for ((key, ..), (number, _)) in COLUMNS.iter().zip(&cells) {
        if let Some(number) = number {
            let _ = write!(page, " data-{key}=\"{number:.6}\"");
        }
    }
    if let Some((x, y)) = row.numbers.as_ref().and_then(|numbers| numbers.worst) {
        let reduced = row.shown.reduced.max(1);
        let _ = write!(
            page,
            " data-x=\"{}\" data-y=\"{}\"",
            x / reduced,
            y / reduced
        );
    }
    let _ = write!(
        page,
        "><td class=\"name\"><span class=\"badge {class}\">{title}</span> <code>{name}</code>\
         <span class=\"why\">{why}</span></td><td class=\"left shown\"><div class=\"pictures\">"
    );
    let shown = &row.shown;
    let pictures = [
        ("theirs", "slider", about.sides.0, &shown.theirs),
        ("ours", "slider", about.sides.1, &shown.ours),
        ("steps", "difference", "difference", &shown.steps),
    ];
    for (class, opens, what, bytes) in pictures {
        match bytes {
            Some(bytes) => {
                let _ = write!(
                    page,
                    "<button data-open=\"{opens}\"><img class=\"{class}\" loading=\"lazy\" decoding=\"async\" \
                     alt=\"{name}: {}\" src=\"{}\"></button>",
                    escaped(what),
                    png_url(bytes)
                );
            }
            None => *page += "<span class=\"none\">none</span>",
        }
    }
    *page += "</div></td>";
    for ((_, title, _), (_, text)) in COLUMNS.iter().zip(&cells) {
        let _ = write!(page, "<td data-label=\"{title}\">{text}</td>");
    }
    *page += "</tr>\n";
}

/// The numbers of a row by column, with their text.
fn cells(row: &Row) -> [(Option<f64>, String); 9] {
    let n = row.numbers.as_ref();
    let cell = |value: Option<f64>, digits: usize| {
        let text = value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"));
        (value, text)
    };
    let count = crate::app::compare::as_f64;
    let of_full = n.is_some_and(|n| n.full > 1.0);
    let psnr = match n {
        Some(n) if n.psnr.is_none() => (Some(999.0), "∞".to_owned()),
        _ => cell(n.and_then(|n| n.psnr), 1),
    };
    [
        cell(n.map(|n| n.differing_percent), 3),
        cell(
            n.map(|n| 100.0 * count(n.off_by_many) / count(n.pixels.max(1))),
            3,
        ),
        cell(n.map(|n| n.rms), 3),
        psnr,
        cell(n.map(|n| n.max), if of_full { 0 } else { 4 }),
        cell(n.map(|n| n.flip), 4),
        cell(row.povray_seconds, 2),
        cell(row.povr_seconds, 3),
        cell(row.ratio(), 1),
    ]
}

/// The numbers of a row in a sentence, for the viewer.
fn spoken(row: &Row) -> String {
    let Some(n) = &row.numbers else {
        return row.why.clone();
    };
    let position = n.worst.map_or_else(String::new, |(x, y)| {
        format!(", at most {:.4} at column {x}, row {y}", n.max).replace(".0000", "")
    });
    let reduced = match row.shown.reduced {
        0 | 1 => String::new(),
        times => format!("; shown {times} times smaller"),
    };
    format!(
        "{} pixels: {} the same, {} off by one, {} off by more{position}; mean {:.4}, RMS {:.4}, FLIP {:.4}{reduced}",
        n.pixels, n.same, n.off_by_one, n.off_by_many, n.mean, n.rms, n.flip
    )
}

fn class(status: Status) -> &'static str {
    match status {
        Status::Failure => "failure",
        Status::Size => "size",
        Status::Lost => "lost",
        Status::Late => "late",
        Status::Alone => "alone",
        Status::Missing => "missing",
        Status::Warning => "warning",
        Status::Pass => "pass",
        Status::Refused => "refused",
    }
}

//! A self-contained page with everything: the plot, the table, the pictures and their differences.

use std::fmt::Write as _;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::CurveError;
use super::error::ENLARGED;
use super::plot::best;
use super::setting::Family;
use super::store::{Measured, Report, Spread};

const STYLE: &str = "
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 1540px; padding: 1rem 1.5rem 4rem; color: #1c1c1c; background: #fff;
  font: 16px/1.45 system-ui, 'DejaVu Sans', sans-serif; }
h1 { font-size: 1.6rem; margin: 0.5rem 0; } h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; }
.plot svg { width: 100%; height: auto; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 0.9rem; }
th, td { padding: 0.25rem 0.6rem; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } thead th { border-bottom: 2px solid #888; }
td:first-child::before { content: ''; display: inline-block; width: 0.7em; height: 0.7em; border-radius: 50%;
  background: var(--family); margin-right: 0.5em; }
code { font-family: 'DejaVu Sans Mono', ui-monospace, monospace; font-size: 0.9em; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); gap: 1.2rem; }
figure { margin: 0; border-top: 3px solid var(--family, #888); padding-top: 0.4rem; }
figure .pair { display: grid; grid-template-columns: 1fr 1fr; gap: 4px; }
img { width: 100%; height: auto; display: block; image-rendering: auto; background: #000; }
figcaption { font-size: 0.85rem; margin-top: 0.3rem; overflow-wrap: anywhere; }
.truth { max-width: 480px; margin-bottom: 24px; }
@media (max-width: 700px) { body { padding: 0.5rem; } }
";

/// The page.
pub(super) fn html(report: &Report, svg: &str, pictures: &Path) -> Result<String, CurveError> {
    let truth = &report.truth;
    let scene = escaped(&report.scene);
    let (width, height) = truth.size;
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Error against run time: {scene}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
         <h1>Error against run time: {scene}</h1>\n\
         <p>{width} × {height} pixels, {} thread(s). Errors are in linear light from 0 (black) to 1 (white), against a \
         reference image with {:.0} samples per pixel, whose own error is estimated at {:.5} (root mean square). Times are \
         processor seconds of tracing, the median of the renders. POV-Ray's pictures are measured against povr's too: what \
         the programs draw differently is a level below which its error does not fall.</p>\n{}\
         <p>Each dot is one setting: time across, error up (both on log scales). Lower left is better. \
         Lines join the settings that no other of their kind betters.</p>\n\
         <section class=\"plot\" aria-label=\"plot\">\n{svg}\n</section>\n",
        report.threads,
        truth.samples_per_pixel,
        truth.rms,
        summary(report),
    );
    // A single rendering has no spread.
    let has_spread = report.measured.iter().any(|m| m.processor.runs > 1);
    let spread = if has_spread {
        "<th>from – to</th>"
    } else {
        ""
    };
    let _ = writeln!(
        page,
        "<h2>Table</h2>\n<p><b>RMSE</b>: root mean square error. <b>99.9 %</b>: the error that 99.9 % of the pixels do not exceed; \
         <b>max</b>: that of the worst. <b>FLIP</b>: how different a person finds both pictures, 0 for equal ones. \
         <b>estimated</b>: povr's own estimate of its RMSE.</p>\n\
         <div class=\"wide\"><table>\n<thead><tr><th>setting</th><th>CPU s</th>{spread}<th>wall s</th>{spread}\
         <th>samples per pixel</th><th>RMSE</th><th>estimated</th><th>99.9 %</th><th>max</th><th>FLIP</th></tr></thead>\n<tbody>"
    );
    for m in &report.measured {
        row(&mut page, m, has_spread);
    }
    page += "</tbody></table></div>\n<h2>Pictures</h2>\n";
    let _ = writeln!(
        page,
        "<p>Left: the image. Right: its error, amplified {ENLARGED:.0}×.</p>\n\
         <figure class=\"truth\"><img alt=\"the reference image\" src=\"{}\"><figcaption>The reference image</figcaption></figure>\n\
         <div class=\"pictures\">",
        embedded(&pictures.join("truth.png"))?
    );
    for m in &report.measured {
        let name = name(m);
        let stem = &m.file_stem;
        let _ = writeln!(
            page,
            "<figure style=\"--family: {}\"><div class=\"pair\"><img alt=\"{name}\" src=\"{}\">\
             <img alt=\"{name}: difference\" src=\"{}\"></div>\
             <figcaption><code>{name}</code>: {:.3} s, RMSE {:.5}</figcaption></figure>",
            color(m.family),
            embedded(&pictures.join(format!("{stem}.png")))?,
            embedded(&pictures.join(format!("{stem}-difference.png")))?,
            m.processor.median,
            m.errors.rmse
        );
    }
    page += "</div>\n</body>\n</html>\n";
    Ok(page)
}

/// The cost of povr's own method beside POV-Ray's best for the same error, if both were measured.
fn summary(report: &Report) -> String {
    let of = |family: Family| {
        let ours = report.measured.iter().filter(|m| m.family == family);
        let mut points: Vec<(f64, f64)> =
            ours.map(|m| (m.processor.median, m.errors.rmse)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        best(&points)
    };
    let (ours, theirs) = (of(Family::Converging), of(Family::PovRay));
    let reached = |points: &[(f64, f64)]| points.last().map(|&(_, error)| error);
    let (Some(our_best), Some(their_best)) = (reached(&ours), reached(&theirs)) else {
        return String::new();
    };
    let error = our_best.max(their_best);
    let (Some(our_cost), Some(their_cost)) = (cost(error, &ours), cost(error, &theirs)) else {
        return String::new();
    };
    format!(
        "<p>For a root mean square error of {error:.5} <code>povr --error</code> needs {our_cost:.3} processor seconds, POV-Ray \
         with its best setting {their_cost:.3}: <b>{:.1} times</b> as many.</p>\n",
        their_cost / our_cost.max(f64::MIN_POSITIVE)
    )
}

/// The cost of an error on a line from fast to accurate: logarithmic interpolation between two points.
fn cost(error: f64, points: &[(f64, f64)]) -> Option<f64> {
    let first = points.first()?;
    if first.1 <= error {
        return Some(first.0);
    }
    let pair = points.windows(2).find(|pair| pair[1].1 <= error)?;
    let ((c0, e0), (c1, e1)) = (pair[0], pair[1]);
    let share = (e0 / error).ln() / (e0 / e1.max(f64::MIN_POSITIVE)).ln();
    Some(c0 * (c1 / c0).powf(share))
}

fn row(page: &mut String, m: &Measured, has_spread: bool) {
    let e = &m.errors;
    let estimated = m
        .estimated
        .map_or_else(|| "–".to_owned(), |(_, rms)| format!("{rms:.5}"));
    let seconds = |spread: &Spread| match has_spread {
        true => format!(
            "<td>{:.3}</td><td>{:.3} – {:.3}</td>",
            spread.median, spread.least, spread.most
        ),
        false => format!("<td>{:.3}</td>", spread.median),
    };
    // Writing to a string cannot fail.
    let _ = writeln!(
        page,
        "<tr style=\"--family: {}\"><td><code>{}</code></td>{}{}<td>{:.2}</td><td>{:.5}</td><td>{estimated}</td>\
         <td>{:.4}</td><td>{:.4}</td><td>{:.5}</td></tr>",
        color(m.family),
        name(m),
        seconds(&m.processor),
        seconds(&m.wall),
        m.samples_per_pixel,
        e.rmse,
        e.p999,
        e.max,
        e.flip
    );
}

fn name(m: &Measured) -> String {
    let program = match m.family {
        Family::PovRay => "povray",
        _ => "povr",
    };
    escaped(&format!("{program} {}", m.switches))
}

fn color(family: Family) -> String {
    let (r, g, b) = family.color();
    format!("rgb({r} {g} {b})")
}

/// A picture as a data URL.
fn embedded(file: &Path) -> Result<String, CurveError> {
    let bytes = std::fs::read(file).map_err(|error| {
        CurveError::new(format!("cannot read `{}`: {error}", file.display()))
            .with_hint("Leave out what was measured before with `--fresh`.")
    })?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(bytes)))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_lie_between_those_of_points() {
        let points = [(1.0, 0.1), (4.0, 0.001)];
        let between = cost(0.01, &points).expect("it is reached");
        assert!((between - 2.0).abs() < 1e-9, "{between}");
        assert_eq!(cost(0.2, &points), Some(1.0));
        assert_eq!(cost(1e-4, &points), None);
    }
}

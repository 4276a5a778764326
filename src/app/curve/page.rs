//! A self-contained page with everything: the plot, the table, the pictures and their differences.

use std::fmt::Write as _;
use std::path::Path;

use super::CurveError;
use super::error::ENLARGED;
use super::plot::{best, dots};
use super::setting::Family;
use super::store::{Measured, Report, Spread};
use crate::app::page::{GALLERY, Page, escaped, png_url};

const STYLE: &str = "\
.plot { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 400px), 1fr)); gap: 0.5rem; margin: 1rem 0; }
.plot svg { width: 100%; height: auto; border-radius: 6px; }
.plot circle.shot { cursor: pointer; stroke: transparent; stroke-width: 10; }
.plot circle.shot:hover, .plot circle.shot:focus { r: 7; outline: none; stroke: #8888; }
@media (prefers-color-scheme: dark) { .plot svg { filter: invert(0.9) hue-rotate(180deg); } }
.wide { background: linear-gradient(to right, var(--paper) 30%, transparent) left / 40px 100% no-repeat local,
  linear-gradient(to left, var(--paper) 30%, transparent) right / 40px 100% no-repeat local,
  linear-gradient(to right, #8885, transparent) left / 14px 100% no-repeat, linear-gradient(to left, #8885, transparent) right / 14px 100% no-repeat; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 0.9rem; }
th, td { padding: 0.25rem 0.6rem; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } thead th { border-bottom: 2px solid var(--quiet); }
td:first-child::before { content: ''; display: inline-block; width: 0.7em; height: 0.7em; border-radius: 50%;
  background: var(--family); margin-right: 0.5em; }
.gallery { grid-template-columns: repeat(auto-fill, minmax(min(100%, 340px), 1fr)); }
figure { border-top: 3px solid var(--family, var(--line)); padding-top: 0.4rem; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 4px; }
.pair img, .stage img { width: 100%; border: 0; border-radius: 0; }
figcaption b { font-weight: 400; }
.truth { max-width: 480px; margin-bottom: 24px; }
.stage { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 300px), 1fr)); gap: 4px; align-content: center; }
.stage img { object-fit: contain; max-height: 100%; }
";
/// Makes the dots of each plot show the picture of their setting: they are the first circles, in the order of
/// `data-dots`.
const DOTS: &str = "<script>
for (const svg of document.querySelectorAll('.plot svg')) {
  const circles = svg.querySelectorAll('circle');
  document.querySelector('.plot').dataset.dots.split(' ').forEach((id, number) => {
    const circle = circles[number], figure = document.getElementById(id);
    if (!circle || !figure) return;
    const title = document.createElementNS('http://www.w3.org/2000/svg', 'title');
    title.textContent = figure.querySelector('figcaption').textContent;
    circle.append(title);
    circle.classList.add('shot');
    circle.setAttribute('tabindex', '0');
    circle.addEventListener('click', () => view(figure));
    circle.addEventListener('keydown', event => { if (event.key === 'Enter') view(figure); });
  });
}
</script>
";

/// The page.
pub(super) fn html(
    report: &Report,
    plots: &[String],
    pictures: &Path,
) -> Result<String, CurveError> {
    let truth = &report.truth;
    let (width, height) = truth.size;
    let headline = headline(report);
    let threads = match report.threads {
        1 => "one thread".to_owned(),
        threads => format!("{threads} threads"),
    };
    let mut page = format!(
        "<h1>{headline}</h1>\n<p class=\"quiet\"><code>{}</code>, {width} × {height} pixels, {threads}. \
         Each dot is one setting, and shows its picture: lower left is better. Lines join the settings that no other of their kind betters.</p>\n\
         <section class=\"plot\" aria-label=\"plot\" data-dots=\"{}\">\n{}</section>\n\
         <details><summary>How it is measured</summary>\n\
         <p>Errors are in linear light from 0 (black) to 1 (white), against a \
         reference image with {:.0} samples per pixel, whose own error is estimated at {:.5} (root mean square). Times are \
         processor seconds of tracing, the median of the renders. POV-Ray's pictures are measured against povr's too: what \
         the programs draw differently is a level below which its error does not fall.</p>\n\
         <p><b>RMSE</b>: root mean square error. <b>99.9 %</b>: the error that 99.9 % of the pixels do not exceed; \
         <b>max</b>: that of the worst. <b>FLIP</b>: how different a person finds both pictures, 0 for equal ones. \
         <b>estimated</b>: povr's own estimate of its RMSE.</p>\n</details>\n",
        escaped(&report.scene),
        dots(report).collect::<Vec<_>>().join(" "),
        plots.concat(),
        truth.samples_per_pixel,
        truth.rms,
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
        "<h2>Table</h2>\n<div class=\"wide\"><table>\n<thead><tr><th>setting</th><th>CPU s</th>{spread}<th>wall s</th>{spread}\
         <th>samples per pixel</th><th>RMSE</th><th>estimated</th><th>99.9 %</th><th>max</th><th>FLIP</th></tr></thead>\n<tbody>"
    );
    let mut rows: Vec<&Measured> = report.measured.iter().collect();
    rows.sort_by_key(|m| m.family);
    for m in rows {
        row(&mut page, m, has_spread);
    }
    page += "</tbody></table></div>\n<h2>Pictures</h2>\n";
    let _ = writeln!(
        page,
        "<p>Left: the image. Right: its error, amplified {ENLARGED:.0}×.</p>\n\
         <figure class=\"truth\" id=\"truth\"><a class=\"shot\" href=\"#truth\"><img alt=\"the reference image\" src=\"{}\"></a>\
         <figcaption><b>The reference image</b></figcaption></figure>\n\
         <div class=\"gallery\">",
        embedded(&pictures.join("truth.png"))?
    );
    for m in &report.measured {
        let name = name(m);
        let stem = &m.file_stem;
        let _ = writeln!(
            page,
            "<figure id=\"{stem}\" style=\"--family: {}\"><a class=\"shot pair\" href=\"#{stem}\"><img alt=\"{name}\" src=\"{}\">\
             <img alt=\"{name}: difference\" src=\"{}\"></a>\
             <figcaption><b><code>{name}</code></b> {} s, RMSE {}</figcaption></figure>",
            color(m.family),
            embedded(&pictures.join(format!("{stem}.png")))?,
            embedded(&pictures.join(format!("{stem}-difference.png")))?,
            digits(m.processor.median),
            digits(m.errors.rmse)
        );
    }
    page += "</div>\n";
    page += GALLERY;
    page += DOTS;
    Ok(Page {
        title: &format!("{headline} – {} – povr curve", report.scene),
        style: STYLE,
        body: &page,
    }
    .html())
}

/// The cost of povr's own method beside POV-Ray's best for the same error, if both were measured.
fn headline(report: &Report) -> String {
    let of = |family: Family| {
        let ours = report.measured.iter().filter(|m| m.family == family);
        let mut points: Vec<(f64, f64)> =
            ours.map(|m| (m.processor.median, m.errors.rmse)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        best(&points)
    };
    let (ours, theirs) = (of(Family::Converging), of(Family::PovRay));
    beside_pov_ray(&ours, &theirs)
        .unwrap_or_else(|| format!("Error against run time: {} settings", report.measured.len()))
}

/// Two lines from fast to accurate: their costs at the smallest error that both reach, or the best of each where the
/// faster line ends before the other begins.
fn beside_pov_ray(ours: &[(f64, f64)], theirs: &[(f64, f64)]) -> Option<String> {
    let ((our_cost, our_error), (their_cost, their_error)) = (*ours.last()?, *theirs.last()?);
    let error = our_error.max(their_error);
    Some(match (cost(error, ours), cost(error, theirs)) {
        (Some(our_cost), Some(their_cost)) => format!(
            "At equal error povr needs {} s, POV-Ray {} s ({:.1} ×)",
            digits(our_cost),
            digits(their_cost),
            their_cost / our_cost.max(f64::MIN_POSITIVE)
        ),
        _ => format!(
            "povr reaches an error of {} in {} s, POV-Ray one of {} in {} s",
            digits(our_error),
            digits(our_cost),
            digits(their_error),
            digits(their_cost)
        ),
    })
}

/// The cost of an error on a line from fast to accurate, logarithmically interpolated between two points; `None` off the
/// line.
fn cost(error: f64, points: &[(f64, f64)]) -> Option<f64> {
    let first = points.first()?;
    if first.1 <= error {
        return (first.1 >= error).then_some(first.0);
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
        .map_or_else(|| "–".to_owned(), |(_, rms)| digits(rms));
    let seconds = |spread: &Spread| match has_spread {
        true => format!(
            "<td>{}</td><td>{} – {}</td>",
            digits(spread.median),
            digits(spread.least),
            digits(spread.most)
        ),
        false => format!("<td>{}</td>", digits(spread.median)),
    };
    // Writing to a string cannot fail.
    let _ = writeln!(
        page,
        "<tr style=\"--family: {}\"><td><code>{}</code></td>{}{}<td>{}</td><td>{}</td><td>{estimated}</td>\
         <td>{}</td><td>{}</td><td>{}</td></tr>",
        color(m.family),
        name(m),
        seconds(&m.processor),
        seconds(&m.wall),
        digits(m.samples_per_pixel),
        digits(e.rmse),
        digits(e.p999),
        digits(e.max),
        digits(e.flip)
    );
}

/// A measurement with three significant digits; repeated runs differ in the third.
fn digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if value.abs() < 1e-6 {
        return format!("{value:.2e}");
    }
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    let decimals = (0..8).find(|&decimals| rounded.abs() * 10f64.powi(decimals) >= 99.5);
    let decimals = usize::try_from(decimals.unwrap_or(8)).unwrap_or(8);
    format!("{rounded:.decimals$}")
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
    Ok(png_url(&bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_lie_between_those_of_points() {
        let points = [(1.0, 0.1), (4.0, 0.001)];
        let between = cost(0.01, &points).expect("it is reached");
        assert!((between - 2.0).abs() < 1e-9, "{between}");
        assert_eq!(cost(0.1, &points), Some(1.0));
        assert_eq!((cost(0.2, &points), cost(1e-4, &points)), (None, None));
    }

    #[test]
    fn measurements_have_three_significant_digits() {
        let values = [0.0, 1.234e-7, 0.000_123_456, 0.009_999, 1.5, 12.345, 1234.5];
        let shown = ["0", "1.23e-7", "0.000123", "0.0100", "1.50", "12.3", "1230"];
        assert_eq!(values.map(digits), shown);
    }

    #[test]
    fn errors_are_called_equal_only_where_both_lines_reach_them() {
        let (ours, theirs) = ([(1.0, 0.04), (4.0, 0.01)], [(2.0, 0.02)]);
        assert_eq!(
            beside_pov_ray(&ours, &theirs).as_deref(),
            Some("At equal error povr needs 2.00 s, POV-Ray 2.00 s (1.0 ×)")
        );
        assert_eq!(
            beside_pov_ray(&ours[1..], &theirs).as_deref(),
            Some("povr reaches an error of 0.0100 in 4.00 s, POV-Ray one of 0.0200 in 2.00 s")
        );
        assert_eq!(beside_pov_ray(&ours, &[]), None);
    }
}

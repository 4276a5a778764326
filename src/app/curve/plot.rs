//! The plot: error over processor time, both logarithmic, a line for each method.

use std::fmt::Display;
use std::ops::Range;

use plotters::coord::combinators::{BindKeyPoints, IntoLogRange};
use plotters::prelude::*;

use super::CurveError;
use super::setting::Family;
use super::store::{Measured, Report};

/// The size of a panel in pixels.
const PANEL: (u32, u32) = (500, 560);
/// Lower limits of the plotted error and time.
const MIN_ERROR: f64 = 1e-6;
const MIN_TIME: f64 = 1e-4;
const FONT: &str = "DejaVu Sans, Liberation Sans, Arial, sans-serif";

/// A panel: its title, and the number of a measurement that it plots.
#[derive(Clone, Copy)]
struct Panel {
    title: &'static str,
    value: fn(&Measured) -> f64,
}

const PANELS: [Panel; 3] = [
    Panel {
        title: "root mean square error, linear light",
        value: |m| m.errors.rmse,
    },
    Panel {
        title: "error that 99.9 % of pixels do not exceed",
        value: |m| m.errors.p999,
    },
    Panel {
        title: "FLIP, mean",
        value: |m| m.errors.flip,
    },
];

/// The plot as SVG: all panels side by side.
pub(super) fn svg(report: &Report) -> Result<String, CurveError> {
    side_by_side(report, &PANELS)
}

/// Each panel of the plot as an SVG of its own.
pub(super) fn panels(report: &Report) -> Result<Vec<String>, CurveError> {
    PANELS
        .iter()
        .map(|&panel| side_by_side(report, &[panel]))
        .collect()
}

/// The settings of the dots of a panel in the order in which they are drawn, by the names of their files.
pub(super) fn dots(report: &Report) -> impl Iterator<Item = &str> {
    let families = Family::ALL
        .iter()
        .flat_map(|&family| of_family(report, family));
    families.map(|m| m.file_stem.as_str())
}

/// The measurements of a family from fast to slow.
fn of_family(report: &Report, family: Family) -> Vec<&Measured> {
    let measured = report.measured.iter().filter(|m| m.family == family);
    let mut measured: Vec<&Measured> = measured.collect();
    measured.sort_by(|a, b| a.processor.median.total_cmp(&b.processor.median));
    measured
}

fn side_by_side(report: &Report, panels: &[Panel]) -> Result<String, CurveError> {
    let mut text = String::new();
    let count = u32::try_from(panels.len()).unwrap_or(1);
    {
        let size = (PANEL.0 * count, PANEL.1);
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE).map_err(|error| refused(&error))?;
        for (area, &panel) in root.split_evenly((1, panels.len())).iter().zip(panels) {
            draw(area, report, panel).map_err(|error| refused(&error))?;
        }
        root.present().map_err(|error| refused(&error))?;
    }
    Ok(text)
}

fn refused(error: &dyn Display) -> CurveError {
    CurveError::new(format!("cannot draw the plot: {error}"))
}

/// The range of some values, a little wider; at least a factor of ten.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (least, most) = values.fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
    if least > most {
        return 0.1..1.0;
    }
    let most = most.max(10.0 * least);
    // Space for the legend.
    least / 1.4..most * 2.0
}

/// Grid lines at 1, 2, and so on to 9 times each power of ten. By default the plot has none below the first power in
/// the range, and two at each power.
fn grid(range: &Range<f64>) -> Vec<f64> {
    let mut lines = Vec::new();
    let mut power = 10f64.powf(range.start.log10().floor());
    while power <= range.end {
        let of_power = (1..10).map(|leading| f64::from(leading) * power);
        lines.extend(of_power.filter(|line| range.contains(line)));
        power *= 10.0;
    }
    lines
}

fn draw<'a>(
    area: &DrawingArea<SVGBackend<'a>, plotters::coord::Shift>,
    report: &Report,
    Panel { title, value }: Panel,
) -> Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>> {
    let time = |m: &Measured| m.processor.median.max(MIN_TIME);
    let value = |m: &Measured| value(m).max(MIN_ERROR);
    let times = range(report.measured.iter().map(time));
    let errors = range(report.measured.iter().map(value));
    let mut chart = ChartBuilder::on(area)
        .caption(title, (FONT, 19))
        .margin(12)
        .x_label_area_size(52)
        .y_label_area_size(82)
        .build_cartesian_2d(
            times.clone().log_scale().with_key_points(grid(&times)),
            errors.clone().log_scale().with_key_points(grid(&errors)),
        )?;
    chart
        .configure_mesh()
        .x_desc("processor seconds of tracing (log scale)")
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .x_label_formatter(&|v| label(*v))
        .y_label_formatter(&|v| label(*v))
        .bold_line_style(BLACK.mix(0.18))
        // They are so dense that they turn the border grey.
        .light_line_style(TRANSPARENT)
        .draw()?;
    for family in Family::ALL {
        let points = of_family(report, family);
        let points: Vec<(f64, f64)> = points.iter().map(|m| (time(m), value(m))).collect();
        if points.is_empty() {
            continue;
        }
        let (r, g, b) = family.color();
        let color = RGBColor(r, g, b);
        // POV-Ray's settings have three parameters; the line joins the Pareto-optimal points.
        let line = LineSeries::new(best(&points), color.stroke_width(2));
        chart
            .draw_series(line)?
            // Browsers draw wider letters than the width of the frame allows for.
            .label(format!("{}   ", family.title()))
            .legend(move |(x, y)| Circle::new((x + 8, y), 4, color.filled()));
        let dots = points
            .iter()
            .map(|&point| Circle::new(point, 4, color.filled()));
        chart.draw_series(dots)?;
    }
    chart
        .configure_series_labels()
        // Points that are both fast and accurate lie at the lower left.
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.3))
        .label_font((FONT, 15))
        .draw()?;
    Ok(())
}

/// The Pareto-optimal points, from fast to slow.
pub(super) fn best(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut least = f64::INFINITY;
    let mut optimal = Vec::new();
    for &(time, error) in points {
        if error < least {
            least = error;
            optimal.push((time, error));
        }
    }
    optimal
}

/// The label of a grid line: the number, if it begins with 1, 2 or 5; there is no space for all.
fn label(v: f64) -> String {
    let leading = v / 10f64.powf((v.log10() + 1e-9).floor());
    let is_labelled = [1.0, 2.0, 5.0]
        .iter()
        .any(|digit| (leading - digit).abs() < 1e-6);
    if is_labelled { short(v) } else { String::new() }
}

/// A number without superfluous digits.
fn short(v: f64) -> String {
    if (0.001..1000.0).contains(&v) {
        let text = format!("{v:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{v:e}")
    }
}

/// The same plot as a PNG file.
#[cfg(feature = "plot-png")]
pub(super) fn png(svg: &str) -> Result<Vec<u8>, CurveError> {
    use resvg::{tiny_skia, usvg};

    let mut options = usvg::Options {
        font_family: "DejaVu Sans".to_owned(),
        ..usvg::Options::default()
    };
    options.fontdb_mut().load_system_fonts();
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| refused(&error))?;
    let size = tree.size().to_int_size();
    let mut pixmap = tiny_skia::Pixmap::new(size.width(), size.height())
        .ok_or_else(|| refused(&"no memory for it"))?;
    resvg::render(
        &tree,
        tiny_skia::Transform::identity(),
        &mut pixmap.as_mut(),
    );
    pixmap.encode_png().map_err(|error| refused(&error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_joins_pareto_optimal_points() {
        let points = [(1.0, 0.5), (2.0, 0.7), (3.0, 0.2), (4.0, 0.3)];
        assert_eq!(best(&points), [(1.0, 0.5), (3.0, 0.2)]);
    }

    #[test]
    fn lines_of_the_grid_reach_both_ends() {
        let lines = grid(&(0.00035..0.021));
        assert_eq!(lines.len(), 6 + 9 + 2);
        assert!((lines[0] - 0.0004).abs() < 1e-12, "{lines:?}");
        assert!((lines[16] - 0.02).abs() < 1e-12, "{lines:?}");
    }

    #[test]
    fn numbers_of_axes_are_short() {
        for (v, expected) in [
            (0.01, "0.01"),
            (100.0, "100"),
            (1e-5, "1e-5"),
            (0.0025, "0.0025"),
        ] {
            assert_eq!(short(v), expected);
            assert_eq!(label(v).is_empty(), v == 0.0025);
        }
    }
}

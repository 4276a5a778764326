//! `plot FILE.json FOLDER`: logarithmic plots and one page with all of them, from
//! `[{"name", "title", "x", "y", "series": [{"name", "points": [[x, y], ...]}], "notes": [text, ...]}, ...]`.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for the terminal"
)]

use plotters::coord::combinators::IntoLogRange;
use plotters::prelude::*;
use serde::Deserialize;
use std::error::Error;
use std::ops::Range;
use std::path::Path;
use std::process::ExitCode;

const SIZE: (u32, u32) = (760, 460);
const FONT: &str = "DejaVu Sans, Liberation Sans, Arial, sans-serif";

#[derive(Deserialize)]
struct Plot {
    /// Of the file.
    name: String,
    title: String,
    x: String,
    y: String,
    series: Vec<Series>,
    #[serde(default)]
    notes: Vec<String>,
}

#[derive(Deserialize)]
struct Series {
    name: String,
    points: Vec<(f64, f64)>,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, folder] = arguments.as_slice() else {
        eprintln!("plot FILE.json FOLDER");
        return ExitCode::FAILURE;
    };
    match write_all(Path::new(file), Path::new(folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("plot: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes each plot as a file of its own, and the page.
fn write_all(file: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    let plots: Vec<Plot> = serde_json::from_reader(std::fs::File::open(file)?)?;
    std::fs::create_dir_all(folder)?;
    let mut page = String::from(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Scaling</title><style>\
        body { font: 16px sans-serif; margin: 2em auto; max-width: 60em; color: #222; }\
        svg { max-width: 100%; height: auto; } li { margin: .2em 0; }</style><h1>Scaling</h1>\n",
    );
    for plot in &plots {
        let mut text = String::new();
        draw(plot, &mut text).map_err(|error| format!("{}: {error}", plot.name))?;
        std::fs::write(folder.join(format!("{}.svg", plot.name)), &text)?;
        page += &format!("<section><h2>{}</h2>\n{text}\n<ul>", escaped(&plot.title));
        for note in &plot.notes {
            page += &format!("<li>{}</li>", escaped(note));
        }
        page += "</ul></section>\n";
    }
    std::fs::write(folder.join("index.html"), page + "</html>\n")?;
    println!("{}", folder.join("index.html").display());
    Ok(())
}

fn draw<'a>(plot: &Plot, text: &'a mut String) -> Result<(), Box<dyn Error + 'a>> {
    let points = || plot.series.iter().flat_map(|series| &series.points);
    let area = SVGBackend::with_string(text, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .margin(14)
        .x_label_area_size(46)
        .y_label_area_size(76)
        .build_cartesian_2d(
            range(points().map(|point| point.0)).log_scale(),
            range(points().map(|point| point.1)).log_scale(),
        )?;
    chart
        .configure_mesh()
        .x_desc(plot.x.as_str())
        .y_desc(plot.y.as_str())
        .label_style((FONT, 13))
        .axis_desc_style((FONT, 14))
        .x_label_formatter(&|v| short(*v))
        .y_label_formatter(&|v| short(*v))
        .light_line_style(TRANSPARENT)
        .draw()?;
    for (number, series) in plot.series.iter().enumerate() {
        let color = Palette99::pick(number).to_rgba();
        let line = LineSeries::new(series.points.clone(), color.stroke_width(2));
        chart
            .draw_series(line)?
            .label(series.name.as_str())
            .legend(move |(x, y)| Circle::new((x + 8, y), 4, color.filled()));
        let dots = series.points.iter();
        chart.draw_series(dots.map(|at| Circle::new(*at, 3, color.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.3))
        .label_font((FONT, 13))
        .draw()?;
    area.present()?;
    Ok(())
}

/// The range of some values, a little wider.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let positive = values.filter(|value| *value > 0.0);
    let (least, most) = positive.fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
    if least > most {
        return 0.1..1.0;
    }
    least / 1.5..most * 1.5
}

/// A number in short notation.
fn short(value: f64) -> String {
    if (0.001..10_000.0).contains(&value) {
        // Ticks are made by multiplication and carry its rounding.
        format!("{}", (value * 1e6).round() / 1e6)
    } else {
        format!("{value:e}")
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

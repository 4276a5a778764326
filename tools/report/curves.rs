//! Wrong pixels against the unit of length and against the distance from the origin.

use crate::case::{Case, Outcome};
use crate::catalogue::far;
use crate::draw;
use crate::in_order;
use plotters::prelude::*;
use std::path::Path;

/// A curve: wrong pixels of povr and of POV-Ray in percent, by the power of ten.
pub(crate) struct Curve {
    pub(crate) title: &'static str,
    pub(crate) across: &'static str,
    pub(crate) points: Vec<Point>,
}

/// The values at one power of ten, in percent.
pub(crate) struct Point {
    power: i32,
    /// Wrong pixels among the certain ones.
    povr: f64,
    pov_ray: Option<f64>,
    /// Certain pixels among all.
    certain: f64,
}

const SIZE: (u32, u32) = (640, 420);
const OF_CERTAIN: RGBColor = RGBColor(130, 130, 130);
const FONT: &str = "DejaVu Sans, Liberation Sans, Arial, sans-serif";
const OF_POVR: RGBColor = RGBColor(20, 110, 190);
const OF_POV_RAY: RGBColor = RGBColor(200, 60, 40);

/// The curves of the scene of item 13.
pub(crate) fn all(scratch: Option<&Path>) -> Vec<Curve> {
    let scaled = (-20..=20).map(|power| {
        let model = far::all_solids().scaled(10f64.powi(power));
        (power, Case::model(13, format!("times 1e{power}"), model))
    });
    let moved = (0..=20).map(|power| {
        let by = 10f64.powi(power);
        let model = far::all_solids().moved([by, 0.5 * by, -by]);
        (power, Case::model(14, format!("moved by 1e{power}"), model))
    });
    vec![
        Curve {
            title: "The room with every length times 10^k",
            across: "k, the power of ten that lengths are multiplied with",
            points: points(scaled.collect(), scratch),
        },
        Curve {
            title: "The room moved by 10^k",
            across: "k, the power of ten of the distance from the origin",
            points: points(moved.collect(), scratch),
        },
    ]
}

fn points(cases: Vec<(i32, Case)>, scratch: Option<&Path>) -> Vec<Point> {
    let percent = |some: usize, all: usize| {
        let count = |n: usize| f64::from(u32::try_from(n).unwrap_or(u32::MAX));
        100.0 * count(some) / count(all.max(1))
    };
    let wrong = |outcome: &Outcome| percent(outcome.wrong, outcome.decided);
    in_order(cases, |_, (power, case)| {
        let povr = case.outcome(&|text, size| draw::by_povr(text, size));
        let pov_ray =
            scratch.map(|folder| case.outcome(&|text, size| draw::by_pov_ray(text, size, folder)));
        let (width, height) = case.size();
        Point {
            power,
            povr: wrong(&povr),
            pov_ray: pov_ray.as_ref().map(wrong),
            certain: percent(povr.decided, (width * height) as usize),
        }
    })
}

impl Curve {
    /// The curve as SVG.
    pub(crate) fn svg(&self) -> String {
        let mut text = String::new();
        let drawn = self.draw(&mut text);
        match drawn {
            Ok(()) => text,
            Err(error) => format!("<p>No plot: {error}</p>"),
        }
    }

    fn draw(&self, text: &mut String) -> Result<(), Box<dyn std::error::Error + '_>> {
        let area = SVGBackend::with_string(text, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let first = self.points.first().map_or(0, |point| point.power);
        let last = self.points.last().map_or(1, |point| point.power);
        let mut chart = ChartBuilder::on(&area)
            .caption(self.title, (FONT, 17))
            .margin(12)
            .x_label_area_size(46)
            .y_label_area_size(64)
            .build_cartesian_2d(f64::from(first) - 0.5..f64::from(last) + 0.5, -2.0..102.0)?;
        chart
            .configure_mesh()
            .x_desc(self.across)
            .y_desc("wrong pixels, % of those that are certain")
            .label_style((FONT, 13))
            .axis_desc_style((FONT, 14))
            .x_label_formatter(&|v| format!("{v:.0}"))
            .y_label_formatter(&|v| format!("{v:.0} %"))
            .bold_line_style(BLACK.mix(0.15))
            .light_line_style(TRANSPARENT)
            .draw()?;
        let series = |of: &dyn Fn(&Point) -> Option<f64>| -> Vec<(f64, f64)> {
            let points = self.points.iter();
            points
                .filter_map(|point| Some((f64::from(point.power), of(point)?)))
                .collect()
        };
        let certain = series(&|point| Some(point.certain));
        chart
            .draw_series(DashedLineSeries::new(
                certain,
                5,
                4,
                OF_CERTAIN.stroke_width(1),
            ))?
            .label("certain pixels")
            .legend(|(x, y)| PathElement::new([(x, y), (x + 16, y)], OF_CERTAIN));
        for (name, color, points) in [
            ("POV-Ray 3.7", OF_POV_RAY, series(&|point| point.pov_ray)),
            ("povr", OF_POVR, series(&|point| Some(point.povr))),
        ] {
            chart
                .draw_series(LineSeries::new(points.clone(), color.stroke_width(2)))?
                .label(name)
                .legend(move |(x, y)| Circle::new((x + 8, y), 4, color.filled()));
            chart.draw_series(
                points
                    .into_iter()
                    .map(|at| Circle::new(at, 3, color.filled())),
            )?;
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::MiddleMiddle)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font((FONT, 12))
            .draw()?;
        area.present()?;
        Ok(())
    }
}

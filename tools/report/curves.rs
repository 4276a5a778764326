//! Wrong pixels against the unit of length and against the distance from the origin.

use crate::case::{Case, Outcome};
use crate::catalogue::far;
use crate::draw;
use crate::in_order;
use plotters::prelude::*;
use std::path::Path;

/// A curve: wrong pixels of a hundred, for povr and for POV-Ray, by the power of ten.
pub(crate) struct Curve {
    pub(crate) title: &'static str,
    pub(crate) across: &'static str,
    /// Power, povr, POV-Ray.
    pub(crate) points: Vec<(i32, f64, Option<f64>)>,
}

const SIZE: (u32, u32) = (760, 420);
const FONT: &str = "DejaVu Sans, Liberation Sans, Arial, sans-serif";
const OF_POVR: RGBColor = RGBColor(20, 110, 190);
const OF_POV_RAY: RGBColor = RGBColor(200, 60, 40);

/// The curves of the room of item 13.
pub(crate) fn all(scratch: Option<&Path>) -> Vec<Curve> {
    let scaled = (-20..=20).map(|power| {
        let model = far::room().scaled(10f64.powi(power));
        (power, Case::model(13, format!("times 1e{power}"), model))
    });
    let moved = (0..=15).map(|power| {
        let by = 10f64.powi(power);
        let model = far::room().moved([by, 0.5 * by, -by]);
        let margin = far::moved_margin(by);
        (
            power,
            Case::model(14, format!("moved by 1e{power}"), model.with_margin(margin)),
        )
    });
    vec![
        Curve {
            title: "wrong pixels of a hundred: every length times 10^k",
            across: "k",
            points: points(scaled.collect(), scratch),
        },
        Curve {
            title: "wrong pixels of a hundred: everything moved by 10^k",
            across: "k",
            points: points(moved.collect(), scratch),
        },
    ]
}

fn points(cases: Vec<(i32, Case)>, scratch: Option<&Path>) -> Vec<(i32, f64, Option<f64>)> {
    let percent = |outcome: &Outcome| {
        let (wrong, decided) = (outcome.wrong, outcome.decided.max(1));
        100.0 * f64::from(u32::try_from(wrong).unwrap_or(u32::MAX))
            / f64::from(u32::try_from(decided).unwrap_or(u32::MAX))
    };
    in_order(cases, |_, (power, case)| {
        let povr = case.outcome(&|text, size| draw::by_povr(text, size));
        let pov_ray =
            scratch.map(|folder| case.outcome(&|text, size| draw::by_pov_ray(text, size, folder)));
        (power, percent(&povr), pov_ray.as_ref().map(percent))
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
        let first = self.points.first().map_or(0, |point| point.0);
        let last = self.points.last().map_or(1, |point| point.0);
        let mut chart = ChartBuilder::on(&area)
            .caption(self.title, (FONT, 17))
            .margin(12)
            .x_label_area_size(42)
            .y_label_area_size(52)
            .build_cartesian_2d(f64::from(first) - 0.5..f64::from(last) + 0.5, -2.0..102.0)?;
        chart
            .configure_mesh()
            .x_desc(self.across)
            .label_style((FONT, 13))
            .axis_desc_style((FONT, 14))
            .x_label_formatter(&|v| format!("{v:.0}"))
            .draw()?;
        let of_pov_ray: Vec<(f64, f64)> = self
            .points
            .iter()
            .filter_map(|point| Some((f64::from(point.0), point.2?)))
            .collect();
        let of_povr: Vec<(f64, f64)> = self
            .points
            .iter()
            .map(|point| (f64::from(point.0), point.1))
            .collect();
        for (name, color, points) in [
            ("POV-Ray 3.7", OF_POV_RAY, of_pov_ray),
            ("povr", OF_POVR, of_povr),
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
            .position(SeriesLabelPosition::UpperMiddle)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font((FONT, 13))
            .draw()?;
        area.present()?;
        Ok(())
    }
}

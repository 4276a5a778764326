//! `root_error FOLDER [RAYS]`: bad rays and backward error against nanoseconds a ray, for povr's torus, sphere and
//! quadric and for alternative methods, on families of 10,000 rays (or RAYS) whose answers are known to 77 digits.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for the terminal"
)]
#![allow(dead_code, reason = "the suite's other parts are for other programs")]

#[path = "../tests/stability/certain.rs"]
mod certain;
#[path = "../tests/stability/rays/mod.rs"]
mod rays;
#[path = "../tests/stability/wide.rs"]
mod wide;

#[path = "candidates"]
mod candidates {
    pub(crate) mod quadric;
    pub(crate) mod sphere;
    pub(crate) mod torus;
}

use plotters::coord::combinators::IntoLogRange;
use plotters::prelude::*;
use povr::scene::shape::Root;
use rays::families::{Family, Question, SPHERES, TORI};
use rays::quadrics::{OnQuadric, QUADRICS};
use rays::{Digits, ExactRoots};
use std::fmt::Write as _;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Fills in the roots of a ray, in any order.
type Solve<Q> = fn(&Q, &mut Vec<f64>);
/// A root finder, with its name.
type Method<Q> = (&'static str, Solve<Q>);

/// Rays of each family.
const RAYS: usize = 10_000;
/// Rays that are timed together: few, so that most runs are not interrupted by other work.
const TIMED: usize = 100;
/// Timings of each of these, of which the least counts.
const TIMINGS: usize = 5;
/// Families of the report on numerics; the others are povr's own.
const OF_REPORT: usize = 31;
const SIZE: (u32, u32) = (640, 460);
const FONT: &str = "DejaVu Sans, Liberation Sans, Arial, sans-serif";

/// The result of one method on one family.
struct Score {
    bad: usize,
    /// The backward error of each ray's worst root, in roundings, in rising order; rays without roots have none.
    errors: Vec<f64>,
    /// The largest of the rays that are not bad.
    worst: f64,
    nanoseconds: f64,
}

impl Score {
    fn worst_of_all(&self) -> f64 {
        self.errors.last().copied().unwrap_or(0.0)
    }
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments
        .next()
        .map_or_else(|| "target/stability/report".into(), PathBuf::from);
    let rays = arguments
        .next()
        .and_then(|text| text.parse().ok())
        .unwrap_or(RAYS);
    match run(&folder, rays) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("root_error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn torus_of_povr(question: &Question, out: &mut Vec<f64>) {
    roots_of(question, out, rays::torus_of_povr);
}

fn sphere_of_povr(question: &Question, out: &mut Vec<f64>) {
    roots_of(question, out, rays::sphere_of_povr);
}

fn quadric_of_povr(question: &OnQuadric, out: &mut Vec<f64>) {
    roots_of(question, out, rays::quadrics::quadric_of_povr);
}

fn roots_of<Q>(question: &Q, out: &mut Vec<f64>, ask: fn(&Q, &mut Vec<Root>)) {
    thread_local! {
        static ROOTS: std::cell::RefCell<Vec<Root>> = const { std::cell::RefCell::new(Vec::new()) };
    }
    ROOTS.with_borrow_mut(|roots| {
        roots.clear();
        ask(question, roots);
        out.extend(roots.iter().map(|root| root.t));
    });
}

fn run(folder: &Path, rays: usize) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let mut page = String::new();
    fn all<Q: ExactRoots>(own: Solve<Q>, others: &[Method<Q>]) -> Vec<Method<Q>> {
        let others = others.iter().copied();
        [("povr", own)].into_iter().chain(others).collect()
    }
    let tori = all(torus_of_povr, candidates::torus::ALL);
    let quadrics = all(quadric_of_povr, candidates::quadric::ALL);
    let spheres = all(sphere_of_povr, candidates::sphere::ALL);
    section(&mut page, "torus", TORI, &tori, rays);
    section(&mut page, "quadric", QUADRICS, &quadrics, rays);
    section(&mut page, "sphere", SPHERES, &spheres, rays);
    std::fs::write(folder.join("root_error.html"), page)
}

fn section<Q: ExactRoots + Sync>(
    page: &mut String,
    shape: &str,
    families: &[Family<Q>],
    methods: &[Method<Q>],
    rays: usize,
) {
    let scores: Vec<Vec<Score>> = families
        .iter()
        .map(|family| {
            let questions = family.rays(rays);
            let exact = on_all_processors(&questions, |_, question| question.roots(Digits::Enough));
            let scores: Vec<Score> = methods
                .iter()
                .map(|method| score(&questions, &exact, method.1))
                .collect();
            let summaries: Vec<String> = scores
                .iter()
                .map(|score| format!("{}/{:.1}/{:.0}", score.bad, score.worst, score.nanoseconds))
                .collect();
            println!("{shape}, {}: {}", family.name, summaries.join("  "));
            scores
        })
        .collect();
    let _ = writeln!(
        page,
        "<h2>Roots of the {shape}: error against run time</h2>\n<p>{} families of {rays} rays. The backward error of a ray is \
         how far its worst root lies off the surface, in roundings of the problem's size. A ray is bad if that is more \
         than 64, or if a root is missing or too many that no shift of the surface by so little explains. Times are the least of {TIMINGS}, on a machine with other work.</p>",
        families.len()
    );
    overview(page, methods, &scores, rays);
    *page += "<div class=\"plots\">\n";
    *page += &plot(shape, methods, &scores, rays)
        .unwrap_or_else(|error| format!("<p>No plot: {error}</p>"));
    *page += "</div>\n";
    for (name, cell) in [
        (
            format!("bad rays of {rays}, by family"),
            (|score: &Score| score.bad.to_string()) as fn(&Score) -> String,
        ),
        (
            "largest backward error in roundings, bad rays left out".to_owned(),
            |score| format!("{:.2}", score.worst),
        ),
        ("nanoseconds a ray".to_owned(), |score| {
            format!("{:.0}", score.nanoseconds)
        }),
    ] {
        let _ = writeln!(page, "<details><summary>The {shape}: {name}</summary>");
        table(page, families, methods, &scores, cell);
        *page += "</details>\n";
    }
    let first = if shape == "torus" {
        OF_REPORT.min(families.len())
    } else {
        families.len()
    };
    for (name, number) in methods.iter().map(|method| method.0).zip(0..) {
        let bad = |of: &[Vec<Score>]| of.iter().map(|scores| scores[number].bad).sum::<usize>();
        println!(
            "{shape}, {name}: {} bad of {} in the families of the report, {} of {} in others",
            bad(&scores[..first]),
            first * rays,
            bad(&scores[first..]),
            (families.len() - first) * rays
        );
    }
}

/// A row for each method: all families together.
fn overview<Q>(page: &mut String, methods: &[Method<Q>], scores: &[Vec<Score>], rays: usize) {
    *page += "<div class=\"wide\"><table><thead><tr><th class=\"text\" rowspan=\"2\">way</th>\
        <th colspan=\"3\">backward error, roundings</th><th rowspan=\"2\">bad rays</th>\
        <th rowspan=\"2\">families with bad rays</th><th rowspan=\"2\">ns a ray, median family</th></tr>\
        <tr><th>median</th><th>99.9 %</th><th>largest</th></tr></thead><tbody>\n";
    for (number, (name, _)) in methods.iter().enumerate() {
        let own = || scores.iter().map(|scores| &scores[number]);
        let bad: usize = own().map(|score| score.bad).sum();
        let touched = own().filter(|score| score.bad > 0).count();
        let mut errors: Vec<f64> = own().flat_map(|score| &score.errors).copied().collect();
        errors.sort_by(f64::total_cmp);
        let at = |part: usize, of: usize| {
            let error = errors.get((errors.len() * part / of).min(errors.len().max(1) - 1));
            short(error.copied().unwrap_or(0.0))
        };
        let mut times: Vec<f64> = own().map(|score| score.nanoseconds).collect();
        times.sort_by(f64::total_cmp);
        let class = if bad > 0 { " class=\"bad\"" } else { "" };
        let (median, most, largest) = (at(1, 2), at(999, 1000), at(1, 1));
        let time = times[times.len() / 2];
        let _ = writeln!(
            page,
            "<tr><td class=\"text\">{name}</td><td>{median}</td><td>{most}</td><td>{largest}</td>\
             <td{class}>{bad} of {}</td><td>{touched} of {}</td><td>{time:.0}</td></tr>",
            scores.len() * rays,
            scores.len(),
        );
        println!("  {name}: {median} {most} {largest} roundings, {bad} bad, {time:.0} ns");
    }
    *page += "</tbody></table></div>\n";
}

/// An error in short notation.
fn short(error: f64) -> String {
    if error.is_infinite() {
        "∞".to_owned()
    } else if error < 1e4 {
        format!("{error:.2}")
    } else {
        format!("{error:.0e}")
    }
}

fn table<Q>(
    page: &mut String,
    families: &[Family<Q>],
    methods: &[Method<Q>],
    scores: &[Vec<Score>],
    cell: impl Fn(&Score) -> String,
) {
    *page += "<div class=\"wide\"><table><thead><tr><th class=\"text\">family</th>";
    for (name, _) in methods {
        let _ = write!(page, "<th>{name}</th>");
    }
    *page += "</tr></thead><tbody>\n";
    for (family, scores) in families.iter().zip(scores) {
        let _ = write!(page, "<tr><td class=\"text\">{}</td>", family.name);
        for score in scores {
            let _ = write!(page, "<td>{}</td>", cell(score));
        }
        *page += "</tr>\n";
    }
    *page += "</tbody></table></div>\n";
}

fn score<Q: ExactRoots + Sync>(questions: &[Q], exact: &[usize], solve: Solve<Q>) -> Score {
    let mut roots = Vec::with_capacity(8);
    let mut seconds = 0.0;
    for some in questions.chunks(TIMED) {
        let mut least = f64::INFINITY;
        for _ in 0..TIMINGS {
            let start = Instant::now();
            for question in some {
                roots.clear();
                solve(black_box(question), &mut roots);
                black_box(&roots);
            }
            least = least.min(start.elapsed().as_secs_f64());
        }
        seconds += least;
    }
    let nanoseconds = seconds * 1e9 / count(questions.len());
    let verdicts = on_all_processors(questions, |number, question| {
        let mut roots = Vec::with_capacity(8);
        solve(question, &mut roots);
        let verdict = question.verdict(&roots, exact[number], Digits::Enough);
        (verdict, !roots.is_empty())
    });
    let good = verdicts.iter().filter(|(verdict, _)| !verdict.is_bad);
    let worst = good.fold(0.0, |worst: f64, (verdict, _)| worst.max(verdict.worst));
    let with_roots = verdicts.iter().filter(|(_, has_roots)| *has_roots);
    let mut errors: Vec<f64> = with_roots.map(|(verdict, _)| verdict.worst).collect();
    errors.sort_by(f64::total_cmp);
    Score {
        bad: verdicts
            .iter()
            .filter(|(verdict, _)| verdict.is_bad)
            .count(),
        errors,
        worst,
        nanoseconds,
    }
}

/// Applies `work` to each item on all processors, in their order.
fn on_all_processors<T: Sync, R: Send>(all: &[T], work: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let share = all.len().div_ceil(workers).max(1);
    let work = &work;
    std::thread::scope(|scope| {
        let parts: Vec<_> = all
            .chunks(share)
            .enumerate()
            .map(|(part, some)| {
                scope.spawn(move || {
                    let numbered = some.iter().enumerate();
                    numbered
                        .map(|(at, one)| work(part * share + at, one))
                        .collect::<Vec<R>>()
                })
            })
            .collect();
        parts
            .into_iter()
            .flat_map(|part| part.join().unwrap_or_default())
            .collect()
    })
}

fn count(n: usize) -> f64 {
    f64::from(u32::try_from(n).unwrap_or(u32::MAX))
}

/// Bad rays of a million over nanoseconds, a dot for each family and method; none is drawn as a tenth.
fn plot<Q>(
    shape: &str,
    methods: &[Method<Q>],
    scores: &[Vec<Score>],
    rays: usize,
) -> Result<String, Box<dyn std::error::Error>> {
    let mut text = String::new();
    let all = || scores.iter().flatten();
    let slowest = all().fold(1.0, |most: f64, score| most.max(score.nanoseconds));
    let fastest = all().fold(slowest, |least: f64, score| least.min(score.nanoseconds));
    let most_error = all()
        .filter(|score| score.worst_of_all().is_finite())
        .fold(10.0, |most: f64, score| most.max(score.worst_of_all()));
    for (title, up, value, range, up_label) in [
        (
            format!("{shape}: bad rays, a dot for each family"),
            "bad rays (none: 0.003 %)",
            (|score: &Score, rays| (100.0 * count(score.bad) / rays).max(0.003))
                as fn(&Score, f64) -> f64,
            0.002..150.0,
            (|v: &f64| format!("{v} %")) as fn(&f64) -> String,
        ),
        (
            format!("{shape}: largest error, a dot for each family"),
            "largest backward error, roundings",
            |score: &Score, _| score.worst_of_all().clamp(0.1, 1e16),
            0.1..most_error.min(1e16) * 2.0,
            |v| format!("{v:e}"),
        ),
    ] {
        let mut part = String::new();
        {
            let area = SVGBackend::with_string(&mut part, SIZE).into_drawing_area();
            area.fill(&WHITE)?;
            let mut chart = ChartBuilder::on(&area)
                .caption(title, (FONT, 15))
                .margin(12)
                .x_label_area_size(42)
                .y_label_area_size(74)
                .build_cartesian_2d(
                    (0.7 * fastest..1.4 * slowest).log_scale(),
                    range.log_scale(),
                )?;
            chart
                .configure_mesh()
                .x_desc("nanoseconds a ray")
                .y_desc(up)
                .label_style((FONT, 12))
                .axis_desc_style((FONT, 13))
                .bold_line_style(BLACK.mix(0.12))
                .x_label_formatter(&|v| label(*v))
                .y_label_formatter(&up_label)
                .light_line_style(TRANSPARENT)
                .draw()?;
            let dots = |number: usize| {
                let color = Palette99::pick(number).to_rgba();
                scores.iter().map(move |scores| {
                    let score = &scores[number];
                    Circle::new(
                        (score.nanoseconds, value(score, count(rays))),
                        4,
                        color.filled(),
                    )
                })
            };
            for (number, (name, _)) in methods.iter().enumerate() {
                let color = Palette99::pick(number).to_rgba();
                chart
                    .draw_series(dots(number))?
                    .label(*name)
                    .legend(move |(x, y)| Circle::new((x + 8, y), 4, color.filled()));
            }
            // povr's once more, above the others.
            chart.draw_series(dots(0))?;
            chart
                .configure_series_labels()
                .position(SeriesLabelPosition::MiddleRight)
                .background_style(WHITE.mix(0.85))
                .border_style(BLACK.mix(0.3))
                .label_font((FONT, 12))
                .draw()?;
            area.present()?;
        }
        text += &part;
    }
    Ok(text)
}

/// A number of nanoseconds, if it begins with 1, 2 or 5; not all of them fit.
fn label(v: f64) -> String {
    let leading = v / 10f64.powf((v.log10() + 1e-9).floor());
    let is_labelled = [1.0, 2.0, 5.0]
        .iter()
        .any(|first| (leading - first).abs() < 1e-6);
    if is_labelled {
        format!("{v:.0}")
    } else {
        String::new()
    }
}

//! True errors of adaptive sampling to an error target, on generated scenes.
//!
//! `error_target FIRST..END [TARGET...]` draws the hard scenes of these numbers (see `tests/support/hard_scenes.rs`) for each
//! target, in steps of 1/255, and prints the true error, the estimated one, and the samples per pixel. The reference is
//! the mean of two regular grids in each pixel, independent of estimates; their difference is printed as well.
//! References are cached in `target/error_target`.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::cast_possible_truncation,
    clippy::expect_used,
    reason = "a tool that prints; means have few digits"
)]

#[path = "../tests/support/hard_scenes.rs"]
mod hard_scenes;

use hard_scenes::{HardScene, ROWS, hard_scenes};
use povr::app::curve::Linear;
use povr::base::options::{Adaptive, Input, Picture, ReadOptions, RenderOptions, Sampling};
use std::path::{Path, PathBuf};

const SIZE: (u32, u32) = (ROWS * 4 / 3, ROWS);
/// Samples on a side of a pixel of both grids.
const GRIDS: [u32; 2] = [32, 25];
const STEPS: f64 = 255.0;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let numbers = arguments.next().and_then(|range| {
        let (first, end) = range.split_once("..")?;
        Some(first.parse::<u32>().ok()?..end.parse::<u32>().ok()?)
    });
    let Some(numbers) = numbers else {
        eprintln!("usage: error_target FIRST..END [TARGET...]");
        std::process::exit(2);
    };
    let mut targets: Vec<f64> = arguments.filter_map(|text| text.parse().ok()).collect();
    if targets.is_empty() {
        targets = vec![0.25, 0.5, 1.0, 2.0];
    }
    let mut missed = vec![0u32; targets.len()];
    let mut samples = vec![0.0; targets.len()];
    let mut count = 0u32;
    for scene in numbers.flat_map(hard_scenes) {
        // Scenes with unsupported features are left out.
        if drawn(&scene, (4, 3), Sampling::Centres).is_none() {
            println!("{:14} cannot be drawn", scene.name);
            continue;
        }
        let (truth, apart) = truth(&scene);
        count += 1;
        let mut line = format!("{:14} {apart:.3} |", scene.name);
        for (number, &error) in targets.iter().enumerate() {
            let sampling = Sampling::Adaptive(Adaptive { error, time: None });
            let picture = drawn(&scene, SIZE, sampling).expect("it was drawn before");
            let errors = truth.errors(&Linear::of_film(&picture.film, picture.working));
            let rmse = errors.rmse * STEPS;
            missed[number] += u32::from(rmse > error);
            samples[number] += picture.statistics.samples_per_pixel;
            line += &format!(
                " {}{rmse:6.3} (est {:5.3}, p999 {:6.2}) {:6.1} |",
                if rmse > error { '!' } else { ' ' },
                picture
                    .statistics
                    .reached
                    .map_or(0.0, |reached| reached.rms),
                errors.p999 * STEPS,
                picture.statistics.samples_per_pixel,
            );
        }
        println!("{line}");
    }
    for ((target, missed), samples) in targets.iter().zip(missed).zip(samples) {
        println!(
            "target {target}: {missed} of {count} missed, {:.1} samples per pixel",
            samples / f64::from(count)
        );
    }
}

/// The picture of a scene, if it can be drawn.
fn drawn(scene: &HardScene, (width, height): (u32, u32), sampling: Sampling) -> Option<Picture> {
    let read = ReadOptions {
        width,
        height,
        library_paths: vec![PathBuf::from("/usr/share/povray-3.7/include")],
        ..ReadOptions::default()
    };
    let render = RenderOptions {
        width,
        height,
        columns: 0..width,
        rows: 0..height,
        sampling,
        ..RenderOptions::default()
    };
    let input = Input::Text {
        name: scene.name.clone(),
        text: scene.text.clone().into_bytes(),
    };
    povr::draw(&input, &read, &render, &|_| {}).ok()
}

/// The reference, and the root mean square difference of both grids.
fn truth(scene: &HardScene) -> (Linear, f64) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/error_target");
    std::fs::create_dir_all(&folder).expect("a folder");
    let [fine, coarse] = GRIDS.map(|grid| {
        let file = folder.join(format!("{}-{ROWS}-{grid}.f32", scene.name));
        let cached = std::fs::read(&file).unwrap_or_default();
        let (text, pixels) = cached.split_at(scene.text.len().min(cached.len()));
        if text == scene.text.as_bytes() {
            let values: Vec<f32> = pixels
                .chunks_exact(4)
                .map(|at| f32::from_le_bytes([at[0], at[1], at[2], at[3]]))
                .collect();
            let pixels = values.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
            return Linear {
                width: SIZE.0,
                height: SIZE.1,
                pixels,
            };
        }
        let means = on_a_grid(scene, grid);
        let mut bytes = scene.text.clone().into_bytes();
        bytes.extend(means.pixels.iter().flatten().flat_map(|c| c.to_le_bytes()));
        std::fs::write(&file, bytes).expect("a file");
        means
    });
    let apart = fine.errors(&coarse).rmse * STEPS;
    let [a, b] = GRIDS.map(|grid| (grid * grid) as f32);
    let mut both = fine;
    for (fine, coarse) in both.pixels.iter_mut().zip(&coarse.pixels) {
        for (fine, coarse) in fine.iter_mut().zip(coarse) {
            *fine = (*fine * a + coarse * b) / (a + b);
        }
    }
    (both, apart)
}

/// The means of the samples on a regular grid in each pixel. Values above white count in full, and the mean is clamped
/// to white.
fn on_a_grid(scene: &HardScene, grid: u32) -> Linear {
    let size = (SIZE.0 * grid, SIZE.1 * grid);
    let large = drawn(scene, size, Sampling::Centres).expect("it was drawn before");
    let mean = |x: u32, y: u32| {
        let mut sum = [0f64; 3];
        for row in y * grid..(y + 1) * grid {
            for column in x * grid..(x + 1) * grid {
                let pixel = large.film.pixels[(row * large.film.width + column) as usize].rgb;
                for (sum, c) in sum.iter_mut().zip([pixel.r, pixel.g, pixel.b]) {
                    *sum += f64::from(c);
                }
            }
        }
        sum.map(|sum| (sum / f64::from(grid * grid)) as f32)
    };
    let mut film = povr::base::film::Film::whole(SIZE.0, SIZE.1);
    for y in 0..SIZE.1 {
        for x in 0..SIZE.0 {
            let [r, g, b] = mean(x, y);
            film.pixels[(y * SIZE.0 + x) as usize].rgb = povr::base::color::Rgb::new(r, g, b);
        }
    }
    Linear::of_film(&film, large.working)
}

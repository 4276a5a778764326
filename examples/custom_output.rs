//! Uses the film of a rendered scene without any encoder: prints the picture as text, dark to bright.
//!
//! `cargo run --release --example custom_output -- SCENE.pov`

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for the terminal"
)]

use povr::base::options::{Event, Input, ReadOptions, RenderOptions};
use std::process::ExitCode;

/// Characters of the terminal: about twice as high as wide.
const SIZE: (u32, u32) = (76, 28);
const SHADES: &[u8] = b" .:-=+*#%@";

fn main() -> ExitCode {
    let Some(scene) = std::env::args_os().nth(1) else {
        eprintln!("usage: custom_output SCENE.pov");
        return ExitCode::FAILURE;
    };
    let (width, height) = SIZE;
    let read = ReadOptions {
        width,
        height,
        ..ReadOptions::default()
    };
    let render = RenderOptions::of_size(width, height);
    let listen = |event: Event<'_>| {
        if let Event::Finding(message) = event {
            eprintln!("{}", message.excerpt);
        }
    };
    let Ok(drawn) = povr::draw(&Input::File(scene.into()), &read, &render, &listen) else {
        return ExitCode::FAILURE;
    };
    for row in drawn.film.rows_of_pixels() {
        // Pixels are linear light, so their square roots look evenly spaced.
        let shade = |grey: f32| {
            let steps = 1..SHADES.len();
            let share = |step: &usize| *step as f32 / SHADES.len() as f32;
            SHADES[steps
                .filter(|step| grey.max(0.0).sqrt() >= share(step))
                .count()]
        };
        let line: Vec<u8> = row.iter().map(|pixel| shade(pixel.rgb.grey())).collect();
        println!("{}", String::from_utf8_lossy(&line));
    }
    ExitCode::SUCCESS
}

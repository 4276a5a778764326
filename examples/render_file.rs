//! Renders a scene file to a picture: `cargo run --release --example render_file -- SCENE.pov PICTURE.png`

#![allow(clippy::print_stderr, reason = "a program for the terminal")]

use povr::base::options::{Event, Input, ReadOptions, RenderOptions};
use povr::output::{self, EncodeOptions, Format, Target};
use std::path::PathBuf;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(scene), Some(picture)) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: render_file SCENE.pov PICTURE.png");
        return ExitCode::FAILURE;
    };
    let read = ReadOptions {
        width: 640,
        height: 480,
        ..ReadOptions::default()
    };
    let render = RenderOptions::of_size(640, 480);
    // Findings of the scene, errors and warnings alike, arrive while it is read.
    let listen = |event: Event<'_>| {
        if let Event::Finding(message) = event {
            eprintln!("{}", message.excerpt);
        }
    };
    let Ok(drawn) = povr::draw(&Input::File(scene), &read, &render, &listen) else {
        return ExitCode::FAILURE;
    };
    let options = EncodeOptions {
        working: drawn.working,
        ..EncodeOptions::new(Format::PNG)
    };
    match output::write(&drawn.film, &Target::File(picture), &options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

//! Pictures of scene texts by povr, within this process, and by POV-Ray.

use povr::base::options::{Event, Input, ReadOptions, RenderOptions};
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// Linear pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture {
    pub(crate) size: (u32, u32),
    pub(crate) pixels: Vec<[f32; 3]>,
}

/// The result of drawing a scene.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    /// `None` if nothing was drawn.
    pub(crate) picture: Option<Picture>,
    /// The messages.
    pub(crate) said: String,
}

/// Draws with povr.
pub(crate) fn by_povr(text: &str, size: (u32, u32)) -> Drawn {
    let (width, height) = size;
    let input = Input::Text {
        name: "stability.pov".to_owned(),
        text: text.as_bytes().to_vec(),
    };
    let read = ReadOptions {
        width,
        height,
        library_paths: vec![INCLUDES.into()],
        ..ReadOptions::default()
    };
    let render = RenderOptions {
        width,
        height,
        columns: 0..width,
        rows: 0..height,
        // As the oracle has it.
        has_clean_cuts: true,
        ..RenderOptions::default()
    };
    let said = Mutex::new(String::new());
    let listen = |event: Event<'_>| {
        if let (Event::Finding(message), Ok(mut said)) = (event, said.lock()) {
            said.push_str(&message.pov_line);
            said.push('\n');
        }
    };
    let drawn = povr::draw(&input, &read, &render, &listen);
    let picture = drawn.ok().map(|picture| Picture {
        size,
        pixels: picture
            .film
            .pixels
            .iter()
            .map(|pixel| [pixel.rgb.r, pixel.rgb.g, pixel.rgb.b])
            .collect(),
    });
    Drawn {
        picture,
        said: said.into_inner().unwrap_or_default(),
    }
}

/// Folder of the standard include files on Debian.
const INCLUDES: &str = "/usr/share/povray-3.7/include";
/// POV-Ray may take minutes for a scene that povr draws at once.
const TIME_LIMIT: Duration = Duration::from_secs(120);

static NUMBER: AtomicU32 = AtomicU32::new(0);

/// Draws with POV-Ray, 16 bits a channel in linear light.
pub(crate) fn by_pov_ray(text: &str, size: (u32, u32), folder: &Path) -> Drawn {
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    let stem = format!("scene-{}-{number}", std::process::id());
    let scene = folder.join(format!("{stem}.pov"));
    let file = folder.join(format!("{stem}.png"));
    let failed = |why: String| Drawn {
        picture: None,
        said: why,
    };
    if let Err(error) = std::fs::write(&scene, text) {
        return failed(format!("{}: {error}", scene.display()));
    }
    let mut command = Command::new("povray");
    command
        .current_dir(folder)
        .env("HOME", folder)
        .arg(format!("+I{stem}.pov"))
        .arg(format!("+O{stem}.png"))
        .arg(format!("+W{}", size.0))
        .arg(format!("+H{}", size.1))
        .args(["-D", "-A", "+WT1", "+FN16", "File_Gamma=1.0"])
        .arg(format!("+L{INCLUDES}"));
    let ended = povr::app::compare::run(&mut command, TIME_LIMIT);
    let said = match &ended {
        Ok(ended) => ended.stderr.clone(),
        Err(error) => return failed(format!("`povray` does not run: {error}")),
    };
    let is_done = matches!(&ended, Ok(ended) if ended.status.is_some_and(|s| s.success()));
    let picture = image::open(&file)
        .ok()
        .filter(|_| is_done)
        .map(|image| Picture {
            size,
            pixels: image
                .to_rgb16()
                .pixels()
                .map(|pixel| pixel.0.map(|c| f32::from(c) / 65535.0))
                .collect(),
        });
    // Neither file is needed any more.
    let _ = std::fs::remove_file(&scene);
    let _ = std::fs::remove_file(&file);
    Drawn { picture, said }
}

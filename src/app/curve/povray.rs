//! Measures POV-Ray itself.

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::CurveError;
use super::error::Linear;
use crate::app::compare::{self, Renderer};
use crate::app::picture_file;
use crate::base::options::CancelToken;

/// Time limit of a rendering.
const PATIENCE: Duration = Duration::from_secs(24 * 3600);

/// A rendering by POV-Ray.
pub(super) struct ByPovRay {
    pub(super) picture: Linear,
    /// Seconds of tracing, over all processors and by the clock, as reported by POV-Ray.
    pub(super) processor: f64,
    pub(super) wall: f64,
    /// Camera rays for each pixel, those of antialiasing included.
    pub(super) samples_per_pixel: f64,
}

/// A rendering task for POV-Ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// The scene, as a path from the root.
    pub scene: PathBuf,
    /// Width and height of the picture.
    pub size: (u32, u32),
    /// Folders for includes.
    pub library_paths: Vec<PathBuf>,
    /// Numbers declared before the scene.
    pub declares: Vec<(String, f64)>,
    /// Number of threads it may use.
    pub threads: usize,
    /// Ends POV-Ray when it is cancelled.
    pub stop: CancelToken,
}

/// Renders with POV-Ray, 16 bits a channel in linear light.
pub(super) fn draw(task: &Task, switches: &str, folder: &Path) -> Result<ByPovRay, CurveError> {
    let file = std::path::absolute(folder)
        .unwrap_or_else(|_| folder.to_owned())
        .join("povray.png");
    let beside = task.scene.parent().unwrap_or(Path::new("/"));
    let folders = std::iter::once(beside).chain(task.library_paths.iter().map(PathBuf::as_path));
    let mut arguments = vec![
        format!("+W{}", task.size.0),
        format!("+H{}", task.size.1),
        "-D".to_owned(),
        "+FN16".to_owned(),
        "File_Gamma=1.0".to_owned(),
    ];
    arguments.extend(folders.map(|folder| format!("+L{}", folder.display())));
    let declares = task.declares.iter();
    arguments.extend(declares.map(|(name, value)| format!("Declare={name}={value}")));
    arguments.extend(switches.split_whitespace().map(str::to_owned));
    let povray = Renderer {
        program: "povray".into(),
        version: String::new(),
        switches: vec![format!("+WT{}", task.threads)],
        includes: PathBuf::new(),
    };
    let ended = povray
        .draw(&compare::Picture {
            scene: &task.scene,
            file: &file,
            switches: &arguments,
            root: beside,
            limit: PATIENCE,
            stop: Some(&task.stop),
        })
        .map_err(|error| {
            CurveError::new(format!("`povray` does not run: {error}")).with_hint(
                "Install POV-Ray 3.7 (Debian: `apt-get install povray`), or leave `--povray` out.",
            )
        })?;
    let stderr = ended.stderr;
    if !ended.status.is_some_and(|status| status.success()) {
        let last = stderr.lines().rev().find(|line| !line.trim().is_empty());
        return Err(CurveError::new(format!(
            "POV-Ray does not draw the scene with `{switches}`: {}",
            last.unwrap_or_default().trim()
        )));
    }
    let unread = |error: &dyn std::fmt::Display| {
        CurveError::new(format!(
            "POV-Ray's picture `{}` cannot be read: {error}",
            file.display()
        ))
    };
    let image = picture_file::open(&file)
        .map_err(|error| unread(&error))?
        .to_rgb16();
    let picture = Linear {
        width: image.width(),
        height: image.height(),
        pixels: image
            .pixels()
            .map(|pixel| pixel.0.map(|c| f32::from(c) / 65535.0))
            .collect(),
    };
    // It has been read; the stored pictures lie in a folder of their own.
    let _ = std::fs::remove_file(&file);
    let pixels = f64::from(task.size.0) * f64::from(task.size.1);
    let (processor, wall) = times(&stderr).ok_or_else(|| unread(&"it tells no times"))?;
    Ok(ByPovRay {
        picture,
        processor,
        wall,
        samples_per_pixel: samples(&stderr).unwrap_or(0.0) / pixels.max(1.0),
    })
}

/// The seconds of tracing: over the processors, and by the clock.
fn times(stderr: &str) -> Option<(f64, f64)> {
    let trace = &stderr[stderr.rfind("Trace Time:")?..];
    let wall = trace.split('(').nth(1)?.split(" seconds").next()?;
    let processor = trace.split(" with ").nth(1)?.split(" CPU-seconds").next()?;
    Some((processor.trim().parse().ok()?, wall.trim().parse().ok()?))
}

/// The camera rays: `Pixels: 76800   Samples: 341234   Smpls/Pxl: 4.44` counts the initial samples of pixels separately
/// from those of antialiasing.
fn samples(stderr: &str) -> Option<f64> {
    let line = &stderr[stderr
        .rfind("Smpls/Pxl:")
        .and_then(|end| stderr[..end].rfind("Pixels:"))?..];
    let number = |name: &str| -> Option<f64> {
        let behind = &line[line.find(name)? + name.len()..];
        behind.split_whitespace().next()?.parse().ok()
    };
    Some(number("Pixels:")? + number("Samples:")?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_samples_are_read_from_what_povray_says() {
        let stderr = "  Bounding Time: 0 hours 0 minutes 0 seconds (0.001 seconds)\n\
             using 1 thread(s) with 0.000 CPU-seconds total\n\
             Pixels:            76800   Samples:          341234   Smpls/Pxl: 4.44\n\
             Trace Time:       0 hours  0 minutes  0 seconds (0.164 seconds)\n\
             using 1 thread(s) with 0.129 CPU-seconds total\n";
        assert_eq!(times(stderr), Some((0.129, 0.164)));
        assert_eq!(samples(stderr), Some(418_034.0));
        assert_eq!(times("nothing"), None);
    }
}

//! POV-Ray's picture of a live scene, where it is installed.

use super::source::{self, Edits};
use crate::app::compare::{Picture, Renderer, compare, tail};
use crate::base::options::{Antialias, CancelToken, Method, ReadOptions, RenderOptions, Sampling};
use crate::scene::camera::View;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::time::Duration;

/// Time limit of POV-Ray.
const PATIENCE: Duration = Duration::from_secs(600);

/// A picture for POV-Ray to draw.
pub(super) struct Task<'a> {
    pub(super) program: &'a Path,
    /// The file of the scene.
    pub(super) scene: &'a Path,
    /// Its text.
    pub(super) text: &'a str,
    pub(super) read: &'a ReadOptions,
    pub(super) render: &'a RenderOptions,
    pub(super) stop: &'a CancelToken,
}

impl Task<'_> {
    /// The picture as a PNG file, and the name of the program with its version.
    ///
    /// # Errors
    /// The reason that there is none.
    pub(super) fn draw(&self) -> Result<(Vec<u8>, String), String> {
        let cannot = |error: std::io::Error| format!("POV-Ray cannot be run: {error}");
        let povray = Renderer::povray(self.program).map_err(cannot)?;
        let folder = tempfile::tempdir().map_err(cannot)?;
        let (scene, file) = (folder.path().join("scene.pov"), folder.path().join("p.png"));
        fs::write(&scene, self.text).map_err(cannot)?;
        let ended = povray.draw(&Picture {
            scene: &scene,
            file: &file,
            switches: &self.switches(&povray.includes),
            root: Path::new("/"),
            limit: PATIENCE,
            stop: Some(self.stop),
        });
        let ended = ended.map_err(cannot)?;
        match fs::read(&file) {
            Ok(png) if ended.status.is_some_and(|status| status.success()) => {
                let version = povray.version.lines().next().unwrap_or_default();
                Ok((png, version.trim().to_owned()))
            }
            _ => Err(tail(&ended.stderr)),
        }
    }

    /// The switches for the options of this picture.
    fn switches(&self, includes: &Path) -> Vec<String> {
        let RenderOptions {
            width,
            height,
            columns,
            rows,
            quality,
            ..
        } = self.render;
        let mut switches = vec![
            format!("+W{width}"),
            format!("+H{height}"),
            format!("+SC{}", columns.start + 1),
            format!("+EC{}", columns.end),
            format!("+SR{}", rows.start + 1),
            format!("+ER{}", rows.end),
            format!("+Q{quality}"),
            format!("+K{}", self.read.clock),
            "+FN8".to_owned(),
            "-D".to_owned(),
            if self.render.alpha { "+UA" } else { "-UA" }.to_owned(),
        ];
        match &self.render.sampling {
            Sampling::PovRay(antialias) => {
                let Antialias {
                    method,
                    threshold,
                    depth,
                    jitter,
                    gamma,
                    ..
                } = antialias;
                let method = match method {
                    Method::One => 1,
                    Method::Two => 2,
                    Method::Three => 3,
                };
                switches.push(format!("+A{threshold}"));
                switches.push(format!("+AM{method}"));
                switches.push(format!("+R{depth}"));
                switches.push(match *jitter > 0.0 {
                    true => format!("+J{jitter}"),
                    false => "-J".to_owned(),
                });
                switches.push(format!("Antialias_Gamma={gamma}"));
            }
            Sampling::Centres | Sampling::Adaptive(_) => switches.push("-A".to_owned()),
        }
        let absolute = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let scene = absolute(self.scene);
        let folders = [scene.parent().unwrap_or(Path::new("/")).to_owned()];
        let here = std::env::current_dir().ok();
        let given = self
            .read
            .library_paths
            .iter()
            .map(|path| absolute(path.as_path()));
        let folders = folders.into_iter().chain(here).chain(given);
        switches.extend(folders.map(|folder| format!("+L{}", folder.display())));
        switches.push(format!("+L{}", includes.display()));
        let declares = self.read.declares.iter();
        switches.extend(declares.map(|(name, value)| format!("Declare={name}={value}")));
        switches
    }
}

/// The text with a camera that has been moved, in place of its own statement or behind all else.
pub(super) fn text(text: &str, view: Option<&View>, statement: Option<Range<usize>>) -> String {
    let Some(view) = view else {
        return text.to_owned();
    };
    let camera = view.to_string();
    let edit = source::camera_edit(text, statement, &camera);
    let edit = edit.or_else(|| source::camera_edit(text, None, &camera));
    let edits = Edits::from_iter(edit);
    source::edited(text, &edits).unwrap_or_else(|| text.to_owned())
}

/// The difference of two pictures in words.
pub(super) fn difference(expected: &[u8], actual: &[u8]) -> String {
    let open = |png| image::load_from_memory(png).ok();
    let pictures = open(expected).zip(open(actual));
    let Some(Ok(result)) = pictures.map(|(expected, actual)| compare(&expected, &actual)) else {
        return "the pictures cannot be compared".to_owned();
    };
    match result.is_equal() {
        true => "equal in every pixel".to_owned(),
        false => format!("{:.3} % of the pixels differ", result.differing_percent()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_camera_replaces_its_statement() {
        let scene = "camera { location -z } sphere { 0, 1 }";
        assert_eq!(text(scene, None, Some(0..22)), scene);
        let view = View::of(&crate::scene::camera::Camera::default(), None).expect("a view");
        let camera = view.to_string();
        let moved = text(scene, Some(&view), Some(0..22));
        assert_eq!(moved, format!("{camera} sphere {{ 0, 1 }}"));
        // One of an included file stays, and the last one counts.
        let added = text("sphere { 0, 1 }\n", Some(&view), None);
        assert_eq!(added, format!("sphere {{ 0, 1 }}\n{camera}\n"));
    }
}

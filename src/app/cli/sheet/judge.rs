//! Compares pictures with POV-Ray's.

use std::fmt;
use std::path::{Path, absolute};
use std::time::Duration;

use super::failed;
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::long_options::Size;
use crate::app::compare::{Picture, Renderer, compare};
use crate::app::picture_file;

/// The folder of POV-Ray's pictures, inside the folder of the sheet.
const FOLDER: &str = "povray";
/// Least percentage of pixels that must be right within one step.
const LEAST: f64 = 99.5;
/// Time limit: the pictures of a sheet take POV-Ray a second.
const PATIENCE: Duration = Duration::from_secs(600);

/// POV-Ray, installed on this machine.
#[derive(Debug)]
pub(super) struct Comparer(Renderer);

/// The result of a comparison with POV-Ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    /// Not compared.
    NotCompared,
    /// Percentages of the pixels.
    Compared {
        /// Equal.
        same: f64,
        /// Equal or one step off.
        near: f64,
    },
    /// POV-Ray renders none.
    NoPicture,
}

impl Comparer {
    /// POV-Ray, if it is installed.
    pub(super) fn find() -> Option<Self> {
        Renderer::povray("povray").ok().map(Comparer)
    }

    /// True if POV-Ray has the shapes of 3.8.
    pub(super) fn is_3_8(&self) -> bool {
        self.0.is_3_8()
    }

    /// Compares the picture of a scene in a folder with POV-Ray's.
    pub(super) fn compare(
        &self,
        folder: &Path,
        name: &str,
        size: Size,
    ) -> Result<Verdict, CliError> {
        let theirs = folder.join(FOLDER).join(format!("{name}.png"));
        super::make_folder(&folder.join(FOLDER))?;
        let absolute_path =
            |path: &Path| absolute(path).map_err(|error| failed("find", path, &error));
        let root = absolute_path(folder)?;
        let ended = self
            .0
            .draw(&Picture {
                scene: &root.join(format!("{name}.pov")),
                file: &absolute_path(&theirs)?,
                switches: &[
                    format!("+W{}", size.0),
                    format!("+H{}", size.1),
                    format!("+L{}", root.display()),
                    "-A".to_owned(),
                    "-D".to_owned(),
                ],
                root: &root,
                limit: PATIENCE,
                stop: None,
            })
            .map_err(|error| failed("run", Path::new("povray"), &error))?;
        if !ended.status.is_some_and(|status| status.success()) {
            return Ok(Verdict::NoPicture);
        }
        let open =
            |path: &Path| picture_file::open(path).map_err(|error| failed("read", path, &error));
        let ours = folder.join(format!("{name}.png"));
        let Ok(comparison) = compare(&open(&theirs)?, &open(&ours)?) else {
            return Ok(Verdict::NoPicture);
        };
        #[allow(clippy::cast_precision_loss, reason = "pixels of one picture")]
        let percent = |pixels: u64| 100.0 * pixels as f64 / comparison.pixels() as f64;
        Ok(Verdict::Compared {
            same: percent(comparison.same),
            near: percent(comparison.same + comparison.off_by_one),
        })
    }
}

impl Verdict {
    /// True if the picture differs from POV-Ray's.
    pub(super) fn is_wrong(&self) -> bool {
        match *self {
            Verdict::NotCompared => false,
            Verdict::Compared { near, .. } => near < LEAST,
            Verdict::NoPicture => true,
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Verdict::NotCompared => f.write_str("not compared"),
            Verdict::Compared { same, near } if same == near => {
                write!(f, "{same:.2} % equal to POV-Ray's")
            }
            Verdict::Compared { same, near } => {
                write!(
                    f,
                    "{same:.2} % equal to POV-Ray's, {near:.2} % within 1/255"
                )
            }
            Verdict::NoPicture => f.write_str("POV-Ray draws no picture"),
        }
    }
}

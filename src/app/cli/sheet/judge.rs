//! POV-Ray's picture beside ours.

use std::fmt;
use std::path::{Path, absolute};
use std::time::Duration;

use super::failed;
use crate::app::cli::options::error::CliError;
use crate::app::cli::options::long_options::Size;
use crate::app::compare::{Picture, Renderer, compare};

/// The folder of POV-Ray's pictures, in that of the sheet.
const FOLDER: &str = "povray";
/// So many percent of the pixels are to be right within one step.
const LEAST: f64 = 99.5;
/// The pictures of a sheet take POV-Ray a second.
const PATIENCE: Duration = Duration::from_secs(600);

/// POV-Ray, found on this machine.
#[derive(Debug)]
pub(super) struct Comparer(Renderer);

/// What POV-Ray says to a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    /// Nobody was asked.
    NotCompared,
    /// So many percent of the pixels are the same, and so many within one step.
    Compared {
        /// Equal.
        same: f64,
        /// Equal or one step off.
        near: f64,
    },
    /// POV-Ray draws none.
    NoPicture,
}

impl Comparer {
    /// POV-Ray, if it is installed.
    pub(super) fn find() -> Option<Self> {
        Renderer::povray().ok().map(Comparer)
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
        let place = |path: &Path| absolute(path).map_err(|error| failed("find", path, &error));
        let root = place(folder)?;
        let ended = self
            .0
            .draw(&Picture {
                scene: &root.join(format!("{name}.pov")),
                file: &place(&theirs)?,
                switches: &[
                    format!("+W{}", size.0),
                    format!("+H{}", size.1),
                    format!("+L{}", root.display()),
                    "-A".to_owned(),
                    "-D".to_owned(),
                ],
                root: &root,
                limit: PATIENCE,
            })
            .map_err(|error| failed("run", Path::new("povray"), &error))?;
        if !ended.status.is_some_and(|status| status.success()) {
            return Ok(Verdict::NoPicture);
        }
        let open = |path: &Path| image::open(path).map_err(|error| failed("read", path, &error));
        let ours = folder.join(format!("{name}.png"));
        let Ok(found) = compare(&open(&theirs)?, &open(&ours)?) else {
            return Ok(Verdict::NoPicture);
        };
        #[allow(clippy::cast_precision_loss, reason = "pixels of one picture")]
        let percent = |pixels: u64| 100.0 * pixels as f64 / found.pixels() as f64;
        Ok(Verdict::Compared {
            same: percent(found.same),
            near: percent(found.same + found.off_by_one),
        })
    }
}

impl Verdict {
    /// Whether the picture is not POV-Ray's.
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

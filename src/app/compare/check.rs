//! Renders a scene with POV-Ray and with this program, and compares the two pictures.

use super::error::CheckError;
use super::noise::OTHER_ORDERS;
use super::reference::Reference;
use super::renderer::{Picture, Renderer};
use super::{
    Case, Comparison, Grade, Limits, Mismatch, Noise, Thresholds, Verdict, alike, compare,
    reference,
};
use crate::app::picture_file;
use image::DynamicImage;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Makes this program lose the surfaces that POV-Ray loses: those nearer than a fixed distance to the origin of a ray.
const AS_POVRAY: &str = "--pov-distances";

/// Two renderers and their common options.
#[derive(Clone, Debug)]
pub struct Bench {
    /// POV-Ray.
    pub povray: Renderer,
    /// This program.
    pub povr: Renderer,
    /// Size of pictures whose scenes request none.
    pub size: (u32, u32),
    /// Switches for both.
    pub switches: Vec<String>,
    /// A folder that contains all scenes and the files they read.
    pub root: PathBuf,
    /// The folder of POV-Ray's pictures.
    pub references: PathBuf,
    /// The folder of this program's pictures.
    pub pictures: PathBuf,
    /// Time limit for each rendering.
    pub limit: Duration,
    /// Replace the limits of scenes.
    pub thresholds: Option<Thresholds>,
}

/// Two pictures of a scene.
#[derive(Debug)]
pub struct Checked {
    /// POV-Ray's picture.
    pub expected: DynamicImage,
    /// This program's picture.
    pub actual: DynamicImage,
    /// POV-Ray's time in seconds, as a process.
    pub povray_seconds: f64,
    /// This program's time in seconds, as a process.
    pub povr_seconds: f64,
    /// The comparison; an error for pictures of different sizes.
    pub compared: Result<Compared, Mismatch>,
}

/// The comparison of two pictures of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// The grade; a warning is a difference with an explanation.
    pub grade: Grade,
    /// The numbers.
    pub comparison: Comparison,
    /// The mean FLIP error.
    pub flip: f64,
    /// The limits that apply.
    pub limits: Limits,
    /// The limit that is broken, regardless of an explanation.
    pub verdict: Verdict,
    /// The reason why the pictures may differ by more than the limits.
    pub explanation: Option<Explanation>,
}

/// Reasons why pictures differ though nothing is wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Explanation {
    /// POV-Ray loses surfaces that are too near to each other, and with its distances this program renders the same
    /// picture.
    Distances,
    /// POV-Ray's own pictures differ as much when their blocks are in other orders.
    Noise(Noise),
}

impl Bench {
    /// POV-Ray's picture of a scene, rendered now unless it is stored.
    ///
    /// # Errors
    /// When POV-Ray fails to render it.
    pub fn reference(&self, case: &Case) -> Result<Reference, CheckError> {
        self.reference_with(case, &[])
    }

    fn reference_with(&self, case: &Case, more: &[&str]) -> Result<Reference, CheckError> {
        let mut switches = case.all_switches(self.size, &self.povray.includes, &self.switches);
        switches.extend(more.iter().map(|&switch| switch.to_owned()));
        let picture = Picture {
            scene: &case.scene,
            file: Path::new(""),
            switches: &switches,
            root: &self.root,
            limit: self.limit,
            stop: None,
        };
        reference::drawn(&self.povray, &picture, &case.text, &self.references)
    }

    /// This program's picture of a scene, in a folder of its own, and the seconds it took.
    ///
    /// # Errors
    /// When the program fails to render it.
    pub fn own(&self, case: &Case, more: &[&str]) -> Result<(DynamicImage, f64), CheckError> {
        let unwritable = |error| CheckError::file(&self.pictures, &error);
        let folder = tempfile::tempdir_in(&self.pictures).map_err(unwritable)?;
        let file = folder.path().join("picture.png");
        let mut switches = case.all_switches(self.size, &self.povray.includes, &self.switches);
        switches.extend(more.iter().map(|&switch| switch.to_owned()));
        let picture = Picture {
            scene: &case.scene,
            file: &file,
            switches: &switches,
            root: &self.root,
            limit: self.limit,
            stop: None,
        };
        let took = reference::draw(&self.povr, &picture)?;
        Ok((open(&file)?, took.as_secs_f64()))
    }

    /// Renders a scene with both and compares the pictures.
    ///
    /// # Errors
    /// When one of the renderers fails.
    pub fn check(&self, case: &Case) -> Result<Checked, CheckError> {
        let reference = self.reference(case)?;
        let expected = open(&reference.file)?;
        let (actual, povr_seconds) = self.own(case, &[])?;
        let compared = self.compared(case, &expected, &actual)?;
        Ok(Checked {
            expected,
            actual,
            povray_seconds: reference.seconds,
            povr_seconds,
            compared,
        })
    }

    /// Compares two pictures of a scene. If they differ too much the scene may be rendered again to find an
    /// explanation.
    ///
    /// # Errors
    /// When a file cannot be read or written, or this program fails to render the scene again.
    pub fn compared(
        &self,
        case: &Case,
        expected: &DynamicImage,
        actual: &DynamicImage,
    ) -> Result<Result<Compared, Mismatch>, CheckError> {
        let comparison = match compare(expected, actual) {
            Ok(comparison) => comparison,
            Err(mismatch) => return Ok(Err(mismatch)),
        };
        let limits = case.limits.unwrap_or(Limits::DEFAULT);
        let verdict = limits.verdict(&comparison);
        let grade = match &self.thresholds {
            Some(thresholds) => match thresholds.grade(expected, actual) {
                Ok(grade) => grade,
                Err(mismatch) => return Ok(Err(mismatch)),
            },
            None if verdict == Verdict::Within => Grade::Pass,
            None => Grade::Failure,
        };
        let mut compared = Compared {
            grade,
            flip: if comparison.is_equal() {
                0.0
            } else {
                super::flip(expected, actual)
            },
            comparison,
            limits,
            verdict,
            explanation: None,
        };
        if grade == Grade::Failure && self.thresholds.is_none() {
            compared.explanation = self.explanation(case, &compared, expected, actual)?;
            if compared.explanation.is_some() {
                compared.grade = Grade::Warning;
            }
        }
        Ok(Ok(compared))
    }

    fn explanation(
        &self,
        case: &Case,
        compared: &Compared,
        expected: &DynamicImage,
        actual: &DynamicImage,
    ) -> Result<Option<Explanation>, CheckError> {
        let comparison = &compared.comparison;
        if case.limits.is_none() && comparison.differing_percent() <= Limits::DEFAULT.pixels {
            let (near, _) = self.own(case, &[AS_POVRAY])?;
            let is_near = compare(expected, &near)
                .is_ok_and(|comparison| Limits::DEFAULT.verdict(&comparison) == Verdict::Within);
            if is_near {
                return Ok(Some(Explanation::Distances));
            }
        }
        let mut noise = Noise::default();
        for order in OTHER_ORDERS {
            // If POV-Ray fails to render the picture again in time, there is no explanation.
            let Ok(again) = self.reference_with(case, &[order]) else {
                return Ok(None);
            };
            let Some(more) = noise.with(expected, &open(&again.file)?) else {
                return Ok(None);
            };
            noise = more;
            let is_quiet = noise
                .without(expected, actual)
                .and_then(|left| compare(expected, &left).ok())
                .is_some_and(|left| compared.limits.verdict(&left) == Verdict::Within);
            if is_quiet && noise.covers(comparison.rms) {
                return Ok(Some(Explanation::Noise(noise)));
            }
        }
        Ok(None)
    }
}

/// Compares two pictures of any kinds.
///
/// # Errors
/// When they differ in size.
pub fn pictures(
    expected: &DynamicImage,
    actual: &DynamicImage,
    thresholds: &Thresholds,
) -> Result<(DynamicImage, DynamicImage, Compared), Mismatch> {
    let (expected, actual) = alike(expected, actual)?;
    let comparison = compare(&expected, &actual)?;
    let compared = Compared {
        grade: thresholds.grade(&expected, &actual)?,
        flip: super::flip(&expected, &actual),
        verdict: Limits::DEFAULT.verdict(&comparison),
        comparison,
        limits: Limits::DEFAULT,
        explanation: None,
    };
    Ok((expected, actual, compared))
}

fn open(file: &Path) -> Result<DynamicImage, CheckError> {
    picture_file::open(file).map_err(|error| CheckError::file(file, &error))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(stderr: &str) -> CheckError {
        CheckError::Refused {
            program: "povr".to_owned(),
            status: "exit status: 1".to_owned(),
            stderr: stderr.to_owned(),
        }
    }

    #[test]
    fn missing_words_are_distinguished_from_other_errors() {
        let missing = "File 'a.pov' line 4: Parse Error: `normal` is not supported yet\n  | shown\n\
            File 'a.pov' line 9: Parse Error: `media` is not supported yet\n\
            File 'a.pov' line 12: Parse Error: `normal` is not supported yet\n";
        assert_eq!(refused(missing).missing(), ["media", "normal"]);
        let other = format!("{missing}File 'a.pov' line 4: Parse Error: expected `}}`\n");
        assert!(refused(&other).missing().is_empty());
        assert!(refused("").missing().is_empty());
        assert_eq!(
            refused(missing).line(),
            "povr: File 'a.pov' line 4: Parse Error: `normal` is not supported yet"
        );
    }
}

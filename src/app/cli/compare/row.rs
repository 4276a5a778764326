//! The result of one comparison, for all report formats.

use std::path::Path;

use image::codecs::png::CompressionType;
use image::imageops::{self, FilterType};
use image::{DynamicImage, GrayImage, Luma};
use serde::Serialize;

use crate::app::cli::options::error::CliError;
use crate::app::compare::{
    Bench, Case, CheckError, Compared, Explanation, Grade, Limits, Mismatch, Verdict, steps_apart,
};
use crate::app::picture_file::{self, png};

/// The status of a comparison, worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Status {
    /// The pictures differ by more than is allowed.
    Failure,
    /// The pictures differ in size.
    Size,
    /// POV-Ray renders the scene and povr refuses it.
    Lost,
    /// One of them ran out of time.
    Late,
    /// POV-Ray refuses the scene and povr renders it.
    Alone,
    /// povr lacks keywords of the scene.
    Missing,
    /// The pictures differ for a known reason.
    Warning,
    /// The same picture.
    Pass,
    /// Both refuse the scene.
    Refused,
}

/// A comparison.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub(super) name: String,
    pub(super) status: Status,
    /// The reason, in a sentence; empty where the numbers say it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(super) why: String,
    /// The keywords that povr lacks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) missing: Vec<String>,
    #[serde(flatten)]
    pub(super) numbers: Option<Numbers>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) povray_seconds: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) povr_seconds: Option<f64>,
    #[serde(skip)]
    pub(super) shown: Shown,
}

/// The numbers of a comparison. Differences are in steps of `full`; counts are of pixels.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Numbers {
    pub(super) pixels: u64,
    pub(super) same: u64,
    pub(super) off_by_one: u64,
    pub(super) off_by_many: u64,
    pub(super) differing_percent: f64,
    pub(super) mean: f64,
    pub(super) rms: f64,
    /// `None` for equal pictures.
    pub(super) psnr: Option<f64>,
    pub(super) max: f64,
    pub(super) full: f64,
    /// Column and row of the largest difference, from 0.
    pub(super) worst: Option<(u32, u32)>,
    pub(super) flip: f64,
}

/// PNG files of the pictures, small enough for a side-by-side view.
#[derive(Clone, Debug, Default)]
pub(super) struct Shown {
    pub(super) theirs: Option<Vec<u8>>,
    pub(super) ours: Option<Vec<u8>>,
    /// Grey: the difference of the pixels in steps of 1/255.
    pub(super) steps: Option<Vec<u8>>,
    /// This many pixels are merged into one, along each side.
    pub(super) reduced: u32,
}

impl Status {
    pub(super) const ALL: [Status; 9] = [
        Status::Failure,
        Status::Size,
        Status::Lost,
        Status::Late,
        Status::Alone,
        Status::Missing,
        Status::Warning,
        Status::Pass,
        Status::Refused,
    ];

    /// The name in reports.
    pub(super) fn title(self) -> &'static str {
        match self {
            Status::Failure => "FAILURE",
            Status::Size => "SIZE",
            Status::Lost => "NOT DRAWN",
            Status::Late => "TIMEOUT",
            Status::Alone => "POV-RAY REFUSES",
            Status::Missing => "MISSING",
            Status::Warning => "WARNING",
            Status::Pass => "PASS",
            Status::Refused => "BOTH REFUSE",
        }
    }

    /// `idiff`'s exit code; pictures that are not rendered here count as unreadable there.
    pub(super) fn exit_code(self) -> u8 {
        match self {
            Status::Pass | Status::Refused => 0,
            Status::Warning => 1,
            Status::Failure => 2,
            Status::Size => 3,
            Status::Lost | Status::Late | Status::Alone | Status::Missing => 4,
        }
    }
}

impl From<Grade> for Status {
    fn from(grade: Grade) -> Self {
        match grade {
            Grade::Pass => Status::Pass,
            Grade::Warning => Status::Warning,
            Grade::Failure => Status::Failure,
        }
    }
}

impl From<&Compared> for Numbers {
    fn from(compared: &Compared) -> Self {
        let comparison = &compared.comparison;
        Numbers {
            pixels: comparison.pixels(),
            same: comparison.same,
            off_by_one: comparison.off_by_one,
            off_by_many: comparison.off_by_many,
            differing_percent: comparison.differing_percent(),
            mean: comparison.mean,
            rms: comparison.rms,
            psnr: Some(comparison.psnr()).filter(|decibels| decibels.is_finite()),
            max: comparison.max(),
            full: comparison.full,
            worst: comparison.worst.map(|worst| (worst.x, worst.y)),
            flip: compared.flip,
        }
    }
}

impl Row {
    fn new(name: &str, status: Status, why: impl Into<String>) -> Row {
        Row {
            name: name.to_owned(),
            status,
            why: why.into(),
            missing: Vec::new(),
            numbers: None,
            povray_seconds: None,
            povr_seconds: None,
            shown: Shown::default(),
        }
    }

    /// A case that cannot even be started.
    pub(super) fn unread(name: &str, why: impl Into<String>) -> Row {
        Row::new(name, Status::Lost, why)
    }

    /// Compares two pictures of any kind.
    pub(super) fn of_pictures(
        name: &str,
        expected: &DynamicImage,
        actual: &DynamicImage,
        compared: &Result<Compared, Mismatch>,
        side: u32,
    ) -> Row {
        let mut row = match compared {
            Ok(compared) => Row::new(name, compared.grade.into(), explained(compared)),
            Err(mismatch) => Row::new(name, Status::Size, mismatch.to_string()),
        };
        row.numbers = compared.as_ref().ok().map(Numbers::from);
        row.shown = Shown::of(Some(expected), Some(actual), side);
        row
    }

    /// Renders a scene with both and compares the pictures.
    pub(super) fn of_scene(bench: &Bench, case: &Case, side: u32) -> Row {
        let name = &case.name;
        let reference = bench.reference(case);
        let own = bench.own(case, &[]);
        let seconds = |error: &CheckError| match error {
            CheckError::OutOfTime(_, limit) => Some(limit.as_secs_f64()),
            _ => None,
        };
        let theirs = reference.as_ref().ok().and_then(|reference| {
            // A picture that cannot be read counts as not rendered.
            picture_file::open(&reference.file).ok()
        });
        let mut row = match (&reference, &own) {
            (Ok(_), Ok((actual, _))) => match &theirs {
                Some(expected) => match bench.compared(case, expected, actual) {
                    Ok(compared) => Row::of_pictures(name, expected, actual, &compared, side),
                    Err(error) => Row::new(name, Status::Lost, error.line()),
                },
                None => Row::new(name, Status::Alone, "POV-Ray's picture cannot be read"),
            },
            (Err(error @ CheckError::OutOfTime(..)), _)
            | (_, Err(error @ CheckError::OutOfTime(..))) => {
                Row::new(name, Status::Late, error.line())
            }
            (Ok(_), Err(error)) => Row::new(name, Status::Lost, error.line()),
            (Err(error), Ok(_)) => Row::new(name, Status::Alone, error.line()),
            (Err(_), Err(error)) => Row::new(name, Status::Refused, error.line()),
        };
        if let Err(error) = &own {
            row.missing = error.missing();
        }
        if !row.missing.is_empty() {
            row.status = Status::Missing;
            row.why = row.missing.join(", ");
        }
        if row.numbers.is_none() && row.status != Status::Size {
            let ours = own.as_ref().ok().map(|(picture, _)| picture);
            row.shown = Shown::of(theirs.as_ref(), ours, side);
        }
        row.povray_seconds = match &reference {
            Ok(reference) => Some(reference.seconds),
            Err(error) => seconds(error),
        };
        row.povr_seconds = match &own {
            Ok((_, seconds)) => Some(*seconds),
            Err(error) => seconds(error),
        };
        row
    }

    /// The speed of povr relative to POV-Ray.
    pub(super) fn ratio(&self) -> Option<f64> {
        let both = self.numbers.is_some();
        Some(self.povray_seconds? / self.povr_seconds?).filter(|ratio| both && ratio.is_finite())
    }

    /// Sort key: a larger number is worse.
    pub(super) fn badness(&self) -> f64 {
        let rank = Status::ALL.iter().position(|&status| status == self.status);
        #[allow(clippy::cast_precision_loss, reason = "nine of them")]
        let rank = (Status::ALL.len() - rank.unwrap_or(0)) as f64;
        let rms = self.numbers.as_ref().map_or(0.0, |n| n.rms / n.full);
        rank + rms.min(0.999)
    }
}

/// The reason why pictures differ, or the scene's own limits that let it pass.
fn explained(compared: &Compared) -> String {
    match &compared.explanation {
        Some(Explanation::Distances) => {
            "POV-Ray loses what is nearer than its least distance; with --pov-distances povr draws the same".to_owned()
        }
        Some(Explanation::Noise(noise)) => format!(
            "random: drawn again with its blocks in other orders, POV-Ray differs from itself in {:.2} % \
             (RMS {:.2}, at most {:.0})",
            noise.percent, noise.rms, noise.max
        ),
        None if compared.verdict == Verdict::Within
            && Limits::DEFAULT.verdict(&compared.comparison) != Verdict::Within =>
        {
            format!("by limits that the scene states: {}", compared.limits)
        }
        None => String::new(),
    }
}

impl Shown {
    /// Pictures scaled down to at most `side` pixels a side.
    fn of(theirs: Option<&DynamicImage>, ours: Option<&DynamicImage>, side: u32) -> Shown {
        let largest = [theirs, ours].into_iter().flatten();
        let largest = largest.map(|p| p.width().max(p.height())).max();
        let reduced = largest.unwrap_or(1).div_ceil(side.max(1)).max(1);
        let small = |picture: &DynamicImage| {
            let picture = crate::app::compare::shown(picture);
            let size = |side: u32| side.div_ceil(reduced);
            let (width, height) = (size(picture.width()), size(picture.height()));
            let small = match reduced {
                1 => picture,
                _ => picture.resize_exact(width, height, FilterType::Triangle),
            };
            if small.color().has_alpha() && small.to_rgba8().pixels().any(|pixel| pixel.0[3] < 255)
            {
                png(&small.to_rgba8(), CompressionType::Best)
            } else {
                png(&small.to_rgb8(), CompressionType::Best)
            }
        };
        let steps = theirs.zip(ours).and_then(|(a, b)| steps_apart(a, b).ok());
        Shown {
            theirs: theirs.map(small),
            ours: ours.map(small),
            steps: steps.map(|steps| png(&largest_of(&steps, reduced), CompressionType::Best)),
            reduced,
        }
    }
}

/// The largest step in every square of `reduced` pixels a side, so that none is lost.
fn largest_of(steps: &GrayImage, reduced: u32) -> GrayImage {
    if reduced == 1 {
        return steps.clone();
    }
    let (width, height) = steps.dimensions();
    GrayImage::from_fn(width.div_ceil(reduced), height.div_ceil(reduced), |x, y| {
        let (x, y) = (x * reduced, y * reduced);
        let (w, h) = (reduced.min(width - x), reduced.min(height - y));
        let part = imageops::crop_imm(steps, x, y, w, h).to_image();
        Luma([part.pixels().map(|p| p.0[0]).max().unwrap_or(0)])
    })
}

/// Reads a picture of any format that povr reads.
pub(super) fn open(path: &Path) -> Result<DynamicImage, CliError> {
    let cannot = |error: &dyn std::fmt::Display| {
        CliError::new(format!("cannot read `{}`: {error}", path.display()))
    };
    picture_file::open(path).map_err(|error| {
        cannot(&error).with_hint(
            "Pictures are PNG, EXR, HDR, JPEG, TGA, BMP, TIFF, GIF and PNM files; scenes end in .pov.",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, RgbImage};

    #[test]
    fn no_step_is_lost_in_a_reduced_picture() {
        let mut steps = GrayImage::new(7, 5);
        steps.put_pixel(6, 4, Luma([3]));
        steps.put_pixel(2, 2, Luma([9]));
        let small = largest_of(&steps, 3);
        assert_eq!(small.as_raw(), &[9, 0, 0, 0, 0, 3]);
    }

    #[test]
    fn shown_pictures_are_the_pictures() {
        let picture = DynamicImage::from(RgbImage::from_fn(40, 30, |x, y| {
            Rgb([
                u8::try_from(x * 6).unwrap(),
                u8::try_from(y * 8).unwrap(),
                7,
            ])
        }));
        let shown = Shown::of(Some(&picture), Some(&picture), 40);
        let read = image::load_from_memory(&shown.theirs.unwrap()).unwrap();
        assert_eq!((read, shown.reduced), (picture.clone(), 1));
        assert!(shown.steps.unwrap().len() < 120);
        let half = Shown::of(Some(&picture), None, 20);
        let read = image::load_from_memory(&half.theirs.unwrap()).unwrap();
        assert_eq!((read.width(), read.height(), half.reduced), (20, 15, 2));
    }

    #[test]
    fn worse_rows_are_larger() {
        let row = |status| Row::new("a", status, "");
        let sorted = Status::ALL.windows(2);
        let mut falling = sorted.map(|two| row(two[0]).badness() > row(two[1]).badness());
        assert!(falling.all(|falls| falls));
    }
}

//! Thresholds for equal pictures, in the terms of OpenImageIO's `idiff`.

use super::kinds::{Kind, visit};
use super::{Limits, Mismatch, off};
use image::DynamicImage;
use std::fmt;

/// Thresholds for the difference of pictures, as shares of full intensity; a pixel counts by its most different
/// channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Pixels that differ by more than this count as failures,
    pub fail: f64,
    /// of which this percentage is allowed,
    pub fail_percent: f64,
    /// and no pixel may differ by more than this.
    pub hard_fail: f64,
    /// The same for warnings.
    pub warn: f64,
    /// See `fail_percent`.
    pub warn_percent: f64,
    /// See `hard_fail`.
    pub hard_warn: f64,
}

/// Two pictures measured against thresholds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Grade {
    /// Equal.
    Pass,
    /// Equal as far as failures go, with warnings.
    Warning,
    /// Different.
    Failure,
}

impl Default for Thresholds {
    /// As in `idiff`: any difference beyond rounding of single precision is a failure.
    fn default() -> Self {
        Thresholds {
            fail: 1e-6,
            fail_percent: 0.0,
            hard_fail: f64::INFINITY,
            warn: 1e-6,
            warn_percent: 0.0,
            hard_warn: f64::INFINITY,
        }
    }
}

impl From<Limits> for Thresholds {
    fn from(limits: Limits) -> Self {
        let hard = (f64::from(limits.channel) + 0.5) / 255.0;
        Thresholds {
            fail_percent: limits.pixels,
            hard_fail: hard,
            warn_percent: limits.pixels,
            hard_warn: hard,
            ..Thresholds::default()
        }
    }
}

impl Thresholds {
    /// Grades two pictures.
    ///
    /// # Errors
    /// When the pictures differ in size or in depth.
    pub fn grade(&self, expected: &DynamicImage, actual: &DynamicImage) -> Result<Grade, Mismatch> {
        // Checks sizes and depths.
        super::compare(expected, actual)?;
        let kind = Kind::of(expected);
        let (mut failing, mut warning, mut largest, mut pixels) = (0u64, 0u64, 0f64, 0u64);
        visit(expected, actual, kind, |_, _, expected, actual| {
            let pairs = expected.into_iter().zip(actual);
            let most = pairs.map(|(e, a)| off(e, a)).fold(0.0, f64::max) / kind.full();
            pixels += 1;
            failing += u64::from(most > self.fail);
            warning += u64::from(most > self.warn);
            largest = largest.max(most);
        });
        let percent = |count| 100.0 * super::as_f64(count) / super::as_f64(pixels.max(1));
        Ok(
            if percent(failing) > self.fail_percent || largest > self.hard_fail {
                Grade::Failure
            } else if percent(warning) > self.warn_percent || largest > self.hard_warn {
                Grade::Warning
            } else {
                Grade::Pass
            },
        )
    }
}

impl Grade {
    /// `idiff`'s exit code.
    #[must_use]
    pub fn exit_code(self) -> u8 {
        match self {
            Grade::Pass => 0,
            Grade::Warning => 1,
            Grade::Failure => 2,
        }
    }
}

impl fmt::Display for Grade {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Grade::Pass => "PASS",
            Grade::Warning => "WARNING",
            Grade::Failure => "FAILURE",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, RgbImage};

    /// Of 100 pixels one is off by 51 of 255, another by 1.
    fn graded(thresholds: &Thresholds) -> Grade {
        let expected = RgbImage::new(10, 10);
        let mut actual = expected.clone();
        actual.put_pixel(2, 3, Rgb([51, 0, 0]));
        actual.put_pixel(4, 3, Rgb([0, 1, 0]));
        thresholds.grade(&expected.into(), &actual.into()).unwrap()
    }

    #[test]
    fn failures_are_counted_as_idiff_counts_them() {
        let usual = Thresholds::default();
        assert_eq!(graded(&usual), Grade::Failure);
        let pixels = Thresholds {
            fail_percent: 2.0,
            ..usual
        };
        assert_eq!(graded(&pixels), Grade::Warning);
        assert_eq!(
            graded(&Thresholds {
                warn_percent: 2.0,
                ..pixels
            }),
            Grade::Pass
        );
        assert_eq!(
            graded(&Thresholds {
                hard_fail: 0.19,
                ..pixels
            }),
            Grade::Failure
        );
        assert_eq!(
            graded(&Thresholds {
                hard_fail: 0.21,
                ..pixels
            }),
            Grade::Warning
        );
        assert_eq!(
            graded(&Thresholds {
                fail: 0.21,
                warn: 0.21,
                ..usual
            }),
            Grade::Pass
        );
        assert_eq!(
            graded(&Thresholds {
                fail: 0.21,
                warn: 0.19,
                ..usual
            }),
            Grade::Warning
        );
        assert_eq!(
            graded(&Thresholds {
                warn_percent: 2.0,
                hard_warn: 0.1,
                ..pixels
            }),
            Grade::Warning
        );
    }

    #[test]
    fn limits_of_scenes_are_thresholds() {
        let one_off = Limits {
            channel: 51,
            pixels: 2.0,
        };
        assert_eq!(graded(&one_off.into()), Grade::Pass);
        assert_eq!(
            graded(
                &Limits {
                    channel: 50,
                    ..one_off
                }
                .into()
            ),
            Grade::Failure
        );
        assert_eq!(
            graded(
                &Limits {
                    pixels: 1.9,
                    ..one_off
                }
                .into()
            ),
            Grade::Failure
        );
    }

    #[test]
    fn unlike_pictures_have_no_grade() {
        let refused =
            Thresholds::default().grade(&RgbImage::new(1, 2).into(), &RgbImage::new(2, 1).into());
        assert_eq!(refused, Err(Mismatch::Size((1, 2), (2, 1))));
    }
}

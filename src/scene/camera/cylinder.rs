//! `cylinder 1` to `cylinder 4`: projection onto a cylinder.

use super::{Frame, Screen, Start};
use std::f64::consts::FRAC_PI_2;

/// The default angle around the axis.
pub(super) const ANGLE: f64 = FRAC_PI_2;

/// The type of a cylindrical projection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Roll {
    /// 1: axis `up`; perspective in height.
    Upright,
    /// 2: axis `right`; perspective in width.
    Lying,
    /// 3: axis `up`; rays leave the axis at a right angle.
    UprightFlat,
    /// 4: axis `right`; rays leave the axis at a right angle.
    LyingFlat,
}

impl Roll {
    /// The type by its number in the scene file.
    #[must_use]
    pub fn of_number(number: f64) -> Option<Roll> {
        let rolls = [
            Roll::Upright,
            Roll::Lying,
            Roll::UprightFlat,
            Roll::LyingFlat,
        ];
        let numbered = [1.0, 2.0, 3.0, 4.0].into_iter().zip(rolls);
        numbered
            .filter(|(known, _)| *known == number.trunc())
            .map(|(_, roll)| roll)
            .next()
    }

    pub(super) fn start(self, frame: &Frame, screen: Screen, angle: Option<f64>) -> Start {
        let angle = angle.unwrap_or(ANGLE);
        let unit = frame.unit();
        let across = screen.u * frame.right.length() * unit.right;
        let upwards = screen.v * frame.up.length() * unit.up;
        let (sin_a, cos_a) = (screen.u * angle).sin_cos();
        let (sin_b, cos_b) = (screen.v * angle).sin_cos();
        let around_up = sin_a * unit.right + cos_a * unit.direction;
        let around_right = sin_b * unit.up + cos_b * unit.direction;
        match self {
            Roll::Upright => (frame.location, around_up + upwards),
            Roll::Lying => (frame.location, around_right + across),
            Roll::UprightFlat => (frame.location + upwards, around_up),
            Roll::LyingFlat => (frame.location + across, around_right),
        }
    }
}

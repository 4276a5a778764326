//! `ultra_wide_angle`: horizontal and vertical positions are proportional to angles.

use super::{Frame, Screen, Start};
use std::f64::consts::FRAC_PI_2;

/// The default horizontal angle.
pub(super) const ANGLE: f64 = FRAC_PI_2;

pub(super) fn start(frame: &Frame, screen: Screen, angle: Option<f64>) -> Start {
    let angle = angle.unwrap_or(ANGLE);
    let (sin_a, cos_a) = (screen.u * angle).sin_cos();
    let (sin_b, cos_b) = (screen.v * angle * frame.up.length() / frame.right.length()).sin_cos();
    let unit = frame.unit();
    let dir = sin_a * unit.right + sin_b * unit.up + cos_a * cos_b * unit.direction;
    (frame.location, dir)
}

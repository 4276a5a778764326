//! `fisheye`: a round image in which the distance from the centre is proportional to the angle from the axis.

use super::{Frame, Screen, Start, polar_angle};
use std::f64::consts::FRAC_PI_2;

/// The default angle across the circle.
const ANGLE: f64 = FRAC_PI_2;

/// The ray of a point within the unit circle; the lengths of `right` and `up` scale the image.
pub(super) fn start(frame: &Frame, screen: Screen, angle: Option<f64>) -> Option<Start> {
    let (x, y) = disc_point(frame, screen);
    let r = x.hypot(y);
    if r > 1.0 {
        return None;
    }
    let (sin_phi, cos_phi) = y.atan2(x).sin_cos();
    let (sin, cos) = (0.5 * r * angle.unwrap_or(ANGLE)).sin_cos();
    let unit = frame.unit();
    let dir = cos_phi * sin * unit.right + sin_phi * sin * unit.up + cos * unit.direction;
    Some((frame.location, dir))
}

/// Image coordinates relative to the unit circle.
fn disc_point(frame: &Frame, screen: Screen) -> (f64, f64) {
    let x = 2.0 * screen.u * frame.right.length();
    let y = 2.0 * screen.v * frame.up.length();
    (x, y)
}

/// The angle around the axis and the angle from it.
pub(super) fn bump_point(frame: &Frame, screen: Screen, angle: Option<f64>) -> (f64, f64) {
    let (x, y) = disc_point(frame, screen);
    (polar_angle(x, y), 0.5 * x.hypot(y) * angle.unwrap_or(ANGLE))
}

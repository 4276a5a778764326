//! `fisheye`: a round picture in which the distance from the middle counts the angle.

use super::{Frame, Screen, Start, turn};
use std::f64::consts::FRAC_PI_2;

/// The angle that the circle spans unless the scene says more.
const ANGLE: f64 = FRAC_PI_2;

/// A ray within the circle of radius 1; the lengths of `right` and `up` stretch the picture.
pub(super) fn start(frame: &Frame, screen: Screen, angle: Option<f64>) -> Option<Start> {
    let (x, y) = place(frame, screen);
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

/// The place in the circle of radius 1.
fn place(frame: &Frame, screen: Screen) -> (f64, f64) {
    let x = 2.0 * screen.u * frame.right.length();
    let y = 2.0 * screen.v * frame.up.length();
    (x, y)
}

/// The angles around the axis and from it.
pub(super) fn measure(frame: &Frame, screen: Screen, angle: Option<f64>) -> (f64, f64) {
    let (x, y) = place(frame, screen);
    (turn(x, y), 0.5 * x.hypot(y) * angle.unwrap_or(ANGLE))
}

//! `omnimax`: dome projection for cinemas, a fisheye with a polynomial angle mapping, cut off at the bottom.

use super::{Frame, Screen, Start, polar_angle};

/// The largest aspect ratio that the dome fills; the sides of a wider image stay empty.
const MAX_ASPECT: f64 = 1.283_458;

/// Image coordinates relative to the unit circle.
fn disc_point(frame: &Frame, screen: Screen) -> (f64, f64) {
    let (mut x, mut y) = (2.0 * screen.u, 2.0 * screen.v);
    let aspect = frame.right.length() / frame.up.length();
    if aspect > MAX_ASPECT {
        x *= aspect / MAX_ASPECT;
        y = (y - 1.0) / MAX_ASPECT + 1.0;
    } else if aspect > 1.0 {
        y = (y - 1.0) / aspect + 1.0;
    } else {
        y /= aspect;
    }
    (x, y)
}

/// The angle from the axis at a distance from the centre.
fn angle(r: f64) -> f64 {
    1.411_269 * r - 0.094_39 * r.powi(3) + 0.256_74 * r.powi(5)
}

/// The angle around the axis and the angle from it.
pub(super) fn bump_point(frame: &Frame, screen: Screen) -> (f64, f64) {
    let (x, y) = disc_point(frame, screen);
    (polar_angle(x, y), angle(x.hypot(y)))
}

pub(super) fn start(frame: &Frame, screen: Screen) -> Option<Start> {
    let (x, y) = disc_point(frame, screen);
    let r = x.hypot(y);
    if r > 1.0 {
        return None;
    }
    let (sin_phi, cos_phi) = y.atan2(x).sin_cos();
    let (sin, cos) = angle(r).sin_cos();
    // The dome ends 45 degrees below the axis.
    if sin_phi * sin < -cos {
        return None;
    }
    let unit = frame.unit();
    let dir = cos_phi * sin * unit.right + sin_phi * sin * unit.up + cos * unit.direction;
    Some((frame.location, dir))
}

//! `omnimax`: the picture for the dome of a cinema, a fisheye with a law of its own, cut off below.

use super::{Frame, Screen, Start, turn};

/// A picture wider than this, in units of its height, leaves its sides empty.
const WIDEST: f64 = 1.283_458;

/// The place in the circle of radius 1.
fn place(frame: &Frame, screen: Screen) -> (f64, f64) {
    let (mut x, mut y) = (2.0 * screen.u, 2.0 * screen.v);
    let shape = frame.right.length() / frame.up.length();
    if shape > WIDEST {
        x *= shape / WIDEST;
        y = (y - 1.0) / WIDEST + 1.0;
    } else if shape > 1.0 {
        y = (y - 1.0) / shape + 1.0;
    } else {
        y /= shape;
    }
    (x, y)
}

/// The angle from the axis at a distance from the middle.
fn angle(r: f64) -> f64 {
    1.411_269 * r - 0.094_39 * r.powi(3) + 0.256_74 * r.powi(5)
}

/// The angles around the axis and from it.
pub(super) fn measure(frame: &Frame, screen: Screen) -> (f64, f64) {
    let (x, y) = place(frame, screen);
    (turn(x, y), angle(x.hypot(y)))
}

pub(super) fn start(frame: &Frame, screen: Screen) -> Option<Start> {
    let (x, y) = place(frame, screen);
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

//! `omnimax`: the picture for the dome of a cinema, a fisheye with a law of its own, cut off below.

use super::{Frame, Screen, Start};

/// A picture wider than this, in units of its height, leaves its sides empty.
const WIDEST: f64 = 1.283_458;

pub(super) fn start(frame: &Frame, screen: Screen) -> Option<Start> {
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
    let r = x.hypot(y);
    if r > 1.0 {
        return None;
    }
    let (sin_phi, cos_phi) = y.atan2(x).sin_cos();
    let angle = 1.411_269 * r - 0.094_39 * r.powi(3) + 0.256_74 * r.powi(5);
    let (sin, cos) = angle.sin_cos();
    // The dome ends 45 degrees below the axis.
    if sin_phi * sin < -cos {
        return None;
    }
    let unit = frame.unit();
    let dir = cos_phi * sin * unit.right + sin_phi * sin * unit.up + cos * unit.direction;
    Some((frame.location, dir))
}

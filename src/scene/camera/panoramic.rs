//! `panoramic`: a half turn from left to right, perspective in height. The lengths of the vectors matter.

use super::{Frame, Screen, Start};
use std::f64::consts::PI;

pub(super) fn start(frame: &Frame, screen: Screen) -> Start {
    let (sin, cos) = ((0.5 - screen.u) * PI).sin_cos();
    let slope = (screen.v * PI).tan();
    let dir = cos * frame.right + slope * frame.up + sin * frame.direction;
    (frame.location, dir)
}

//! `panoramic`: half around to both sides, straight in height; the lengths of the vectors count.

use super::{Frame, Screen, Start};
use std::f64::consts::PI;

pub(super) fn start(frame: &Frame, screen: Screen) -> Start {
    let (sin, cos) = ((0.5 - screen.u) * PI).sin_cos();
    let slope = (screen.v * PI).tan();
    let dir = cos * frame.right + slope * frame.up + sin * frame.direction;
    (frame.location, dir)
}

//! `spherical`: equirectangular projection, with longitude across and latitude upwards.

use super::{Frame, Screen, Start};
use std::f64::consts::{PI, TAU};

/// The default horizontal angle.
pub(super) const WIDTH: f64 = TAU;
/// The vertical angle of a camera without `angle`.
pub(super) const HEIGHT: f64 = PI;

pub(super) fn start(frame: &Frame, screen: Screen, across: Option<f64>, vertical: f64) -> Start {
    let (sin_a, cos_a) = (screen.u * across.unwrap_or(WIDTH)).sin_cos();
    let (sin_b, cos_b) = (screen.v * vertical).sin_cos();
    let unit = frame.unit();
    let dir = sin_a * cos_b * unit.right + sin_b * unit.up + cos_a * cos_b * unit.direction;
    (frame.location, dir)
}

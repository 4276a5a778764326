//! `spherical`: equirectangular projection, with longitude across and latitude upwards.

use super::{Frame, Screen, Start};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The default horizontal angle.
pub(super) const WIDTH: f64 = TAU;
/// The vertical angle of a camera without `angle`.
pub(super) const HEIGHT: f64 = PI;

/// The direction turned about `right` by the latitude, then about `up` by the longitude, so that a mirrored `right`
/// exchanges above and below (docs/povray-facts.md, 1.4). It keeps the length of the camera's `direction`, in which focal
/// blur measures.
pub(super) fn start(frame: &Frame, screen: Screen, across: Option<f64>, vertical: f64) -> Start {
    let unit = frame.unit();
    let raised = turned(frame.direction, unit.right, -(screen.v * vertical));
    let dir = turned(raised, unit.up, screen.u * across.unwrap_or(WIDTH));
    (frame.location, dir)
}

/// `v` turned about the unit vector `axis`, by an angle in radians.
fn turned(v: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sin, cos) = angle.sin_cos();
    cos * v + sin * axis.cross(v) + (1.0 - cos) * axis.dot(v) * axis
}

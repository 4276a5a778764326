//! `perspective`: rays through the points of a flat picture.
//!
//! A component of a direction that is less than what rounding leaves of the terms it is the sum of is nothing. Otherwise
//! a ray along the horizon of a plane would meet it 10^16 away; POV-Ray draws no plane beyond 10^7.

use super::{Frame, Screen, Start};
use glam::DVec3;

/// What rounding leaves of a sum that is to be nothing, as a share of its terms without signs: at most 1.3 * 2^-53 was
/// measured over cameras that look at the origin, at whole sixteenths of pixels.
pub(super) const NOISE: f64 = f64::EPSILON;

#[inline]
pub(super) fn start(frame: &Frame, screen: Screen) -> Start {
    let (right, up) = (screen.u * frame.right, screen.v * frame.up);
    let dir = frame.direction + right + up;
    let terms = frame.direction.abs() + right.abs() + up.abs();
    let is_nothing = dir.abs().cmplt(terms * NOISE);
    (frame.location, DVec3::select(is_nothing, DVec3::ZERO, dir))
}

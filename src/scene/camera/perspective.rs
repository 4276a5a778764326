//! `perspective`: rays through the points of an image plane.
//!
//! A component of a direction that is smaller than the rounding error of its sum is set to zero. Otherwise a ray along
//! the horizon of a plane would hit it at a distance of 10^16; POV-Ray renders no plane beyond 10^7.

use super::{Frame, Screen, Start};
use glam::DVec3;

/// Rounding error of a sum that should be zero, relative to the sum of the absolute terms. The largest measured is
/// 1.3 * 2^-53, over cameras that look at the origin, at whole sixteenths of pixels.
pub(super) const NOISE: f64 = f64::EPSILON;

#[inline]
pub(super) fn start(frame: &Frame, screen: Screen) -> Start {
    let (right, up) = (screen.u * frame.right, screen.v * frame.up);
    let dir = frame.direction + right + up;
    let terms = frame.direction.abs() + right.abs() + up.abs();
    let is_noise = dir.abs().cmplt(terms * NOISE);
    (frame.location, DVec3::select(is_noise, DVec3::ZERO, dir))
}

//! `perspective`: rays through the points of a flat picture.

use super::{Frame, Screen, Start};

pub(super) fn start(frame: &Frame, screen: Screen) -> Start {
    let dir = frame.direction + screen.u * frame.right + screen.v * frame.up;
    (frame.location, dir)
}

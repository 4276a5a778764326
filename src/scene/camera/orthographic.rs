//! `orthographic`: parallel rays.

use super::{Camera, Frame, Screen, Start};

pub(super) fn start(frame: &Frame, screen: Screen) -> Start {
    let origin = frame.location + screen.u * frame.right + screen.v * frame.up;
    (origin, frame.direction)
}

impl Camera {
    /// Scales `right` and `up` to what a perspective camera would show at the distance of `look_at`.
    pub(super) fn fit_orthographic(&mut self) {
        let frame = &mut self.frame;
        let scale = (self.look_at - frame.location).length() / frame.direction.length();
        if scale.is_finite() {
            frame.right *= scale;
            frame.up *= scale;
        }
    }
}

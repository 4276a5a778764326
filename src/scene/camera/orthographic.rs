//! `orthographic`: parallel rays.

use super::{Camera, Frame, Screen, Start};

pub(super) fn start(frame: &Frame, screen: Screen) -> Start {
    let origin = frame.location + screen.u * frame.right + screen.v * frame.up;
    (origin, frame.direction)
}

impl Camera {
    /// Gives an orthographic view the size of what a perspective one shows at `look_at`.
    pub(super) fn fit_orthographic(&mut self) {
        let frame = &mut self.frame;
        let scale = (self.look_at - frame.location).length() / frame.direction.length();
        if scale.is_finite() {
            frame.right *= scale;
            frame.up *= scale;
        }
    }
}

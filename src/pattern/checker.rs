//! `checker`: unit cubes of two colours by turns.

use super::{NUDGE, Pattern};
use crate::color::{Color, Rgb};
use glam::DVec3;

/// The colours that POV-Ray gives where the scene does not.
const COLORS: [Color; 2] = [
    Color::opaque(Rgb::new(0.0, 0.0, 1.0)),
    Color::opaque(Rgb::new(0.0, 1.0, 0.0)),
];

/// Unit cubes; 0 where the sum of the whole parts of the coordinates is even, otherwise 1.
#[derive(Clone, Debug)]
struct Checker;

pub(super) fn new() -> Box<dyn Pattern> {
    Box::new(Checker)
}

impl Pattern for Checker {
    fn value(&self, point: DVec3) -> f64 {
        let cell = (point + NUDGE).floor();
        (cell.x + cell.y + cell.z).rem_euclid(2.0)
    }

    fn default_colors(&self) -> &'static [Color] {
        &COLORS
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(self.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_cubes_differ() {
        let value = |x, y, z| Checker.value(DVec3::new(x, y, z));
        assert_eq!(value(0.5, 0.5, 0.5), 0.0);
        assert_eq!(value(1.5, 0.5, 0.5), 1.0);
        assert_eq!(value(-0.5, 0.5, 0.5), 1.0);
        assert_eq!(value(-0.5, -0.5, 0.5), 0.0);
    }

    #[test]
    fn a_face_in_a_boundary_belongs_to_the_cube_above() {
        assert_eq!(Checker.value(DVec3::new(0.5, -1e-12, 0.5)), 0.0);
        assert_eq!(Checker.value(DVec3::new(0.5, -1e-9, 0.5)), 1.0);
    }
}

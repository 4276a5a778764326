//! `checker`: unit cubes in two alternating colours.

use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::base::math::rounding::{floor, remainder};
use crate::scene::pattern::geometric::formula::Formula;
use crate::scene::pattern::{NUDGE, Pattern, Stop};
use glam::DVec3;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 2] = [
    (0.0, Color::opaque(Rgb::new(0.0, 0.0, 1.0))),
    (1.0, Color::opaque(Rgb::new(0.0, 1.0, 0.0))),
];

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::list(value, &COLORS).without_jumps().boxed()
}

/// 0 where the sum of the floors of the coordinates is even, otherwise 1.
fn value(point: DVec3) -> f64 {
    let [x, y, z] = (point + NUDGE).to_array().map(floor);
    remainder(x + y + z, 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_cubes_differ() {
        assert_eq!(value(DVec3::new(0.5, 0.5, 0.5)), 0.0);
        assert_eq!(value(DVec3::new(1.5, 0.5, 0.5)), 1.0);
        assert_eq!(value(DVec3::new(-0.5, 0.5, 0.5)), 1.0);
        assert_eq!(value(DVec3::new(-0.5, -0.5, 0.5)), 0.0);
    }

    #[test]
    fn a_face_in_a_boundary_belongs_to_the_cube_above() {
        assert_eq!(value(DVec3::new(0.5, -1e-12, 0.5)), 0.0);
        assert_eq!(value(DVec3::new(0.5, -1e-9, 0.5)), 1.0);
    }
}

//! `hexagon`: hexagonal prisms of side 1 along y, in three colours.
//!
//! The xz plane is divided into cells of half a side by half the height of a hexagon; a block of six by six of them
//! repeats. Cells on a slanted edge are split by a diagonal.

use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::base::math::rounding::{floor, remainder};
use crate::scene::pattern::geometric::formula::Formula;
use crate::scene::pattern::{Pattern, Stop};
use glam::DVec3;

/// Three times the height of a hexagon of side 1, which is the period in z; added to negative z. The digits are
/// POV-Ray's.
const PERIOD_Z: f64 = 5.196_152_424;
/// Half the height of a hexagon of side 1, with POV-Ray's digits.
const HALF_HEIGHT: f64 = 0.866_025_404;
/// Replaces a position of 0 in a diagonal cell, to keep the slope finite; POV-Ray's value.
const MIN_FRACTION: f64 = 1e-4;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 3] = [
    (0.0, Color::opaque(Rgb::new(0.0, 0.0, 1.0))),
    (1.0, Color::opaque(Rgb::new(0.0, 1.0, 0.0))),
    (2.0, Color::opaque(Rgb::new(1.0, 0.0, 0.0))),
];

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::list(value, &COLORS).boxed()
}

fn value(point: DVec3) -> f64 {
    let x = point.x.abs();
    let z = if point.z >= 0.0 {
        point.z
    } else {
        PERIOD_Z - point.z.abs()
    };
    let column = remainder(x / 0.5, 6.0);
    let row = remainder(z / HALF_HEIGHT, 6.0);
    let (b, g) = (cell(row), fraction(row));
    match cell(column) {
        0 | 5 => [0.0, 1.0, 1.0, 2.0, 2.0, 0.0][b],
        2 | 3 => [2.0, 2.0, 0.0, 0.0, 1.0, 1.0][b],
        a => {
            let f = fraction(column);
            let f = if (a + b) % 2 == 1 { 1.0 - f } else { f };
            let f = if f == 0.0 { MIN_FRACTION } else { f };
            if g / f < 1.0 {
                [0.0, 2.0, 1.0, 0.0, 2.0, 1.0][b]
            } else {
                [2.0, 1.0, 0.0, 2.0, 1.0, 0.0][b]
            }
        }
    }
}

/// The cell, 0 to 5, of a position in `[0, 6]`; the upper end, which rounding can reach, belongs to the last cell.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the position is cut to 0..=5; NaN becomes 0"
)]
fn cell(position: f64) -> usize {
    position.clamp(0.0, 5.0) as usize
}

/// The fractional position within the cell.
fn fraction(position: f64) -> f64 {
    position - floor(position)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hexagon_around_the_origin_has_the_first_colour() {
        for (x, z) in [
            (0.0, 0.1),
            (0.4, 0.8),
            (-0.4, -0.8),
            (0.9, 0.1),
            (-0.9, -0.1),
        ] {
            assert_eq!(value(DVec3::new(x, 7.0, z)), 0.0, "{x} {z}");
        }
    }

    #[test]
    fn its_neighbours_differ() {
        assert_eq!(value(DVec3::new(0.0, 0.0, 1.0)), 1.0);
        assert_eq!(value(DVec3::new(0.0, 0.0, -1.0)), 2.0);
        assert_eq!(value(DVec3::new(1.2, 0.0, 0.3)), 2.0);
    }

    #[test]
    fn a_point_at_infinity_has_a_value() {
        assert!(value(DVec3::INFINITY) < 3.0);
    }
}

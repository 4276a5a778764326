//! `triangular`: equilateral triangles of side 1 in the xz plane, in six colours around each corner.

use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::base::math::rounding::{floor, remainder};
use crate::scene::pattern::geometric::formula::Formula;
use crate::scene::pattern::{Pattern, Stop};
use glam::DVec3;

/// The square root of 3.
const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 6] = [
    (0.0, Color::opaque(Rgb::new(1.0, 0.0, 0.0))),
    (1.0, Color::opaque(Rgb::new(0.0, 1.0, 0.0))),
    (2.0, Color::opaque(Rgb::new(0.0, 0.0, 1.0))),
    (3.0, Color::opaque(Rgb::new(1.0, 1.0, 0.0))),
    (4.0, Color::opaque(Rgb::new(0.0, 1.0, 1.0))),
    (5.0, Color::opaque(Rgb::new(1.0, 0.0, 1.0))),
];

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::list(value, &COLORS).boxed()
}

fn value(p: DVec3) -> f64 {
    let x = remainder(p.x, 3.0);
    let z = p.z.rem_euclid(SQRT_3);
    let column = floor(x);
    let x = x - column;
    let is_upper = z >= 0.5 * SQRT_3;
    let z = if is_upper { SQRT_3 - z } else { z };
    let rest = 1.0 - x;
    let value = if x == 0.0 || rest == 0.0 {
        1.0
    } else {
        match (z / x < SQRT_3, z / rest < SQRT_3) {
            (true, true) => 0.0,
            (false, true) => 1.0,
            (true, false) => 3.0,
            (false, false) => 1.0,
        }
    };
    let rotated = if remainder(value, 2.0) == 1.0 {
        remainder(value + 2.0 * column, 6.0)
    } else {
        remainder(6.0 + value - 2.0 * column, 6.0)
    };
    if is_upper { 5.0 - rotated } else { rotated }
}

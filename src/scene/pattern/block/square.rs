//! `square`: unit squares in the xz plane, in four colours around each corner.

use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::base::math::rounding::{floor, remainder};
use crate::scene::pattern::geometric::formula::Formula;
use crate::scene::pattern::{Pattern, Stop};
use glam::DVec3;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 4] = [
    (0.0, Color::opaque(Rgb::new(1.0, 0.0, 0.0))),
    (1.0, Color::opaque(Rgb::new(0.0, 1.0, 0.0))),
    (2.0, Color::opaque(Rgb::new(0.0, 0.0, 1.0))),
    (3.0, Color::opaque(Rgb::new(1.0, 1.0, 0.0))),
];

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::list(value, &COLORS).boxed()
}

fn value(p: DVec3) -> f64 {
    let is_odd = |x: f64| remainder(floor(x), 2.0) == 1.0;
    match (is_odd(p.x), is_odd(p.z)) {
        (false, false) => 0.0,
        (false, true) => 1.0,
        (true, true) => 2.0,
        (true, false) => 3.0,
    }
}

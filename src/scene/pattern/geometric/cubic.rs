//! `cubic`: six pyramids from the origin over the faces of a cube, in six colours.

use super::formula::Formula;
use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::scene::pattern::{Pattern, Stop};
use glam::DVec3;

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
    let size = p.abs();
    if p.x >= 0.0 && p.x >= size.y && p.x >= size.z {
        0.0
    } else if p.y >= 0.0 && p.y >= size.x && p.y >= size.z {
        1.0
    } else if p.z >= 0.0 && p.z >= size.x && p.z >= size.y {
        2.0
    } else if p.x < 0.0 && size.x >= size.y && size.x >= size.z {
        3.0
    } else if p.y < 0.0 && size.y >= size.x && size.y >= size.z {
        4.0
    } else {
        5.0
    }
}

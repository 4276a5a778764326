//! `radial`: the angle around the y axis, one turn for the whole map.

use super::formula::Formula;
use crate::base::args::{Args, Parse};
use crate::base::color::{Color, Rgb};
use crate::scene::pattern::{Pattern, Stop};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Size of x and z below which a point counts as on the axis.
const AXIS_TOLERANCE: f64 = 0.001;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 4] = [
    (0.0, Color::opaque(Rgb::new(0.0, 1.0, 1.0))),
    (0.333, Color::opaque(Rgb::new(1.0, 1.0, 0.0))),
    (0.666, Color::opaque(Rgb::new(1.0, 0.0, 1.0))),
    (1.0, Color::opaque(Rgb::new(0.0, 1.0, 1.0))),
];

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::new(value).with_map(&COLORS).boxed()
}

fn value(p: DVec3) -> f64 {
    if p.x.abs() < AXIS_TOLERANCE && p.z.abs() < AXIS_TOLERANCE {
        0.25
    } else {
        0.25 + (p.x.atan2(p.z) + PI) / TAU
    }
}

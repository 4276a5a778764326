//! `cylindrical`: 1 at the y axis, falling to 0 at distance 1 and beyond.

use super::Pattern;
use super::formula::Formula;
use crate::base::args::{Args, Parse};
use glam::DVec3;

pub(super) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::new(value).boxed()
}

fn value(p: DVec3) -> f64 {
    (1.0 - (p.x * p.x + p.z * p.z).sqrt()).max(0.0)
}

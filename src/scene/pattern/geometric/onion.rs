//! `onion`: concentric shells of thickness 1.

use super::formula::Formula;
use crate::base::args::{Args, Parse};
use crate::base::math::rounding::remainder;
use crate::scene::pattern::Pattern;
use glam::DVec3;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::new(value).boxed()
}

fn value(p: DVec3) -> f64 {
    remainder((p.x * p.x + p.y * p.y + p.z * p.z).sqrt(), 1.0)
}

//! `spherical`: 1 at the origin, falling to 0 at distance 1; 0 beyond.

use super::formula::Formula;
use crate::base::args::{Args, Parse};
use crate::scene::pattern::Pattern;
use glam::DVec3;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::new(value).boxed()
}

fn value(p: DVec3) -> f64 {
    (1.0 - p.length()).max(0.0)
}

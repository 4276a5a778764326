//! `leopard`: round spots in a grid, from sines along the axes.

use super::formula::Formula;
use crate::base::args::{Args, Parse};
use crate::scene::pattern::Pattern;
use glam::DVec3;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::new(value).without_jumps().boxed()
}

fn value(p: DVec3) -> f64 {
    let mean = (p.x.sin() + p.y.sin() + p.z.sin()) / 3.0;
    mean * mean
}

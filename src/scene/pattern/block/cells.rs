//! `cells`: unit cubes, each with a random value.

use crate::base::args::{Args, Parse};
use crate::base::math::sampling::hash::hashed_cell;
use crate::base::math::sampling::mersenne;
use crate::scene::pattern::geometric::formula::Formula;
use crate::scene::pattern::{NUDGE, Pattern};
use glam::DVec3;

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::new(value).without_jumps().boxed()
}

fn value(point: DVec3) -> f64 {
    mersenne::random(hashed_cell(crate::scene::pattern::cell(point + NUDGE)))
}

//! `cells`: unit cubes, each of a random value.

use super::formula::Formula;
use super::{NUDGE, Pattern};
use crate::base::args::{Args, Parse};
use crate::base::math::hash::hashed_cell;
use crate::base::math::mersenne;
use glam::DVec3;

pub(super) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Formula::new(value).boxed()
}

fn value(point: DVec3) -> f64 {
    mersenne::random(hashed_cell(super::cell(point + NUDGE)))
}

//! The catalogue: 54 items, each with its scenes or families of rays.

mod csg;
mod degenerate;
mod extreme;
pub(crate) mod far;
mod plates;
mod shapes;
mod torus;
mod trace;

use crate::case::{Asks, Case};
use crate::rays;

/// Every case of every item, in the order of the items.
pub(crate) fn all() -> Vec<Case> {
    let mut all = Vec::new();
    torus::add(&mut all);
    far::add(&mut all);
    csg::add(&mut all);
    plates::add(&mut all);
    degenerate::add(&mut all);
    shapes::add(&mut all);
    extreme::add(&mut all);
    trace::add(&mut all);
    for (item, name, family) in [
        (
            5,
            "rays that touch the top circle of a torus",
            rays::tangents as fn() -> (usize, usize),
        ),
        (
            6,
            "rays along axes and in the plane of a torus",
            rays::along_axes,
        ),
        (
            7,
            "rays through the axis of a torus",
            rays::through_the_axis,
        ),
        (2, "36 families of rays past tori", rays::all_tori),
        (15, "22 families of rays past quadrics", rays::all_quadrics),
        (10, "rays down on a floor sphere of 1e7", rays::floors),
        (
            48,
            "rays that graze a sphere, 1e-15 to 1e-3 deep",
            rays::grazing_spheres,
        ),
        (
            48,
            "rays past spheres from 5 to 1e8 radii",
            rays::far_spheres,
        ),
    ] {
        all.push(Case::new(item, name, Asks::Rays(family)));
    }
    let both = "roots counted and measured with 32 digits and with 77";
    all.push(Case::new(2, both, Asks::Rays(rays::quick_and_slow)));
    let more = format!("{both}, 10,000 rays");
    all.push(Case::new(2, more, Asks::Rays(rays::all_quick_and_slow)).slow());
    all.sort_by_key(|case| case.item);
    all
}

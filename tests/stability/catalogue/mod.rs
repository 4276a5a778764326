//! The catalogue: 54 items, each with its scenes or families of rays.

mod csg;
pub(crate) mod far;
mod odd;
mod plates;
mod torus;

use super::case::Case;

/// Every case of every item, in the order of the items.
pub(crate) fn all() -> Vec<Case> {
    let mut all = Vec::new();
    torus::add(&mut all);
    far::add(&mut all);
    csg::add(&mut all);
    plates::add(&mut all);
    odd::add(&mut all);
    all.sort_by_key(|case| case.item);
    all
}

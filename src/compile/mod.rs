//! From the description of a scene to the world that rays need.

mod csg;
mod flatten;
mod interiors;
mod leaf;
mod probe;
mod lights;
mod simplify;
mod world;

pub use interiors::{InteriorId, Interiors};
pub use leaf::{Extent, Leaf};
pub use probe::Probed;
pub use lights::{LightList, Lights};
pub use world::{Departure, Flags, Globals, Hit, Query, Scratch, Seen, Surface, Way, World};

use crate::accel::Bvh;
use crate::options::RenderOptions;
use crate::scene::Scene;
use flatten::Flat;

/// Prepares a scene for rays: folds transforms into the cheapest form of each object, takes unions apart, flattens
/// combinations, and builds the tree.
#[must_use]
pub fn compile(scene: &Scene, options: &RenderOptions) -> World {
    let mut flat = Flat::new(scene.pattern_settings());
    for object in &scene.objects {
        flat.add(object);
    }
    flat.lights.finish();
    World::new(scene, flat, options)
}

/// The tree over the bounded items, and the numbers of the unbounded ones.
fn tree(flat: &Flat) -> (Bvh, Vec<u32>, Vec<u32>) {
    let mut bounded = Vec::new();
    let mut unbounded = Vec::new();
    for (number, bounds) in (0u32..).zip(&flat.bounds) {
        if bounds.is_finite() {
            bounded.push(number)
        } else {
            unbounded.push(number)
        }
    }
    let boxes: Vec<_> = bounded
        .iter()
        .map(|&number| flat.bounds[number as usize])
        .collect();
    (Bvh::build(&boxes), bounded, unbounded)
}

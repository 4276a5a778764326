//! From the description of a scene to the world that rays need.

mod again;
mod around;
mod balls;
mod chance;
mod cluster;
mod combine;
mod csg;
mod cutaway;
mod find;
mod flatten;
mod four;
mod four_of_copy;
mod four_of_leaf;
mod four_of_tree;
mod hits;
mod instance;
mod interiors;
mod leaf;
mod lights;
mod limits;
mod looks;
mod lot;
mod meshes;
mod model;
mod order;
mod passed;
mod plan;
mod probe;
mod query;
mod rays;
mod row;
mod search;
mod seen_in;
mod shadow;
mod share;
mod simplify;
mod state;
mod surface;
mod targets;
mod together;
mod traits;
mod vistas;
mod world;

pub use hits::{FourHits, FourWays, NO_LEAF};
pub use interiors::{InteriorId, Interiors};
pub use leaf::{Extent, Leaf};
pub use lights::{LightList, Lights};
pub use passed::{Passed, Passing};
pub use probe::{Probed, solid_of};
pub use query::{Departure, Hit, Query, Scratch, Seen, Way};
pub use rays::Rays;
pub use surface::{Kept, Surface};
pub use world::{Globals, World};

use crate::options::RenderOptions;
use crate::pattern::Settings;
use crate::scene::{Object, Scene};
use flatten::Flat;
use std::sync::Arc;
use targets::Targets;

/// Below this quality there are no photons (facts 4.11).
const QUALITY_OF_PHOTONS: u8 = 9;

/// Prepares a scene for rays: folds transforms into the cheapest form of each object, takes unions apart, flattens
/// combinations, and builds the tree.
#[must_use]
pub fn compile(scene: Scene, options: &RenderOptions) -> World {
    compile_apart(scene, options, &mut drop)
}

/// The same; `let_go` gets the objects that are needed no more, one by one.
#[must_use]
pub fn compile_apart(
    scene: Scene,
    options: &RenderOptions,
    let_go: &mut dyn FnMut(Arc<Object>),
) -> World {
    let mut scene = scene.near_the_origin().in_comfort();
    let mut flat = Flat::new(Settings {
        solid_of: Some(solid_of),
        ..scene.pattern_settings()
    });
    let shoots = scene.globals.photons.is_some() && options.quality >= QUALITY_OF_PHOTONS;
    flat.targets = shoots.then(Targets::default);
    // What has been taken in is needed no more; in large scenes the room is.
    flat.take_all(std::mem::take(&mut scene.objects), let_go);
    flat.lights.finish();
    let mut world = World::new(&scene, flat, options);
    world.look_around(options);
    world
}

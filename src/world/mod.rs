//! From the description of a scene to the world that rays need.

mod bvh_items;
mod compiled;
mod csg;
mod instance;
mod interiors;
mod lights;
mod lower;
mod model;
mod plan;
mod primitive;
mod query;
mod ray_counts;
mod sphere_soa;
mod spheres;
mod surface;
mod surface_flags;

pub use compiled::{Globals, World};
pub use interiors::{InteriorId, Interiors};
pub use lights::{LightList, Lights};
pub use primitive::{Extent, Leaf};
pub use query::packet::hits::{HitPacket4, NO_LEAF, ShadowPacket4};
pub use query::probe::{ProbeModel, solid_of};
pub use query::transmission::{TransmissiveHit, TransmissiveHits};
pub use query::{Hit, Occlusion, Query, RayKind, Scratch, SpawnSurface};
pub use ray_counts::RayCounts;
pub use surface::{OwnedOrShared, Surface};

use crate::base::options::RenderOptions;
use crate::scene::pattern::Settings;
use crate::scene::{Object, Scene};
use lower::flatten::Lowering;
use lower::targets::Targets;
use std::sync::Arc;

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
    let mut scene = scene.recentered().rescaled();
    let mut flat = Lowering::new(Settings {
        solid_of: Some(solid_of),
        ..scene.pattern_settings()
    });
    let shoots = scene.globals.photons.is_some() && options.quality >= QUALITY_OF_PHOTONS;
    flat.targets = shoots.then(Targets::default);
    // What has been taken in is needed no more; in large scenes the room is.
    flat.lower_all(std::mem::take(&mut scene.objects), let_go);
    flat.lights.finish();
    let mut world = World::new(&scene, flat, options);
    world.build_light_buffers(options);
    world
}

//! The compiled scene: lowering of objects to primitives, CSG programs and instances, and ray queries on them.

mod compiled;
mod csg;
mod index;
mod interiors;
mod light_buffers;
mod lights;
mod lower;
mod model;
mod photons;
mod plan;
mod primitive;
mod query;
mod ray;
mod rounding;
mod slabs;
mod sphere_soa;
mod surface;

pub use compiled::{Globals, World};
pub use interiors::{InteriorId, Interiors};
pub use lights::{LightList, Lights};
pub use lower::probe::{ProbeModel, solid_of};
pub(crate) use lower::restyle::NewTextures;
pub use photons::{PhotonMapping, PhotonTarget};
pub use primitive::{Extent, Leaf};
pub use query::QueryScratch;
pub use query::blocker_memory::BlockerMemory;
pub use query::hit_leaves::HitLeaves;
pub use query::packet::area::{AreaBlockers, LightArea};
pub use query::packet::hits::{HitPacket4, NO_LEAF, ShadowPacket4};
pub use query::ray_counts::RayCounts;
pub use query::transmission::{TransmissiveHit, TransmissiveHits};
pub use ray::{Hit, Occlusion, Query, RayKind, SpawnSurface};
pub use surface::{OwnedOrShared, Surface};

use crate::base::options::RenderOptions;
use crate::scene::pattern::Settings;
use crate::scene::{Object, Scene};
use csg::coincidence::Widening;
use lower::lowering::Lowering;
use lower::parts::targets::Targets;
use std::sync::Arc;

/// Below this quality there are no photons (docs/povray-facts.md, section 4.11).
const QUALITY_OF_PHOTONS: u8 = 9;

/// Compiles a scene for ray tracing: folds transforms into the cheapest form of each object, splits up unions, flattens
/// CSG objects, and builds the BVH.
#[must_use]
pub fn compile(scene: Scene, options: &RenderOptions) -> World {
    compile_dropping(scene, options, &mut drop)
}

/// Same as [`compile`]; passes each object to `drop_object` when it is no longer needed.
#[must_use]
pub fn compile_dropping(
    scene: Scene,
    options: &RenderOptions,
    drop_object: &mut dyn FnMut(Arc<Object>),
) -> World {
    compile_noting(scene, options, drop_object, None)
}

/// Same as [`compile_dropping`]; notes the index of the first item of each object for [`World::restyle`], and the number
/// of all items at the end.
pub(crate) fn compile_noting(
    scene: Scene,
    options: &RenderOptions,
    drop_object: &mut dyn FnMut(Arc<Object>),
    first_items: Option<&mut Vec<u32>>,
) -> World {
    let mut scene = scene.recentered().rescaled();
    let mut flat = Lowering::new(Settings {
        solid_of: Some(solid_of),
        ..scene.pattern_settings()
    });
    if options.has_clean_cuts {
        flat.widening = Widening::NONE;
    }
    let shoots = scene.globals.photons.is_some() && options.quality >= QUALITY_OF_PHOTONS;
    flat.targets = shoots.then(Targets::default);
    flat.first_items = first_items.is_some().then(Vec::new);
    // Objects are freed as they are lowered: large scenes need the memory.
    flat.lower_all(std::mem::take(&mut scene.objects), drop_object);
    if let (Some(noted), Some(mut all)) = (first_items, flat.first_items.take()) {
        all.push(index::index(flat.parts.items.len()));
        *noted = all;
    }
    flat.lights.finish();
    let mut world = World::new(&scene, flat, options);
    world.build_light_buffers(options);
    world
}

//! Ray queries, their results, and the buffers that a thread reuses between queries.

pub(super) mod closest;
pub(super) mod intersect;
pub(super) mod occlusion;
pub(super) mod packet;
pub(super) mod probe;
pub(super) mod transmission;

use super::bvh_items::IndexedItem;
use super::csg::program::{RawHit, Sweep};
use super::query::packet::hits::ShadowPacket4;
use super::query::packet::mesh::MeshScratch;
use super::query::packet::rays::RayStream;
use super::query::transmission::ItemSet;
use super::ray_counts::RayCounts;
use crate::base::accel::Bundle;
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::Stream;
use crate::render::photons::Near;
use crate::render::radiosity::Session;
use crate::scene::shape::{Crossing, Root};
use glam::DVec3;
use smallvec::SmallVec;

/// The surface point that a spawned ray leaves, so that the ray does not hit it again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpawnSurface {
    /// The leaf.
    pub leaf: u32,
    /// The face of the leaf.
    pub face: u32,
    /// The outward geometric normal there, in world space.
    pub normal: DVec3,
    /// The crossing of the incoming ray there.
    pub crossing: Crossing,
    /// Error bound on the coordinates of the point: distances below it are not significant.
    pub blur: f64,
}

/// A closest hit.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance along the (unit) ray.
    pub t: f64,
    /// The point in world space.
    pub point: DVec3,
    /// The unit normal for shading, before any `normal` pattern; differs on smooth triangles only.
    pub shading_normal: DVec3,
    /// Index into [`super::World::surfaces`].
    pub surface: u32,
    /// Origin surface of the rays spawned here.
    pub departure: SpawnSurface,
}

/// Kind of ray: selects between `no_image`, `no_reflection`, `no_radiosity` and `no_shadow`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// A camera ray, or its straight or refracted continuation.
    Camera,
    /// A reflected ray and its continuations.
    Reflection,
    /// A radiosity sample ray, or its straight or refracted continuation.
    Radiosity,
    /// A reflection of such a ray.
    RadiosityReflection,
    /// A shadow ray.
    Shadow,
}

impl RayKind {
    /// The kind of a ray after a mirror reflection.
    #[must_use]
    pub fn mirrored(self) -> RayKind {
        match self {
            RayKind::Camera | RayKind::Reflection | RayKind::Shadow => RayKind::Reflection,
            RayKind::Radiosity | RayKind::RadiosityReflection => RayKind::RadiosityReflection,
        }
    }
}

/// A ray query.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// The ray; its direction has length 1.
    pub ray: Ray,
    /// The surface point it leaves; `None` for camera rays.
    pub origin_surface: Option<SpawnSurface>,
    /// Far limit: hits at or beyond it are ignored; infinite for none.
    pub t_max: f64,
    /// The kind of ray.
    pub kind: RayKind,
}

/// Per-thread buffers that are reused between queries.
#[derive(Debug, Default)]
pub struct Scratch {
    /// Light received from each sample of the current area light, where computed.
    pub lamps: Vec<Option<Rgb>>,
    /// The shadow rays from a point to the samples of an area light.
    pub to_lamps: Vec<ShadowPacket4>,
    /// Numbers of rays traced.
    pub rays: RayCounts,
    /// Random numbers for lights and rainbows in the current sample.
    pub stream: Stream,
    /// Random numbers for media.
    pub media_stream: Stream,
    /// State of the generator for `crand`.
    pub crand: u32,
    /// If true, random numbers continue from sample to sample instead of restarting.
    pub goes_on: bool,
    /// Recursion depth: the surfaces whose shading waits for the current ray.
    pub followed: u32,
    /// Radiosity state, if radiosity is on.
    pub radiosity: Option<Box<Session>>,
    /// Photons around a point.
    pub photons: Near,
    pub(super) sweep: Sweep,
    pub(super) roots: Vec<Root>,
    /// For each light, the item that last blocked a shadow ray to it.
    pub(super) blockers: SmallVec<[Option<IndexedItem>; 8]>,
    pub(super) bundle: Bundle,
    pub(super) bests: Vec<Option<ClosestHit>>,
    pub(super) ray_stream: RayStream,
    pub(super) mesh: MeshScratch,
    /// Transmissive items on the current shadow ray.
    pub(super) transmissive_items: ItemSet,
    /// Hits on the CSG programs among them: one program after the other, each in order of distance.
    pub(super) passed: Vec<RawHit>,
}

impl Scratch {
    /// Returns true if rays must be traced in POV-Ray's order, because each changes the results of later ones.
    #[must_use]
    pub fn order_dependent(&self) -> bool {
        let session = self.radiosity.as_ref();
        self.goes_on || session.is_some_and(|session| session.order_dependent())
    }

    /// Restarts all random-number streams.
    pub fn begin_anew(&mut self) {
        self.stream = Stream::default();
        self.media_stream = Stream::default();
        self.crand = 0;
    }
}

/// Occlusion between a point and a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occlusion {
    /// Nothing.
    Clear,
    /// Only transmissive surfaces.
    Transmissive,
    /// At least one opaque surface.
    Opaque,
}

/// The closest hit so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosestHit {
    pub(super) hit: RawHit,
    pub(super) item: u32,
}

//! What rays ask the world, what they get, and what a thread keeps between two questions.

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

/// The root that a spawned ray left, so that it does not find it again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpawnSurface {
    /// The leaf.
    pub leaf: u32,
    /// The piece of its surface.
    pub face: u32,
    /// The outward geometric normal there, in the world.
    pub normal: DVec3,
    /// What the old ray did there.
    pub crossing: Crossing,
    /// A bound on the error of coordinates at the point: below this distance nothing can be told apart.
    pub blur: f64,
}

/// What a ray found.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance along the (unit) ray.
    pub t: f64,
    /// The point in the world.
    pub point: DVec3,
    /// The unit normal for shading, before any `normal` pattern; differs on smooth triangles only.
    pub shading_normal: DVec3,
    /// Index into [`super::World::surfaces`].
    pub surface: u32,
    /// For the rays that leave from here.
    pub departure: SpawnSurface,
}

/// Who looks: decides between `no_image`, `no_reflection`, `no_radiosity` and `no_shadow`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// A camera ray, or its straight or refracted continuation.
    Camera,
    /// A reflected ray and what comes of it.
    Reflection,
    /// A ray that gathers light from other surfaces, or its straight or refracted continuation.
    Radiosity,
    /// What such a ray sees in a mirror.
    RadiosityReflection,
    /// A ray to a light.
    Shadow,
}

impl RayKind {
    /// Who looks after a mirror.
    #[must_use]
    pub fn mirrored(self) -> RayKind {
        match self {
            RayKind::Camera | RayKind::Reflection | RayKind::Shadow => RayKind::Reflection,
            RayKind::Radiosity | RayKind::RadiosityReflection => RayKind::RadiosityReflection,
        }
    }
}

/// One question to the world.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// The ray; its direction has length 1.
    pub ray: Ray,
    /// The root it left, for all but camera rays.
    pub origin_surface: Option<SpawnSurface>,
    /// Nothing at or beyond this distance counts; infinite for none.
    pub t_max: f64,
    /// Who asks.
    pub kind: RayKind,
}

/// Buffers that a thread keeps between questions.
#[derive(Debug, Default)]
pub struct Scratch {
    /// The light that came from each lamp of the area light at hand, as far as it is known.
    pub lamps: Vec<Option<Rgb>>,
    /// The shadow rays from a point to the samples of an area light.
    pub to_lamps: Vec<ShadowPacket4>,
    /// How many rays were followed.
    pub rays: RayCounts,
    /// The random numbers of lamps and rainbows for the sample at hand.
    pub stream: Stream,
    /// Those of media.
    pub media_stream: Stream,
    /// The state of the generator that `crand` draws from.
    pub crand: u32,
    /// Whether random numbers go on from sample to sample instead of starting anew.
    pub goes_on: bool,
    /// Behind how many surfaces the ray at hand is, of those that wait for what it finds.
    pub followed: u32,
    /// What is known of radiosity, where that is drawn.
    pub radiosity: Option<Box<Session>>,
    /// Photons around a point.
    pub photons: Near,
    pub(super) sweep: Sweep,
    pub(super) roots: Vec<Root>,
    /// For each light, the item that stood last in its way.
    pub(super) blockers: SmallVec<[Option<IndexedItem>; 8]>,
    pub(super) bundle: Bundle,
    pub(super) bests: Vec<Option<ClosestHit>>,
    pub(super) lot: RayStream,
    pub(super) mesh: MeshScratch,
    /// What the ray to a light meets that is being followed.
    pub(super) among: ItemSet,
    /// The surfaces of combinations among them, one combination after the other, each in order.
    pub(super) passed: Vec<RawHit>,
}

impl Scratch {
    /// Whether rays are to be followed in POV-Ray's order, since each changes what the next ones find.
    #[must_use]
    pub fn order_dependent(&self) -> bool {
        let session = self.radiosity.as_ref();
        self.goes_on || session.is_some_and(|session| session.order_dependent())
    }

    /// Starts all random numbers anew.
    pub fn begin_anew(&mut self) {
        self.stream = Stream::default();
        self.media_stream = Stream::default();
        self.crand = 0;
    }
}

/// What lies between a point and a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occlusion {
    /// Nothing.
    Clear,
    /// Only surfaces that may let light through.
    Transmissive,
    /// Something opaque.
    Opaque,
}

/// The best surface on a ray so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosestHit {
    pub(super) found: RawHit,
    pub(super) item: u32,
}

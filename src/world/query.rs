//! Ray queries, and the buffers that a thread reuses between them.

pub(super) mod closest;
mod instance;
pub(super) mod intersect;
pub(super) mod occlusion;
pub(super) mod packet;
mod projector;
pub(super) mod ray_counts;
pub(super) mod transmission;

use super::csg::program::{RawHit, Sweep};
use super::model::IndexedItem;
use super::query::packet::hits::ShadowPacket4;
use super::query::packet::mesh::MeshScratch;
use super::query::packet::rays::RayStream;
use super::query::ray_counts::RayCounts;
use super::query::transmission::ItemSet;
use crate::base::accel::Bundle;
use crate::base::color::Rgb;
use crate::base::math::sampling::mersenne::Stream;
use crate::render::photons::Near;
use crate::render::radiosity::Session;
use crate::scene::shape::Root;
use smallvec::SmallVec;

/// Per-thread buffers that are reused between queries.
#[derive(Debug, Default)]
pub struct Scratch {
    /// Light received from each sample of the current area light, where computed.
    pub area_samples: Vec<Option<Rgb>>,
    /// The shadow rays from a point to the samples of an area light.
    pub area_shadow_rays: Vec<ShadowPacket4>,
    /// Numbers of rays traced.
    pub rays: RayCounts,
    /// Random numbers for lights and rainbows in the current sample.
    pub stream: Stream,
    /// Random numbers for media.
    pub media_stream: Stream,
    /// State of the generator for `crand`.
    pub crand: u32,
    /// If true, random numbers continue from sample to sample instead of restarting.
    pub continues_random: bool,
    /// Recursion depth: the surfaces whose shading waits for the current ray.
    pub depth: u32,
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
        self.continues_random || session.is_some_and(|session| session.order_dependent())
    }

    /// Restarts all random-number streams.
    pub fn restart_random(&mut self) {
        self.stream = Stream::default();
        self.media_stream = Stream::default();
        self.crand = 0;
    }
}

/// The closest hit so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosestHit {
    pub(super) hit: RawHit,
    pub(super) item: u32,
}

//! What rays ask the world, what they get, and what a thread keeps between two questions.

use super::csg::{Found, Sweep};
use super::hits::FourWays;
use super::lot::Lot;
use super::meshes::MeshScratch;
use super::order::Numbered;
use super::passed::Items;
use super::rays::Rays;
use crate::accel::Bundle;
use crate::color::Rgb;
use crate::math::Ray;
use crate::math::mersenne::Stream;
use crate::photons::Near;
use crate::radiosity::Session;
use crate::shape::{Crossing, Root};
use glam::DVec3;
use smallvec::SmallVec;

/// The root that a spawned ray left, so that it does not find it again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
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
    pub departure: Departure,
}

/// Who looks: decides between `no_image`, `no_reflection`, `no_radiosity` and `no_shadow`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// A camera ray, or its straight or refracted continuation.
    Image,
    /// A reflected ray and what comes of it.
    Reflection,
    /// A ray that gathers light from other surfaces, or its straight or refracted continuation.
    Gathering,
    /// What such a ray sees in a mirror.
    GatheringReflection,
    /// A ray to a light.
    Shadow,
}

impl Seen {
    /// Who looks after a mirror.
    #[must_use]
    pub fn mirrored(self) -> Seen {
        match self {
            Seen::Image | Seen::Reflection | Seen::Shadow => Seen::Reflection,
            Seen::Gathering | Seen::GatheringReflection => Seen::GatheringReflection,
        }
    }
}

/// One question to the world.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// The ray; its direction has length 1.
    pub ray: Ray,
    /// The root it left, for all but camera rays.
    pub from: Option<Departure>,
    /// Nothing at or beyond this distance counts; infinite for none.
    pub far: f64,
    /// Who asks.
    pub seen: Seen,
}

/// Buffers that a thread keeps between questions.
#[derive(Debug, Default)]
pub struct Scratch {
    /// The light that came from each lamp of the area light at hand, as far as it is known.
    pub lamps: Vec<Option<Rgb>>,
    /// The shadow rays from a point to the samples of an area light.
    pub to_lamps: Vec<FourWays>,
    /// How many rays were followed.
    pub rays: Rays,
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
    pub(super) blockers: SmallVec<[Option<Numbered>; 8]>,
    pub(super) bundle: Bundle,
    pub(super) bests: Vec<Option<Best>>,
    pub(super) lot: Lot,
    pub(super) mesh: MeshScratch,
    /// What the ray to a light meets that is being followed.
    pub(super) among: Items,
    /// The surfaces of combinations among them, one combination after the other, each in order.
    pub(super) passed: Vec<Found>,
}

impl Scratch {
    /// Whether rays are to be followed in POV-Ray's order, since each changes what the next ones find.
    #[must_use]
    pub fn minds_order(&self) -> bool {
        let session = self.radiosity.as_ref();
        self.goes_on || session.is_some_and(|session| session.minds_order())
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
pub enum Way {
    /// Nothing.
    Free,
    /// Only surfaces that may let light through.
    Filtered,
    /// Something opaque.
    Blocked,
}

/// The best surface on a ray so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Best {
    pub(super) found: Found,
    pub(super) item: u32,
}

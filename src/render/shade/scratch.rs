//! State of a thread that traces rays: buffers that are reused between samples, and random numbers.

use crate::base::color::Rgb;
use crate::base::math::sampling::mersenne::Stream;
use crate::render::photons::Near;
use crate::render::radiosity::Session;
use crate::world::{QueryScratch, ShadowPacket4};

/// Per-thread state of tracing.
#[derive(Debug, Default)]
pub struct Scratch {
    /// The buffers of ray queries.
    pub query: QueryScratch,
    /// The random numbers of the current sample.
    pub random: RandomStreams,
    /// The samples of the current area light.
    pub(super) area: AreaScratch,
    /// Recursion depth: the surfaces whose shading waits for the current ray.
    pub(super) depth: u32,
    /// Radiosity state, if radiosity is on.
    pub radiosity: Option<Box<Session>>,
    /// Photons around a point.
    pub(super) photons: Near,
}

/// Random-number streams, one for each purpose, as in POV-Ray.
#[derive(Debug, Default)]
pub struct RandomStreams {
    /// For lights and rainbows.
    pub(super) lights: Stream,
    /// For media.
    pub(super) media: Stream,
    /// State of the generator for `crand`.
    pub(super) crand: u32,
    /// If true, random numbers continue from sample to sample instead of restarting.
    pub continues: bool,
}

/// Buffers for the samples of an area light.
#[derive(Debug, Default)]
pub(super) struct AreaScratch {
    /// Light received from each sample, where computed.
    pub(super) light: Vec<Option<Rgb>>,
    /// The shadow rays from a point to the samples.
    pub(super) shadow_rays: Vec<ShadowPacket4>,
}

impl Scratch {
    /// Returns true if rays must be traced in POV-Ray's order, because each changes the results of later ones.
    #[must_use]
    pub fn order_dependent(&self) -> bool {
        let session = self.radiosity.as_ref();
        self.random.continues || session.is_some_and(|session| session.order_dependent())
    }
}

impl RandomStreams {
    /// Restarts all streams.
    pub fn restart(&mut self) {
        self.lights = Stream::default();
        self.media = Stream::default();
        self.crand = 0;
    }
}

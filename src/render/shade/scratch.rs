//! State of a thread that traces rays: buffers that are reused between samples, and random numbers.

use super::subsurface::SubsurfaceStreams;
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
#[derive(Clone, Copy, Debug, Default)]
pub struct RandomStreams {
    /// For lights and rainbows.
    pub(super) lights: Stream,
    /// For media.
    pub(super) media: Stream,
    /// State of the generator for `crand`.
    pub(super) crand: u32,
    /// For subsurface light.
    pub(super) subsurface: SubsurfaceStreams,
    /// The same for rays of irradiance samples, where random numbers continue.
    gathering: SubsurfaceStreams,
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
    /// Sets the streams aside while the rays of an irradiance sample use their own.
    pub(super) fn set_aside(&mut self, irradiance_depth: usize) -> RandomStreams {
        let before = *self;
        if self.continues && irradiance_depth == 0 {
            self.subsurface = self.gathering;
        }
        before
    }

    /// Resumes the streams that were set aside. Where random numbers continue, all rays of irradiance samples share one
    /// set of streams for subsurface light.
    pub(super) fn resume(&mut self, before: RandomStreams, irradiance_depth: usize) {
        let used = self.subsurface;
        *self = before;
        match irradiance_depth {
            _ if !self.continues => {}
            0 => self.gathering = used,
            _ => self.subsurface = used,
        }
    }

    /// Restarts all streams.
    pub fn restart(&mut self) {
        self.lights = Stream::default();
        self.media = Stream::default();
        self.crand = 0;
        self.subsurface = SubsurfaceStreams::default();
        self.gathering = SubsurfaceStreams::default();
    }
}

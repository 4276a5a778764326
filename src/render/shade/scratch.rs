//! State of a thread that traces rays: buffers that are reused between samples, and random numbers.

use super::subsurface::SubsurfaceStreams;
use crate::base::color::Rgb;
use crate::base::math::sampling::mersenne::Stream;
use crate::render::photons::Near;
use crate::render::radiosity::Session;
use crate::world::{BlockerMemory, QueryScratch, ShadowPacket4, World};

/// Per-thread state of tracing.
#[derive(Debug, Default)]
pub struct Scratch {
    /// The buffers of ray queries.
    pub query: QueryScratch,
    /// The random numbers of the current sample.
    pub random: RandomStreams,
    /// State that rays of irradiance samples share when traced in POV-Ray's order.
    pub(super) gathering: Option<Box<GatheringState>>,
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
    /// If true, random numbers continue from sample to sample instead of restarting.
    pub continues: bool,
}

/// Random numbers and the memory of blockers that all rays of irradiance samples share.
#[derive(Debug)]
pub(super) struct GatheringState {
    random: RandomStreams,
    memory: Option<Box<BlockerMemory>>,
}

/// The light that remains from one light of the grid of an area light.
#[derive(Clone, Copy, Debug)]
pub(super) struct GridSample {
    pub(super) light: Rgb,
    /// The distance from the last surface on its shadow ray to it.
    pub(super) last_segment: f64,
    /// True if a part of the grid has used it as a corner.
    pub(super) is_used: bool,
}

impl GridSample {
    /// That of a light not sampled yet.
    pub(super) const DARK: GridSample = GridSample {
        light: Rgb::BLACK,
        last_segment: 0.0,
        is_used: false,
    };
}

/// Buffers for the samples of an area light.
#[derive(Debug, Default)]
pub(super) struct AreaScratch {
    /// The samples of the grid, where taken.
    pub(super) samples: Vec<Option<GridSample>>,
    /// The distance from the last surface on the last new shadow ray of the current part of the grid to the light; none
    /// if that part had no new corner.
    pub(super) last_segment: Option<f64>,
    /// True if the grid was divided.
    pub(super) is_divided: bool,
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

    /// Starts to trace in POV-Ray's order, or starts again: random numbers continue from sample to sample, and what blocks a
    /// light is remembered if the world has POV-Ray's distances.
    pub fn begin_order(&mut self, world: &World) {
        let memory = || world.has_povray_distances().then(Box::default);
        let random = RandomStreams {
            continues: true,
            ..RandomStreams::default()
        };
        self.random = random;
        self.query.memory = memory();
        self.gathering = Some(Box::new(GatheringState {
            random,
            memory: memory(),
        }));
    }

    /// Turns to what the rays of irradiance samples hand on to later ones, and back. Changes nothing outside of
    /// POV-Ray's order.
    pub(super) fn swap_gathering(&mut self) {
        if let Some(gathering) = &mut self.gathering {
            std::mem::swap(&mut self.random, &mut gathering.random);
            std::mem::swap(&mut self.query.memory, &mut gathering.memory);
        }
    }
}

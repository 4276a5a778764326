//! Hits of a block with their rays and light samples.

use crate::base::math::sampling::mersenne::Stream;
use crate::render::shade::Path;
use crate::world::{HitPacket4, InteriorId, Occlusion, RayKind, ShadowPacket4};
use glam::DVec3;

/// Hits of many rays, with their shadow rays.
#[derive(Debug, Default)]
pub(in crate::render::shade) struct BlockHits {
    /// The hits, in packets of four.
    pub(in crate::render::shade) hits: Vec<HitPacket4>,
    /// The shadow rays, light by light.
    pub(in crate::render::shade) shadow_rays: Vec<ShadowPacket4>,
    /// The occlusion of the shadow rays is known; otherwise all that matter are marked as filtered. Area lights are
    /// marked as clear or filtered in any case.
    pub(in crate::render::shade) has_occlusion: bool,
    pub(crate) order: LightSortedOrder,
}

/// The order in which the hits of a block are tested against a light.
#[derive(Debug, Default)]
pub(crate) struct LightSortedOrder {
    /// The hits that the light may reach, in the order of the block.
    pub(crate) active: Vec<u16>,
    /// The direction from the light of each hit, to the right and upwards, in packets of four.
    pub(crate) seen: Vec<[[f32; 4]; 2]>,
    /// The grid cell of each shadow ray.
    pub(crate) cells: Vec<u16>,
    /// The number of rays in each cell, then the start of each cell.
    pub(crate) counts: Vec<u16>,
    /// The hits sorted by their direction from the light.
    pub(crate) sorted: Vec<u16>,
    pub(crate) occlusions: Vec<Occlusion>,
}

/// The rays that hit a packet of surfaces.
pub(in crate::render::shade) trait RaySource {
    /// The kind of the ray in this lane.
    fn kind(&self, lane: usize) -> RayKind;
    /// The common kind of all rays, if there is one.
    fn common_kind(&self) -> Option<RayKind>;
    /// The interiors around the ray in this lane.
    fn inside(&self, lane: usize) -> &[InteriorId];
    /// The random numbers that the sample of this lane begins with; `None` behind its first ray. Those of a picture whose
    /// random numbers run on are others.
    fn stream(&self, lane: usize) -> Option<Stream>;
    /// The path of the ray in this lane, in this direction.
    fn path(&self, lane: usize, dir: DVec3) -> Path;
}

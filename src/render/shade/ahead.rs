//! Samples in POV-Ray's order: what their camera rays hit, and the colours that do not depend on the order, are found
//! for many of them at once before their turns come.

use super::block::{BlockScratch, CameraRays};
use super::direct::area::skip_clear;
use super::direct::block_hits::BlockHits;
use super::direct::packet::{RadiancePacket4, ShadeBuffers};
use super::shading_point::LightSamples;
use super::wavefront::MANY_LIGHTS;
use super::{InteriorStack, Sample, Scratch, Tracer, begin_sample};
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::world::{HitPacket4, Occlusion, Query, QueryScratch, RayKind};
use arrayvec::ArrayVec;

/// The number of camera rays that are traced as one bundle.
pub(super) const BUNDLE: usize = 256;
/// The number of camera rays without a common origin that are traced together.
const STREAM: usize = 8;

/// Samples that are looked ahead.
#[derive(Debug, Default)]
pub struct Ahead {
    /// Their camera rays; none if they are not looked ahead.
    rays: Vec<Ray>,
    /// The interiors around the rays, where these differ.
    interior_stacks: Vec<InteriorStack>,
    all: BlockHits,
    /// Those that do not depend on the order.
    samples: Vec<Option<Sample>>,
}

impl Tracer<'_> {
    /// Prepares the samples at these positions, neighbours in the list close to each other, for
    /// [`Tracer::sample_ahead`]. Each must be taken once: its rays are counted already.
    pub fn look_ahead(
        &self,
        positions: &[(f64, f64)],
        size: (u32, u32),
        ahead: &mut Ahead,
        scratch: &mut BlockScratch,
    ) {
        let ShadeBuffers { scratch, cache } = scratch.buffers();
        let Ahead {
            rays,
            interior_stacks,
            all,
            samples,
        } = ahead;
        rays.clear();
        interior_stacks.clear();
        samples.clear();
        // Radiosity takes some samples from its first pass; the shadow rays to many lights would take too much memory.
        let has_many_lights = self.world.lights.len() > MANY_LIGHTS;
        if self.has_many_rays() || self.radiosity.is_some() || has_many_lights {
            return;
        }
        self.world.camera.add_primary_rays(positions, size, rays);
        if rays.len() < positions.len() {
            rays.clear();
            return;
        }
        self.find_hits(rays, all, scratch);
        samples.resize(rays.len(), None);
        all.shadow_rays.clear();
        // POV-Ray's memory of blockers changes what point lights reach.
        let has_memory = scratch.query.memory.is_some();
        if has_memory && !self.features.has_area_lights {
            return;
        }
        if self.has_stacks_of_rays() {
            let inside = |ray: &Ray| self.world.interiors_at(ray.origin);
            interior_stacks.extend(rays.iter().map(inside));
        }
        let count = rays.len();
        self.light_all(count, !has_memory, all, scratch);
        with_widest(
            #[inline(always)]
            |_| {
                let mut seen = RadiancePacket4::NOTHING;
                let packets = rays.chunks(4).zip(positions.chunks(4));
                for (packet, ((rays, positions), samples)) in
                    packets.zip(samples.chunks_mut(4)).enumerate()
                {
                    let buffers = ShadeBuffers {
                        scratch: &mut *scratch,
                        cache: &mut *cache,
                    };
                    let rays = CameraRays {
                        tracer: self,
                        positions,
                        rays,
                        interior_stacks: interior_stacks.get(4 * packet..).unwrap_or_default(),
                    };
                    self.shade_packet4(&rays, packet, count, all, buffers, &mut seen);
                    for (lane, sample) in samples.iter_mut().enumerate() {
                        *sample = seen.sample(lane);
                    }
                }
            },
        );
    }

    /// Finds the first hits of camera rays.
    fn find_hits(&self, rays: &[Ray], all: &mut BlockHits, scratch: &mut Scratch) {
        let hits = &mut all.hits;
        hits.resize(rays.len().div_ceil(4), HitPacket4::NOTHING);
        let query = &mut scratch.query;
        if self.world.camera.has_one_origin() {
            for (rays, hits) in rays.chunks(4).zip(&mut *hits) {
                for lane in 0..4 {
                    hits.aim(lane, rays[lane.min(rays.len() - 1)].dir);
                }
            }
            let origin = self.world.camera.location();
            for (rays, hits) in rays.chunks(BUNDLE).zip(hits.chunks_mut(BUNDLE / 4)) {
                self.world
                    .closest_hits_bundle(origin, rays.len(), hits, query);
            }
            return;
        }
        for (rays, hits) in rays.chunks(BUNDLE).zip(hits.chunks_mut(BUNDLE / 4)) {
            let world = self.world;
            if !world.closest_hits_parallel(rays.len(), |ray| rays[ray], hits, query) {
                self.find_scattered_hits(rays, hits, query);
            }
        }
    }

    /// Finds the first hits of camera rays that have neither their origin nor their direction in common.
    fn find_scattered_hits(&self, rays: &[Ray], hits: &mut [HitPacket4], query: &mut QueryScratch) {
        for (rays, hits) in rays.chunks(STREAM).zip(hits.chunks_mut(STREAM / 4)) {
            let queries = rays.iter().map(|&ray| Query {
                ray,
                origin_surface: None,
                t_max: f64::INFINITY,
                kind: RayKind::Camera,
            });
            let queries: ArrayVec<Query, STREAM> = queries.collect();
            self.world
                .nearest_of_stream(queries.len(), |ray| &queries[ray], hits, query);
        }
    }

    /// The sample at a position, whose turn it is: the one with this index of those looked ahead to.
    pub fn sample_ahead(
        &self,
        ahead: &Ahead,
        number: usize,
        (x, y): (f64, f64),
        (width, height): (u32, u32),
        scratch: &mut Scratch,
    ) -> Sample {
        let known_sample = ahead.samples.get(number).copied().flatten();
        if let Some(sample) = known_sample
            && !scratch.random.continues
        {
            return sample;
        }
        let Some(&ray) = ahead.rays.get(number) else {
            return self.pixel(x, y, width, height, scratch);
        };
        let (hits, lane) = (&ahead.all.hits[number / 4], number % 4);
        let known = LightSamples::at(&ahead.all, number);
        if let Some(sample) = known_sample {
            if hits.is_hit(lane) {
                self.skip_area_lights(hits.surface[lane], known, scratch);
            }
            return sample;
        }
        begin_sample(x, y, scratch);
        self.trace(
            self.camera_path(ray, ahead.interior_stacks.get(number)),
            Some((hits.hit(lane), known)),
            scratch,
        )
    }

    /// Leaves out the random numbers of the area lights whose light arrives at a surface.
    fn skip_area_lights(&self, surface: u32, known: LightSamples, scratch: &mut Scratch) {
        let lights = &self.world.lights;
        for &number in lights.of(self.world.surfaces[surface as usize].lights) {
            if let Some(area) = &lights.get(number).area
                && known.occlusion(number) == Some(Occlusion::Clear)
            {
                skip_clear(area, scratch);
            }
        }
    }
}

//! Tracing a block of pixels. Camera rays are traced as a bundle, shadow rays are traced light by light for all hits
//! ([`super::direct::block`]), and most surfaces are shaded four at a time ([`super::direct::packet`]). Reflected and
//! refracted rays form a wavefront ([`super::wavefront`]). Every other pixel takes the scalar path.

use super::ahead::Ahead;
use super::direct::block_hits::{BlockHits, RaySource};
use super::direct::packet::{RadiancePacket4, ShadeBuffers};
use super::shade_cache::ShadeCache;
use super::shading_point::LightSamples;
use super::wavefront::{MANY_LIGHTS, PixelSamples, SMALL_BATCH, Wavefront};
use super::{InteriorStack, Path, Sample, Scratch, Tracer, begin_sample};
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::Stream;
use crate::base::math::simd::with_widest;
use crate::world::{HitPacket4, InteriorId, RayCounts, RayKind};
use glam::DVec3;
use std::ops::Range;

/// The side of a block in pixels.
pub const BLOCK: u32 = 32;
/// The side of the parts of a block that are traced as one bundle.
const BUNDLE_SIDE: u32 = 16;

/// The columns and rows of eight adjacent pixels, which are traced together.
const GROUP_SIZE: (u32, u32) = (4, 2);

/// The range of the columns of some positions, and of their rows.
type PixelBounds = [[f64; 2]; 2];

/// Buffers that a thread reuses between blocks.
#[derive(Debug, Default)]
pub struct BlockScratch {
    pub(super) single: Scratch,
    /// The columns and rows of a block's pixels; then the first column and row of the block, and its width and height.
    whole: Vec<(f64, f64)>,
    block: (u32, u32, usize, usize),
    /// The end of each part that is traced as one bundle.
    parts: Vec<usize>,
    parts_of_block: Vec<usize>,
    /// The offset of each pixel to the right and down of the first pixel of its block.
    offsets: Vec<[u8; 2]>,
    /// The bounds of each run of [`SMALL_BATCH`] pixels, relative to the first pixel of its block.
    bounds: Vec<PixelBounds>,
    /// The camera hits at the positions.
    all: BlockHits,
    /// The samples of a batch.
    samples: PixelSamples,
    wavefront: Wavefront,
    shade_cache: ShadeCache,
    ahead: Ahead,
}

/// Up to four camera rays.
pub(super) struct CameraRays<'a, 'w> {
    pub(super) tracer: &'a Tracer<'w>,
    /// Their positions in the picture.
    pub(super) positions: &'a [(f64, f64)],
    /// The rays; none if they start at the location of the camera.
    pub(super) rays: &'a [Ray],
    /// The interiors around their starts, where these differ.
    pub(super) interior_stacks: &'a [InteriorStack],
}

impl RaySource for CameraRays<'_, '_> {
    #[inline(always)]
    fn kind(&self, _lane: usize) -> RayKind {
        RayKind::Camera
    }

    #[inline(always)]
    fn common_kind(&self) -> Option<RayKind> {
        Some(RayKind::Camera)
    }

    fn inside(&self, lane: usize) -> &[InteriorId] {
        let around_camera = &self.tracer.around_camera;
        self.interior_stacks.get(lane).unwrap_or(around_camera)
    }

    fn stream(&self, lane: usize) -> Option<Stream> {
        let position = self.positions.get(lane);
        position.map(|&(x, y)| Stream::of_sample(x, y))
    }

    fn path(&self, lane: usize, dir: DVec3) -> Path {
        let from_location = || Ray::new(self.tracer.world.camera.location(), dir);
        let ray = self.rays.get(lane).copied();
        let ray = ray.unwrap_or_else(from_location);
        self.tracer.camera_path(ray, self.interior_stacks.get(lane))
    }
}

/// The first hit of a camera ray.
#[derive(Clone, Copy, Debug)]
pub struct FirstHit {
    /// The index of the primitive.
    pub leaf: u32,
    /// Its outward unit shading normal there, without bump mapping.
    pub normal: DVec3,
}

impl BlockScratch {
    /// Lists the pixels of a block: part by part, and group by group within.
    fn lay_out(&mut self, columns: &Range<u32>, rows: &Range<u32>) {
        let (left, top, width, height) = self.block;
        self.block = (columns.start, rows.start, columns.len(), rows.len());
        if (width, height) == (columns.len(), rows.len()) && !self.whole.is_empty() {
            // Another block of the same size.
            let right = f64::from(columns.start) - f64::from(left);
            let down = f64::from(rows.start) - f64::from(top);
            for (x, y) in &mut self.whole {
                *x += right;
                *y += down;
            }
            self.parts.clone_from(&self.parts_of_block);
            return;
        }
        self.whole.clear();
        self.parts.clear();
        for rows in split(rows, BUNDLE_SIDE) {
            for columns in split(columns, BUNDLE_SIDE) {
                for rows in split(&rows, GROUP_SIZE.1) {
                    for columns in split(&columns, GROUP_SIZE.0) {
                        let row = |y| columns.clone().map(move |x| (f64::from(x), f64::from(y)));
                        self.whole.extend(rows.clone().flat_map(row));
                    }
                }
                // Parts begin at packet boundaries.
                self.parts.push(self.whole.len() / 4 * 4);
            }
        }
        if let Some(last) = self.parts.last_mut() {
            *last = self.whole.len();
        }
        self.parts_of_block.clone_from(&self.parts);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a block has few columns and rows"
        )]
        let offset = |&(x, y): &(f64, f64)| {
            [x - f64::from(columns.start), y - f64::from(rows.start)].map(|off| off as u8)
        };
        self.offsets.clear();
        self.offsets.extend(self.whole.iter().map(offset));
        self.bounds.clear();
        let first = [columns.start, rows.start].map(f64::from);
        self.bounds
            .extend(self.whole.chunks(SMALL_BATCH).map(|positions| {
                let [columns, rows] = pixel_bounds(positions);
                [columns.map(|x| x - first[0]), rows.map(|y| y - first[1])]
            }));
    }

    /// Returns true if random numbers continue from sample to sample.
    pub fn continues_random(&self) -> bool {
        self.single.random.continues
    }

    /// The buffers for shading.
    pub(super) fn buffers(&mut self) -> ShadeBuffers<'_> {
        ShadeBuffers {
            scratch: &mut self.single,
            cache: &mut self.shade_cache,
        }
    }

    /// The buffers of scalar rays.
    pub fn single(&mut self) -> &mut Scratch {
        &mut self.single
    }

    /// Takes the ray counts since the last call.
    pub fn take_rays(&mut self) -> RayCounts {
        std::mem::take(&mut self.single.query.rays)
    }
}

impl Tracer<'_> {
    /// Traces the pixels of a block no larger than [`BLOCK`] on a side, of a picture of `size` (width, height). `take`
    /// gets the offset to the right and down of the first pixel, and the sample, in any order. Bit-identical to
    /// [`Tracer::pixel`].
    pub fn block(
        &self,
        columns: &Range<u32>,
        rows: &Range<u32>,
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut([u8; 2], Sample),
    ) {
        scratch.lay_out(columns, rows);
        let whole = std::mem::take(&mut scratch.whole);
        let offsets = std::mem::take(&mut scratch.offsets);
        let bounds = std::mem::take(&mut scratch.bounds);
        let first = [columns.start, rows.start].map(f64::from);
        let bounds_of = |piece: usize, _: &[_]| {
            let [columns, rows] = bounds[piece];
            [columns.map(|x| x + first[0]), rows.map(|y| y + first[1])]
        };
        self.trace_positions(
            &whole,
            bounds_of,
            size,
            scratch,
            #[inline(always)]
            |number, sample, _| take(offsets[number], sample),
        );
        (scratch.whole, scratch.offsets, scratch.bounds) = (whole, offsets, bounds);
    }

    /// Traces positions of a picture of `size`: no more than a block has pixels, neighbours in the list close to each
    /// other; integral numbers are pixel centres. `take` gets the index of the position, the sample, and the first hit
    /// if it is known, in any order. Bit-identical to [`Tracer::pixel`].
    pub fn sample_positions(
        &self,
        positions: &[(f64, f64)],
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(usize, Sample, Option<FirstHit>),
    ) {
        scratch.parts.clear();
        let end = positions.len();
        let ends = (0..end)
            .step_by((BUNDLE_SIDE * BUNDLE_SIDE) as usize)
            .skip(1);
        scratch.parts.extend(ends.chain([end]));
        let bounds = |_, positions: &[_]| pixel_bounds(positions);
        self.trace_positions(positions, bounds, size, scratch, |number, sample, hits| {
            let lane = number % 4;
            let hits = hits.filter(|hits| hits.is_hit(lane));
            let first_hit = hits.map(|hits| FirstHit {
                leaf: hits.leaf[lane],
                normal: hits.shading_normal(lane),
            });
            take(number, sample, first_hit);
        });
    }

    /// Traces samples one after the other, in POV-Ray's order, at positions near each other.
    pub fn sample_in_order(
        &self,
        positions: &[(f64, f64)],
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(usize, Sample),
    ) {
        let mut ahead = std::mem::take(&mut scratch.ahead);
        self.look_ahead(positions, size, &mut ahead, scratch);
        for (number, &at) in positions.iter().enumerate() {
            let sample = self.sample_ahead(&ahead, number, at, size, &mut scratch.single);
            take(number, sample);
        }
        scratch.ahead = ahead;
    }

    /// Traces positions whose parts are laid out; `bounds` gives the bounds of a run of them.
    fn trace_positions(
        &self,
        positions: &[(f64, f64)],
        bounds: impl Fn(usize, &[(f64, f64)]) -> PixelBounds,
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(usize, Sample, Option<&HitPacket4>),
    ) {
        // Light buffers share no traversal between rays, so small batches stay in cache. With many lights the shadow
        // rays of a large batch would take too much memory.
        let uses_small_batches =
            self.world.has_all_light_buffers() || self.world.lights.len() > MANY_LIGHTS;
        let parts = std::mem::take(&mut scratch.parts);
        let at_once = if uses_small_batches {
            SMALL_BATCH
        } else {
            positions.len().max(1)
        };
        for (piece, positions) in positions.chunks(at_once).enumerate() {
            let whole = [positions.len()];
            let parts = if uses_small_batches {
                &whole
            } else {
                &parts[..]
            };
            if uses_small_batches
                && let Some(background) = self.background_within(bounds(piece, positions), size)
            {
                scratch.single.query.rays.camera += positions.len() as u64;
                for number in 0..positions.len() {
                    take(at_once * piece + number, background, None);
                }
                continue;
            }
            let has_hits = self.trace_batch(positions, parts, size, scratch);
            for (number, sample) in scratch.samples.drain(..) {
                let hits = scratch.all.hits.get(number / 4).filter(|_| has_hits);
                take(at_once * piece + number, sample, hits);
            }
        }
        scratch.parts = parts;
    }

    /// The background, if nothing else is visible within these bounds and it is the same everywhere.
    fn background_within(
        &self,
        bounds: PixelBounds,
        (width, height): (u32, u32),
    ) -> Option<Sample> {
        let world = self.world;
        let is_even = self.fast_paths.packets
            && !self.has_atmosphere()
            && world.sky.is_none()
            && world.lens.is_none();
        if !is_even || self.stop.is_cancelled() {
            return None;
        }
        let (width, height) = (f64::from(width), f64::from(height));
        let [left, right] = bounds[0].map(|x| (x + 0.5) / width - 0.5);
        let [top, bottom] = bounds[1].map(|y| 0.5 - (y + 0.5) / height);
        let is_empty = world.is_background([left, bottom], [right, top]);
        is_empty.then(|| self.background_of(RayKind::Camera).seen)
    }

    /// Traces positions in parts with the ends `parts`, and appends their samples to the scratch. Returns true if the
    /// first hits are known too.
    fn trace_batch(
        &self,
        positions: &[(f64, f64)],
        parts: &[usize],
        size: (u32, u32),
        scratch: &mut BlockScratch,
    ) -> bool {
        if !self.trace_camera_rays(positions, parts, size, scratch) {
            self.trace_without_common_origin(positions, size, scratch);
            return false;
        }
        let count = positions.len();
        self.light_all(count, true, &mut scratch.all, &mut scratch.single);
        with_widest(
            #[inline(always)]
            |_| {
                let mut seen = RadiancePacket4::NOTHING;
                for (packet, positions) in positions.chunks(4).enumerate() {
                    let BlockScratch {
                        single,
                        all,
                        shade_cache,
                        ..
                    } = scratch;
                    let buffers = ShadeBuffers {
                        scratch: single,
                        cache: shade_cache,
                    };
                    let rays = CameraRays {
                        tracer: self,
                        positions,
                        rays: &[],
                        interior_stacks: &[],
                    };
                    self.shade_packet4(&rays, packet, count, all, buffers, &mut seen);
                    if seen.is_known(positions.len()) {
                        let known = |lane| (4 * packet + lane, seen.known(lane));
                        scratch.samples.extend((0..positions.len()).map(known));
                        continue;
                    }
                    for (lane, &(x, y)) in positions.iter().enumerate() {
                        let number = 4 * packet + lane;
                        let secondary = seen
                            .secondary(&scratch.all.hits[packet], lane)
                            .filter(|_| scratch.wavefront.has_capacity());
                        let sample = match (seen.sample(lane), secondary) {
                            (Some(sample), _) => sample,
                            (None, Some(secondary)) => {
                                let hits = &scratch.all.hits[packet];
                                let single = &mut scratch.single;
                                let wavefront = &mut scratch.wavefront;
                                self.begin_wavefront(
                                    wavefront, number, hits, lane, &secondary, single,
                                );
                                continue;
                            }
                            (None, None) => match self.shade_scalar(number, x, y, scratch) {
                                Some(sample) => sample,
                                None => continue,
                            },
                        };
                        scratch.samples.push((number, sample));
                    }
                }
            },
        );
        self.trace_queued_rays(scratch);
        true
    }

    /// Traces the rays that wait in the wavefront.
    fn trace_queued_rays(&self, scratch: &mut BlockScratch) {
        let buffers = ShadeBuffers {
            scratch: &mut scratch.single,
            cache: &mut scratch.shade_cache,
        };
        self.trace_wavefronts(&mut scratch.wavefront, buffers, &mut scratch.samples);
    }

    /// [`Self::trace_batch`] where camera rays have no common origin, or some positions have none: the rays are traced as
    /// secondary rays.
    fn trace_without_common_origin(
        &self,
        positions: &[(f64, f64)],
        (width, height): (u32, u32),
        scratch: &mut BlockScratch,
    ) {
        let world = self.world;
        let is_scalar = !self.fast_paths.wavefront
            || world.radiosity.is_some()
            || !self.is_above_bailout(0, 1.0, 0);
        if !is_scalar && self.has_many_rays() {
            self.queue_many_rays(positions, (width, height), scratch);
            return;
        }
        if is_scalar {
            let mut samples = std::mem::take(&mut scratch.samples);
            let take = |number, sample| samples.push((number, sample));
            self.sample_in_order(positions, (width, height), scratch, take);
            scratch.samples = samples;
            return;
        }
        for (number, &(x, y)) in positions.iter().enumerate() {
            match world.camera.primary_ray(x, y, width, height) {
                Some(ray) => self.queue_camera_ray(&mut scratch.wavefront, number, ray),
                None => scratch.samples.push((number, Sample::OUTSIDE)),
            }
        }
        self.trace_queued_rays(scratch);
    }

    /// [`Self::trace_batch`] where positions have several rays each: all are traced as secondary rays.
    fn queue_many_rays(
        &self,
        positions: &[(f64, f64)],
        size: (u32, u32),
        scratch: &mut BlockScratch,
    ) {
        let BlockScratch {
            single,
            shade_cache,
            wavefront,
            samples,
            ..
        } = scratch;
        let mut traced = PixelSamples::new();
        let trace = |rays: &[Option<Ray>], seen: &mut [Sample]| {
            for (number, ray) in rays.iter().enumerate() {
                if let Some(ray) = *ray {
                    self.queue_camera_ray(wavefront, number, ray);
                }
            }
            let buffers = ShadeBuffers {
                scratch: single,
                cache: shade_cache,
            };
            self.trace_wavefronts(wavefront, buffers, &mut traced);
            for (number, sample) in traced.drain(..) {
                seen[number] = sample;
            }
        };
        self.trace_many_rays(positions, size, trace, |number, sample| {
            samples.push((number, sample));
        });
    }

    /// Traces one position from its known hit and light samples; `None` if its secondary rays are queued.
    #[inline(never)]
    fn shade_scalar(
        &self,
        number: usize,
        x: f64,
        y: f64,
        scratch: &mut BlockScratch,
    ) -> Option<Sample> {
        let known = LightSamples::at(&scratch.all, number);
        let hits = &scratch.all.hits[number / 4];
        let (dir, hit) = (hits.dir(number % 4), hits.hit(number % 4));
        let single = &mut scratch.single;
        if self.fast_paths.queues_all_surfaces && self.is_above_bailout(0, 1.0, 0) {
            return self.shade_or_queue_camera_hit(
                &mut scratch.wavefront,
                number,
                dir,
                hit,
                known,
                single,
            );
        }
        let path = self.camera_path(Ray::new(self.world.camera.location(), dir), None);
        if self.radiosity.is_some() {
            let see = |single: &mut Scratch| self.trace(path, Some((hit, known)), single);
            return Some(self.recall_or_trace(x, y, single, see));
        }
        begin_sample(x, y, single);
        Some(self.trace(path, Some((hit, known)), single))
    }

    /// Traces the camera rays; false if they have no common origin.
    fn trace_camera_rays(
        &self,
        positions: &[(f64, f64)],
        parts: &[usize],
        size: (u32, u32),
        scratch: &mut BlockScratch,
    ) -> bool {
        let camera = &self.world.camera;
        if !camera.has_one_origin() || self.world.lens.is_some() {
            return false;
        }
        let hits = &mut scratch.all.hits;
        hits.resize(positions.len().div_ceil(4), HitPacket4::NOTHING);
        let are_aimed = with_widest(
            #[inline(always)]
            |lanes| {
                camera.for_each_dir_packet(lanes, positions, size, |packet, dirs| {
                    hits[packet].dir = dirs
                }) || positions
                    .chunks(4)
                    .zip(&mut *hits)
                    .all(|(positions, hits)| {
                        (0..4).all(|lane| {
                            let (x, y) = positions[lane.min(positions.len() - 1)];
                            let ray = camera.primary_ray(x, y, size.0, size.1);
                            ray.inspect(|ray| hits.aim(lane, ray.dir)).is_some()
                        })
                    })
            },
        );
        if !are_aimed {
            return false;
        }
        let mut first = 0;
        for &end in parts {
            let origin = camera.location();
            let hits = &mut scratch.all.hits[first / 4..end.div_ceil(4)];
            self.world
                .closest_hits_bundle(origin, end - first, hits, &mut scratch.single.query);
            first = end;
        }
        true
    }
}

/// The bounds of some positions.
fn pixel_bounds(positions: &[(f64, f64)]) -> PixelBounds {
    let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for &(x, y) in positions {
        for ([low, high], at) in bounds.iter_mut().zip([x, y]) {
            // Two instructions, unlike `f64::min`, which tests both for NaN.
            *low = if at < *low { at } else { *low };
            *high = if at > *high { at } else { *high };
        }
    }
    bounds
}

/// A range in pieces of this length; the last may be shorter.
fn split(range: &Range<u32>, length: u32) -> impl Iterator<Item = Range<u32>> + use<> {
    let end = range.end;
    let starts = range.clone().step_by(length as usize);
    starts.map(move |start| start..(start + length).min(end))
}

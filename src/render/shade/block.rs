//! A block of pixels at once: what the camera sees at all of them is searched for together, then, for each light, what
//! stands between it and all the points seen ([`super::direct::block`]), and plain places are coloured four at a time
//! ([`super::direct::packet`]). What plain surfaces show of others is looked for together again ([`super::wavefront`]). Everything else
//! goes one pixel at a time, as for a single one.

use super::direct::block::BlockHits;
use super::direct::light::LightSamples;
use super::direct::packet::{RadiancePacket4, RaySource};
use super::shade_cache::ShadeCache;
use super::wavefront::Wavefront;
use super::{Path, Sample, Tracer, begin_sample};
use crate::base::math::Ray;
use crate::base::math::simd::with_widest;
use crate::world::{HitPacket4, InteriorId, RayCounts, RayKind, Scratch};
use glam::DVec3;
use std::ops::Range;

/// The side of a block in pixels.
pub const BLOCK: u32 = 32;
/// The side of the parts of a block that are searched together.
const SEARCHED: u32 = 16;
/// So many are searched for, lit and coloured together where it is known what lies around camera and lamps.
pub(super) const AROUND: usize = 64;
/// The same where there are more lights than this.
pub(super) const MANY_LIGHTS: usize = 64;
/// Pixels that lie together are searched for together: eight, in columns and rows.
const GROUP: (u32, u32) = (4, 2);

/// The least and the largest of some places' columns, and of their rows.
type PixelBounds = [[f64; 2]; 2];

/// Buffers that a thread keeps between blocks.
#[derive(Debug, Default)]
pub struct BlockScratch {
    pub(super) single: Scratch,
    /// The columns and rows of a block's pixels, and the block's own first ones and how many there are.
    whole: Vec<(f64, f64)>,
    block: (u32, u32, usize, usize),
    /// Where each part of the places that are searched together ends.
    parts: Vec<usize>,
    parts_of_block: Vec<usize>,
    /// How far to the right and down of the first pixel of its block each place lies.
    offsets: Vec<[u8; 2]>,
    /// Between which columns and rows, counted from there, [`AROUND`] of them after the other lie.
    bounds: Vec<PixelBounds>,
    /// What the camera sees at the places.
    all: BlockHits,
    waves: Wavefront,
    coats: ShadeCache,
}

/// Rays of a camera all of which start in one point.
struct FromCamera<'t, 'w>(&'t Tracer<'w>);

impl RaySource for FromCamera<'_, '_> {
    #[inline(always)]
    fn seen(&self, _lane: usize) -> RayKind {
        RayKind::Camera
    }

    #[inline(always)]
    fn all_seen(&self) -> Option<RayKind> {
        Some(RayKind::Camera)
    }

    fn inside(&self, _lane: usize) -> &[InteriorId] {
        &self.0.around_camera
    }

    fn path(&self, _lane: usize, dir: DVec3) -> Path {
        self.0
            .camera_path(Ray::new(self.0.world.camera.location(), dir))
    }
}

/// What is met first at a place.
#[derive(Clone, Copy, Debug)]
pub struct FirstHit {
    /// The number of the primitive.
    pub leaf: u32,
    /// Its outward unit normal there, for shading and without bumps.
    pub normal: DVec3,
}

impl BlockScratch {
    /// Lists the places of a block: part by part, and there group by group.
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
        for rows in split(rows, SEARCHED) {
            for columns in split(columns, SEARCHED) {
                for rows in split(&rows, GROUP.1) {
                    for columns in split(&columns, GROUP.0) {
                        let row = |y| columns.clone().map(move |x| (f64::from(x), f64::from(y)));
                        self.whole.extend(rows.clone().flat_map(row));
                    }
                }
                // Parts begin where fours do.
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
        self.bounds.extend(self.whole.chunks(AROUND).map(|places| {
            let [columns, rows] = between(places);
            [columns.map(|x| x - first[0]), rows.map(|y| y - first[1])]
        }));
    }

    /// Whether random numbers go on from sample to sample.
    pub fn goes_on(&self) -> bool {
        self.single.goes_on
    }

    /// What it keeps for rays that are followed one at a time.
    pub fn single(&mut self) -> &mut Scratch {
        &mut self.single
    }

    /// How many rays were followed with it since this was last asked.
    pub fn take_rays(&mut self) -> RayCounts {
        std::mem::take(&mut self.single.rays)
    }
}

impl Tracer<'_> {
    /// What the camera sees at the whole pixels of a block no larger than [`BLOCK`] on a side, of a picture of `size`
    /// (width, height). `take` gets how far to the right and down of the first pixel one lies, and its sample, in any
    /// order. To the bit what [`Tracer::pixel`] gives.
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
        self.seen_at(
            (&whole, bounds_of),
            size,
            scratch,
            #[inline(always)]
            |number, sample, _| take(offsets[number], sample),
        );
        (scratch.whole, scratch.offsets, scratch.bounds) = (whole, offsets, bounds);
    }

    /// What the camera sees at places of a picture of `size`, no more than a block has pixels and such that neighbours
    /// in the list lie near each other; whole numbers are centres of pixels. `take` gets the number of the place, what is
    /// seen, and what was met first if that is known, in any order. To the bit what [`Tracer::pixel`] gives.
    pub fn places(
        &self,
        places: &[(f64, f64)],
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(usize, Sample, Option<FirstHit>),
    ) {
        scratch.parts.clear();
        let end = places.len();
        let ends = (0..end).step_by((SEARCHED * SEARCHED) as usize).skip(1);
        scratch.parts.extend(ends.chain([end]));
        let bounds = |_, places: &[_]| between(places);
        self.seen_at((places, bounds), size, scratch, |number, sample, hits| {
            let lane = number % 4;
            let hits = hits.filter(|hits| hits.is_met(lane));
            let met = hits.map(|hits| FirstHit {
                leaf: hits.leaf[lane],
                normal: hits.shading_normal(lane),
            });
            take(number, sample, met);
        });
    }

    /// The same with the parts laid out; `bounds` tells between what the places of a piece of them lie.
    fn seen_at(
        &self,
        (places, bounds): (&[(f64, f64)], impl Fn(usize, &[(f64, f64)]) -> PixelBounds),
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(usize, Sample, Option<&HitPacket4>),
    ) {
        // Where no walk is shared fewer at a time stay nearer at hand, and the ways to many lights would take much room.
        let are_few = self.world.has_all_light_buffers() || self.world.lights.len() > MANY_LIGHTS;
        let parts = std::mem::take(&mut scratch.parts);
        let at_once = if are_few { AROUND } else { places.len().max(1) };
        for (piece, places) in places.chunks(at_once).enumerate() {
            let whole = [places.len()];
            let parts = if are_few { &whole } else { &parts[..] };
            if are_few && let Some(background) = self.nothing_at(bounds(piece, places), size) {
                scratch.single.rays.camera += places.len() as u64;
                for number in 0..places.len() {
                    take(at_once * piece + number, background, None);
                }
                continue;
            }
            self.seen_together(
                (places, parts),
                size,
                scratch,
                #[inline(always)]
                |number, sample, hits| {
                    take(at_once * piece + number, sample, hits);
                },
            );
        }
        scratch.parts = parts;
    }

    /// The background, if nothing else is seen between these places, and it is the same everywhere.
    fn nothing_at(&self, between: PixelBounds, (width, height): (u32, u32)) -> Option<Sample> {
        let world = self.world;
        let is_even =
            self.takes_plain && !self.has_air() && world.sky.is_none() && world.lens.is_none();
        if !is_even || self.stop.is_asked() {
            return None;
        }
        let (width, height) = (f64::from(width), f64::from(height));
        let [left, right] = between[0].map(|x| (x + 0.5) / width - 0.5);
        let [top, bottom] = between[1].map(|y| 0.5 - (y + 0.5) / height);
        let is_empty = world.is_background([left, bottom], [right, top]);
        is_empty.then(|| self.background_of(RayKind::Camera).seen)
    }

    /// The same for places in parts that end where `parts` tells.
    fn seen_together(
        &self,
        (places, parts): (&[(f64, f64)], &[usize]),
        size: (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(usize, Sample, Option<&HitPacket4>),
    ) {
        if !self.search((places, parts), size, scratch) {
            self.seen_from_anywhere(places, size, scratch, |number, sample| {
                take(number, sample, None);
            });
            return;
        }
        let count = places.len();
        self.light_all(count, true, &mut scratch.all, &mut scratch.single);
        with_widest(
            #[inline(always)]
            |_| {
                let mut seen = RadiancePacket4::NOTHING;
                for (four, places) in places.chunks(4).enumerate() {
                    let BlockScratch {
                        single, all, coats, ..
                    } = scratch;
                    let kept = (single, coats);
                    self.shade_packet4(&FromCamera(self), (four, count), all, kept, &mut seen);
                    if seen.is_known(places.len()) {
                        for lane in 0..places.len() {
                            take(4 * four + lane, seen.known(lane), all.hits.get(four));
                        }
                        continue;
                    }
                    for (lane, &place) in places.iter().enumerate() {
                        let number = 4 * four + lane;
                        let showing = seen.showing(lane).filter(|_| scratch.waves.have_room());
                        let sample = match (seen.sample(lane), showing) {
                            (Some(sample), _) => sample,
                            (None, Some(showing)) => {
                                let hits = (&scratch.all.hits[four], lane);
                                let single = &mut scratch.single;
                                let waves = &mut scratch.waves;
                                self.begin_wavefront(waves, number, hits, &showing, single);
                                continue;
                            }
                            (None, None) => match self.seen_singly(number, place, scratch) {
                                Some(sample) => sample,
                                None => continue,
                            },
                        };
                        take(number, sample, scratch.all.hits.get(four));
                    }
                }
            },
        );
        let BlockScratch {
            single,
            all,
            waves,
            coats,
            ..
        } = scratch;
        self.follow_wavefronts(waves, (single, coats), |number, sample| {
            take(number, sample, all.hits.get(number / 4));
        });
    }

    /// The same where the rays of the camera do not start in one point, or some places have none: those that there are
    /// are followed as rays that go on from surfaces are.
    fn seen_from_anywhere(
        &self,
        places: &[(f64, f64)],
        (width, height): (u32, u32),
        scratch: &mut BlockScratch,
        mut take: impl FnMut(usize, Sample),
    ) {
        let world = self.world;
        let has_one_ray = world.lens.is_none() && world.camera.rays() == 1;
        let goes_singly = !has_one_ray
            || !self.sends_waves
            || world.radiosity.is_some()
            || !self.is_above_bailout((0, 1.0), 0);
        for (number, &(x, y)) in places.iter().enumerate() {
            if goes_singly {
                take(number, self.pixel(x, y, width, height, &mut scratch.single));
                continue;
            }
            match world.camera.primary_ray(x, y, width, height) {
                Some(ray) => self.begin_ray(&mut scratch.waves, number, ray),
                None => take(number, Sample::OUTSIDE),
            }
        }
        let BlockScratch {
            single,
            waves,
            coats,
            ..
        } = scratch;
        self.follow_wavefronts(waves, (single, coats), take);
    }

    /// What the camera sees at the place of this number, of which all that can be found out together is known; nothing if
    /// it is noted what goes on from there.
    #[inline(never)]
    fn seen_singly(
        &self,
        number: usize,
        (x, y): (f64, f64),
        scratch: &mut BlockScratch,
    ) -> Option<Sample> {
        let known = LightSamples::at(&scratch.all, number);
        let hits = &scratch.all.hits[number / 4];
        let (dir, hit) = (hits.dir(number % 4), hits.hit(number % 4));
        let single = &mut scratch.single;
        if self.queues && self.is_above_bailout((0, 1.0), 0) {
            let met = (dir, hit, known);
            return self.seen_by_camera(&mut scratch.waves, number, met, single);
        }
        let path = self.camera_path(Ray::new(self.world.camera.location(), dir));
        if self.world.radiosity.is_some() {
            let see = |single: &mut Scratch| self.trace(path, Some((hit, known)), single);
            return Some(self.noted((x, y), single, see));
        }
        begin_sample(x, y, single);
        Some(self.trace(path, Some((hit, known)), single))
    }

    /// Searches for what the camera sees; false if its rays do not start in one
    /// point.
    fn search(
        &self,
        (places, parts): (&[(f64, f64)], &[usize]),
        size: (u32, u32),
        scratch: &mut BlockScratch,
    ) -> bool {
        let camera = &self.world.camera;
        if !camera.has_one_origin() || self.world.lens.is_some() {
            return false;
        }
        let hits = &mut scratch.all.hits;
        hits.resize(places.len().div_ceil(4), HitPacket4::NOTHING);
        let are_aimed = with_widest(
            #[inline(always)]
            |lanes| {
                camera.aim_all(lanes, places, size, |four, dirs| hits[four].dir = dirs)
                    || places.chunks(4).zip(&mut *hits).all(|(places, hits)| {
                        (0..4).all(|lane| {
                            let (x, y) = places[lane.min(places.len() - 1)];
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
                .closest_hits_bundle(origin, end - first, hits, &mut scratch.single);
            first = end;
        }
        true
    }
}

/// Between what some places lie.
fn between(places: &[(f64, f64)]) -> PixelBounds {
    let mut between = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for &(x, y) in places {
        for ([low, high], at) in between.iter_mut().zip([x, y]) {
            // Two instructions, unlike `f64::min`, which asks whether both are numbers.
            *low = if at < *low { at } else { *low };
            *high = if at > *high { at } else { *high };
        }
    }
    between
}

/// A range in pieces of this length; the last may be shorter.
fn split(range: &Range<u32>, length: u32) -> impl Iterator<Item = Range<u32>> + use<> {
    let end = range.end;
    let starts = range.clone().step_by(length as usize);
    starts.map(move |start| start..(start + length).min(end))
}

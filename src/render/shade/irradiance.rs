//! A new sample of gathered light: rays all around a point, and what they find.
//!
//! The rays start anew: they know of no interiors around them, meet neither fog nor media (unless the scene asks for
//! that), and see lights as points and no highlights. What they find at their ends hangs on the samples that those before
//! them made. Where there are several threads all are sent at once with the samples that there are; those for which there
//! were too few, or for which one that came since counts, are sent again in their turn.

use super::direct::light::LightSamples;
use super::radiosity::IrradiancePoint;
use super::{Inside, Path, Tracer};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::{Stream, seed_of_sample};
use crate::render::radiosity::{
    CacheQuery, Frame, IrradianceSample, LightRequest, Mode, Radiosity,
};
use crate::scene::Importance;
use crate::scene::atmosphere::WAY_TO_NOTHING;
use crate::world::{Hit, Query, RayCounts, RayKind, Scratch};
use glam::DVec3;
use rayon::prelude::*;

/// A sample whose nearest neighbour is nearer than this share of its largest radius is not kept.
const TOO_NEAR: f64 = 1e-4;
/// For fewer rays other threads are not asked.
const MANY: u32 = 24;
/// So many are sent by a thread at least.
const TOGETHER: usize = 8;

/// What a ray found.
#[derive(Clone, Copy)]
struct GatheredRay {
    /// How far away, if anything.
    distance: Option<f64>,
    light: Rgb,
    /// The quality of the light.
    quality: f64,
    /// How much the ray counts.
    weight: f64,
}

/// The same found without making samples.
struct WatchedRay {
    found: GatheredRay,
    asked: LightRequest,
    rays: RayCounts,
}

/// The sum of what rays found.
struct IrradianceSum {
    light: Rgb,
    qualities: f64,
    weights: f64,
    /// The sum of the reciprocals of the distances.
    nearness: f64,
    nearest: f64,
    to_nearest: DVec3,
}

impl IrradianceSum {
    fn add(&mut self, dir: DVec3, found: &GatheredRay) {
        if let Some(distance) = found.distance {
            self.nearness += 1.0 / distance;
            if distance < self.nearest {
                (self.nearest, self.to_nearest) = (distance, dir);
            }
        }
        let share = found.quality * found.weight;
        self.qualities += share;
        self.weights += found.weight;
        self.light += found.light * share;
    }
}

impl Tracer<'_> {
    /// A new sample for a look at the front (1) or the back (-1) of a surface; whether it is to be kept.
    pub(super) fn gather(
        &self,
        gathering: &IrradiancePoint,
        (look, side): (&CacheQuery, f64),
        scratch: &mut Scratch,
    ) -> (IrradianceSample, bool) {
        let &IrradiancePoint {
            radiosity, depth, ..
        } = gathering;
        let count = radiosity.rays(depth);
        let mut aim = HemisphereSampler::new(look.normal, side * gathering.flat, count);
        let mut sum = IrradianceSum {
            light: Rgb::BLACK,
            qualities: 0.0,
            weights: 0.0,
            nearness: 0.0,
            nearest: WAY_TO_NOTHING * self.world.globals.unit,
            to_nearest: look.normal,
        };
        let random = (scratch.stream, scratch.media_stream, scratch.crand);
        if self.sends_together(depth, count, scratch) {
            self.send_together(gathering, look, &mut aim, &mut sum, scratch);
        } else {
            for number in 0..count {
                let dir = aim.next(radiosity, depth, scratch);
                sum.add(dir, &self.send(gathering, look, (number, dir), scratch));
            }
        }
        (scratch.stream, scratch.media_stream, scratch.crand) = random;
        let eye = self.world.camera.location().distance(look.point);
        let [least, most] = radiosity.reuse(depth).map(|reuse| reuse * eye);
        let sample = IrradianceSample {
            point: look.point,
            normal: look.normal,
            light: sum.light * (1.0 / sum.qualities),
            radius: single((f64::from(count) / sum.nearness).clamp(least, most)),
            nearest: single(sum.nearest),
            to_nearest: sum.to_nearest,
            quality: sum.qualities / sum.weights,
            depth,
        };
        (sample, sum.nearest > TOO_NEAR * most)
    }

    /// Whether other threads help with a sample.
    fn sends_together(&self, depth: usize, count: u32, scratch: &Scratch) -> bool {
        let session = scratch.radiosity.as_deref();
        depth == 0
            && count >= MANY
            && session.is_some_and(|session| session.mode == Mode::Grow)
            && rayon::current_num_threads() > 1
    }

    /// Sends all rays of a sample on all threads.
    fn send_together(
        &self,
        gathering: &IrradiancePoint,
        look: &CacheQuery,
        aim: &mut HemisphereSampler,
        sum: &mut IrradianceSum,
        scratch: &mut Scratch,
    ) {
        let &IrradiancePoint {
            radiosity, depth, ..
        } = gathering;
        let numbers = 0..radiosity.rays(depth);
        let aimed = numbers.map(|number| (number, aim.next(radiosity, depth, scratch)));
        let aimed: Vec<(u32, DVec3)> = aimed.collect();
        let Some(session) = scratch.radiosity.as_deref() else {
            return;
        };
        let watching = || {
            let mut scratch = Scratch::default();
            scratch.radiosity = Some(Box::new(session.in_mode(Mode::Watch)));
            scratch
        };
        let watch = |scratch: &mut Scratch, &ray: &(u32, DVec3)| {
            let found = self.send(gathering, look, ray, scratch);
            let session = scratch.radiosity.as_deref_mut();
            WatchedRay {
                found,
                asked: session
                    .map(|session| session.notes.asked())
                    .unwrap_or_default(),
                rays: std::mem::take(&mut scratch.rays),
            }
        };
        let rays = aimed.par_iter().with_min_len(TOGETHER);
        let watched: Vec<WatchedRay> = rays.map_init(watching, watch).collect();
        let before = session.cache.samples().len();
        for (&(number, dir), watched) in aimed.iter().zip(&watched) {
            let session = scratch.radiosity.as_deref();
            let holds = session.is_some_and(|session| {
                let since = &session.cache.samples()[before..];
                watched.asked.holds(since, session.cache.unit())
            });
            if holds {
                scratch.rays += watched.rays;
                sum.add(dir, &watched.found);
            } else {
                sum.add(dir, &self.send(gathering, look, (number, dir), scratch));
            }
        }
    }

    /// Sends a ray.
    fn send(
        &self,
        gathering: &IrradiancePoint,
        look: &CacheQuery,
        (number, dir): (u32, DVec3),
        scratch: &mut Scratch,
    ) -> GatheredRay {
        let &IrradiancePoint {
            radiosity, depth, ..
        } = gathering;
        if let Some(session) = scratch.radiosity.as_deref_mut() {
            session.quality = 1.0;
            if session.mode == Mode::Watch {
                session.notes.begin();
            }
        }
        // Random numbers of its own, or they would hang on the rays before it.
        let place = look.point.x + look.point.y + look.point.z;
        scratch.stream = Stream::of_sample(f64::from(number), place);
        scratch.media_stream = scratch.stream;
        scratch.crand = seed_of_sample(f64::from(number), place);
        let path = Path {
            ray: Ray::new(look.point, dir),
            from: gathering.departure,
            seen: RayKind::Radiosity,
            level: radiosity.level(depth, self.world.globals.max_trace_level),
            weight: radiosity.weight(depth),
            gathered: depth + 1,
            inside: Inside::new(),
            wavelength: None,
        };
        let query = Query {
            ray: path.ray,
            origin_surface: path.from,
            t_max: f64::INFINITY,
            kind: path.seen,
        };
        let hit = self.world.nearest(&query, scratch);
        let distance = hit.map(|hit| hit.t);
        let weight = self.weight_of(hit.as_ref(), radiosity, number, radiosity.rays(depth));
        if weight == 0.0 {
            return GatheredRay {
                distance,
                light: Rgb::BLACK,
                quality: 0.0,
                weight,
            };
        }
        let seen = self.trace(path, Some((hit, LightSamples::NONE)), scratch);
        let session = scratch.radiosity.as_deref();
        GatheredRay {
            distance,
            light: limited(seen.rgb, radiosity),
            quality: session.map_or(1.0, |session| session.quality),
            weight,
        }
    }

    /// How much the ray of this number counts for what it met: those of less important objects stand for more of them.
    fn weight_of(&self, hit: Option<&Hit>, radiosity: &Radiosity, number: u32, count: u32) -> f64 {
        let own = hit.and_then(|hit| self.world.surfaces[hit.surface as usize].importance());
        let importance = own.map_or(radiosity.importance, Importance::share);
        if importance >= 1.0 {
            return 1.0;
        }
        let last = f64::from(count - 1);
        if f64::from(number) > importance * last {
            return 0.0;
        }
        f64::from(count) / ((importance * last).floor() + 1.0)
    }
}

/// Light no brighter than `max_sample`.
fn limited(light: Rgb, radiosity: &Radiosity) -> Rgb {
    let most = radiosity.settings.max_sample;
    let brightest = f64::from(light.max());
    if most > 0.0 && brightest > most {
        light * (most / brightest)
    } else {
        light
    }
}

/// Chooses the directions of a sample.
struct HemisphereSampler {
    frame: Frame,
    flat: DVec3,
    /// How many directions below the surface may still be skipped; none are looked for where there are no bumps.
    skips: Option<u32>,
}

/// So many directions are tried for each that is wanted.
const TRIES: u32 = 5;

impl HemisphereSampler {
    fn new(normal: DVec3, flat: DVec3, count: u32) -> Self {
        HemisphereSampler {
            frame: Frame::about(normal),
            flat,
            skips: (normal != flat).then(|| count.saturating_mul(TRIES)),
        }
    }

    fn next(&mut self, radiosity: &Radiosity, depth: usize, scratch: &mut Scratch) -> DVec3 {
        loop {
            let session = scratch.radiosity.as_deref_mut();
            let dir = session.map_or(DVec3::Y, |session| session.direction(radiosity, depth));
            let dir = self.frame.turned(dir);
            let Some(skips) = &mut self.skips else {
                return dir;
            };
            if dir.dot(self.flat) > 0.0 {
                return dir;
            }
            *skips = skips.saturating_sub(1);
            if *skips == 0 {
                self.skips = None;
                self.frame = Frame::about(self.flat);
            }
        }
    }
}

/// POV-Ray keeps distances of samples in single precision.
#[allow(clippy::cast_possible_truncation, reason = "it is asked for")]
fn single(distance: f64) -> f64 {
    f64::from(distance as f32)
}

//! Irradiance samples: rays over the hemisphere of a point.
//!
//! The rays start with an empty interior stack, ignore fog and media (unless the scene asks for them), and see area
//! lights as points and no highlights. The light at their hits depends on the irradiance samples made before. With
//! several threads all rays of a sample are traced in parallel against the current samples. Those that lacked samples,
//! or for which a newer sample counts, are traced again in order.

use super::radiosity::IrradiancePoint;
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::mersenne::{Stream, seed_of_sample};
use crate::render::radiosity::{
    CacheQuery, Frame, IrradianceSample, LightRequest, Mode, Radiosity,
};
use crate::render::shade::Scratch;
use crate::render::shade::shading_point::LightSamples;
use crate::render::shade::subsurface::SubsurfaceStreams;
use crate::render::shade::{InteriorStack, Path, Tracer};
use crate::scene::Importance;
use crate::scene::atmosphere::MISS_DISTANCE;
use crate::world::{Hit, Query, RayCounts, RayKind};
use glam::DVec3;
use rayon::prelude::*;

/// A sample is not stored if its nearest hit is closer than this share of its largest radius.
const TOO_NEAR: f64 = 1e-4;
/// Samples of fewer rays are not shared between threads.
const MIN_PARALLEL_RAYS: u32 = 24;
/// The least number of rays for a thread.
const MIN_RAYS_PER_THREAD: usize = 8;

/// The result of one ray.
#[derive(Clone, Copy)]
struct GatheredRay {
    /// The distance of the hit, if any.
    distance: Option<f64>,
    light: Rgb,
    /// The quality of the light.
    quality: f64,
    /// The weight of the ray.
    weight: f64,
}

/// The result of a ray that was traced without adding samples.
struct WatchedRay {
    gathered: GatheredRay,
    request: LightRequest,
    rays: RayCounts,
}

/// The sums over the rays of a sample.
struct IrradianceSum {
    light: Rgb,
    qualities: f64,
    weights: f64,
    /// The sum of the reciprocal distances.
    nearness: f64,
    nearest: f64,
    to_nearest: DVec3,
}

impl IrradianceSum {
    fn add(&mut self, dir: DVec3, gathered: &GatheredRay) {
        if let Some(distance) = gathered.distance {
            self.nearness += 1.0 / distance;
            if distance < self.nearest {
                (self.nearest, self.to_nearest) = (distance, dir);
            }
        }
        let share = gathered.quality * gathered.weight;
        self.qualities += share;
        self.weights += gathered.weight;
        self.light += gathered.light * share;
    }
}

impl Tracer<'_> {
    /// Makes a sample for a query at the front (1) or the back (-1) of a surface. The flag tells if it is to be stored.
    pub(in crate::render::shade) fn gather(
        &self,
        irradiance_point: &IrradiancePoint,
        cache_query: &CacheQuery,
        side: f64,
        scratch: &mut Scratch,
    ) -> (IrradianceSample, bool) {
        let &IrradiancePoint {
            radiosity, depth, ..
        } = irradiance_point;
        let count = radiosity.rays(depth);
        let mut directions =
            HemisphereSampler::new(cache_query, side * irradiance_point.flat, count);
        let mut sum = IrradianceSum {
            light: Rgb::BLACK,
            qualities: 0.0,
            weights: 0.0,
            nearness: 0.0,
            nearest: MISS_DISTANCE * self.world.globals.unit,
            to_nearest: DVec3::ZERO,
        };
        let random = scratch.random;
        if depth == 0 {
            scratch.swap_gathering();
        }
        if self.is_parallel(depth, count, scratch) {
            self.trace_in_parallel(
                irradiance_point,
                cache_query,
                &mut directions,
                &mut sum,
                scratch,
            );
        } else {
            for number in 0..count {
                let dir = directions.next(radiosity, depth, scratch);
                sum.add(
                    dir,
                    &self.trace_sample_ray(irradiance_point, cache_query, number, dir, scratch),
                );
            }
        }
        if depth == 0 {
            scratch.swap_gathering();
        }
        if !random.continues {
            scratch.random = random;
        }
        let eye = self.world.camera.location().distance(cache_query.point);
        let [least, most] = radiosity.reuse(depth).map(|reuse| reuse * eye);
        let sample = IrradianceSample {
            point: cache_query.point,
            normal: cache_query.normal,
            light: sum.light * (1.0 / sum.qualities),
            radius: single((f64::from(count) / sum.nearness).clamp(least, most)),
            nearest: single(sum.nearest),
            to_nearest: sum.to_nearest,
            quality: sum.qualities / sum.weights,
            depth,
            brilliance: cache_query.brilliance,
        };
        (sample, sum.nearest > TOO_NEAR * most)
    }

    /// Returns true if the rays of a sample are shared between threads.
    fn is_parallel(&self, depth: usize, count: u32, scratch: &Scratch) -> bool {
        let session = scratch.radiosity.as_deref();
        depth == 0
            && count >= MIN_PARALLEL_RAYS
            && session.is_some_and(|session| session.mode == Mode::Store)
            && rayon::current_num_threads() > 1
            && !scratch.random.continues
    }

    /// Traces all rays of a sample in parallel.
    fn trace_in_parallel(
        &self,
        irradiance_point: &IrradiancePoint,
        cache_query: &CacheQuery,
        directions: &mut HemisphereSampler,
        sum: &mut IrradianceSum,
        scratch: &mut Scratch,
    ) {
        let &IrradiancePoint {
            radiosity, depth, ..
        } = irradiance_point;
        let numbers = 0..radiosity.rays(depth);
        let aimed = numbers.map(|number| (number, directions.next(radiosity, depth, scratch)));
        let aimed: Vec<(u32, DVec3)> = aimed.collect();
        let Some(session) = scratch.radiosity.as_deref() else {
            return;
        };
        let watching = || Scratch {
            radiosity: Some(Box::new(session.in_mode(Mode::Record))),
            ..Scratch::default()
        };
        let watch = |scratch: &mut Scratch, &(number, dir): &(u32, DVec3)| {
            let gathered =
                self.trace_sample_ray(irradiance_point, cache_query, number, dir, scratch);
            let session = scratch.radiosity.as_deref_mut();
            WatchedRay {
                gathered,
                request: session
                    .map(|session| session.notes.take_request())
                    .unwrap_or_default(),
                rays: std::mem::take(&mut scratch.query.rays),
            }
        };
        let rays = aimed.par_iter().with_min_len(MIN_RAYS_PER_THREAD);
        let watched: Vec<WatchedRay> = rays.map_init(watching, watch).collect();
        let before = session.cache.samples().len();
        for (&(number, dir), watched) in aimed.iter().zip(&watched) {
            let session = scratch.radiosity.as_deref();
            let is_valid = session.is_some_and(|session| {
                let since = &session.cache.samples()[before..];
                watched.request.is_valid(since, session.cache.unit())
            });
            if is_valid {
                scratch.query.rays += watched.rays;
                sum.add(dir, &watched.gathered);
            } else {
                sum.add(
                    dir,
                    &self.trace_sample_ray(irradiance_point, cache_query, number, dir, scratch),
                );
            }
        }
    }

    /// Traces one ray of a sample.
    fn trace_sample_ray(
        &self,
        irradiance_point: &IrradiancePoint,
        cache_query: &CacheQuery,
        number: u32,
        dir: DVec3,
        scratch: &mut Scratch,
    ) -> GatheredRay {
        let &IrradiancePoint {
            radiosity, depth, ..
        } = irradiance_point;
        if let Some(session) = scratch.radiosity.as_deref_mut() {
            session.quality = 1.0;
            if session.mode == Mode::Record {
                session.notes.begin();
            }
        }
        // Every ray seeds its own random numbers, unless these depend on the rays before it.
        if !scratch.random.continues {
            let seed = cache_query.point.x + cache_query.point.y + cache_query.point.z;
            scratch.random.lights = Stream::of_sample(f64::from(number), seed);
            scratch.random.media = scratch.random.lights;
            scratch.random.crand = seed_of_sample(f64::from(number), seed);
            scratch.random.subsurface = SubsurfaceStreams::of_seed(scratch.random.crand);
        }
        let path = Path {
            ray: Ray::new(cache_query.point, dir),
            from: irradiance_point.spawn_surface,
            kind: RayKind::Radiosity,
            level: radiosity.level(depth, self.world.globals.max_trace_level),
            weight: radiosity.weight(depth),
            irradiance_depth: depth + 1,
            subsurface_depth: irradiance_point.subsurface_depth,
            inside: InteriorStack::new(),
            wavelength: None,
        };
        let query = Query {
            ray: path.ray,
            origin_surface: path.from,
            t_max: f64::INFINITY,
            kind: path.kind,
        };
        let hit = self.world.nearest(&query, &mut scratch.query);
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

    /// The weight of the ray with this index: fewer rays hit objects of low importance, and each counts for more.
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

/// Light clamped to `max_sample`.
fn limited(light: Rgb, radiosity: &Radiosity) -> Rgb {
    let most = radiosity.settings.max_sample;
    let brightest = f64::from(light.max());
    if most > 0.0 && brightest > most {
        light * (most / brightest)
    } else {
        light
    }
}

/// Chooses the ray directions of a sample.
struct HemisphereSampler {
    frame: Frame,
    brilliance: f32,
    flat: DVec3,
    /// The number of directions below the surface that may still be rejected; none are rejected without bump mapping.
    skips: Option<u32>,
}

/// Directions tried for each one that is used.
const TRIES: u32 = 5;

impl HemisphereSampler {
    fn new(cache_query: &CacheQuery, flat: DVec3, count: u32) -> Self {
        let &CacheQuery {
            normal, brilliance, ..
        } = cache_query;
        HemisphereSampler {
            frame: Frame::about(normal),
            brilliance,
            flat,
            skips: (normal != flat).then(|| count.saturating_mul(TRIES)),
        }
    }

    fn next(&mut self, radiosity: &Radiosity, depth: usize, scratch: &mut Scratch) -> DVec3 {
        loop {
            let session = scratch.radiosity.as_deref_mut();
            let dir = session.map_or(DVec3::Y, |session| {
                session.direction(radiosity, depth, self.brilliance)
            });
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

/// POV-Ray stores the distances of samples in single precision.
#[allow(clippy::cast_possible_truncation, reason = "POV-Ray rounds here")]
fn single(distance: f64) -> f64 {
    f64::from(distance as f32)
}

//! Radiosity: diffuse interreflection by irradiance caching (Ward, Rubinstein and Clear 1988; Ward and Heckbert 1992),
//! with the numbers of POV-Ray 3.7.
//!
//! An irradiance sample traces rays in directions of a fixed list, which wraps around. It is stored in a [`Cache`] and
//! reused at nearby points. The hit of a sample ray needs irradiance itself, from samples of the next depth, up to
//! `recursion_limit`. So the picture depends on the order of the samples. The order is that of POV-Ray with one thread;
//! [`crate::render`] explains how several threads preserve it.
//!
//! Missing: POV-Ray's own table of directions (`count a, b` with `b` less than 1600 takes the first of the usual ones).

mod cache;
mod cell;
mod directions;
mod lists;
mod notes;
mod sample;

pub use cache::Cache;
pub use directions::Frame;
pub use lists::{Mean, SampleLists};
pub use notes::{LightRequest, Notes, SeenLight};
pub use sample::{CacheQuery, IrradianceSample};

use crate::scene;
use glam::DVec3;
use std::sync::Arc;

/// Below this weight the error bound of the settings is not relaxed.
const LIGHT_WEIGHT: f64 = 0.25;
/// The margin of sample rays above the least weight.
const ABOVE: f64 = 1e-10;
/// The factor on weights: POV-Ray counts quarters, so one sample used as a whole has weight 4.
const QUARTERS: f64 = 4.0;

/// The radiosity settings of a scene.
#[derive(Clone, Debug)]
pub struct Radiosity {
    /// The settings as given.
    pub settings: scene::RadiositySettings,
    /// The importance of objects without their own: the share of rays that count there.
    pub importance: f64,
    /// The directions, about y.
    directions: Vec<DVec3>,
}

impl Radiosity {
    /// The radiosity of a scene; `importance` is the default of objects.
    #[must_use]
    pub fn new(settings: scene::RadiositySettings, importance: f64) -> Self {
        let count = settings.directions.unwrap_or(directions::DEFAULT_COUNT);
        let count = count.max(settings.count).clamp(1, MAX_DIRECTIONS);
        Radiosity {
            settings,
            importance,
            directions: directions::pool(count),
        }
    }

    /// The number of rays of a sample at a depth.
    #[must_use]
    pub fn rays(&self, depth: usize) -> u32 {
        (self.settings.count.min(MAX_DIRECTIONS) >> depth).max(MIN_RAYS)
    }

    /// The weight of these rays.
    #[must_use]
    pub fn weight(&self, depth: usize) -> f64 {
        let settings = &self.settings;
        let exponent = i32::try_from(depth + 1).unwrap_or(i32::MAX);
        let weight = (0.5 * settings.brightness).powi(exponent);
        weight.max(settings.adc_bailout + ABOVE)
    }

    /// The trace level that these rays start with, such that they are always traced.
    #[must_use]
    pub fn level(&self, depth: usize, max_trace_level: u32) -> u32 {
        let level = u32::try_from((depth + 1) * 3 / 2).unwrap_or(u32::MAX);
        level.min(max_trace_level.saturating_sub(1))
    }

    /// The least and the largest radius of a sample, at a distance of 1 from the camera.
    #[must_use]
    pub fn reuse(&self, depth: usize) -> [f64; 2] {
        let settings = &self.settings;
        [settings.minimum_reuse, settings.maximum_reuse].map(|reuse| reuse * power(depth))
    }

    /// The error bound for a ray of a weight.
    fn error(&self, depth: usize, weight: f64, is_final: bool) -> f64 {
        let mut error = self.settings.error_bound;
        if !is_final {
            error *= self.settings.low_error_factor;
        }
        (error + (LIGHT_WEIGHT - weight).max(0.0)) * power(depth)
    }

    /// The distance within which a sample is stored for use.
    fn reach(&self, sample: &IrradianceSample) -> f64 {
        let share = if sample.depth == 0 { 1.0 } else { 1.0 / 8.0 };
        sample.radius * self.settings.error_bound * power(sample.depth) * share
    }

    /// The number of samples needed near a point.
    fn needed(&self, depth: usize) -> f64 {
        let nearest = self.settings.nearest_count;
        f64::from(match depth {
            0 => nearest,
            1 => nearest.min(2),
            _ => 1,
        })
    }
}

/// The least number of rays of a sample.
const MIN_RAYS: u32 = 5;
/// The largest number of distinct directions.
const MAX_DIRECTIONS: u32 = 1 << 20;

/// Two to the power of the depth.
fn power(depth: usize) -> f64 {
    i32::try_from(depth).map_or(f64::INFINITY, |depth| f64::from(depth).exp2())
}

/// The policy for new samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Take samples where the cache has too few, and store them: in POV-Ray's order.
    Store,
    /// Take none: queries are recorded.
    Record,
    /// Take samples where the cache has none, and do not store them: in any order.
    Isolated,
}

/// The radiosity state of a thread.
#[derive(Clone, Debug)]
pub struct Session {
    /// The samples so far.
    pub cache: Arc<Cache>,
    /// Those near the points of recent lookups.
    lists: SampleLists,
    /// The policy for new samples.
    pub mode: Mode,
    /// The final picture is being rendered, not the pretrace.
    pub is_final: bool,
    /// The least quality of the light along the current ray.
    pub quality: f64,
    /// Samples and queries recorded in mode `Record`, or to be revised.
    pub notes: Notes,
    /// The next direction, by depth.
    next: Vec<usize>,
    /// Irradiance was queried since the last reset.
    has_queries: bool,
}

/// The irradiance known at a point.
#[derive(Clone, Copy, Debug)]
pub enum CachedLight {
    /// Enough samples.
    Enough(Mean),
    /// Too few samples; one is to be made.
    Short(Mean),
    /// Too few samples, and none is to be made.
    Unknown,
}

impl Session {
    /// A session without samples, for a scene with this unit.
    #[must_use]
    pub fn new(radiosity: &Radiosity, unit: f64) -> Self {
        Session {
            cache: Arc::new(Cache::new(unit)),
            lists: SampleLists::default(),
            mode: Mode::Store,
            is_final: false,
            quality: 1.0,
            notes: Notes::default(),
            next: vec![0; radiosity.settings.recursion_limit as usize + 1],
            has_queries: false,
        }
    }

    /// Starts the final picture.
    pub fn finish(&mut self) {
        self.is_final = true;
        self.next.fill(0);
    }

    /// Returns true if points of the picture must come in POV-Ray's order.
    #[must_use]
    pub fn order_dependent(&self) -> bool {
        self.mode == Mode::Store
    }

    /// A copy in another mode, for another thread.
    #[must_use]
    pub fn in_mode(&self, mode: Mode) -> Session {
        Session {
            cache: Arc::clone(&self.cache),
            lists: SampleLists::default(),
            mode,
            is_final: self.is_final,
            quality: 1.0,
            notes: Notes::of(&self.cache),
            next: self.next.clone(),
            has_queries: false,
        }
    }

    /// The cache query at a point with its normal for a ray of a weight.
    #[must_use]
    pub fn query(
        &self,
        radiosity: &Radiosity,
        [point, normal]: [DVec3; 2],
        depth: usize,
        weight: f64,
        brilliance: f32,
    ) -> CacheQuery {
        CacheQuery {
            point,
            normal,
            error: radiosity.error(depth, weight, self.is_final),
            depth,
            brilliance,
            is_smooth: self.is_final && depth == 0,
        }
    }

    /// Looks up the irradiance at a point.
    pub fn known(&mut self, radiosity: &Radiosity, query: &CacheQuery) -> CachedLight {
        self.has_queries = true;
        let mean = self.lists.mean(&self.cache, query);
        if self.mode == Mode::Record {
            self.notes.record(*query);
        }
        let is_enough = QUARTERS * mean.weight >= radiosity.needed(query.depth);
        let accepts_fewer = match self.mode {
            Mode::Store | Mode::Record => self.is_final && !radiosity.settings.always_sample,
            Mode::Isolated => true,
        };
        if is_enough || accepts_fewer && mean.weight > 0.0 {
            return CachedLight::Enough(mean);
        }
        if self.mode == Mode::Record {
            self.notes.is_short = true;
            return CachedLight::Unknown;
        }
        CachedLight::Short(mean)
    }

    /// Returns and resets the flag of irradiance queries.
    pub fn take_was_queried(&mut self) -> bool {
        std::mem::take(&mut self.has_queries)
    }

    /// Lowers the quality to that of the light used.
    pub fn used(&mut self, radiosity: &Radiosity, depth: usize, mean: &Mean) {
        let quality = QUARTERS * mean.weight / radiosity.needed(depth);
        self.quality = self.quality.min(quality);
    }

    /// Starts the directions of a sample of a depth.
    pub fn begin(&mut self, depth: usize) {
        if self.mode == Mode::Isolated
            && let Some(next) = self.next.get_mut(depth)
        {
            *next = 0;
        }
    }

    /// The next direction about y, for a sample with this exponent of the cosine.
    pub fn direction(&mut self, radiosity: &Radiosity, depth: usize, brilliance: f32) -> DVec3 {
        let Some(next) = self.next.get_mut(depth) else {
            return DVec3::Y;
        };
        let at = *next % radiosity.directions.len();
        *next = at + 1;
        directions::of_brilliance(radiosity.directions[at], brilliance)
    }

    /// Stores a sample, in mode `Store`.
    pub fn store(&mut self, radiosity: &Radiosity, sample: IrradianceSample) {
        if self.mode == Mode::Store {
            let reach = radiosity.reach(&sample);
            let number = self.cache.samples().len();
            Arc::make_mut(&mut self.cache).add(sample, reach);
            if sample.depth == 0 && self.cache.samples().len() > number {
                self.notes.add(number);
            }
        }
    }
}

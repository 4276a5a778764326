//! Radiosity: light that surfaces throw on each other, gathered at few points and spread between them (Ward, Rubinstein
//! and Clear 1988; Ward and Heckbert 1992), in the numbers of POV-Ray 3.7.
//!
//! A sample gathers light by rays in directions of a fixed list, which goes round; what it found is kept in a
//! [`Cache`] and used for points nearby. A ray of a sample asks for such light itself where it ends, from samples of the
//! next depth, up to `recursion_limit`. So what is seen depends on the order in which samples came. Here it is POV-Ray's
//! with one thread; [`crate::render`] tells how several threads keep it.
//!
//! Missing: POV-Ray's own table of directions (`count a, b` with `b` less than 1600 takes the first of the usual ones).

mod cache;
mod cell;
mod directions;
mod notes;

pub use cache::{Cache, CacheQuery, IrradianceSample, Mean};
pub use directions::Frame;
pub use notes::{LightRequest, Notes, SeenLight};

use crate::scene;
use glam::DVec3;
use std::sync::Arc;

/// Below this weight no error is allowed beyond that of the settings.
const LIGHT_WEIGHT: f64 = 0.25;
/// Rays of samples are this much more than the least weight.
const ABOVE: f64 = 1e-10;
/// A mean of this weight is one sample used as a whole: POV-Ray counts quarters.
const QUARTERS: f64 = 4.0;

/// The settings of a scene, worked out.
#[derive(Clone, Debug)]
pub struct Radiosity {
    /// As the scene gives them.
    pub settings: scene::Radiosity,
    /// The share of rays that count where they meet an object that does not say.
    pub importance: f64,
    /// The directions, about y.
    directions: Vec<DVec3>,
}

impl Radiosity {
    /// What a scene asks for; `importance` is that of objects that do not say theirs.
    #[must_use]
    pub fn new(settings: scene::Radiosity, importance: f64) -> Self {
        let count = settings.directions.unwrap_or(directions::USUAL);
        let count = count.max(settings.count).clamp(1, MOST_DIRECTIONS);
        Radiosity {
            settings,
            importance,
            directions: directions::pool(count),
        }
    }

    /// How many rays a sample of a depth shoots.
    #[must_use]
    pub fn rays(&self, depth: usize) -> u32 {
        (self.settings.count.min(MOST_DIRECTIONS) >> depth).max(LEAST_RAYS)
    }

    /// The weight of these.
    #[must_use]
    pub fn weight(&self, depth: usize) -> f64 {
        let settings = &self.settings;
        let exponent = i32::try_from(depth + 1).unwrap_or(i32::MAX);
        let weight = (0.5 * settings.brightness).powi(exponent);
        weight.max(settings.adc_bailout + ABOVE)
    }

    /// The level that these count as in a scene of so many levels: they are always traced.
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

    /// The largest error of samples that count for a ray of a weight.
    fn error(&self, depth: usize, weight: f64, is_final: bool) -> f64 {
        let mut error = self.settings.error_bound;
        if !is_final {
            error *= self.settings.low_error_factor;
        }
        (error + (LIGHT_WEIGHT - weight).max(0.0)) * power(depth)
    }

    /// How far a sample is filed from where it may be used.
    fn reach(&self, sample: &IrradianceSample) -> f64 {
        let share = if sample.depth == 0 { 1.0 } else { 1.0 / 8.0 };
        sample.radius * self.settings.error_bound * power(sample.depth) * share
    }

    /// How many samples are to be near a place.
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
const LEAST_RAYS: u32 = 5;
/// More directions than this are not told apart.
const MOST_DIRECTIONS: u32 = 1 << 20;

/// Two to a depth.
fn power(depth: usize) -> f64 {
    i32::try_from(depth).map_or(f64::INFINITY, |depth| f64::from(depth).exp2())
}

/// How samples are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Wherever there are too few, and they are kept: in POV-Ray's order.
    Grow,
    /// Not at all: what was asked is noted.
    Watch,
    /// Where there is none, and they are not kept: in any order.
    Lone,
}

/// What a thread knows of radiosity while it draws.
#[derive(Clone, Debug)]
pub struct Session {
    /// The samples so far.
    pub cache: Arc<Cache>,
    /// How more are made.
    pub mode: Mode,
    /// Whether the picture is drawn, rather than only samples made for it.
    pub is_final: bool,
    /// The least quality of the light of the ray at hand.
    pub quality: f64,
    /// What was seen and asked while watching, or is to be seen again.
    pub notes: Notes,
    /// By depth, the next direction.
    next: Vec<usize>,
    /// Whether light was asked for since this was last looked at.
    is_asked: bool,
}

/// What is known of the light at a place.
#[derive(Clone, Copy, Debug)]
pub enum CachedLight {
    /// Enough.
    Enough(Mean),
    /// Not enough; a sample is to be made.
    Short(Mean),
    /// Not enough, and no sample is to be made.
    Unknown,
}

impl Session {
    /// Of a scene with this unit, without samples.
    #[must_use]
    pub fn new(radiosity: &Radiosity, unit: f64) -> Self {
        Session {
            cache: Arc::new(Cache::new(unit)),
            mode: Mode::Grow,
            is_final: false,
            quality: 1.0,
            notes: Notes::default(),
            next: vec![0; radiosity.settings.recursion_limit as usize + 1],
            is_asked: false,
        }
    }

    /// From here on the picture is drawn.
    pub fn finish(&mut self) {
        self.is_final = true;
        self.next.fill(0);
    }

    /// Whether points of the picture are to come in POV-Ray's order.
    #[must_use]
    pub fn order_dependent(&self) -> bool {
        self.mode == Mode::Grow
    }

    /// The same in another mode, for another thread.
    #[must_use]
    pub fn in_mode(&self, mode: Mode) -> Session {
        Session {
            cache: Arc::clone(&self.cache),
            mode,
            is_final: self.is_final,
            quality: 1.0,
            notes: Notes::of(&self.cache),
            next: self.next.clone(),
            is_asked: false,
        }
    }

    /// The look at a place with a ray of a weight.
    #[must_use]
    pub fn look(
        &self,
        radiosity: &Radiosity,
        (point, normal): (DVec3, DVec3),
        depth: usize,
        weight: f64,
    ) -> CacheQuery {
        CacheQuery {
            point,
            normal,
            error: radiosity.error(depth, weight, self.is_final),
            depth,
            is_smooth: self.is_final && depth == 0,
        }
    }

    /// What is known of the light at a place.
    pub fn known(&mut self, radiosity: &Radiosity, look: &CacheQuery) -> CachedLight {
        self.is_asked = true;
        let mean = self.cache.mean(look);
        if self.mode == Mode::Watch {
            self.notes.ask(*look);
        }
        let is_enough = QUARTERS * mean.weight >= radiosity.needed(look.depth);
        let makes_do = match self.mode {
            Mode::Grow | Mode::Watch => self.is_final && !radiosity.settings.always_sample,
            Mode::Lone => true,
        };
        if is_enough || makes_do && mean.weight > 0.0 {
            return CachedLight::Enough(mean);
        }
        if self.mode == Mode::Watch {
            self.notes.is_short = true;
            return CachedLight::Unknown;
        }
        CachedLight::Short(mean)
    }

    /// Whether light was asked for since this was last called.
    pub fn was_asked(&mut self) -> bool {
        std::mem::take(&mut self.is_asked)
    }

    /// Notes the quality of light that was used.
    pub fn used(&mut self, radiosity: &Radiosity, depth: usize, mean: &Mean) {
        let quality = QUARTERS * mean.weight / radiosity.needed(depth);
        self.quality = self.quality.min(quality);
    }

    /// Starts the directions of a sample of a depth.
    pub fn begin(&mut self, depth: usize) {
        if self.mode == Mode::Lone
            && let Some(next) = self.next.get_mut(depth)
        {
            *next = 0;
        }
    }

    /// The next direction about y.
    pub fn direction(&mut self, radiosity: &Radiosity, depth: usize) -> DVec3 {
        let Some(next) = self.next.get_mut(depth) else {
            return DVec3::Y;
        };
        let at = *next % radiosity.directions.len();
        *next = at + 1;
        radiosity.directions[at]
    }

    /// Keeps a sample, if samples are kept.
    pub fn keep(&mut self, radiosity: &Radiosity, sample: IrradianceSample) {
        if self.mode == Mode::Grow {
            let reach = radiosity.reach(&sample);
            let number = self.cache.samples().len();
            Arc::make_mut(&mut self.cache).add(sample, reach);
            if sample.depth == 0 && self.cache.samples().len() > number {
                self.notes.add(number);
            }
        }
    }
}

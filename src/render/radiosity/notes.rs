//! Records of parallel rendering: the irradiance queries of each point of the picture, and whether later samples change
//! it.

use super::cache::Cache;
use super::sample::{CacheQuery, IrradianceSample};
use crate::base::color::Rgb;
use glam::DVec3;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use std::ops::Range;

/// The recorded sample of a point of the picture: light, and transparency.
pub type SeenLight = (Rgb, f32);

/// The irradiance queries of one ray; invalid if samples were missing.
#[derive(Clone, Debug, Default)]
pub struct LightRequest(Option<SmallVec<[CacheQuery; 2]>>);

impl LightRequest {
    /// Returns true if the results stay the same with these further samples.
    #[must_use]
    pub fn is_valid(&self, since: &[IrradianceSample], unit: f64) -> bool {
        let is_changed = |query: &CacheQuery| {
            let mut since = since.iter().filter(|sample| sample.depth == query.depth);
            since.any(|sample| sample.weight_at(query, unit) > 0.0)
        };
        let queries = self.0.as_ref();
        queries.is_some_and(|queries| !queries.iter().any(is_changed))
    }
}

/// The records of a tile: samples and irradiance queries.
#[derive(Clone, Debug, Default)]
pub struct Notes {
    /// The current point needed irradiance with too few samples.
    pub is_short: bool,
    queries: Vec<CacheQuery>,
    /// By point of the picture, as bits, the sample and the range of its queries; none where irradiance samples were
    /// missing.
    seen: FxHashMap<[u64; 2], Option<(SeenLight, Range<usize>)>>,
    /// Irradiance samples were missing somewhere.
    is_ever_short: bool,
    /// The number of irradiance samples at the start.
    samples: usize,
    /// The indices of newer samples that may matter.
    since: Vec<usize>,
    /// The start of the current point's queries.
    start: usize,
}

impl Notes {
    /// Empty records for these irradiance samples.
    pub(super) fn of(cache: &Cache) -> Notes {
        Notes {
            samples: cache.samples().len(),
            ..Notes::default()
        }
    }

    pub(super) fn record(&mut self, query: CacheQuery) {
        self.queries.push(query);
    }

    /// Starts a point of the picture, or a ray.
    pub fn begin(&mut self) {
        self.is_short = false;
        self.start = self.queries.len();
    }

    /// Takes the queries since the last start.
    pub fn take_request(&mut self) -> LightRequest {
        let queries = self.queries.drain(self.start..).collect();
        LightRequest((!self.is_short).then_some(queries))
    }

    /// Ends a point of the picture.
    pub fn end(&mut self, x: f64, y: f64, seen: SeenLight) {
        let all = (!self.is_short).then_some((seen, self.start..self.queries.len()));
        self.is_ever_short |= self.is_short;
        self.seen.insert([x.to_bits(), y.to_bits()], all);
    }

    /// Takes the records so far; the next ones start with the same samples.
    #[must_use]
    pub fn take(&mut self) -> Notes {
        let next = Notes {
            samples: self.samples,
            ..Notes::default()
        };
        std::mem::replace(self, next)
    }

    /// Returns true if everything would be the same with the current samples.
    #[must_use]
    pub fn are_valid(&self, cache: &Cache) -> bool {
        !self.is_ever_short && self.samples == cache.samples().len()
    }

    /// Collects the newer samples that may matter.
    pub fn catch_up(&mut self, cache: &Cache) {
        let (mut min, mut max, mut error) = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0.0f64);
        for query in &self.queries {
            (min, max) = (min.min(query.point), max.max(query.point));
            error = error.max(query.error);
        }
        let new = self.samples..cache.samples().len();
        self.since = new
            .filter(|&number| {
                let sample = &cache.samples()[number];
                let reach = sample.radius * error;
                let near = sample.point.min(max).max(min);
                sample.depth == 0 && near.distance(sample.point) < reach
            })
            .collect();
        self.samples = cache.samples().len();
    }

    /// Adds a new sample that may matter to the points that follow.
    pub(super) fn add(&mut self, number: usize) {
        if !self.seen.is_empty() {
            self.since.push(number);
        }
    }

    /// The recorded sample of a point of the picture, if it is still valid.
    #[must_use]
    pub fn recall(&self, x: f64, y: f64, cache: &Cache) -> Option<SeenLight> {
        let (seen, queries) = self.seen.get(&[x.to_bits(), y.to_bits()])?.as_ref()?;
        let is_changed = |query: &CacheQuery| {
            let mut since = self.since.iter().map(|&number| &cache.samples()[number]);
            since.any(|sample| sample.weight_at(query, cache.unit()) > 0.0)
        };
        (!self.queries[queries.clone()].iter().any(is_changed)).then_some(*seen)
    }
}

//! What a thread saw with the samples that there were, and whether more samples would change it.

use super::cache::{Cache, CacheQuery, IrradianceSample};
use crate::base::color::Rgb;
use glam::DVec3;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use std::ops::Range;

/// What was seen at a point of the picture: light, and the share that shines through.
pub type SeenLight = (Rgb, f32);

/// What was asked for something; nothing holds where samples were missing.
#[derive(Clone, Debug, Default)]
pub struct LightRequest(Option<SmallVec<[CacheQuery; 2]>>);

impl LightRequest {
    /// Whether the answers are the same with these further samples.
    #[must_use]
    pub fn holds(&self, since: &[IrradianceSample], unit: f64) -> bool {
        let is_changed = |look: &CacheQuery| {
            let mut since = since.iter().filter(|sample| sample.depth == look.depth);
            since.any(|sample| sample.weight_at(look, unit) > 0.0)
        };
        let looks = self.0.as_ref();
        looks.is_some_and(|looks| !looks.iter().any(is_changed))
    }
}

/// What was seen of a piece of the picture and what was asked for it.
#[derive(Clone, Debug, Default)]
pub struct Notes {
    /// Whether light was asked for, for the point at hand, where there was not enough.
    pub is_short: bool,
    looks: Vec<CacheQuery>,
    /// By point of the picture, in bits, what was seen and the looks for that; none where samples were missing.
    seen: FxHashMap<[u64; 2], Option<(SeenLight, Range<usize>)>>,
    /// Whether samples were missing somewhere.
    is_ever_short: bool,
    /// How many samples there were.
    samples: usize,
    /// Those that came since and may matter, by number.
    since: Vec<usize>,
    /// The looks of the point at hand start here.
    start: usize,
}

impl Notes {
    /// Notes of what is seen with these samples.
    pub(super) fn of(cache: &Cache) -> Notes {
        Notes {
            samples: cache.samples().len(),
            ..Notes::default()
        }
    }

    pub(super) fn ask(&mut self, look: CacheQuery) {
        self.looks.push(look);
    }

    /// Starts a point of the picture, or a ray.
    pub fn begin(&mut self) {
        self.is_short = false;
        self.start = self.looks.len();
    }

    /// What was asked since the last beginning; it is forgotten here.
    pub fn asked(&mut self) -> LightRequest {
        let looks = self.looks.drain(self.start..).collect();
        LightRequest((!self.is_short).then_some(looks))
    }

    /// Ends a point of the picture.
    pub fn end(&mut self, x: f64, y: f64, seen: SeenLight) {
        let all = (!self.is_short).then_some((seen, self.start..self.looks.len()));
        self.is_ever_short |= self.is_short;
        self.seen.insert([x.to_bits(), y.to_bits()], all);
    }

    /// The notes so far; the next begin with the same samples.
    #[must_use]
    pub fn take(&mut self) -> Notes {
        let next = Notes {
            samples: self.samples,
            ..Notes::default()
        };
        std::mem::replace(self, next)
    }

    /// Whether all was seen as it would be with the samples that there are now.
    #[must_use]
    pub fn hold(&self, cache: &Cache) -> bool {
        !self.is_ever_short && self.samples == cache.samples().len()
    }

    /// Looks up which samples came since and may matter.
    pub fn catch_up(&mut self, cache: &Cache) {
        let (mut min, mut max, mut error) = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0.0f64);
        for look in &self.looks {
            (min, max) = (min.min(look.point), max.max(look.point));
            error = error.max(look.error);
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

    /// A sample was made that may matter to all that follows.
    pub(super) fn add(&mut self, number: usize) {
        if !self.seen.is_empty() {
            self.since.push(number);
        }
    }

    /// What was seen at a point of the picture, if it would be seen the same now.
    #[must_use]
    pub fn recall(&self, x: f64, y: f64, cache: &Cache) -> Option<SeenLight> {
        let (seen, looks) = self.seen.get(&[x.to_bits(), y.to_bits()])?.as_ref()?;
        let is_changed = |look: &CacheQuery| {
            let mut since = self.since.iter().map(|&number| &cache.samples()[number]);
            since.any(|sample| sample.weight_at(look, cache.unit()) > 0.0)
        };
        (!self.looks[looks.clone()].iter().any(is_changed)).then_some(*seen)
    }
}

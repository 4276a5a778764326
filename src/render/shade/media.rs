//! Participating media along a ray: emission, absorption and scattering on each segment between two surfaces.
//!
//! A segment is divided where light beams begin and end, each part into intervals, and these are sampled by one of
//! three methods (docs/povray-facts.md, section 10): at random, evenly, or evenly with adaptive halving.

mod intervals;
mod scattering;

use super::atmosphere::SegmentEnd;
use super::{InteriorStack, Path, Tracer};
use crate::base::accel::MAX_STREAM_RAYS;
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::chi_square::chi_square;
use crate::render::shade::Scratch;
use crate::scene::atmosphere::{CONE_DISTANCE, Tint};
use crate::scene::interior::{MediumCoefficients, PreparedMedia, Sampling};
use crate::world::{LightList, SpawnSurface};
use glam::DVec3;
pub(super) use intervals::{LightBeam, MediaInterval, common_sampling, parts_of, subdivided};
use scattering::MediaPoints;
use smallvec::{SmallVec, smallvec};

/// The media of a segment; their effects add up.
pub(super) type Mixture<'w> = SmallVec<[&'w PreparedMedia; 4]>;

/// A ray segment in media.
struct MediaSegment<'a> {
    media: &'a [&'a PreparedMedia],
    ray: Ray,
    path: &'a Path,
    length: f64,
    /// The surface that ends it.
    end: Option<SpawnSurface>,
    beams: &'a [LightBeam],
    sampling: Sampling,
}

impl MediaSegment<'_> {
    /// The surface that a sample at a distance lies in: the one that the ray has left, or the one that it hits, which is
    /// sampled from version 3.8 on.
    fn surface_at(&self, distance: f64) -> Option<&SpawnSurface> {
        // The end of the last step is rounded.
        if distance == 0.0 {
            self.path.from.as_ref()
        } else if distance >= self.length * (1.0 - 4.0 * f64::EPSILON) {
            self.end.as_ref()
        } else {
            None
        }
    }
}

/// Emitted and in-scattered light and optical depth of an interval, as sums over samples.
#[derive(Clone, Copy)]
struct MediaSums {
    radiance: Rgb,
    /// The sum of the squares of the light of each sample.
    squares: Rgb,
    optical_depth: Rgb,
    count: u32,
}

/// Emitted and in-scattered light and optical depth at a point, scaled to the whole interval.
#[derive(Clone, Copy)]
struct MediaSample {
    radiance: Rgb,
    optical_depth: Rgb,
}

/// Samples that are taken together.
const AHEAD: usize = MAX_STREAM_RAYS;

impl Tracer<'_> {
    /// The effect of the interiors around a ray over `length`.
    pub(super) fn media_inside(
        &self,
        path: &Path,
        end: &SegmentEnd,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        if !self.features.has_media
            || path.inside.is_empty()
            || !self.is_outside_solids(&path.inside)
        {
            return None;
        }
        let media = self.media_of(&path.inside);
        self.segment_tint(
            &media,
            path,
            (end.length, Some(end.surface)),
            end.lights,
            scratch,
        )
    }

    /// The effect of the media of the atmosphere over `length` of a ray in the atmosphere.
    pub(super) fn atmospheric_media(
        &self,
        path: &Path,
        length: f64,
        lights: LightList,
        end: Option<SpawnSurface>,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        if !self.features.has_media {
            return None;
        }
        let media: Mixture = self.world.media.iter().collect();
        self.segment_tint(&media, path, (length, end), lights, scratch)
    }

    /// The transmittance of the interiors around a shadow ray over `length`.
    pub(super) fn interior_transmittance(
        &self,
        ray: &Ray,
        length: f64,
        inside: &InteriorStack,
        scratch: &mut Scratch,
    ) -> Rgb {
        if !self.features.has_media || inside.is_empty() || !self.is_outside_solids(inside) {
            return Rgb::WHITE;
        }
        self.extinction(&self.media_of(inside), ray, length, scratch)
    }

    /// The transmittance of the media of the atmosphere along a shadow ray.
    pub(super) fn atmosphere_transmittance(
        &self,
        ray: &Ray,
        length: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        let media: Mixture = self.world.media.iter().collect();
        self.extinction(&media, ray, length, scratch)
    }

    pub(super) fn media_of(&self, inside: &InteriorStack) -> Mixture<'_> {
        let media = inside.iter().map(|&id| self.world.interiors.media(id));
        media.flatten().collect()
    }

    fn segment_tint(
        &self,
        media: &[&PreparedMedia],
        path: &Path,
        (length, end): (f64, Option<SpawnSurface>),
        lights: LightList,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        let sampling = common_sampling(media)?;
        let beams = self.beams(lights, &path.ray, length);
        let segment = MediaSegment {
            media,
            ray: path.ray,
            path,
            length,
            end,
            beams: &beams,
            sampling,
        };
        let parts = parts_of(&beams, length);
        let has_density = media
            .iter()
            .any(|media| media.sampling.intervals == sampling.intervals && media.has_density());
        let intervals = match parts.as_slice() {
            [only] if !only.is_lit && !has_density => vec![*only],
            parts => subdivided(parts, &sampling),
        };
        Some(self.sum_up(&segment, &intervals, scratch))
    }

    /// The lights that media scatter, with the intervals of their beams along a ray: those that shine on the object at
    /// its end, except shadowless ones.
    pub(super) fn beams(&self, lights: LightList, ray: &Ray, length: f64) -> Vec<LightBeam> {
        let lights = self.world.lights.of(lights).iter();
        let endless = CONE_DISTANCE * self.world.globals.unit;
        let beam = |&number: &u32| {
            let light = self.world.lights.get(number);
            if !light.media_interaction || light.is_shadowless() {
                return None;
            }
            let (from, to) = light.beam_interval(ray, endless)?;
            let (from, to) = (from.max(0.0), to.min(length));
            (from < to).then_some(LightBeam { number, from, to })
        };
        lights.filter_map(beam).collect()
    }

    /// The effect of all intervals of a segment, the nearest first.
    fn sum_up(
        &self,
        segment: &MediaSegment,
        intervals: &[MediaInterval],
        scratch: &mut Scratch,
    ) -> Tint {
        let mut sums: Vec<MediaSums> = intervals
            .iter()
            .map(|interval| self.sampled(segment, interval, scratch))
            .collect();
        self.sample_more(segment, intervals, &mut sums, scratch);
        let (mut radiance, mut optical_depth) = (Rgb::BLACK, Rgb::BLACK);
        for sum in &sums {
            let share = 1.0 / f64::from(sum.count.max(1));
            radiance += sum.radiance * share * transmittance_of(optical_depth);
            optical_depth += sum.optical_depth * share;
        }
        Tint {
            factor: transmittance_of(optical_depth),
            added: radiance,
        }
    }

    fn sampled(
        &self,
        segment: &MediaSegment,
        interval: &MediaInterval,
        scratch: &mut Scratch,
    ) -> MediaSums {
        let sampling = &segment.sampling;
        let mut sums = MediaSums::NOTHING;
        match sampling.method {
            3 => self.sample_by_halving(segment, interval, &mut sums, scratch),
            method => {
                let count = sampling.samples[0];
                for number in 0..count {
                    let random = scratch.random.media.next_number();
                    let at = if method == 1 {
                        random
                    } else {
                        (f64::from(number) + 0.5 + sampling.jitter * random) / f64::from(count)
                    };
                    self.add_sample(segment, interval, at, &mut sums, scratch);
                }
            }
        }
        sums
    }

    /// Adds samples until the variance is small enough, for the methods that do so.
    fn sample_more(
        &self,
        segment: &MediaSegment,
        intervals: &[MediaInterval],
        sums: &mut [MediaSums],
        scratch: &mut Scratch,
    ) {
        let sampling = &segment.sampling;
        let [least, most] = sampling.samples;
        if sampling.method == 3 || most <= least {
            return;
        }
        let confidence = sampling.confidence;
        let scale = sampling.variance / chi_square(most.saturating_sub(1).max(1), confidence);
        for (interval, sum) in intervals.iter().zip(sums) {
            while sum.count <= most
                && sum.variance() >= scale * chi_square(sum.count.max(1), confidence)
            {
                let at = scratch.random.media.next_number();
                self.add_sample(segment, interval, at, sum, scratch);
            }
        }
    }

    fn add_sample(
        &self,
        segment: &MediaSegment,
        interval: &MediaInterval,
        at: f64,
        sums: &mut MediaSums,
        scratch: &mut Scratch,
    ) {
        let sampled = self.media_sample(segment, interval, at, scratch);
        let radiance = sampled.radiance * transmittance_of(sampled.optical_depth * at);
        sums.radiance += radiance;
        sums.squares += radiance * radiance;
        sums.optical_depth += sampled.optical_depth;
        sums.count += 1;
    }

    /// Method 3: even steps, halved where neighbours differ.
    fn sample_by_halving(
        &self,
        segment: &MediaSegment,
        interval: &MediaInterval,
        sums: &mut MediaSums,
        scratch: &mut Scratch,
    ) {
        let sampling = &segment.sampling;
        let (steps, width) = self.even_steps(sampling);
        let jitter = width * sampling.jitter;
        let shifted = |at: f64, scratch: &mut Scratch| match self.features.uses_random {
            true => at + jitter * (scratch.random.media.next_number() - 0.5),
            false => at,
        };
        // The ends of the steps and the middles between them, many together where no random number moves them.
        let mut ahead = [MediaSample::NOTHING; AHEAD];
        let mut known = |half: usize, scratch: &mut Scratch| {
            if self.features.uses_random {
                return None;
            }
            if half.is_multiple_of(AHEAD) {
                let end = |step: usize| step as f64 * width;
                let mut at = [0.0; AHEAD];
                for (half, at) in (half..).zip(&mut at) {
                    *at = match half % 2 {
                        0 => end(half / 2),
                        _ => 0.5 * (end(half / 2) + end(half / 2 + 1)),
                    };
                }
                let left = (2 * steps as usize + 1 - half).min(AHEAD);
                ahead = self.media_samples(segment, interval, &at[..left], scratch);
            }
            Some(ahead[half % AHEAD])
        };
        let mut from = shifted(0.0, scratch);
        let mut first = match known(0, scratch) {
            Some(first) => first,
            None => self.media_sample(segment, interval, from, scratch),
        };
        for step in 1..=steps {
            let to = shifted(f64::from(step) * width, scratch);
            let middle = known(2 * step as usize - 1, scratch);
            let second = match known(2 * step as usize, scratch) {
                Some(second) => second,
                None => self.media_sample(segment, interval, to, scratch),
            };
            let ends = [(from, first), (to, second)];
            let depth = sampling.aa_level.saturating_sub(1);
            let mean = self.halve(segment, interval, ends, middle, depth, scratch);
            let share = 1.0 / f64::from(steps);
            let mut escaping = transmittance_of(sums.optical_depth * share);
            if self.world.globals.is_3_8 {
                escaping *= mean_transmittance_of(mean.optical_depth * share);
            }
            sums.radiance += mean.radiance * escaping;
            sums.optical_depth += mean.optical_depth;
            (from, first) = (to, second);
        }
        sums.count = steps;
    }

    /// The mean between two samples, with one in the middle, which may be known, and more where they differ.
    fn halve(
        &self,
        segment: &MediaSegment,
        interval: &MediaInterval,
        [(from, first), (to, last)]: [(f64, MediaSample); 2],
        middle: Option<MediaSample>,
        depth: u32,
        scratch: &mut Scratch,
    ) -> MediaSample {
        let sampling = &segment.sampling;
        let mut at = 0.5 * (from + to);
        if self.features.uses_random {
            let random = scratch.random.media.next_number() - 0.5;
            at += sampling.jitter * (to - from) * random;
        }
        let middle = match middle {
            Some(middle) => middle,
            None => self.media_sample(segment, interval, at, scratch),
        };
        if depth == 0 {
            return first.plus(&middle).plus(&last).times(1.0 / 3.0);
        }
        let mut half = |end: (f64, MediaSample), ends: [(f64, MediaSample); 2]| {
            if end.1.differs(&middle, sampling.aa_threshold) {
                let mean = self.halve(segment, interval, ends, None, depth - 1, scratch);
                mean.times(0.5)
            } else {
                end.1.times(1.0 / 3.0).plus(&middle.times(1.0 / 6.0))
            }
        };
        let before = half((from, first), [(from, first), (at, middle)]);
        before.plus(&half((to, last), [(at, middle), (to, last)]))
    }

    /// The effect of the media at a fraction of an interval.
    fn media_sample(
        &self,
        segment: &MediaSegment,
        interval: &MediaInterval,
        at: f64,
        scratch: &mut Scratch,
    ) -> MediaSample {
        let [sample] = self.media_samples(segment, interval, &[at], scratch);
        sample
    }

    /// The effects of the media at up to `N` fractions of an interval.
    fn media_samples<const N: usize>(
        &self,
        segment: &MediaSegment,
        interval: &MediaInterval,
        at: &[f64],
        scratch: &mut Scratch,
    ) -> [MediaSample; N] {
        let length = interval.to - interval.from;
        let count = at.len().min(N);
        let mut distances = [0.0; N];
        let mut points = [DVec3::ZERO; N];
        for i in 0..count {
            distances[i] = interval.from + at[i] * length;
            points[i] = segment.ray.at(distances[i]);
        }
        let points = &points[..count];
        let mut effects = [MediumCoefficients::NONE; N];
        let effects = &mut effects[..count];
        add_effects(segment.media, points, effects);
        let mut radiances = [Rgb::BLACK; N];
        for (radiance, effect) in radiances.iter_mut().zip(&*effects) {
            *radiance = effect.emission;
        }
        if interval.is_lit {
            for beam in segment.beams {
                let at = MediaPoints {
                    distances: &distances,
                    points,
                    effects,
                };
                let scattered: [_; N] = self.scattered(segment, beam, length, &at, scratch);
                for (i, scattered) in scattered.into_iter().enumerate() {
                    if let Some(scattered) = scattered {
                        radiances[i] += scattered * effects[i].scattering;
                    }
                }
            }
        }
        let mut samples = [MediaSample::NOTHING; N];
        for i in 0..count {
            let (mut radiance, effect) = (radiances[i], &effects[i]);
            if self.has_volume_photons() {
                let dir = segment.ray.dir;
                radiance +=
                    self.volume_photon_light(segment.media, points[i], dir, effect, scratch);
            }
            samples[i] = MediaSample {
                radiance: radiance * length,
                optical_depth: effect.extinction * length,
            };
        }
        samples
    }

    /// The number of steps of method 3 and their width as a share of the interval. In 3.7 a last step of the same width
    /// follows that is not sampled, and fewer than 2 samples count as 2; from 3.8 on the steps fill the interval (measured).
    fn even_steps(&self, sampling: &Sampling) -> (u32, f64) {
        let samples = sampling.samples[0];
        let (steps, unsampled) = match self.world.globals.is_3_8 {
            true => (samples.div_ceil(2).max(1), 0),
            false => ((samples / 2 + 1).max(2), 1),
        };
        (steps, 1.0 / f64::from(steps + unsampled))
    }

    /// The transmittance of media along a ray. Media without extinction are skipped, as in POV-Ray: no random numbers
    /// are drawn.
    fn extinction(
        &self,
        media: &[&PreparedMedia],
        ray: &Ray,
        length: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        if !media.iter().any(|media| media.attenuates()) {
            return Rgb::WHITE;
        }
        if !media.iter().any(|media| media.has_density()) {
            // A single sample draws a random number like any other.
            scratch.random.media.next_number();
            return transmittance_of(effect_at(media, ray.origin).extinction * length);
        }
        let Some(sampling) = common_sampling(media) else {
            return Rgb::WHITE;
        };
        let taken = |at: f64| effect_at(media, ray.at(at)).extinction;
        let is_even = media.iter().all(|media| media.is_homogeneous());
        let intervals = sampling.intervals;
        let each = length / f64::from(intervals);
        // As in `subdivided`.
        let end = f64::from(intervals) * each;
        let rest = (end < length).then_some((end, length - end));
        let mut optical_depth = Rgb::BLACK;
        let all = (0..intervals).map(|interval| (f64::from(interval) * each, each));
        for (from, long) in all.chain(rest) {
            let mean = if is_even {
                scratch.random.media.next_number();
                taken(from)
            } else {
                let effects_at = |at: &[f64]| {
                    let points: SmallVec<[DVec3; 16]> =
                        at.iter().map(|at| ray.at(from + at * long)).collect();
                    let mut effects = smallvec![MediumCoefficients::NONE; points.len()];
                    add_effects(media, &points, &mut effects);
                    effects
                };
                mean_extinction(&sampling, self.even_steps(&sampling), effects_at, scratch)
            };
            optical_depth += mean * long;
        }
        transmittance_of(optical_depth)
    }
}

/// Adds the combined effects of media at points.
#[inline]
fn add_effects(media: &[&PreparedMedia], points: &[DVec3], effects: &mut [MediumCoefficients]) {
    for media in media {
        media.add_coefficients(points, effects);
    }
}

/// The combined effect of media at one point.
pub(super) fn effect_at(media: &[&PreparedMedia], point: DVec3) -> MediumCoefficients {
    let mut effect = [MediumCoefficients::NONE];
    add_effects(media, &[point], &mut effect);
    effect[0]
}

/// The mean extinction over an interval, sampled as the method does without emission and scattering; `effects_at` gives
/// the effects at fractions of the interval. `steps` and `width` are those of method 3.
fn mean_extinction(
    sampling: &Sampling,
    (steps, width): (u32, f64),
    effects_at: impl Fn(&[f64]) -> SmallVec<[MediumCoefficients; 16]>,
    scratch: &mut Scratch,
) -> Rgb {
    let least = sampling.samples[0];
    let mut random = || scratch.random.media.next_number();
    let mut at: SmallVec<[f64; 16]> = SmallVec::new();
    let mut sum = Rgb::BLACK;
    if sampling.method != 3 {
        at.extend((0..least).map(|number| match sampling.method {
            1 => random(),
            _ => (f64::from(number) + 0.5 + sampling.jitter * random()) / f64::from(least),
        }));
        for effect in effects_at(&at) {
            sum += effect.extinction;
        }
        return sum * (1.0 / f64::from(least));
    }
    let mut shifted = |at: f64, by: f64| at + by * sampling.jitter * (random() - 0.5);
    let mut from = shifted(0.0, width);
    at.push(from);
    for step in 1..=steps {
        let to = shifted(f64::from(step) * width, width);
        at.extend([shifted(0.5 * (from + to), to - from), to]);
        from = to;
    }
    let effects = effects_at(&at);
    for step in effects.windows(3).step_by(2) {
        let [first, middle, last] = [0, 1, 2].map(|i| step[i].extinction);
        // Each half takes one of the two thirds in the middle.
        sum += (first + last) * (1.0 / 3.0) + middle * (1.0 / 3.0);
    }
    sum * (1.0 / f64::from(steps))
}

/// The transmittance of an optical depth (Beer's law).
pub(super) fn transmittance_of(optical_depth: Rgb) -> Rgb {
    let Rgb { r, g, b } = optical_depth;
    if r == g && g == b {
        return Rgb::splat((-r).exp());
    }
    optical_depth.map(|c| (-c).exp())
}

/// The mean transmittance from the points of a step to its beginning, by the optical depth of the step. Version 3.8 dims
/// the light of a step by it (measured).
#[allow(
    clippy::cast_possible_truncation,
    reason = "light is in single precision"
)]
fn mean_transmittance_of(optical_depth: Rgb) -> Rgb {
    optical_depth.map(|depth| {
        let depth = f64::from(depth);
        match depth == 0.0 {
            true => 1.0,
            false => (-(-depth).exp_m1() / depth) as f32,
        }
    })
}

impl MediaSums {
    const NOTHING: MediaSums = MediaSums {
        radiance: Rgb::BLACK,
        squares: Rgb::BLACK,
        optical_depth: Rgb::BLACK,
        count: 0,
    };

    /// The largest variance of the mean among the channels.
    fn variance(&self) -> f64 {
        let share = 1.0 / f64::from(self.count.max(1));
        let mean = self.radiance * share;
        let variance = (self.squares * share - mean * mean) * share;
        f64::from(variance.max())
    }
}

impl MediaSample {
    const NOTHING: MediaSample = MediaSample {
        radiance: Rgb::BLACK,
        optical_depth: Rgb::BLACK,
    };

    fn plus(&self, other: &MediaSample) -> MediaSample {
        MediaSample {
            radiance: self.radiance + other.radiance,
            optical_depth: self.optical_depth + other.optical_depth,
        }
    }

    fn times(&self, factor: f64) -> MediaSample {
        MediaSample {
            radiance: self.radiance * factor,
            optical_depth: self.optical_depth * factor,
        }
    }

    fn differs(&self, other: &MediaSample, threshold: f64) -> bool {
        let difference = (self.radiance - other.radiance).map(f32::abs);
        f64::from(difference.r + difference.g + difference.b) > threshold
    }
}

//! Participating media along a ray: emission, absorption and scattering on each segment between two surfaces.
//!
//! A segment is divided where light beams begin and end, each part into intervals, and these are sampled by one of
//! three methods (docs/povray-facts.md, section 10): at random, evenly, or evenly with adaptive halving.

use super::bsdf::{ViewPoint, is_negligible};
use super::shading_point::{LightSamples, ShadingPoint};
use super::{InteriorStack, Path, Tracer};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::chi_square::chi_square;
use crate::render::shade::Scratch;
use crate::scene::atmosphere::Tint;
use crate::scene::interior::{MediumCoefficients, PreparedMedia, Sampling};
use crate::world::LightList;
use glam::DVec3;
use smallvec::SmallVec;

/// The media of a segment; their effects add up.
pub(super) type Mixture<'w> = SmallVec<[&'w PreparedMedia; 4]>;

/// The interval of a ray within the beam of a light.
pub(super) struct LightBeam {
    number: u32,
    from: f64,
    to: f64,
}

/// An interval of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MediaInterval {
    pub(super) from: f64,
    pub(super) to: f64,
    is_lit: bool,
}

/// A ray segment in media.
struct MediaSegment<'a> {
    media: &'a [&'a PreparedMedia],
    ray: Ray,
    path: &'a Path,
    beams: &'a [LightBeam],
    sampling: Sampling,
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

impl Tracer<'_> {
    /// The effect of the interiors around a ray over `length`.
    pub(super) fn media_inside(
        &self,
        path: &Path,
        length: f64,
        lights: LightList,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        if !self.features.has_media
            || path.inside.is_empty()
            || !self.is_outside_solids(&path.inside)
        {
            return None;
        }
        let media = self.media_of(&path.inside);
        self.segment_tint(&media, path, length, lights, scratch)
    }

    /// The effect of the media of the atmosphere over `length` of a ray in the atmosphere.
    pub(super) fn atmospheric_media(
        &self,
        path: &Path,
        length: f64,
        lights: LightList,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        if !self.features.has_media {
            return None;
        }
        let media: Mixture = self.world.media.iter().collect();
        self.segment_tint(&media, path, length, lights, scratch)
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
        inside: &InteriorStack,
        scratch: &mut Scratch,
    ) -> Rgb {
        if !self.is_outside_solids(inside) {
            return Rgb::WHITE;
        }
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
        length: f64,
        lights: LightList,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        let sampling = common_sampling(media)?;
        let beams = self.beams(lights, &path.ray, length);
        let segment = MediaSegment {
            media,
            ray: path.ray,
            path,
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

    /// The lights that media scatter, with the intervals of their beams along a ray. Neither lights of light groups,
    /// whatever the ray hits, nor shadowless ones take part (checked with POV-Ray).
    pub(super) fn beams(&self, lights: LightList, ray: &Ray, length: f64) -> Vec<LightBeam> {
        let lights = self.world.lights.outside_groups(lights).iter();
        let beam = |&number: &u32| {
            let light = self.world.lights.get(number);
            if !light.media_interaction || light.is_shadowless() {
                return None;
            }
            let (from, to) = light.beam_interval(ray)?;
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

    /// Method 3: even steps, halved where neighbours differ. The last step of an interval is counted but not sampled.
    fn sample_by_halving(
        &self,
        segment: &MediaSegment,
        interval: &MediaInterval,
        sums: &mut MediaSums,
        scratch: &mut Scratch,
    ) {
        let sampling = &segment.sampling;
        let steps = steps_of(sampling.samples[0]);
        let width = 1.0 / (f64::from(steps) + 1.0);
        let jitter = width * sampling.jitter;
        let shifted = |at: f64, scratch: &mut Scratch| {
            at + jitter * (scratch.random.media.next_number() - 0.5)
        };
        let mut from = shifted(0.0, scratch);
        let mut first = self.media_sample(segment, interval, from, scratch);
        for step in 1..=steps {
            let to = shifted(f64::from(step) * width, scratch);
            let second = self.media_sample(segment, interval, to, scratch);
            let ends = [(from, first), (to, second)];
            let depth = sampling.aa_level.saturating_sub(1);
            let mean = self.halve(segment, interval, ends, depth, scratch);
            sums.radiance +=
                mean.radiance * transmittance_of(sums.optical_depth * (1.0 / f64::from(steps)));
            sums.optical_depth += mean.optical_depth;
            (from, first) = (to, second);
        }
        sums.count = steps;
    }

    /// The mean between two samples, with one in the middle and more where they differ.
    fn halve(
        &self,
        segment: &MediaSegment,
        interval: &MediaInterval,
        [(from, first), (to, last)]: [(f64, MediaSample); 2],
        depth: u32,
        scratch: &mut Scratch,
    ) -> MediaSample {
        let sampling = &segment.sampling;
        let random = scratch.random.media.next_number() - 0.5;
        let at = 0.5 * (from + to) + sampling.jitter * (to - from) * random;
        let middle = self.media_sample(segment, interval, at, scratch);
        if depth == 0 {
            return first.plus(&middle).plus(&last).times(1.0 / 3.0);
        }
        let mut half = |end: (f64, MediaSample), ends: [(f64, MediaSample); 2]| {
            if end.1.differs(&middle, sampling.aa_threshold) {
                let mean = self.halve(segment, interval, ends, depth - 1, scratch);
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
        let length = interval.to - interval.from;
        let distance = interval.from + at * length;
        let point = segment.ray.at(distance);
        let effect = effect_of(segment.media, point);
        let mut radiance = effect.emission;
        if interval.is_lit && !is_negligible(effect.scattering * length) {
            for beam in segment.beams {
                if beam.from <= distance && distance <= beam.to {
                    let scattered = self.scattered(segment, beam.number, distance, scratch);
                    radiance += scattered * effect.scattering;
                }
            }
        }
        if self.has_volume_photons() {
            radiance +=
                self.volume_photon_light(segment.media, point, segment.ray.dir, &effect, scratch);
        }
        MediaSample {
            radiance: radiance * length,
            optical_depth: effect.extinction * length,
        }
    }

    /// Light from a light source that media scatter into the ray at this distance, relative to their scattering.
    fn scattered(
        &self,
        segment: &MediaSegment,
        number: u32,
        distance: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        let point = segment.ray.at(distance);
        // The first sample lies in the surface that the ray has left.
        let spawn_surface = segment.path.from.as_ref().filter(|_| distance == 0.0);
        let light = self.world.lights.get(number);
        let arrival = light.arrival(point);
        let mut arriving = light.color * light.attenuation(point, &arrival);
        if is_negligible(arriving) {
            return Rgb::BLACK;
        }
        let lit = ShadingPoint {
            at: ViewPoint {
                point,
                normal: DVec3::ZERO,
                view: segment.ray.dir,
            },
            spawn_surface,
            path: segment.path,
            known: LightSamples::NONE,
            shadow_cache: None,
            is_double_illuminated: false,
            lights: &[],
            collects: self.has_caustics(),
        };
        if self.quality.has_shadows {
            arriving = self.shadowed_light(arriving, number, &lit, &arrival, scratch);
        }
        let cosine = arrival.to_light.dot(segment.ray.dir);
        let phases = segment.media.iter().map(|media| media.phase(cosine));
        arriving * (phases.sum::<f64>() / segment.media.len() as f64)
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
            return transmittance_of(effect_of(media, ray.origin).extinction * length);
        }
        let Some(sampling) = common_sampling(media) else {
            return Rgb::WHITE;
        };
        let taken = |at: f64| effect_of(media, ray.at(at)).extinction;
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
                mean_of(&sampling, |at| taken(from + at * long), scratch)
            };
            optical_depth += mean * long;
        }
        transmittance_of(optical_depth)
    }
}

/// The combined effect of media at a point.
#[inline]
fn effect_of(media: &[&PreparedMedia], point: DVec3) -> MediumCoefficients {
    let mut effect = MediumCoefficients::NONE;
    for media in media {
        media.add_coefficients(point, &mut effect);
    }
    effect
}

/// The even steps of method 3; fewer than 2 samples count as 2 (measured with POV-Ray).
fn steps_of(samples: u32) -> u32 {
    (samples / 2 + 1).max(2)
}

/// The mean of a quantity over an interval, sampled as the method does without emission and scattering.
fn mean_of(sampling: &Sampling, of: impl Fn(f64) -> Rgb, scratch: &mut Scratch) -> Rgb {
    let least = sampling.samples[0];
    let mut sum = Rgb::BLACK;
    if sampling.method != 3 {
        for number in 0..least {
            let random = scratch.random.media.next_number();
            sum += of(if sampling.method == 1 {
                random
            } else {
                (f64::from(number) + 0.5 + sampling.jitter * random) / f64::from(least)
            });
        }
        return sum * (1.0 / f64::from(least));
    }
    let steps = steps_of(least);
    let width = 1.0 / (f64::from(steps) + 1.0);
    let mut shifted =
        |at: f64, by: f64| at + by * sampling.jitter * (scratch.random.media.next_number() - 0.5);
    let mut from = shifted(0.0, width);
    let mut first = of(from);
    for step in 1..=steps {
        let to = shifted(f64::from(step) * width, width);
        let middle = shifted(0.5 * (from + to), to - from);
        let last = of(to);
        // Each half takes one of the two thirds in the middle.
        sum += (first + last) * (1.0 / 3.0) + of(middle) * (1.0 / 3.0);
        (from, first) = (to, last);
    }
    sum * (1.0 / f64::from(steps))
}

/// The common sampling of several media: that with the most intervals, at the smallest threshold.
pub(super) fn common_sampling(media: &[&PreparedMedia]) -> Option<Sampling> {
    let mut common = media.first()?.sampling;
    for media in media {
        let own = media.sampling;
        let threshold = common.aa_threshold.min(own.aa_threshold);
        if own.intervals > common.intervals {
            common = own;
        }
        common.aa_threshold = threshold;
    }
    Some(common)
}

/// The intervals inside and outside of beams, in order.
pub(super) fn parts_of(beams: &[LightBeam], length: f64) -> Vec<MediaInterval> {
    let mut lit: Vec<(f64, f64)> = beams.iter().map(|beam| (beam.from, beam.to)).collect();
    lit.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut parts: Vec<MediaInterval> = Vec::new();
    let mut end = 0.0;
    for (from, to) in lit {
        if from > end {
            parts.push(MediaInterval {
                from: end,
                to: from,
                is_lit: false,
            });
        }
        match parts.last_mut() {
            Some(last) if last.is_lit && from <= last.to => last.to = last.to.max(to),
            _ => parts.push(MediaInterval {
                from,
                to,
                is_lit: true,
            }),
        }
        end = end.max(to);
    }
    if end < length {
        parts.push(MediaInterval {
            from: end,
            to: length,
            is_lit: false,
        });
    }
    parts
}

/// Divides parts into intervals: lit parts get their share of them. Where rounding leaves all intervals together short
/// of the end, the rest is one more, as in POV-Ray: it draws random numbers like any other.
pub(super) fn subdivided(parts: &[MediaInterval], sampling: &Sampling) -> Vec<MediaInterval> {
    let wanted = sampling.intervals as usize;
    let all = wanted.max(parts.len());
    let weight = |part: &MediaInterval| {
        if part.is_lit {
            sampling.ratio
        } else {
            1.0 - sampling.ratio
        }
    };
    let total: f64 = parts.iter().map(weight).sum();
    let mut remaining = all;
    let mut intervals = Vec::with_capacity(all);
    for (number, part) in parts.iter().enumerate() {
        let count = if parts.len() == 1 {
            wanted
        } else {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "the cast saturates"
            )]
            let share = (weight(part) / total * all as f64) as usize + 1;
            share
                .min((remaining + number + 1).saturating_sub(parts.len()))
                .max(1)
        };
        remaining = remaining.saturating_sub(count);
        let length = (part.to - part.from) / count as f64;
        intervals.extend((0..count).map(|index| MediaInterval {
            from: part.from + index as f64 * length,
            to: part.from + (index + 1) as f64 * length,
            is_lit: part.is_lit,
        }));
    }
    if let (Some(end), Some(last)) = (parts.last().map(|part| part.to), intervals.last())
        && last.to < end
    {
        let from = last.to;
        intervals.push(MediaInterval {
            from,
            to: end,
            is_lit: false,
        });
    }
    intervals
}

/// The transmittance of an optical depth (Beer's law).
pub(super) fn transmittance_of(optical_depth: Rgb) -> Rgb {
    let Rgb { r, g, b } = optical_depth;
    if r == g && g == b {
        return Rgb::splat((-r).exp());
    }
    optical_depth.map(|c| (-c).exp())
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

#[cfg(test)]
mod tests {
    use super::*;

    fn beam(from: f64, to: f64) -> LightBeam {
        LightBeam {
            number: 0,
            from,
            to,
        }
    }

    fn part(from: f64, to: f64, is_lit: bool) -> MediaInterval {
        MediaInterval { from, to, is_lit }
    }

    #[test]
    fn beams_that_overlap_are_one_lit_part() {
        let beams = [beam(5.0, 7.0), beam(1.0, 3.0), beam(2.0, 4.0)];
        let expected = [
            part(0.0, 1.0, false),
            part(1.0, 4.0, true),
            part(4.0, 5.0, false),
            part(5.0, 7.0, true),
            part(7.0, 10.0, false),
        ];
        assert_eq!(parts_of(&beams, 10.0), expected);
        assert_eq!(parts_of(&[], 2.0), [part(0.0, 2.0, false)]);
    }

    fn sampling_of_seven() -> Sampling {
        Sampling {
            method: 3,
            intervals: 7,
            samples: [1, 1],
            confidence: 0.9,
            variance: 0.01,
            ratio: 0.9,
            jitter: 0.0,
            aa_level: 3,
            aa_threshold: 0.1,
        }
    }

    #[test]
    fn intervals_fill_the_segment_without_gaps() {
        let sampling = sampling_of_seven();
        let parts = parts_of(&[beam(1.0, 3.0), beam(6.0, 7.0)], 9.0);
        let intervals = subdivided(&parts, &sampling);
        assert!(
            intervals
                .windows(2)
                .all(|pair| (pair[0].to - pair[1].from).abs() < 1e-12)
        );
        assert_eq!(
            (intervals[0].from, intervals[intervals.len() - 1].to),
            (0.0, 9.0)
        );
        let lit = intervals.iter().filter(|interval| interval.is_lit).count();
        assert!(2 * lit > intervals.len(), "{lit} of {}", intervals.len());
    }

    #[test]
    fn rounding_may_leave_one_more_interval() {
        let sampling = Sampling {
            intervals: 3,
            ..sampling_of_seven()
        };
        // The lengths are among those measured with POV-Ray.
        for (length, count) in [(1.728_715, 4), (0.920_754, 4), (1.0, 3), (1.5, 3)] {
            assert_eq!(subdivided(&parts_of(&[], length), &sampling).len(), count);
        }
    }
}

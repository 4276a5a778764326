//! Media on the way of a ray: light is given, swallowed and scattered along each stretch between two surfaces.
//!
//! A stretch is divided where beams of light begin and end, each part into intervals, and these are sampled by one of
//! three methods (facts 2, section 1): at random, evenly, or evenly with halving where neighbours differ.

use super::direct::light::{LightSamples, ShadingPoint, ViewPoint, is_nothing};
use super::{Inside, Path, Tracer};
use crate::base::color::Rgb;
use crate::base::math::Ray;
use crate::base::math::sampling::chi_square::chi_square;
use crate::scene::atmosphere::Tint;
use crate::scene::interior::{Effect, PreparedMedia, Sampling};
use crate::world::{LightList, Scratch};
use glam::DVec3;
use smallvec::SmallVec;

/// The media of a stretch, which add up.
pub(super) type Mixture<'w> = SmallVec<[&'w PreparedMedia; 4]>;

/// A light with the stretch of the ray that lies in its beam.
pub(super) struct LightBeam {
    number: u32,
    from: f64,
    to: f64,
}

/// A part of a stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MediaStep {
    pub(super) from: f64,
    pub(super) to: f64,
    is_lit: bool,
}

/// A stretch of a ray in media.
struct MediaInterval<'a> {
    media: &'a [&'a PreparedMedia],
    ray: Ray,
    path: &'a Path,
    beams: &'a [LightBeam],
    sampling: Sampling,
}

/// What media give along an interval and how much light they swallow, both as sums over samples.
#[derive(Clone, Copy)]
struct MediaSums {
    given: Rgb,
    /// The squares of what each sample gave.
    squares: Rgb,
    swallowed: Rgb,
    count: u32,
}

/// What media do at a point of an interval, over all its length.
#[derive(Clone, Copy)]
struct MediaSample {
    given: Rgb,
    swallowed: Rgb,
}

impl Tracer<'_> {
    /// What the interiors that a ray is in do to light over `length` of it.
    pub(super) fn media_inside(
        &self,
        path: &Path,
        length: f64,
        lights: LightList,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        if !self.has_media || path.inside.is_empty() || !self.is_in_air(&path.inside) {
            return None;
        }
        let media = self.media_of(&path.inside);
        self.stretch(&media, path, length, lights, scratch)
    }

    /// What the media of the atmosphere do to light over `length` of a ray that is in the air.
    pub(super) fn media_of_air(
        &self,
        path: &Path,
        length: f64,
        lights: LightList,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        if !self.has_media {
            return None;
        }
        let media: Mixture = self.world.media.iter().collect();
        self.stretch(&media, path, length, lights, scratch)
    }

    /// What the interiors around it leave of light over a part of its way to a point.
    pub(super) fn dimmed_inside(
        &self,
        ray: &Ray,
        length: f64,
        inside: &Inside,
        scratch: &mut Scratch,
    ) -> Rgb {
        if !self.has_media || inside.is_empty() || !self.is_in_air(inside) {
            return Rgb::WHITE;
        }
        self.extinction(&self.media_of(inside), ray, length, scratch)
    }

    /// What the media of the atmosphere leave of it.
    pub(super) fn dimmed_by_air(
        &self,
        ray: &Ray,
        length: f64,
        inside: &Inside,
        scratch: &mut Scratch,
    ) -> Rgb {
        if !self.is_in_air(inside) {
            return Rgb::WHITE;
        }
        let media: Mixture = self.world.media.iter().collect();
        self.extinction(&media, ray, length, scratch)
    }

    pub(super) fn media_of(&self, inside: &Inside) -> Mixture<'_> {
        let media = inside.iter().map(|&id| self.world.interiors.media(id));
        media.flatten().collect()
    }

    fn stretch(
        &self,
        media: &[&PreparedMedia],
        path: &Path,
        length: f64,
        lights: LightList,
        scratch: &mut Scratch,
    ) -> Option<Tint> {
        let sampling = common_sampling(media)?;
        let beams = self.beams(lights, &path.ray, length);
        let stretch = MediaInterval {
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
            parts => divided(parts, &sampling),
        };
        Some(self.sum_up(&stretch, &intervals, scratch))
    }

    /// The lights that media scatter, and where their beams cross a ray. Those of light groups are not among them, whatever
    /// the ray meets behind, and neither are shadowless ones (checked with POV-Ray).
    pub(super) fn beams(&self, lights: LightList, ray: &Ray, length: f64) -> Vec<LightBeam> {
        let lights = self.world.lights.outside_groups(lights).iter();
        let beam = |&number: &u32| {
            let light = self.world.lights.get(number);
            if !light.media_interaction || light.is_shadowless() {
                return None;
            }
            let (from, to) = light.crossed_by(ray)?;
            let (from, to) = (from.max(0.0), to.min(length));
            (from < to).then_some(LightBeam { number, from, to })
        };
        lights.filter_map(beam).collect()
    }

    /// What the intervals of a stretch do to light, the nearest first.
    fn sum_up(
        &self,
        stretch: &MediaInterval,
        intervals: &[MediaStep],
        scratch: &mut Scratch,
    ) -> Tint {
        let mut sums: Vec<MediaSums> = intervals
            .iter()
            .map(|interval| self.sampled(stretch, interval, scratch))
            .collect();
        self.sample_more(stretch, intervals, &mut sums, scratch);
        let (mut given, mut swallowed) = (Rgb::BLACK, Rgb::BLACK);
        for sum in &sums {
            let share = 1.0 / f64::from(sum.count.max(1));
            given += sum.given * share * vanishing(swallowed);
            swallowed += sum.swallowed * share;
        }
        Tint {
            factor: vanishing(swallowed),
            added: given,
        }
    }

    fn sampled(
        &self,
        stretch: &MediaInterval,
        interval: &MediaStep,
        scratch: &mut Scratch,
    ) -> MediaSums {
        let sampling = &stretch.sampling;
        let mut sums = MediaSums::NOTHING;
        match sampling.method {
            3 => self.sample_by_halving(stretch, interval, &mut sums, scratch),
            method => {
                let count = sampling.samples[0];
                for number in 0..count {
                    let random = scratch.media_stream.next_number();
                    let at = if method == 1 {
                        random
                    } else {
                        (f64::from(number) + 0.5 + sampling.jitter * random) / f64::from(count)
                    };
                    self.add_sample(stretch, interval, at, &mut sums, scratch);
                }
            }
        }
        sums
    }

    /// Samples on until the variance is small enough, for the methods that do so.
    fn sample_more(
        &self,
        stretch: &MediaInterval,
        intervals: &[MediaStep],
        sums: &mut [MediaSums],
        scratch: &mut Scratch,
    ) {
        let sampling = &stretch.sampling;
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
                let at = scratch.media_stream.next_number();
                self.add_sample(stretch, interval, at, sum, scratch);
            }
        }
    }

    fn add_sample(
        &self,
        stretch: &MediaInterval,
        interval: &MediaStep,
        at: f64,
        sums: &mut MediaSums,
        scratch: &mut Scratch,
    ) {
        let sampled = self.at(stretch, interval, at, scratch);
        let given = sampled.given * vanishing(sampled.swallowed * at);
        sums.given += given;
        sums.squares += given * given;
        sums.swallowed += sampled.swallowed;
        sums.count += 1;
    }

    /// Method 3: even steps, halved where neighbours differ. The last step of an interval is counted and not sampled.
    fn sample_by_halving(
        &self,
        stretch: &MediaInterval,
        interval: &MediaStep,
        sums: &mut MediaSums,
        scratch: &mut Scratch,
    ) {
        let sampling = &stretch.sampling;
        let steps = steps_of(sampling.samples[0]);
        let width = 1.0 / (f64::from(steps) + 1.0);
        let jitter = width * sampling.jitter;
        let shifted = |at: f64, scratch: &mut Scratch| {
            at + jitter * (scratch.media_stream.next_number() - 0.5)
        };
        let mut from = shifted(0.0, scratch);
        let mut first = self.at(stretch, interval, from, scratch);
        for step in 1..=steps {
            let to = shifted(f64::from(step) * width, scratch);
            let second = self.at(stretch, interval, to, scratch);
            let ends = [(from, first), (to, second)];
            let depth = sampling.aa_level.saturating_sub(1);
            let mean = self.halved(stretch, interval, ends, depth, scratch);
            sums.given += mean.given * vanishing(sums.swallowed * (1.0 / f64::from(steps)));
            sums.swallowed += mean.swallowed;
            (from, first) = (to, second);
        }
        sums.count = steps;
    }

    /// The mean between two samples, with one in the middle and more where they differ.
    fn halved(
        &self,
        stretch: &MediaInterval,
        interval: &MediaStep,
        [(from, first), (to, last)]: [(f64, MediaSample); 2],
        depth: u32,
        scratch: &mut Scratch,
    ) -> MediaSample {
        let sampling = &stretch.sampling;
        let random = scratch.media_stream.next_number() - 0.5;
        let at = 0.5 * (from + to) + sampling.jitter * (to - from) * random;
        let middle = self.at(stretch, interval, at, scratch);
        if depth == 0 {
            return first.plus(&middle).plus(&last).times(1.0 / 3.0);
        }
        let mut half = |end: (f64, MediaSample), ends: [(f64, MediaSample); 2]| {
            if end.1.differs(&middle, sampling.aa_threshold) {
                let mean = self.halved(stretch, interval, ends, depth - 1, scratch);
                mean.times(0.5)
            } else {
                end.1.times(1.0 / 3.0).plus(&middle.times(1.0 / 6.0))
            }
        };
        let before = half((from, first), [(from, first), (at, middle)]);
        before.plus(&half((to, last), [(at, middle), (to, last)]))
    }

    /// What media do at a share of an interval.
    fn at(
        &self,
        stretch: &MediaInterval,
        interval: &MediaStep,
        at: f64,
        scratch: &mut Scratch,
    ) -> MediaSample {
        let length = interval.to - interval.from;
        let way = interval.from + at * length;
        let point = stretch.ray.at(way);
        let effect = effect_of(stretch.media, point);
        let mut given = effect.emission;
        if interval.is_lit && !is_nothing(effect.scattering * length) {
            for beam in stretch.beams {
                if beam.from <= way && way <= beam.to {
                    let scattered = self.scattered(stretch, beam.number, way, scratch);
                    given += scattered * effect.scattering;
                }
            }
        }
        if self.has_cloud() {
            given += self.cloud_light(stretch.media, (point, stretch.ray.dir), &effect, scratch);
        }
        MediaSample {
            given: given * length,
            swallowed: effect.extinction * length,
        }
    }

    /// The light of a lamp that media scatter so far along a ray into it, as a factor on how much they scatter.
    fn scattered(
        &self,
        stretch: &MediaInterval,
        number: u32,
        way: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        let point = stretch.ray.at(way);
        // The first sample lies in the surface that the ray has left.
        let departure = stretch.path.from.as_ref().filter(|_| way == 0.0);
        let light = self.world.lights.get(number);
        let arrival = light.arrival(point);
        let mut arriving = light.color * light.share(point, &arrival);
        if is_nothing(arriving) {
            return Rgb::BLACK;
        }
        let lit = ShadingPoint {
            at: ViewPoint {
                point,
                normal: DVec3::ZERO,
                view: stretch.ray.dir,
            },
            departure,
            path: stretch.path,
            known: LightSamples::NONE,
            arrived: None,
            is_double_illuminated: false,
            lights: &[],
            collects: self.has_caustics(),
        };
        if self.quality.has_shadows {
            arriving = self.after_shadows(arriving, number, &lit, &arrival, scratch);
        }
        let cosine = arrival.to_light.dot(stretch.ray.dir);
        let phases = stretch.media.iter().map(|media| media.phase(cosine));
        arriving * (phases.sum::<f64>() / stretch.media.len() as f64)
    }

    /// The share of light that passes media along a ray. Where they take none they are not asked, as in POV-Ray: that takes
    /// no random numbers.
    fn extinction(
        &self,
        media: &[&PreparedMedia],
        ray: &Ray,
        length: f64,
        scratch: &mut Scratch,
    ) -> Rgb {
        if !media.iter().any(|media| media.takes_light()) {
            return Rgb::WHITE;
        }
        if !media.iter().any(|media| media.has_density()) {
            // A single sample, which takes a random number as any other.
            scratch.media_stream.next_number();
            return vanishing(effect_of(media, ray.origin).extinction * length);
        }
        let Some(sampling) = common_sampling(media) else {
            return Rgb::WHITE;
        };
        let taken = |at: f64| effect_of(media, ray.at(at)).extinction;
        let is_even = media.iter().all(|media| media.is_even());
        let intervals = sampling.intervals;
        let each = length / f64::from(intervals);
        // As in `divided`.
        let end = f64::from(intervals) * each;
        let rest = (end < length).then_some((end, length - end));
        let mut swallowed = Rgb::BLACK;
        let all = (0..intervals).map(|interval| (f64::from(interval) * each, each));
        for (from, long) in all.chain(rest) {
            let mean = if is_even {
                scratch.media_stream.next_number();
                taken(from)
            } else {
                mean_of(&sampling, |at| taken(from + at * long), scratch)
            };
            swallowed += mean * long;
        }
        vanishing(swallowed)
    }
}

/// What media together do at a point.
#[inline]
fn effect_of(media: &[&PreparedMedia], point: DVec3) -> Effect {
    let mut effect = Effect::NONE;
    for media in media {
        media.add_effect(point, &mut effect);
    }
    effect
}

/// The even steps of method 3; fewer samples than 2 are taken for 2 (measured with POV-Ray).
fn steps_of(samples: u32) -> u32 {
    (samples / 2 + 1).max(2)
}

/// The mean of a quantity over an interval, sampled as the method has it where nothing is given.
fn mean_of(sampling: &Sampling, of: impl Fn(f64) -> Rgb, scratch: &mut Scratch) -> Rgb {
    let least = sampling.samples[0];
    let mut sum = Rgb::BLACK;
    if sampling.method != 3 {
        for number in 0..least {
            let random = scratch.media_stream.next_number();
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
        |at: f64, by: f64| at + by * sampling.jitter * (scratch.media_stream.next_number() - 0.5);
    let mut from = shifted(0.0, width);
    let mut first = of(from);
    for step in 1..=steps {
        let to = shifted(f64::from(step) * width, width);
        let middle = shifted(0.5 * (from + to), to - from);
        let last = of(to);
        // Of the two thirds in the middle each half takes one.
        sum += (first + last) * (1.0 / 3.0) + of(middle) * (1.0 / 3.0);
        (from, first) = (to, last);
    }
    sum * (1.0 / f64::from(steps))
}

/// How media are sampled together: as that of the most intervals, at the least threshold of all.
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

/// Where a ray is in some beam and where in none, in order.
pub(super) fn parts_of(beams: &[LightBeam], length: f64) -> Vec<MediaStep> {
    let mut lit: Vec<(f64, f64)> = beams.iter().map(|beam| (beam.from, beam.to)).collect();
    lit.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut parts: Vec<MediaStep> = Vec::new();
    let mut end = 0.0;
    for (from, to) in lit {
        if from > end {
            parts.push(MediaStep {
                from: end,
                to: from,
                is_lit: false,
            });
        }
        match parts.last_mut() {
            Some(last) if last.is_lit && from <= last.to => last.to = last.to.max(to),
            _ => parts.push(MediaStep {
                from,
                to,
                is_lit: true,
            }),
        }
        end = end.max(to);
    }
    if end < length {
        parts.push(MediaStep {
            from: end,
            to: length,
            is_lit: false,
        });
    }
    parts
}

/// The intervals of some parts: lit ones have their share of them. Where all intervals together fall short of the way by
/// rounding, the rest of it is one more, as in POV-Ray: it takes random numbers like any other.
pub(super) fn divided(parts: &[MediaStep], sampling: &Sampling) -> Vec<MediaStep> {
    let wanted = sampling.intervals as usize;
    let all = wanted.max(parts.len());
    let weight = |part: &MediaStep| {
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
        intervals.extend((0..count).map(|place| MediaStep {
            from: part.from + place as f64 * length,
            to: part.from + (place + 1) as f64 * length,
            is_lit: part.is_lit,
        }));
    }
    if let (Some(end), Some(last)) = (parts.last().map(|part| part.to), intervals.last())
        && last.to < end
    {
        let from = last.to;
        intervals.push(MediaStep {
            from,
            to: end,
            is_lit: false,
        });
    }
    intervals
}

/// What is left of light.
pub(super) fn vanishing(swallowed: Rgb) -> Rgb {
    let Rgb { r, g, b } = swallowed;
    if r == g && g == b {
        return Rgb::splat((-r).exp());
    }
    swallowed.map(|c| (-c).exp())
}

impl MediaSums {
    const NOTHING: MediaSums = MediaSums {
        given: Rgb::BLACK,
        squares: Rgb::BLACK,
        swallowed: Rgb::BLACK,
        count: 0,
    };

    /// The largest variance of the mean among the channels.
    fn variance(&self) -> f64 {
        let share = 1.0 / f64::from(self.count.max(1));
        let mean = self.given * share;
        let variance = (self.squares * share - mean * mean) * share;
        f64::from(variance.max())
    }
}

impl MediaSample {
    fn plus(&self, other: &MediaSample) -> MediaSample {
        MediaSample {
            given: self.given + other.given,
            swallowed: self.swallowed + other.swallowed,
        }
    }

    fn times(&self, factor: f64) -> MediaSample {
        MediaSample {
            given: self.given * factor,
            swallowed: self.swallowed * factor,
        }
    }

    fn differs(&self, other: &MediaSample, threshold: f64) -> bool {
        let difference = (self.given - other.given).map(f32::abs);
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

    fn part(from: f64, to: f64, is_lit: bool) -> MediaStep {
        MediaStep { from, to, is_lit }
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
    fn intervals_fill_the_stretch_without_gaps() {
        let sampling = sampling_of_seven();
        let parts = parts_of(&[beam(1.0, 3.0), beam(6.0, 7.0)], 9.0);
        let intervals = divided(&parts, &sampling);
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
    fn what_rounding_leaves_of_the_way_is_an_interval_more() {
        let sampling = Sampling {
            intervals: 3,
            ..sampling_of_seven()
        };
        // The lengths are among those measured with POV-Ray.
        for (length, count) in [(1.728_715, 4), (0.920_754, 4), (1.0, 3), (1.5, 3)] {
            assert_eq!(divided(&parts_of(&[], length), &sampling).len(), count);
        }
    }
}

//! Finishes pixels: estimates from their samples and those around them, and more samples until the estimate is good
//! enough.
//!
//! Many pixels are finished side by side, and the samples they request are traced together: rays traced in packets cost
//! a fraction of single rays.

use super::edge_fit::{Buffers, EdgeFit, ErrorGoal, NextStep};
use super::estimate::{Estimate, estimate, limited_by_half};
use super::neighbours::first_estimate;
use super::pixels::{Band, FinishedPixel};
use super::rectangles::TinyObjects;
use super::sample::PointSample;
use super::sample::{AdaptiveSample, SamplerScratch, TOGETHER, pixel};
use super::slope::{Slopes, Sums};
use crate::world::RayCounts;
use std::ops::Range;

/// Share of `contrast / samples` that a feature may contribute which no sample saw. A half plane missed by a (0,
/// 2)-sequence of `n` points covers up to about `1/n` of the pixel; most missed features cover less.
const UNSEEN: f64 = 0.25;
/// The same where the samples around a pixel agree with its own.
pub(super) const HIDDEN: f64 = 0.0625;
/// Upper limit of the samples of a pixel.
const MAX_SAMPLES: usize = 1 << 14;
/// The side of a pixel in the units of sample positions.
const SIDE: i32 = 1 << 16;
/// Distance around a pixel within which first samples show how an edge continues and how colours slope. With half a
/// pixel, three times as many estimates are fooled.
const RING: i32 = SIDE / 4 * 3;
/// The same where pixels have more samples.
const CLOSE: i32 = SIDE / 4;
/// Share of the requested error for pixels that need few samples to reach it. Halving their error costs little, so that
/// the picture is best for its total number of samples.
const EVEN: f64 = 0.25;

/// Task for a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Task {
    /// Finish it if its first samples and a few more are enough.
    Settle,
    /// Finish it in any case.
    Finish,
}

/// The result for a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome {
    pub(super) pixel: (u32, u32),
    /// `None` if a few more samples were not enough.
    pub(super) done: Option<FinishedPixel>,
    /// Additional samples taken.
    pub(super) taken: u32,
}

/// Finishes pixels side by side; holds the buffers of a thread.
#[derive(Default)]
pub(super) struct Finisher {
    sampler: SamplerScratch,
    jobs: Vec<PixelJob>,
    /// Jobs that wait for samples, and those that will wait in the next round.
    waiting: Vec<usize>,
    next: Vec<usize>,
    samples: Vec<AdaptiveSample>,
    buffers: JobBuffers,
}

/// Buffers shared by all jobs.
#[derive(Default)]
struct JobBuffers {
    /// The samples of the pixel and just around it.
    point_samples: Vec<PointSample>,
    grid: Vec<[f64; 4]>,
    edge_fit: Buffers,
}

/// Samples that a job waits for.
#[derive(Clone, Debug, Default)]
enum SampleRequest {
    /// Points of the pixel's sequence with these numbers.
    Numbers(Range<u32>),
    /// Samples at the points of its edge fit.
    #[default]
    Points,
}

/// Purpose of the samples that a job waits for.
#[derive(Clone, Copy, Debug, Default)]
enum Step {
    /// Confirm that the colour slopes like this.
    Sloped(Slopes),
    /// Improve the lines that divide the pixel.
    Divided,
    /// Improve the mean over the pixel.
    #[default]
    Sampled,
}

/// A pixel in progress.
#[derive(Default)]
struct PixelJob {
    pixel: (u32, u32),
    settles: bool,
    step: Step,
    request: SampleRequest,
    samples: Vec<AdaptiveSample>,
    edge_fit: EdgeFit,
    /// True once lines have been fitted to all its samples.
    is_tried: bool,
    taken: u32,
    /// The estimate from all samples, and the same without its history.
    estimate: Estimate,
    whole: Estimate,
    contrast: f64,
}

impl Finisher {
    /// Returns the rays traced since the last call, and resets them.
    pub(super) fn take_rays(&mut self) -> RayCounts {
        self.sampler.take_rays()
    }

    /// Works on pixels that lie near each other; `report` receives the outcome of each, in any order.
    pub(super) fn work(
        &mut self,
        band: &Band<'_>,
        pixels: &[(u32, u32)],
        task: Task,
        mut report: impl FnMut(Outcome),
    ) {
        if self.jobs.len() < pixels.len() {
            self.jobs.resize_with(pixels.len(), PixelJob::default);
        }
        self.waiting.clear();
        for (number, &pixel) in pixels.iter().enumerate() {
            match self.jobs[number].begin(band, pixel, task, &mut self.buffers) {
                Some(outcome) => report(outcome),
                None => self.waiting.push(number),
            }
        }
        while !self.waiting.is_empty() {
            self.next.clear();
            let mut waiting = &self.waiting[..];
            while !waiting.is_empty() {
                self.sampler.clear();
                let requesting = waiting.iter().take_while(|&&number| {
                    let has_capacity = self.sampler.len() < TOGETHER;
                    if has_capacity {
                        self.jobs[number]
                            .request_samples(&mut self.sampler, band.sampler.tiny_objects);
                    }
                    has_capacity
                });
                let (now, later) = waiting.split_at(requesting.count());
                waiting = later;
                self.samples.clear();
                band.sampler
                    .trace_batch(&mut self.sampler, &mut self.samples);
                let mut samples = &self.samples[..];
                for &number in now {
                    let job = &mut self.jobs[number];
                    let (own, others) = samples.split_at(job.request_len());
                    samples = others;
                    match job.resume(band, own, &mut self.buffers) {
                        Some(outcome) => report(outcome),
                        None => self.next.push(number),
                    }
                }
            }
            std::mem::swap(&mut self.waiting, &mut self.next);
        }
    }
}

impl PixelJob {
    /// Starts a pixel; returns its outcome, or `None` if it waits for samples.
    fn begin(
        &mut self,
        band: &Band<'_>,
        (x, y): (u32, u32),
        task: Task,
        buffers: &mut JobBuffers,
    ) -> Option<Outcome> {
        self.pixel = (x, y);
        self.taken = 0;
        self.is_tried = false;
        self.settles = task == Task::Settle;
        let at = band.at(x, y);
        match task {
            Task::Settle => self.settle(band, at, buffers),
            Task::Finish => {
                if let Some(settled) = band.settled_at(at) {
                    return self.outcome(Some(settled));
                }
                let is_calm = !band.is_finer(at) && !band.is_broken_at(at);
                if is_calm {
                    // The comparison with its neighbours has shown that it is calm.
                    let (samples, channels) = (band.first_of(at), band.sampler.channels);
                    let estimate =
                        estimate(samples, channels, &Slopes::default(), &mut buffers.grid);
                    let error = estimate.error.min(band.target.error);
                    return self.outcome(Some(done(&estimate, error)));
                }
                self.samples.clear();
                self.samples.extend_from_slice(band.samples_of(at));
                self.whole = self.of_half(band, &Slopes::default(), buffers);
                self.estimate(band, &Slopes::default(), buffers);
                if !band.is_finer(at) {
                    // The time limit has passed.
                    return self.outcome(Some(done(&self.estimate, self.estimate.error)));
                }
                self.contrast = band.range_around(x, y).contrast(band.sampler.channels);
                self.refine(band, buffers)
            }
        }
    }

    /// Continues with the samples it waited for; returns the outcome, or `None` if it waits for more.
    fn resume(
        &mut self,
        band: &Band<'_>,
        samples: &[AdaptiveSample],
        buffers: &mut JobBuffers,
    ) -> Option<Outcome> {
        self.taken += count_of(samples);
        match self.step {
            Step::Sloped(slopes) => {
                self.samples.extend_from_slice(samples);
                self.whole = self.of_half(band, &slopes, buffers);
                self.estimate(band, &slopes, buffers);
                let is_enough = self.estimate.error <= band.target.error * EVEN;
                self.outcome(is_enough.then(|| done(&self.estimate, self.estimate.error)))
            }
            Step::Sampled => {
                self.samples.extend_from_slice(samples);
                self.estimate(band, &Slopes::default(), buffers);
                self.refine(band, buffers)
            }
            Step::Divided => {
                let holds = match self.request {
                    SampleRequest::Points => self.edge_fit.take_points(samples),
                    SampleRequest::Numbers(_) => {
                        self.samples.extend_from_slice(samples);
                        self.edge_fit.test(samples)
                    }
                };
                match holds {
                    true => self.divide(band),
                    false => self.is_not_divided(band),
                }
            }
        }
    }

    /// Adds the samples it needs to the next batch.
    fn request_samples(&self, sampler: &mut SamplerScratch, tiny_objects: &TinyObjects) {
        match &self.request {
            SampleRequest::Numbers(numbers) => {
                sampler.add_sequence(self.pixel, numbers.clone(), tiny_objects)
            }
            SampleRequest::Points => {
                sampler.add_points(self.pixel, &self.edge_fit.points, tiny_objects)
            }
        }
    }

    /// The number of these samples.
    fn request_len(&self) -> usize {
        match &self.request {
            SampleRequest::Numbers(numbers) => numbers.len(),
            SampleRequest::Points => self.edge_fit.points.len(),
        }
    }

    /// Tries to finish a pixel at an edge or on a slope with its first samples.
    fn settle(&mut self, band: &Band<'_>, at: usize, buffers: &mut JobBuffers) -> Option<Outcome> {
        let (x, y) = self.pixel;
        if band.may_miss_features(x, y) {
            return self.outcome(None);
        }
        self.samples.clear();
        self.samples.extend_from_slice(band.first_of(at));
        let point_samples = &mut buffers.point_samples;
        gather(
            band,
            self.pixel,
            &self.samples,
            RING,
            |at| band.first_of(at),
            point_samples,
        );
        let first = &self.samples[0];
        if point_samples
            .iter()
            .all(|(_, sample)| sample.is_same_side(first))
        {
            let mut sums = Sums::default();
            for (point, sample) in point_samples {
                sums.add(*point, &sample.channels);
            }
            let slopes = sums.plane().map(|plane| plane.slopes()).unwrap_or_default();
            let (estimate, _) = first_estimate(band, self.pixel, &slopes);
            if estimate.error <= band.target.error * EVEN {
                self.step = Step::Sloped(slopes);
                self.request = SampleRequest::Numbers(band.target.first..2 * band.target.first);
                return None;
            }
        }
        match self.begin_dividing(band, buffers) {
            true => self.divide(band),
            false => self.outcome(None),
        }
    }

    /// The next step with all samples so far.
    fn refine(&mut self, band: &Band<'_>, buffers: &mut JobBuffers) -> Option<Outcome> {
        let error = self.estimate.error.max(self.hidden(UNSEEN));
        let is_last = self.samples.len() >= MAX_SAMPLES || band.target.is_over();
        if error <= band.target.error * EVEN || is_last {
            return self.outcome(Some(done(&self.estimate, error)));
        }
        // A few samples on lines lower the error far more than many others. A pixel that no line divides now will not
        // be divided with more samples either.
        if !self.is_tried && self.hidden(HIDDEN) <= band.target.error {
            self.is_tried = true;
            gather(
                band,
                self.pixel,
                &self.samples,
                CLOSE,
                |at| band.samples_of(at),
                &mut buffers.point_samples,
            );
            if self.begin_dividing(band, buffers) {
                return self.divide(band);
            }
        }
        self.is_not_divided(band)
    }

    /// Error of a feature hidden between the samples, if it may cover this share of the contrast around.
    fn hidden(&self, share: f64) -> f64 {
        self.contrast * share / f64::from(count_of(&self.samples))
    }

    fn begin_dividing(&mut self, band: &Band<'_>, buffers: &mut JobBuffers) -> bool {
        self.edge_fit.begin(
            &buffers.point_samples,
            band.sampler.channels,
            self.settles,
            &mut buffers.edge_fit,
        )
    }

    /// The next step with the fitted lines.
    fn divide(&mut self, band: &Band<'_>) -> Option<Outcome> {
        let target = band.target.error;
        let goal = ErrorGoal {
            best: target * EVEN,
            most: if self.settles { target * EVEN } else { target },
        };
        self.step = Step::Divided;
        match self.edge_fit.next(band.sampler.channels, goal) {
            NextStep::GiveUp => self.is_not_divided(band),
            NextStep::Points => {
                self.request = SampleRequest::Points;
                None
            }
            NextStep::Test => {
                self.request = SampleRequest::Numbers(band.target.first..2 * band.target.first);
                None
            }
            NextStep::Done(estimate) => {
                let hidden = if self.settles {
                    0.0
                } else {
                    self.hidden(HIDDEN)
                };
                self.outcome(Some(done(&estimate, estimate.error.max(hidden))))
            }
        }
    }

    /// No lines divide the pixel: take more samples if needed.
    fn is_not_divided(&mut self, band: &Band<'_>) -> Option<Outcome> {
        if self.settles {
            return self.outcome(None);
        }
        let error = self.estimate.error.max(self.hidden(UNSEEN));
        if error <= band.target.error {
            return self.outcome(Some(done(&self.estimate, error)));
        }
        let count = count_of(&self.samples);
        self.step = Step::Sampled;
        self.request = SampleRequest::Numbers(count..2 * count);
        None
    }

    /// The estimate from all samples on a surface with these slopes; `whole` holds the estimate from half of them.
    fn estimate(&mut self, band: &Band<'_>, slopes: &Slopes, buffers: &mut JobBuffers) {
        let channels = band.sampler.channels;
        let half = self.whole;
        self.whole = estimate(&self.samples, channels, slopes, &mut buffers.grid);
        let estimate = limited_by_half(self.whole, &half, channels);
        let times = count_of(&self.samples) / band.target.first;
        self.estimate = Estimate {
            error: estimate.error * caution(times),
            ..estimate
        };
    }

    /// The estimate from the first half of the samples.
    fn of_half(&self, band: &Band<'_>, slopes: &Slopes, buffers: &mut JobBuffers) -> Estimate {
        let half = &self.samples[..self.samples.len() / 2];
        estimate(half, band.sampler.channels, slopes, &mut buffers.grid)
    }

    #[allow(clippy::unnecessary_wraps, reason = "what all steps give")]
    fn outcome(&self, done: Option<FinishedPixel>) -> Option<Outcome> {
        Some(Outcome {
            pixel: self.pixel,
            done,
            taken: self.taken,
        })
    }
}

/// True if the first samples of a pixel, compared with the adjacent ones around it, leave no doubt.
pub(super) fn is_calm(band: &Band<'_>, (x, y): (u32, u32)) -> bool {
    let target = band.target.error;
    let contrast = band.range_around(x, y).contrast(band.sampler.channels);
    // Upper bound of the estimated error if any two of `n` neighbours differ by the contrast.
    let most = (3.0 * f64::from(band.target.first)).sqrt();
    if contrast <= target * f64::min(EVEN * most, 1.0) {
        return true;
    }
    let (estimate, is_torn) = first_estimate(band, (x, y), &Slopes::default());
    if is_torn {
        return contrast <= target;
    }
    estimate.error <= target * EVEN
}

/// Safety factor for the estimated error of a pixel with `times` as many samples as its first. Among pixels with few
/// samples, those stop whose estimate happens to be low: over all pixels that stopped with 16 samples the estimate was
/// from 0.9 to 1.9 times the true error, with 32 from 1.5 to 2.1, with 64 and more up to 2.6. With this factor the same
/// error of the picture takes up to an eighth fewer samples.
fn caution(times: u32) -> f64 {
    match times {
        4..8 => 2.0,
        8..16 => 1.25,
        _ => 1.0,
    }
}

/// Gathers the samples of a pixel and just around it.
fn gather<'a>(
    band: &'a Band<'_>,
    (x, y): (u32, u32),
    own: &[AdaptiveSample],
    width: i32,
    samples_of: impl Fn(usize) -> &'a [AdaptiveSample],
    point_samples: &mut Vec<PointSample>,
) {
    point_samples.clear();
    point_samples.extend(own.iter().map(|sample| (sample.share(), *sample)));
    for (other_x, other_y) in band.around(x, y).filter(|&other| other != (x, y)) {
        let away = [
            other_x.cast_signed() - x.cast_signed(),
            other_y.cast_signed() - y.cast_signed(),
        ];
        let [across, down] = away.map(|away| near(away, width));
        let from = away.map(f64::from);
        for sample in samples_of(band.at(other_x, other_y)) {
            if across.contains(&sample.position.0.into())
                && down.contains(&sample.position.1.into())
            {
                let share = sample.share();
                point_samples.push(([from[0] + share[0], from[1] + share[1]], *sample));
            }
        }
    }
}

/// The positions in a pixel at an offset of at most one column or row that lie within `width` of the pixel at offset
/// zero.
fn near(away: i32, width: i32) -> Range<i32> {
    let from = away * SIDE;
    (-width - from).clamp(0, SIDE)..(SIDE + width - from).clamp(0, SIDE)
}

fn count_of(samples: &[AdaptiveSample]) -> u32 {
    u32::try_from(samples.len()).unwrap_or(u32::MAX)
}

fn done(estimate: &Estimate, error: f64) -> FinishedPixel {
    FinishedPixel {
        value: pixel(estimate.mean),
        error,
    }
}

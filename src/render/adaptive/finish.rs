//! Finishing pixels: what their samples and those around them tell, and more samples until that is enough.
//!
//! Many pixels are finished side by side, and what they ask for is looked at together: rays that are searched for
//! together cost a fraction of what they cost one by one.

use super::band::{Band, FinishedPixel};
use super::edge_fit::{Buffers, Dividing, ErrorGoal, Next, PlacedSample};
use super::estimate::{Estimate, after_half, of_all};
use super::neighbors::first_estimate;
use super::sample::{AdaptiveSample, EyeScratch, TOGETHER, pixel};
use super::slope::{Slopes, Sums};
use super::tiny_objects::TinyObjects;
use crate::world::RayCounts;
use std::ops::Range;

/// The share of `contrast / samples` that a feature may make which no sample saw. A half plane that a (0, 2)-sequence of
/// `n` points does not see covers up to about `1/n` of the pixel, and most do less.
const UNSEEN: f64 = 0.25;
/// The same where the samples around a pixel go with its own.
pub(super) const HIDDEN: f64 = 0.0625;
/// No pixel gets more samples.
const MOST_SAMPLES: usize = 1 << 14;
/// The side of a pixel in the parts that places are counted in.
const SIDE: i32 = 1 << 16;
/// First samples so far around a pixel tell how an edge goes on and how colours slope: those within half a pixel let three
/// times as many be fooled.
const RING: i32 = SIDE / 4 * 3;
/// The same where pixels have more samples.
const CLOSE: i32 = SIDE / 4;
/// The share of the error asked for that pixels may have which need few samples for it: so a picture is best for all its
/// samples together, since halving their error costs little.
const EVEN: f64 = 0.25;

/// What is wanted of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Task {
    /// To be done if its first samples and a little more are enough.
    Settle,
    /// To be done.
    Finish,
}

/// What has become of a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome {
    pub(super) pixel: (u32, u32),
    /// Nothing if a little more was not enough.
    pub(super) done: Option<FinishedPixel>,
    /// How many more samples it took.
    pub(super) taken: u32,
}

/// Buffers of a thread that finishes pixels.
#[derive(Default)]
pub(super) struct Finishing {
    eye: EyeScratch,
    cases: Vec<Case>,
    /// The cases that wait for samples, and those that will do so next.
    waiting: Vec<usize>,
    next: Vec<usize>,
    looks: Vec<AdaptiveSample>,
    buffers: CaseBuffers,
}

/// Buffers that cases use one after the other.
#[derive(Default)]
struct CaseBuffers {
    /// The samples of the pixel and just around it.
    placed: Vec<PlacedSample>,
    grid: Vec<[f64; 4]>,
    dividing: Buffers,
}

/// What a case waits for.
#[derive(Clone, Debug, Default)]
enum SampleRequest {
    /// Samples of these numbers.
    Numbers(Range<u32>),
    /// Samples at the places of its division.
    #[default]
    Places,
}

/// What the samples that a case waits for are to tell.
#[derive(Clone, Copy, Debug, Default)]
enum Step {
    /// Whether the colour slopes like that.
    Sloped(Slopes),
    /// More of the lines that divide the pixel.
    Divided,
    /// More of what is in the pixel.
    #[default]
    Sampled,
}

/// A pixel at work.
#[derive(Default)]
struct Case {
    pixel: (u32, u32),
    settles: bool,
    step: Step,
    wish: SampleRequest,
    looks: Vec<AdaptiveSample>,
    dividing: Dividing,
    /// Whether it was looked for lines among all its samples.
    is_tried: bool,
    taken: u32,
    /// What all samples together tell, and the same without a look at how it came about.
    found: Estimate,
    whole: Estimate,
    contrast: f64,
}

impl Finishing {
    /// How many rays were followed with it since this was last asked.
    pub(super) fn take_rays(&mut self) -> RayCounts {
        self.eye.take_rays()
    }

    /// Works on some pixels that lie near each other; `tell` hears of each what became of it, in any order.
    pub(super) fn work(
        &mut self,
        band: &Band<'_>,
        pixels: &[(u32, u32)],
        task: Task,
        mut tell: impl FnMut(Outcome),
    ) {
        if self.cases.len() < pixels.len() {
            self.cases.resize_with(pixels.len(), Case::default);
        }
        self.waiting.clear();
        for (number, &pixel) in pixels.iter().enumerate() {
            match self.cases[number].begin(band, pixel, task, &mut self.buffers) {
                Some(outcome) => tell(outcome),
                None => self.waiting.push(number),
            }
        }
        while !self.waiting.is_empty() {
            self.next.clear();
            let mut waiting = &self.waiting[..];
            while !waiting.is_empty() {
                self.eye.clear();
                let asking = waiting.iter().take_while(|&&number| {
                    let is_room = self.eye.len() < TOGETHER;
                    if is_room {
                        self.cases[number].ask(&mut self.eye, band.eye.specks);
                    }
                    is_room
                });
                let (now, later) = waiting.split_at(asking.count());
                waiting = later;
                self.looks.clear();
                band.eye.look(&mut self.eye, &mut self.looks);
                let mut looks = &self.looks[..];
                for &number in now {
                    let case = &mut self.cases[number];
                    let (own, others) = looks.split_at(case.asked());
                    looks = others;
                    match case.go_on(band, own, &mut self.buffers) {
                        Some(outcome) => tell(outcome),
                        None => self.next.push(number),
                    }
                }
            }
            std::mem::swap(&mut self.waiting, &mut self.next);
        }
    }
}

impl Case {
    /// Begins with a pixel; what became of it, or nothing if it waits for samples.
    fn begin(
        &mut self,
        band: &Band<'_>,
        (x, y): (u32, u32),
        task: Task,
        buffers: &mut CaseBuffers,
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
                    // It was found so by comparison with those around it.
                    let (looks, channels) = (band.first_of(at), band.eye.channels);
                    let found = of_all(looks, channels, &Slopes::default(), &mut buffers.grid);
                    let error = found.error.min(band.target.error);
                    return self.outcome(Some(done(&found, error)));
                }
                self.looks.clear();
                self.looks.extend_from_slice(band.looks_of(at));
                self.whole = self.of_half(band, &Slopes::default(), buffers);
                self.estimate(band, &Slopes::default(), buffers);
                if !band.is_finer(at) {
                    // The time is over.
                    return self.outcome(Some(done(&self.found, self.found.error)));
                }
                self.contrast = band.reach_around(x, y).contrast(band.eye.channels);
                self.refine(band, buffers)
            }
        }
    }

    /// Goes on with the samples it waited for; what became of the pixel, or nothing if it waits for more.
    fn go_on(
        &mut self,
        band: &Band<'_>,
        looks: &[AdaptiveSample],
        buffers: &mut CaseBuffers,
    ) -> Option<Outcome> {
        self.taken += count_of(looks);
        match self.step {
            Step::Sloped(slopes) => {
                self.looks.extend_from_slice(looks);
                self.whole = self.of_half(band, &slopes, buffers);
                self.estimate(band, &slopes, buffers);
                let is_enough = self.found.error <= band.target.error * EVEN;
                self.outcome(is_enough.then(|| done(&self.found, self.found.error)))
            }
            Step::Sampled => {
                self.looks.extend_from_slice(looks);
                self.estimate(band, &Slopes::default(), buffers);
                self.refine(band, buffers)
            }
            Step::Divided => {
                let holds = match self.wish {
                    SampleRequest::Places => self.dividing.take_places(looks),
                    SampleRequest::Numbers(_) => {
                        self.looks.extend_from_slice(looks);
                        self.dividing.test(looks)
                    }
                };
                match holds {
                    true => self.divide(band),
                    false => self.is_not_divided(band),
                }
            }
        }
    }

    /// Notes the places that it wants to be looked at.
    fn ask(&self, eye: &mut EyeScratch, specks: &TinyObjects) {
        match &self.wish {
            SampleRequest::Numbers(numbers) => eye.note(self.pixel, numbers.clone(), specks),
            SampleRequest::Places => eye.note_places(self.pixel, &self.dividing.places, specks),
        }
    }

    /// How many these are.
    fn asked(&self) -> usize {
        match &self.wish {
            SampleRequest::Numbers(numbers) => numbers.len(),
            SampleRequest::Places => self.dividing.places.len(),
        }
    }

    /// A pixel at an edge or on a slope, by its first samples.
    fn settle(&mut self, band: &Band<'_>, at: usize, buffers: &mut CaseBuffers) -> Option<Outcome> {
        let (x, y) = self.pixel;
        if band.may_hide(x, y) {
            return self.outcome(None);
        }
        self.looks.clear();
        self.looks.extend_from_slice(band.first_of(at));
        let placed = &mut buffers.placed;
        gather(
            band,
            (self.pixel, &self.looks),
            RING,
            |at| band.first_of(at),
            placed,
        );
        let first = &self.looks[0];
        if placed.iter().all(|(_, look)| look.is_same_side(first)) {
            let mut sums = Sums::default();
            for (place, look) in placed {
                sums.add(*place, &look.channels);
            }
            let slopes = sums.plane().map(|plane| plane.slopes()).unwrap_or_default();
            let (found, _) = first_estimate(band, self.pixel, &slopes);
            if found.error <= band.target.error * EVEN {
                self.step = Step::Sloped(slopes);
                self.wish = SampleRequest::Numbers(band.target.first..2 * band.target.first);
                return None;
            }
        }
        match self.begin_dividing(band, buffers) {
            true => self.divide(band),
            false => self.outcome(None),
        }
    }

    /// What is to be done with all the samples that there are.
    fn refine(&mut self, band: &Band<'_>, buffers: &mut CaseBuffers) -> Option<Outcome> {
        let error = self.found.error.max(self.hidden(UNSEEN));
        let is_last = self.looks.len() >= MOST_SAMPLES || band.target.is_over();
        if error <= band.target.error * EVEN || is_last {
            return self.outcome(Some(done(&self.found, error)));
        }
        // A few samples on lines lower the error far more than many others. What no line divides will not be divided with
        // more samples either.
        if !self.is_tried && self.hidden(HIDDEN) <= band.target.error {
            self.is_tried = true;
            gather(
                band,
                (self.pixel, &self.looks),
                CLOSE,
                |at| band.looks_of(at),
                &mut buffers.placed,
            );
            if self.begin_dividing(band, buffers) {
                return self.divide(band);
            }
        }
        self.is_not_divided(band)
    }

    /// The error that something unseen may make, if a share of the contrast around may hide between the samples.
    fn hidden(&self, share: f64) -> f64 {
        self.contrast * share / f64::from(count_of(&self.looks))
    }

    fn begin_dividing(&mut self, band: &Band<'_>, buffers: &mut CaseBuffers) -> bool {
        self.dividing.begin(
            &buffers.placed,
            band.eye.channels,
            self.settles,
            &mut buffers.dividing,
        )
    }

    /// What is to be done with the lines that are known.
    fn divide(&mut self, band: &Band<'_>) -> Option<Outcome> {
        let target = band.target.error;
        let aim = ErrorGoal {
            best: target * EVEN,
            most: if self.settles { target * EVEN } else { target },
        };
        self.step = Step::Divided;
        match self.dividing.next(band.eye.channels, aim) {
            Next::Nothing => self.is_not_divided(band),
            Next::Places => {
                self.wish = SampleRequest::Places;
                None
            }
            Next::Test => {
                self.wish = SampleRequest::Numbers(band.target.first..2 * band.target.first);
                None
            }
            Next::Found(found) => {
                let hidden = if self.settles {
                    0.0
                } else {
                    self.hidden(HIDDEN)
                };
                self.outcome(Some(done(&found, found.error.max(hidden))))
            }
        }
    }

    /// No lines divide the pixel: it is sampled on if that is needed.
    fn is_not_divided(&mut self, band: &Band<'_>) -> Option<Outcome> {
        if self.settles {
            return self.outcome(None);
        }
        let error = self.found.error.max(self.hidden(UNSEEN));
        if error <= band.target.error {
            return self.outcome(Some(done(&self.found, error)));
        }
        let count = count_of(&self.looks);
        self.step = Step::Sampled;
        self.wish = SampleRequest::Numbers(count..2 * count);
        None
    }

    /// What all samples tell on a surface with these slopes, `whole` being what half of them do.
    fn estimate(&mut self, band: &Band<'_>, slopes: &Slopes, buffers: &mut CaseBuffers) {
        let channels = band.eye.channels;
        let half = self.whole;
        self.whole = of_all(&self.looks, channels, slopes, &mut buffers.grid);
        let found = after_half(self.whole, &half, channels);
        let times = count_of(&self.looks) / band.target.first;
        self.found = Estimate {
            error: found.error * caution(times),
            ..found
        };
    }

    /// What the first half of the samples tells.
    fn of_half(&self, band: &Band<'_>, slopes: &Slopes, buffers: &mut CaseBuffers) -> Estimate {
        let half = &self.looks[..self.looks.len() / 2];
        of_all(half, band.eye.channels, slopes, &mut buffers.grid)
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

/// Whether the first samples of a pixel, and those next to them around it, leave nothing to be asked.
pub(super) fn is_calm(band: &Band<'_>, (x, y): (u32, u32)) -> bool {
    let target = band.target.error;
    let contrast = band.reach_around(x, y).contrast(band.eye.channels);
    // So much is the estimate of the error at most if every two of `n` neighbours differ by the contrast.
    let most = (3.0 * f64::from(band.target.first)).sqrt();
    if contrast <= target * f64::min(EVEN * most, 1.0) {
        return true;
    }
    let (found, is_torn) = first_estimate(band, (x, y), &Slopes::default());
    if is_torn {
        return contrast <= target;
    }
    found.error <= target * EVEN
}

/// What the estimated error of a pixel is multiplied with that has so many times its first samples. Of pixels with few
/// samples those stop whose estimate happens to be low: over all that stopped with 16 it was from 0.9 to 1.9 times the true
/// error, with 32 from 1.5 to 2.1, with 64 and more up to 2.6. So the same error of the picture takes up to an eighth of
/// the samples less.
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
    ((x, y), own): ((u32, u32), &[AdaptiveSample]),
    width: i32,
    looks_of: impl Fn(usize) -> &'a [AdaptiveSample],
    placed: &mut Vec<PlacedSample>,
) {
    placed.clear();
    placed.extend(own.iter().map(|look| (look.share(), *look)));
    for (other_x, other_y) in band.around(x, y).filter(|&other| other != (x, y)) {
        let away = [
            other_x.cast_signed() - x.cast_signed(),
            other_y.cast_signed() - y.cast_signed(),
        ];
        let [across, down] = away.map(|away| near(away, width));
        let from = away.map(f64::from);
        for look in looks_of(band.at(other_x, other_y)) {
            if across.contains(&look.place.0.into()) && down.contains(&look.place.1.into()) {
                let share = look.share();
                placed.push(([from[0] + share[0], from[1] + share[1]], *look));
            }
        }
    }
}

/// Which places of a pixel so many columns or rows away, at most one, lie within `width` of the one that it is seen from.
fn near(away: i32, width: i32) -> Range<i32> {
    let from = away * SIDE;
    (-width - from).clamp(0, SIDE)..(SIDE + width - from).clamp(0, SIDE)
}

fn count_of(looks: &[AdaptiveSample]) -> u32 {
    u32::try_from(looks.len()).unwrap_or(u32::MAX)
}

fn done(found: &Estimate, error: f64) -> FinishedPixel {
    FinishedPixel {
        value: pixel(found.mean),
        error,
    }
}

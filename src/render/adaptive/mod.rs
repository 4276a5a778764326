//! Sampling until the estimated error of every pixel is small (`+AM4`, `--error`, `--time`).
//!
//! Every pixel is the mean over its square, as POV-Ray's are (a box filter), of the points of a scrambled Sobol sequence
//! of its own. Where edges run the error falls like `samples^-0.75`, on smooth surfaces like `samples^-1.5`. What a pixel
//! gets depends on itself and on the few around it alone, so that pictures are the same for any number of threads and
//! for any part of them.
//!
//! With a time the picture is drawn again and again for ever smaller errors, the worst bands first, and every pixel
//! keeps the best that it had when the time is over.

mod band;
mod coverage;
mod edge;
mod edge_fit;
mod estimate;
mod finish;
mod neighbors;
mod sample;
mod slope;
mod strip;
#[cfg(test)]
mod tests;
mod tiny_objects;
mod triple_edge;
mod two_class;

use super::{Checkpoint, CheckpointTile, Drawn};
use crate::base::film::Film;
use crate::base::options::{Adaptive, AdaptiveOutcome, RenderOptions};
use crate::render::shade::Tracer;
use crate::world::RayCounts;
use band::{Band, ErrorTarget, FinishedPixel, MARGIN};
use sample::Eye;
use std::ops::Range;
use std::time::Instant;
use tiny_objects::TinyObjects;

/// So many pixels are sampled together at most: their samples take 100 to 300 bytes each.
const BAND_PIXELS: u32 = 1 << 18;
/// Rows of a band of a picture that is gone on with: what is lost by an interruption.
const ROWS_KEPT: u32 = 64;
/// Rows of a band where there is a time limit: what is begun is mostly finished.
const ROWS_IN_TIME: u32 = 32;
/// The error of the first drawing where there is a time limit, and by how much it falls from one to the next.
const FIRST_ERROR: f64 = 16.0;
const FALL: f64 = 0.25;
/// A smaller error is not aimed at: single precision of colours ends here.
const LEAST_ERROR: f64 = 1e-4;
const STEPS: f64 = 255.0;

/// Draws what is to be drawn.
pub(super) fn draw(
    tracer: &Tracer<'_>,
    options: &RenderOptions,
    how: &Adaptive,
    unfinished: Option<&Checkpoint>,
    progress: &(dyn Fn(u64) + Sync),
) -> Drawn {
    let deadline = how.time.and_then(|time| Instant::now().checked_add(time));
    let error = how.error.max(LEAST_ERROR);
    let specks = TinyObjects::of(
        tracer.world(),
        (options.width, options.height),
        error / STEPS,
    );
    let eye = Eye {
        tracer,
        size: (options.width, options.height),
        channels: if options.alpha { 4 } else { 3 },
        specks: &specks,
    };
    let mut drawing = Drawing {
        eye,
        columns: options.columns.clone(),
        rows: options.rows.clone(),
        film: Film::new(
            options.width,
            options.height,
            options.columns.clone(),
            options.rows.clone(),
        ),
        errors: vec![f64::INFINITY; options.columns.len() * options.rows.len()],
        samples: 0,
        rays: RayCounts::default(),
    };
    match deadline {
        None => {
            let target = ErrorTarget::new(error / STEPS, None);
            let mut missing = vec![drawing.rows.clone()];
            for piece in unfinished.map_or(&[][..], Checkpoint::pieces) {
                if drawing.take(piece) {
                    progress(piece.pixels.len() as u64);
                    missing = without(&missing, &piece.rows);
                }
            }
            let continues = options.keep.as_ref().is_some_and(|keep| keep.continues);
            let height = match continues {
                true => drawing.rows_together().min(ROWS_KEPT),
                false => drawing.rows_together(),
            };
            for rows in missing.iter().flat_map(|rows| bands(rows, height)) {
                drawing.draw(&rows, target, progress);
                if let Some(unfinished) = unfinished.filter(|_| !options.stop.is_asked()) {
                    unfinished.keep(&drawing.piece(&rows));
                }
            }
        }
        Some(deadline) => drawing.draw_in_time(error, deadline, progress),
    }
    let reached = Some(drawing.reached(how.error));
    Drawn {
        film: drawing.film,
        rays: drawing.rays,
        reached,
        radiosity: None,
        photons: None,
    }
}

/// A picture that is being drawn.
struct Drawing<'a> {
    eye: Eye<'a>,
    columns: Range<u32>,
    rows: Range<u32>,
    film: Film,
    /// The estimated errors of the pixels drawn, row by row.
    errors: Vec<f64>,
    samples: u64,
    rays: RayCounts,
}

impl Drawing<'_> {
    fn rows_together(&self) -> u32 {
        let width = u32::try_from(self.columns.len()).unwrap_or(u32::MAX);
        (BAND_PIXELS / width.max(1)).max(MARGIN)
    }

    /// What has been drawn of some rows, to be kept.
    fn piece(&self, rows: &Range<u32>) -> CheckpointTile {
        let (wide, width) = (self.columns.len(), self.eye.size.0 as usize);
        let first = (rows.start - self.rows.start) as usize * wide;
        let columns = self.columns.start as usize..self.columns.end as usize;
        let lines = rows.clone().map(|y| y as usize * width);
        CheckpointTile {
            columns: self.columns.clone(),
            rows: rows.clone(),
            pixels: lines
                .flat_map(|line| &self.film.pixels[line + columns.start..line + columns.end])
                .copied()
                .collect(),
            errors: self.errors[first..first + rows.len() * wide].to_vec(),
            samples: self.samples,
        }
    }

    /// Takes what an earlier run has drawn, if it is all of some rows.
    fn take(&mut self, piece: &CheckpointTile) -> bool {
        let wide = self.columns.len();
        let count = wide * piece.rows.len();
        let is_whole = piece.columns == self.columns
            && self.rows.start <= piece.rows.start
            && piece.rows.end <= self.rows.end
            && (piece.pixels.len(), piece.errors.len()) == (count, count);
        if !is_whole {
            return false;
        }
        let first = (piece.rows.start - self.rows.start) as usize * wide;
        self.errors[first..first + count].copy_from_slice(&piece.errors);
        for (y, line) in piece.rows.clone().zip(piece.pixels.chunks(wide.max(1))) {
            let at = y as usize * self.eye.size.0 as usize + self.columns.start as usize;
            self.film.pixels[at..at + wide].copy_from_slice(line);
        }
        // Every piece tells of all samples up to its own.
        self.samples = self.samples.max(piece.samples);
        true
    }

    /// Draws for smaller and smaller errors until the time is over.
    fn draw_in_time(&mut self, error: f64, deadline: Instant, progress: &(dyn Fn(u64) + Sync)) {
        let mut aim = FIRST_ERROR.max(error);
        // The first drawing is finished whatever it takes: there must be a picture.
        for rows in bands(&self.rows, self.rows_together()) {
            self.draw(&rows, ErrorTarget::new(aim / STEPS, None), progress);
        }
        while aim > error && Instant::now() < deadline {
            aim = (aim * FALL).max(error);
            let target = ErrorTarget::new(aim / STEPS, Some(deadline));
            let mut bands = bands(&self.rows, ROWS_IN_TIME);
            bands.sort_by(|a, b| self.error_of(b).total_cmp(&self.error_of(a)));
            for rows in bands {
                if Instant::now() >= deadline {
                    return;
                }
                self.draw(&rows, target, &|_| {});
            }
        }
    }

    /// The sum of the squared errors of some rows.
    fn error_of(&self, rows: &Range<u32>) -> f64 {
        let width = self.columns.len();
        let start = (rows.start - self.rows.start) as usize * width;
        let errors = &self.errors[start..start + rows.len() * width];
        errors.iter().map(|error| error * error).sum()
    }

    /// Draws some rows; a pixel that was better before stays if the time ends meanwhile.
    fn draw(&mut self, rows: &Range<u32>, target: ErrorTarget, progress: &(dyn Fn(u64) + Sync)) {
        let with_margin = |range: &Range<u32>, side: u32| {
            range.start.saturating_sub(MARGIN)..(range.end + MARGIN).min(side)
        };
        let (width, height) = self.eye.size;
        let columns = with_margin(&self.columns, width);
        let mut band = Band::new(&self.eye, target, columns, with_margin(rows, height));
        let done: Vec<FinishedPixel> = band.finish(&self.columns, rows, progress);
        // To keep the lower of two estimates would be to keep those that are too low.
        let is_whole = !target.is_over();
        self.samples += band.samples;
        self.rays += band.rays;
        let wide = self.columns.len();
        for (row, y) in done.chunks(wide.max(1)).zip(rows.clone()) {
            let errors = (y - self.rows.start) as usize * wide;
            let pixels = y as usize * width as usize + self.columns.start as usize;
            for (i, done) in row.iter().enumerate() {
                if is_whole || done.error < self.errors[errors + i] {
                    self.errors[errors + i] = done.error;
                    self.film.pixels[pixels + i] = done.value;
                }
            }
        }
    }

    fn reached(&self, target: f64) -> AdaptiveOutcome {
        let largest = self.errors.iter().copied().fold(0.0, f64::max);
        let squares: f64 = self.errors.iter().map(|error| error * error).sum();
        #[allow(clippy::cast_precision_loss, reason = "pixels are fewer than 2^52")]
        let pixels = self.errors.len().max(1) as f64;
        AdaptiveOutcome {
            target,
            largest: largest * STEPS,
            rms: (squares / pixels).sqrt() * STEPS,
            samples: self.samples,
        }
    }
}

/// Rows in bands of some height, from the top.
fn bands(rows: &Range<u32>, height: u32) -> Vec<Range<u32>> {
    let end = rows.end;
    rows.clone()
        .step_by(height as usize)
        .map(|top| top..(top + height).min(end))
        .collect()
}

/// What is left of some ranges of rows without others.
fn without(ranges: &[Range<u32>], taken: &Range<u32>) -> Vec<Range<u32>> {
    let parts = ranges.iter().flat_map(|rows| {
        [
            rows.start..rows.end.min(taken.start).max(rows.start),
            rows.start.max(taken.end).min(rows.end)..rows.end,
        ]
    });
    parts.filter(|part| !part.is_empty()).collect()
}

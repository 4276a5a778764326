//! Adaptive sampling until the estimated error of every pixel is small (`+AM4`, `--error`, `--time`).
//!
//! Each pixel is box-filtered, as in POV-Ray: the mean of samples at the points of its own scrambled Sobol sequence. The
//! error falls like `samples^-0.75` where edges run, and like `samples^-1.5` on smooth surfaces. The
//! samples of a pixel depend only on itself and on a few pixels around it, so that pictures are the same for any number
//! of threads and for any crop.
//!
//! With a time limit the picture is rendered again and again for smaller errors, the worst bands first. When time is
//! up, every pixel holds its value of the last completed pass over its band; in the band where time ran out, the value
//! with the lower error.

mod band;
mod coverage;
mod edge;
mod edge_fit;
mod estimate;
mod finish;
mod neighbours;
mod pixels;
mod rectangles;
mod sample;
mod slope;
mod strip;
#[cfg(test)]
mod tests;
mod tiny_objects;
mod triple_edge;
mod two_class;

use super::checkpoint::{Checkpoint, CheckpointTile};
use super::tiles::Drawn;
use crate::base::film::{Film, Pixel};
use crate::base::options::{Adaptive, AdaptiveOutcome, Event, EventHandler, RenderOptions};
use crate::render::shade::Tracer;
use crate::world::RayCounts;
use band::MARGIN;
use pixels::{Band, ErrorTarget, FinishedPixel};
use rectangles::TinyObjects;
use sample::PixelSampler;
use std::ops::Range;
use std::time::Instant;

/// Upper limit of the pixels sampled together: their samples take 100 to 300 bytes each.
const BAND_PIXELS: u32 = 1 << 18;
/// Rows of a band of a picture with a checkpoint: an interruption loses at most this.
const ROWS_WITH_CHECKPOINT: u32 = 64;
/// Rows of a band with a time limit: most bands that begin are finished.
const ROWS_IN_TIME: u32 = 32;
/// Error of the first pass with a time limit.
const FIRST_ERROR: f64 = 16.0;
/// Ratio of the errors of a pass and the one before.
const ERROR_FACTOR: f64 = 0.25;
/// Smallest error aimed for: single precision of colours ends here.
const MIN_ERROR: f64 = 1e-4;
/// Steps of a channel from black to white: the unit of errors.
const LEVELS: f64 = 255.0;

/// Renders the requested pixels.
pub(super) fn draw(
    tracer: &Tracer<'_>,
    options: &RenderOptions,
    settings: &Adaptive,
    checkpoint: Option<&Checkpoint>,
    listen: &EventHandler<'_>,
) -> Drawn {
    let progress = &|pixels| listen(Event::Drawn(pixels));
    let deadline = settings
        .time
        .and_then(|time| Instant::now().checked_add(time));
    let error = settings.error.max(MIN_ERROR);
    let tiny_objects = TinyObjects::of(
        tracer.world(),
        (options.width, options.height),
        error / LEVELS,
    );
    let sampler = PixelSampler {
        tracer,
        size: (options.width, options.height),
        channels: if options.alpha { 4 } else { 3 },
        tiny_objects: &tiny_objects,
    };
    let mut drawing = Drawing {
        sampler,
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
            let target = ErrorTarget::new(error / LEVELS, None);
            let mut missing = vec![drawing.rows.clone()];
            for tile in checkpoint.map_or(&[][..], Checkpoint::tiles) {
                if drawing.take(tile) {
                    progress(tile.pixels.len() as u64);
                    missing = without(&missing, &tile.rows);
                }
            }
            let continues = options.checkpoint.as_ref().is_some_and(|keep| keep.resume);
            let height = match continues {
                true => drawing.rows_together().min(ROWS_WITH_CHECKPOINT),
                false => drawing.rows_together(),
            };
            for rows in missing.iter().flat_map(|rows| bands(rows, height)) {
                drawing.draw(&rows, target, progress);
                drawing.report(&rows, listen);
                if let Some(checkpoint) = checkpoint.filter(|_| !options.stop.is_cancelled()) {
                    checkpoint.keep(&drawing.tile(&rows));
                }
            }
        }
        Some(deadline) => drawing.draw_in_time(error, deadline, listen),
    }
    let reached = Some(drawing.reached(settings.error));
    Drawn {
        film: drawing.film,
        rays: drawing.rays,
        reached,
        radiosity: None,
        photons: None,
    }
}

/// A picture in progress.
struct Drawing<'a> {
    sampler: PixelSampler<'a>,
    columns: Range<u32>,
    rows: Range<u32>,
    film: Film,
    /// Estimated errors of the pixels, row by row.
    errors: Vec<f64>,
    samples: u64,
    rays: RayCounts,
}

impl Drawing<'_> {
    fn rows_together(&self) -> u32 {
        let width = u32::try_from(self.columns.len()).unwrap_or(u32::MAX);
        (BAND_PIXELS / width.max(1)).max(MARGIN)
    }

    /// Sends the pixels of some rows.
    fn report(&self, rows: &Range<u32>, listen: &EventHandler<'_>) {
        listen(Event::Tile {
            columns: &self.columns,
            rows,
            pixels: &self.pixels_of(rows),
        });
    }

    /// The pixels of some rows.
    fn pixels_of(&self, rows: &Range<u32>) -> Vec<Pixel> {
        let width = self.sampler.size.0 as usize;
        let columns = self.columns.start as usize..self.columns.end as usize;
        rows.clone()
            .map(|y| y as usize * width)
            .flat_map(|line| &self.film.pixels[line + columns.start..line + columns.end])
            .copied()
            .collect()
    }

    /// The finished pixels of some rows, for the checkpoint.
    fn tile(&self, rows: &Range<u32>) -> CheckpointTile {
        let wide = self.columns.len();
        let first = (rows.start - self.rows.start) as usize * wide;
        CheckpointTile {
            columns: self.columns.clone(),
            rows: rows.clone(),
            pixels: self.pixels_of(rows),
            errors: self.errors[first..first + rows.len() * wide].to_vec(),
            samples: self.samples,
        }
    }

    /// Takes over a tile of an earlier run, if it consists of whole rows.
    fn take(&mut self, tile: &CheckpointTile) -> bool {
        let wide = self.columns.len();
        let count = wide * tile.rows.len();
        let is_whole = tile.columns == self.columns
            && self.rows.start <= tile.rows.start
            && tile.rows.end <= self.rows.end
            && (tile.pixels.len(), tile.errors.len()) == (count, count);
        if !is_whole {
            return false;
        }
        let first = (tile.rows.start - self.rows.start) as usize * wide;
        self.errors[first..first + count].copy_from_slice(&tile.errors);
        for (y, line) in tile.rows.clone().zip(tile.pixels.chunks(wide.max(1))) {
            let at = y as usize * self.sampler.size.0 as usize + self.columns.start as usize;
            self.film.pixels[at..at + wide].copy_from_slice(line);
        }
        // The sample count of a tile includes all tiles before it.
        self.samples = self.samples.max(tile.samples);
        true
    }

    /// Renders for smaller and smaller errors until the time is over.
    fn draw_in_time(&mut self, error: f64, deadline: Instant, listen: &EventHandler<'_>) {
        let progress = &|pixels| listen(Event::Drawn(pixels));
        let mut goal = FIRST_ERROR.max(error);
        // The first pass is finished regardless of the time: there must be a picture.
        for rows in bands(&self.rows, self.rows_together()) {
            self.draw(&rows, ErrorTarget::new(goal / LEVELS, None), progress);
            self.report(&rows, listen);
        }
        while goal > error && Instant::now() < deadline {
            goal = (goal * ERROR_FACTOR).max(error);
            let target = ErrorTarget::new(goal / LEVELS, Some(deadline));
            let mut bands = bands(&self.rows, ROWS_IN_TIME);
            bands.sort_by(|a, b| self.error_of(b).total_cmp(&self.error_of(a)));
            for rows in bands {
                if Instant::now() >= deadline {
                    return;
                }
                self.draw(&rows, target, &|_| {});
                self.report(&rows, listen);
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

    /// Renders some rows; a pixel that was better before stays if the time ends meanwhile.
    fn draw(&mut self, rows: &Range<u32>, target: ErrorTarget, progress: &(dyn Fn(u64) + Sync)) {
        let with_margin = |range: &Range<u32>, side: u32| {
            range.start.saturating_sub(MARGIN)..(range.end + MARGIN).min(side)
        };
        let (width, height) = self.sampler.size;
        let columns = with_margin(&self.columns, width);
        let mut band = Band::new(&self.sampler, target, columns, with_margin(rows, height));
        let done: Vec<FinishedPixel> = band.finish(&self.columns, rows, progress);
        // Always retaining the lower of two estimates would select those that are too low.
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
            largest: largest * LEVELS,
            rms: (squares / pixels).sqrt() * LEVELS,
            samples: self.samples,
        }
    }
}

/// Splits rows into bands of this height, from the top.
fn bands(rows: &Range<u32>, height: u32) -> Vec<Range<u32>> {
    let end = rows.end;
    rows.clone()
        .step_by(height as usize)
        .map(|top| top..(top + height).min(end))
        .collect()
}

/// Removes a range of rows from some ranges.
fn without(ranges: &[Range<u32>], taken: &Range<u32>) -> Vec<Range<u32>> {
    let parts = ranges.iter().flat_map(|rows| {
        [
            rows.start..rows.end.min(taken.start).max(rows.start),
            rows.start.max(taken.end).min(rows.end)..rows.end,
        ]
    });
    parts.filter(|part| !part.is_empty()).collect()
}

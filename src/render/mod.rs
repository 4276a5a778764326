//! Rendering of a world to a film, in tiles over all cores.

mod adaptive;
mod antialias;
mod checkpoint;
pub mod cost;
mod first_call;
mod photon_pass;
pub mod photons;
mod pretrace;
pub mod radiosity;
mod radiosity_pass;
pub mod shade;
pub mod statistics;
mod tile_cache;
mod tiles;

use crate::base::film;
use crate::base::film::{Pixel, Quantizer};
use crate::base::options::{Event, EventHandler, RenderOptions, Sampling};
use crate::world::{RayCounts, World};
use antialias::Sampler;
use checkpoint::CheckpointTile;
pub use checkpoint::{Checkpoint, CheckpointStatus};
pub use photon_pass::PhotonPass;
use radiosity_pass::RadiosityPass;
use shade::{BLOCK, BlockScratch, Sample, Tracer};
use std::ops::Range;
pub use tile_cache::TileCache;
pub use tiles::Drawn;
use tiles::{
    Canvas, DrawnTile, MIN_AT_ONCE, Pixels, TILE, TILES_OF_THREAD, Tile, TilePixels, tile_side,
    tiles_of,
};

/// The parts of a picture that are there already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Earlier<'a> {
    /// Those of an earlier run.
    pub checkpoint: Option<&'a Checkpoint>,
    /// Those of an earlier picture of this world. The tiles of this picture are added.
    pub tiles: Option<&'a TileCache>,
}

/// Renders the world. `listen` receives the finished pixels, from any thread. The picture is the same for any number of
/// threads, unless there is a time limit, and the same if a part of it is there `earlier`.
#[must_use]
pub fn render(
    world: &World,
    options: &RenderOptions,
    earlier: Earlier<'_>,
    listen: &EventHandler<'_>,
) -> Drawn {
    let checkpoint = earlier.checkpoint;
    if world.radiosity.is_some() && rayon::current_thread_index().is_none() {
        // Short parallel sections are started from one of the worker threads.
        return rayon::scope(|_| render(world, options, earlier, listen));
    }
    let progress = &|pixels| listen(Event::Drawn(pixels));
    let tracer = Tracer::new(world, options.quality).with_cancel_token(&options.stop);
    let (tracer, photons) = photon_pass::with_photons(tracer);
    if photons.as_ref().is_some_and(|photons| !photons.is_complete) {
        let Canvas { film, rays } = Canvas::new(options, None, RayCounts::default());
        return Drawn {
            film,
            rays,
            reached: None,
            radiosity: None,
            photons,
        };
    }
    first_call::find(&tracer, options);
    let mut radiosity_pass = RadiosityPass::pretraced(&tracer, options);
    if let Sampling::Adaptive(settings) = &options.sampling {
        let (tracer, radiosity) = match radiosity_pass {
            None => (tracer, None),
            Some(radiosity_pass) => radiosity_pass.given_to(tracer),
        };
        let drawn = adaptive::draw(&tracer, options, settings, checkpoint, listen);
        return Drawn {
            radiosity,
            photons,
            ..drawn
        };
    }
    let mut in_order = world
        .draws_in_order(options)
        .then(|| sequential_scratch(world));
    // A tile of an earlier run does not record the radiosity samples it added, nor the random numbers it consumed.
    let are_alone = radiosity_pass.is_none() && in_order.is_none();
    let checkpoint = checkpoint.filter(|_| are_alone);
    let cached = earlier
        .tiles
        .filter(|_| are_alone && photons.is_none() && world.subsurface.is_none());
    let gathers = radiosity_pass.is_some();
    let tiles = match in_order {
        Some(_) => tiles_of(&with_all_before(options), TILE),
        None => tiles_of(options, if are_alone { tile_side(options) } else { TILE }),
    };
    let quantizer = options.target_format.as_ref().and_then(Quantizer::of_tiles);
    let renderer = TileRenderer::new(&tracer, options);
    let draw = |scratch: &mut BlockScratch, tile: &Tile| {
        let (tile, (pixels, rays)) = match (checkpoint, cached) {
            (Some(checkpoint), _) => renderer.checkpointed_tile(checkpoint, tile, scratch),
            (None, Some(cached)) => renderer.cached_tile(cached, tile, scratch),
            (None, None) => renderer.tile(tile, scratch),
        };
        if !gathers {
            progress(pixels.len() as u64);
        }
        let pixels = match &quantizer {
            Some(quantizer) => TilePixels::Levels(quantizer.levels(&pixels)),
            None => TilePixels::Light(pixels),
        };
        let drawn = DrawnTile { tile, pixels, rays };
        drawn.report(listen);
        drawn
    };
    let rays = radiosity_pass
        .as_ref()
        .map(|radiosity_pass| radiosity_pass.rays);
    let mut canvas = Canvas::new(options, quantizer.as_ref(), rays.unwrap_or_default());
    match (&mut radiosity_pass, &mut in_order) {
        (None, None) => canvas = canvas.draw_all(&tiles, draw),
        (None, Some(scratch)) => {
            let drawn = tiles.iter().map(|tile| draw(scratch, tile));
            drawn.for_each(|drawn| canvas.take(drawn));
        }
        (Some(radiosity_pass), _) => {
            let at_once = MIN_AT_ONCE.max(TILES_OF_THREAD * rayon::current_num_threads());
            for some in tiles.chunks(at_once) {
                let drawn = radiosity_pass.draw(some, &draw, progress);
                drawn.into_iter().for_each(|drawn| canvas.take(drawn));
            }
        }
    }
    let Canvas { film, rays } = canvas;
    Drawn {
        film,
        rays,
        reached: None,
        radiosity: radiosity_pass.map(RadiosityPass::taken),
        photons,
    }
}

/// Scratch memory for rendering in order, with one continuing stream of random numbers.
fn sequential_scratch(world: &World) -> BlockScratch {
    let mut scratch = BlockScratch::default();
    scratch.single().begin_order(world);
    scratch
}

/// Options for all tiles up to the requested ones, so that these get the same random numbers as in the whole picture.
fn with_all_before(options: &RenderOptions) -> RenderOptions {
    RenderOptions {
        columns: 0..options.width,
        rows: 0..options.rows.end,
        ..options.clone()
    }
}

/// Renders the tiles of one picture.
struct TileRenderer<'a> {
    tracer: &'a Tracer<'a>,
    options: &'a RenderOptions,
    /// POV-Ray's antialiasing, if it is on.
    sampler: Option<Sampler<'a>>,
}

impl<'a> TileRenderer<'a> {
    fn new(tracer: &'a Tracer<'a>, options: &'a RenderOptions) -> Self {
        let sampler = match &options.sampling {
            Sampling::PovRay(settings) => Some(Sampler::new(tracer, options, settings)),
            Sampling::Centres | Sampling::Adaptive(_) => None,
        };
        TileRenderer {
            tracer,
            options,
            sampler,
        }
    }

    /// A tile of a picture with a checkpoint: taken from it, or rendered and added to it.
    fn checkpointed_tile(
        &self,
        checkpoint: &Checkpoint,
        tile: &Tile,
        scratch: &mut BlockScratch,
    ) -> (Tile, Pixels) {
        let wanted = wanted(tile, self.options);
        if let Some(stored) = checkpoint.tile(&wanted.columns, &wanted.rows) {
            return (wanted, (stored.pixels.clone(), RayCounts::default()));
        }
        let (tile, (pixels, rays)) = self.tile(tile, scratch);
        let rendered = CheckpointTile {
            columns: tile.columns.clone(),
            rows: tile.rows.clone(),
            pixels,
            errors: Vec::new(),
            samples: 0,
        };
        // A tile that was interrupted is not finished.
        if !self.options.stop.is_cancelled() {
            checkpoint.keep(&rendered);
        }
        (tile, (rendered.pixels, rays))
    }

    /// A tile of a picture with a cache: taken from that, or rendered and added to it.
    fn cached_tile(
        &self,
        cache: &TileCache,
        tile: &Tile,
        scratch: &mut BlockScratch,
    ) -> (Tile, Pixels) {
        let wanted = wanted(tile, self.options);
        if let Some(known) = cache.tile(&wanted) {
            return (wanted, known.pixels.clone());
        }
        scratch.single().query.hit_leaves = Some(Box::default());
        let (wanted, pixels) = self.tile(tile, scratch);
        let hit_leaves = scratch.single().query.hit_leaves.take();
        if let Some(hit_leaves) = hit_leaves
            && !self.options.stop.is_cancelled()
        {
            cache.add(&wanted, pixels.clone(), hit_leaves.into_sorted());
        }
        (wanted, pixels)
    }

    /// The requested pixels of a tile, row by row.
    fn tile(&self, tile: &Tile, scratch: &mut BlockScratch) -> (Tile, Pixels) {
        let (tracer, options) = (self.tracer, self.options);
        let wanted = wanted(tile, options);
        let pixels = if let Some(sampler) = &self.sampler {
            let whole = sampler.tile(tile, scratch);
            (cut_out(whole, tile, &wanted), scratch.take_rays())
        } else if scratch.continues_random() {
            let (whole, rays) = draw_rows(tracer, tile, options, scratch);
            (cut_out(whole, tile, &wanted), rays)
        } else if scratch.single().order_dependent() {
            draw_rows(tracer, &wanted, options, scratch)
        } else {
            draw_blocks(tracer, &wanted, options, scratch)
        };
        (wanted, pixels)
    }
}

/// The requested part of a tile.
fn wanted(tile: &Tile, options: &RenderOptions) -> Tile {
    Tile {
        columns: shared(&tile.columns, &options.columns),
        rows: shared(&tile.rows, &options.rows),
    }
}

/// The pixels of a part of a tile.
fn cut_out(whole: Vec<Pixel>, tile: &Tile, wanted: &Tile) -> Vec<Pixel> {
    if wanted == tile {
        return whole;
    }
    if wanted.columns.is_empty() {
        return Vec::new();
    }
    let rows = whole.chunks(tile.columns.len()).zip(tile.rows.clone());
    let skipped = (wanted.columns.start - tile.columns.start) as usize;
    rows.filter(|(_, y)| wanted.rows.contains(y))
        .flat_map(|(row, _)| &row[skipped..skipped + wanted.columns.len()])
        .copied()
        .collect()
}

/// Renders a rectangle in blocks, row by row, without antialiasing.
fn draw_blocks(
    tracer: &Tracer<'_>,
    wanted: &Tile,
    options: &RenderOptions,
    scratch: &mut BlockScratch,
) -> Pixels {
    let blocks = |range: &Range<u32>| {
        let end = range.end;
        range
            .clone()
            .step_by(BLOCK as usize)
            .map(move |start| start..(start + BLOCK).min(end))
    };
    let width = wanted.columns.len();
    let mut pixels = vec![Pixel::default(); width * wanted.rows.len()];
    for rows in blocks(&wanted.rows) {
        for columns in blocks(&wanted.columns) {
            let size = (options.width, options.height);
            let above = (rows.start - wanted.rows.start) as usize;
            let first = above * width + (columns.start - wanted.columns.start) as usize;
            let pixels = &mut pixels[first..];
            tracer.block(&columns, &rows, size, scratch, |[right, down], sample| {
                let Sample { rgb, transmit } = sample;
                pixels[usize::from(down) * width + usize::from(right)] = Pixel { rgb, transmit };
            });
        }
    }
    film::sanitize_all(&mut pixels);
    (pixels, scratch.take_rays())
}

/// Renders a rectangle pixel by pixel, in POV-Ray's order.
fn draw_rows(
    tracer: &Tracer<'_>,
    wanted: &Tile,
    options: &RenderOptions,
    scratch: &mut BlockScratch,
) -> Pixels {
    let size = (options.width, options.height);
    let row = |y| {
        wanted
            .columns
            .clone()
            .map(move |x| (f64::from(x), f64::from(y)))
    };
    let positions: Vec<_> = wanted.rows.clone().flat_map(row).collect();
    let mut pixels = Vec::with_capacity(positions.len());
    tracer.sample_in_order(&positions, size, scratch, |_, Sample { rgb, transmit }| {
        pixels.push(Pixel::new(rgb, transmit));
    });
    (pixels, scratch.take_rays())
}

/// The intersection of two ranges; an empty one if they are disjoint.
fn shared(a: &Range<u32>, b: &Range<u32>) -> Range<u32> {
    let start = a.start.max(b.start);
    start..a.end.min(b.end).max(start)
}

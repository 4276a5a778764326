//! Rendering with radiosity on several threads, with the same picture as on a single thread.
//!
//! Samples that are made while the picture is rendered change all that comes after them. They are few. So tiles are
//! rendered in parallel with the samples that exist, and all points with a radiosity query are recorded. Then the tiles
//! are revised in order: where samples were missing, or a newer one counts at a recorded point, the tile is rendered
//! again and the missing samples are made; all other tiles stand.

use super::pretrace::pretrace;
use super::tiles::DrawnTile;
use super::tiles::Tile;
use crate::base::options::{RadiosityStatistics, RenderOptions};
use crate::render::radiosity::{Mode, Notes, Session};
use crate::render::shade::{BlockScratch, Tracer};
use crate::world::RayCounts;
use rayon::prelude::*;
use std::time::Instant;

/// The radiosity samples of a picture in progress.
pub(super) struct RadiosityPass {
    scratch: BlockScratch,
    /// Rays traced in the pretrace.
    pub(super) rays: RayCounts,
    taken: RadiosityStatistics,
}

impl RadiosityPass {
    /// Runs the pretrace; `None` without radiosity.
    pub(super) fn pretraced(tracer: &Tracer<'_>, options: &RenderOptions) -> Option<RadiosityPass> {
        let world = tracer.world();
        let radiosity = tracer.radiosity()?;
        let start = Instant::now();
        let mut scratch = BlockScratch::default();
        let session = Session::new(radiosity, world.globals.unit);
        scratch.single().radiosity = Some(Box::new(session));
        let in_order = world.draws_in_order(options);
        if in_order {
            scratch.single().begin_order(world);
        }
        pretrace(tracer, options, scratch.single());
        if in_order {
            scratch.single().begin_order(world);
        }
        let rays = scratch.take_rays();
        let mut pretraced = 0;
        if let Some(session) = &mut scratch.single().radiosity {
            session.finish();
            pretraced = session.cache.samples().len();
        }
        let taken = RadiosityStatistics {
            pretraced,
            pretrace_seconds: start.elapsed().as_secs_f64(),
            ..RadiosityStatistics::default()
        };
        Some(RadiosityPass {
            scratch,
            rays,
            taken,
        })
    }

    /// Renders the next tiles, in order.
    pub(super) fn draw(
        &mut self,
        tiles: &[Tile],
        draw: &(impl Fn(&mut BlockScratch, &Tile) -> DrawnTile + Sync),
        progress: &(dyn Fn(u64) + Sync),
    ) -> Vec<DrawnTile> {
        let finished = |drawn: DrawnTile| {
            progress((drawn.tile.columns.len() * drawn.tile.rows.len()) as u64);
            drawn
        };
        let in_turn = rayon::current_num_threads() == 1 || self.scratch.continues_random();
        let Some(session) = &self.scratch.single().radiosity else {
            return Vec::new();
        };
        if in_turn {
            let each = tiles
                .iter()
                .map(|tile| finished(draw(&mut self.scratch, tile)));
            return each.collect();
        }
        let watcher = || {
            let mut scratch = BlockScratch::default();
            scratch.single().radiosity = Some(Box::new(session.in_mode(Mode::Record)));
            scratch
        };
        let watched: Vec<(DrawnTile, Notes)> = tiles
            .par_iter()
            .map_init(watcher, |scratch, tile| {
                let drawn = draw(scratch, tile);
                let session = scratch.single().radiosity.as_mut();
                (
                    drawn,
                    session
                        .map(|session| session.notes.take())
                        .unwrap_or_default(),
                )
            })
            .collect();
        let revised = watched
            .into_iter()
            .zip(tiles)
            .map(|((drawn, notes), tile)| {
                finished(self.revised(drawn, notes, |scratch| draw(scratch, tile)))
            });
        revised.collect()
    }

    /// Renders a tile again if samples have come or are missing since it was rendered.
    fn revised(
        &mut self,
        drawn: DrawnTile,
        mut notes: Notes,
        draw: impl Fn(&mut BlockScratch) -> DrawnTile,
    ) -> DrawnTile {
        let Some(session) = &mut self.scratch.single().radiosity else {
            return drawn;
        };
        if notes.are_valid(&session.cache) {
            return drawn;
        }
        notes.catch_up(&session.cache);
        session.notes = notes;
        let mut revised = draw(&mut self.scratch);
        if let Some(session) = &mut self.scratch.single().radiosity {
            session.notes = Notes::default();
        }
        self.taken.revised += 1;
        revised.rays += drawn.rays;
        revised
    }

    /// The tracer with these samples, and their statistics.
    pub(super) fn given_to(
        mut self,
        tracer: Tracer<'_>,
    ) -> (Tracer<'_>, Option<RadiosityStatistics>) {
        let tracer = match &self.scratch.single().radiosity {
            Some(session) => tracer.with_irradiance_cache(session),
            None => tracer,
        };
        (tracer, Some(self.taken()))
    }

    /// The statistics of the samples.
    pub(super) fn taken(mut self) -> RadiosityStatistics {
        if let Some(session) = &self.scratch.single().radiosity {
            self.taken.samples = session.cache.samples().len();
            self.taken.bytes = session.cache.bytes();
        }
        self.taken
    }
}

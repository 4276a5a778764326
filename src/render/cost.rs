//! The cost of each pixel of a picture without antialiasing.

use super::photon_pass;
use super::radiosity_pass::RadiosityPass;
use super::shade::{BlockScratch, Tracer};
use crate::base::options::RenderOptions;
use crate::world::World;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// The cost of the ray through the centre of a pixel, and of all rays that follow from it.
#[derive(Clone, Copy, Debug, Default)]
pub struct PixelCost {
    /// Number of rays.
    pub rays: u64,
    /// The time to trace them.
    pub time: Duration,
}

/// Traces each pixel of the whole picture by itself, and returns their costs row by row; zeros after a cancellation.
#[must_use]
pub fn costs(world: &World, options: &RenderOptions) -> Vec<PixelCost> {
    if world.radiosity.is_some() && rayon::current_thread_index().is_none() {
        return rayon::scope(|_| costs(world, options));
    }
    let tracer = Tracer::new(world, options.quality).with_cancel_token(&options.stop);
    let (tracer, _) = photon_pass::with_photons(tracer);
    let tracer = match RadiosityPass::pretraced(&tracer, options) {
        None => tracer,
        Some(pass) => pass.given_to(tracer).0,
    };
    let (width, height) = (options.width, options.height);
    let mut costs = vec![PixelCost::default(); width as usize * height as usize];
    let rows = costs.par_chunks_mut(width.max(1) as usize).enumerate();
    rows.for_each_init(BlockScratch::default, |scratch, (row, costs)| {
        #[allow(clippy::cast_precision_loss, reason = "a picture has few rows")]
        let y = row as f64;
        for (x, cost) in (0..width).map(f64::from).zip(costs) {
            if options.stop.is_cancelled() {
                return;
            }
            let start = Instant::now();
            let _ = tracer.pixel(x, y, width, height, scratch.single());
            let time = start.elapsed();
            let rays = scratch.take_rays().sum();
            *cost = PixelCost { rays, time };
        }
    });
    costs
}

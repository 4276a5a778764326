//! Pixels with several camera rays: focal blur and cameras with several rays for each point.

use super::{Sample, Tracer};
use crate::base::math::Ray;
use crate::scene::camera::{Lens, LensRay, Spread};

/// Limit on the rays of all points that are traced together, unless a single sample of each point has more.
const RAYS_AT_ONCE: usize = 1 << 12;

/// A point of the picture whose rays are being traced.
struct Point {
    /// Its index among the positions.
    number: usize,
    x: f64,
    y: f64,
    spread: Spread,
    /// The sum of the samples, and their number.
    sum: Sample,
    count: f32,
}

impl Tracer<'_> {
    /// True if the camera has a lens, or several rays for each point.
    pub(super) fn has_many_rays(&self) -> bool {
        self.world.lens.is_some() || self.world.camera.rays_per_pixel() > 1
    }

    /// Traces points of a picture of this size with several rays each. Through a lens they are traced until their
    /// samples agree. `trace` gets rays, those of each point in order, and stores their samples; `take` gets the index
    /// of each point and the mean of its samples, in any order.
    pub(super) fn trace_many_rays(
        &self,
        positions: &[(f64, f64)],
        (width, height): (u32, u32),
        mut trace: impl FnMut(&[Option<Ray>], &mut [Sample]),
        mut take: impl FnMut(usize, Sample),
    ) {
        if positions.is_empty() {
            return;
        }
        let (camera, lens) = (&self.world.camera, self.world.lens.as_ref());
        let all = [camera.rays_per_pixel()];
        let ends = lens.map_or(&all[..], Lens::batch_ends);
        let mut points: Vec<_> = positions.iter().enumerate().map(Point::new).collect();
        let (mut rays, mut samples) = (Vec::new(), Vec::new());
        let mut count = 0;
        for (stop, &end) in ends.iter().enumerate() {
            while count < end {
                let next = end.min(count + (RAYS_AT_ONCE / points.len()).max(1));
                rays.clear();
                for sample in count..next {
                    rays.extend(points.iter().map(|&Point { x, y, .. }| match lens {
                        Some(lens) => lens.ray(camera, &LensRay { sample, x, y }, width, height),
                        None => camera.ray_by_index(sample, (x, y), (width, height)),
                    }));
                }
                samples.clear();
                samples.resize(rays.len(), Sample::OUTSIDE);
                trace(&rays, &mut samples);
                let rounds = rays.chunks(points.len()).zip(samples.chunks(points.len()));
                for (rays, samples) in rounds {
                    for ((point, ray), seen) in points.iter_mut().zip(rays).zip(samples) {
                        // A lens sees nothing where its camera has no ray; other cameras leave such rays out.
                        if ray.is_some() || lens.is_some() {
                            // Without an alpha channel the background counts as opaque.
                            point.add(ray.is_some() && !self.world.globals.has_alpha, seen);
                        }
                    }
                }
                count = next;
            }
            points.retain(|point| {
                let is_enough = |lens: &Lens| lens.is_enough(stop, &point.spread);
                let is_done = stop + 1 == ends.len() || lens.is_some_and(is_enough);
                if is_done {
                    take(point.number, point.mean());
                }
                !is_done
            });
            if points.is_empty() {
                break;
            }
        }
    }
}

impl Point {
    fn new((number, &(x, y)): (usize, &(f64, f64))) -> Self {
        Point {
            number,
            x,
            y,
            spread: Spread::default(),
            sum: Sample::BLACK,
            count: 0.0,
        }
    }

    /// Adds a sample; the transparency of an opaque one does not count in the variance.
    fn add(&mut self, is_opaque: bool, seen: &Sample) {
        let transmit = if is_opaque { 0.0 } else { seen.transmit };
        self.spread.add(seen.rgb, transmit);
        self.sum.rgb += seen.rgb;
        self.sum.transmit += seen.transmit;
        self.count += 1.0;
    }

    /// The mean of the samples.
    fn mean(&self) -> Sample {
        if self.count == 0.0 {
            return Sample::OUTSIDE;
        }
        Sample {
            rgb: self.sum.rgb.map(|c| c / self.count),
            transmit: self.sum.transmit / self.count,
        }
    }
}

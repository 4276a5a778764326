//! Pixels with several camera rays: focal blur and cameras with several rays for each point.

use super::{Sample, Tracer};
use crate::base::color::Rgb;
use crate::render::shade::Scratch;
use crate::scene::camera::{Lens, LensRay, Spread};

impl Tracer<'_> {
    /// The mean over the rays of a camera with several rays for each point.
    #[cold]
    pub(super) fn mean_of_rays(
        &self,
        x: f64,
        y: f64,
        width: u32,
        height: u32,
        scratch: &mut Scratch,
    ) -> Sample {
        let camera = &self.world.camera;
        let (at, size) = ((x, y), (width, height));
        let rays =
            (0..camera.rays_per_pixel()).filter_map(|number| camera.ray_by_index(number, at, size));
        let mut count: f32 = 0.0;
        let mut sum = Sample::BLACK;
        for ray in rays {
            let seen = self.sample(Some(ray), scratch);
            sum.rgb += seen.rgb;
            sum.transmit += seen.transmit;
            count += 1.0;
        }
        if count == 0.0 {
            return self.sample(None, scratch);
        }
        Sample {
            rgb: sum.rgb.map(|c| c / count),
            transmit: sum.transmit / count,
        }
    }

    /// Traces a point of a picture of `width` by `height` pixels through a lens, until its samples agree.
    pub(super) fn through_lens(
        &self,
        lens: &Lens,
        x: f64,
        y: f64,
        width: u32,
        height: u32,
        scratch: &mut Scratch,
    ) -> Sample {
        let mut spread = Spread::default();
        let mut rgb = Rgb::BLACK;
        let mut transmit = 0.0;
        let mut count = 0;
        for (stop, &end) in lens.batch_ends().iter().enumerate() {
            for sample in count..end {
                let sample = LensRay { sample, x, y };
                let ray = lens.ray(&self.world.camera, &sample, width, height);
                let seen = self.sample(ray, scratch);
                // Without an alpha channel the background counts as opaque.
                let is_opaque = ray.is_some() && !self.world.globals.has_alpha;
                spread.add(seen.rgb, if is_opaque { 0.0 } else { seen.transmit });
                rgb += seen.rgb;
                transmit += seen.transmit;
            }
            count = end;
            if lens.is_enough(stop, &spread) {
                break;
            }
        }
        #[allow(clippy::cast_precision_loss, reason = "samples are few")]
        let count = count as f32;
        Sample {
            rgb: rgb.map(|c| c / count),
            transmit: transmit / count,
        }
    }
}

//! `image_pattern`: the grey value of an image, or with `use_alpha` its transparency, or its red where it has
//! none.

use crate::base::args::{Args, Parse};
use crate::base::bitmap::{self, Alpha, MappedBitmap, Purpose};
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint, Wave};
use glam::DVec3;

#[derive(Clone, Debug)]
struct ImagePattern {
    source: MappedBitmap,
}

pub(crate) fn new(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    let source = bitmap::read(args, Purpose::Values)?;
    Ok(Box::new(ImagePattern { source }))
}

impl Pattern for ImagePattern {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(self.clone())
    }

    fn default_wave(&self) -> Wave {
        Wave::NONE
    }

    fn sample_counts(&self) -> Option<DVec3> {
        Some(self.source.sample_counts())
    }
}

impl PatternEval for ImagePattern {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let MappedBitmap {
            bitmap, mapping, ..
        } = &self.source;
        let Some(color) = mapping.color(bitmap, point) else {
            return 0.0;
        };
        f64::from(match self.source.alpha {
            Alpha::Used if bitmap.stores_alpha() => color.transmit,
            // POV-Ray's value of an image without alpha (measured).
            Alpha::Used => color.rgb.r,
            Alpha::Ignored => color.rgb.grey(),
        })
    }
}

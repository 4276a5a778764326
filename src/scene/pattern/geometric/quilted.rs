//! `quilted`: cushions in unit cubes, with a profile set by `control0` and `control1`.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::rounding::floor;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint, Wave};
use glam::DVec3;

/// `2 / √3`, which scales the distance from the centre to a corner of the cube to 1.
const SCALE: f64 = 1.154_700_538;

#[derive(Clone, Copy, Debug)]
struct Quilted {
    controls: [f32; 2],
}

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Quilted { controls: [1.0; 2] }))
}

impl Pattern for Quilted {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }

    fn default_wave(&self) -> Wave {
        Wave::NONE
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        let control = match word {
            Word::Control0 => &mut self.controls[0],
            Word::Control1 => &mut self.controls[1],
            _ => return Ok(false),
        };
        args.accept(word)?;
        *control = args.single()?;
        Ok(true)
    }
}

impl PatternEval for Quilted {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let v = self.cushion(point).abs();
        (v.x + v.y + v.z) / 3.0
    }

    fn tilt(&self, point: DVec3) -> Option<DVec3> {
        Some(self.cushion(point))
    }
}

impl Quilted {
    /// Vector from the centre of the cube, scaled by the profile of the cushion.
    fn cushion(&self, point: DVec3) -> DVec3 {
        let from_centre = point - point.map(floor) - 0.5;
        let t = from_centre.length();
        let [c0, c1] = self.controls.map(f64::from);
        let s = 1.0 - t;
        let height = t * (t * t) + 3.0 * t * (s * s) * c0 + 3.0 * (t * t) * s * c1;
        from_centre * (height * SCALE)
    }
}

//! `brick`: bricks in a running bond, stacked in rows along y, with mortar between them on all sides.
//!
//! A brick with its mortar has the size `brick_size`; the mortar of thickness `m` is on the lower sides, at coordinates
//! `-m .. 0`. Odd rows are shifted by half a brick in x, even rows in z.

use crate::base::args::{Args, Parse, Word};
use crate::base::color::{Color, Rgb};
use crate::scene::pattern::{
    NUDGE, Pattern, PatternEval, PrepareContext, Stop, SurfacePoint, Wave, fraction,
};
use glam::DVec3;

/// The default colours, as in POV-Ray.
const COLORS: [Stop; 2] = [
    (0.0, Color::opaque(Rgb::splat(0.5))),
    (1.0, Color::opaque(Rgb::new(0.6, 0.15, 0.15))),
];

/// 0 in the mortar, 1 in a brick.
#[derive(Clone, Copy, Debug)]
struct Brick {
    /// The size of a brick with its mortar.
    size: DVec3,
    /// The thickness of the mortar.
    mortar: f64,
}

/// The default sizes, as in POV-Ray.
const DEFAULT: Brick = Brick {
    size: DVec3::new(8.0, 3.0, 4.5),
    mortar: 0.5,
};

pub(crate) fn new(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(DEFAULT))
}

impl Pattern for Brick {
    fn prepare(&self, _context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(*self)
    }

    fn default_map(&self) -> &'static [Stop] {
        &COLORS
    }

    fn default_wave(&self) -> Wave {
        Wave::NONE
    }

    fn has_list(&self) -> bool {
        true
    }

    fn read_modifier(&mut self, word: Word, args: &mut dyn Args) -> Parse<bool> {
        match word {
            Word::BrickSize => {
                args.accept(word)?;
                self.size = args.vector()?;
            }
            Word::Mortar => {
                args.accept(word)?;
                self.mortar = args.float()?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

impl PatternEval for Brick {
    fn jumps(&self) -> bool {
        false
    }

    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let brick = (point + self.mortar + NUDGE) / self.size;
        let mortar = self.mortar / self.size;
        if fraction(brick.y) <= mortar.y {
            return 0.0;
        }
        let is_even_row = fraction(0.5 * brick.y) <= 0.5;
        let (shift_x, shift_z) = if is_even_row { (0.0, 0.5) } else { (0.5, 0.0) };
        let in_joint =
            fraction(brick.x + shift_x) <= mortar.x || fraction(brick.z + shift_z) <= mortar.z;
        if in_joint { 0.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(brick: &Brick, x: f64, y: f64, z: f64) -> f64 {
        let point = DVec3::new(x, y, z);
        brick.value(point, &SurfacePoint::at(point))
    }

    #[test]
    fn mortar_is_on_the_lower_sides_of_the_brick() {
        assert_eq!(value(&DEFAULT, 1.0, -0.25, 1.0), 0.0);
        assert_eq!(value(&DEFAULT, 1.0, 0.25, 1.0), 1.0);
        assert_eq!(value(&DEFAULT, -0.25, 0.25, 1.0), 0.0);
    }

    #[test]
    fn the_next_row_is_shifted_by_half_a_brick() {
        assert_eq!(value(&DEFAULT, -0.25, 3.25, 1.0), 1.0);
        assert_eq!(value(&DEFAULT, 3.75, 3.25, 1.0), 0.0);
    }

    #[test]
    fn a_size_of_zero_gives_a_valid_index() {
        let flat = Brick {
            size: DVec3::ZERO,
            mortar: 0.0,
        };
        assert!([0.0, 1.0].contains(&value(&flat, 1.0, 1.0, 1.0)));
    }
}

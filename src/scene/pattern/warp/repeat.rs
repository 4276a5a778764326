//! `warp { repeat }`: one block of the pattern repeated along an axis.

use super::{Warp, WarpEval};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::rounding::{floor, remainder};
use crate::scene::pattern::Settings;
use glam::DVec3;

/// Components up to this size count as zero.
const ZERO: f64 = 1e-10;

#[derive(Clone, Copy, Debug)]
struct Repeat {
    axis: usize,
    width: f64,
    /// -1 along the axes that are mirrored in every second block, otherwise 1.
    flip: DVec3,
    /// Offset of each block from the one before.
    offset: DVec3,
}

pub(super) fn read(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    let by = args.vector()?;
    let axis = (0..3)
        .rev()
        .find(|&axis| by[axis].abs() > ZERO)
        .unwrap_or(0);
    let mut warp = Repeat {
        axis,
        width: by[axis],
        flip: DVec3::ONE,
        offset: DVec3::ZERO,
    };
    loop {
        if args.accept(Word::Flip)? {
            let flip = args.vector()?;
            let is_flipped = |component: f64| component.abs() > ZERO;
            warp.flip = DVec3::from(
                flip.to_array()
                    .map(|c| if is_flipped(c) { -1.0 } else { 1.0 }),
            );
        } else if args.accept(Word::Offset)? {
            warp.offset = args.vector()?;
        } else {
            return Ok(Box::new(warp));
        }
    }
}

impl Warp for Repeat {
    fn prepare(&self, _settings: &Settings) -> Box<dyn WarpEval> {
        Box::new(*self)
    }
}

impl WarpEval for Repeat {
    fn moved(&self, point: DVec3) -> DVec3 {
        let mut moved = point;
        let block = floor(point[self.axis] / self.width);
        moved[self.axis] -= block * self.width;
        if remainder(block, 2.0) == 1.0 {
            moved *= self.flip;
            if self.flip[self.axis] < 0.0 {
                moved[self.axis] += self.width;
            }
        }
        moved + self.offset * block
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::args::text::TextArgs;

    fn moved(text: &str, point: DVec3) -> DVec3 {
        let warp = read(&mut TextArgs::new(text)).unwrap();
        warp.prepare(&Settings::default()).moved(point)
    }

    #[test]
    fn blocks_repeat() {
        assert_eq!(moved("<0, 2, 0>", DVec3::new(5.0, 5.0, 5.0)).y, 1.0);
        assert_eq!(moved("<0, 2, 0>", DVec3::new(5.0, -0.5, 5.0)).y, 1.5);
    }

    #[test]
    fn every_second_block_is_flipped() {
        assert_eq!(
            moved("<2, 0, 0> flip <1, 0, 0>", DVec3::new(2.5, 1.0, 0.0)).x,
            1.5
        );
        assert_eq!(
            moved("<2, 0, 0> flip <0, 1, 0>", DVec3::new(2.5, 1.0, 0.0)).y,
            -1.0
        );
        assert_eq!(
            moved("<2, 0, 0> flip <0, 1, 0>", DVec3::new(4.5, 1.0, 0.0)).y,
            1.0
        );
    }

    #[test]
    fn offsets_of_blocks_accumulate() {
        assert_eq!(
            moved("<1, 0, 0> offset <0, 0.5, 0>", DVec3::new(3.5, 0.0, 0.0)).y,
            1.5
        );
    }
}

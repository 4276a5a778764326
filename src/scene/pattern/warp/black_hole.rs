//! `warp { black_hole }`: a sphere in which the pattern is pulled to, or pushed from, the centre.

use super::{Warp, WarpEval};
use crate::base::args::{Args, Parse, Word};
use crate::base::math::sampling::hash::hashed_cell;
use crate::base::math::sampling::mersenne;
use crate::base::source::Diagnostic;
use crate::scene::pattern::{self, Settings};
use glam::DVec3;

#[derive(Clone, Copy, Debug)]
struct BlackHole {
    centre: DVec3,
    radius: f64,
    strength: f64,
    falloff: f64,
    is_inverse: bool,
    /// Periods at which the sphere is repeated along the axes; 0 along axes without repetition.
    repeat: DVec3,
    /// Largest random displacement of the centres of repeated spheres.
    turbulence: DVec3,
}

pub(super) fn read(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    let centre = args.vector()?;
    args.comma()?;
    let mut warp = BlackHole {
        centre,
        radius: args.float()?,
        strength: 1.0,
        falloff: 2.0,
        is_inverse: false,
        repeat: DVec3::ZERO,
        turbulence: DVec3::ZERO,
    };
    loop {
        if args.accept(Word::Strength)? {
            warp.strength = args.float()?;
        } else if args.accept(Word::Falloff)? {
            warp.falloff = args.float()?;
        } else if args.accept(Word::Inverse)? {
            warp.is_inverse = true;
        } else if args.accept(Word::Repeat)? {
            warp.repeat = args.vector()?;
        } else if args.accept(Word::Turbulence)? {
            warp.turbulence = args.vector()?;
        } else {
            warp.fit_blocks(args);
            return Ok(Box::new(warp));
        }
    }
}

impl Warp for BlackHole {
    fn prepare(&self, _settings: &Settings) -> Box<dyn WarpEval> {
        Box::new(*self)
    }
}

impl BlackHole {
    /// Moves the centre and widens the blocks so that a block contains the whole sphere, as POV-Ray does, with a
    /// warning.
    fn fit_blocks(&mut self, args: &mut dyn Args) {
        for axis in 0..3 {
            if self.repeat[axis] <= 0.0 {
                continue;
            }
            let centre = self.centre[axis].max(self.radius);
            let width = self.repeat[axis].max(centre + self.radius + self.turbulence[axis]);
            if (centre, width) != (self.centre[axis], self.repeat[axis]) {
                let message =
                    "the blocks of `black_hole` are widened until they hold all of the ball";
                let at = args.last_span();
                args.warn(Diagnostic::warning(at, message));
            }
            self.centre[axis] = centre;
            self.repeat[axis] = width;
        }
    }

    /// The centre of the sphere in the block that contains a point.
    fn centre_near(&self, point: DVec3) -> DVec3 {
        if self.repeat == DVec3::ZERO {
            return self.centre;
        }
        let mut block = DVec3::ZERO;
        for axis in 0..3 {
            if self.repeat[axis] > 0.0 {
                block[axis] = (point[axis] / self.repeat[axis]).floor();
            }
        }
        let mut centre = self.centre + self.repeat * block;
        if self.turbulence != DVec3::ZERO {
            let first = hashed_cell(pattern::cell(block));
            let random = [0, 1, 2].map(|i| mersenne::random(first + i));
            centre += self.turbulence * DVec3::from(random);
        }
        centre
    }
}

impl WarpEval for BlackHole {
    fn moved(&self, point: DVec3) -> DVec3 {
        let away = point - self.centre_near(point);
        let distance = away.length();
        if distance >= self.radius {
            return point;
        }
        let share = (self.radius - distance) / self.radius;
        let pull = (self.strength * share.powf(self.falloff)).min(1.0);
        if self.is_inverse {
            point - away * pull
        } else {
            point + away * pull
        }
    }
}

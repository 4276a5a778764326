//! `spiral1` and `spiral2`: spiral arms around the z axis, which also wind along it.

use crate::base::args::{Args, Parse};
use crate::base::math::noise::{NoiseGenerator, Octaves};
use crate::scene::pattern::wave::triangle;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint, Wave};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

#[derive(Clone, Copy, Debug)]
struct Spiral {
    arms: f64,
    is_crossed: bool,
}

#[derive(Debug)]
struct Prepared {
    spiral: Spiral,
    amount: f64,
    octaves: Octaves,
    noise: NoiseGenerator,
}

/// `spiral1`: arms side by side.
pub(crate) fn spiral1(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    read(args, false)
}

/// `spiral2`: arms crossed by rings.
pub(crate) fn spiral2(args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    read(args, true)
}

fn read(args: &mut dyn Args, is_crossed: bool) -> Parse<Box<dyn Pattern>> {
    let arms = args.float()?.trunc();
    Ok(Box::new(Spiral { arms, is_crossed }))
}

impl Pattern for Spiral {
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        Box::new(Prepared {
            spiral: *self,
            amount: context.turbulence.x,
            octaves: context.octaves,
            noise: context.noise,
        })
    }

    fn default_wave(&self) -> Wave {
        Wave::TRIANGLE
    }
}

impl PatternEval for Prepared {
    fn value(&self, p: DVec3, _spot: &SurfacePoint) -> f64 {
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let from_x = if rho == 0.0 { 0.0 } else { (p.y / rho).asin() };
        let phi = if p.x < 0.0 {
            3.0 * FRAC_PI_2 - from_x
        } else {
            FRAC_PI_2 + from_x
        };
        let turbulence = if self.amount == 0.0 {
            0.0
        } else {
            self.amount * self.noise.turbulence(p, &self.octaves)
        };
        let value = p.z + rho + self.spiral.arms * phi / TAU + turbulence;
        if self.spiral.is_crossed {
            triangle(rho) + triangle(value)
        } else {
            value
        }
    }
}

//! `warp { turbulence }`: displaces the point by octaves of vector noise, in order with the other warps.

use super::{Warp, WarpEval};
use crate::base::args::{Args, Parse};
use crate::base::math::noise::{Octaves, vector_turbulence, vector_turbulence_x4};
use crate::scene::pattern::Settings;
use crate::scene::pattern::octaves::read_octaves;
use glam::DVec3;

/// Displacement by octaves of vector noise.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene::pattern) struct Turbulence {
    /// The amounts along the axes.
    pub(in crate::scene::pattern) amount: DVec3,
    pub(in crate::scene::pattern) octaves: Octaves,
}

pub(super) fn read(args: &mut dyn Args) -> Parse<Box<dyn Warp>> {
    let mut warp = Turbulence {
        amount: args.vector()?,
        octaves: Octaves::default(),
    };
    while let Some(word) = args.word()?
        && read_octaves(&mut warp.octaves, word, args)?
    {}
    Ok(Box::new(warp))
}

impl Warp for Turbulence {
    fn prepare(&self, _settings: &Settings) -> Box<dyn WarpEval> {
        Box::new(*self)
    }
}

impl Turbulence {
    /// Four points after the warp.
    pub(in crate::scene::pattern) fn moved_x4(&self, points: &[DVec3; 4]) -> [DVec3; 4] {
        let shifts = vector_turbulence_x4(points, &self.octaves);
        std::array::from_fn(|i| points[i] + self.amount * shifts[i])
    }
}

impl WarpEval for Turbulence {
    fn moved(&self, point: DVec3) -> DVec3 {
        point + self.amount * vector_turbulence(point, &self.octaves)
    }
}

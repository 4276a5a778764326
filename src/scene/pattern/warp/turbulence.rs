//! `warp { turbulence }`: the point is displaced by octaves of vector noise, in the order of the other warps.

use super::{Warp, Warping};
use crate::base::args::{Args, Parse};
use crate::base::math::noise::{Octaves, vector_turbulence};
use crate::scene::pattern::Settings;
use crate::scene::pattern::modifiers::read_octaves;
use glam::DVec3;

#[derive(Clone, Copy, Debug)]
struct Turbulence {
    amount: DVec3,
    octaves: Octaves,
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
    fn prepare(&self, _settings: &Settings) -> Box<dyn Warping> {
        Box::new(*self)
    }
}

impl Warping for Turbulence {
    fn moved(&self, point: DVec3) -> DVec3 {
        point + self.amount * vector_turbulence(point, &self.octaves)
    }
}

//! The automatic gather radius: about as many photons lie within it as are gathered at most.
//!
//! POV-Ray measures the density at some photons chosen by the random generator of the C library.

use super::{Map, Near};
use glam::DVec3;
use std::f64::consts::PI;

/// One in this many photons is measured.
const ONE_IN: usize = 20;
const MIN_PROBES: usize = 100;
const MAX_PROBES: usize = 1000;
/// The radius of the neighbour search.
const FAR: f64 = 1e7;
/// Densities between these shares of the mean call for a larger radius.
const SPARSE: [f64; 2] = [0.05, 0.7];
/// The growth of the radius if all densities do.
const GROWTH: f64 = 20.0;

/// The dimension of the space of photons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// On surfaces.
    Surface,
    /// In media.
    Media,
}

impl Space {
    /// The density of photons within a radius.
    fn density(self, photons: f64, radius: f64) -> f64 {
        match self {
            Space::Surface => photons / (PI * radius * radius),
            Space::Media => 3.0 * photons / (4.0 * PI * radius * radius * radius),
        }
    }

    /// The radius within which as many photons are expected at a density. Its rounding is POV-Ray's: it decides whether
    /// a share of just 0.05 or 0.7 of the mean density is sparse.
    fn radius(self, photons: f64, density: f64) -> f64 {
        match self {
            Space::Surface => (photons / (density * PI)).sqrt(),
            Space::Media => (3.0 * photons / (density * PI * 4.0)).powf(0.3333),
        }
    }
}

/// The generator of the GNU C library with the seed 1: additive, with lags 3 and 31.
#[derive(Clone, Debug)]
pub struct CRand {
    last: [u32; 31],
    at: usize,
}

/// The count of discarded numbers at the start.
const WARM_UP: usize = 310;

impl CRand {
    /// The generator at its start.
    #[must_use]
    pub fn new() -> CRand {
        let mut last = [1_u32; 31];
        for at in 1..last.len() {
            let product = 16_807 * u64::from(last[at - 1]) % 0x7fff_ffff;
            last[at] = u32::try_from(product).unwrap_or(0);
        }
        let mut random = CRand { last, at: 3 };
        for _ in 0..WARM_UP {
            random.next_number();
        }
        random
    }

    /// The next number, of 31 bits.
    pub fn next_number(&mut self) -> u32 {
        let before = (self.at + 28) % 31;
        let sum = self.last[self.at].wrapping_add(self.last[before]);
        self.last[self.at] = sum;
        self.at = (self.at + 1) % 31;
        sum >> 1
    }
}

impl Default for CRand {
    fn default() -> Self {
        CRand::new()
    }
}

/// The radius of a map that gathers no more than `most` photons at a point; 0 if the map has none, or all at one position.
#[must_use]
pub fn automatic(map: &Map, most: usize, space: Space, random: &mut CRand) -> f64 {
    let photons = map.photons();
    if photons.is_empty() || most == 0 {
        return 0.0;
    }
    let probes = (photons.len() / ONE_IN).clamp(MIN_PROBES, MAX_PROBES);
    let mut near = Near::default();
    // Without a radius where all photons have one position.
    let mut density = |radius: f64| {
        let position = photons[random.next_number() as usize % photons.len()].at();
        map.find(position, DVec3::ZERO, radius, most, &mut near);
        (near.radius > 0.0).then(|| space.density(near.count() as f64, near.radius))
    };
    let mut sum = 0.0;
    for number in 0..probes {
        sum += density(FAR).unwrap_or_else(|| sum / number.max(1) as f64);
    }
    let mean = sum / probes as f64;
    if mean == 0.0 {
        return 0.0;
    }
    let radius = space.radius(most as f64, mean);
    let [least, less] = SPARSE.map(|share| share * mean);
    let sparse = (0..probes).filter(|_| {
        let density = density(radius);
        density.is_some_and(|density| density > least && density < less)
    });
    radius * (1.0 + GROWTH * (sparse.count() as f64 / probes as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_numbers_are_those_of_the_c_library() {
        let mut random = CRand::new();
        let first = [1_804_289_383, 846_930_886, 1_681_692_777, 1_714_636_915];
        for expected in first {
            assert_eq!(random.next_number(), expected);
        }
    }
}

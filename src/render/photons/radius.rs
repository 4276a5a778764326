//! How far around a point photons count where the scene does not say: so that about as many lie there as may be taken.
//!
//! POV-Ray asks at some photons chosen by the generator of the C library how densely they lie.

use super::{Map, Near};
use glam::DVec3;
use std::f64::consts::PI;

/// One in so many photons is asked.
const ONE_IN: usize = 20;
const LEAST_ASKED: usize = 100;
const MOST_ASKED: usize = 1000;
/// As far as this is searched for neighbours.
const FAR: f64 = 1e7;
/// Shares of the mean density between which photons call for a larger radius.
const SPARSE: [f64; 2] = [0.05, 0.7];
/// By how much it grows where all do.
const GROWTH: f64 = 20.0;

/// In which kind of space photons lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// On surfaces.
    Surface,
    /// In media.
    Media,
}

impl Space {
    /// The size of what lies within a radius.
    fn within(self, radius: f64) -> f64 {
        match self {
            Space::Surface => PI * radius * radius,
            Space::Media => 4.0 / 3.0 * PI * radius * radius * radius,
        }
    }

    /// The radius of what has this size.
    fn radius(self, size: f64) -> f64 {
        match self {
            Space::Surface => (size / PI).sqrt(),
            Space::Media => (3.0 * size / (4.0 * PI)).powf(0.3333),
        }
    }
}

/// The generator of the GNU C library as it begins with the seed 1: additive, with lags 3 and 31.
#[derive(Clone, Debug)]
pub struct CRand {
    last: [u32; 31],
    at: usize,
}

/// So many of the first numbers are thrown away.
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

/// The radius of a map of which no more than `most` photons are taken at a point; 0 for an empty map.
#[must_use]
pub fn automatic(map: &Map, most: usize, space: Space, random: &mut CRand) -> f64 {
    let photons = map.photons();
    if photons.is_empty() || most == 0 {
        return 0.0;
    }
    let asked = (photons.len() / ONE_IN).clamp(LEAST_ASKED, MOST_ASKED);
    let mut near = Near::default();
    let mut density = |radius: f64| {
        let place = photons[random.next_number() as usize % photons.len()].at();
        map.find(place, DVec3::ZERO, radius, most, &mut near);
        near.count() as f64 / space.within(near.radius)
    };
    let sum: f64 = (0..asked).map(|_| density(FAR)).sum();
    let mean = sum / asked as f64;
    let radius = space.radius(most as f64 / mean);
    let [least, less] = SPARSE.map(|share| share * mean);
    let sparse = (0..asked).filter(|_| {
        let density = density(radius);
        density > least && density < less
    });
    radius * (1.0 + GROWTH * sparse.count() as f64 / asked as f64)
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

//! `ripples` and `waves`: rings about ten points near the origin.
//!
//! Frequency and phase act within each ring, and once more on the sum, as in POV-Ray.

use super::wave::cycloidal;
use super::{Pattern, Preparing, Spot, Value};
use crate::args::{Args, Parse};
use crate::math::hash::{bits, next};
use crate::math::noise::vector_noise;
use glam::DVec3;

/// Where the generator starts that gives the frequencies.
const SEED: u32 = (-560_851_967_i32).cast_unsigned();

/// A centre of rings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Source {
    /// Its place on the unit sphere.
    pub(crate) place: DVec3,
    /// Its frequency in `waves`.
    pub(crate) frequency: f64,
}

/// The first sources; a scene chooses how many.
pub(crate) fn sources(count: u32) -> Vec<Source> {
    let mut state = SEED;
    let source = |number: u32| {
        state = next(state);
        Source {
            place: vector_noise(DVec3::new(f64::from(number), 0.0, 0.0)).normalize_or_zero(),
            frequency: f64::from(bits(state)) * 0.000_030_518_509_476 + 0.01,
        }
    };
    (0..count).map(source).collect()
}

#[derive(Clone, Copy, Debug)]
enum Rings {
    Ripples,
    Waves,
}

#[derive(Debug)]
struct Prepared {
    rings: Rings,
    sources: Vec<Source>,
    frequency: f64,
    phase: f64,
}

/// `ripples`: rings of one frequency.
pub(super) fn ripples(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Rings::Ripples))
}

/// `waves`: rings of many frequencies, the slow ones high.
pub(super) fn waves(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Rings::Waves))
}

impl Pattern for Rings {
    fn prepare(&self, with: &Preparing<'_>) -> Box<dyn Value> {
        Box::new(Prepared {
            rings: *self,
            sources: sources(with.settings.number_of_waves),
            frequency: f64::from(with.wave.frequency),
            phase: f64::from(with.wave.phase),
        })
    }
}

/// The distance from the middle of rings, in which nothing is divided by zero.
fn length(out: DVec3) -> f64 {
    match out.length() {
        0.0 => 1.0,
        length => length,
    }
}

impl Prepared {
    /// The height of the rings about a source at this distance.
    fn height(&self, source: &Source, length: f64) -> f64 {
        match self.rings {
            Rings::Ripples => cycloidal(length * self.frequency + self.phase),
            Rings::Waves => {
                let index = length * self.frequency * source.frequency + self.phase;
                cycloidal(index) / source.frequency
            }
        }
    }
}

impl Value for Prepared {
    fn value(&self, point: DVec3, _spot: &Spot) -> f64 {
        let mut sum = 0.0;
        for source in &self.sources {
            sum += self.height(source, length(point - source.place));
        }
        let mean = sum / self.sources.len().max(1) as f64;
        match self.rings {
            Rings::Ripples => 0.5 * (1.0 + mean),
            Rings::Waves => 0.2 * (2.5 + mean),
        }
    }

    fn tilt(&self, point: DVec3) -> Option<DVec3> {
        let count = self.sources.len().max(1) as f64;
        let tilts = self.sources.iter().map(|source| {
            let out = point - source.place;
            let length = length(out);
            self.height(source, length) / length / count * out
        });
        Some(tilts.sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sources_are_those_of_pov_ray() {
        // Facts, appendix A.
        let sources = sources(10);
        let close = |a: DVec3, b: DVec3| (a - b).abs().max_element() < 1e-10;
        let first = DVec3::new(-0.604_378_213_3, 0.492_048_408_0, -0.626_590_248_5);
        let second = DVec3::new(-0.552_573_104_2, -0.246_075_338_7, -0.796_310_173_4);
        assert!(close(sources[0].place, first) && close(sources[1].place, second));
        assert!((sources[0].frequency - 0.919_115_878_8).abs() < 1e-10);
        assert!((sources[9].frequency - 0.168_513_138_2).abs() < 1e-10);
    }
}

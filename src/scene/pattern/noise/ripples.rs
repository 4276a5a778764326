//! `ripples` and `waves`: rings about ten points near the origin.
//!
//! Frequency and phase act within each ring, and once more on the sum, as in POV-Ray.

use crate::base::args::{Args, Parse};
use crate::base::math::noise::vector_noise;
use crate::base::math::rounding::floor_of;
use crate::base::math::sampling::hash::{bits, next};
use crate::base::math::simd::vec3::Vec3Lanes;
use crate::base::math::simd::{F64x4, SimdKernel, vec3, with_widest};
use crate::scene::pattern::{Pattern, PatternEval, Preparing, SurfacePoint};
use glam::DVec3;
use std::f64::consts::TAU;

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
    /// The sources by fours; behind the last of them there may be others that do not count.
    sources: Vec<Sources>,
    count: usize,
    frequency: f64,
    phase: f64,
}

/// Four sources: their x, y, z and frequencies.
type Sources = [[f64; 4]; 4];

/// `ripples`: rings of one frequency.
pub(crate) fn ripples(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Rings::Ripples))
}

/// `waves`: rings of many frequencies, the slow ones high.
pub(crate) fn waves(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Rings::Waves))
}

impl Pattern for Rings {
    fn prepare(&self, with: &Preparing<'_>) -> Box<dyn PatternEval> {
        let sources = sources(with.settings.number_of_waves);
        let count = sources.len();
        let fours = sources.chunks(4).map(|chunk| {
            let four = [0, 1, 2, 3].map(|number| chunk[number.min(chunk.len() - 1)]);
            [
                four.map(|source| source.place.x),
                four.map(|source| source.place.y),
                four.map(|source| source.place.z),
                four.map(|source| source.frequency),
            ]
        });
        Box::new(Prepared {
            rings: *self,
            sources: fours.collect(),
            count,
            frequency: f64::from(with.wave.frequency),
            phase: f64::from(with.wave.phase),
        })
    }
}

/// Rings about four sources at a point.
struct Four<F> {
    /// How high they are.
    heights: [f64; 4],
    /// The ways from the sources, and how long these are; in the middle of rings nothing is divided by zero.
    out: Vec3Lanes<F>,
    length: F,
}

impl Prepared {
    #[inline(always)]
    fn rings_of<F: F64x4>(&self, sources: &Sources, point: DVec3) -> Four<F> {
        let [x, y, z, frequency] = sources;
        let place = [F::from_array(x), F::from_array(y), F::from_array(z)];
        let out = vec3::sub(vec3::splat(point), place);
        let length = vec3::dot(out, out).sqrt();
        let length = F::select(length.eq(F::splat(0.0)), F::splat(1.0), length);
        let own = F::from_array(frequency);
        let index = length * F::splat(self.frequency);
        let index = match self.rings {
            Rings::Ripples => index,
            Rings::Waves => index * own,
        };
        let index = index + F::splat(self.phase);
        // As `cycloidal` of each.
        let size = index.abs();
        let angles = ((size - floor_of(size)) * F::splat(TAU)).to_array();
        let is_positive = F::bitmask(F::splat(0.0).le(index));
        let mut heights = [0.0; 4];
        for (lane, (height, angle)) in heights.iter_mut().zip(angles).enumerate() {
            let sine = angle.sin();
            *height = if is_positive >> lane & 1 == 1 {
                sine
            } else {
                -sine
            };
        }
        if let Rings::Waves = self.rings {
            heights = (F::from_array(&heights) / own).to_array();
        }
        Four {
            heights,
            out,
            length,
        }
    }
}

/// The sum of the heights of all rings at a point.
struct Height<'a>(&'a Prepared, DVec3);

impl SimdKernel for Height<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<F: F64x4>(self) -> f64 {
        let Height(prepared, point) = self;
        let mut sum = 0.0;
        let mut left = prepared.count;
        for sources in &prepared.sources {
            let rings = prepared.rings_of::<F>(sources, point);
            for height in rings.heights.into_iter().take(left) {
                sum += height;
            }
            left = left.saturating_sub(4);
        }
        sum
    }
}

/// How all rings together tilt a normal at a point.
struct Tilt<'a>(&'a Prepared, DVec3);

impl SimdKernel for Tilt<'_> {
    type Output = DVec3;

    #[inline(always)]
    fn run<F: F64x4>(self) -> DVec3 {
        let Tilt(prepared, point) = self;
        let count = F::splat(prepared.count as f64);
        let mut sum = DVec3::ZERO;
        let mut left = prepared.count;
        for sources in &prepared.sources {
            let rings = prepared.rings_of::<F>(sources, point);
            let slope = F::from_array(&rings.heights) / rings.length / count;
            let [x, y, z] = vec3::to_arrays(vec3::scale(rings.out, slope));
            for lane in 0..left.min(4) {
                sum += DVec3::new(x[lane], y[lane], z[lane]);
            }
            left = left.saturating_sub(4);
        }
        sum
    }
}

impl PatternEval for Prepared {
    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let sum = with_widest(
            #[inline(always)]
            |lanes| lanes.run(Height(self, point)),
        );
        let mean = sum / self.count.max(1) as f64;
        match self.rings {
            Rings::Ripples => 0.5 * (1.0 + mean),
            Rings::Waves => 0.2 * (2.5 + mean),
        }
    }

    fn tilt(&self, point: DVec3) -> Option<DVec3> {
        Some(with_widest(
            #[inline(always)]
            |lanes| lanes.run(Tilt(self, point)),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::math::noise::{NoiseGenerator, Octaves};
    use crate::base::math::sampling::random::Random;
    use crate::scene::pattern::Settings;
    use crate::scene::pattern::wave::{Wave, cycloidal};

    #[test]
    fn rings_are_those_of_single_sources() {
        let sources = sources(10);
        let mut rng = Random::new(8);
        for rings in [Rings::Ripples, Rings::Waves] {
            let with = Preparing {
                noise: NoiseGenerator::default(),
                turbulence: DVec3::ZERO,
                octaves: Octaves::default(),
                wave: Wave {
                    frequency: 3.5,
                    phase: -7.25,
                    ..Wave::default()
                },
                settings: &Settings::default(),
            };
            let prepared = rings.prepare(&with);
            let height = |source: &Source, length: f64| match rings {
                Rings::Ripples => cycloidal(length * 3.5 - 7.25),
                Rings::Waves => {
                    cycloidal(length * 3.5 * source.frequency - 7.25) / source.frequency
                }
            };
            for _ in 0..2000 {
                let point = rng.vector(9.0);
                let (mut sum, mut tilt) = (0.0, DVec3::ZERO);
                for source in &sources {
                    let out = point - source.place;
                    let height = height(source, out.length());
                    sum += height;
                    tilt += height / out.length() / 10.0 * out;
                }
                let value = match rings {
                    Rings::Ripples => 0.5 * (1.0 + sum / 10.0),
                    Rings::Waves => 0.2 * (2.5 + sum / 10.0),
                };
                assert_eq!(prepared.value(point, &SurfacePoint::at(point)), value);
                assert_eq!(prepared.tilt(point), Some(tilt));
            }
        }
    }

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

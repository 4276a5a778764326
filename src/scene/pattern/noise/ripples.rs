//! `ripples` and `waves`: waves around sources on the unit sphere, ten by default.
//!
//! Frequency and phase act on the waves of each source, and again on the sum, as in POV-Ray.

use crate::base::args::{Args, Parse};
use crate::base::math::noise::vector_noise;
use crate::base::math::rounding::floor_lanes;
use crate::base::math::sampling::hash::{bits, next};
use crate::base::math::simd::vec3::Vec3Lanes;
use crate::base::math::simd::{F64x4, SimdKernel, vec3, with_widest};
use crate::scene::pattern::wave::STEPS;
use crate::scene::pattern::{Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;
use std::f64::consts::TAU;

/// Initial state of the random-number generator for the frequencies.
const SEED: u32 = (-560_851_967_i32).cast_unsigned();

/// A wave source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Source {
    /// A point on the unit sphere.
    pub(crate) centre: DVec3,
    /// The frequency in `waves`.
    pub(crate) frequency: f64,
}

/// The first `count` sources.
pub(crate) fn sources(count: u32) -> Vec<Source> {
    let mut state = SEED;
    let source = |number: u32| {
        state = next(state);
        let noise = vector_noise(DVec3::new(f64::from(number), 0.0, 0.0));
        Source {
            // A quotient, unlike POV-Ray's other unit vectors.
            centre: noise / noise.length(),
            frequency: f64::from(bits(state)) * 0.000_030_518_509_476 + 0.01,
        }
    };
    (0..count).map(source).collect()
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Ripples,
    Waves,
}

#[derive(Debug)]
struct Prepared {
    kind: Kind,
    /// The sources in packets of four. The last packet is padded with copies of the last source.
    sources: Vec<SourcePacket>,
    count: usize,
    frequency: f64,
    phase: f64,
}

/// Four sources: their x, y, z and frequencies.
type SourcePacket = [[f64; 4]; 4];

/// `ripples`: all sources have the same frequency.
pub(crate) fn ripples(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Kind::Ripples))
}

/// `waves`: the sources have different frequencies; amplitudes are inverse to them.
pub(crate) fn waves(_args: &mut dyn Args) -> Parse<Box<dyn Pattern>> {
    Ok(Box::new(Kind::Waves))
}

impl Pattern for Kind {
    fn prepare(&self, context: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        let sources = sources(context.settings.number_of_waves);
        let count = sources.len();
        let packets = sources.chunks(4).map(|chunk| {
            let padded = [0, 1, 2, 3].map(|number| chunk[number.min(chunk.len() - 1)]);
            [
                padded.map(|source| source.centre.x),
                padded.map(|source| source.centre.y),
                padded.map(|source| source.centre.z),
                padded.map(|source| source.frequency),
            ]
        });
        Box::new(Prepared {
            kind: *self,
            sources: packets.collect(),
            count,
            frequency: f64::from(context.wave.frequency),
            phase: f64::from(context.wave.phase),
        })
    }
}

/// The waves of four sources at a point.
struct WavePacket<F> {
    /// Heights of the waves.
    heights: [f64; 4],
    /// Vectors from the sources to the point, and their lengths, with 1 instead of 0 to avoid division by zero.
    offset: Vec3Lanes<F>,
    length: F,
}

impl Prepared {
    #[inline(always)]
    fn wave_packet<F: F64x4>(&self, sources: &SourcePacket, point: DVec3) -> WavePacket<F> {
        let [x, y, z, frequency] = sources;
        let centre = [F::from_array(x), F::from_array(y), F::from_array(z)];
        let offset = vec3::sub(vec3::splat(point), centre);
        let length = vec3::dot(offset, offset).sqrt();
        let length = F::select(length.eq(F::splat(0.0)), F::splat(1.0), length);
        let frequency_of_source = F::from_array(frequency);
        let index = length * F::splat(self.frequency);
        let index = match self.kind {
            Kind::Ripples => index,
            Kind::Waves => index * frequency_of_source,
        };
        let index = index + F::splat(self.phase);
        // As `cycloidal`, lane by lane.
        let size = index.abs();
        let steps = F::splat(STEPS);
        let angles = (((size - floor_lanes(size)) * steps / steps) * F::splat(TAU)).to_array();
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
        if let Kind::Waves = self.kind {
            heights = (F::from_array(&heights) / frequency_of_source).to_array();
        }
        WavePacket {
            heights,
            offset,
            length,
        }
    }
}

/// Kernel for the sum of the heights of all waves at a point.
struct Height<'a>(&'a Prepared, DVec3);

impl SimdKernel for Height<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<F: F64x4>(self) -> f64 {
        let Height(prepared, point) = self;
        let mut sum = 0.0;
        let mut remaining = prepared.count;
        for sources in &prepared.sources {
            let waves = prepared.wave_packet::<F>(sources, point);
            for height in waves.heights.into_iter().take(remaining) {
                sum += height;
            }
            remaining = remaining.saturating_sub(4);
        }
        sum
    }
}

/// Kernel for the vector that all waves together add to the unit normal at a point.
struct Tilt<'a>(&'a Prepared, DVec3);

impl SimdKernel for Tilt<'_> {
    type Output = DVec3;

    #[inline(always)]
    fn run<F: F64x4>(self) -> DVec3 {
        let Tilt(prepared, point) = self;
        let count = F::splat(prepared.count as f64);
        let mut sum = DVec3::ZERO;
        let mut remaining = prepared.count;
        for sources in &prepared.sources {
            let waves = prepared.wave_packet::<F>(sources, point);
            let slope = F::from_array(&waves.heights) / waves.length / count;
            let [x, y, z] = vec3::to_arrays(vec3::scale(waves.offset, slope));
            for lane in 0..remaining.min(4) {
                sum += DVec3::new(x[lane], y[lane], z[lane]);
            }
            remaining = remaining.saturating_sub(4);
        }
        sum
    }
}

impl PatternEval for Prepared {
    fn jumps(&self) -> bool {
        false
    }

    fn value(&self, point: DVec3, _spot: &SurfacePoint) -> f64 {
        let sum = with_widest(
            #[inline(always)]
            |lanes| lanes.run(Height(self, point)),
        );
        let mean = sum / self.count.max(1) as f64;
        match self.kind {
            Kind::Ripples => 0.5 * (1.0 + mean),
            Kind::Waves => 0.2 * (2.5 + mean),
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
    fn packets_match_single_sources() {
        let sources = sources(10);
        let mut rng = Random::new(8);
        for kind in [Kind::Ripples, Kind::Waves] {
            let context = PrepareContext {
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
            let prepared = kind.prepare(&context);
            let height = |source: &Source, length: f64| match kind {
                Kind::Ripples => cycloidal(length * 3.5 - 7.25),
                Kind::Waves => cycloidal(length * 3.5 * source.frequency - 7.25) / source.frequency,
            };
            for _ in 0..2000 {
                let point = rng.vector(9.0);
                let (mut sum, mut tilt) = (0.0, DVec3::ZERO);
                for source in &sources {
                    let offset = point - source.centre;
                    let height = height(source, offset.length());
                    sum += height;
                    tilt += height / offset.length() / 10.0 * offset;
                }
                let value = match kind {
                    Kind::Ripples => 0.5 * (1.0 + sum / 10.0),
                    Kind::Waves => 0.2 * (2.5 + sum / 10.0),
                };
                assert_eq!(prepared.value(point, &SurfacePoint::at(point)), value);
                assert_eq!(prepared.tilt(point), Some(tilt));
            }
        }
    }

    #[test]
    fn sources_match_pov_ray() {
        // docs/povray-shapes.md, section 14.
        let sources = sources(10);
        let close = |a: DVec3, b: DVec3| (a - b).abs().max_element() < 1e-10;
        let first = DVec3::new(-0.604_378_213_3, 0.492_048_408_0, -0.626_590_248_5);
        let second = DVec3::new(-0.552_573_104_2, -0.246_075_338_7, -0.796_310_173_4);
        assert!(close(sources[0].centre, first) && close(sources[1].centre, second));
        assert!((sources[0].frequency - 0.919_115_878_8).abs() < 1e-10);
        assert!((sources[9].frequency - 0.168_513_138_2).abs() < 1e-10);
    }
}

//! POV-Ray's solid noise: scalar and vector noise, and turbulence, their sums over octaves.
//!
//! Lattice noise after Perlin ("An Image Synthesizer", SIGGRAPH 1985): a hash gives each corner of a cell an offset and
//! a gradient, and smooth weights blend the eight linear functions. The tables, the hash and the order of summation are
//! POV-Ray's, so the values agree with it bit for bit.

mod lattice;
mod perlin;
mod tables;

use super::simd::vec3::{self, Vec3Lanes, to_arrays};
use super::simd::{F64Lanes, F64x4, SimdKernel, with_widest};
use glam::DVec3;
use lattice::VectorPoints;
pub use perlin::Perlin;

/// POV-Ray's limit of octaves.
const MAX_OCTAVES: u32 = 10;

/// `noise_generator`: the noise function of the patterns.
#[derive(Clone, Copy, Debug, Default)]
pub enum NoiseGenerator {
    /// 1: the noise of versions up to 3.1; flat where it is clamped to 0 and 1.
    Original,
    /// 2: the same noise scaled into 0 to 1.
    #[default]
    RangeCorrected,
    /// 3: Perlin's gradient noise with its tables.
    Perlin(&'static Perlin),
}

impl PartialEq for NoiseGenerator {
    fn eq(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

/// The octaves of turbulence. POV-Ray stores `lambda` and `omega` in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octaves {
    /// `octaves`: the number of octaves, 1 to 10.
    pub count: u32,
    /// `lambda`: the frequency of an octave relative to the previous one.
    pub lambda: f32,
    /// `omega`: the amplitude of an octave relative to the previous one.
    pub omega: f32,
}

impl Default for Octaves {
    fn default() -> Self {
        Octaves {
            count: 6,
            lambda: 2.0,
            omega: 0.5,
        }
    }
}

impl Octaves {
    /// The number of octaves for the value written in a scene, clamped to POV-Ray's 1 to 10.
    #[must_use]
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the number is cut to 1..=10"
    )]
    pub fn clamped_count(written: f64) -> u32 {
        written.clamp(1.0, f64::from(MAX_OCTAVES)) as u32
    }

    /// The octaves, from amplitude and frequency 1 on.
    fn series(&self) -> Series {
        Series {
            amplitude: 1.0,
            frequency: 1.0,
            omega: f64::from(self.omega),
            lambda: f64::from(self.lambda),
            left: self.count.max(1),
        }
    }
}

/// The octaves of a sum, which are evaluated four at a time.
#[derive(Clone, Copy)]
struct Series {
    /// Amplitude and frequency of the next octave.
    amplitude: f64,
    frequency: f64,
    /// The ratios of one octave to the previous one.
    omega: f64,
    lambda: f64,
    left: u32,
}

/// Up to four octaves in a row. Unused frequencies repeat the first one.
struct OctavePacket4 {
    amplitudes: [f64; 4],
    frequencies: [f64; 4],
    count: usize,
}

impl Series {
    /// Octaves of which the amplitudes halve, from 1 on, and the frequencies double.
    fn halved(count: u32, frequency: f64) -> Self {
        Series {
            amplitude: 1.0,
            frequency,
            omega: 0.5,
            lambda: 2.0,
            left: count,
        }
    }
}

impl Iterator for Series {
    type Item = OctavePacket4;

    #[inline(always)]
    fn next(&mut self) -> Option<OctavePacket4> {
        let count = self.left.min(4);
        self.left -= count;
        let [a, f] = [self.amplitude, self.frequency];
        let [a1, f1] = [a * self.omega, f * self.lambda];
        let [a2, f2] = [a1 * self.omega, f1 * self.lambda];
        let [a3, f3] = [a2 * self.omega, f2 * self.lambda];
        [self.amplitude, self.frequency] = [a3 * self.omega, f3 * self.lambda];
        let packet = OctavePacket4 {
            amplitudes: [a, a1, a2, a3],
            frequencies: [f, f1, f2, f3],
            count: count as usize,
        };
        (count > 0).then_some(packet)
    }
}

impl NoiseGenerator {
    /// The generator of a number in a scene, clamped to 1 to 3.
    #[must_use]
    pub fn of_number(number: f64) -> Self {
        if number < 2.0 {
            NoiseGenerator::Original
        } else if number < 3.0 {
            NoiseGenerator::RangeCorrected
        } else {
            NoiseGenerator::Perlin(perlin::tables())
        }
    }

    /// The noise at a point, 0 to 1.
    #[must_use]
    pub fn noise(self, point: DVec3) -> f64 {
        with_widest(
            #[inline(always)]
            |lanes| match self {
                NoiseGenerator::Perlin(perlin) => self.scaled(perlin.noise(point)),
                _ => self.scaled(lanes.run(Scalar(point))),
            },
        )
    }

    /// The noise at four points.
    #[must_use]
    pub fn noise_x4(self, points: &[DVec3; 4]) -> [f64; 4] {
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(NoiseX4(self, points)),
        )
    }

    /// The sum of `count` octaves of noise, of which `term` makes the terms. The first octave has amplitude 1 and the
    /// given frequency; amplitudes halve and frequencies double from octave to octave.
    pub(crate) fn octaves(
        self,
        point: DVec3,
        (count, frequency): (u32, f64),
        term: impl OctaveTerm,
    ) -> f64 {
        self.summed(point, Series::halved(count, frequency), term)
    }

    /// [`NoiseGenerator::octaves`] at four points.
    pub(crate) fn octaves_x4(
        self,
        points: &[DVec3; 4],
        (count, frequency): (u32, f64),
        term: impl OctaveTerm,
    ) -> [f64; 4] {
        self.summed_x4(points, Series::halved(count, frequency), term)
    }

    /// Maps the raw lattice sum to noise from 0 to 1.
    #[inline(always)]
    fn scaled<F: F64Lanes>(self, sum: F) -> F {
        let noise = match self {
            NoiseGenerator::Original => sum + F::splat(0.5),
            NoiseGenerator::RangeCorrected => (sum + F::splat(1.05242)) * F::splat(0.489_855_82),
            NoiseGenerator::Perlin(_) => F::splat(0.5) * (F::splat(1.59) * sum + F::splat(0.985)),
        };
        clamped(noise)
    }

    /// Turbulence: a sum of octaves. The first octave is clamped to 0 and 1, the sum is not.
    #[must_use]
    pub fn turbulence(self, point: DVec3, octaves: &Octaves) -> f64 {
        self.summed(point, octaves.series(), TurbulenceTerm)
    }

    /// [`NoiseGenerator::turbulence`] at four points.
    #[must_use]
    pub fn turbulence_x4(self, points: &[DVec3; 4], octaves: &Octaves) -> [f64; 4] {
        self.summed_x4(points, octaves.series(), TurbulenceTerm)
    }

    /// A sum of octaves of what `term` makes of the noise.
    #[inline(always)]
    fn summed(self, point: DVec3, octaves: Series, term: impl OctaveTerm) -> f64 {
        let sum = OctaveSum {
            generator: self,
            point,
            octaves,
            term,
        };
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(sum),
        )
    }

    /// [`NoiseGenerator::summed`] at four points.
    #[inline(always)]
    fn summed_x4(self, points: &[DVec3; 4], octaves: Series, term: impl OctaveTerm) -> [f64; 4] {
        let sums = OctaveSumX4 {
            generator: self,
            points,
            octaves,
            term,
        };
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(sums),
        )
    }
}

/// The terms of a sum of octaves.
pub(crate) trait OctaveTerm: Copy {
    /// The terms for noises from 0 to 1; `is_first` is true for the first octave.
    fn of<F: F64Lanes>(self, generator: NoiseGenerator, noise: F, is_first: F::Mask) -> F;
}

/// The terms of turbulence: for generators 2 and 3 the noise stretched to -0.5 to 1.5.
#[derive(Clone, Copy)]
struct TurbulenceTerm;

impl OctaveTerm for TurbulenceTerm {
    #[inline(always)]
    fn of<F: F64Lanes>(self, generator: NoiseGenerator, noise: F, is_first: F::Mask) -> F {
        let centred = match generator {
            NoiseGenerator::Original => noise,
            _ => F::splat(2.0) * noise - F::splat(0.5),
        };
        F::select(is_first, clamped(centred), centred)
    }
}

/// `f64::clamp` to 0 and 1 in lanes.
#[inline(always)]
pub(crate) fn clamped<F: F64Lanes>(x: F) -> F {
    F::splat(1.0).lane_min(F::splat(0.0).lane_max(x))
}

/// Kernel of the raw lattice sum at a point.
struct Scalar(DVec3);

impl SimdKernel for Scalar {
    type Output = f64;

    #[inline(always)]
    fn run<F: F64x4>(self) -> f64 {
        lattice::scalar::<F>(vec3::splat(self.0))
    }
}

/// Kernel of [`NoiseGenerator::noise_x4`].
struct NoiseX4<'a>(NoiseGenerator, &'a [DVec3; 4]);

impl SimdKernel for NoiseX4<'_> {
    type Output = [f64; 4];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [f64; 4] {
        let NoiseX4(generator, points) = self;
        let sum = generator.raw_x4::<F>(in_lanes(points));
        generator.scaled(sum).to_array()
    }
}

impl NoiseGenerator {
    /// The raw sums at four points.
    #[inline(always)]
    fn raw_x4<F: F64x4>(self, points: Vec3Lanes<F>) -> F {
        let NoiseGenerator::Perlin(perlin) = self else {
            return lattice::scalar_x4(points);
        };
        let [x, y, z] = to_arrays(points);
        let mut sums = [0.0; 4];
        for (lane, sum) in sums.iter_mut().enumerate() {
            *sum = perlin.noise(DVec3::new(x[lane], y[lane], z[lane]));
        }
        F::from_array(&sums)
    }
}

/// Kernel of [`NoiseGenerator::summed`].
struct OctaveSum<T> {
    generator: NoiseGenerator,
    point: DVec3,
    octaves: Series,
    term: T,
}

impl<T: OctaveTerm> SimdKernel for OctaveSum<T> {
    type Output = f64;

    #[inline(always)]
    fn run<F: F64x4>(self) -> f64 {
        let mut total = 0.0;
        let mut first = 0b0001;
        for octaves in self.octaves {
            let sums = match self.generator {
                NoiseGenerator::Perlin(perlin) => {
                    let mut sums = [0.0; 4];
                    let wanted = sums.iter_mut().zip(octaves.frequencies);
                    for (sum, frequency) in wanted.take(octaves.count) {
                        *sum = perlin.noise(self.point * frequency);
                    }
                    F::from_array(&sums)
                }
                _ => lattice::scalar_apart::<F>(octaves.points(self.point), octaves.count),
            };
            let noise = self.generator.scaled(sums);
            let term = self
                .term
                .of(self.generator, noise, F::mask_from_bits(first));
            let terms = (F::from_array(&octaves.amplitudes) * term).to_array();
            for term in terms.into_iter().take(octaves.count) {
                total += term;
            }
            first = 0;
        }
        total
    }
}

/// Kernel of [`NoiseGenerator::summed_x4`].
struct OctaveSumX4<'a, T> {
    generator: NoiseGenerator,
    points: &'a [DVec3; 4],
    octaves: Series,
    term: T,
}

impl<T: OctaveTerm> SimdKernel for OctaveSumX4<'_, T> {
    type Output = [f64; 4];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [f64; 4] {
        let points = in_lanes::<F>(self.points);
        let mut totals = F::splat(0.0);
        let mut first = 0b1111;
        for octaves in self.octaves {
            for octave in 0..octaves.count {
                let frequency = F::splat(octaves.frequencies[octave]);
                let sums = self.generator.raw_x4(vec3::scale(points, frequency));
                let noise = self.generator.scaled(sums);
                let term = self
                    .term
                    .of(self.generator, noise, F::mask_from_bits(first));
                totals = totals + F::splat(octaves.amplitudes[octave]) * term;
                first = 0;
            }
        }
        totals.to_array()
    }
}

impl OctavePacket4 {
    /// The points at which these octaves of a point are evaluated.
    #[inline(always)]
    fn points<F: F64Lanes>(&self, point: DVec3) -> Vec3Lanes<F> {
        vec3::scale(vec3::splat(point), F::from_array(&self.frequencies))
    }
}

/// Vector noise, each component about -0.5 to 0.5; the same for all generators.
#[must_use]
pub fn vector_noise(point: DVec3) -> DVec3 {
    with_widest(
        #[inline(always)]
        |lanes| lanes.run(Vector(point)),
    )
}

/// Vector turbulence: a sum of octaves of vector noise.
#[must_use]
pub fn vector_turbulence(point: DVec3, octaves: &Octaves) -> DVec3 {
    with_widest(
        #[inline(always)]
        |lanes| lanes.run(VectorTurbulence(point, octaves)),
    )
}

/// [`vector_turbulence`] at four points.
#[must_use]
pub fn vector_turbulence_x4(points: &[DVec3; 4], octaves: &Octaves) -> [DVec3; 4] {
    with_widest(
        #[inline(always)]
        |lanes| lanes.run(VectorTurbulenceX4(points, octaves)),
    )
}

/// The sum of `count` octaves of vector noise, `each` applied to every one and its frequency. Frequencies double, from 1
/// on.
pub(crate) fn vector_octaves(
    point: DVec3,
    count: u32,
    each: impl Fn(DVec3, f64) -> DVec3,
) -> DVec3 {
    let octaves = VectorOctaves {
        point,
        octaves: Series::halved(count, 1.0),
        each,
    };
    with_widest(
        #[inline(always)]
        |lanes| lanes.run(octaves),
    )
}

/// Kernel of [`vector_octaves`].
struct VectorOctaves<T> {
    point: DVec3,
    octaves: Series,
    each: T,
}

impl<T: Fn(DVec3, f64) -> DVec3> SimdKernel for VectorOctaves<T> {
    type Output = DVec3;

    #[inline(always)]
    fn run<F: F64x4>(self) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for octaves in self.octaves {
            let points = VectorPoints::apart::<F>(octaves.points(self.point), octaves.count);
            for octave in 0..octaves.count {
                let noise = from_lanes(points.noise::<F>(octave));
                sum += (self.each)(noise, octaves.frequencies[octave]);
            }
        }
        sum
    }
}

/// Kernel of [`vector_noise`].
struct Vector(DVec3);

impl SimdKernel for Vector {
    type Output = DVec3;

    #[inline(always)]
    fn run<F: F64x4>(self) -> DVec3 {
        let points = VectorPoints::apart::<F>(vec3::splat(self.0), 1);
        from_lanes(points.noise::<F>(0))
    }
}

/// Kernel of [`vector_turbulence`].
struct VectorTurbulence<'a>(DVec3, &'a Octaves);

impl SimdKernel for VectorTurbulence<'_> {
    type Output = DVec3;

    #[inline(always)]
    fn run<F: F64x4>(self) -> DVec3 {
        let VectorTurbulence(point, octaves) = self;
        let mut sum = F::splat(0.0);
        for octaves in octaves.series() {
            let points = VectorPoints::apart::<F>(octaves.points(point), octaves.count);
            for octave in 0..octaves.count {
                let amplitude = F::splat(octaves.amplitudes[octave]);
                sum = sum + amplitude * points.noise(octave);
            }
        }
        from_lanes(sum)
    }
}

/// Kernel of [`vector_turbulence_x4`].
struct VectorTurbulenceX4<'a>(&'a [DVec3; 4], &'a Octaves);

impl SimdKernel for VectorTurbulenceX4<'_> {
    type Output = [DVec3; 4];

    #[inline(always)]
    fn run<F: F64x4>(self) -> [DVec3; 4] {
        let VectorTurbulenceX4(points, octaves) = self;
        let points = in_lanes::<F>(points);
        let mut sum = [F::splat(0.0); 3];
        for octaves in octaves.series() {
            for octave in 0..octaves.count {
                let frequency = F::splat(octaves.frequencies[octave]);
                let noise = lattice::vector_x4(vec3::scale(points, frequency));
                let amplitude = F::splat(octaves.amplitudes[octave]);
                sum = vec3::add(sum, vec3::scale(noise, amplitude));
            }
        }
        let [x, y, z] = to_arrays(sum);
        [0, 1, 2, 3].map(|point| DVec3::new(x[point], y[point], z[point]))
    }
}

/// Four points in lanes.
#[inline(always)]
fn in_lanes<F: F64Lanes>([a, b, c, d]: &[DVec3; 4]) -> Vec3Lanes<F> {
    [
        F::from_array(&[a.x, b.x, c.x, d.x]),
        F::from_array(&[a.y, b.y, c.y, d.y]),
        F::from_array(&[a.z, b.z, c.z, d.z]),
    ]
}

#[inline(always)]
fn from_lanes<F: F64Lanes>(lanes: F) -> DVec3 {
    let [x, y, z, _] = lanes.to_array();
    DVec3::new(x, y, z)
}

/// The smoothstep `3t² - 2t³`, with zero slope at 0 and 1.
#[must_use]
#[inline]
pub fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The points of docs/povray-shapes.md, section 14.
    const POINTS: [DVec3; 3] = [
        DVec3::new(0.3, 0.2, 0.1),
        DVec3::new(-1.7, 2.25, 0.6),
        DVec3::new(12.34, -5.67, 8.9),
    ];

    #[test]
    fn the_generators_are_those_of_pov_ray() {
        // docs/povray-shapes.md, section 14, which prints ten digits.
        let expected = [
            [0.209_924_647_6, 0.801_849_110_5, 0.392_921_149_1],
            [0.373_438_962_5, 0.663_396_605_6, 0.463_080_863_8],
            [0.578_735_912_4, 0.517_431_379_0, 0.543_519_081_6],
        ];
        for (number, expected) in [1.0, 2.0, 3.0].into_iter().zip(expected) {
            let generator = NoiseGenerator::of_number(number);
            for (point, value) in POINTS.into_iter().zip(expected) {
                let noise = generator.noise(point);
                assert!((noise - value).abs() < 1e-10, "{number} {point} {noise}");
            }
        }
    }

    #[test]
    fn values_are_those_of_pov_ray_to_the_bit() {
        // Printed by POV-Ray 3.7 with twenty digits: `f_noise_generator` and `vturbulence`.
        let point = DVec3::new(
            0.505_593_364_054_149_2,
            0.457_880_659_258_567_47,
            -0.640_897_446_641_823_6,
        );
        let noise = [1.0, 2.0, 3.0].map(|n| NoiseGenerator::of_number(n).noise(point));
        let expected = [
            0.293_844_141_993_058_2,
            0.414_547_415_212_605_9,
            0.398_281_382_159_354_1,
        ];
        assert_eq!(noise, expected);
        let expected = DVec3::new(
            -0.206_155_858_006_941_78,
            0.105_386_493_936_168_78,
            0.301_794_675_074_659_6,
        );
        assert_eq!(vector_noise(point), expected);
        let octaves = Octaves {
            count: 5,
            lambda: 2.3,
            omega: 0.7,
        };
        let expected = DVec3::new(
            -0.161_400_766_978_217_65,
            0.281_070_275_509_701_65,
            0.267_388_712_591_477_56,
        );
        assert_eq!(vector_turbulence(point, &octaves), expected);
    }

    #[test]
    fn vector_noise_is_that_of_pov_ray() {
        // docs/povray-shapes.md, section 14.
        let expected = [
            DVec3::new(-0.290_075_352_4, -0.053_512_751_7, -0.394_393_213_0),
            DVec3::new(0.301_849_110_5, -0.100_780_619_9, 0.107_387_320_3),
            DVec3::new(-0.107_078_850_9, 0.282_105_694_3, -0.150_839_377_0),
        ];
        for (point, expected) in POINTS.into_iter().zip(expected) {
            assert!(
                (vector_noise(point) - expected).abs().max_element() < 1e-10,
                "{point}"
            );
        }
    }

    #[test]
    fn vector_turbulence_is_that_of_pov_ray() {
        // docs/povray-shapes.md, section 14.
        let expected = [
            DVec3::new(-0.426_615_879_9, -0.193_939_078_4, -0.365_478_992_6),
            DVec3::new(0.224_776_295_7, -0.140_241_935_6, 0.219_361_663_2),
            DVec3::new(-0.084_618_163_3, 0.338_964_799_5, -0.013_158_720_8),
        ];
        for (point, expected) in POINTS.into_iter().zip(expected) {
            let value = vector_turbulence(point, &Octaves::default());
            assert!((value - expected).abs().max_element() < 1e-10, "{point}");
        }
    }

    #[test]
    fn beyond_32_bits_noise_is_that_of_pov_ray() {
        // Printed by POV-Ray 3.7: `f_noise_generator` of all three generators.
        for (point, expected) in [
            ([3e9, 0.3, 0.7], [0.0, 0.0, 1.0]),
            ([-3e9, 0.3, 0.7], [0.0, 0.0, 1.0]),
            ([0.3, 3e9, 0.7], [1.0, 1.0, 0.0]),
            ([0.3, 0.7, 3e9], [0.0, 0.0, 1.0]),
            ([5e9, 0.2, 1e10], [1.0, 1.0, 0.0]),
            ([-2_147_483_650.3, -5e9, 0.7], [1.0, 1.0, 0.0]),
        ] {
            let noise = [1.0, 2.0, 3.0]
                .map(|number| NoiseGenerator::of_number(number).noise(DVec3::from_array(point)));
            assert_eq!(noise, expected, "{point:?}");
        }
        let octaves = Octaves {
            count: 1,
            ..Octaves::default()
        };
        let expected = DVec3::new(
            -298_425_193_156_625_021_097_013_622_513_648_795_648.0,
            -188_251_134_514_334_579_553_265_391_215_512_125_440.0,
            592_472_055_067_682_947_529_764_017_684_227_293_184.0,
        );
        let value = vector_turbulence(DVec3::new(2_147_483_648.3, 0.3, 0.7), &octaves);
        assert!((value / expected - 1.0).abs().max_element() < 1e-14);
    }

    #[test]
    fn points_far_out_do_not_panic() {
        for point in [1e17, 1e100, f64::MAX, f64::NAN].map(DVec3::splat) {
            for number in [1.0, 2.0, 3.0] {
                let _ = NoiseGenerator::of_number(number).noise(point);
            }
            let _ = vector_turbulence(point, &Octaves::default());
        }
    }
}

//! The centres of a tile's pixels: graded and compared with their neighbours four at a time.

use super::{ENDLESS, GRADE_CARE, Graded, Scale};
use crate::base::film::Pixel;
use crate::base::math::powers::power;
use crate::base::math::simd::{F64x4, SimdKernel, with_widest};

/// The pixels of a tile, with the row above and the column left of it, in row-major order.
pub(super) struct Centres {
    width: usize,
    pixels: Vec<Pixel>,
    /// The grades, channel by channel; each channel is padded to a whole SIMD vector.
    grades: [Vec<f64>; 4],
}

/// True where a centre differs from its left neighbour, and from its upper neighbour.
pub(super) type Apart = [bool; 2];

impl Centres {
    /// Starts with black pixels.
    pub(super) fn new(width: usize, height: usize) -> Self {
        let count = width * height;
        Centres {
            width,
            pixels: vec![Pixel::default(); count],
            grades: std::array::from_fn(|_| vec![0.0; count + 4]),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.pixels.len()
    }

    pub(super) fn into_pixels(self) -> Vec<Pixel> {
        self.pixels
    }

    pub(super) fn pixel(&self, at: usize) -> Pixel {
        self.pixels[at]
    }

    pub(super) fn graded(&self, at: usize) -> Graded {
        Graded {
            pixel: self.pixels[at],
            grades: std::array::from_fn(|channel| self.grades[channel][at]),
        }
    }

    /// Stores a graded pixel.
    pub(super) fn put_graded(&mut self, at: usize, graded: Graded) {
        self.pixels[at] = graded.pixel;
        for (channel, grade) in self.grades.iter_mut().zip(graded.grades) {
            channel[at] = grade;
        }
    }

    /// Stores all pixels, row by row, and grades them.
    pub(super) fn put_all(&mut self, pixels: Vec<Pixel>, scale: &Scale) {
        self.pixels = pixels;
        if !scale.has_estimates() {
            for at in 0..self.len() {
                self.put_graded(at, scale.graded(self.pixels[at]));
            }
            return;
        }
        for (at, pixel) in self.pixels.iter().enumerate() {
            for (channel, value) in self.grades.iter_mut().zip(scale.values(*pixel)) {
                channel[at] = value;
            }
        }
        // Transmit is compared without a power.
        let colors = &mut self.grades[..3];
        with_widest(
            #[inline(always)]
            |lanes| lanes.run(Grading(colors, scale.exponent)),
        );
    }

    /// Compares each centre with its left and its upper neighbour, where it has both.
    pub(super) fn compare(&self, scale: &Scale, threshold: f64) -> Vec<Apart> {
        let mut apart = vec![[false; 2]; self.len()];
        with_widest(
            #[inline(always)]
            |lanes| {
                let work = Comparing {
                    centres: self,
                    scale,
                    threshold,
                    apart: &mut apart,
                };
                lanes.run(work);
            },
        );
        apart
    }

    /// Offsets from a centre back to its left and its upper neighbour.
    pub(super) fn neighbours(&self) -> [usize; 2] {
        [1, self.width]
    }
}

/// Replaces values by estimates of their powers.
struct Grading<'a>(&'a mut [Vec<f64>], f64);

impl SimdKernel for Grading<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: F64x4>(self) {
        let Grading(channels, exponent) = self;
        for channel in channels {
            for values in channel.as_chunks_mut::<4>().0 {
                *values = power(F::from_array(values), exponent).to_array();
            }
        }
    }
}

/// Compares the centres of all pixels that have neighbours.
struct Comparing<'a> {
    centres: &'a Centres,
    scale: &'a Scale,
    threshold: f64,
    apart: &'a mut [Apart],
}

impl Comparing<'_> {
    /// For four pixels: a mask of those that surely differ from the pixels `before` positions earlier, and a mask of
    /// unsure ones.
    #[inline(always)]
    fn compare4<F: F64x4>(&self, at: usize, before: usize) -> (u32, u32) {
        let (mut size, mut difference) = (F::splat(0.0), F::splat(0.0));
        for channel in &self.centres.grades[..self.scale.channels()] {
            let load = |at: usize| {
                let first = channel.get(at..).and_then(|rest| rest.first_chunk());
                first.map_or(F::splat(0.0), F::from_array)
            };
            let (a, b) = (load(at), load(at - before));
            size = size + (a + b);
            difference = difference + (a - b).abs();
        }
        let [share, more] = GRADE_CARE;
        let threshold = F::splat(self.threshold);
        let care = F::splat(share) * size + F::splat(more);
        let is_sure = size.lt(F::splat(ENDLESS)) & care.lt((difference - threshold).abs());
        let differ = F::bitmask(is_sure & threshold.lt(difference));
        (differ, 0b1111 & !F::bitmask(is_sure))
    }
}

impl SimdKernel for Comparing<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: F64x4>(self) {
        let centres = self.centres;
        for row in (centres.width..centres.len()).step_by(centres.width) {
            for first in (1..centres.width).step_by(4) {
                let count = (centres.width - first).min(4);
                for (side, before) in centres.neighbours().into_iter().enumerate() {
                    let (mut differ, unsure) = self.compare4::<F>(row + first, before);
                    if differ | unsure == 0 {
                        continue;
                    }
                    for lane in 0..count {
                        let at = row + first + lane;
                        if unsure >> lane & 1 == 1 {
                            let [one, other] = [at, at - before].map(|at| centres.graded(at));
                            let differs = self.scale.differ(&one, &other, self.threshold);
                            differ |= u32::from(differs) << lane;
                        }
                        self.apart[at][side] = differ >> lane & 1 == 1;
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::color::{Gamma, Rgb};
    use crate::base::math::rounding::nearest;
    use crate::base::math::sampling::random::Random;

    #[test]
    fn centres_compare_like_single_pixels() {
        let mut rng = Random::new(11);
        for (width, height, exponent) in [(33, 5, 0.4), (7, 6, 0.88), (2, 2, 1.0), (6, 3, 3.0)] {
            let scale = Scale {
                working: Gamma::LINEAR,
                exponent,
                has_alpha: true,
            };
            let mut pixel = || {
                let [r, g, b, transmit] = [(); 4].map(|()| nearest(rng.uniform()));
                Pixel::new(Rgb::new(r, g, b), transmit)
            };
            let pixels: Vec<Pixel> = (0..width * height).map(|_| pixel()).collect();
            let mut centres = Centres::new(width, height);
            centres.put_all(pixels.clone(), &scale);
            let graded: Vec<Graded> = pixels.iter().map(|&pixel| scale.graded(pixel)).collect();
            for threshold in [0.3, 0.6, 1.0] {
                let apart = centres.compare(&scale, threshold);
                for at in (0..width * height).filter(|at| at / width > 0 && at % width > 0) {
                    let expected = [at - 1, at - width]
                        .map(|other| scale.differ(&graded[at], &graded[other], threshold));
                    assert_eq!(apart[at], expected, "{at} of {width} x {height}");
                }
            }
        }
    }
}

//! The widest instructions of the machine, chosen at run time.
//!
//! A program for every x86-64 has lanes of 128 bits; most machines have 256. Work handed to [`with_widest`] is compiled
//! twice, and the machine takes the one it can run. Both give the same bits: they differ in how many numbers one
//! instruction takes, and neither fuses a product with a sum.
//!
//! Only what is inlined into the work is compiled twice: hot loops say `#[inline(always)]`.
#![allow(
    unsafe_code,
    reason = "a function for a machine known only at run time cannot be called otherwise"
)]

mod four;

#[cfg(test)]
pub(crate) use four::four_anywhere;
pub(crate) use four::{Four, FourKernel, four};

/// Does the work with 256 bits at once where the machine can.
#[inline]
pub(crate) fn with_widest<R>(work: impl FnOnce() -> R) -> R {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: `with_wide` needs nothing but the instructions that this machine has just said it has.
        return unsafe { with_wide(work) };
    }
    work()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_wide<R>(work: impl FnOnce() -> R) -> R {
    work()
}

/// Eight numbers in single precision, worked on together. Where one of two is not a number, `smaller` and `larger` give
/// the second.
pub(crate) trait Eight: Copy {
    fn all(x: f32) -> Self;
    fn load(from: &[f32; 8]) -> Self;
    fn store(self) -> [f32; 8];
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    fn over(self, other: Self) -> Self;
    fn smaller(self, other: Self) -> Self;
    fn larger(self, other: Self) -> Self;
    fn size(self) -> Self;
    /// One bit for each pair of which the first is not above the second; none where one is not a number.
    fn not_above(self, other: Self) -> u32;
}

/// Work on eight numbers at once, written once for every machine.
pub(crate) trait Kernel {
    type Answer;
    fn run<E: Eight>(&self) -> Self::Answer;
}

/// Runs a kernel with 256 bits at once where the machine can.
#[inline(always)]
pub(crate) fn eight<K: Kernel>(kernel: &K) -> K::Answer {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the machine has just said that it has the instructions.
        return unsafe { eight_wide(kernel) };
    }
    kernel.run::<[f32; 8]>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline]
fn eight_wide<K: Kernel>(kernel: &K) -> K::Answer {
    kernel.run::<std::arch::x86_64::__m256>()
}

/// Anywhere.
impl Eight for [f32; 8] {
    #[inline(always)]
    fn all(x: f32) -> Self {
        [x; 8]
    }
    #[inline(always)]
    fn load(from: &[f32; 8]) -> Self {
        *from
    }
    #[inline(always)]
    fn store(self) -> [f32; 8] {
        self
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] + other[i])
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] - other[i])
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] * other[i])
    }
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] / other[i])
    }
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        std::array::from_fn(|i| {
            if self[i] < other[i] {
                self[i]
            } else {
                other[i]
            }
        })
    }
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        std::array::from_fn(|i| {
            if self[i] > other[i] {
                self[i]
            } else {
                other[i]
            }
        })
    }
    #[inline(always)]
    fn size(self) -> Self {
        self.map(f32::abs)
    }
    #[inline(always)]
    fn not_above(self, other: Self) -> u32 {
        (0..8).fold(0, |bits, i| bits | u32::from(self[i] <= other[i]) << i)
    }
}

/// Only for work that runs inside [`eight_wide`].
#[cfg(target_arch = "x86_64")]
mod wide {
    use super::Eight;
    use std::arch::x86_64::*;

    macro_rules! each {
        ($($name:ident by $intrinsic:ident),+) => {
            $(
                #[inline(always)]
                fn $name(self, other: Self) -> Self {
                    // SAFETY: such numbers are made by `all` and `load` alone, on machines that have the instructions.
                    unsafe { $intrinsic(self, other) }
                }
            )+
        };
    }

    impl Eight for __m256 {
        #[inline(always)]
        fn all(x: f32) -> Self {
            // SAFETY: called by work inside `eight_wide` alone.
            unsafe { _mm256_set1_ps(x) }
        }
        #[inline(always)]
        fn load(from: &[f32; 8]) -> Self {
            // SAFETY: called by work inside `eight_wide` alone, and an array of eight floats is what is read.
            unsafe { _mm256_loadu_ps(from.as_ptr()) }
        }
        #[inline(always)]
        fn store(self) -> [f32; 8] {
            let mut to = [0.0; 8];
            // SAFETY: as in `load`.
            unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self) };
            to
        }
        each! {
            plus by _mm256_add_ps,
            minus by _mm256_sub_ps,
            times by _mm256_mul_ps,
            over by _mm256_div_ps,
            smaller by _mm256_min_ps,
            larger by _mm256_max_ps
        }
        #[inline(always)]
        fn size(self) -> Self {
            // SAFETY: as in the others.
            unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self) }
        }
        #[inline(always)]
        fn not_above(self, other: Self) -> u32 {
            // SAFETY: as in the others.
            unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self, other)) }.cast_unsigned()
        }
    }
}

/// Eight boxes against a ray, as the planes that the ray meets first and last on each axis, and the ray as the numbers
/// that make the former nearer and the latter farther.
#[derive(Clone, Copy)]
pub(crate) struct Slabs<'a> {
    pub(crate) first: [&'a [f32; 8]; 3],
    pub(crate) last: [&'a [f32; 8]; 3],
    pub(crate) near: [f32; 3],
    pub(crate) far: [f32; 3],
    pub(crate) inverse: [f32; 3],
    /// The stretch of the ray that counts.
    pub(crate) from: f32,
    pub(crate) to: f32,
    /// The share by which results are moved outward.
    pub(crate) error: f32,
}

impl Slabs<'_> {
    /// Where the ray enters each box at the earliest, and which boxes it may meet, one bit each.
    #[inline(always)]
    pub(crate) fn meet(&self) -> ([f32; 8], u32) {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the machine has just said that it has the instructions.
            return unsafe { self.meet_wide() };
        }
        self.meet_anywhere()
    }

    #[inline(always)]
    fn meet_anywhere(&self) -> ([f32; 8], u32) {
        // The second where the first is not a number (zero times infinity in a plane along the ray).
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let smaller = |a: f32, b: f32| if a < b { a } else { b };
        let mut enter = [self.from; 8];
        let mut leave = [self.to; 8];
        for axis in 0..3 {
            let (near, far, inverse) = (self.near[axis], self.far[axis], self.inverse[axis]);
            for i in 0..8 {
                enter[i] = larger((self.first[axis][i] - near) * inverse, enter[i]);
                leave[i] = smaller((self.last[axis][i] - far) * inverse, leave[i]);
            }
        }
        let mut met = 0;
        for i in 0..8 {
            enter[i] -= enter[i].abs() * self.error + f32::MIN_POSITIVE;
            leave[i] += leave[i].abs() * self.error + f32::MIN_POSITIVE;
            // False for NaN: infinitely far beside a plane that the ray runs along.
            met |= u32::from(enter[i] <= leave[i]) << i;
        }
        (enter, met)
    }

    /// The same to the bit.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    #[inline]
    fn meet_wide(&self) -> ([f32; 8], u32) {
        use std::arch::x86_64::*;
        // SAFETY: an array of eight floats is what is read.
        let load = |planes: &[f32; 8]| unsafe { _mm256_loadu_ps(planes.as_ptr()) };
        let all = |x: f32| _mm256_set1_ps(x);
        let mut enter = all(self.from);
        let mut leave = all(self.to);
        for axis in 0..3 {
            let inverse = all(self.inverse[axis]);
            let to_first = _mm256_sub_ps(load(self.first[axis]), all(self.near[axis]));
            let to_last = _mm256_sub_ps(load(self.last[axis]), all(self.far[axis]));
            enter = _mm256_max_ps(_mm256_mul_ps(to_first, inverse), enter);
            leave = _mm256_min_ps(_mm256_mul_ps(to_last, inverse), leave);
        }
        let sign = all(-0.0);
        let slack = |t: __m256| {
            let share = _mm256_mul_ps(_mm256_andnot_ps(sign, t), all(self.error));
            _mm256_add_ps(share, all(f32::MIN_POSITIVE))
        };
        let enter = _mm256_sub_ps(enter, slack(enter));
        let leave = _mm256_add_ps(leave, slack(leave));
        let met = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave));
        let mut earliest = [0.0; 8];
        // SAFETY: an array of eight floats is what is written.
        unsafe { _mm256_storeu_ps(earliest.as_mut_ptr(), enter) };
        (earliest, met.cast_unsigned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::math::rounding::nearest;

    #[test]
    fn wide_and_narrow_lanes_give_the_same_bits() {
        let mut rng = Random::new(9);
        let special = [0.0, -0.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-40];
        let mut any = 0;
        for round in 0..20_000_usize {
            let mut number = || {
                let bits = usize::try_from(rng.bits() % 64).expect("small");
                special
                    .get(bits)
                    .copied()
                    .unwrap_or_else(|| nearest(rng.share() - 0.5))
            };
            let mut three = || [number(), number(), number()];
            let (near, far, inverse) = (three(), three(), three());
            let planes = [(); 6].map(|()| [(); 8].map(|()| number()));
            let [a, b, c, d, e, f] = &planes;
            let slabs = Slabs {
                first: [a, b, c],
                last: [d, e, f],
                near,
                far,
                inverse,
                from: if round % 3 == 0 {
                    f32::NEG_INFINITY
                } else {
                    0.0
                },
                to: if round % 2 == 0 { f32::INFINITY } else { 1.0 },
                error: f32::EPSILON,
            };
            let (wide, narrow) = (slabs.meet(), slabs.meet_anywhere());
            assert_eq!(wide.1, narrow.1);
            assert!((0..8).all(|i| wide.0[i].to_bits() == narrow.0[i].to_bits()
                || wide.0[i].is_nan() && narrow.0[i].is_nan()));
            any += wide.1.count_ones();
        }
        assert!(any > 1000);
    }

    #[test]
    fn the_work_is_done_once() {
        let mut count = 0;
        assert_eq!(
            with_widest(|| {
                count += 1;
                7
            }),
            7
        );
        assert_eq!(count, 1);
    }
}

//! The widest instructions of the machine, chosen at run time.
//!
//! A program for every x86-64 has lanes of 128 bits; most machines have 256 (AVX2). Work handed to [`with_widest`] is
//! compiled for both, and the machine takes the better that it can run. Both give the same bits: they differ in how many
//! numbers one instruction takes, and neither fuses a product with a sum.
//!
//! AVX-512 is not used. The masks that it has for lanes of 256 bits took 2 to 8 % off the time of tracing spheres on a
//! Zen 5, but with it the compiler copies 64 bytes at a time, also where they have just been written as twice 32, for which
//! an Intel Xeon waits: there tracing took 10 to 25 % longer than with AVX2 in all scenes of the bench but the mirrors.
//!
//! Only what is inlined into the work is compiled so: hot loops say `#[inline(always)]`.
#![allow(
    unsafe_code,
    reason = "a function for a machine known only at run time cannot be called otherwise"
)]

mod four;
pub(crate) mod three;

pub(crate) use four::{F64Lanes, F64x4, FourKernel, FourWork, four, fours};
use std::sync::atomic::{AtomicU8, Ordering};

/// Which lanes the machine has. Work that is compiled for them knows the answer when it is compiled: so a kernel within
/// it asks nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SimdLevel {
    /// Only ever true on machines that have said so.
    are_wide: bool,
}

impl SimdLevel {
    /// Those of any machine.
    pub(crate) const NARROW: SimdLevel = SimdLevel { are_wide: false };

    /// Those of the machine at hand.
    #[cfg(test)]
    pub(crate) fn widest() -> Self {
        SimdLevel {
            are_wide: Machine::at_hand() != Machine::Any,
        }
    }
}

/// What a machine can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Machine {
    /// What all can.
    Any,
    /// AVX2, and the instructions for bits that came with it.
    Wide,
}

impl Machine {
    /// That at hand. The answer is kept: it is asked for with each ray.
    #[inline]
    fn at_hand() -> Self {
        /// Nothing until it is known.
        static KNOWN: AtomicU8 = AtomicU8::new(0);
        match KNOWN.load(Ordering::Relaxed) {
            1 => Machine::Any,
            2 => Machine::Wide,
            _ => {
                let machine = Machine::asked();
                KNOWN.store(machine as u8 + 1, Ordering::Relaxed);
                machine
            }
        }
    }

    #[cold]
    fn asked() -> Self {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2")
            && std::arch::is_x86_feature_detected!("bmi1")
            && std::arch::is_x86_feature_detected!("bmi2")
            && std::arch::is_x86_feature_detected!("lzcnt")
        {
            return Machine::Wide;
        }
        Machine::Any
    }
}

/// Does the work with the best that the machine can.
#[inline(always)]
pub(crate) fn with_widest<R>(work: impl FnOnce(SimdLevel) -> R) -> R {
    match Machine::at_hand() {
        Machine::Any => with_any(work),
        // SAFETY: it needs nothing but the instructions that this machine has said it has.
        #[cfg(target_arch = "x86_64")]
        Machine::Wide => unsafe { with_wide(work) },
        #[cfg(not(target_arch = "x86_64"))]
        Machine::Wide => with_any(work),
    }
}

/// Not part of whoever calls it, so that what the work takes along is handed on in place.
#[inline(never)]
fn with_any<R>(work: impl FnOnce(SimdLevel) -> R) -> R {
    work(SimdLevel::NARROW)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
fn with_wide<R>(work: impl FnOnce(SimdLevel) -> R) -> R {
    work(SimdLevel { are_wide: true })
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
    fn root(self) -> Self;
    /// One bit for each pair of which the first is not above the second; none where one is not a number.
    fn not_above(self, other: Self) -> u32;
}

/// Work on eight numbers at once, written once for every machine.
pub(crate) trait Kernel {
    type Answer;
    fn run<E: Eight>(&self) -> Self::Answer;
}

/// Runs a kernel in these lanes.
#[inline(always)]
pub(crate) fn eight<K: Kernel>(lanes: SimdLevel, kernel: &K) -> K::Answer {
    #[cfg(target_arch = "x86_64")]
    if lanes.are_wide {
        // SAFETY: lanes are wide only where the machine has the instructions.
        return unsafe { eight_wide(kernel) };
    }
    debug_assert!(!lanes.are_wide, "wide lanes are known on x86-64 alone");
    kernel.run::<[f32; 8]>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
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
    fn root(self) -> Self {
        self.map(f32::sqrt)
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
        fn root(self) -> Self {
            // SAFETY: as in the others.
            unsafe { _mm256_sqrt_ps(self) }
        }
        #[inline(always)]
        fn not_above(self, other: Self) -> u32 {
            // SAFETY: as in the others.
            unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self, other)) }.cast_unsigned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_work_is_done_once() {
        let mut count = 0;
        assert_eq!(
            with_widest(|_| {
                count += 1;
                7
            }),
            7
        );
        assert_eq!(count, 1);
    }
}

//! SIMD lanes, dispatched at run time to the widest instruction set of the machine.
//!
//! Every x86-64 machine has 128-bit registers (SSE2), most have 256-bit registers (AVX2). A [`SimdKernel`] is written
//! once over the lane traits [`F64Lanes`] and [`F32x8`] and compiled for each level; [`SimdLevel::run`] selects the
//! level. All levels and the scalar `f64` give the same bits: they differ only in the number of lanes per instruction,
//! and none uses fused multiply-add.
//!
//! The lane types are private: outside of this module they exist only as the type parameter of a kernel that
//! [`SimdLevel::run`] has started, so safe code cannot execute AVX2 on a machine without it.
//!
//! AVX-512 is not used. Its masks for 256-bit lanes made tracing spheres 2 to 8 % faster on a Zen 5. But it lets the
//! compiler copy 64 bytes at a time, even where they have just been written as twice 32. An Intel Xeon then stalls on
//! store forwarding: tracing was 10 to 25 % slower than with AVX2 in all benchmark scenes but the mirrors.
//!
//! Only code inlined into a kernel is compiled for its level: hot functions are `#[inline(always)]` and avoid closures,
//! which do not inherit the level.
#![allow(
    unsafe_code,
    reason = "functions for a level known only at run time cannot be called otherwise"
)]

#[cfg(target_arch = "x86_64")]
mod avx2;
mod lanes;
#[cfg(any(test, not(target_arch = "x86_64")))]
mod portable;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod sse2;
pub(crate) mod vec3;

pub(crate) use lanes::{F32x8, F64Lanes, F64x4};
use std::sync::atomic::{AtomicU8, Ordering};

/// The lanes that every machine of the target supports.
#[cfg(target_arch = "x86_64")]
type Baseline = sse2::F64x4Sse2;
#[cfg(not(target_arch = "x86_64"))]
type Baseline = portable::F64x4Portable;

/// An instruction set level, and the proof that the machine supports it: only [`with_widest`] creates wide levels.
/// The level is a constant within code compiled for it, so kernels do not test it at run time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SimdLevel {
    is_wide: bool,
}

/// A computation over lanes, written once for all levels.
pub(crate) trait SimdKernel {
    type Output;
    fn run<F: F64x4>(self) -> Self::Output;
}

impl SimdLevel {
    /// The baseline level of the target.
    pub(crate) const NARROW: SimdLevel = SimdLevel { is_wide: false };

    /// The widest level of this machine.
    #[cfg(test)]
    pub(crate) fn widest() -> Self {
        SimdLevel {
            is_wide: Machine::detected() == Machine::Avx2,
        }
    }

    /// Runs a kernel with the lanes of this level.
    #[inline(always)]
    pub(crate) fn run<K: SimdKernel>(self, kernel: K) -> K::Output {
        #[cfg(target_arch = "x86_64")]
        if self.is_wide {
            // SAFETY: a level is wide only where the machine has reported the instructions.
            return unsafe { run_wide(kernel) };
        }
        debug_assert!(!self.is_wide, "only x86-64 has a wide level");
        run_baseline(kernel)
    }
}

/// Not inlined: most machines never run it, and compiling each kernel once instead of in each caller saves minutes of
/// build time.
#[inline(never)]
fn run_baseline<K: SimdKernel>(kernel: K) -> K::Output {
    kernel.run::<Baseline>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
#[inline]
fn run_wide<K: SimdKernel>(kernel: K) -> K::Output {
    kernel.run::<avx2::F64x4Avx2>()
}

/// The instruction set of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Machine {
    /// The instructions that every machine of the target supports.
    Baseline,
    /// AVX2 with the bit manipulation instructions (BMI1, BMI2, LZCNT).
    Avx2,
}

impl Machine {
    /// The instruction set of this machine, cached because every ray needs it.
    #[inline]
    fn detected() -> Self {
        /// 0 until detected.
        static DETECTED: AtomicU8 = AtomicU8::new(0);
        match DETECTED.load(Ordering::Relaxed) {
            1 => Machine::Baseline,
            2 => Machine::Avx2,
            _ => {
                let machine = Machine::detect();
                DETECTED.store(machine as u8 + 1, Ordering::Relaxed);
                machine
            }
        }
    }

    #[cold]
    fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2")
            && std::arch::is_x86_feature_detected!("bmi1")
            && std::arch::is_x86_feature_detected!("bmi2")
            && std::arch::is_x86_feature_detected!("lzcnt")
        {
            return Machine::Avx2;
        }
        Machine::Baseline
    }
}

/// Runs `work` in a copy compiled for the widest level of the machine.
#[inline(always)]
pub(crate) fn with_widest<R>(work: impl FnOnce(SimdLevel) -> R) -> R {
    match Machine::detected() {
        Machine::Baseline => with_baseline(work),
        // SAFETY: `with_wide` needs nothing but the instructions that the machine has reported.
        #[cfg(target_arch = "x86_64")]
        Machine::Avx2 => unsafe { with_wide(work) },
        #[cfg(not(target_arch = "x86_64"))]
        Machine::Avx2 => with_baseline(work),
    }
}

/// Not inlined, so that the caller passes the captures of `work` by reference and grows by a single call.
#[inline(never)]
fn with_baseline<R>(work: impl FnOnce(SimdLevel) -> R) -> R {
    work(SimdLevel::NARROW)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt")]
fn with_wide<R>(work: impl FnOnce(SimdLevel) -> R) -> R {
    work(SimdLevel { is_wide: true })
}

#[cfg(test)]
mod tests;

//! How the allocator of the system treats large pieces of memory.
//!
//! A scene is read into very many small pieces and prepared for rays in a few large ones. The allocator of glibc learns
//! from the first large piece given back to it to put all later ones between the small ones, where each stands in the way
//! of the next: 100,000 copies took half as much again.
//!
//! Large pages below the largest pieces were tried: they spare three page faults of four, but on a virtual machine whose
//! host has yet to give the memory they cost more than that, and a million balls took up to a third longer.
#![allow(
    unsafe_code,
    reason = "the C library is asked, by functions that may be called at any time, and lines are sent for by their address"
)]

/// Larger pieces of memory stand by themselves, and are given back to the system at once when they are no longer needed.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const LARGE: i32 = 1 << 18;

/// Lets large pieces of memory stand by themselves. For a program to call at its start.
pub fn set_mmap_threshold() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // Fails only for numbers that the allocator has no use for, and then nothing changes.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE);
    }
}

/// Sends for what will be read a little later, so that nobody waits for it then.
#[inline(always)]
pub(crate) fn prefetch<T>(what: &T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // Changes nothing, whatever lies there.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(what).cast()) }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = what;
}

/// Gives back to the system what many small pieces have left free.
pub(crate) fn trim_heap() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    unsafe {
        libc::malloc_trim(0);
    }
}

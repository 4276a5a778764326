//! Tuning of the system allocator, and prefetching.
//!
//! Reading a scene allocates very many small blocks, lowering it a few large ones. When the first large block is freed,
//! glibc raises its mmap threshold and puts all later ones into the heap between the small blocks, which fragments it:
//! 100,000 copies took half as much memory again.
//!
//! Huge pages below the largest blocks were tried. They avoid three page faults of four, but on a virtual machine whose
//! host has not yet committed the memory they cost more than that: a million spheres took up to a third longer.
#![allow(
    unsafe_code,
    reason = "the C library is asked, by functions that may be called at any time, and lines are sent for by their address"
)]

mod system;

use std::sync::atomic::{AtomicBool, Ordering};

pub(crate) use system::{Taken, address_space_limit, available, left};

/// Blocks of at least this size are mapped on their own, and unmapped as soon as they are freed.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const MMAP_THRESHOLD: i32 = 1 << 18;

/// True in a program of povr's own, whose allocator serves nobody else.
static OWNS_HEAP: AtomicBool = AtomicBool::new(false);

/// Makes the heap of this process povr's own: renders return its free memory to the system from now on, and glibc's
/// mmap threshold is fixed, so that large blocks stay out of it. Programs call this at start; in the process of
/// somebody else the allocator stays as it is.
pub fn claim_heap() {
    OWNS_HEAP.store(true, Ordering::Relaxed);
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: takes plain integers; an invalid value is rejected without effect.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, MMAP_THRESHOLD);
    }
}

/// Prefetches a value that will be read soon, into all cache levels.
#[inline(always)]
pub(crate) fn prefetch<T>(what: &T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch has no effect on memory, whatever the address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(what).cast()) }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = what;
}

/// Returns the free memory of the heap to the system, if the heap is povr's own ([`claim_heap`]).
pub(crate) fn trim_heap() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    if OWNS_HEAP.load(Ordering::Relaxed) {
        unsafe {
            libc::malloc_trim(0);
        }
    }
}

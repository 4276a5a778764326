//! How the allocator of the system treats large pieces of memory.
//!
//! A scene is read into very many small pieces and prepared for rays in a few large ones. The allocator of glibc learns
//! from the first large piece given back to it to put all later ones between the small ones, where each stands in the way
//! of the next: 100,000 copies took half as much again.
//!
//! A page of 4 kB that is touched for the first time costs some 3 µs on a virtual machine, a third of what it takes to
//! read and prepare a million balls. So the system is asked for pages of 2 MB below the largest pieces, where it lets
//! programs ask.
#![allow(
    unsafe_code,
    reason = "the C library is asked; its functions may be called at any time"
)]

use std::alloc::{GlobalAlloc, Layout, System};

/// Larger pieces of memory stand by themselves, and are given back to the system at once when they are no longer needed.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const LARGE: i32 = 1 << 18;

/// Below pieces of this size large pages are of use: they are filled, but for the last.
const HUGE: usize = 1 << 22;

/// What pages of any machine begin at a multiple of.
#[cfg(target_os = "linux")]
const PAGE: usize = 1 << 12;

/// The allocator of the system, with large pages below the largest pieces. For a program to use.
#[derive(Clone, Copy, Debug, Default)]
pub struct LargePages;

// SAFETY: all is left to the allocator of the system, and a hint on how pages are to be mapped changes nothing in them.
unsafe impl GlobalAlloc for LargePages {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises are those that the system asks for.
        let piece = unsafe { System.alloc(layout) };
        want_large_pages(piece, layout.size());
        piece
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as in `alloc`.
        let piece = unsafe { System.alloc_zeroed(layout) };
        want_large_pages(piece, layout.size());
        piece
    }

    unsafe fn realloc(&self, old: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as in `alloc`.
        let piece = unsafe { System.realloc(old, layout, size) };
        if size > layout.size() {
            want_large_pages(piece, size);
        }
        piece
    }

    unsafe fn dealloc(&self, piece: *mut u8, layout: Layout) {
        // SAFETY: as in `alloc`.
        unsafe { System.dealloc(piece, layout) };
    }
}

/// Asks for large pages below a piece of memory if it is large.
#[inline]
fn want_large_pages(piece: *mut u8, size: usize) {
    #[cfg(target_os = "linux")]
    if size >= HUGE && !piece.is_null() {
        let before = piece.addr() % PAGE;
        // SAFETY: the pages of the piece are there. A system that has no large pages says so, and that is all.
        unsafe {
            libc::madvise(
                piece.wrapping_sub(before).cast(),
                size + before,
                libc::MADV_HUGEPAGE,
            );
        }
    }
    #[cfg(not(target_os = "linux"))]
    let _ = (piece, size, HUGE);
}

/// Lets large pieces of memory stand by themselves. For a program to call at its start.
pub fn keep_large_pieces_apart() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // Fails only for numbers that the allocator has no use for, and then nothing changes.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE);
    }
}

/// Gives back to the system what many small pieces have left free.
pub(crate) fn give_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    unsafe {
        libc::malloc_trim(0);
    }
}

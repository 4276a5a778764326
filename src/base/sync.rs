//! Locks that outlive a panic, and threads with deep stacks.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// The stack for reading, comparing and lowering, which recurse once for each level of nesting in the scene. It is
/// reserved, not committed, until a scene nests that deep.
pub(crate) const STACK_BYTES: usize = 1 << 30;

/// Locks a mutex, even if a thread has panicked while it held it.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A builder of threads with stacks of [`STACK_BYTES`].
pub(crate) fn deep_thread(name: &str) -> std::thread::Builder {
    let thread = std::thread::Builder::new();
    thread.name(name.to_owned()).stack_size(STACK_BYTES)
}

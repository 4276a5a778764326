//! Sharing of equal values: many objects of a scene have the same finish or interior.

use super::Args;
use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

/// Number of recent values that a new one is compared with.
const CAPACITY: usize = 4;

/// Cache of the most recent values, one `Arc` for all equal ones.
#[derive(Debug, Default)]
pub struct Interner(RefCell<Recent>);

#[derive(Debug, Default)]
struct Recent {
    values: [Option<Arc<dyn Any + Send + Sync>>; CAPACITY],
    /// Slot of the oldest value, which is replaced next.
    oldest: usize,
}

impl Interner {
    /// Returns the cached value if an equal one exists, otherwise caches the new one.
    fn share<T: Any + Send + Sync + PartialEq>(&self, value: T) -> Arc<T> {
        let mut recent = self.0.borrow_mut();
        let cached = recent.values.iter().flatten().find_map(|cached| {
            let cached = Arc::clone(cached).downcast::<T>().ok()?;
            (*cached == value).then_some(cached)
        });
        if let Some(cached) = cached {
            return cached;
        }
        let value = Arc::new(value);
        let oldest = recent.oldest;
        recent.values[oldest] = Some(value.clone());
        recent.oldest = (oldest + 1) % CAPACITY;
        value
    }
}

/// Wraps a value in an `Arc`, shared with equal values that were read recently.
pub fn interned<T: Any + Send + Sync + PartialEq>(args: &dyn Args, value: T) -> Arc<T> {
    match args.interner() {
        Some(interner) => interner.share(value),
        None => Arc::new(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_are_shared_until_newer_ones_replace_them() {
        let interner = Interner::default();
        let first = interner.share(String::from("a"));
        for other in ["b", "c", "d"] {
            let other = interner.share(String::from(other));
            assert!(!Arc::ptr_eq(&first, &other));
            assert!(Arc::ptr_eq(&first, &interner.share(String::from("a"))));
        }
        interner.share(7);
        assert!(!Arc::ptr_eq(&first, &interner.share(String::from("a"))));
    }
}

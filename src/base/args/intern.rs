//! What many objects say alike, kept once.

use super::Args;
use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

/// So many values are compared with a new one.
const MOST: usize = 4;

/// The values that were read last.
#[derive(Debug, Default)]
pub struct Interner(RefCell<Last>);

#[derive(Debug, Default)]
struct Last {
    values: [Option<Arc<dyn Any + Send + Sync>>; MOST],
    /// The oldest, which gives way next.
    oldest: usize,
}

impl Interner {
    /// One of the values if it is equal, or else the new one, which is then among them.
    fn share<T: Any + Send + Sync + PartialEq>(&self, value: T) -> Arc<T> {
        let mut last = self.0.borrow_mut();
        let known = last.values.iter().flatten().find_map(|known| {
            let known = Arc::clone(known).downcast::<T>().ok()?;
            (*known == value).then_some(known)
        });
        if let Some(known) = known {
            return known;
        }
        let value = Arc::new(value);
        let oldest = last.oldest;
        last.values[oldest] = Some(value.clone());
        last.oldest = (oldest + 1) % MOST;
        value
    }
}

/// A value that was read, kept once if others before it said the same.
pub fn alike<T: Any + Send + Sync + PartialEq>(args: &dyn Args, value: T) -> Arc<T> {
    match args.alike() {
        Some(known) => known.share(value),
        None => Arc::new(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_equal_is_kept_once_until_four_others_have_come() {
        let known = Interner::default();
        let first = known.share(String::from("a"));
        for other in ["b", "c", "d"] {
            let other = known.share(String::from(other));
            assert!(!Arc::ptr_eq(&first, &other));
            assert!(Arc::ptr_eq(&first, &known.share(String::from("a"))));
        }
        known.share(7);
        assert!(!Arc::ptr_eq(&first, &known.share(String::from("a"))));
    }
}

//! Comparison of the values of two readings of a scene.
//!
//! Values are alike if their `Debug` texts are equal: these name every field, and tell all numbers apart whose bits
//! differ. Long texts, as of pictures, are not compared; such values count as different.

use rustc_hash::FxHashMap;
use std::fmt::{self, Debug, Write};
use std::sync::Arc;

/// Longest text that is compared, in bytes.
const LONGEST: usize = 1 << 18;

/// The results of comparisons, by the addresses of values that stay.
#[derive(Debug, Default)]
pub(crate) struct Likeness {
    known: FxHashMap<[usize; 2], bool>,
    count: usize,
}

impl Likeness {
    /// Number of texts compared so far.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// True if two values are alike.
    pub(crate) fn alike(&mut self, a: &impl Debug, b: &impl Debug) -> bool {
        self.count += 1;
        alike(a, b)
    }

    /// True if two shared values are alike. Both have to live as long as this.
    pub(crate) fn same<T: Debug>(&mut self, a: &Arc<T>, b: &Arc<T>) -> bool {
        if Arc::ptr_eq(a, b) {
            return true;
        }
        let key = [a, b].map(|one| Arc::as_ptr(one).addr());
        let count = &mut self.count;
        let result = self.known.entry(key);
        *result.or_insert_with(|| {
            *count += 1;
            alike(&**a, &**b)
        })
    }
}

/// True if two values are alike.
pub(crate) fn alike(a: &impl Debug, b: &impl Debug) -> bool {
    let mut text = Limited(String::new());
    if write!(text, "{a:?}").is_err() {
        return false;
    }
    let mut rest = Expected(text.0.as_bytes());
    write!(rest, "{b:?}").is_ok() && rest.0.is_empty()
}

/// The text of a value, unless it is long.
pub(crate) fn text_of(value: &impl Debug) -> Option<String> {
    let mut text = Limited(String::new());
    write!(text, "{value:?}").is_ok().then_some(text.0)
}

/// A text that does not grow beyond [`LONGEST`].
struct Limited(String);

impl Write for Limited {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        if self.0.len() + more.len() > LONGEST {
            return Err(fmt::Error);
        }
        self.0.push_str(more);
        Ok(())
    }
}

/// The rest of a text that is to be written once more.
struct Expected<'a>(&'a [u8]);

impl Write for Expected<'_> {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        let rest = self.0.strip_prefix(more.as_bytes());
        self.0 = rest.ok_or(fmt::Error)?;
        Ok(())
    }
}

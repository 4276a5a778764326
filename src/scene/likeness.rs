//! Comparison of the values of two readings of a scene.
//!
//! Values are alike if their `Debug` texts are equal: these name every field, and tell all numbers apart whose bits
//! differ. Texts that are too long, as of pictures, are not compared; such values count as different.

use rustc_hash::FxHashMap;
use std::fmt::{self, Debug, Write};
use std::sync::Arc;

/// Longest text of a value that is compared alone, in bytes.
const LONGEST: usize = 1 << 18;
/// Length of all texts that are compared by one [`Likeness`], in bytes. That takes one or two tenths of a second.
const BUDGET: usize = 1 << 24;

/// The results of comparisons, by the addresses of values that stay.
#[derive(Debug)]
pub(crate) struct Likeness {
    known: FxHashMap<[usize; 2], bool>,
    /// The text of the last value, whose memory is used again.
    text: String,
    /// The rest of the [`BUDGET`].
    left: usize,
}

impl Default for Likeness {
    fn default() -> Self {
        Likeness {
            known: FxHashMap::default(),
            text: String::new(),
            left: BUDGET,
        }
    }
}

impl Likeness {
    /// True if two values are alike; false as well once the texts are too long.
    pub(crate) fn alike(&mut self, a: &impl Debug, b: &impl Debug) -> bool {
        let mut text = std::mem::take(&mut self.text);
        text.clear();
        let result = alike_within(self.left, &mut text, a, b);
        self.left = self.left.saturating_sub(text.len().max(1));
        self.text = text;
        result
    }

    /// True if two shared values are alike. Both have to live as long as this.
    pub(crate) fn same<T: Debug>(&mut self, a: &Arc<T>, b: &Arc<T>) -> bool {
        self.known_or(a, b, |likeness| likeness.alike(&**a, &**b))
    }

    /// The result of an earlier comparison of two shared values, or of this one. Both have to live as long as this.
    pub(crate) fn known_or<T>(
        &mut self,
        a: &Arc<T>,
        b: &Arc<T>,
        compare: impl FnOnce(&mut Self) -> bool,
    ) -> bool {
        if Arc::ptr_eq(a, b) {
            return true;
        }
        let key = [a, b].map(|one| Arc::as_ptr(one).addr());
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let result = compare(self);
        self.known.insert(key, result);
        result
    }
}

/// True if two values are alike.
pub(crate) fn alike(a: &impl Debug, b: &impl Debug) -> bool {
    alike_within(LONGEST, &mut String::new(), a, b)
}

/// True if two values are alike, with texts that are no longer than this; `text` receives that of the first.
fn alike_within(longest: usize, text: &mut String, a: &impl Debug, b: &impl Debug) -> bool {
    let mut limited = Limited { text, longest };
    if write!(limited, "{a:?}").is_err() {
        return false;
    }
    let mut rest = Expected(text.as_bytes());
    write!(rest, "{b:?}").is_ok() && rest.0.is_empty()
}

/// The text of a value, unless it is long.
pub(crate) fn text_of(value: &impl Debug) -> Option<String> {
    let mut text = String::new();
    let mut limited = Limited {
        text: &mut text,
        longest: LONGEST,
    };
    write!(limited, "{value:?}").is_ok().then_some(text)
}

/// A text that does not grow beyond a length in bytes.
struct Limited<'a> {
    text: &'a mut String,
    longest: usize,
}

impl Write for Limited<'_> {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        if self.text.len() + more.len() > self.longest {
            return Err(fmt::Error);
        }
        self.text.push_str(more);
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

//! Indices of objects and of the tables that hold their parts.

/// The index behind `len` entries. Panics from 2^32 on, which the limits of the language exclude.
pub(super) fn index(len: usize) -> u32 {
    u32::try_from(len).expect("the number of objects is limited below 2^32")
}

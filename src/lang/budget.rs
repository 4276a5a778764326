//! Limits on reading: tokens read again by loops and macros, and memory.
//!
//! Memory is not counted but measured from time to time, from what the system reports of the process. Where it reports
//! nothing, only the limits on counts hold.

use super::limits;
use crate::base::memory::{Taken, address_space_limit, available};
use crate::scene::{Children, Object};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Limits of a run, and how much of them is used up.
#[derive(Debug)]
pub(super) struct Budget {
    /// Number of tokens read again so far.
    pub(super) reread: u64,
    pub(super) objects: u64,
    /// Primitives of the scene once it is compiled.
    pub(super) leaves: u64,
    /// The same, each counted as often as it is drawn.
    pub(super) shown: u64,
    pub(super) shared: Shared,
    /// Bytes taken since memory was last measured.
    pub(super) unmeasured: u64,
    pub(super) memory: Memory,
}

impl Budget {
    /// The memory that is available now, but at most `part` bytes.
    pub(super) fn new(part: Option<u64>) -> Self {
        Budget {
            reread: 0,
            objects: 0,
            leaves: 0,
            shown: 0,
            shared: Shared::default(),
            unmeasured: 0,
            memory: Memory::now(part),
        }
    }

    /// True if there is memory for the tokens of a text.
    pub(super) fn has_memory_for(&self, text: &str) -> bool {
        let bytes = text.len() as u64 * limits::FILE_BYTES;
        bytes < limits::MEMORY_STEP || self.memory.allows(bytes, self.leaves)
    }
}

/// Parts that several objects share, as far as they were counted, by address. They are held so that no address is
/// reused.
#[derive(Debug, Default)]
pub(super) struct Shared(FxHashMap<usize, Children>);

impl Shared {
    /// Number of shapes and copies to prepare for an object beyond those already counted.
    pub(super) fn stored(&mut self, object: &Object) -> u64 {
        let Some(children) = object.plain_union() else {
            return u64::from(object.size().leaves);
        };
        let mut leaves = 0;
        if let Some(shared) = object.shared_parts() {
            leaves = 1;
            let key = Arc::as_ptr(shared).addr();
            if self.0.insert(key, Arc::clone(shared)).is_some() {
                return leaves;
            }
        }
        let of_children = children.iter().map(|child| self.stored(child));
        of_children.fold(leaves, u64::saturating_add)
    }
}

/// Memory that the process may still take, in bytes; `u64::MAX` where it is not known.
#[derive(Debug)]
pub(super) struct Memory {
    /// Memory of the process at the start.
    start: Taken,
    /// Memory it may take on top of that.
    headroom: Taken,
}

impl Memory {
    fn now(part: Option<u64>) -> Self {
        let start = Taken::now().unwrap_or_default();
        let most = address_space_limit().unwrap_or(u64::MAX);
        Memory {
            start,
            headroom: Taken {
                address_space: most.saturating_sub(start.address_space),
                resident: available().min(part.unwrap_or(u64::MAX)),
            },
        }
    }

    /// Bytes that the process may take on top of what it had at the start.
    pub(super) fn headroom(&self) -> u64 {
        self.headroom.address_space.min(self.headroom.resident)
    }

    /// True if `more` bytes, and then the compiled scene, fit beside the memory taken so far.
    pub(super) fn allows(&self, more: u64, leaves: u64) -> bool {
        let Some(now) = Taken::now() else {
            return true;
        };
        let compiled = leaves.saturating_mul(limits::LEAF_BYTES);
        let fits = |start: u64, now: u64, headroom: u64| {
            let read = now.saturating_sub(start).saturating_add(more);
            // Textures and matrices are built again for rendering, about half of what is read.
            let all = (read + read / 2).saturating_add(compiled);
            all <= headroom - headroom / 8
        };
        let (start, headroom) = (self.start, self.headroom);
        fits(
            start.address_space,
            now.address_space,
            headroom.address_space,
        ) && fits(start.resident, now.resident, headroom.resident)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_allowed_up_to_its_limit() {
        let memory = Memory {
            start: Taken::default(),
            headroom: Taken {
                address_space: u64::MAX,
                resident: u64::MAX,
            },
        };
        assert!(memory.allows(1 << 40, 1 << 30));
        let none = Memory {
            start: Taken::default(),
            headroom: Taken::default(),
        };
        assert_eq!(none.allows(1, 0), Taken::now().is_none());
    }
}

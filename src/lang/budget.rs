//! Limits on reading: tokens read again by loops and macros, and memory.
//!
//! Memory is not counted but measured from time to time, from what the system reports of the process. Where it reports
//! nothing, only the limits on counts hold.

use super::limits;
use crate::scene::{Children, Object};
use rustc_hash::FxHashMap;
use std::fs;
use std::path::Path;
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

/// Memory of the process, by the measures of its two limits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Taken {
    address_space: u64,
    resident: u64,
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

impl Taken {
    fn now() -> Option<Self> {
        let status = fs::read_to_string("/proc/self/status").ok()?;
        Some(Taken {
            address_space: kibibytes(&status, "VmSize:")?,
            resident: kibibytes(&status, "VmRSS:")?,
        })
    }
}

/// The limit set by `ulimit -v`, in bytes.
fn address_space_limit() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits
        .lines()
        .find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Free memory of the machine, or of the control group of this process (a cluster job).
fn available() -> u64 {
    let of_machine = field("/proc/meminfo", "MemAvailable:").unwrap_or(u64::MAX);
    of_machine.min(left_to_group().unwrap_or(u64::MAX))
}

/// Memory left below the tightest limit of the control groups (version 2) of this process.
fn left_to_group() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    let name = groups.lines().find_map(|line| line.strip_prefix("0::/"))?;
    let number = |folder: &Path, file: &str| -> Option<u64> {
        let text = fs::read_to_string(folder.join(file)).ok()?;
        text.trim().parse().ok()
    };
    let left = |folder: &Path| {
        // Page cache is reclaimed when memory is needed, so only anonymous memory counts.
        let held = fs::read_to_string(folder.join("memory.stat")).ok()?;
        let held = held.lines().find_map(|line| line.strip_prefix("anon "))?;
        Some(number(folder, "memory.max")?.saturating_sub(held.parse().ok()?))
    };
    let group = Path::new("/sys/fs/cgroup").join(name);
    group.ancestors().filter_map(left).min()
}

fn field(file: &str, name: &str) -> Option<u64> {
    kibibytes(&fs::read_to_string(file).ok()?, name)
}

/// The value of `Name:  123 kB` among other lines, in bytes.
fn kibibytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let number: u64 = line.split_whitespace().next()?.parse().ok()?;
    number.checked_mul(1024)
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

    #[test]
    fn values_of_the_system_are_in_bytes() {
        let text = "VmPeak:\t 3892 kB\nVmSize:\t    12 kB\n";
        assert_eq!(kibibytes(text, "VmSize:"), Some(12 << 10));
        assert_eq!(kibibytes(text, "VmRSS:"), None);
    }
}

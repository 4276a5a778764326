//! Limits on reading: tokens read again by loops and macros, and memory.
//!
//! Memory is not counted but measured from time to time, from what the system reports of the process. Where it reports
//! nothing, only the limits on counts hold.

use super::cursor::Start;
use super::limits;
use super::reader::Reader;
use crate::base::args::Parse;
use crate::base::source::{Code, Diagnostic, Span};
use crate::scene::{Children, Object};
use rustc_hash::FxHashMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// Limits of a run, and how much of them is used up.
#[derive(Debug)]
pub(super) struct Budget {
    /// Number of tokens read again so far.
    reread: u64,
    objects: u64,
    /// Primitives of the scene once it is compiled.
    leaves: u64,
    /// The same, each counted as often as it is drawn.
    shown: u64,
    shared: Shared,
    /// Bytes taken since memory was last measured.
    unmeasured: u64,
    memory: Memory,
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
struct Shared(FxHashMap<usize, Children>);

impl Shared {
    /// Number of shapes and copies to prepare for an object beyond those already counted.
    fn stored(&mut self, object: &Object) -> u64 {
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
struct Memory {
    /// Memory of the process at the start.
    start: Taken,
    /// Memory it may take on top of that.
    headroom: Taken,
}

/// Memory of the process, by the measures of its two limits.
#[derive(Clone, Copy, Debug, Default)]
struct Taken {
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

    /// True if `more` bytes, and then the compiled scene, fit beside the memory taken so far.
    fn allows(&self, more: u64, leaves: u64) -> bool {
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

impl Reader<'_> {
    /// Counts tokens that a loop or a macro makes the reader read again.
    pub(super) fn count_reread(&mut self, tokens: usize, at: Start) -> Parse<()> {
        let budget = &mut self.budget;
        // A round costs something beside its tokens.
        budget.reread += tokens as u64 + 8;
        if self.options.stop.is_asked() {
            return Err(self.stopped(at));
        }
        let budget = &self.budget;
        if budget.reread <= self.options.patience {
            return self.take_memory_at(limits::ROUND_BYTES, |reader| reader.span_of(at));
        }
        let most = self.options.patience
            + self.options.patience / limits::PATIENCE_FOR_OBJECT * budget.objects
            + limits::TOKENS_FOR_BYTE * self.files.written();
        if budget.reread > most {
            let message = format!(
                "the loops and macros of this scene do not come to an end: {} tokens were read in them",
                budget.reread
            );
            let error = Diagnostic::error(self.span_of(at), message)
                .with_hint("Look for a condition that stays true, or for too many rounds.");
            return Err(self.fatal(error));
        }
        self.take_memory_at(limits::ROUND_BYTES, |reader| reader.span_of(at))
    }

    fn stopped(&mut self, at: Start) -> Box<Diagnostic> {
        let error = Diagnostic::error(self.span_of(at), "reading was stopped here");
        self.fatal(error)
    }

    /// Counts a stream of random numbers.
    pub(super) fn count_stream(&mut self) -> Parse<()> {
        self.take_memory_at(limits::STREAM_BYTES, Self::taken_span)
    }

    /// Counts an object.
    pub(super) fn count_object(&mut self) -> Parse<()> {
        self.count_objects(1)
    }

    /// Counts this many objects.
    pub(super) fn count_objects(&mut self, count: u64) -> Parse<()> {
        self.budget.objects += count;
        self.take_memory_at(count * limits::OBJECT_BYTES, Self::taken_span)
    }

    /// Counts the primitives of a top-level object.
    pub(super) fn count_leaves(&mut self, object: &Object) -> Parse<()> {
        self.count_object()?;
        let leaves = self.budget.shared.stored(object);
        self.count_shapes(leaves, u64::from(object.size().leaves))
    }

    /// The same for an object that is a single shape.
    pub(super) fn count_leaf(&mut self) -> Parse<()> {
        self.count_single_shapes(1)
    }

    /// The same for `count` objects that are a single shape each.
    pub(super) fn count_single_shapes(&mut self, count: u64) -> Parse<()> {
        self.count_objects(count)?;
        self.count_shapes(count, count)
    }

    /// Counts shapes to be prepared, and shapes as often as they are drawn.
    fn count_shapes(&mut self, leaves: u64, shown: u64) -> Parse<()> {
        self.budget.leaves += leaves;
        self.budget.shown += shown;
        let many = if self.budget.leaves > limits::LEAVES {
            format!("a scene has at most {} shapes", limits::LEAVES)
        } else if self.budget.shown > limits::SHOWN {
            format!("a scene shows at most {} shapes", limits::SHOWN)
        } else {
            return self.take_memory_at(leaves * limits::LEAF_BYTES, Self::taken_span);
        };
        let error = Diagnostic::error(self.taken_span(), many)
            .with_hint("Objects that hold each other twice double their shapes each time.");
        Err(self.fatal(error))
    }

    /// Checks that there is memory to compile an object for `trace` and `inside`.
    pub(super) fn check_probed(&mut self, object: &Object) -> Parse<()> {
        if object.size().leaves < limits::PROBED {
            return Ok(());
        }
        let leaves = Shared::default().stored(object);
        if leaves <= limits::LEAVES && self.budget.memory.allows(0, leaves) {
            return Ok(());
        }
        let message = format!("this object comes to {leaves} shapes, too many to look into");
        Err(self.with_trace(Diagnostic::error(self.taken_span(), message)))
    }

    /// Checks the nesting depth and the number of the parts of an object.
    pub(super) fn check_size(&mut self, object: &Object, at: Span) -> Parse<()> {
        match limits::exceeded(object) {
            Some(message) => Err(self.with_trace(Diagnostic::error(at, message))),
            None => Ok(()),
        }
    }

    /// Notes about `bytes` of memory taken, or about to be; an error if there is no more.
    pub(super) fn take_memory(&mut self, bytes: u64, at: Span) -> Parse<()> {
        self.take_memory_at(bytes, |_| at)
    }

    /// The same; the span is computed only for a message.
    #[inline]
    fn take_memory_at(&mut self, bytes: u64, at: impl FnOnce(&Self) -> Span) -> Parse<()> {
        let unmeasured = self.budget.unmeasured.saturating_add(bytes);
        if unmeasured < limits::MEMORY_STEP {
            self.budget.unmeasured = unmeasured;
            return Ok(());
        }
        self.budget.unmeasured = 0;
        let ahead = if bytes < limits::MEMORY_STEP {
            0
        } else {
            bytes
        };
        if self.budget.memory.allows(ahead, self.budget.leaves) {
            return Ok(());
        }
        let error = Diagnostic::error(at(self), "this scene needs more memory than there is")
            .with_hint("Look for a loop that does not end, or draw it on a larger machine.");
        Err(self.fatal(error.with_code(Code::Memory)))
    }

    /// Notes that one thing is about to take `bytes`; the error names it.
    pub(super) fn take_memory_for(&mut self, what: &str, bytes: u64, at: Span) -> Parse<()> {
        if bytes < limits::MEMORY_STEP || self.budget.memory.allows(bytes, self.budget.leaves) {
            return self.take_memory(bytes.min(limits::MEMORY_STEP - 1), at);
        }
        let megabytes = bytes.div_ceil(1_000_000);
        let message = format!("{what} takes {megabytes} MB of memory, more than there is left");
        let error = Diagnostic::error(at, message)
            .with_hint("Make it smaller, or draw the scene on a larger machine.");
        Err(self.fatal(error.with_code(Code::Memory)))
    }

    /// Reads a part that may hold parts of its own kind, up to a limit on the nesting.
    pub(super) fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Parse<T>) -> Parse<T> {
        if self.statement.nesting >= limits::READING {
            let message = format!(
                "directives, conditions and calls are nested more than {} deep",
                limits::READING
            );
            let error = Diagnostic::error(self.taken_span(), message);
            return Err(self.fatal(error));
        }
        self.statement.nesting += 1;
        let result = read(self);
        self.statement.nesting -= 1;
        result
    }

    /// The error that ends reading.
    fn fatal(&mut self, error: Diagnostic) -> Box<Diagnostic> {
        self.is_over = true;
        let code = error.code.unwrap_or(Code::Limit);
        self.with_trace(error.with_code(code))
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

    #[test]
    fn values_of_the_system_are_in_bytes() {
        let text = "VmPeak:\t 3892 kB\nVmSize:\t    12 kB\n";
        assert_eq!(kibibytes(text, "VmSize:"), Some(12 << 10));
        assert_eq!(kibibytes(text, "VmRSS:"), None);
    }
}

//! The memory of this process, of its limits and of the machine, as far as the system reports them.

use std::fs;
use std::path::Path;

/// Memory of the process, by the measures of its two limits.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Taken {
    pub(crate) address_space: u64,
    pub(crate) resident: u64,
}

impl Taken {
    /// The memory taken now; `None` where the system does not report it.
    pub(crate) fn now() -> Option<Self> {
        let status = fs::read_to_string("/proc/self/status").ok()?;
        Some(Taken {
            address_space: kibibytes(&status, "VmSize:")?,
            resident: kibibytes(&status, "VmRSS:")?,
        })
    }
}

/// Bytes that this process may still take; `u64::MAX` where that is not known.
pub(crate) fn left() -> u64 {
    let taken = Taken::now().unwrap_or_default();
    let most = address_space_limit().unwrap_or(u64::MAX);
    most.saturating_sub(taken.address_space).min(available())
}

/// The limit set by `ulimit -v`, in bytes.
pub(crate) fn address_space_limit() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits
        .lines()
        .find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Free memory of the machine, or of the control group of this process (a cluster job).
pub(crate) fn available() -> u64 {
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
    fn values_of_the_system_are_in_bytes() {
        let text = "VmPeak:\t 3892 kB\nVmSize:\t    12 kB\n";
        assert_eq!(kibibytes(text, "VmSize:"), Some(12 << 10));
        assert_eq!(kibibytes(text, "VmRSS:"), None);
    }
}

//! Options for scenes that are not trusted: files they may use, and limits on time and memory.

use super::raw_args::RawArgs;
use super::values::{bytes, duration};
use crate::base::file::{Folders, folder_of};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Limits of a sandbox unless others are set.
const SANDBOX_TIMEOUT: Duration = Duration::from_secs(300);
const SANDBOX_MEMORY: u64 = 2 << 30;

/// The files that scenes may use.
#[derive(Clone, Debug, Default, PartialEq, Eq, clap::Args)]
pub(crate) struct SafetyOptions {
    /// Draw scenes of strangers: they read beside them, and write nothing
    #[arg(long)]
    pub(crate) sandbox: bool,
    /// Let scenes read beside them, in library folders and in DIR only
    #[arg(long, value_name = "DIR")]
    pub(crate) allow_read: Vec<PathBuf>,
    /// Let scenes write files in DIR too
    #[arg(long, value_name = "DIR")]
    pub(crate) allow_write: Vec<PathBuf>,
    /// Let scenes write no files
    #[arg(long)]
    pub(crate) no_write: bool,
}

/// Limits on the whole process.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::Args)]
pub(crate) struct LimitOptions {
    /// Give up after this time: 10s, 500ms [in a sandbox: 5m]
    #[arg(long, value_name = "TIME", value_parser = |text: &str| duration(text, "--timeout"))]
    pub(crate) timeout: Option<Duration>,
    /// Give up when more memory is taken: 500M, 4G [in a sandbox: 2G]
    #[arg(long, value_name = "SIZE", value_parser = |text: &str| bytes(text, "--max-memory"))]
    pub(crate) max_memory: Option<u64>,
}

impl SafetyOptions {
    /// Adds options given later.
    pub(crate) fn add(&mut self, more: SafetyOptions) {
        self.sandbox |= more.sandbox;
        self.no_write |= more.no_write;
        self.allow_read.extend(more.allow_read);
        self.allow_write.extend(more.allow_write);
    }

    /// The folders in which a scene may read; `beside` is the scene's file, if it has one.
    pub(crate) fn readable(
        &self,
        beside: Option<&Path>,
        library_paths: &[PathBuf],
        include_header: Option<&PathBuf>,
    ) -> Folders {
        if !self.sandbox && self.allow_read.is_empty() {
            return Folders::All;
        }
        let beside = beside.map(folder_of);
        let named = library_paths.iter().chain(include_header);
        let folders = beside.into_iter().chain(named.cloned());
        Folders::Only(folders.chain(self.allow_read.clone()).collect())
    }

    /// The folders in which a scene may write; `usual` are those without these options.
    pub(crate) fn writable(&self, usual: Folders) -> Folders {
        let mut folders = match usual {
            _ if self.no_write => return Folders::Only(Vec::new()),
            _ if self.sandbox => Vec::new(),
            Folders::All => return Folders::All,
            Folders::Only(folders) => folders,
        };
        folders.extend(self.allow_write.iter().cloned());
        Folders::Only(folders)
    }
}

impl LimitOptions {
    /// Adds options given later.
    pub(crate) fn add(&mut self, more: LimitOptions) {
        self.timeout = more.timeout.or(self.timeout);
        self.max_memory = more.max_memory.or(self.max_memory);
    }

    /// The limits of a command line.
    pub(crate) fn of(raw_args: &RawArgs) -> Self {
        match raw_args.safety.sandbox {
            true => raw_args.limits.of_sandbox(),
            false => raw_args.limits,
        }
    }

    /// These limits, and those of a sandbox where none are set.
    pub(crate) fn of_sandbox(self) -> Self {
        LimitOptions {
            timeout: self.timeout.or(Some(SANDBOX_TIMEOUT)),
            max_memory: self.max_memory.or(Some(SANDBOX_MEMORY)),
        }
    }
}

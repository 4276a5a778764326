//! The kernel's part of `--sandbox`: even where a fault of this program lets a scene run code, it reads and writes no
//! other files, opens no connections and starts no programs.
//!
//! Landlock limits files and forbids TCP connections, a seccomp filter the system calls that no drawing needs. Threads
//! started later inherit both, so a command enters its sandbox before it starts any. Where the kernel lacks one of them,
//! a warning says so, and the limits of [`crate::base::file`] hold alone.

use super::draw::report::say;
use super::options::settings::{Scene, Settings};
use crate::base::file::{Folders, folder_of};
use crate::base::options::ReadOptions;
use crate::output::Target;
use std::path::{Path, PathBuf};

/// Files of the system that tell this program about its memory and processors.
const SYSTEM_FILES: [&str; 6] = [
    "/proc/self/status",
    "/proc/self/limits",
    "/proc/self/cgroup",
    "/proc/meminfo",
    "/proc/cpuinfo",
    "/sys/fs/cgroup",
];

/// Enters the sandbox of a drawing; the program writes to `folder` and to the picture.
pub(super) fn enter_to_draw(settings: &Settings, folder: Option<&Path>) {
    let mut sandbox = Sandbox::default();
    sandbox.writable.extend(folder.map(Path::to_owned));
    sandbox.admit(settings.scene.path(), &settings.read);
    if let Some((Target::File(picture), _)) = &settings.output {
        // The picture, or what a link leads to, is written beside its destination and renamed.
        let picture = std::fs::canonicalize(picture).unwrap_or_else(|_| picture.clone());
        let is_written_to = picture.exists() && !picture.is_file();
        sandbox.writable.push(match is_written_to {
            true => picture,
            false => folder_of(&picture),
        });
    }
    let streams = settings.streams.iter();
    sandbox
        .writable
        .extend(streams.map(|(_, file)| folder_of(file)));
    warn(&sandbox.enter());
}

/// Enters the sandbox of a command that only reads scenes.
pub(super) fn enter_to_read(scenes: &[Scene], options: &dyn Fn(&Scene) -> ReadOptions) {
    let mut sandbox = Sandbox::default();
    for scene in scenes {
        let mut options = options(scene);
        options.writable = Folders::Only(Vec::new());
        sandbox.admit(scene.path(), &options);
    }
    warn(&sandbox.enter());
}

/// Reports the parts of a sandbox that the kernel lacks.
pub(super) fn warn(lacks: &[String]) {
    for lack in lacks {
        say(format_args!(
            "povr: warning: this sandbox is weaker: {lack}"
        ));
    }
}

/// Enters the sandbox of a process that draws one scene for another process; returns the parts that the kernel lacks.
pub(super) fn enter_to_draw_one(scene: &Path, options: &ReadOptions) -> Vec<String> {
    let mut sandbox = Sandbox::default();
    sandbox.admit(Some(scene), options);
    sandbox.enter()
}

/// The files and folders that the process may use.
#[derive(Debug, Default)]
struct Sandbox {
    readable: Vec<PathBuf>,
    writable: Vec<PathBuf>,
}

impl Sandbox {
    fn admit(&mut self, scene: Option<&Path>, options: &ReadOptions) {
        self.readable.extend(scene.map(Path::to_owned));
        for (folders, admitted) in [
            (&options.readable, &mut self.readable),
            (&options.writable, &mut self.writable),
        ] {
            match folders {
                Folders::All => admitted.push(PathBuf::from("/")),
                Folders::Only(folders) => admitted.extend(folders.iter().cloned()),
            }
        }
    }

    /// Limits this thread, and all threads that it starts, for good; returns the parts that the kernel lacks.
    fn enter(mut self) -> Vec<String> {
        self.readable.extend(SYSTEM_FILES.map(PathBuf::from));
        for paths in [&mut self.readable, &mut self.writable] {
            paths.sort();
            paths.dedup();
        }
        limited(&self)
    }
}

/// Limits this thread; returns the parts that the kernel lacks.
#[cfg(all(
    target_os = "linux",
    any(target_arch = "x86_64", target_arch = "aarch64")
))]
fn limited(sandbox: &Sandbox) -> Vec<String> {
    let mut lacking = Vec::new();
    match landlocked(sandbox) {
        Ok(landlock::RulesetStatus::FullyEnforced) => {}
        Ok(landlock::RulesetStatus::PartiallyEnforced) => {
            lacking.push("the kernel's Landlock is old: it limits files in part".to_owned());
        }
        Ok(landlock::RulesetStatus::NotEnforced) => {
            lacking.push("the kernel has no Landlock".to_owned());
        }
        Err(error) => lacking.push(format!("Landlock: {error}")),
    }
    if let Err(error) = filtered() {
        lacking.push(format!("seccomp: {error}"));
    }
    lacking
}

#[cfg(not(all(
    target_os = "linux",
    any(target_arch = "x86_64", target_arch = "aarch64")
)))]
fn limited(_: &Sandbox) -> Vec<String> {
    vec!["this system has neither Landlock nor seccomp".to_owned()]
}

/// Limits the files and connections.
#[cfg(all(
    target_os = "linux",
    any(target_arch = "x86_64", target_arch = "aarch64")
))]
fn landlocked(
    sandbox: &Sandbox,
) -> Result<landlock::RulesetStatus, Box<dyn std::error::Error + Send + Sync>> {
    use landlock::{
        ABI, Access, AccessFs, AccessNet, Ruleset, RulesetAttr, RulesetCreatedAttr,
        path_beneath_rules,
    };
    use std::os::unix::fs::FileTypeExt;
    // The kernel takes no rule for an anonymous pipe, and needs none: it is open already.
    let ruled = |paths: &[PathBuf]| -> Vec<PathBuf> {
        let is_pipe = |path: &&PathBuf| {
            std::fs::metadata(path).is_ok_and(|about| about.file_type().is_fifo())
        };
        paths
            .iter()
            .filter(|path| !is_pipe(path))
            .cloned()
            .collect()
    };
    // Later versions add signals and abstract sockets, which the filter of system calls refuses.
    let abi = ABI::V5;
    let read = AccessFs::ReadFile | AccessFs::ReadDir;
    let write = read
        | AccessFs::WriteFile
        | AccessFs::MakeReg
        | AccessFs::MakeDir
        | AccessFs::RemoveFile
        | AccessFs::Refer
        | AccessFs::Truncate;
    let status = Ruleset::default()
        .handle_access(AccessFs::from_all(abi))?
        .handle_access(AccessNet::from_all(abi))?
        .create()?
        .add_rules(path_beneath_rules(ruled(&sandbox.readable), read))?
        .add_rules(path_beneath_rules(ruled(&sandbox.writable), write))?
        .restrict_self()?;
    Ok(status.ruleset)
}

/// Makes the system calls fail that no drawing needs.
#[cfg(all(
    target_os = "linux",
    any(target_arch = "x86_64", target_arch = "aarch64")
))]
fn filtered() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    use seccompiler::{BpfProgram, SeccompAction, SeccompFilter, apply_filter};
    const UNNEEDED: [i64; 40] = [
        libc::SYS_tgkill,
        libc::SYS_tkill,
        libc::SYS_rt_sigqueueinfo,
        libc::SYS_pidfd_send_signal,
        libc::SYS_open_by_handle_at,
        libc::SYS_execve,
        libc::SYS_execveat,
        libc::SYS_ptrace,
        libc::SYS_process_vm_readv,
        libc::SYS_process_vm_writev,
        libc::SYS_kcmp,
        libc::SYS_socket,
        libc::SYS_socketpair,
        libc::SYS_connect,
        libc::SYS_bind,
        libc::SYS_listen,
        libc::SYS_accept,
        libc::SYS_accept4,
        libc::SYS_mount,
        libc::SYS_umount2,
        libc::SYS_pivot_root,
        libc::SYS_chroot,
        libc::SYS_unshare,
        libc::SYS_setns,
        libc::SYS_kill,
        libc::SYS_mknodat,
        libc::SYS_keyctl,
        libc::SYS_add_key,
        libc::SYS_request_key,
        libc::SYS_bpf,
        libc::SYS_perf_event_open,
        libc::SYS_userfaultfd,
        libc::SYS_io_uring_setup,
        libc::SYS_init_module,
        libc::SYS_finit_module,
        libc::SYS_delete_module,
        libc::SYS_kexec_load,
        libc::SYS_personality,
        libc::SYS_setuid,
        libc::SYS_setgid,
    ];
    let rules = UNNEEDED.iter().map(|&call| (call, Vec::new())).collect();
    let refuse = SeccompAction::Errno(libc::EPERM.unsigned_abs());
    let arch = std::env::consts::ARCH.try_into()?;
    let filter = SeccompFilter::new(rules, SeccompAction::Allow, refuse, arch)?;
    let program: BpfProgram = filter.try_into()?;
    Ok(apply_filter(&program)?)
}

#[cfg(all(
    test,
    target_os = "linux",
    any(target_arch = "x86_64", target_arch = "aarch64")
))]
mod tests {
    use super::*;
    use std::fs;

    /// A sandbox holds for a thread and those that it starts, so the other tests go on outside of it.
    #[test]
    fn a_thread_in_a_sandbox_reaches_nothing_outside() {
        let all = tempfile::tempdir().unwrap();
        let path = |name: &str| all.path().join(name);
        for folder in ["in", "out", "library"] {
            fs::create_dir(path(folder)).unwrap();
            fs::write(path(folder).join("a"), folder).unwrap();
        }
        let sandbox = Sandbox {
            readable: vec![path("library")],
            writable: vec![path("in")],
        };
        std::thread::scope(|scope| {
            scope.spawn(|| {
                if !limited(&sandbox).is_empty() {
                    return;
                }
                assert!(fs::read(path("library/a")).is_ok() && fs::read(path("in/a")).is_ok());
                assert!(fs::write(path("in/b"), "b").is_ok());
                assert!(fs::rename(path("in/b"), path("in/a")).is_ok());
                assert!(fs::write(path("library/a"), "b").is_err());
                assert!(fs::read(path("out/a")).is_err() && fs::read("/etc/passwd").is_err());
                assert!(fs::write(path("out/b"), "b").is_err());
                assert!(std::process::Command::new("true").status().is_err());
                assert!(std::net::TcpListener::bind("127.0.0.1:0").is_err());
                let deeper = std::thread::spawn({
                    let file = path("out/a");
                    move || fs::read(file).is_err()
                });
                assert!(deeper.join().unwrap());
            });
        });
        assert!(fs::read(path("out/a")).is_ok());
    }
}

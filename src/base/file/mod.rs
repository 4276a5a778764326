//! All access to the files that a scene names: includes, pictures, fonts, densities, photon maps, files of `#fopen`.
//!
//! A scene may come from a stranger. So only regular files are opened, without blocking, and their sizes are limited.
//! [`Folders`] limits where they may lie; this is checked again after opening, when another process can no longer
//! replace the file by a link. `docs/security.md` describes the rules.
//!
//! Files that the user names (the scene, the picture) may be pipes and devices.

mod difference;
mod folders;
mod pending;
mod read;
mod regular;

#[cfg(feature = "cli")]
pub(crate) use difference::difference;
pub(crate) use difference::{common_end, common_start};
pub use folders::Folders;
pub(crate) use pending::{PendingFile, check_appendable, check_replaceable, folder_of, save};
pub use read::MAX_FILE_BYTES;
#[cfg(feature = "cli")]
pub(crate) use read::read_regular;
pub(crate) use read::{FileLimits, MAX_STREAM_BYTES, Named, read_limited};
pub(crate) use regular::{Irregular, only_regular, open_appending, open_regular};

//! Dependencies of a picture: the files that were read, and the paths where the search found no file.

use rustc_hash::FxHashSet;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A file whose content or existence affects the picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Dependency {
    /// The path at which the file was searched.
    pub path: PathBuf,
    /// True if the file exists.
    pub is_there: bool,
}

/// The dependencies of a run so far, without duplicates, in the order in which they were recorded.
#[derive(Clone, Debug, Default)]
pub(super) struct Dependencies {
    pub(super) all: Vec<Dependency>,
    pub(super) known: FxHashSet<Dependency>,
}

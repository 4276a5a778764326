//! What a picture depends on: the files that were read, and the places where files were looked for and are not.

use super::search::places;
use super::{FileId, Sources};
use rustc_hash::FxHashSet;
use std::path::{Path, PathBuf};

/// A file whose content or whose presence matters to the picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Dependency {
    /// The path by which it was found, or at which it was looked for.
    pub path: PathBuf,
    /// Whether it was there.
    pub is_there: bool,
}

/// The dependencies of a run so far, each once, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct Asked {
    all: Vec<Dependency>,
    known: FxHashSet<Dependency>,
}

impl Sources {
    /// The files that were read, and the places where files were looked for in vain, each once, without those that the
    /// scene wrote itself: if one of them changes, appears or goes, the picture may change.
    #[must_use]
    pub fn dependencies(&self) -> &[Dependency] {
        &self.asked.all
    }

    /// The first file of this name in the folders, with an ending appended; one that the scene wrote comes before all.
    pub(super) fn search(
        &mut self,
        name: &str,
        folders: &[PathBuf],
        endings: &[&str],
    ) -> Option<PathBuf> {
        let mut found = self.own_file(name);
        let is_own = found.is_some();
        for place in places(name, folders, endings).take_while(|_| !is_own) {
            if self.is_file(&place) {
                found = Some(place);
                break;
            }
            self.note(&place, false);
        }
        found
    }

    pub(super) fn note(&mut self, path: &Path, is_there: bool) {
        let dependency = Dependency {
            path: path.to_owned(),
            is_there,
        };
        if self.asked.known.contains(&dependency) {
            return;
        }
        if !self.has_written(path) {
            self.asked.known.insert(dependency.clone());
            self.asked.all.push(dependency);
        }
    }

    /// Whether the scene has written files.
    #[must_use]
    pub fn wrote_files(&self) -> bool {
        !self.written.is_empty()
    }

    /// Whether a text is that of a file which the scene did not write itself.
    #[must_use]
    pub fn is_lasting(&self, file: FileId) -> bool {
        self.by_path
            .iter()
            .any(|(path, id)| *id == file && !self.written.contains(path))
    }

    /// The same texts for another run, which has asked for no file and written none yet.
    #[must_use]
    pub fn for_another_run(mut self) -> Self {
        let written = std::mem::take(&mut self.written);
        self.held.clear();
        self.by_path.retain(|path, _| !written.contains(path));
        self.data.retain(|path, _| !written.contains(path));
        self.asked = Asked::default();
        self.of_earlier_run = self.by_path.values().copied().collect();
        self
    }
}

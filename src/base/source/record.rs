//! Record of what a run read and wrote: the dependencies of a picture.

use super::dependency::{Dependencies, Dependency};
use super::search::candidates;
use super::{FileId, Sources};
use std::path::{Path, PathBuf};

impl Sources {
    /// The files that were read and the paths where the search found no file, without duplicates and without files that
    /// the scene wrote itself. If one of them changes, appears or disappears, the picture may change.
    #[must_use]
    pub fn dependencies(&self) -> &[Dependency] {
        &self.dependencies.all
    }

    /// Searches the folders for a file of this name with one of the endings appended. A file that the scene wrote takes
    /// precedence.
    pub(super) fn search(
        &mut self,
        name: &str,
        folders: &[PathBuf],
        endings: &[&str],
    ) -> Option<PathBuf> {
        let mut found = self.own_file(name);
        let is_own = found.is_some();
        for path in candidates(name, folders, endings).take_while(|_| !is_own) {
            if self.is_file(&path) {
                found = Some(path);
                break;
            }
            self.note(&path, false);
        }
        found
    }

    pub(super) fn note(&mut self, path: &Path, is_there: bool) {
        let dependency = Dependency {
            path: path.to_owned(),
            is_there,
        };
        if self.dependencies.known.contains(&dependency) {
            return;
        }
        // The scene does not learn of other files, so they do not matter.
        let is_known = is_there || self.limits.folders.reach(path);
        if is_known && !self.has_written(path) {
            self.dependencies.known.insert(dependency.clone());
            self.dependencies.all.push(dependency);
        }
    }

    /// Returns true if the scene has written files.
    #[must_use]
    pub fn wrote_files(&self) -> bool {
        !self.written.is_empty()
    }

    /// Returns true for the text of a file that the scene did not write itself.
    #[must_use]
    pub fn is_persistent(&self, file: FileId) -> bool {
        self.by_path
            .iter()
            .any(|(path, id)| *id == file && !self.written.contains(path))
    }

    /// The texts for another run, with no dependencies recorded and no files written.
    #[must_use]
    pub fn for_another_run(mut self) -> Self {
        let written = std::mem::take(&mut self.written);
        self.held.clear();
        self.by_path.retain(|path, _| !written.contains(path));
        self.data.retain(|path, _| !written.contains(path));
        self.dependencies = Dependencies::default();
        self.of_earlier_run = self.by_path.values().copied().collect();
        self
    }
}

//! Binary files that a scene names: pictures, fonts.

use super::held_file::canonical_path;
use super::refusal::refusal;
use super::{Diagnostic, FileId, Sources};
use crate::base::file::Named;
use std::io;
use std::sync::Arc;

impl Sources {
    /// Returns the bytes of the file that a scene names in `including_file`. The search is that for include files: the
    /// name itself, then the name with each of `endings` appended. `what` is "the picture" or the like. Each file is
    /// read once, whatever path names it.
    ///
    /// # Errors
    /// No such file, or it cannot be read; the diagnostic has no span yet.
    pub fn find_bytes(
        &mut self,
        what: &str,
        name: &str,
        including_file: FileId,
        endings: &[&str],
    ) -> Result<Arc<[u8]>, Box<Diagnostic>> {
        let folders = self.folders(including_file);
        let endings: Vec<&str> = [""].iter().chain(endings).copied().collect();
        let Some(path) = self.search(name, &folders, &endings) else {
            return Err(Box::new(self.not_found(what, name, &folders)));
        };
        self.note(&path, true);
        let name = path.display();
        let cannot_read = |error| Box::new(refusal("read", &name, &error));
        let key = canonical_path(&path).map_err(cannot_read)?;
        if let Some(bytes) = self.data.get(&key) {
            return Ok(Arc::clone(bytes));
        }
        let bytes = self.bytes_of(&path, Named::ByScene).map_err(cannot_read)?;
        let bytes = bytes.ok_or_else(|| cannot_read(io::Error::other("it is too large")))?;
        let bytes: Arc<[u8]> = bytes.into();
        self.data.insert(key, Arc::clone(&bytes));
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_file_is_found_with_its_ending_or_without_and_read_once() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a.png"), [1, 2]).unwrap();
        let mut sources = Sources::new(vec![folder.path().to_owned()]);
        let scene = sources.add_text("x", "");
        let first = sources
            .find_bytes("the file", "a", scene, &[".png"])
            .unwrap();
        let second = sources.find_bytes("the file", "a.png", scene, &[]).unwrap();
        assert_eq!(*first, [1, 2]);
        assert!(Arc::ptr_eq(&first, &second));
        let error = sources
            .find_bytes("the file", "a", scene, &[".gif"])
            .unwrap_err();
        assert!(error.message.starts_with("cannot find the file `a` in "));
    }
}

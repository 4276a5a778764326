//! Files that a scene names and that are no text: pictures, fonts.

use super::read::Named;
use super::regular::refusal;
use super::search::not_found;
use super::written::place_of;
use super::{Diagnostic, FileId, Sources};
use std::io;
use std::sync::Arc;

impl Sources {
    /// The bytes of the file that a scene means by `"name"` in `including_file`: searched like an include file, by its
    /// name and then with each of `endings` appended. `what` is "the picture" or the like. A file is read once, by whatever path it is named.
    ///
    /// # Errors
    /// When there is no such file or it cannot be read; the finding has no place yet.
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
            return Err(Box::new(not_found(what, name, &folders)));
        };
        self.note(&path, true);
        let name = path.display();
        let cannot_read = |error| Box::new(refusal("read", &name, &error));
        let place = place_of(&path).map_err(cannot_read)?;
        if let Some(bytes) = self.data.get(&place) {
            return Ok(Arc::clone(bytes));
        }
        let bytes = self.bytes_of(&path, Named::ByScene).map_err(cannot_read)?;
        let bytes = bytes.ok_or_else(|| cannot_read(io::Error::other("it is too large")))?;
        let bytes: Arc<[u8]> = bytes.into();
        self.data.insert(place, Arc::clone(&bytes));
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

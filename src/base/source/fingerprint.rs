//! Hash of the texts of a run, to detect changes.

use super::Sources;
use rustc_hash::FxHasher;
use std::hash::{Hash, Hasher};

impl Sources {
    /// A hash of every byte of every file that was read and of the existence of every file that was searched. It guards
    /// against accidents, not against forgery.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let mut hasher = FxHasher::default();
        for text in self.all_texts() {
            text.hash(&mut hasher);
        }
        // The same file can be named by different paths, so the order of the hashes must not depend on them.
        let mut data: Vec<u64> = self
            .data
            .values()
            .map(|bytes| {
                let mut hasher = FxHasher::default();
                bytes.hash(&mut hasher);
                hasher.finish()
            })
            .collect();
        data.sort_unstable();
        data.hash(&mut hasher);
        for dependency in self.dependencies() {
            dependency.is_there.hash(&mut hasher);
        }
        hasher.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn every_byte_of_every_file_counts() {
        let folder = tempfile::tempdir().unwrap();
        let fingerprint = |text: &str, include: &str, font: &str| {
            fs::write(folder.path().join("a.pov"), text).unwrap();
            fs::write(folder.path().join("b.inc"), include).unwrap();
            fs::write(folder.path().join("c.ttf"), font).unwrap();
            let mut sources = Sources::new(Vec::new());
            let scene = sources.load_file(folder.path().join("a.pov")).unwrap();
            sources.find_include("b", scene).unwrap();
            sources
                .find_bytes("the font", "c", scene, &[".ttf"])
                .unwrap();
            let _ = sources.has_data("missing", scene);
            sources.fingerprint()
        };
        let first = fingerprint("sphere", "box", "font");
        assert_eq!(first, fingerprint("sphere", "box", "font"));
        for (text, include, font) in [
            ("spherf", "box", "font"),
            ("sphere", "bax", "font"),
            ("sphere", "box", "fond"),
        ] {
            assert_ne!(
                first,
                fingerprint(text, include, font),
                "{text} {include} {font}"
            );
        }
        fs::write(folder.path().join("missing"), "here").unwrap();
        assert_ne!(first, fingerprint("sphere", "box", "font"));
    }
}

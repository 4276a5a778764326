//! Files of a curve, replaced as a whole.

use super::CurveError;
use crate::base::file::{Folders, PendingFile};
use serde::Serialize;
use std::path::Path;

/// Writes a file atomically.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), CurveError> {
    let written = PendingFile::new(path, &Folders::All).and_then(|mut file| {
        std::io::Write::write_all(&mut file, bytes)?;
        file.persist()
    });
    written.map(drop).map_err(|error| {
        CurveError::new(format!("cannot write `{}`: {error}", path.display()))
            .with_hint("Name another folder with `--out`.")
    })
}

pub(crate) fn write_json(path: &Path, value: &impl Serialize) -> Result<(), CurveError> {
    match serde_json::to_vec_pretty(value) {
        Ok(bytes) => write(path, &bytes),
        Err(error) => Err(CurveError::new(format!(
            "cannot write `{}`: {error}",
            path.display()
        ))),
    }
}

//! Diagnostics for files that cannot be read or written.

use super::Diagnostic;
use crate::base::file::Irregular;
use std::fmt;
use std::io;

/// Makes a diagnostic without a span from an I/O error; `verb` is the operation that failed.
pub(crate) fn refusal(verb: &str, name: &dyn fmt::Display, error: &io::Error) -> Diagnostic {
    let inner = error.get_ref();
    match inner.and_then(|inner| inner.downcast_ref::<Irregular>()) {
        Some(irregular) => Diagnostic::error(None, format!("`{name}` is {irregular}"))
            .with_hint(format!("A scene can {verb} regular files only.")),
        None => Diagnostic::error(None, format!("cannot {verb} `{name}`: {error}")),
    }
}

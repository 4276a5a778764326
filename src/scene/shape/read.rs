//! Readers of shape parameters: finite numbers and vectors, with errors that name the parameter.

use crate::base::args::{Args, Parse};
use crate::base::source::Diagnostic;
use glam::DVec3;

/// Reads a finite number, after an optional comma. `what` names it in errors: "the radius of the sphere".
pub(super) fn number(args: &mut dyn Args, what: &str) -> Parse<f64> {
    args.comma()?;
    let value = args.float()?;
    if value.is_finite() {
        return Ok(value);
    }
    Err(Box::new(Diagnostic::error(
        args.last_span(),
        format!("{what} must be finite, found {value}"),
    )))
}

/// Reads a point or direction with finite components, after an optional comma.
pub(super) fn vector(args: &mut dyn Args, what: &str) -> Parse<DVec3> {
    args.comma()?;
    let value = args.vector()?;
    if value.is_finite() {
        return Ok(value);
    }
    Err(Box::new(Diagnostic::error(
        args.last_span(),
        format!(
            "{what} must be finite, found <{}, {}, {}>",
            value.x, value.y, value.z
        ),
    )))
}

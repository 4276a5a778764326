//! Numbers of finishes, stored in single precision.

use crate::base::args::{Args, Parse, Word};

#[allow(
    clippy::cast_possible_truncation,
    reason = "finish values are single precision, as in POV-Ray"
)]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}

/// Reads `word` and the number after it.
pub(crate) fn number(word: Word, args: &mut dyn Args) -> Parse<f32> {
    args.accept(word)?;
    Ok(single(args.float()?))
}

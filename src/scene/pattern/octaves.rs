//! `octaves`, `omega` and `lambda` of turbulence.

use crate::base::args::{Args, Parse, Word};
use crate::base::math::noise::Octaves;

/// Reads `octaves`, `omega` or `lambda` with its number. Returns whether `word` was one of them.
pub(crate) fn read_octaves(octaves: &mut Octaves, word: Word, args: &mut dyn Args) -> Parse<bool> {
    if !matches!(word, Word::Octaves | Word::Omega | Word::Lambda) {
        return Ok(false);
    }
    args.accept(word)?;
    match word {
        Word::Octaves => octaves.count = Octaves::clamped_count(args.float()?),
        Word::Omega => octaves.omega = args.single()?,
        _ => octaves.lambda = args.single()?,
    }
    Ok(true)
}

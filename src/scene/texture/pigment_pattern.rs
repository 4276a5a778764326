//! `pigment_pattern`: the grey value of a pigment as a pattern.

use super::{Pigment, PreparedPigment};
use crate::base::args::{Args, Parse, Word, default_of};
use crate::scene::pattern::{self, Pattern, PatternEval, PrepareContext, SurfacePoint};
use glam::DVec3;

#[derive(Clone, Debug)]
struct PigmentPattern {
    pigment: Box<Pigment>,
}

#[derive(Debug)]
struct Prepared(PreparedPigment);

/// Reads a pattern that begins with `word`; `None` if `word` is no supported pattern.
///
/// # Errors
/// A malformed value after the word.
pub fn read_pattern(word: Word, args: &mut dyn Args) -> Parse<Option<Box<dyn Pattern>>> {
    if word != Word::PigmentPattern {
        return pattern::read_named(word, args);
    }
    args.accept(word)?;
    let base = default_of(args);
    let pigment = Box::new(Pigment::read(args, &base)?);
    Ok(Some(Box::new(PigmentPattern { pigment })))
}

impl Pattern for PigmentPattern {
    fn prepare(&self, with: &PrepareContext<'_>) -> Box<dyn PatternEval> {
        let pigment = PreparedPigment::new(&self.pigment, &[], with.settings);
        Box::new(Prepared(pigment))
    }
}

impl PatternEval for Prepared {
    fn value(&self, point: DVec3, spot: &SurfacePoint) -> f64 {
        f64::from(self.0.color_at(point, spot).rgb.grey())
    }
}

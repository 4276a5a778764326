//! The language versions of scenes for POV-Ray 3.8.

use crate::base::word::Word;

/// The first version that POV-Ray 3.7 does not know: that of the early releases of 3.8.
const FIRST: f64 = 3.71;
/// The first version with the defaults of POV-Ray 3.8.
const FIRST_WITH_DEFAULTS: f64 = 3.8;
/// Versions may be computed, so that their last digits are rounded.
const EQUAL: f64 = 1e-10;

/// True if scenes of a version are for POV-Ray 3.8: they have its words and are drawn by its rules.
#[must_use]
pub fn is_for_3_8(version: f64) -> bool {
    version >= FIRST - EQUAL
}

/// True if scenes of a version also have the defaults of POV-Ray 3.8.
#[must_use]
pub fn has_defaults_of_3_8(version: f64) -> bool {
    version >= FIRST_WITH_DEFAULTS - EQUAL
}

/// A feature of the language that POV-Ray 3.7 lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Novelty {
    /// The version alone.
    Version,
    /// A word.
    Word(Word),
    /// Several names in one declaration.
    Tuple,
    /// A name of one scope: `global.Name`, `local["Name"]`.
    ScopedName,
    /// A comma behind the last value of a list.
    LastComma,
}

impl Novelty {
    /// As it is written in a scene, or called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Novelty::Version => "#version",
            Novelty::Word(word) => word.spelling(),
            Novelty::Tuple => "#declare (...)",
            Novelty::ScopedName => "global.",
            Novelty::LastComma => "a comma behind the last value",
        }
    }

    /// The name in a sentence: between backquotes if it is written so.
    #[must_use]
    pub fn quoted(self) -> String {
        match self {
            Novelty::LastComma => self.name().to_owned(),
            _ => format!("`{}`", self.name()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measured with POV-Ray 3.8: `#version 3.71` has all but the defaults.
    #[test]
    fn version_3_71_has_all_but_the_defaults() {
        let of = |version| (is_for_3_8(version), has_defaults_of_3_8(version));
        assert_eq!(of(3.7), (false, false));
        assert_eq!(of(3.71), (true, false));
        assert_eq!(of(3.8), (true, true));
        assert_eq!(of(3.0 + 0.1 * 8.0), (true, true));
    }
}

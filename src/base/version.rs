//! The language versions from which scenes follow the rules of POV-Ray 3.8.

/// The first version with the syntax of POV-Ray 3.8: that of its early releases.
const FIRST_WITH_SYNTAX: f64 = 3.71;
/// The first version with the defaults and rules of POV-Ray 3.8.
const FIRST: f64 = 3.8;
/// Versions may be computed, so that their last digits are rounded.
const EQUAL: f64 = 1e-10;

/// True if a version has the words and the syntax of POV-Ray 3.8.
#[must_use]
pub fn has_syntax_of_3_8(version: f64) -> bool {
    version >= FIRST_WITH_SYNTAX - EQUAL
}

/// True if a version has the defaults and rules of POV-Ray 3.8.
#[must_use]
pub fn is_3_8(version: f64) -> bool {
    version >= FIRST - EQUAL
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measured with POV-Ray 3.8: `#version 3.71` has the words but not the defaults.
    #[test]
    fn version_3_71_has_the_syntax_alone() {
        let of = |version| (has_syntax_of_3_8(version), is_3_8(version));
        assert_eq!(of(3.7), (false, false));
        assert_eq!(of(3.71), (true, false));
        assert_eq!(of(3.8), (true, true));
        assert_eq!(of(3.0 + 0.1 * 8.0), (true, true));
    }
}

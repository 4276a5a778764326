//! The octave weights of `f_ridged_mf`, which POV-Ray computes once, for the first call.

use super::internal::ridged_mf;
use std::sync::{Mutex, OnceLock};

/// The `H` and the lacunarity of a call, which determine the octave weights.
pub(super) type OctaveWeights = [f64; 2];

/// The calls of `f_ridged_mf` in a scene. The first one that is evaluated sets the weights for all.
#[derive(Debug, Default)]
pub struct RidgedCalls {
    /// Set by the first call; holds nothing if each call has its own.
    first: OnceLock<Option<OctaveWeights>>,
    written: Mutex<Written>,
}

/// The calls in the formulas of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Written {
    #[default]
    None,
    /// All with the same weights.
    Same(OctaveWeights),
    /// With different weights, or with arguments that vary.
    Different,
}

impl RidgedCalls {
    /// The value for these arguments; zero if there are too few.
    #[must_use]
    pub fn value(&self, arguments: &[f64]) -> f64 {
        let Some(&[x, y, z, h, lacunarity, octaves, offset, gain, noise]) = arguments.first_chunk()
        else {
            return 0.0;
        };
        let own = [h, lacunarity];
        let weights = self.first.get_or_init(|| Some(own)).unwrap_or(own);
        let arguments = [x, y, z, h, lacunarity, octaves, offset, gain, noise];
        ridged_mf(&arguments, weights)
    }

    /// Notes a call in a formula, with `None` for arguments that vary.
    pub(super) fn note(&self, call: Option<OctaveWeights>) {
        if let Ok(mut written) = self.written.lock() {
            *written = match (*written, call) {
                (Written::None, Some(weights)) => Written::Same(weights),
                (Written::Same(known), Some(weights)) if known == weights => *written,
                _ => Written::Different,
            };
        }
    }

    /// Returns true if the picture depends on which call is the first one, and none was evaluated yet.
    #[must_use]
    pub fn is_open(&self) -> bool {
        let written = self
            .written
            .lock()
            .map_or(Written::None, |written| *written);
        written == Written::Different && self.first.get().is_none()
    }

    /// Gives each call weights of its own, unless one was evaluated.
    pub fn close(&self) {
        let _ = self.first.set(None);
    }
}

impl PartialEq for RidgedCalls {
    /// They follow from the rest of the scene.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_call_sets_the_weights_of_all() {
        let at = |h, lacunarity| [0.3, 0.4, 0.5, h, lacunarity, 7.0, 0.6, 0.9, 1.0];
        let calls = RidgedCalls::default();
        calls.note(Some([0.07, 2.2]));
        assert!(!calls.is_open());
        calls.note(Some([0.4, 3.1]));
        assert!(calls.is_open());
        let first = calls.value(&at(0.07, 2.2));
        assert!(!calls.is_open());
        let own = |h, lacunarity| ridged_mf(&at(h, lacunarity), [h, lacunarity]);
        assert_eq!(first.to_bits(), own(0.07, 2.2).to_bits());
        let second = calls.value(&at(0.4, 3.1));
        assert_ne!(second.to_bits(), own(0.4, 3.1).to_bits());
        assert_eq!(
            second.to_bits(),
            ridged_mf(&at(0.4, 3.1), [0.07, 2.2]).to_bits()
        );
    }

    #[test]
    fn calls_that_come_after_all_have_weights_of_their_own() {
        let calls = RidgedCalls::default();
        calls.close();
        for [h, lacunarity] in [[0.07, 2.2], [0.4, 3.1]] {
            let arguments = [0.3, 0.4, 0.5, h, lacunarity, 7.0, 0.6, 0.9, 1.0];
            let own = ridged_mf(&arguments, [h, lacunarity]);
            assert_eq!(calls.value(&arguments).to_bits(), own.to_bits());
        }
    }

    #[test]
    fn calls_with_varying_arguments_are_open() {
        let calls = RidgedCalls::default();
        calls.note(None);
        assert!(calls.is_open());
        assert_eq!(calls.value(&[1.0]).to_bits(), 0.0_f64.to_bits());
        assert!(calls.is_open());
    }
}

//! The cubic step that POV-Ray smooths edges with.

/// `3·t² - 2·t³`: from 0 at 0 to 1 at 1 with flat ends. `t` is not clamped.
#[must_use]
pub fn smooth_step(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::smooth_step;

    #[test]
    fn it_is_flat_at_both_ends() {
        assert_eq!([0.0, 0.5, 1.0].map(smooth_step), [0.0, 0.5, 1.0]);
        assert!(smooth_step(1e-4) < 1e-7 && smooth_step(1.0 - 1e-4) > 1.0 - 1e-7);
    }
}

//! The Halton sequence (Halton 1960) in bases 2 and 3.

use glam::DVec2;

/// Point `number`, counted from 1, of the Halton sequence over the unit square.
#[must_use]
pub fn halton(number: u32) -> DVec2 {
    let radical_inverse = |base: u32| {
        let (mut rest, mut digit, mut sum) = (number, 1.0, 0.0);
        while rest > 0 {
            digit /= f64::from(base);
            sum += digit * f64::from(rest % base);
            rest /= base;
        }
        sum
    };
    DVec2::new(radical_inverse(2), radical_inverse(3))
}

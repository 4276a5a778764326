//! Points of Halton's sequence (Halton 1960) in bases 2 and 3.

use glam::DVec2;

/// The point of a number from 1 on in Halton's sequence over the unit square.
#[must_use]
pub fn halton(number: u32) -> DVec2 {
    let inverse = |base: u32| {
        let (mut rest, mut digit, mut sum) = (number, 1.0, 0.0);
        while rest > 0 {
            digit /= f64::from(base);
            sum += digit * f64::from(rest % base);
            rest /= base;
        }
        sum
    };
    DVec2::new(inverse(2), inverse(3))
}

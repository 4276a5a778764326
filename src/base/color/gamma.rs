//! Transfer functions between linear light and stored values.

/// How stored values relate to linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gamma {
    /// The sRGB curve (IEC 61966-2-1).
    Srgb,
    /// A power law: `linear = stored ^ g`. `Power(1.0)` is linear.
    Power(f32),
}

impl Gamma {
    /// Stored values are linear.
    pub const LINEAR: Gamma = Gamma::Power(1.0);

    /// The curve of a `gamma` number; within 1 % of 1 it is linear.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "a gamma has few digits")]
    pub fn power(g: f64) -> Gamma {
        if (g - 1.0).abs() < 0.01 {
            Gamma::LINEAR
        } else {
            Gamma::Power(g as f32)
        }
    }

    /// Linear light of a stored value.
    #[must_use]
    pub fn decode(self, stored: f32) -> f32 {
        match self {
            Gamma::Srgb if stored <= 0.040_45 => stored / 12.92,
            Gamma::Srgb => ((stored + 0.055) / 1.055).powf(2.4),
            Gamma::Power(1.0) => stored,
            Gamma::Power(g) => stored.max(0.0).powf(g),
        }
    }

    /// The stored value of linear light.
    #[must_use]
    pub fn encode(self, linear: f32) -> f32 {
        match self {
            Gamma::Srgb if linear <= 0.003_130_8 => linear * 12.92,
            Gamma::Srgb => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
            Gamma::Power(1.0) => linear,
            Gamma::Power(g) => linear.max(0.0).powf(1.0 / g),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Gamma;

    #[test]
    fn decoding_undoes_encoding() {
        for gamma in [Gamma::Srgb, Gamma::LINEAR, Gamma::power(2.2)] {
            for i in 0..=10u8 {
                let v = f32::from(i) / 10.0;
                assert!((gamma.decode(gamma.encode(v)) - v).abs() < 1e-5);
            }
        }
    }
}
